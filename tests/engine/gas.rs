//! Many spheres by the event-driven method: cells against all pairs, energy, slices, and the collision rate of a gas.

use std::f64::consts::PI;

use crate::support::{ELASTIC, G, changed, gas, run_to, sphere};
use carom::physics::{Class, Contact, Kind, Method, Progress, Scene, Settings, Simulation, Until};
use glam::{DVec3, dvec3};

const EXACT: Settings = Settings { method: Method::Exact, dt: 0.01, tolerance: 1e-3 };

/// The first so many impacts among the first 64 spheres and the walls.
fn impacts(scene: &Scene, count: usize) -> Vec<Contact> {
    let mut run = Simulation::new(scene, EXACT);
    run.record_events(true);
    let mut found = Vec::new();
    while found.len() < count {
        assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
        let concerns = |e: &Contact| e.class == Class::Collide && e.a < 64;
        found.extend(run.take_events().into_iter().filter(concerns));
    }
    found.truncate(count);
    found
}

/// Up to 64 spheres all pairs are looked at, beyond them cells: one more outside the room makes the difference.
fn with_one_outside(scene: &Scene) -> Scene {
    changed(scene, |draft| draft.spheres.push(sphere(DVec3::splat(3.0), dvec3(0.3, 0.2, 0.1), 0.1)))
}

/// Gases of 64: straight, falling, with a force on one sphere, and one big sphere among so small ones that they crowd
/// the cells.
fn gases() -> [(&'static str, Scene); 4] {
    let straight = gas(64, 5, 1.0);
    let falling = changed(&straight, |draft| draft.gravity = G);
    let forced = changed(&falling, |draft| draft.spheres[3].force = dvec3(1.0, 2.0, -3.0));
    let crowded = changed(&falling, |draft| {
        for (i, body) in draft.spheres.iter_mut().enumerate() {
            body.radius = if i == 21 { 0.1 } else { 0.02 };
            body.x *= 0.5;
        }
    });
    [("straight", straight), ("falling", falling), ("forced", forced), ("crowded", crowded)]
}

#[test]
fn cells_and_all_pairs_find_the_same_events() {
    for (name, scene) in gases() {
        let (all, cells) = (impacts(&scene, 300), impacts(&with_one_outside(&scene), 300));
        for (k, (one, other)) in all.iter().zip(&cells).enumerate() {
            assert_eq!(one.key(), other.key(), "{name}, impact {k} at {} s", one.time);
            // The same physics in another order of rounding: 1e-16 grows by less than a decade per impact of a sphere,
            // of which each has had nine by then.
            let apart = (one.time - other.time).abs();
            assert!(apart < 1e-8, "{name}, impact {k} at {} s: {apart:e}", one.time);
        }
    }
}

#[test]
fn slices_and_looks_change_no_bit_of_a_gas() {
    let scene = changed(&gas(500, 11, 1.0), |draft| draft.gravity = G);
    let mut whole = Simulation::new(&scene, EXACT);
    assert_eq!(run_to(&mut whole, 1.0, u64::MAX), None);
    for work in [1, 7, 1000] {
        let mut run = Simulation::new(&scene, EXACT);
        while run.advance(Until::Time(1.0), work) == Progress::Yielded {
            assert!(work == 1 || run.at(run.time() - 0.3 * run.step()).t <= run.time());
        }
        assert_eq!(run.state().hash(), whole.state().hash(), "slices of {work}");
        assert_eq!(run.tallies(), whole.tallies(), "slices of {work}");
    }
}

#[test]
fn so_many_spheres_that_events_are_looked_up_ahead_make_the_same_run_in_slices_too() {
    let scene = gas(21_000, 13, 1.0);
    let until = 0.05;
    let mut whole = Simulation::new(&scene, EXACT);
    assert_eq!(run_to(&mut whole, until, u64::MAX), None);
    let mut run = Simulation::new(&scene, EXACT);
    assert_eq!(run_to(&mut run, until, 17), None);
    assert_eq!((run.state().hash(), run.tallies()), (whole.state().hash(), whole.tallies()));
    assert!(run.tallies().impacts > 1000, "{}", run.tallies().impacts);
}

#[test]
fn a_gas_keeps_its_energy_and_no_sphere_enters_another() {
    for gravity in [DVec3::ZERO, G] {
        let scene = changed(&gas(1000, 3, 1.0), |draft| draft.gravity = gravity);
        let mut run = Simulation::new(&scene, EXACT);
        while run.tallies().impacts < 100_000 {
            run.advance(Until::Frame, u64::MAX);
        }
        // Each impact rounds to some 1e-16 of one sphere's energy, at random: a thousandth of the total, √100 000 times.
        let drift = run.energy() / run.initial_energy() - 1.0;
        assert!(drift.abs() < 1e-13, "{drift:e}");
        let state = run.state();
        for i in 0..1000 {
            for j in 0..i {
                // A contact at this instant is closed to rounding of coordinates of 2 m.
                assert!((state.x[i] - state.x[j]).length() > 0.2 - 1e-14, "{i} and {j}");
            }
        }
    }
}

#[test]
fn a_gas_collides_as_often_as_enskog_and_carnahan_starling_say() {
    // Per sphere 4 √π n d² g √(kT/m), with the contact value g = (1 − φ/2) / (1 − φ)³, in a gas without walls. Walls
    // push spheres together: all centres are at least a radius from them. So the rate lies between that of the gas spread
    // over the whole box and that of the gas squeezed into the room for its centres.
    let (n, d) = (4096, 0.2);
    let scene = gas(n, 17, 1.0);
    let side = (n as f64).cbrt() * 0.3473;
    let temperature = scene.spheres.iter().map(|s| s.v.length_squared()).sum::<f64>() / (3.0 * n as f64);
    let rate = |side: f64| {
        let (density, packing) = (n as f64 / side.powi(3), n as f64 * PI * d * d * d / (6.0 * side.powi(3)));
        let contact = (1.0 - 0.5 * packing) / (1.0 - packing).powi(3);
        4.0 * (PI * temperature).sqrt() * density * d * d * contact
    };
    let mut run = Simulation::new(&scene, EXACT);
    // the uniform start is forgotten after a few impacts per sphere
    assert_eq!(run_to(&mut run, 1.0, u64::MAX), None);
    run.record_events(true);
    let (start, mut pairs) = (run.time(), 0);
    while run.time() < start + 1.5 {
        run.advance(Until::Frame, u64::MAX);
        pairs += run.take_events().iter().filter(|e| e.kind == Kind::Pair).count();
    }
    let found = 2.0 * pairs as f64 / (n as f64 * (run.time() - start));
    // some 27 000 impacts scatter by half a per cent
    assert!(
        found > 0.99 * rate(side) && found < 1.01 * rate(side - d),
        "{found} not in {}…{}",
        rate(side),
        rate(side - d)
    );
    assert_eq!(scene.contact, ELASTIC);
}
