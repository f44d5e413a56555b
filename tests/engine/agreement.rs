//! What each method does in the source paper's scenes, against the reference found by three independent codes.

use crate::support::{ELASTIC, paper, paper_scene, run_to, scene, sphere};
use carom::physics::{Class, Contact, Method, Progress, Settings, Simulation, Stall, StallKind, State, Until};
use glam::DVec3;

/// First impact of each scene, s (reference).
const FIRST_IMPACT: [f64; 5] = [1.355262, 0.225877, 0.050247, 0.666667, 0.8];

/// Energy at 20 s where everything has come to rest by then, J (reference).
const ENERGY: [(usize, f64); 3] = [(0, 4.9), (1, 5.526971042), (3, 9.836084)];

/// 20 s of a scene by `paper` at dt 0.01 s and tolerance 1e-3.
fn twenty_seconds(k: usize) -> (Simulation, Option<Stall>) {
    let mut run = Simulation::new(&paper_scene(k), paper(0.01, 1e-3));
    run.record_events(true);
    let stall = run_to(&mut run, 20.0, 100_000);
    (run, stall)
}

#[test]
fn paper_runs_scenes_0_1_and_3_to_their_end_and_finds_their_rest() {
    for (k, energy) in ENERGY {
        let (run, stall) = twenty_seconds(k);
        assert_eq!(stall, None, "scene {k}");
        // What is left is the height at which each sphere rests, and what still slides: first order in dt, as all of
        // `paper`; 3 % of it at this dt.
        assert!((run.energy() / energy - 1.0).abs() < 0.03, "scene {k}: {} J", run.energy());
        assert!(run.tallies().deepest_degree <= 1.1e-3, "scene {k}: {}", run.tallies().deepest_degree);
    }
}

#[test]
fn paper_loses_impacts_with_the_energy_it_loses_and_finds_them_as_dt_shrinks() {
    // Reference: 22, 56 and 91 impacts. The last and lowest bounces go first.
    let impacts = |k: usize, dt: f64| {
        let mut run = Simulation::new(&paper_scene(k), paper(dt, 1e-3));
        run_to(&mut run, 20.0, u64::MAX);
        run.tallies().impacts
    };
    for (k, reference) in [(0, 22), (1, 56), (3, 91)] {
        let (coarse, fine) = (impacts(k, 0.01), impacts(k, 0.001));
        assert!(coarse < fine && fine < reference, "scene {k}: {coarse}, {fine}");
    }
}

#[test]
fn paper_stalls_in_the_wedges_of_scenes_2_and_4_and_says_what_to_do() {
    // Where prototypes stalled: near 10.3 s and 7.5 s. A frame's length is what separates them.
    for (k, time) in [(2, 10.3), (4, 7.5)] {
        let (mut run, stall) = twenty_seconds(k);
        let stall = stall.expect("a wedge holds no sphere by forces given contact by contact");
        assert!((stall.time - time).abs() < 0.1 && stall.time == run.time(), "scene {k}: {}", stall.time);
        assert_eq!(stall.kind, StallKind::RestingContact);
        assert!(stall.reason.contains("change the method from here"), "{}", stall.reason);
        assert_eq!(run.advance(Until::Frame, 1), Progress::Stalled(stall));
        // It has spent no more than the watchdog's patience on it: a second at 60 frames is far more.
        assert!(run.tallies().frames < 4000, "{} frames", run.tallies().frames);
    }
}

#[test]
fn a_stalled_run_tries_again_with_other_settings() {
    let (mut run, stall) = twenty_seconds(4);
    let stalled = stall.expect("scene 4 stalls").time;
    run.set_settings(paper(0.01, 0.1));
    run_to(&mut run, stalled + 0.05, u64::MAX);
    assert!(run.time() > stalled + 0.05);
}

#[test]
fn the_first_impact_of_each_scene_is_found_to_first_order() {
    for (k, reference) in FIRST_IMPACT.into_iter().enumerate() {
        for dt in [0.01, 0.001, 0.0001] {
            let mut run = Simulation::new(&paper_scene(k), paper(dt, 1e-5));
            run.record_events(true);
            run_to(&mut run, 2.0, u64::MAX);
            let events = run.take_events();
            let first = events.iter().find(|e| e.class == Class::Collide).expect("an impact within 2 s").time;
            // Euler falls dt / 2 too far in time, an overlap of 1.1e-4 r may be overlooked for one more frame, and the
            // reference has six digits.
            assert!((first - reference).abs() <= 1.5 * dt + 1e-6, "scene {k}, dt {dt}: {first} s");
        }
    }
}

#[test]
fn a_state_beyond_the_range_of_numbers_is_reported_and_never_shown() {
    let (x, v) = ([DVec3::ZERO, DVec3::Y * 9.0], [DVec3::X, DVec3::X * 1e307]);
    let slow = scene(DVec3::ZERO, ELASTIC, Vec::new(), x.map(|x| sphere(x, DVec3::X, 0.5)).to_vec());
    let fast = slow.moved(&x, &v).expect("numbers");
    for &method in Method::ALL {
        let mut run = Simulation::new(&fast, Settings { method, ..paper(1.0, 1e-3) });
        let stall = run_to(&mut run, 1e3, u64::MAX).expect("1e307 m/s leave f64 within 18 s");
        assert_eq!((stall.kind, stall.time), (StallKind::NotFinite, run.time()), "{method:?}");
        assert!(stall.reason.starts_with("Sphere 1 "), "{method:?}: {}", stall.reason);
        assert!(run.state().x.iter().all(|x| x.is_finite()), "{method:?}");
    }
}

