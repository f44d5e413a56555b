//! The one window into a run: plain public data, complete enough to draw a frame from, and to build by hand in a test.

mod bins;
mod ghost;
mod ticks;
mod trend;

use std::sync::Arc;

pub use ghost::Ghost;
use glam::DVec3;
pub use ticks::Ticks;
pub use trend::{Trade, Trend};

pub use crate::audit::Alarm;
use crate::geometry::Bounds;
pub use crate::physics::{Class, Contact, Kind, Probe, Tallies};
use crate::physics::{Simulation, Stall, State};
use crate::printable;
use crate::scene::Scene;

/// What does not change during a run; built once per scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Name by which the scene was opened (built-in name or file stem), free of control characters.
    pub key: String,
    /// The scene's title.
    pub name: String,
    /// One line on what to look at.
    pub about: String,
    /// Duration the scene proposes, s.
    pub duration: f64,
    /// What the screen shows at first, m.
    pub view: Bounds,
    /// Outlines of the walls, m, with the colour the scene names.
    pub walls: Vec<([DVec3; 4], Option<[f64; 3]>)>,
    /// Radii, m, by sphere index.
    pub radii: Vec<f64>,
    /// Masses, kg, by sphere index.
    pub masses: Vec<f64>,
    /// Colours, by sphere index.
    pub colors: Vec<Option<[f64; 3]>>,
    /// Names, by sphere index.
    pub names: Vec<Option<String>>,
}

impl Stage {
    /// What stays constant of `scene`, opened by the name `key`.
    pub fn of(key: &str, scene: &Scene) -> Stage {
        Stage {
            key: printable::escaped(key),
            name: scene.name.clone(),
            about: scene.about.clone(),
            duration: scene.duration,
            view: scene.view,
            walls: scene.walls.iter().map(|wall| (wall.shape.corners(), wall.color)).collect(),
            radii: scene.spheres.iter().map(|sphere| sphere.radius).collect(),
            masses: scene.spheres.iter().map(|sphere| sphere.mass).collect(),
            colors: scene.spheres.iter().map(|sphere| sphere.color).collect(),
            names: scene.spheres.iter().map(|sphere| sphere.name.clone()).collect(),
        }
    }
}

/// A run at the end of one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// What does not change.
    pub stage: Arc<Stage>,
    /// Time, s.
    pub t: f64,
    /// Real length of the frame that ended here, s.
    pub step: f64,
    /// Centres, m.
    pub x: Vec<DVec3>,
    /// Velocities, m/s.
    pub v: Vec<DVec3>,
    /// Σ ½ m v² − m g·x − F·x, J.
    pub energy: f64,
    /// Σ ½ m v² − m g·x − F·x at t = 0, J.
    pub initial_energy: f64,
    /// Every contact of the frame that ended here.
    pub contacts: Vec<Contact>,
    /// What its search for the collision time did, trial step by trial step; empty if it needed none.
    pub probes: Vec<Probe>,
    /// Counted since t = 0.
    pub tallies: Tallies,
    /// Name of the method.
    pub method: &'static str,
    /// Longest frame, s.
    pub dt: f64,
    /// Intersection tolerance, dimensionless.
    pub tolerance: f64,
    /// Why the run cannot go on, if it cannot: a full sentence.
    pub stall: Option<String>,
    /// What the watch over the run has found wrong since its start.
    pub alarm: Alarm,
}

impl Snapshot {
    /// The run as it stands at the end of the last complete frame; `stall` if it cannot go on.
    pub fn of(stage: &Arc<Stage>, sim: &Simulation, stall: Option<&Stall>) -> Snapshot {
        let State { t, x, v } = sim.state();
        let settings = sim.settings();
        Snapshot {
            stage: Arc::clone(stage),
            t,
            step: sim.step(),
            x,
            v,
            energy: sim.energy(),
            initial_energy: sim.initial_energy(),
            contacts: sim.contacts().to_vec(),
            probes: sim.probes().to_vec(),
            tallies: sim.tallies(),
            method: settings.method.name(),
            dt: settings.dt,
            tolerance: settings.tolerance,
            stall: stall.map(|stall| stall.reason.clone()),
            alarm: Alarm::default(),
        }
    }
}
