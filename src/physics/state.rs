//! All that moves: t, x, v; energy, momentum, tallies; and why a run cannot go on.

use glam::DVec3;

/// Time, positions and velocities. P = m v.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct State {
    /// Time, s.
    pub t: f64,
    /// Centres, m, by sphere index.
    pub x: Vec<DVec3>,
    /// Velocities, m/s, by sphere index.
    pub v: Vec<DVec3>,
}

/// Counted work and outcomes since t = 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tallies {
    /// Frames completed.
    pub frames: u64,
    /// Impacts (`collide` rows).
    pub impacts: u64,
    /// Rests begun.
    pub rests: u64,
    /// Rests ended.
    pub releases: u64,
    /// Degree evaluations (gap computations of one sphere with one wall or sphere).
    pub evaluations: u64,
    /// Trial steps of searches for a collision time.
    pub probes: u64,
    /// Deepest intersection degree at the end of any frame, dimensionless.
    pub deepest_degree: f64,
}

/// Why a run cannot go on.
#[derive(Debug, Clone, PartialEq)]
pub struct Stall {
    /// When, s.
    pub time: f64,
    /// A word for `stall=…`, e.g. `resting-contact`.
    pub kind: &'static str,
    /// A full sentence for people: where, why, and what to try.
    pub reason: String,
}
