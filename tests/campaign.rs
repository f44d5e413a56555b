//! Thousands of random scenes by the event-driven method: nothing hangs, escapes, gains energy or goes deep.
//!
//! `CAROM_CAMPAIGN=20000 cargo test --release --test campaign -- --nocapture` is the whole campaign; the ordinary suite
//! runs the first forty of the same scenes. `CAROM_CAMPAIGN_FROM` sets the first seed.

#[path = "support/random.rs"]
mod random;
mod support;

use std::collections::BTreeSet;

use random::Random;

use carom::physics::contact_time::{Part, touch};
use carom::physics::{Class, Kind, Method, Model, Progress, Scene, Settings, Simulation, State, Until};
use carom::scene::{ContactLaw, Sphere, Wall};
use glam::{DVec3, dvec3};
use support::{room, scene, wall};

const EXACT: Settings = Settings { method: Method::Exact, dt: 0.5, tolerance: 1e-3 };

fn law(random: &mut Random) -> ContactLaw {
    let mut restitution = || match random.pick(&[0, 1, 2, 2, 2, 3]) {
        0 => 0.0,
        1 => 1.0,
        2 => random.unit(),
        _ => random.between(0.0, 0.1),
    };
    let (restitution, wall_restitution) = (restitution(), restitution());
    let tangential = random.pick(&[1.0, 0.99, 0.5]);
    ContactLaw { restitution, wall_restitution, tangential, rest_speed: random.pick(&[0.0, 0.1, 0.1]) }
}

/// Free-standing walls: anything, or a V to roll into.
fn obstacles(random: &mut Random) -> Vec<Wall> {
    match random.pick(&[0, 1, 1, 2, 2, 3]) {
        0 => vec![],
        1 => (0..=(3.0 * random.unit()) as usize)
            .map(|_| {
                let center = dvec3(random.between(-4.0, 4.0), random.between(1.0, 8.0), random.between(-4.0, 4.0));
                let s1 = random.vector().normalize_or(DVec3::X) * random.between(0.5, 6.0);
                let s2 = random.vector().normalize_or(DVec3::Z).cross(s1).normalize_or(DVec3::Y);
                wall(center, s1, (s2 + s1 * random.between(-0.1, 0.1)) * random.between(0.5, 4.0))
            })
            .collect(),
        2 => {
            let (a, b) = (random.between(0.2, 1.5), random.between(0.2, 1.5));
            let along = dvec3(0.0, random.pick(&[0.0, 0.0, 0.3]), 6.0);
            vec![
                wall(dvec3(-1.5, 2.0 + 1.5 * a, 0.0), along, dvec3(-3.0, 3.0 * a, 0.0)),
                wall(dvec3(1.5, 2.0 + 1.5 * b, 0.0), along, dvec3(3.0, 3.0 * b, 0.0)),
            ]
        }
        _ => {
            // a bench: flat or tilted, with edges to fall from
            let tilt = random.pick(&[0.0, 0.0, 0.1, 0.3]);
            vec![wall(dvec3(0.0, 3.0, 0.0), dvec3(random.between(1.0, 4.0), tilt, 0.0), dvec3(0.0, 0.0, -2.0))]
        }
    }
}

fn random_scene(seed: u64) -> Scene {
    let random = &mut Random(seed.wrapping_mul(0x5851_f42d_4c95_7f2d) ^ 0x1405_7b7e_f767_814f);
    let mut walls = room(dvec3(-5.0, 0.0, -5.0), dvec3(5.0, 10.0, 5.0));
    walls.extend(obstacles(random));
    let gravity = match random.pick(&[0, 1, 1, 1, 1, 2]) {
        0 => DVec3::ZERO,
        1 => dvec3(0.0, -9.8, 0.0),
        _ => random.vector() * 9.8,
    };
    let law = law(random);
    let model = Model::new(&scene(gravity, law, walls.clone(), vec![]));
    let mut spheres: Vec<Sphere> = Vec::new();
    let (count, in_line) = (1 + (6.0 * random.unit()) as usize, random.unit() < 0.15);
    let speed = random.pick(&[0.0, 1.0, 5.0, 17.0]);
    for _ in 0..1000 {
        let radius = if in_line { 0.3 } else { random.between(0.2, 0.6) };
        let mut x = dvec3(random.between(-4.4, 4.4), random.between(0.6, 9.4), random.between(-4.4, 4.4));
        let mut v = random.vector() * speed;
        if in_line {
            // on one line: cradles and collapses
            (x.y, x.z, v) = (3.5, 0.0, dvec3(v.x, 0.0, 0.0));
        }
        let free = model.faces.iter().all(|face| touch(face, x, radius).gap > 0.0)
            && spheres.iter().all(|s| (s.x - x).length() > s.radius + radius);
        if free {
            let mass = if in_line { 1.0 } else { random.pick(&[1.0, 1.0, 0.1, 10.0, 3.7]) };
            let force = if random.unit() < 0.1 { random.vector() } else { DVec3::ZERO };
            spheres.push(Sphere { x, v, mass, radius, force, color: None, name: None });
        }
        if spheres.len() == count {
            break;
        }
    }
    scene(gravity, law, walls, spheres)
}

