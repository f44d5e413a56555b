//! Gases of hard spheres in a box of elastic walls, and what is counted in them.

use std::f64::consts::PI;

use super::bodies::EXACT;
use super::runner::{Runner, Trouble};
use crate::physics::{Class, Contact, Kind, Simulation, State};
use crate::scene::{self, ContactLaw, Scene};

/// Radius of every sphere, m.
pub(super) const RADIUS: f64 = 0.1;
/// Diameter, m.
pub(super) const SIGMA: f64 = 2.0 * RADIUS;
/// Time after which the start is forgotten, s: a sphere of mean speed passes its diameter thirty times, collides fifty
/// times and more, and sound crosses the box several times.
const WARM_UP: f64 = 30.0 * SIGMA;

/// Elastic spheres of these masses (kg) in equal numbers, strewn at rms speed 1 m/s per axis over a cube of which
/// they fill the share `packing`.
pub(super) fn gas(packing: f64, count: usize, masses: &[f64]) -> Result<Scene, Trouble> {
    let half = 0.5 * side(packing, count);
    let corners = format!("min: (-{half}, -{half}, -{half}), max: ({half}, {half}, {half})");
    let part = |(seed, mass): (usize, &f64)| {
        let (count, seed) = (count / masses.len(), seed + 7);
        format!("Gas({corners}, count: {count}, seed: {seed}, speed: 1, mass: {mass}, radius: {RADIUS})")
    };
    let parts: Vec<String> = masses.iter().enumerate().map(part).collect();
    let text = format!(
        "Scene(contact: (restitution: 1, tangential: 1, rest_speed: 0), walls: [Room({corners})], spheres: [{}])",
        parts.join(", ")
    );
    Ok(scene::parse(&text, "gas")?)
}

/// Edge of the cube, m; in millimetres, so that a machine's own cube root does not show.
pub(super) fn side(packing: f64, count: usize) -> f64 {
    ((count as f64 * PI * SIGMA * SIGMA * SIGMA / (6.0 * packing)).cbrt() * 1000.0).round() / 1000.0
}

/// The scene at another moment, under another law of contact.
///
/// # Errors
/// If that breaks a rule of scenes.
pub(super) fn continued(scene: &Scene, state: &State, contact: ContactLaw) -> Result<Scene, Trouble> {
    Ok(scene.changed(|draft| draft.contact = contact)?.moved(&state.x, &state.v)?)
}

/// A gas under way.
pub(super) struct Gas<'a> {
    runner: &'a Runner<'a>,
    pub(super) run: Simulation,
    pub(super) count: f64,
}

impl<'a> Gas<'a> {
    /// A gas that begins with this scene, in which nothing has happened yet.
    pub(super) fn new(runner: &'a Runner, scene: &Scene) -> Gas<'a> {
        Gas { runner, run: Simulation::new(scene, EXACT), count: scene.spheres.len() as f64 }
    }

    /// A gas that has run from this scene on until the start is forgotten.
    pub(super) fn thermal(runner: &'a Runner, scene: &Scene) -> Result<Gas<'a>, Trouble> {
        let mut gas = Gas::new(runner, scene);
        gas.go(WARM_UP)?;
        gas.run.record_events(true);
        gas.run.take_events();
        Ok(gas)
    }

    /// The state at `time`, s.
    pub(super) fn go(&mut self, time: f64) -> Result<State, Trouble> {
        self.runner.go(&mut self.run, time)
    }

    /// The impacts of pairs since the last look.
    pub(super) fn impacts(&mut self) -> impl Iterator<Item = Contact> + use<> {
        self.run.take_events().into_iter().filter(|row| row.kind == Kind::Pair && row.class == Class::Collide)
    }

    /// Σ m v² / 3 by sphere, J: kT.
    pub(super) fn temperature(&self) -> f64 {
        2.0 * self.run.energy() / (3.0 * self.count)
    }
}
