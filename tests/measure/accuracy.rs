//! `--accuracy`: the same choice however busy the machine, and the error asked for met where `exact` is certified.

use carom::certify::certify_within;
use carom::measure::{Miss, choose};
use carom::physics::{Method, Progress, Scene, Settings, Simulation, State, Until};
use carom::scene::{self, builtin};

use crate::ON;

fn open(name: &str) -> Scene {
    scene::open(name).expect("a built-in scene").scene
}

/// When a run's frames end up to `until`, s: of an event-driven method, that is at each event too.
fn frames(scene: &Scene, settings: Settings, until: f64) -> Vec<f64> {
    let mut run = Simulation::new(scene, settings);
    let mut times = vec![0.0];
    while run.time() < until {
        match run.advance(Until::Frame, Simulation::SLICE) {
            Progress::Yielded => {}
            Progress::Reached => times.push(run.time().min(until)),
            Progress::Stalled(stall) => panic!("it goes on to {until} s: {stall:?}"),
        }
    }
    times
}

/// The state at `t` (s) of a run that has not passed it.
fn state(run: &mut Simulation, t: f64) -> State {
    run.run_to(t, |_| Some(Simulation::SLICE));
    run.at(t)
}

/// The largest distance (m) of a sphere from where `exact` has it, at each frame of the run and each event of `exact` up to `until`
/// (s); when (s), and of which. How many states that are.
fn farthest(scene: &Scene, settings: Settings, until: f64) -> ([f64; 2], usize, usize) {
    let exact = Settings { method: Method::Exact, dt: until.max(f64::MIN_POSITIVE), tolerance: 0.0 };
    let mut times = frames(scene, exact, until);
    times.extend(frames(scene, settings, until));
    times.sort_by(f64::total_cmp);
    times.dedup();
    let [mut run, mut reference] = [settings, exact].map(|settings| Simulation::new(scene, settings));
    let mut worst = ([0.0, 0.0], 0, times.len());
    for t in times {
        let [here, there] = [&mut run, &mut reference].map(|run| state(run, t));
        for (i, (x, y)) in here.x.iter().zip(&there.x).enumerate() {
            if x.distance(*y) > worst.0[0] {
                worst = ([x.distance(*y), t], i, worst.2);
            }
        }
    }
    worst
}

/// Holds a scene's choice for an error (m) against what is known of the truth: every sphere in each state up to the certified horizon
/// by `exact` and what the shadow run, which shares no code with the methods, says of its error; and at the horizon by the shadow run
/// itself. What was chosen, or why nothing was.
fn held(name: &str, wanted: f64) -> String {
    let scene = open(name);
    let choice = match choose(&scene, (wanted, scene.duration), Method::ALL, scene.solver, ON) {
        Ok(choice) => choice,
        Err(Miss::Nothing(why)) => return why,
        Err(Miss::Interrupted) => panic!("it is not interrupted"),
    };
    let shadow = certify_within(&scene, choice.certified, 1_000_000_000, ON).expect("it is not interrupted");
    // where an event ends it, the certificate up to there may end an ulp before
    let until = shadow.until;
    assert!(choice.certified - until <= until * 1e-12, "{name}, {wanted:e} m: {choice:?}, {:?}", shadow.ending);
    let ([off, t], i, states) = farthest(&scene, choice.settings, until);
    let most = off + shadow.error;
    assert!(most <= wanted, "{name}, {wanted:e} m: sphere {i} is up to {most:e} m off at {t} s, {choice:?}");
    let last = state(&mut Simulation::new(&scene, choice.settings), until);
    for (i, x) in last.x.iter().enumerate() {
        let place = shadow.place(i).expect("a place").map(carom::certify::Double::value);
        let off = x.distance(glam::DVec3::from_array(place));
        assert!(off <= wanted, "{name}, {wanted:e} m: sphere {i} is {off:e} m off at {until} s, {choice:?}");
    }
    assert!(choice.chosen.error <= wanted && choice.compared >= until, "{name}: {choice:?}");
    format!("{} [at most {most:.1e} m off in {states} states up to {until} s]", choice.sentence())
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
