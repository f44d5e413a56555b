//! Does `measure` tell the truth: errors against closed forms, horizons against the prototypes', parts against the whole?

#[path = "measure/accuracy.rs"]
mod accuracy;
#[path = "measure/arithmetic.rs"]
mod arithmetic;
#[path = "measure/certified.rs"]
mod certified;
#[path = "measure/command.rs"]
mod command;
#[path = "measure/crowds.rs"]
mod crowds;
#[path = "measure/figures.rs"]
mod figures;
#[path = "measure/floor.rs"]
mod floor;
#[path = "measure/judged.rs"]
mod judged;
#[allow(dead_code)] // each test crate uses what it needs
#[path = "cli/program.rs"]
mod program;
#[allow(dead_code)]
#[path = "support/pty.rs"]
mod pty;
#[path = "support/random.rs"]
mod random;
#[path = "measure/student.rs"]
mod student;
mod support;
#[path = "support/watch.rs"]
mod watch;

use carom::export::TradeRow;
use carom::measure::{Axes, Budget, Errors, Miss, Reference, Rung, Subject, choose, errors};
use carom::physics::{Method, Scene};
use carom::scene::ContactLaw;
use glam::{DVec3, dvec3};
use support::{ELASTIC, G, PAPER_LAW, changed, paper, paper_scene, room, scene, sphere, wall};

const ON: &(dyn Fn() -> bool + Sync) = &|| true;

/// What a command that succeeds writes to standard output.
fn carom_of(arguments: &[&str]) -> String {
    program::carom(arguments).succeeds().out
}

/// A sphere of 1 kg that falls for so long (s) from 10 m and meets nothing.
fn drop_for(duration: f64) -> Scene {
    let bodies = vec![sphere(DVec3::Y * 10.0, DVec3::X, 0.5)];
    changed(&scene(G, ELASTIC, Vec::new(), bodies), |draft| draft.duration = duration)
}

/// A sphere whose lowest point is so high (m) above a floor.
fn drop_from(height: f64, contact: ContactLaw, duration: f64) -> Scene {
    let floor = wall(DVec3::ZERO, DVec3::X * 10.0, DVec3::Z * 10.0);
    let bodies = vec![sphere(DVec3::Y * (height + 0.5), DVec3::ZERO, 0.5)];
    changed(&scene(G, contact, vec![floor], bodies), |draft| draft.duration = duration)
}

fn reference(scene: &Scene) -> Reference {
    Reference::of(scene, scene.duration, Budget::REFERENCE, ON).expect("it is not interrupted")
}

fn errors_of(scene: &Scene, dt: f64, tolerance: f64) -> Errors {
    errors(scene, paper(dt, tolerance), &reference(scene), f64::INFINITY, ON).expect("it is not interrupted")
}

#[test]
fn the_position_error_of_a_drop_is_eulers_closed_form() {
    for dt in [0.1, 0.01, 0.001] {
        let found = errors_of(&drop_for(1.0), dt, 1e-3);
        // g·t·dt/2 at t = 1 s; a thousand additions of rounding at 10 m remain.
        let expected = 9.8 * 1.0 * dt / 2.0;
        assert!((found.position.distance - expected).abs() < 1e-12, "dt {dt}: {found:?}");
        assert_eq!((found.compared, found.end), (1.0, 1.0));
    }
}

#[test]
fn the_energy_error_of_a_drop_is_the_height_that_euler_loses() {
    let found = errors_of(&drop_for(1.0), 0.1, 1e-3).energy.expect("there is energy");
    // m g · g t dt / 2 of 98.5 J: 10 m high, 1 m/s across. Rounding as above.
    assert!((found - 9.8 * 0.49 / 98.5).abs() < 1e-13, "{found}");
}

#[test]
fn the_impact_time_error_of_a_drop_is_the_one_computed_by_hand() {
    // 4.9 m take 1 s. Euler at dt 0.1 has fallen 9.8·0.01·45 = 4.41 m after nine frames and does 8.82 m/s; of the tenth
    // it takes (8.82 + 9.8 h) h = 0.49, that is h = (√(8.82² + 4·9.8·0.49) − 8.82) / 19.6.
    let h = ((8.82_f64 * 8.82 + 4.0 * 9.8 * 0.49).sqrt() - 8.82) / 19.6;
    let found = errors_of(&drop_from(4.9, PAPER_LAW, 1.5), 0.1, 1e-5);
    let error = found.impact_time.expect("one impact each");
    // Found at a depth of up to 1.1e-4 · 0.5 m, at 9 m/s.
    assert!((error - (0.1 - h)).abs() < 1e-5, "{error}, by hand {}", 0.1 - h);
    assert_eq!((found.common, found.run.impacts.len()), (1, 1));
}

#[test]
fn the_yardstick_is_without_error_against_itself() {
    let subject = Subject::new("paper-0", paper_scene(0), ON).expect("it is not interrupted");
    let row =
        subject.measure(Rung { method: Method::Exact, dt: None, tolerance: None }, ON).expect("it is not interrupted");
    let TradeRow { position_error, impact_time_error, energy_error, common_events, impacts, .. } = row;
    assert_eq!((position_error, impact_time_error, energy_error), (Some(0.0), Some(0.0), Some(0.0)));
    assert_eq!((common_events, impacts), (22, 22), "22 impacts were found by three independent codes");
}

