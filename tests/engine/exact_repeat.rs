//! What the event-driven method keeps: bits however it is sliced and watched, the way back, symmetry, what is conserved.

use crate::sums::Sum;
use crate::support::{self, ELASTIC, changed, gas, moved, paper_scene, run_to};
use carom::physics::{Class, Contact, Kind, Method, Progress, Scene, Settings, Simulation, State, Until};
use glam::{DQuat, DVec3};
use proptest::prelude::*;

fn exact(dt: f64) -> Settings {
    Settings { method: Method::Exact, dt, tolerance: 1e-3 }
}

fn open(name: &str) -> Scene {
    carom::scene::open(name).expect("a built-in scene").scene
}

/// The state at `until` (s), in frames of `dt` s, in one piece.
fn whole(scene: &Scene, until: f64, dt: f64) -> State {
    let mut run = Simulation::new(scene, exact(dt));
    assert_eq!(run_to(&mut run, until, u64::MAX), None);
    run.at(until)
}

/// Scenes that fly, rest, slide, stick and crowd, and how long they are run, s.
const SCENES: [(&str, f64); 10] = [
    ("paper-0", 14.0),
    ("paper-1", 16.0),
    ("paper-2", 18.0),
    ("paper-3", 17.0),
    ("paper-4", 9.0),
    ("zeno", 10.0),
    ("corner", 10.0),
    ("newtons-cradle", 20.0),
    ("galton", 3.0),
    ("zigzag", 15.0),
];

#[test]
fn frames_of_any_length_show_the_same_run() {
    for (name, until) in SCENES {
        let scene = open(name);
        let expected = whole(&scene, until, 100.0);
        for dt in [1.0, 0.1, 0.01, 0.003] {
            assert_eq!(whole(&scene, until, dt).hash(), expected.hash(), "{name} in frames of {dt} s");
        }
    }
}

#[test]
fn slices_of_any_size_make_the_same_run() {
    for (name, until) in SCENES {
        let scene = open(name);
        let expected = whole(&scene, until, 0.05);
        for work in [1, 2, 7, 1000] {
            let mut run = Simulation::new(&scene, exact(0.05));
            assert_eq!(run_to(&mut run, until, work), None);
            assert_eq!(run.at(until).hash(), expected.hash(), "{name} in slices of {work}");
        }
    }
}

#[test]
fn looking_recording_and_copying_change_no_bit() {
    for (name, until) in SCENES {
        let scene = open(name);
        let expected = whole(&scene, until, 0.05);
        let mut run = Simulation::new(&scene, exact(0.05));
        let mut frames = 0_u64;
        while run.time() < until {
            run.record_events(frames % 3 == 1);
            run.advance(Until::Frame, 1 + frames % 4);
            for share in [0.9, 0.3, 0.0] {
                let between = run.at(run.time() - share * run.step());
                assert!(between.t <= run.time() && between.energy(run.model()).is_finite());
            }
            run.take_events();
            if frames % 11 == 5 {
                run = run.clone();
            }
            frames += 1;
        }
        assert_eq!(run.at(until).hash(), expected.hash(), "{name}");
    }
}

