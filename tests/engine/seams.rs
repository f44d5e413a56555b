//! Next to a seam, where the closest points of two walls nearly coincide, each scene with its closed form.

use crate::support::{G, go, scene, sphere, wall};
use carom::audit::Judge;
use carom::physics::{Kind, Method, Progress, RestReason, Scene, Settings, Simulation, State, Until};
use carom::scene::{ContactLaw, Wall};
use glam::{DVec3, dvec3};

/// Nothing bounces, rubs or rests by being slow.
const DEAD: ContactLaw = ContactLaw { restitution: 0.0, wall_restitution: 0.0, tangential: 1.0, rest_speed: 0.0 };

/// Both event-driven methods; `swept` finds contacts as deep as its tolerance, which is no deeper than rounding here.
const METHODS: [Settings; 2] = [
    Settings { method: Method::Exact, dt: 0.5, tolerance: 1e-3 },
    Settings { method: Method::Swept, dt: 0.5, tolerance: 1e-15 },
];

/// A tile of 2 m by 4 m from x = `from` (m) on.
fn tile(from: f64) -> Wall {
    wall(dvec3(from + 1.0, 0.0, 0.0), DVec3::X * 2.0, DVec3::NEG_Z * 4.0)
}

/// A slope down from x = 0 on, by half a radian.
fn slope() -> Wall {
    wall(dvec3(1.0, -0.5, 0.0), dvec3(2.0, -1.0, 0.0), DVec3::NEG_Z * 4.0)
}

/// The state of a ball of 1 m at time `t` (s) that begins at height `y` (m), `x` (m) beyond the border of the first wall.
fn ball_at(walls: &[Wall], law: ContactLaw, [x, y]: [f64; 2], v: f64, (settings, t): (Settings, f64)) -> State {
    let mut run = Simulation::new(&begin(walls, law, [x, y], v), settings);
    go(&mut run, t);
    run.at(t)
}

fn begin(walls: &[Wall], law: ContactLaw, [x, y]: [f64; 2], v: f64) -> Scene {
    scene(G, law, walls.to_vec(), vec![sphere(dvec3(x, y, 0.0), DVec3::X * v, 1.0)])
}

/// Two tiles in either order, and a tile above a slope in either order.
fn joints() -> [Vec<Wall>; 4] {
    [vec![tile(-2.0), tile(0.0)], vec![tile(0.0), tile(-2.0)], vec![tile(-2.0), slope()], vec![slope(), tile(-2.0)]]
}

#[test]
fn a_ball_at_rest_beside_a_seam_lies_still() {
    for (joint, walls) in joints().iter().enumerate() {
        for x in [-1e-3, -1e-6, -1e-8, -1e-10, -1e-12, 1e-12, 1e-10, 1e-8, 1e-6, 1e-3] {
            // beyond the ridge it would roll down
            if x > 0.0 && joint >= 2 {
                continue;
            }
            for settings in METHODS {
                let end = ball_at(walls, DEAD, [x, 1.0], 0.0, (settings, 10.0));
                assert_eq!((end.x[0].x, end.v[0]), (x, DVec3::ZERO), "joint {joint}, {:?}", settings.method);
            }
        }
    }
}

#[test]
fn a_ball_passes_a_seam_however_slowly_it_rolls() {
    for walls in &joints()[..2] {
        for (x, v) in [(-1e-3, 1e-4), (-1e-5, 1e-6), (-1e-6, 1e-7), (-1e-8, 1e-8), (-1e-9, 1e-9), (-1e-12, 1e-12)] {
            for settings in METHODS {
                let end = ball_at(walls, DEAD, [x, 1.0], v, (settings, -2.0 * x / v));
                // 1e-12 m are asked; the clock's rounding over such times is far below
                assert!((end.x[0].x + x).abs() <= 1e-9 * v, "from {x}, {:?}: {}", settings.method, end.x[0]);
                assert_eq!((end.v[0].x, end.x[0].y), (v, 1.0), "from {x}, {:?}", settings.method);
            }
        }
    }
}