#[test]
fn the_horizons_are_those_of_the_prototypes() {
    // Growth of a displacement within 20 s there: 1 in scene 0, 1e3 in 1, 2 in 2; in 3 it was 6e3 at 5 s and 2e6 at 10 s.
    for k in [0, 1, 2] {
        assert_eq!(reference(&paper_scene(k)).horizon.time, None, "scene {k}");
    }
    let third = reference(&paper_scene(3)).horizon.time.expect("scene 3 has a horizon");
    assert!((7.0..=11.0).contains(&third), "{third} s");
}

#[test]
fn a_displacement_in_free_flight_does_not_grow() {
    let horizon = reference(&drop_for(5.0)).horizon;
    // 1e-12 m are known to an ulp of 112 m, 1.4e-14 m, at each end: 3 % of it.
    assert!(horizon.time.is_none() && horizon.growth < 1.06, "{horizon:?}");
}

#[test]
fn beyond_the_horizon_positions_are_not_compared() {
    let scene = paper_scene(3);
    let reference = reference(&scene);
    let found = errors(&scene, paper(1e-2, 1e-3), &reference, f64::INFINITY, ON).expect("it is not interrupted");
    let horizon = reference.horizon.time.expect("scene 3 has a horizon");
    assert_eq!(found.compared, horizon);
    assert_eq!(found.end, 20.0, "the run itself goes on");
}

#[test]
fn a_run_that_stalls_says_so_and_is_judged_up_to_there() {
    let subject = Subject::new("paper-2", paper_scene(2), ON).expect("it is not interrupted");
    let rung = Rung { method: Method::Paper, dt: Some(1e-2), tolerance: Some(1e-3) };
    let row = subject.measure(rung, ON).expect("it is not interrupted");
    assert!(row.note.to_string().starts_with("stalled at 10.") && row.until < 10.5, "{row:?}");
    assert_eq!(carom::measure::front(&[row], &[Method::Paper], Axes::default()), [0; 0], "it does not compete");
}

#[test]
fn a_tunnelled_run_is_told_by_its_note() {
    let subject = Subject::new("paper-0", paper_scene(0), ON).expect("it is not interrupted");
    let rung = Rung { method: Method::Paper, dt: Some(0.1), tolerance: Some(1e-3) };
    let row = subject.measure(rung, ON).expect("it is not interrupted");
    assert!(row.note.to_string().contains("parted from the reference; lacks one"), "{row:?}");
    assert_eq!(row.impact_time_error, None);
}

#[test]
fn where_exact_passes_its_budget_the_finest_moreau_run_stands_in_and_every_row_says_so() {
    // A box this narrow is crossed 20 times a second: two hundred impacts in 10 s.
    let walls = room(dvec3(-0.55, -5.0, -5.0), dvec3(0.55, 5.0, 5.0));
    let bodies = vec![sphere(DVec3::ZERO, DVec3::X * 2.0, 0.5)];
    let busy = changed(&scene(DVec3::ZERO, ELASTIC, walls, bodies), |draft| draft.duration = 10.0);
    let poor = Budget { work: 50, ..Budget::REFERENCE };
    let reference = Reference::of(&busy, 10.0, poor, ON).expect("it is not interrupted");
    assert_eq!((reference.settings.method, reference.end), (Method::Moreau, 10.0));
    assert!(reference.doubt.contains("because exact passes its budget"), "{}", reference.doubt);
    let subject = Subject { key: "busy".into(), scene: busy.clone(), reference };
    let row =
        subject.measure(Rung { method: Method::Exact, dt: None, tolerance: None }, ON).expect("it is not interrupted");
    assert!(row.note.to_string().contains("reference is moreau dt 1e-4 because"), "{}", row.note);
    let brief = Reference::brief(&busy, 10.0, poor, ON).expect("it is not interrupted");
    assert!(brief.settings.method == Method::Exact && brief.end < 10.0, "{} s", brief.end);
}

#[test]
fn interrupted_measurements_have_no_result() {
    let off: &(dyn Fn() -> bool + Sync) = &|| false;
    let scene = paper_scene(0);
    let known = reference(&scene);
    assert!(errors(&scene, paper(1e-4, 1e-3), &known, f64::INFINITY, off).is_err());
    assert_eq!(choose(&scene, (1e-2, 20.0), Method::ALL, scene.solver, off), Err(Miss::Interrupted));
}

#[test]
fn an_accuracy_is_met_by_what_is_chosen() {
    let scene = drop_for(2.0);
    // Euler's error at 2 s is 9.8 dt: 1e-2 needs dt 1e-3 of the ladder, whatever it costs.
    let choice = choose(&scene, (1e-2, 2.0), &[Method::Paper], scene.solver, ON).expect("it can be met");
    assert!(choice.settings.dt <= 1e-3 && choice.chosen.error <= 1e-2, "{choice:?}");
    let again = errors(&scene, choice.settings, &reference(&scene), f64::INFINITY, ON).expect("it is not interrupted");
    assert_eq!(again.position.distance, choice.chosen.error);
    let sentence = choice.sentence();
    assert!(["chose paper, dt", "position error", "m up to 2 s"].iter().all(|w| sentence.contains(w)), "{sentence}");
}

#[test]
fn an_accuracy_that_nothing_meets_is_refused_with_a_sentence() {
    let scene = drop_for(1.0);
    let Err(Miss::Nothing(why)) = choose(&scene, (1e-9, 1.0), &[Method::Paper], scene.solver, ON) else {
        panic!("paper cannot do 1e-9 m");
    };
    assert!(why.contains("1e-9 m") && why.contains("paper"), "{why}");
}
