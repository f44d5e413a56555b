//! Small scenes on which a method was once wrong, kept as files in `tests/cases`, each with what is right and why.

use crate::support;
use carom::geometry::Parallelogram;
use carom::physics::{Class, Method, Scene, Settings, Simulation, State};
use glam::{DVec3, dvec3};

/// Both methods that find contact times without a step; the tolerance of `swept` is as fine as rounding lets it be.
const TIMED: [Settings; 2] = [
    Settings { method: Method::Exact, dt: 0.01, tolerance: 1e-3 },
    Settings { method: Method::Swept, dt: 0.01, tolerance: 1e-12 },
];

fn case(name: &str) -> Scene {
    let path = format!("{}/tests/cases/{name}.ron", env!("CARGO_MANIFEST_DIR"));
    carom::scene::open(&path).expect("a valid scene").scene
}

/// Distance of a point from a wall, m: by the four edges as segments, and the plane where the foot is inside them.
fn distance(wall: &Parallelogram, p: DVec3) -> f64 {
    let corners = wall.corners();
    let normal = wall.s1.cross(wall.s2).normalize();
    let sides = || (0..4).map(|k| (corners[k], corners[(k + 1) % 4]));
    let turn = |(a, b): (DVec3, DVec3)| (b - a).cross(p - a).dot(normal);
    if sides().all(|side| turn(side) >= 0.0) || sides().all(|side| turn(side) <= 0.0) {
        return (p - wall.center).dot(normal).abs();
    }
    let segment = |(a, b): (DVec3, DVec3)| {
        let share = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        p.distance(a + (b - a) * share)
    };
    sides().map(segment).fold(f64::INFINITY, f64::min)
}

/// Runs a case, asking at every hundredth of its duration that no sphere is deeper in a wall or another than `bound`
/// radii; the run, and its last state.
fn run(scene: &Scene, settings: Settings, bound: f64) -> (Simulation, State) {
    let mut run = Simulation::new(scene, settings);
    run.record_events(true);
    for k in 1..=100 {
        let t = scene.duration * f64::from(k) / 100.0;
        let stall = support::run_to(&mut run, t, 100_000);
        assert_eq!(stall, None, "{:?}", settings.method);
        let state = run.at(t);
        let deep = deepest(scene, &state);
        assert!(deep <= bound, "{:?}: {deep:e} radii deep at {t} s, {:?}", settings.method, state.x);
    }
    let state = run.at(scene.duration);
    (run, state)
}

/// Deepest overlap of a state, in radii.
fn deepest(scene: &Scene, state: &State) -> f64 {
    let mut deepest = 0.0_f64;
    for (i, one) in scene.spheres.iter().enumerate() {
        for wall in &scene.walls {
            deepest = deepest.max(1.0 - distance(&wall.shape, state.x[i]) / one.radius);
        }
        for (j, other) in scene.spheres.iter().enumerate().skip(i + 1) {
            deepest = deepest.max(1.0 - state.x[i].distance(state.x[j]) / (one.radius + other.radius));
        }
    }
    deepest
}

fn impacts(run: &mut Simulation) -> usize {
    run.take_events().iter().filter(|event| event.class == Class::Collide).count()
}

