//! The scenes, how long each runs, and what enters with which settings. An entry a line: what is compared is read here.

use carom::physics::{Method, Scene, Settings};

use crate::engine::Entrant;
use crate::peer::{Contacts, Tuning};

/// The names, in the order of the table.
pub const NAMES: [&str; 5] = ["bouncing-49", "elastic-666", "inelastic-666", "gas-1000", "gas-10000"];

/// A scene and what enters; the first entrant is what the others are compared with.
pub struct Case {
    /// Its name.
    pub name: &'static str,
    /// The scene.
    pub scene: Scene,
    /// Simulated time, s.
    pub until: f64,
    /// Whether energy must stay what it is.
    pub elastic: bool,
    /// Engines with settings.
    pub entrants: Vec<Entrant>,
}

impl Case {
    /// When the frames of this entrant end, s.
    pub fn times(&self, entrant: &Entrant) -> impl Iterator<Item = f64> + use<> {
        let rate = entrant.rate();
        (1..=(self.until * rate).round() as u64).map(move |k| k as f64 / rate)
    }
}

/// All cases.
pub fn all() -> Vec<Case> {
    use Contacts::{Default, Hard, Late};
    let [bouncing, elastic, inelastic, gas_3, gas_4] = NAMES;
    let steps = [rapier(60, 4, Default), rapier(240, 4, Default), rapier(960, 4, Default)];
    let keeping = [rapier(960, 16, Default), rapier(240, 16, Late), rapier(960, 16, Late)];
    let bounces = [&[exact(), swept(1e-6)][..], &steps, &keeping].concat();
    let heaps = [moreau(60, 1e-3), moreau(60, 1e-10), moreau(240, 1e-6)];
    let harder = [rapier(60, 16, Hard), rapier(240, 16, Hard)];
    vec![
        case(bouncing, shipped(bouncing), 20.0, bounces.clone()),
        case(elastic, shipped(elastic), 10.0, bounces),
        case(inelastic, shipped(inelastic), 10.0, [&heaps[..], &steps, &harder].concat()),
        case(gas_3, gas(1000), 3.0, [&[exact(), swept(1e-6)][..], &steps, &[rapier(240, 16, Late)]].concat()),
        case(gas_4, gas(10_000), 0.5, [&[exact(), swept(1e-6)][..], &steps[..2], &[rapier(240, 16, Late)]].concat()),
    ]
}

fn case(name: &'static str, scene: Scene, until: f64, entrants: Vec<Entrant>) -> Case {
    let elastic = scene.contact.restitution == 1.0;
    Case { name, scene, until, elastic, entrants }
}

/// Events; frames as often as a screen shows them.
fn exact() -> Entrant {
    Entrant::Carom(Settings { method: Method::Exact, dt: 1.0 / 60.0, tolerance: 1e-3 })
}

fn swept(tolerance: f64) -> Entrant {
    Entrant::Carom(Settings { method: Method::Swept, dt: 1.0 / 60.0, tolerance })
}

fn moreau(rate: u32, tolerance: f64) -> Entrant {
    Entrant::Carom(Settings { method: Method::Moreau, dt: 1.0 / f64::from(rate), tolerance })
}

fn rapier(rate: u32, iterations: usize, contacts: Contacts) -> Entrant {
    Entrant::Rapier(Tuning { rate, iterations, contacts })
}

fn shipped(name: &str) -> Scene {
    carom::scene::open(name).expect("a built-in scene").scene
}

/// An elastic gas without gravity: spheres of radius 0.1 m that fill a tenth of a cube, as in `benches/gas.rs`.
fn gas(count: usize) -> Scene {
    let volume = count as f64 * std::f64::consts::PI / 750.0;
    let half = 0.5 * (volume / 0.1).cbrt();
    let text = format!(
        "Scene(name: \"gas\", contact: (restitution: 1, tangential: 1, rest_speed: 0), \
         walls: [Room(min: (-{half}, -{half}, -{half}), max: ({half}, {half}, {half}))], \
         spheres: [Gas(min: (-{half}, -{half}, -{half}), max: ({half}, {half}, {half}), \
         count: {count}, seed: 7, speed: 1, mass: 1, radius: 0.1)])"
    );
    carom::scene::parse(&text, "gas").expect("a valid scene")
}
