//! Curved rest: spheres that slide over an edge, over a corner or over each other have no parabola. They are integrated
//! to 1e-12, and the time spent so is counted as not exact.
//!
//! INTERFACE (agreed with `exact/rest.rs`; the types and signatures below are what rest.rs calls):
//! - An island is `bodies` (local indices 0..n) and `contacts`, all closed (v_n = 0, loaded or idle) at the start.
//! - `advance(bodies, contacts, h)` moves all bodies by exactly `h` seconds with the contacts kept closed: high order
//!   (error per step ≪ 1e-13 m at the h that `step` proposes), finishing with a projection of x and v onto the contacts
//!   (gap 0 to rounding, v_n 0). Deterministic; only + − × ÷ √. It is also called with any shorter h (an event in mid-step,
//!   or somebody reads the state), so the result must be smooth in h.
//! - `step(bodies, contacts)` proposes h such that the chord parabola x₀ + v₀ s + a s²/2 with a = 2 (x_h − x₀ − v₀ h)/h²
//!   departs from the true path by < 1e-13 · r anywhere in [0, h] (departure ≈ jerk h³ / 40), so that every contact time with other
//!   bodies can be predicted by `contact_time` on that parabola.
//! - `advance` reports `Ended::Kept`, or the first time s ≤ h at which a contact stops carrying load (λ falls through 0, found to
//!   1e-12 relative), or at which a wall contact's closest point changes its part (edge → face, edge → corner,
//!   corner → edge): bodies are then at that s.

use glam::DVec3;

use super::super::contact_time::Part;
use super::super::model::Face;

/// A body of the island.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Body {
    /// Centre, m.
    pub(super) x: DVec3,
    /// Velocity, m/s.
    pub(super) v: DVec3,
    /// Acceleration by everything but contacts, m/s².
    pub(super) applied: DVec3,
    /// 1/kg.
    pub(super) inverse_mass: f64,
    /// Radius, m.
    pub(super) r: f64,
}

/// What a body of the island touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum On<'a> {
    /// This part of a wall.
    Wall(&'a Face, Part),
    /// Another body of the island.
    Body(usize),
}

/// A closed contact of the island.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Closed<'a> {
    /// The body.
    pub(super) a: usize,
    /// What it touches.
    pub(super) on: On<'a>,
}

/// How `advance` ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Ended {
    /// All of h, every contact still closed and loaded (or idle as before).
    Kept,
    /// After this many seconds a contact opens or changes its part; the bodies are there.
    Changed(f64),
}