#[test]
fn a_state_within_a_frame_is_the_state_at_which_a_shorter_frame_ends() {
    for (name, until) in SCENES {
        let scene = open(name);
        let mut coarse = Simulation::new(&scene, exact(0.5));
        let mut fine = Simulation::new(&scene, exact(0.0625));
        while fine.time() < until {
            assert_eq!(fine.advance(Until::Frame, u64::MAX), Progress::Reached);
            assert_eq!(run_to(&mut coarse, fine.time(), u64::MAX), None);
            // Frames of both end at impacts, whose instant shows the state after them.
            assert_eq!(coarse.at(fine.time()), fine.state(), "{name} at {} s", fine.time());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn random_budgets_make_the_same_run(
        k in 0..SCENES.len(),
        budgets in prop::collection::vec(1..40u64, 1..40),
        dt in 0.01..0.5,
    ) {
        let (name, until) = SCENES[k];
        let scene = open(name);
        let mut run = Simulation::new(&scene, exact(dt));
        let mut budgets = budgets.iter().cycle();
        while run.advance(Until::Time(until), *budgets.next().expect("a cycle never ends")) == Progress::Yielded {}
        prop_assert_eq!(run.at(until).hash(), whole(&scene, until, 1.0).hash(), "{}", name);
    }
}

/// A run that goes on where another one is, from plain data alone.
fn again(scene: &Scene, run: &Simulation) -> Simulation {
    Simulation::resumed(&moved(scene, &run.state()), run.settings(), run.time(), &run.transient())
}

#[test]
fn a_run_continues_bit_for_bit_from_where_another_one_was_and_how_it_began() {
    let gas = changed(&gas(100, 8, 1.0), |draft| draft.gravity = support::G);
    for (scene, until) in SCENES.map(|(name, until)| (open(name), until)).into_iter().chain([(gas, 2.0)]) {
        let name = &scene.name;
        let expected = whole(&scene, until, 0.05);
        let mut run = Simulation::new(&scene, exact(0.05));
        for share in [0.0, 0.1, 0.37, 0.6, 0.95] {
            assert_eq!(run_to(&mut run, share * until, u64::MAX), None);
            let mut next = again(&scene, &run);
            assert_eq!((next.state(), next.time()), (run.state(), run.time()), "{name}");
            // Frame by frame in step, events too; then in slices to the end; and a continuation can be continued.
            let mut original = run.clone();
            original.record_events(true);
            next.record_events(true);
            original.take_events();
            next.take_events();
            for _ in 0..3 {
                assert_eq!(original.advance(Until::Frame, u64::MAX), next.advance(Until::Frame, u64::MAX));
                assert_eq!((next.state(), next.step()), (original.state(), original.step()), "{name}");
                assert_eq!(
                    (next.take_events(), next.contacts()),
                    (original.take_events(), original.contacts()),
                    "{name}"
                );
            }
            let mut third = again(&scene, &next);
            for run in [&mut next, &mut third] {
                assert_eq!(run_to(run, until, 1000), None);
                assert_eq!(run.at(until).hash(), expected.hash(), "{name} from {} s", share * until);
            }
        }
    }
}

#[test]
fn swept_runs_continue_bit_for_bit_too_unless_their_tolerance_was_changed() {
    let swept = |tolerance| Settings { method: Method::Swept, dt: 0.05, tolerance };
    let scene = open("paper-3");
    let mut run = Simulation::new(&scene, swept(1e-6));
    assert_eq!(run_to(&mut run, 3.0, u64::MAX), None);
    let mut next = again(&scene, &run);
    for run in [&mut run, &mut next] {
        assert_eq!(run_to(run, 9.0, u64::MAX), None);
    }
    assert_eq!(next.at(9.0).hash(), run.at(9.0).hash());
    run.set_settings(swept(1e-9));
    // Then they begin anew from t, x and v: to rounding the same, no more.
    assert!(run.transient().is_empty());
    let mut next = again(&scene, &run);
    for run in [&mut run, &mut next] {
        assert_eq!(run_to(run, 12.0, u64::MAX), None);
    }
    let error = (run.at(12.0).x[0] - next.at(12.0).x[0]).length();
    // Rounding, 1e-15 m, grows by 2e8 over twenty seconds of this scene at most.
    assert!(error <= 1e-6, "{error:e} m");
}

#[test]
fn a_run_begun_by_the_other_method_continues_from_there() {
    let scene = open("paper-3");
    let mut run = Simulation::new(&scene, support::paper(0.01, 1e-3));
    assert_eq!(run_to(&mut run, 2.0, u64::MAX), None);
    run.set_settings(exact(0.05));
    assert_eq!(run_to(&mut run, 3.0, u64::MAX), None);
    let mut next = again(&scene, &run);
    for run in [&mut run, &mut next] {
        assert_eq!(run_to(run, 9.0, u64::MAX), None);
    }
    assert_eq!(next.at(9.0).hash(), run.at(9.0).hash());
}

/// The scene as it stands, going back the way it came.
fn reversed(scene: &Scene, state: &State) -> Scene {
    let v = state.v.iter().map(|v| -*v).collect();
    moved(scene, &State { v, ..state.clone() })
}

#[test]
fn elastic_runs_go_back_the_way_they_came() {
    // Ten seconds there and ten back. Not paper-1 and paper-3: their first impact is one of two walls at once, which
    // has no unique way back. Rounding, 1e-15 m, grows by 2 at most in paper-2, by nothing in paper-0, but each of the
    // impacts adds its own: a prototype returned to 1e-13 and 1e-12 m.
    for (k, tolerance) in [(0, 1e-12), (2, 1e-11)] {
        let scene = changed(&paper_scene(k), |draft| draft.contact = ELASTIC);
        let there = whole(&scene, 10.0, 0.1);
        // A millisecond short of the start, where some touch a wall: the impact on it may be due or not, by rounding.
        let back = whole(&reversed(&scene, &there), 9.999, 0.1);
        let start = whole(&scene, 0.001, 0.1);
        for i in 0..scene.spheres.len() {
            let error = back.x[i].distance(start.x[i]).max(back.v[i].distance(-start.v[i]));
            assert!(error <= tolerance, "paper-{k}, sphere {i}: returns {error:e} m or m/s off");
        }
        let run = Simulation::new(&scene, exact(1.0));
        let energy = (there.energy(run.model()) / run.initial_energy() - 1.0).abs();
        // Dozens of impacts and parabolas, an ulp or two each.
        assert!(energy <= 1e-14, "paper-{k}: energy off by {energy:e}");
    }
}

#[test]
fn the_mirror_symmetric_scene_stays_so_for_five_seconds() {
    let scene = paper_scene(4);
    let mut run = Simulation::new(&scene, exact(0.01));
    run.record_events(true);
    while run.time() < 7.0 {
        assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
        let x = run.state().x;
        let asymmetry = (x[0].x + x[1].x).abs().max((x[0].y - x[1].y).abs());
        // Demanded; rounding that differs between left and right would have grown by 1.5e5 until 5 s.
        assert!(run.time() > 5.0 || asymmetry <= 1e-10, "{asymmetry:e} m at {} s", run.time());
    }
    let impacts: Vec<f64> = run.take_events().iter().filter(|c| c.class == Class::Collide).map(|c| c.time).collect();
    // Published with the reference: later the two rest in an unstable mirror equilibrium.
    assert_eq!(impacts.iter().filter(|&&t| t <= 5.0).count(), 19);
    assert_eq!(impacts.iter().filter(|&&t| t <= 7.0).count(), 37);
}

/// Runs an elastic scene until so many impacts: relative errors of the energy, and of the momentum less what the walls
/// gave, by Σ m |v|.
fn drifts(scene: &Scene, impacts: u64) -> (f64, f64) {
    let mut run = Simulation::new(scene, exact(0.1));
    run.record_events(true);
    let before = run.state();
    let mut walls = Sum::default();
    let given = |row: &Contact| if row.kind == Kind::Wall { row.normal * row.impulse } else { DVec3::ZERO };
    while run.tallies().impacts < impacts {
        assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
        run.take_events().iter().for_each(|row| walls.add(given(row)));
    }
    let (state, model) = (run.state(), run.model());
    let energy = (state.energy(model) / run.initial_energy() - 1.0).abs();
    let pulled: DVec3 = scene.spheres.iter().map(|s| (scene.gravity * s.mass + s.force) * state.t).sum();
    let scale: f64 = state.v.iter().zip(&model.masses).map(|(v, m)| v.length() * m).sum();
    let left = state.momentum(model) - before.momentum(model) - pulled - walls.value();
    (energy, left.length() / scale)
}

#[test]
fn an_elastic_gas_keeps_energy_and_momentum_over_hundreds_of_thousands_of_impacts() {
    // Demanded. Rounding at random leaves less: √300 000 impacts of an ulp, spread over a thousand spheres, are 1e-16;
    // the sums round more. Ten million: `long`.
    let (energy, momentum) = drifts(&gas(1000, 5, 1.0), 300_000);
    assert!(energy <= 1e-14 && momentum <= 1e-14, "energy off by {energy:e}, momentum by {momentum:e}");
}

#[test]
fn a_gas_in_a_tilted_box_keeps_energy_and_momentum_though_its_normals_are_rounded() {
    let turn = DQuat::from_axis_angle(DVec3::new(2.0, 3.0, 6.0) / 7.0, 1.0);
    let scene = changed(&gas(27, 7, 1.0), |draft| {
        for wall in &mut draft.walls {
            let shape = &mut wall.shape;
            (shape.center, shape.s1, shape.s2) = (turn * shape.center, turn * shape.s1, turn * shape.s2);
        }
        for body in &mut draft.spheres {
            (body.x, body.v) = (turn * body.x, turn * body.v);
        }
    });
    let (energy, momentum) = drifts(&scene, 100_000);
    // A normal's square is off by up to an ulp, and by the same in every impact: 4000 of them a sphere would leave 1e-12.
    // That is taken back but for what is under half an ulp of the change, a tenth of an ulp on average: 1e-13.
    assert!(energy <= 1e-13 && momentum <= 1e-14, "energy off by {energy:e}, momentum by {momentum:e}");
}

#[test]
fn a_mixture_under_gravity_keeps_energy_and_momentum_too() {
    // Fewer than 64 spheres: every pair is looked at; masses over two decades.
    let scene = changed(&gas(60, 6, 1.0), |draft| {
        draft.gravity = support::G;
        for (i, body) in draft.spheres.iter_mut().enumerate() {
            body.mass = [0.1, 1.0, 10.0][i % 3];
        }
    });
    let (energy, momentum) = drifts(&scene, 50_000);
    // Parabolas round, too: a walk of √(50 000 · some) ulp, mostly of the twenty heavy ones. And Σ m g t has grown to a
    // thousand times the momentum by then, so that its own last digit is 1e-13 of it.
    assert!(energy <= 1e-13 && momentum <= 1e-13, "energy off by {energy:e}, momentum by {momentum:e}");
}