/// How often each thing was met.
#[derive(Default, Debug)]
struct Met {
    impacts: u64,
    faces: u64,
    edges: u64,
    corners: u64,
    pairs: u64,
    rests: u64,
    creases: u64,
    pair_rests: u64,
    edge_rests: u64,
    releases: u64,
    collapses: u64,
    curved: u64,
    curved_time: f64,
    deepest: f64,
    gain: f64,
}

/// Largest −gap / r of the state, walls and pairs.
fn depth(model: &Model, state: &State) -> f64 {
    let mut deepest = f64::NEG_INFINITY;
    for i in 0..model.len() {
        for face in &model.faces {
            deepest = deepest.max(-touch(face, state.x[i], model.radii[i]).gap / model.radii[i]);
        }
        for j in 0..i {
            let reach = model.radii[i] + model.radii[j];
            deepest = deepest.max(1.0 - (state.x[i] - state.x[j]).length() / reach);
        }
    }
    deepest
}

/// Σ of what the energy is made of, each term positive: what rounding is relative to.
fn size(model: &Model, state: &State) -> f64 {
    let of = |i: usize| {
        let (v, x) = (state.v[i], state.x[i]);
        model.masses[i] * (0.5 * v.length_squared() + model.acceleration(i).length() * (x.length() + 1.0))
    };
    (0..model.len()).map(of).sum()
}

fn check(seed: u64, met: &mut Met) -> Result<(), String> {
    let scene = random_scene(seed);
    let mut run = Simulation::new(&scene, EXACT);
    run.record_events(true);
    let fail = |run: &Simulation, what: String| Err(format!("seed {seed} at t = {}: {what}", run.time()));
    let mut size_most = size(run.model(), &run.state());
    let mut least = run.initial_energy();
    for frame in 0..20 {
        let until = 0.5 * f64::from(frame + 1);
        match run.advance(Until::Time(until), 2_000_000) {
            Progress::Reached => {}
            Progress::Yielded => return fail(&run, format!("hangs: {:?}", run.tallies())),
            Progress::Stalled(stall) => return fail(&run, format!("stalls: {}", stall.reason)),
        }
        let state = run.at(until);
        let (model, deep) = (run.model(), depth(run.model(), &state));
        met.deepest = met.deepest.max(deep);
        if deep > 1e-12 {
            return fail(&run, format!("degree {deep:e}"));
        }
        if let Some(i) = (0..model.len()).find(|&i| {
            let far = (state.x[i] - dvec3(0.0, 5.0, 0.0)).abs().max_element();
            far.is_nan() || far > 5.0
        }) {
            return fail(&run, format!("sphere {i} has escaped to {}", state.x[i]));
        }
        let energy = state.energy(model);
        size_most = size_most.max(size(model, &state));
        let gain = (energy - least) / size_most.max(f64::MIN_POSITIVE);
        met.gain = met.gain.max(gain);
        // an impact changes the energy by some ulp; 1e-12 is a thousand of them
        if gain > 1e-12 {
            return fail(&run, format!("energy rose from {least} to {energy}"));
        }
        least = least.min(energy);
    }
    let events = run.take_events();
    let mut resting: BTreeSet<(Kind, usize, usize)> = BTreeSet::new();
    for event in &events {
        let part = (event.kind == Kind::Wall).then(|| {
            let x = event.point + event.normal * run.model().radii[event.a];
            touch(&run.model().faces[event.b], x, run.model().radii[event.a]).part
        });
        match event.class {
            Class::Collide => {
                met.impacts += 1;
                match part {
                    Some(Part::Face) => met.faces += 1,
                    Some(Part::Edge(_)) => met.edges += 1,
                    Some(Part::Corner(_)) => met.corners += 1,
                    None => met.pairs += 1,
                }
            }
            Class::Rest => {
                met.rests += 1;
                resting.insert(event.key());
                let walls = resting.iter().filter(|key| key.0 == Kind::Wall && key.1 == event.a).count();
                match part {
                    None => met.pair_rests += 1,
                    Some(Part::Face) if walls >= 2 => met.creases += 1,
                    Some(Part::Face) => {}
                    Some(_) => met.edge_rests += 1,
                }
            }
            Class::Release => {
                met.releases += 1;
                resting.remove(&event.key());
            }
            Class::Leave => {}
        }
    }
    met.collapses += run.tallies().collapses;
    met.curved += u64::from(run.tallies().inexact_time > 0.0);
    met.curved_time += run.tallies().inexact_time;
    Ok(())
}

fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(otherwise)
}

#[test]
fn random_scenes_neither_hang_nor_escape_nor_gain_energy_nor_go_deep() {
    let (from, count) = (number("CAROM_CAMPAIGN_FROM", 0), number("CAROM_CAMPAIGN", 40));
    let mut met = Met::default();
    let failures: Vec<String> = (from..from + count).filter_map(|seed| check(seed, &mut met).err()).collect();
    #[expect(clippy::print_stdout, reason = "a campaign tells what it met")]
    {
        println!("{count} scenes: {met:#?}");
    }
    let shown = failures[..failures.len().min(20)].join("\n");
    assert!(failures.is_empty(), "{} of {count} scenes failed:\n{shown}", failures.len());
    if count >= 20_000 {
        let rare = [met.faces, met.edges, met.corners, met.pairs, met.rests, met.creases, met.releases, met.collapses];
        assert!(rare.iter().all(|&n| n >= 500), "each thing at least 500 times");
    }
}
