//! Laws over as many impacts as the demands name: ten million of a gas, three million of two balls at a wall.
//!
//! `CAROM_LONG=1 cargo test --release --test engine long::` asks for all of them, which takes half a minute; without it, for a
//! tenth of the gas and of the balls.

use crate::sums::Sum;
use crate::support::{ELASTIC, gas, run_to, scene, sphere, wall};
use carom::physics::{Contact, Kind, Method, Progress, Scene, Settings, Simulation, Until};
use carom::scene::Sphere;
use glam::DVec3;

fn all() -> bool {
    std::env::var_os("CAROM_LONG").is_some_and(|value| value != "0")
}

fn start(scene: &Scene, dt: f64) -> Simulation {
    Simulation::new(scene, Settings { method: Method::Exact, dt, tolerance: 1e-3 })
}

/// Σ m v² (J, twice the energy) and Σ m v (kg m/s), summed without loss but for the squares' own rounding.
fn kept(run: &Simulation) -> (f64, DVec3) {
    let (mut energy, mut momentum) = (Sum::default(), Sum::default());
    for (v, &mass) in run.state().v.iter().zip(&run.model().masses) {
        energy.add(*v * *v * mass);
        momentum.add(*v * mass);
    }
    (energy.value().element_sum(), momentum.value())
}

#[test]
fn an_elastic_gas_keeps_energy_and_momentum_over_ten_million_impacts() {
    let impacts = if all() { 10_000_000 } else { 1_000_000 };
    let mut run = start(&gas(1000, 5, 1.0), 0.1);
    run.record_events(true);
    let before = kept(&run);
    let mut walls = Sum::default();
    let given = |row: &Contact| if row.kind == Kind::Wall { row.normal * row.impulse } else { DVec3::ZERO };
    while run.tallies().impacts < impacts {
        assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
        run.take_events().iter().for_each(|row| walls.add(given(row)));
    }
    let after = kept(&run);
    let scale: f64 = run.state().v.iter().zip(&run.model().masses).map(|(v, m)| v.length() * m).sum();
    let (energy, momentum) = (after.0 / before.0 - 1.0, (after.1 - before.1 - walls.value()).length() / scale);
    println!("{impacts} impacts: energy off by {energy:e}, momentum less the walls' impulses by {momentum:e}");
    // Demanded. Rounding at random leaves √10⁷ ulp over a thousand spheres, some 1e-15.
    assert!(energy.abs() <= 1e-14 && momentum <= 1e-14, "energy off by {energy:e}, momentum by {momentum:e}");
}

#[test]
fn two_balls_at_a_wall_count_six_digits_of_pi() {
    // Galperin 2003: 1 kg at rest, 100^k kg coming in: ⌊π 10^k⌋ impacts.
    let more: &[(i32, u64)] = if all() { &[(5, 314_159), (6, 3_141_592)] } else { &[(5, 314_159)] };
    for &(k, digits) in more {
        let ball = |x: f64, v: f64, mass: f64| Sphere { mass, ..sphere(DVec3::X * x, DVec3::X * v, 0.5) };
        let balls = vec![ball(2.0, 0.0, 1.0), ball(4.0, -1.0, 100_f64.powi(k))];
        let mut run =
            start(&scene(DVec3::ZERO, ELASTIC, vec![wall(DVec3::ZERO, DVec3::Y * 4.0, DVec3::Z * 4.0)], balls), 1.0);
        assert_eq!(run_to(&mut run, 100.0, u64::MAX), None);
        let state = run.at(100.0);
        println!("100^{k}: {} impacts", run.tallies().impacts);
        assert_eq!((run.tallies().impacts, run.tallies().collapses), (digits, 0), "mass 100^{k}");
        assert!(state.v[1].x >= state.v[0].x.abs(), "something is still to come: {:?}", state.v);
    }
}
