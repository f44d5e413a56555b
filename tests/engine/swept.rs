//! What `swept` promises: nothing tunnels, nothing goes deeper than the tolerance, dt leaves no trace, nothing stalls.

use crate::random::Random;
use crate::support::{ELASTIC, G, PAPER_LAW, gas, paper, paper_scene, room, run_to, scene, sphere, wall};
use carom::physics::{Class, Contact, Method, Progress, Scene, Settings, Simulation, Until};
use carom::scene::ContactLaw;
use glam::{DVec3, dvec3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn swept(dt: f64, tolerance: f64) -> Settings {
    Settings { method: Method::Swept, dt, tolerance }
}

fn open(name: &str) -> Scene {
    carom::scene::open(name).expect("a built-in scene").scene
}

/// The hash of the state at `until` (s).
fn hash(scene: &Scene, settings: Settings, until: f64) -> u64 {
    let mut run = Simulation::new(scene, settings);
    assert_eq!(run_to(&mut run, until, u64::MAX), None);
    run.at(until).hash()
}

/// The impacts until `until` (s).
fn impacts(scene: &Scene, settings: Settings, until: f64) -> Vec<Contact> {
    let mut run = Simulation::new(scene, settings);
    run.record_events(true);
    assert_eq!(run_to(&mut run, until, u64::MAX), None);
    run.take_events().into_iter().filter(|row| row.class == Class::Collide && row.time <= until).collect()
}

#[test]
fn dt_leaves_no_trace_in_the_trajectory() {
    for (name, until) in [("paper-1", 16.0), ("paper-3", 17.0), ("corner", 10.0), ("galton", 3.0), ("stack", 0.3)] {
        for tolerance in [0.0, 1e-6, 1e-2] {
            let scene = open(name);
            let expected = hash(&scene, swept(10.0, tolerance), until);
            for dt in [1.0, 0.1, 0.01, 1e-3] {
                assert_eq!(
                    hash(&scene, swept(dt, tolerance), until),
                    expected,
                    "{name}, {tolerance}, frames of {dt} s"
                );
            }
        }
    }
    let expected = hash(&open("paper-1"), swept(1.0, 1e-9), 2.0);
    assert_eq!(hash(&open("paper-1"), swept(1e-5, 1e-9), 2.0), expected);
}

#[test]
fn no_shipped_scene_stalls_at_any_tolerance() {
    // inelastic-666, the crowd that `moreau` is for, is too slow to settle here: see the next test.
    let names = carom::scene::builtin::ALL.iter().map(|scene| scene.name);
    for name in names.filter(|&name| name != "inelastic-666" && name != "stack") {
        let scene = open(name);
        for tolerance in [0.0, 1e-17, 1e-12, 1e-6, 1e-3, 0.1, 1.0] {
            let mut run = Simulation::new(&scene, swept(0.1, tolerance));
            assert_eq!(run_to(&mut run, scene.duration.min(5.0), u64::MAX), None, "{name}, tolerance {tolerance}");
            assert!(run.state().x.iter().all(|x| x.is_finite()));
        }
    }
}

#[test]
fn crowds_go_on_settling_at_any_tolerance() {
    for (name, until) in [("stack", 0.5), ("inelastic-666", 0.1)] {
        let scene = open(name);
        for tolerance in [0.0, 1e-15, 1e-6, 1e-2] {
            let mut run = Simulation::new(&scene, swept(0.1, tolerance));
            assert_eq!(run_to(&mut run, until, u64::MAX), None, "{name}, tolerance {tolerance}");
        }
    }
}

#[test]
fn impacts_happen_at_degrees_within_the_tolerance() {
    for k in 0..5 {
        for tolerance in [0.5, 1e-2, 1e-4, 1e-8, 1e-12] {
            let rows = impacts(&paper_scene(k), swept(0.1, tolerance), 8.0);
            assert!(rows.len() > 2, "scene {k}");
            // The degree is a difference of coordinates of 10 m, r = 0.5 m: rounding of 1e-14. What overlaps already when
            // it is driven together again is taken as it is, so that 0 is allowed, and deeper than accepted is not.
            let fine = |row: &Contact| row.degree >= -1e-14 && row.degree <= tolerance + 1e-14;
            let first = |row: &&Contact| row.time > 0.0;
            assert!(rows.iter().filter(first).all(fine), "scene {k}, tolerance {tolerance}: {rows:?}");
        }
    }
}

#[test]
fn nothing_tunnels_at_any_speed() {
    // A plate of no thickness, met head on from random distances and offsets.
    let random = &mut Random::new(1);
    for speed in [1e2, 1e4, 1e6, 1e8] {
        for _ in 0..50 {
            let plate = wall(DVec3::ZERO, dvec3(0.0, 4.0, 0.0), dvec3(0.0, 0.0, 4.0));
            let start = dvec3(-speed * random.between(0.1, 1.0), random.between(-1.9, 1.9), random.between(-1.9, 1.9));
            let scene = scene(DVec3::ZERO, ELASTIC, vec![plate], vec![sphere(start, DVec3::X * speed, 0.5)]);
            let mut run = Simulation::new(&scene, swept(10.0, 1e-3));
            assert_eq!(run_to(&mut run, 10.0, u64::MAX), None);
            assert_eq!((run.tallies().impacts, run.state().v[0]), (1, DVec3::NEG_X * speed), "from {start}");
        }
    }
}

#[test]
fn fast_spheres_meet_edges_corners_and_each_other() {
    // Just inside and just outside of what they can reach, at 1e4 m/s: a step of 1e-3 s is 10 m.
    let plate = || vec![wall(DVec3::ZERO, dvec3(0.0, 4.0, 0.0), dvec3(0.0, 0.0, 4.0))];
    let at = |y: f64, z: f64| sphere(dvec3(-5e3, y, z), DVec3::X * 1e4, 0.5);
    let corner = 2.0 + 0.5 * 0.5_f64.sqrt();
    for (x, hits) in [
        (at(2.499, 0.0), 1),
        (at(2.501, 0.0), 0),
        (at(corner - 1e-3, corner - 1e-3), 1),
        (at(corner + 1e-3, corner + 1e-3), 0),
    ] {
        let mut run = Simulation::new(&scene(DVec3::ZERO, ELASTIC, plate(), vec![x.clone()]), swept(1e-3, 1e-6));
        assert_eq!(run_to(&mut run, 1.0, u64::MAX), None);
        assert_eq!(run.tallies().impacts, hits, "{}", x.x);
    }
    for (offset, hits) in [(0.999, 1), (1.001, 0)] {
        let spheres = vec![at(0.0, 0.0), sphere(dvec3(0.0, offset, 0.0), DVec3::ZERO, 0.5)];
        let mut run = Simulation::new(&scene(DVec3::ZERO, ELASTIC, vec![], spheres), swept(1e-3, 1e-6));
        assert_eq!(run_to(&mut run, 1.0, u64::MAX), None);
        assert_eq!(run.tallies().impacts, hits, "offset {offset}");
    }
}

#[test]
fn an_overlap_that_opens_is_no_impact_until_it_closes_again() {
    // A ball bounces on the floor by `paper`, which leaves it 1e-2 r deep; `swept` takes over on its way up.
    let law = ContactLaw { rest_speed: 0.0, ..ELASTIC };
    let floor = vec![wall(DVec3::ZERO, dvec3(10.0, 0.0, 0.0), dvec3(0.0, 0.0, -10.0))];
    let mut run =
        Simulation::new(&scene(G, law, floor, vec![sphere(DVec3::Y * 1.5, DVec3::ZERO, 0.5)]), paper(1e-3, 1e-2));
    while run.tallies().impacts == 0 {
        run.advance(Until::Frame, u64::MAX);
    }
    run.set_settings(swept(0.1, 1e-12));
    let state = run.state();
    let (height, speed) = (state.x[0].y, state.v[0].y);
    assert!(height < 0.5 && speed > 0.0, "it overlaps and goes up: {height} m, {speed} m/s");
    // Back at the floor after the parabola from where it was: y = r.
    let back = (speed + (speed * speed - 19.6 * (0.5 - height)).sqrt()) / 9.8;
    run.record_events(true);
    run_to(&mut run, state.t + back + 1e-9, u64::MAX);
    let rows = run.take_events();
    // Late by tolerance r / 2 v_n at most, 1e-13 s, and as much for rounding.
    assert!(rows.len() == 1 && (rows[0].time - state.t - back).abs() < 2e-13, "{rows:?} instead of {back}");
}

#[test]
fn a_sphere_that_cannot_leave_its_overlap_rests_where_it_is() {
    // 2e-3 r deep in the floor and rising at a speed that ends before it is out.
    let floor = vec![wall(DVec3::ZERO, dvec3(10.0, 0.0, 0.0), dvec3(0.0, 0.0, -10.0))];
    let lying = scene(G, PAPER_LAW, floor, vec![sphere(DVec3::Y * 0.5, DVec3::ZERO, 0.5)]);
    let deep = lying.moved(&[DVec3::Y * 0.499], &[DVec3::Y * 0.05]).expect("numbers");
    let mut run = Simulation::new(&deep, swept(0.1, 1e-9));
    assert_eq!(run_to(&mut run, 1.0, u64::MAX), None);
    let top = 0.499 + 0.05 * 0.05 / 19.6;
    // Closed form of the apex; a few ulp of 0.5 m.
    assert!((run.state().x[0].y - top).abs() < 1e-15 && run.state().v[0] == DVec3::ZERO, "{:?}", run.state());
    assert_eq!((run.tallies().impacts, run.tallies().rests), (0, 1));
}

#[test]
fn the_probes_of_a_frame_lead_to_the_contact_that_ends_it() {
    let mut run = Simulation::new(&paper_scene(0), swept(1.0, 1e-9));
    let (mut seen, mut before) = (0, run.tallies().impacts);
    while run.time() < 5.0 {
        assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
        if run.tallies().impacts > before && run.time() > 0.0 {
            let last = run.probes().last().expect("the search left its probes");
            // The frame's length and the probe's are differences of the same clock times.
            assert!((last.step - run.step()).abs() < 1e-12, "{last:?}, frame of {} s", run.step());
            assert!(last.degree > 0.0 && last.degree <= 1e-9 + 1e-15, "{last:?}");
            seen += 1;
        }
        before = run.tallies().impacts;
    }
    assert!(seen >= 2, "{seen} frames ended by an impact");
    assert!(run.tallies().probes > 0 && run.tallies().evaluations > run.tallies().probes);
}

#[test]
fn an_elastic_gas_keeps_its_energy_and_never_goes_deeper_than_the_tolerance() {
    let scene = gas(1000, 5, 1.0);
    let mut run = Simulation::new(&scene, swept(0.01, 1e-6));
    assert_eq!(run_to(&mut run, 1.0, u64::MAX), None);
    let tallies = run.tallies();
    assert!(tallies.impacts > 500, "{tallies:?}");
    assert!(tallies.deepest_degree <= 1e-6 + 1e-14, "{tallies:?}");
    // Each impact rounds the squares of two speeds.
    assert!((run.energy() / run.initial_energy() - 1.0).abs() < 1e-13, "{} J", run.energy());
}

#[test]
fn a_tolerance_set_in_mid_run_holds_from_then_on() {
    let scene =
        scene(G, ELASTIC, room(DVec3::splat(-5.0), DVec3::splat(5.0)), vec![sphere(DVec3::ZERO, DVec3::X, 0.5)]);
    let mut run = Simulation::new(&scene, swept(0.1, 0.1));
    run_to(&mut run, 3.0, u64::MAX);
    run.record_events(true);
    run.set_settings(swept(0.1, 1e-10));
    run_to(&mut run, 10.0, u64::MAX);
    let rows = run.take_events();
    assert!(rows.len() == 4 && rows.iter().all(|row| row.degree <= 1e-10 + 1e-14), "{rows:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(8), failure_persistence: None, ..ProptestConfig::with_cases(32) })]

    #[test]
    fn slices_of_any_size_make_the_same_run(k in 0..5usize, budgets in prop::collection::vec(1..40u64, 1..40), dt in 0.01..0.5) {
        let mut run = Simulation::new(&paper_scene(k), swept(dt, 1e-6));
        let mut budgets = budgets.iter().cycle();
        while run.advance(Until::Time(5.0), *budgets.next().expect("a cycle never ends")) == Progress::Yielded {}
        prop_assert_eq!(run.at(5.0).hash(), hash(&paper_scene(k), swept(1.0, 1e-6), 5.0));
    }
}