#[test]
fn an_impact_that_sends_a_sphere_out_of_range_is_reported_with_sphere_time_and_cause() {
    // A sphere at rest is struck by one of 1e12 times its mass, and goes off nearly twice as fast: at 1.6e75 m/s.
    let (x, v) = ([DVec3::ZERO, DVec3::NEG_X * 8e29], [DVec3::ZERO, DVec3::X * 8e74]);
    let mut bodies = x.map(|x| sphere(x, DVec3::ZERO, 0.5e29)).to_vec();
    bodies[1].mass = 1e12;
    let struck = scene(DVec3::ZERO, ELASTIC, Vec::new(), bodies).moved(&x, &v).expect("numbers");
    for method in [Method::Swept, Method::Exact] {
        let mut run = Simulation::new(&struck, Settings { method, ..paper(0.1, 1e-3) });
        let stall = run_to(&mut run, 10.0, u64::MAX).expect("out of range");
        // They touch when 7e29 m of the way are gone.
        let off = stall.time / (7e29 / 8e74) - 1.0;
        assert!(stall.kind == StallKind::NotFinite && off.abs() < 1e-3, "{method:?}: {stall:?}");
        assert!(
            stall.reason.contains("Sphere 0 ") && stall.reason.contains("a contact"),
            "{method:?}: {}",
            stall.reason
        );
    }
}

#[test]
fn a_step_too_small_to_change_the_time_is_reported() {
    let mut body = sphere(DVec3::ZERO, DVec3::X, 0.5);
    body.mass = 2.0;
    let scene = scene(DVec3::ZERO, ELASTIC, Vec::new(), vec![body]);
    let mut run = Simulation::resumed(&scene, paper(1e-9, 1e-3), 1e9, &[DVec3::ZERO]);
    let stall = run_to(&mut run, 2e9, u64::MAX).expect("1e-9 s vanish beside 1e9 s");
    assert_eq!(stall.kind, StallKind::StepTooSmall);
}

/// How long positions of scene `k` mean anything, s: later on scene 4 grows rounding to metres.
const HORIZON: [f64; 5] = [20.0, 20.0, 20.0, 20.0, 5.0];

/// States of scene `k` each 0.1 s up to its horizon, and its impacts.
fn sampled(k: usize, settings: Settings) -> (Vec<State>, Vec<Contact>) {
    let mut run = Simulation::new(&paper_scene(k), settings);
    run.record_events(true);
    let mut states = Vec::new();
    for tenth in 1..=(10.0 * HORIZON[k]) as u32 {
        let t = 0.1 * f64::from(tenth);
        assert_eq!(run_to(&mut run, t, u64::MAX), None, "scene {k}");
        states.push(run.at(t));
    }
    let impact = |row: &Contact| row.class == Class::Collide && row.time <= HORIZON[k];
    (states, run.take_events().into_iter().filter(impact).collect())
}

/// Largest distance between two runs' positions, m.
fn deviation(one: &[State], other: &[State]) -> f64 {
    let pairs = one.iter().zip(other).flat_map(|(a, b)| a.x.iter().zip(&b.x));
    pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

fn exact() -> Settings {
    Settings { method: Method::Exact, ..paper(0.1, 1e-3) }
}

fn swept(dt: f64, tolerance: f64) -> Settings {
    Settings { method: Method::Swept, ..paper(dt, tolerance) }
}

#[test]
fn swept_agrees_with_exact_to_a_nanometre_at_the_finest_tolerance() {
    for (k, horizon) in HORIZON.into_iter().enumerate() {
        let (states, rows) = sampled(k, swept(0.1, 1e-15));
        let (expected, reference) = sampled(k, exact());
        let error = deviation(&states, &expected);
        assert!(error <= 1e-9, "scene {k}: {error:e} m within {horizon} s");
        assert_eq!(rows.len(), reference.len(), "impacts of scene {k}");
    }
}

#[test]
fn the_error_of_swept_is_first_order_in_the_tolerance_over_ten_decades() {
    let (expected, _) = sampled(0, exact());
    let ladder: Vec<(f64, f64)> = (2..=13)
        .map(|decade| 10f64.powi(-decade))
        .map(|tolerance| (tolerance, deviation(&sampled(0, swept(0.1, tolerance)).0, &expected)))
        .collect();
    // The slope of a straight line through log error over log tolerance, by least squares.
    let points: Vec<(f64, f64)> = ladder.iter().map(|(x, y)| (x.log10(), y.log10())).collect();
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let slope = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>()
        / points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum::<f64>();
    // At 1e-2 an impact more or less is second order, at 1e-13 rounding adds a tenth.
    assert!((slope - 1.0).abs() < 0.02, "slope {slope}: {ladder:?}");
    // An impact at half the tolerance's depth is late by tolerance r / 2 v_n and changes the way by as much again; each
    // of 22 bounces at e = 0.8 is slower than the one before.
    for (tolerance, error) in &ladder {
        assert!(error / tolerance > 0.05 && error / tolerance < 20.0, "{ladder:?}");
    }
}

#[test]
fn swept_finds_the_impacts_of_the_reference() {
    // Impacts and the last one's time, found by three independent codes.
    for (k, count, last) in [(0, 22, 12.0973560149), (1, 56, 15.445750111), (2, 163, 17.877133170), (3, 91, 16.9738)] {
        let (_, rows) = sampled(k, swept(0.1, 1e-15));
        assert_eq!(rows.len(), count, "scene {k}");
        let time = rows.last().expect("there are some").time;
        // As many digits as are given; scene 3 has grown rounding by 2e8 by then.
        let digits = if k == 3 { 5e-5 } else { 1e-9 };
        assert!((time - last).abs() < digits, "scene {k}: last impact at {time} s");
    }
}
