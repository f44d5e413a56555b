//! `marks`: trajectories of Carom's own methods, and of a program that shares no code with it, right and with nine mistakes.

use std::io::{Cursor, Read};

use carom::export::{Columns, States};
use carom::marks::{Exam, Mark, Mistake, NoMark, Source, Wrong};
use carom::physics::{Kind, Method, Scene, Settings, Simulation};
use carom::scene;

use crate::student::Student;

fn open(name: &str) -> Scene {
    scene::open(name).expect("a built-in scene").scene
}

fn exam(scene: &Scene, until: f64, tolerance: Option<f64>) -> Exam {
    Exam::new(scene, until, tolerance, &|| true).expect("it is not interrupted")
}

fn source(text: &str, spheres: usize) -> Source {
    let reader: Box<dyn Read + Send> = Box::new(Cursor::new(text.to_owned()));
    States::new(reader, &Columns::default(), spheres).expect("rows")
}

fn mark(exam: &Exam, text: &str) -> Mark {
    exam.mark(source(text, exam.spheres()), &|| true).expect("a trajectory")
}

/// Rows of one of Carom's methods, `every` seconds.
fn own(scene: &Scene, settings: Settings, until: f64, every: f64) -> String {
    let mut run = Simulation::new(scene, settings);
    let mut text = String::from("time,sphere,x,y,z,vx,vy,vz\n");
    for k in 0..=(until / every).round() as u64 {
        let t = k as f64 * every;
        run.run_to(t, |_| Some(Simulation::SLICE));
        if run.time() < t {
            break; // a method that cannot go on
        }
        let state = run.at(t);
        for (i, (x, v)) in state.x.iter().zip(&state.v).enumerate() {
            text += &format!("{t:?},{i},{:?},{:?},{:?},{:?},{:?},{:?}\n", x.x, x.y, x.z, v.x, v.y, v.z);
        }
    }
    text
}

fn by(method: Method, dt: f64) -> Settings {
    Settings { method, dt, tolerance: 1e-6 }
}

#[test]
fn exact_against_itself_is_off_by_nothing_and_lacks_no_impact() {
    for (name, until) in [("paper-1", 8.0), ("paper-3", 5.0), ("paper-2", 5.0)] {
        let scene = open(name);
        let found = mark(&exam(&scene, until, Some(1e-9)), &own(&scene, by(Method::Exact, until), until, 0.01));
        assert_eq!((found.error.0, found.passes, found.mistake), (0.0, Some(true), None), "{name}");
        let impacts = found.impacts.expect("it has velocities");
        assert_eq!((impacts.first_wrong, impacts.found), (None, impacts.wanted), "{name}: {impacts:?}");
        assert!(impacts.wanted > 5 && found.unexplained.is_none(), "{name}: {impacts:?}, {:?}", found.unexplained);
        let energy = found.energy.expect("it has velocities");
        assert_eq!((energy.error, energy.momentum_error), (Some(0.0), Some(0.0)), "{name}");
    }
}

#[test]
fn a_trajectory_that_is_shifted_by_a_millimetre_is_a_millimetre_off() {
    let scene = open("paper-0");
    let rows = own(&scene, by(Method::Exact, 3.0), 3.0, 0.01);
    let shifted = rows.replace(",-4.5,", ",-4.499,");
    let found = mark(&exam(&scene, 3.0, Some(2e-3)), &shifted);
    assert!((found.error.0 - 1e-3).abs() < 1e-12 && found.passes == Some(true), "{found:?}");
    let strict = exam(&scene, 3.0, Some(5e-4));
    assert_eq!(mark(&strict, &shifted).passes, Some(false));
}

#[test]
fn a_trajectory_that_ends_early_does_not_pass() {
    let scene = open("paper-0");
    let rows = own(&scene, by(Method::Exact, 1.0), 1.0, 0.01);
    let found = mark(&exam(&scene, 3.0, Some(1e-3)), &rows);
    assert_eq!((found.passes, found.compared, found.error.0), (Some(false), 1.0, 0.0));
}

#[test]
fn an_impact_that_is_left_out_or_added_is_named_with_its_time_and_bodies() {
    // A ball that falls on the floor of paper-0 after 9 m, √(18 / 9.8) s; then one that flies on.
    let scene = open("paper-0");
    let falls = |bounces: bool| {
        let mut text = String::from("time,x,y,z,vx,vy,vz\n");
        let hit = (18.0_f64 / 9.8).sqrt();
        for k in 0..=200 {
            let t = f64::from(k) * 0.01;
            let (y, v) = if t <= hit || !bounces {
                (9.5 - 4.9 * t * t, -9.8 * t)
            } else {
                let (s, up) = (t - hit, 0.8 * 9.8 * hit);
                (0.5 + up * s - 4.9 * s * s, up - 9.8 * s)
            };
            text += &format!("{t:?},-4.5,{y:?},0,0,{v:?},0\n");
        }
        text
    };
    let exam = exam(&scene, 2.0, Some(1e-6));
    let right = mark(&exam, &falls(true));
    let ledger = right.energy.expect("it has velocities");
    // It begins at rest, and is 0.8 m g √(18 / g) up as it leaves the floor.
    let up = 0.8 * 9.8 * (18.0_f64 / 9.8).sqrt() - 9.8 * (2.0 - (18.0_f64 / 9.8).sqrt());
    assert!(ledger.momentum_start.length() < 1e-12 && (ledger.momentum_end.y - up).abs() < 1e-9, "{ledger:?}");
    assert!(right.passes == Some(true) && right.error.0 < 1e-13, "{right:?}");
    let wrong = mark(&exam, &falls(false)).impacts.and_then(|impacts| impacts.first_wrong).expect("a missing impact");
    assert_eq!((wrong.key, wrong.wrong), ((Kind::Wall, 0, 0), Wrong::Missing));
    assert!((wrong.time - (18.0_f64 / 9.8).sqrt()).abs() < 1e-12, "{wrong:?}");
}

