//! Bits, not "almost": the same run whatever way it is sliced, watched, copied or continued.

mod support;

use carom::measure::verify::{Depth, GOLDEN, Golden, Runner};
use carom::physics::{Method, Progress, Settings, Simulation, State, Until};
use proptest::{prelude::*, test_runner::RngSeed};
use support::{gas, moved, paper, paper_scene, run_to};

/// How far the scenes are run, s: past the first rests, and in scenes 2 and 4 short of their stalls.
const UNTIL: [f64; 5] = [12.0, 8.0, 10.0, 8.0, 7.4];

fn start(k: usize) -> Simulation {
    Simulation::new(&paper_scene(k), paper(0.01, 1e-3))
}

/// The run in one piece.
fn whole(k: usize) -> State {
    let mut run = start(k);
    assert_eq!(run_to(&mut run, UNTIL[k], u64::MAX), None);
    run.state()
}

#[test]
fn a_run_stops_where_it_is_told_to_and_goes_on_from_there() {
    for (k, until) in UNTIL.into_iter().enumerate() {
        let (mut run, mut slices) = (start(k), 0);
        let stopped = run.run_to(until, |_| {
            slices += 1;
            (slices <= 5).then_some(10)
        });
        assert_eq!((stopped, slices), (Progress::Yielded, 6), "scene {k}");
        assert!(run.time() < until, "scene {k} is at {} s", run.time());
        assert_eq!(run.run_to(until, |_| Some(1000)), Progress::Reached);
        assert_eq!(run.state().hash(), whole(k).hash(), "scene {k}");
    }
}

#[test]
fn slices_of_any_size_make_the_same_run() {
    for (k, until) in UNTIL.into_iter().enumerate() {
        let expected = whole(k);
        for work in [1, 2, 7, 100, 12_345] {
            let mut run = start(k);
            assert_eq!(run_to(&mut run, until, work), None);
            assert_eq!(run.state().hash(), expected.hash(), "scene {k}, slices of {work}");
        }
    }
}

#[test]
fn frame_by_frame_is_the_same_run() {
    for (k, until) in UNTIL.into_iter().enumerate() {
        let mut run = start(k);
        while run.time() < until {
            assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
        }
        assert_eq!(run.state().hash(), whole(k).hash(), "scene {k}");
    }
}

#[test]
fn watching_a_run_does_not_change_it() {
    for (k, until) in UNTIL.into_iter().enumerate() {
        let mut run = start(k);
        run.record_events(true);
        let mut events = run.take_events().len();
        while run.time() < until {
            run.advance(Until::Frame, 3);
            let between = run.at(run.time() - 0.3 * run.step());
            assert!(between.t <= run.time() && run.energy().is_finite());
            run.record_events(events % 3 != 1);
            events += run.take_events().len();
        }
        assert!(events > 0);
        assert_eq!(run.state().hash(), whole(k).hash(), "scene {k}");
    }
}

#[test]
fn a_copy_goes_on_as_its_original() {
    for (k, until) in UNTIL.into_iter().enumerate() {
        let mut run = start(k);
        // A budget that ends within a frame's search somewhere.
        run.advance(Until::Time(until), 3001);
        let mut copy = run.clone();
        run_to(&mut run, until, u64::MAX);
        run_to(&mut copy, until, 17);
        assert_eq!((run.state(), run.tallies()), (copy.state(), copy.tallies()), "scene {k}");
        assert_eq!(run.state().hash(), whole(k).hash(), "scene {k}");
    }
}

#[test]
fn a_run_continues_from_time_positions_velocities_and_pending_impulses_alone() {
    for (k, until) in UNTIL.into_iter().enumerate() {
        let scene = paper_scene(k);
        let mut run = start(k);
        for stop in [0.0, 0.23, 1.36, 3.0, 5.0, 7.0] {
            run_to(&mut run, stop, u64::MAX);
            let mut again =
                Simulation::resumed(&moved(&scene, &run.state()), run.settings(), run.time(), &run.transient());
            assert_eq!(again.state(), run.state());
            run_to(&mut again, until, u64::MAX);
            assert_eq!(again.state().hash(), whole(k).hash(), "scene {k} from {stop} s");
        }
    }
}

#[test]
fn a_frame_given_up_for_other_settings_leaves_no_trace() {
    for k in 0..5 {
        let mut run = start(k);
        run_to(&mut run, 1.0, u64::MAX);
        // One unit of work at a time, until one leaves a frame in progress.
        let mut reference = run.clone();
        while run.advance(Until::Frame, 1) != Progress::Yielded {
            reference = run.clone();
        }
        for run in [&mut reference, &mut run] {
            run.set_settings(paper(0.003, 1e-5));
            run_to(run, 3.0, u64::MAX);
        }
        assert_eq!(run.state().hash(), reference.state().hash(), "scene {k}");
    }
}

