//! The one window into a run: plain public data, complete enough to draw a frame from, and to build by hand in a test.

use std::sync::Arc;

use glam::DVec3;

use crate::geometry::Bounds;
pub use crate::physics::{Class, Contact, Kind, Probe, Tallies};
use crate::physics::{Scene, Simulation, Stall, State};

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
            key: key.chars().filter(|c| !c.is_control()).collect(),
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
    /// The same at t = 0, J.
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
        }
    }
}

/// Bins of a [`Ticks`]: more than any terminal has columns, and a few kilobytes however long the run lasts.
const BINS: usize = 1024;

/// Collisions over time, for the timeline: bins of equal width that double when the run outgrows them.
#[derive(Debug, Clone, PartialEq)]
pub struct Ticks {
    /// Time covered by all bins, s, from 0.
    pub span: f64,
    /// Impacts per bin.
    pub impacts: Vec<u32>,
}

impl Ticks {
    /// No collisions yet, in bins that cover `span` seconds (1 s if that is not a positive number).
    pub fn new(span: f64) -> Ticks {
        let span = if span.is_finite() && span > 0.0 { span } else { 1.0 };
        Ticks { span, impacts: vec![0; BINS] }
    }

    /// Counts an impact at `time`, s; the bins double until they reach it. A time that is no number is left out.
    pub fn add(&mut self, time: f64) {
        if !time.is_finite() {
            return;
        }
        while time >= self.span && self.span < f64::MAX / 2.0 {
            self.double();
        }
        let bin = time.max(0.0) / self.span * self.impacts.len() as f64;
        let last = self.impacts.len() - 1;
        let count = &mut self.impacts[(bin as usize).min(last)];
        *count = count.saturating_add(1);
    }

    /// Twice the span in the same number of bins.
    fn double(&mut self) {
        let half = self.impacts.len() / 2;
        for i in 0..half {
            self.impacts[i] = self.impacts[2 * i].saturating_add(self.impacts[2 * i + 1]);
        }
        self.impacts[half..].fill(0);
        self.span *= 2.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn total(ticks: &Ticks) -> u32 {
        ticks.impacts.iter().sum()
    }

    #[test]
    fn an_impact_is_counted_in_the_bin_of_its_time() {
        let mut ticks = Ticks::new(20.0);
        ticks.add(5.0);
        assert_eq!(ticks.impacts[BINS / 4], 1);
        assert_eq!(total(&ticks), 1);
    }

    #[test]
    fn the_bins_double_when_the_run_outgrows_them_and_lose_no_impact() {
        let mut ticks = Ticks::new(20.0);
        for time in [0.0, 1.0, 5.0, 19.9, 20.0, 79.0] {
            ticks.add(time);
        }
        assert_eq!((ticks.span, ticks.impacts.len()), (80.0, BINS));
        assert_eq!(total(&ticks), 6);
        assert_eq!(ticks.impacts[BINS / 4], 1, "20 s of 80 s");
    }

    #[test]
    fn odd_spans_and_times_are_survived() {
        for span in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
            let mut ticks = Ticks::new(span);
            for time in [f64::NAN, f64::INFINITY, -3.0, 0.0, 1e308, f64::MAX] {
                ticks.add(time);
            }
            assert_eq!(total(&ticks), 4);
        }
    }
}