/// Time that a ball of radius `r` (m) takes to roll over an edge from the angle `from` (rad, from the vertical) to the
/// angle `to`, beginning at `speed` (m/s): ∫ r dθ / v with v² = speed² + 2 g r (cos from − cos θ), by Simpson's rule.
fn rolling_time(r: f64, speed: f64, from: f64, to: f64) -> f64 {
    let slowness = |angle: f64| r / (speed * speed + 2.0 * 9.8 * r * (from.cos() - angle.cos())).sqrt();
    let (n, h) = (4000, (to - from) / 4000.0);
    let weight = |k: u32| if k == 0 || k == n { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
    (0..=n).map(|k| weight(k) * slowness(from + f64::from(k) * h)).sum::<f64>() * h / 3.0
}

#[test]
fn a_ball_rolls_over_a_ridge_on_to_the_slope_beyond_it() {
    // A second on the plateau, then over the edge until the normal is the slope's (v² = 2.21 m²/s² stays below
    // g r cos θ = 3.92), then down the slope at 0.6 g.
    let scene = case("ridge-down");
    let (along, out) = (dvec3(0.8, -0.6, 0.0), dvec3(0.6, 0.8, 0.0));
    let arc = rolling_time(0.5, 0.5, 0.0, 0.6_f64.asin());
    let (speed, left) = (2.21_f64.sqrt(), 1.0 - arc);
    let expected = out * 0.5 + along * (speed * left + 0.5 * 0.6 * 9.8 * left * left);
    for settings in TIMED {
        let (mut run, state) = run(&scene, settings, 1e-9);
        // Simpson's rule over 4000 steps is below rounding; the rolling is integrated to 1e-12.
        assert!((state.x[0] - expected).length() < 1e-11, "{:?}: {}, not {expected}", settings.method, state.x[0]);
        assert!((run.energy() / 5.025 - 1.0).abs() < 1e-12, "{} J", run.energy());
        assert_eq!(impacts(&mut run), 0);
    }
}

#[test]
fn a_ball_rolls_up_a_slope_and_over_its_edge_on_to_the_plateau() {
    // 1 m up the slope against 0.28 g from 3 m/s, over the edge from −16.26° to the vertical, then straight on.
    let scene = case("ridge-up");
    let (edge, top): (f64, f64) = (9.0 - 2.0 * 9.8 * 0.28, 9.0 - 2.0 * 9.8 * 0.3);
    let slope = (3.0 - edge.sqrt()) / (9.8 * 0.28);
    let arc = rolling_time(0.5, edge.sqrt(), -0.28_f64.asin(), 0.0);
    let expected = dvec3(top.sqrt() * (2.0 - slope - arc), 0.5, 0.0);
    for settings in TIMED {
        let (mut run, state) = run(&scene, settings, 1e-9);
        // As above.
        assert!((state.x[0] - expected).length() < 1e-11, "{:?}: {}, not {expected}", settings.method, state.x[0]);
        assert_eq!(impacts(&mut run), 0);
    }
}

#[test]
fn a_ball_that_comes_up_a_ramp_stays_on_its_plateau() {
    for settings in TIMED {
        let (run, state) = run(&case("ramp"), settings, 1e-9);
        assert!((state.x[0].y - 0.3).abs() < 1e-12, "{:?}: {}", settings.method, state.x[0]);
        // It rests 5 ms after the start with a loss of ½ m v_n² and loses nothing after that.
        let began = 0.5 * (1.45 * 1.45 + 0.145 * 0.145) + 9.8 * 0.1986;
        assert!(run.energy() < began && run.energy() > began - 2e-3, "{} of {began} J", run.energy());
    }
}

#[test]
fn cracks_of_a_nanometre_hold_and_drop_nothing() {
    for (name, v, x) in [
        ("seam-gap", dvec3(0.7, 0.0, 0.0), dvec3(-1.0, 0.5, 0.0)),
        ("seam-gap-diagonal", dvec3(2.3, 0.0, 2.3), dvec3(-15.0, 0.5, -15.0)),
    ] {
        let scene = case(name);
        for settings in TIMED {
            let (mut run, state) = run(&scene, settings, 1e-12);
            // The crack's far edge takes (v · 1e-9)² of the energy.
            let expected = x + v * scene.duration;
            assert!((state.x[0] - expected).length() < 1e-12, "{name}, {:?}: {}", settings.method, state.x[0]);
            assert_eq!(impacts(&mut run), 0, "{name}, {:?}", settings.method);
        }
    }
}

#[test]
fn an_almost_flat_valley_is_crossed_in_a_few_events() {
    let scene = case("valley");
    for settings in TIMED {
        let (mut run, state) = run(&scene, settings, 1e-12);
        assert!(run.take_events().len() < 30, "{:?}", run.tallies());
        // It bends by 2e-10 rad, which takes 1e-3 · 2e-10 m/s across.
        assert!((state.x[0].x - (-0.0012 + 0.001 * 3.0)).abs() < 1e-8, "{}", state.x[0]);
    }
}

#[test]
fn a_ball_comes_to_rest_on_redundant_supports() {
    for name in ["funnel-rest", "funnel-rest-2", "funnel-rest-3", "three-support", "many-support", "overlap-funnel"] {
        for settings in TIMED {
            // Tilted walls leave rounding of the coordinates, 10 m against radii of 0.2 m.
            run(&case(name), settings, 1e-12);
        }
    }
}

#[test]
fn a_ball_in_a_pit_of_four_slopes_lies_still() {
    let scene = support::changed(&case("pit"), |draft| draft.duration = 100.0);
    for settings in TIMED {
        let (mut run, state) = run(&scene, settings, 1e-12);
        assert_eq!(state.v[0], DVec3::ZERO, "{:?}", settings.method);
        assert!(support::run_to(&mut run, 1000.0, 100_000).is_none());
        assert_eq!(run.at(1000.0).x, state.x, "{:?}", settings.method);
    }
}

#[test]
fn what_just_fits_between_two_walls_slides_along_them() {
    for name in ["tube-tight", "tube-tight-2"] {
        let scene = case(name);
        let v = scene.spheres[0].v * dvec3(0.0, 1.0, 1.0);
        for settings in TIMED {
            let (mut run, state) = run(&scene, settings, 1e-12);
            let expected = scene.spheres[0].x + v * scene.duration;
            assert!((state.x[0] - expected).length() < 1e-12, "{name}, {:?}: {}", settings.method, state.x[0]);
            assert_eq!(impacts(&mut run), 0, "{name}, {:?}", settings.method);
        }
    }
}

#[test]
fn a_row_that_just_fits_across_two_walls_swings_through_its_line_without_sinking_in() {
    // the walls are 6e-8 m closer than the row is long: within 0.1 ms of the line the accelerations leap, between one look of
    // an arc and the next
    let scene = case("fit-line");
    for settings in TIMED {
        run(&scene, settings, 1e-12);
    }
}

#[test]
fn a_row_that_just_fits_falls_out_from_between_two_walls_as_if_they_were_not_there() {
    let scene = case("fit-fall");
    for settings in TIMED {
        let (mut run, state) = run(&scene, settings, 1e-12);
        for ((x, v), sphere) in state.x.iter().zip(&state.v).zip(&scene.spheres) {
            // the walls' lower edges pass by at 14 m/s: an ulp of that for 1.6 s
            let expected = sphere.x - DVec3::Y * (0.5 * 9.8 * scene.duration * scene.duration);
            assert!(x.distance(expected) < 1e-12, "{:?}: {x} instead of {expected}", settings.method);
            assert!(v.distance(DVec3::NEG_Y * (9.8 * scene.duration)) < 1e-12, "{:?}: {v}", settings.method);
        }
        assert_eq!(impacts(&mut run), 0, "{:?}", settings.method);
    }
}

#[test]
fn a_sphere_slides_over_a_seam_however_late_the_clock() {
    // 1 m/s over a seam of 0.2 m between two elastic walls: after 2000 s an ulp of the clock is 16 of the coordinates
    let scene = case("late-seams");
    for settings in TIMED {
        let mut run = Simulation::new(&scene, settings);
        assert_eq!(support::run_to(&mut run, scene.duration, 100_000), None, "{:?}", settings.method);
        let state = run.at(scene.duration);
        // 0.18 m from wall to wall; each of the 11 111 bounces is off by an ulp of the clock at most
        let way = 0.09 + scene.spheres[0].x.x + scene.duration;
        let (bounces, rest) = ((way / 0.18).floor(), way % 0.18);
        let x = if bounces % 2.0 == 0.0 { rest - 0.09 } else { 0.09 - rest };
        assert!((state.x[0].x - x).abs() < 1e-8, "{:?}: {} instead of {x}", settings.method, state.x[0].x);
        assert_eq!(state.x[0].y, 0.01, "{:?}", settings.method);
        assert_eq!(run.tallies().impacts, bounces as u64, "{:?}", settings.method);
    }
}

#[test]
fn a_few_spheres_for_ten_seconds_are_little_work() {
    for name in ["slow-wedge", "slow-corner-start", "slow-row"] {
        let scene = case(name);
        let mut run = Simulation::new(&scene, TIMED[0]);
        assert_eq!(support::run_to(&mut run, scene.duration, 1000), None);
        // A million impacts are a second or two.
        assert!(run.tallies().impacts < 1_000_000, "{name}: {:?}", run.tallies());
    }
}