#[test]
fn a_ball_that_lands_beside_a_seam_goes_on_as_on_one_wall() {
    let one = [wall(DVec3::ZERO, DVec3::X * 4.0, DVec3::NEG_Z * 4.0)];
    // it falls by half a metre
    let falls = (1.0 / -G.y).sqrt();
    for (e, tangential) in [(1.0, 1.0), (0.5, 1.0), (0.5, 0.5), (0.0, 1.0), (0.0, 0.5)] {
        let law = ContactLaw { restitution: e, wall_restitution: e, tangential, rest_speed: 0.0 };
        for walls in &joints()[..2] {
            for beyond in [-1e-7, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-7] {
                for v in [-1.0, 0.0, 1e-3, 1.0] {
                    let state =
                        |walls: &[Wall]| ball_at(walls, law, [beyond - v * falls, 1.5], v, (METHODS[0], 1.5)).x[0];
                    // rounding of the time of one impact, times the speeds
                    let apart = state(walls).distance(state(&one));
                    assert!(apart <= 1e-14, "e {e}, {tangential}, {beyond} m beyond at {v} m/s: {apart:e} m");
                }
            }
        }
    }
}

#[test]
fn only_the_face_is_told_to_carry_and_not_the_edge_beside_it() {
    for settings in METHODS {
        let mut run = Simulation::new(&begin(&[tile(-2.0), tile(0.0)], DEAD, [1e-9, 1.0], 0.0), settings);
        go(&mut run, 1.0);
        let reasons = [0, 1].map(|tile| run.rest_reason((Kind::Wall, 0, tile)));
        assert_eq!(reasons, [None, Some(RestReason::Touching)], "{:?}", settings.method);
        let told: Vec<usize> = run.contacts().iter().map(|row| row.b).collect();
        assert_eq!(told, [1], "{:?}", settings.method);
    }
}

#[test]
fn bounces_out_of_an_overlap_that_swept_allows_gain_nothing_at_an_edge() {
    // several frames end while the bounces are summed up: the energy of each is seen
    let settings = Settings { method: Method::Swept, dt: 0.01, tolerance: 1e-3 };
    for walls in [vec![tile(-2.0)], vec![tile(-2.0), slope()], vec![tile(-2.0), tile(0.0)]] {
        for (e, tangential) in [(0.3, 0.99), (0.4, 0.99), (0.5, 0.9), (0.5, 0.5)] {
            let law = ContactLaw { restitution: e, wall_restitution: e, tangential, rest_speed: 0.0 };
            for (v, height) in [(1.0, 1.5e-4), (3.0, 1.5e-4), (1.0, 3e-4), (3.0, 3e-4)] {
                // it comes to the edge after its first impact, while the bounces that follow are summed up
                for k in 1..=10 {
                    let way = v * ((2.0 * height / -G.y).sqrt() + 2e-3 * f64::from(k));
                    let mut run = Simulation::new(&begin(&walls, law, [-way, 1.0 + height], v), settings);
                    let mut judge = Judge::of(&run);
                    run.record_events(true);
                    while run.time() < 0.2 {
                        assert_eq!(run.advance(Until::Frame, 1_000_000), Progress::Reached);
                        let events = run.take_events();
                        judge.frame(&run, &events);
                    }
                    let found = judge.findings().rows().first().map(ToString::to_string);
                    assert_eq!(found, None, "e {e}, {tangential}, {v} m/s, {way} m before the edge");
                }
            }
        }
    }
}

/// An inelastic ball of r = 1 m strikes the edge of a step of h at v, keeps what goes on round the edge, v (1 − h/r), slides
/// up it without loss, and goes on with what the height has left it.
#[test]
fn a_ball_climbs_a_step_however_low_and_stops_before_one_that_is_too_high() {
    for h in [1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6] {
        let step = wall(dvec3(1.0, h, 0.0), DVec3::X * 2.0, DVec3::NEG_Z * 4.0);
        for v in [1e-5, 1e-4, 1e-3, 1e-2, 1.0] {
            let (before, climb) = (f64::sqrt(2.0 * h), 2.0 * -G.y * h);
            let kept = (v * (1.0 - h)).powi(2) - climb;
            // near the top it would be slow
            if kept.abs() < 0.5 * climb {
                continue;
            }
            let t = 0.1 + 5.0 * before / v;
            let state = ball_at(&[tile(-2.0), step.clone()], DEAD, [-0.05 * v - before, 1.0], v, (METHODS[0], t));
            let (x, u) = (state.x[0], state.v[0]);
            if kept > 0.0 {
                assert!((u.x - kept.sqrt()).abs() <= 1e-6 * v, "{h} m at {v} m/s: {u}, not {}", kept.sqrt());
                assert!((x.y - 1.0 - h).abs() <= 1e-12, "{h} m at {v} m/s: {x}");
            } else {
                assert!(x.x <= 0.0 && x.y >= 1.0 - 1e-12, "{h} m at {v} m/s: {x}");
            }
        }
    }
}

