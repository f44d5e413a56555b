//! Builders of scenes in code, for tests that ask about physics and not about files.

// Each test file is a crate of its own and uses what it needs.
#![allow(dead_code)]

use carom::geometry::{Bounds, Parallelogram};
use carom::physics::{Method, Progress, Scene, Settings, Simulation, Stall, State};
use carom::random::SplitMix64;
use carom::scene::{ContactLaw, Draft, Sphere, Wall};
use glam::{DVec3, dvec3};

/// The contact law of the source paper.
pub(crate) const PAPER_LAW: ContactLaw =
    ContactLaw { restitution: 0.8, wall_restitution: 0.8, tangential: 0.99, rest_speed: 0.1 };

/// Nothing is lost, nothing rests.
pub(crate) const ELASTIC: ContactLaw =
    ContactLaw { restitution: 1.0, wall_restitution: 1.0, tangential: 1.0, rest_speed: 0.0 };

/// `paper` with these knobs.
pub(crate) fn paper(dt: f64, tolerance: f64) -> Settings {
    Settings { method: Method::Paper, dt, tolerance }
}

/// A wall.
pub(crate) fn wall(center: DVec3, s1: DVec3, s2: DVec3) -> Wall {
    Wall { shape: Parallelogram { center, s1, s2 }, color: None }
}

/// A sphere of mass 1 kg.
pub(crate) fn sphere(x: DVec3, v: DVec3, radius: f64) -> Sphere {
    Sphere { x, v, mass: 1.0, radius, force: DVec3::ZERO, color: None, name: None }
}

/// A sphere of radius 0.5 m and mass 1 kg at rest.
pub(crate) fn still(x: DVec3) -> Sphere {
    sphere(x, DVec3::ZERO, 0.5)
}

/// A sphere of radius 0.5 m on the x axis, at `x` (m) with `v` (m/s) along it.
pub(crate) fn ball(x: f64, v: f64, mass: f64) -> Sphere {
    Sphere { mass, ..sphere(DVec3::X * x, DVec3::X * v, 0.5) }
}

/// Everything has this restitution; nothing rubs, nothing rests before its time.
pub(crate) fn smooth(e: f64) -> ContactLaw {
    ContactLaw { restitution: e, wall_restitution: e, ..ELASTIC }
}

/// The six walls of a box, in the order and orientation of the source paper's table.
pub(crate) fn room(min: DVec3, max: DVec3) -> Vec<Wall> {
    let (c, s) = (0.5 * (min + max), max - min);
    let (x, y, z) = (DVec3::X * s.x, DVec3::Y * s.y, DVec3::Z * s.z);
    vec![
        wall(c - 0.5 * y, x, -z),
        wall(c + 0.5 * y, x, z),
        wall(c - 0.5 * z, x, y),
        wall(c + 0.5 * z, -x, y),
        wall(c + 0.5 * x, z, y),
        wall(c - 0.5 * x, -z, y),
    ]
}

/// A scene of these bodies.
pub(crate) fn scene(gravity: DVec3, contact: ContactLaw, walls: Vec<Wall>, spheres: Vec<Sphere>) -> Scene {
    let view = Bounds { min: DVec3::splat(-5.0), max: DVec3::splat(5.0) };
    let draft = Draft { name: "built in code".into(), gravity, contact, view, ..Draft::new(walls, spheres) };
    draft.validated().unwrap_or_else(|error| panic!("{error}"))
}

/// The scene after a change that keeps it within the rules.
pub(crate) fn changed(scene: &Scene, change: impl FnOnce(&mut Draft)) -> Scene {
    scene.changed(change).unwrap_or_else(|error| panic!("{error}"))
}

/// The scene with its spheres where a run has taken them.
pub(crate) fn moved(scene: &Scene, state: &State) -> Scene {
    scene.moved(&state.x, &state.v).unwrap_or_else(|error| panic!("{error}"))
}

/// g of the source paper, m/s².
pub(crate) const G: DVec3 = dvec3(0.0, -9.8, 0.0);