#[test]
fn the_state_within_a_frame_leads_from_its_start_to_its_end() {
    let mut run = start(3);
    while run.time() < 3.0 {
        let before = run.state();
        run.advance(Until::Frame, u64::MAX);
        let (after, middle) = (run.state(), run.at(before.t + 0.5 * run.step()));
        assert_eq!(run.at(before.t), before);
        assert_eq!(run.at(after.t), after);
        for i in 0..2 {
            // The centre of a chord, but for the way the frame's own acceleration bends it: 10 g h² / 8 at most.
            let bend = (middle.x[i] - 0.5 * (before.x[i] + after.x[i])).length();
            let h = run.step();
            assert!(bend <= 13.0 * h * h || run.tallies().impacts > 0, "{bend} m in {h} s");
        }
    }
}

#[test]
fn thousands_of_spheres_are_sliced_within_a_trial_step_too() {
    let scene = gas(9000, 3, 1.0);
    let mut whole = Simulation::new(&scene, paper(0.002, 1e-3));
    assert_eq!(run_to(&mut whole, 0.004, u64::MAX), None);
    let mut sliced = Simulation::new(&scene, paper(0.002, 1e-3));
    let mut slices = 0;
    while sliced.time() < 0.004 {
        assert!(!matches!(sliced.advance(Until::Time(0.004), 1), Progress::Stalled(_)));
        slices += 1;
    }
    let trials = whole.tallies().frames + whole.tallies().probes;
    assert!(slices > 5 * trials, "{slices} slices of {trials} trial steps");
    assert_eq!(sliced.state().hash(), whole.state().hash());
    assert_eq!(sliced.tallies(), whole.tallies());
}

#[test]
fn every_build_makes_these_bits() {
    let runner = Runner::new(Depth::Quick, &|| true);
    let found = GOLDEN.iter().map(|run| Golden { hash: run.found(&runner).expect("a run that ends"), ..*run });
    let found: Vec<Golden> = found.collect();
    let line = |run: &Golden| {
        let Golden { scene, until, method, hash } = run;
        format!("    golden({scene:?}, {until:?}, Method::{method:?}, {hash:#018x}),")
    };
    let list: Vec<String> = found.iter().map(line).collect();
    assert!(found == GOLDEN, "this build makes\n{}\ninstead of\n{GOLDEN:x?}", list.join("\n"));
}

/// The same by `moreau`, as the scene asks for it or in frames of 0.01 s.
const GOLDEN_CROWDS: [(&str, f64, u64); 4] = [
    ("inelastic-666", 1.0, 0x89a59f55f5d88d3a),
    ("elastic-666", 1.0, 0x8f5ddbf6083990db),
    ("stack", 5.0, 0xb9b6e822f11558ae),
    ("paper-2", 10.0, 0x929658daa952d000),
];

#[test]
fn every_build_makes_these_bits_of_crowds() {
    let end = |(name, until, _): (&'static str, f64, u64)| {
        let scene = carom::scene::open(name).expect("a built-in scene").scene;
        let mut run = Simulation::new(&scene, Settings { method: Method::Moreau, dt: 0.01, ..scene.solver });
        assert_eq!(run_to(&mut run, until, u64::MAX), None, "{name}");
        (name, until, run.at(until).hash())
    };
    let found = GOLDEN_CROWDS.map(end);
    let list: Vec<_> = found.iter().map(|(n, t, hash)| format!("    ({n:?}, {t:?}, {hash:#018x}),")).collect();
    assert!(found == GOLDEN_CROWDS, "this build makes\n{}\ninstead of\n{GOLDEN_CROWDS:x?}", list.join("\n"));
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(6), failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    #[test]
    fn random_budgets_make_the_same_run(k in 0..5usize, budgets in prop::collection::vec(1..5000u64, 1..40)) {
        let mut run = start(k);
        let mut budgets = budgets.iter().cycle();
        while run.advance(Until::Time(3.0), *budgets.next().expect("a cycle never ends")) == Progress::Yielded {}
        let mut reference = start(k);
        run_to(&mut reference, 3.0, u64::MAX);
        prop_assert_eq!(run.state().hash(), reference.state().hash());
        prop_assert_eq!(run.tallies(), reference.tallies());
    }
}
