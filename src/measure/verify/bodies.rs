//! Scenes for known results, built in code.

use glam::DVec3;

use super::runner::Trouble;
use crate::geometry::Parallelogram;
use crate::physics::Simulation;
use crate::scene::{ContactLaw, Draft, Method, Scene, Settings, Sphere, Wall};

/// g, m/s².
pub(super) const G: f64 = 9.8;

/// Nothing is lost, nothing rests.
pub(super) const ELASTIC: ContactLaw =
    ContactLaw { restitution: 1.0, wall_restitution: 1.0, tangential: 1.0, rest_speed: 0.0 };

/// Impacts keep the share `e` of the approach speed; nothing rubs, nothing rests before its time.
pub(super) fn smooth(e: f64) -> ContactLaw {
    ContactLaw { restitution: e, wall_restitution: e, ..ELASTIC }
}

/// A sphere of mass 1 kg.
pub(super) fn sphere(x: DVec3, v: DVec3, radius: f64) -> Sphere {
    Sphere { x, v, mass: 1.0, radius, force: DVec3::ZERO, color: None, name: None }
}

/// A wall.
pub(super) fn wall(center: DVec3, s1: DVec3, s2: DVec3) -> Wall {
    Wall { shape: Parallelogram { center, s1, s2 }, color: None }
}

/// A floor of 20 m × 20 m at y = 0.
pub(super) fn floor() -> Wall {
    wall(DVec3::ZERO, DVec3::X * 20.0, DVec3::NEG_Z * 20.0)
}

/// A scene of these bodies under gravity `g` (m/s²).
///
/// # Errors
/// If they break a rule of scenes.
pub(super) fn scene(g: DVec3, contact: ContactLaw, walls: Vec<Wall>, spheres: Vec<Sphere>) -> Result<Scene, Trouble> {
    let draft = Draft::new(walls, spheres);
    Ok(Draft { name: "a known result".into(), gravity: g, contact, solver: EXACT, ..draft }.validated()?)
}

/// The event-driven method; its dt only says how often a frame ends.
pub(super) const EXACT: Settings = Settings { method: Method::Exact, dt: 0.1, tolerance: 1e-3 };

/// A run by `exact` that keeps its events.
pub(super) fn exact(scene: &Scene) -> Simulation {
    let mut run = Simulation::new(scene, EXACT);
    run.record_events(true);
    run
}
