//! `--accuracy`: the same choice however busy the machine, and the error asked for met where `exact` is certified.

use carom::certify::certify_within;
use carom::measure::{Miss, choose};
use carom::physics::{Method, Scene, Simulation};
use carom::scene::{self, builtin};

use crate::ON;

fn open(name: &str) -> Scene {
    scene::open(name).expect("a built-in scene").scene
}

/// Holds a scene's choice for an error (m) against the shadow run, which shares no code with the methods: every sphere at the last
/// time that is certified. What was chosen, or why nothing was.
fn held(name: &str, wanted: f64) -> String {
    let scene = open(name);
    let choice = match choose(&scene, (wanted, scene.duration), Method::ALL, scene.solver, ON) {
        Ok(choice) => choice,
        Err(Miss::Nothing(why)) => return why,
        Err(Miss::Interrupted) => panic!("it is not interrupted"),
    };
    let until = choice.certified;
    let shadow = certify_within(&scene, until, 1_000_000_000, ON).expect("it is not interrupted");
    let mut run = Simulation::new(&scene, choice.settings);
    run.run_to(shadow.until, |_| Some(Simulation::SLICE));
    let state = run.at(shadow.until);
    for (i, x) in state.x.iter().enumerate() {
        let place = shadow.place(i).expect("a place").map(carom::certify::Double::value);
        let off = x.distance(glam::DVec3::from_array(place));
        assert!(off <= wanted, "{name}, {wanted:e} m: sphere {i} is {off:e} m off at {} s, {choice:?}", shadow.until);
    }
    assert!(choice.chosen.error <= wanted && choice.compared >= until, "{name}: {choice:?}");
    choice.sentence()
}

#[allow(clippy::print_stdout)] // read with --nocapture
#[test]
fn an_error_asked_for_is_met_up_to_the_certified_horizon() {
    // CAROM_ACCURACY=all: every shipped scene and decade, some minutes.
    let all = std::env::var("CAROM_ACCURACY").is_ok_and(|word| word == "all");
    let few = ["paper-0", "paper-3", "zeno", "corner"];
    let names = builtin::ALL.iter().map(|scene| scene.name).filter(|name| all || few.contains(name));
    let wanted = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
    for name in names {
        for wanted in wanted.into_iter().step_by(if all { 1 } else { 3 }) {
            let sentence = held(name, wanted);
            println!("{name}, {wanted:e} m: {sentence}");
            assert!(!few.contains(&name) || sentence.starts_with("chose "), "{name}, {wanted:e} m: {sentence}");
        }
    }
}

#[test]
fn a_busy_machine_chooses_as_an_idle_one() {
    // Slices of work follow the clock; here each look costs as much as a machine that others use, now more, now less.
    let turn = std::sync::atomic::AtomicU64::new(0);
    let busy = || {
        let turn = turn.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        let idle: u64 = (0..turn * 7919 % 3_000).fold(turn, |sum, k| std::hint::black_box(sum ^ k));
        std::hint::black_box(idle) != u64::MAX
    };
    for (name, wanted) in [("paper-1", 1e-2), ("paper-3", 1e-7), ("bouncing-49", 1e-3)] {
        let scene = open(name);
        let [quiet, loud] = [ON, &busy].map(|go_on: &(dyn Fn() -> bool + Sync)| {
            choose(&scene, (wanted, 5.0), Method::ALL, scene.solver, go_on).expect("it can be met")
        });
        assert_eq!(quiet, loud, "{name}");
    }
}

#[test]
fn exact_competes_and_is_chosen_where_it_is_cheapest() {
    let scene = open("box-gas");
    let choice = choose(&scene, (1e-6, 1.0), Method::ALL, scene.solver, ON).expect("it can be met");
    assert_eq!(choice.settings.method, Method::Exact, "{choice:?}");
    let sentence = choice.sentence();
    for word in ["chose exact: least counted work of 55 settings", "position error 0 m up to 1 s"] {
        assert!(sentence.contains(word), "{word:?} is not in {sentence}");
    }
}