#[test]
fn two_files_at_different_times_are_compared_between_their_rows() {
    let scene = open("paper-1");
    let exam = exam(&scene, 5.0, Some(1e-9));
    let [fine, coarse] = [0.01, 0.035].map(|every| own(&scene, by(Method::Exact, 5.0), 5.0, every));
    let found = exam.mark_against(source(&fine, 1), source(&coarse, 1), &|| true).expect("two trajectories");
    // Both are parabolas between impacts, at most one of which lies between two rows: only rounding is left.
    assert!(found.error.0 < 1e-12 && found.interpolation < 1e-12 && found.passes == Some(true), "{found:?}");
    assert!(found.impacts.is_some_and(|impacts| impacts.first_wrong.is_none() && impacts.found > 3), "{found:?}");
}

#[test]
fn a_file_without_velocities_is_marked_by_its_places() {
    let scene = open("paper-1");
    let rows = own(&scene, by(Method::Exact, 2.0), 2.0, 0.01);
    let places: String = rows.lines().map(|row| row.split(',').take(5).collect::<Vec<_>>().join(",") + "\n").collect();
    let found = mark(&exam(&scene, 2.0, Some(1e-9)), &places);
    assert_eq!((found.error.0, found.passes, found.impacts, found.energy), (0.0, Some(true), None, None));
}

#[test]
fn an_interrupt_ends_a_mark() {
    let scene = open("paper-0");
    let exam = exam(&scene, 1.0, None);
    let rows = own(&scene, by(Method::Exact, 1.0), 1.0, 0.1);
    assert_eq!(exam.mark(source(&rows, 1), &|| false), Err(NoMark::Interrupted));
}

#[test]
fn the_students_program_without_a_mistake_converges_to_exact() {
    for (name, steps) in [("paper-0", [1e-2, 1e-3]), ("paper-1", [1e-3, 1e-4])] {
        let scene = open(name);
        let exam = exam(&scene, 3.0, None);
        let errors = steps.map(|dt| mark(&exam, &Student::new(&scene, dt, None).rows(3.0, 100_000)).error.0);
        // First order: a tenth of the step, a tenth of the error, give or take where frames end.
        assert!(errors[1] < 0.2 * errors[0] && errors[1] < 0.05, "{name}: {errors:?}");
    }
}

/// Each mistake, the scene where it shows, the student's dt, s, and the end, s.
const MISTAKES: [(Mistake, &str, f64, f64); 9] = [
    (Mistake::PairTwice, "paper-3", 0.01, 10.0),
    (Mistake::PairHalf, "paper-3", 0.01, 10.0),
    (Mistake::RestingSpeedKept, "paper-0", 0.01, 20.0),
    (Mistake::Projected, "paper-1", 0.01, 10.0),
    (Mistake::NormalAtTheBack, "paper-2", 0.01, 5.0),
    (Mistake::Tunnelling, "paper-0", 0.1, 5.0),
    (Mistake::TangentialEveryFrame, "paper-3", 0.01, 10.0),
    (Mistake::ThresholdsSwapped, "paper-1", 0.01, 5.0),
    (Mistake::OneStepLate, "paper-1", 0.01, 10.0),
];

#[allow(clippy::print_stdout)] // read with --nocapture
#[test]
fn each_known_mistake_is_named() {
    let mut wrong = Vec::new();
    let by_steps = MISTAKES.into_iter().flat_map(|(mistake, name, dt, until)| {
        // half the step is another run altogether; to tunnel takes a step as long as a wall's reach
        let steps = if mistake == Mistake::Tunnelling { vec![dt] } else { vec![dt, 0.5 * dt] };
        steps.into_iter().map(move |dt| (mistake, name, dt, until))
    });
    for (mistake, name, dt, until) in by_steps {
        let scene = open(name);
        let found = mark(&exam(&scene, until, None), &Student::new(&scene, dt, Some(mistake)).rows(until, 20_000));
        let named = found.mistake.map(|suspicion| suspicion.mistake);
        let said = found.mistake.map_or("none".into(), |suspicion| suspicion.to_string());
        println!("{}, {name}, dt {dt} s: named {said}", mistake.name());
        if named != Some(mistake) {
            let found = Mark { series: Default::default(), ..found };
            wrong.push(format!("{mistake:?} in {name}: {found:?}"));
        }
    }
    assert!(wrong.is_empty(), "{} are not named:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn no_mistake_is_named_in_a_right_program() {
    let mut wrong = Vec::new();
    for name in ["paper-0", "paper-1", "paper-2", "paper-3", "billiard", "cannon"] {
        let scene = open(name);
        let exam = exam(&scene, 10.0, None);
        let mut hold = |what: String, rows: &str| {
            let found = mark(&exam, rows);
            if found.mistake.is_some() {
                wrong.push(format!("{what} in {name}: {:?}", found.mistake));
            }
        };
        for dt in [1e-2, 1e-3] {
            hold(format!("the student's, dt {dt}"), &Student::new(&scene, dt, None).rows(10.0, 20_000));
            for method in [Method::Paper, Method::Moreau] {
                for every in [1e-2, 3e-3] {
                    let rows = own(&scene, Settings { method, dt, tolerance: 1e-3 }, 10.0, every);
                    hold(format!("{method:?} dt {dt} every {every}"), &rows);
                }
            }
        }
        for method in [Method::Exact, Method::Swept] {
            for every in [1e-2, 0.1] {
                hold(format!("{method:?} every {every}"), &own(&scene, by(method, 0.1), 10.0, every));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