#[test]
fn a_ball_beside_a_crack_passes_it_at_its_speed_without_an_impact() {
    // the edge of the next tile is as near as a step of 1e-14 m would be, and the ball seems to approach it
    for (crack, from) in [(1e-12, 2e-7), (1e-10, 2e-7), (1e-10, 3e-7), (1e-8, 5e-7)] {
        for v in [2e-6, 4e-6, 1e-5, 1e-4] {
            let mut run = Simulation::new(&begin(&[tile(-2.0), tile(crack)], DEAD, [-from, 1.0], v), METHODS[0]);
            let end = 4.0 * from / v;
            go(&mut run, end);
            let (state, tallies, name) = (run.at(end), run.tallies(), format!("crack {crack}, {v} m/s from {from} m"));
            // it sinks by c²/8 r into the crack and climbs out of it, far less than coordinates tell: v² keeps to some 2 g c²/r
            let off = 1e-13 * v + G.length() * crack * crack / v;
            let ahead = state.x[0] - dvec3(3.0 * from, 1.0, 0.0);
            assert!(ahead.length() < 1e-15 + off * end, "{name}: {:?}", state.x[0]);
            assert!((state.v[0].x - v).abs() < off, "{name}: {:?}", state.v[0]);
            assert_eq!(tallies.impacts, 0, "{name}");
            assert!(tallies.rests <= 4 && tallies.releases <= 4, "{name}: {tallies:?}");
        }
    }
}

#[test]
fn infinitely_many_bounces_take_all_of_a_slide_along_an_edge_as_on_the_face() {
    // each leaves 0.999 of the slide, and they are over 0.4 ms after the first: at the end of the table the island is curved
    let law = ContactLaw { restitution: 0.3, wall_restitution: 0.3, tangential: 0.999, rest_speed: 0.0 };
    let table = || wall(dvec3(-1.5, 0.0, 0.0), DVec3::X * 3.0, DVec3::NEG_Z * 8.0);
    for x in [-1e-7, 1e-7] {
        for method in [Method::Exact, Method::Swept] {
            let ball = sphere(dvec3(x, 1.001, 0.0), DVec3::Z, 1.0);
            let settings = Settings { method, dt: 0.01, tolerance: 1e-3 };
            let mut run = Simulation::new(&scene(G, law, vec![table()], vec![ball]), settings);
            go(&mut run, 0.1);
            assert!(run.at(0.1).v[0].z.abs() < 1e-12, "{method:?} from {x}: {:?}", run.at(0.1).v[0]);
        }
    }
}

#[test]
fn energy_hidden_in_bounces_that_are_summed_up_is_told_at_any_time_of_a_frame() {
    // the bounces are slower than their mean velocity shows, by 0.4 J of 200
    let law = ContactLaw { restitution: 0.0, wall_restitution: 0.9, tangential: 0.3, rest_speed: 0.05 };
    let floor = wall(DVec3::X * -45.0, DVec3::X * 90.0, DVec3::NEG_Z * 240.0);
    let ball = sphere(dvec3(-0.04, 30.0739, 0.0), dvec3(0.32, 0.0, 1.643), 30.0);
    let begin = scene(dvec3(-5.803, -7.897, 0.0), law, vec![floor], vec![ball]);
    for method in [Method::Exact, Method::Swept] {
        let mut run = Simulation::new(&begin, Settings { method, dt: 0.01, tolerance: 0.009 });
        let (mut least, mut hides) = (run.initial_energy(), false);
        for step in 1..=400 {
            let t = 0.01 * f64::from(step);
            go(&mut run, t);
            let state = run.at(t);
            let hidden = run.hidden_energy_at(&state);
            let energy = state.energy(run.model()) + hidden;
            assert!(
                energy <= least * (1.0 + 1e-9),
                "{method:?} at {t} s: {least} J, then {energy} J, {hidden} J of it hidden"
            );
            (least, hides) = (energy.min(least), hides || hidden != 0.0);
        }
        assert!(hides || method == Method::Exact, "{method:?} hides nothing");
    }
}