/// Scene `k` of the source paper.
pub(crate) fn paper_scene(k: usize) -> Scene {
    carom::scene::open(format!("paper-{k}")).expect("a built-in scene").scene
}

/// A run at its start that keeps its events.
pub(crate) fn recorded(scene: &Scene, settings: Settings) -> Simulation {
    let mut run = Simulation::new(scene, settings);
    run.record_events(true);
    run
}

/// Goes on to a frame that ends at or after `t` (s), in slices of `work`; why it stalled, if it did.
pub(crate) fn run_to(run: &mut Simulation, t: f64, work: u64) -> Option<Stall> {
    match run.run_to(t, |_| Some(work)) {
        Progress::Stalled(stall) => Some(stall),
        Progress::Reached | Progress::Yielded => None,
    }
}

/// The state at `until` (s), which is reached within a hundred million units of work.
pub(crate) fn go(run: &mut Simulation, until: f64) -> State {
    let mut slices = 0..1000;
    match run.run_to(until, |_| slices.next().map(|_| 100_000)) {
        Progress::Reached => run.at(until),
        Progress::Yielded => panic!("a hundred million units of work and still at {} s", run.time()),
        Progress::Stalled(stall) => panic!("{}", stall.reason),
    }
}

/// A square floor of this width (m) at y = 0, its centre at the origin.
pub(crate) fn floor(width: f64) -> Wall {
    wall(DVec3::ZERO, DVec3::X * width, DVec3::NEG_Z * width)
}

/// A pyramid of so many square layers of spheres of radius 0.5 m, apart by `gap` (m), the lowest just between four walls.
pub(crate) fn pyramid(layers: u8, gap: f64, contact: ContactLaw) -> Scene {
    let (half, mut spheres) = (0.5 * f64::from(layers), Vec::new());
    for layer in 0..layers {
        let (side, height) = (layers - layer, f64::from(layer) * (0.5_f64.sqrt() + gap));
        for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
            let at = |k: u8| (f64::from(k) - f64::from(side - 1) * 0.5) * (1.0 + gap);
            spheres.push(sphere(dvec3(at(i), 0.5 + gap + height, at(j)), DVec3::ZERO, 0.5));
        }
    }
    let width = half * (1.0 + gap);
    scene(G, contact, room(dvec3(-width, 0.0, -width), dvec3(width, 20.0, width)), spheres)
}

/// `n`³ spheres of mass 1 kg on a cubic lattice about the origin, all with the same velocity.
pub(crate) fn lattice(n: usize, spacing: f64, v: DVec3, radius: f64) -> Vec<Sphere> {
    let at = |k: usize| (k as f64 - 0.5 * (n - 1) as f64) * spacing;
    let place = |k: usize| dvec3(at(k / (n * n)), at(k / n % n), at(k % n));
    (0..n * n * n).map(|k| sphere(place(k), v, radius)).collect()
}

/// An elastic gas of `n` spheres of radius 0.1 m and rms speed 1 m/s per axis (uniform, not yet thermal), filling a
/// tenth of its box.
pub(crate) fn gas(n: usize, seed: u64, speed: f64) -> Scene {
    let mut random = SplitMix64::new(seed);
    let mut centered = || random.unit() - 0.5;
    // A tenth: spheres of 4/3 π 0.1³ m³ in cells of 0.3473 m, jittered by what the gap allows.
    let (side, spacing) = ((1..).find(|k| k * k * k >= n).unwrap_or(1), 0.3473);
    let mut spheres = lattice(side, spacing, DVec3::ZERO, 0.1);
    spheres.truncate(n);
    for body in &mut spheres {
        body.x += dvec3(centered(), centered(), centered()) * 0.14;
        body.v = dvec3(centered(), centered(), centered()) * (speed * 12f64.sqrt());
    }
    let half = DVec3::splat(0.5 * spacing * side as f64);
    scene(DVec3::ZERO, ELASTIC, room(-half, half), spheres)
}
