//! The one window into a run: plain public data, complete enough to draw a frame from, and to build by hand in a test.

use std::sync::Arc;

use glam::DVec3;

use crate::geometry::Bounds;
pub use crate::physics::{Class, Contact, Kind, Probe, Tallies};

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

/// Collisions over time, for the timeline: bins of equal width that double when the run outgrows them.
#[derive(Debug, Clone, PartialEq)]
pub struct Ticks {
    /// Time covered by all bins, s, from 0.
    pub span: f64,
    /// Impacts per bin.
    pub impacts: Vec<u32>,
}
