//! Does what is taken away hold what was on the screen, and go on where the run was?

use carom::{
    physics::{Progress, Simulation, Until},
    scene::{self, Scene},
};

use super::app::User;

/// The names of the files that were written.
fn files(user: &User) -> Vec<String> {
    let entries = std::fs::read_dir(user.folder.path()).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn open(user: &User, name: &str) -> Scene {
    scene::open(user.folder.path().join(name)).unwrap_or_else(|error| panic!("{error}")).scene
}

/// The hashes of the next frames.
fn frames(run: &mut Simulation, count: usize) -> Vec<u64> {
    let mut next = || {
        while run.advance(Until::Frame, 1000) == Progress::Yielded {}
        run.state().hash()
    };
    (0..count).map(|_| next()).collect()
}

/// What the keys have led to, in one line.
fn said(user: &User) -> String {
    user.text().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn the_state_goes_on_bit_for_bit_by_every_method() {
    for name in ["paper-0", "paper-2", "paper-3", "newtons-cradle", "zigzag", "galton", "stack"] {
        for keys in ["", "m", "mm", "mmm"] {
            for at in [":goto 1\n", "cc", "c", ":goto 0.4\n,"] {
                let mut user = User::with(name);
                user.type_in(&format!("{keys}{at}"));
                let hash = user.snapshot().hash();
                user.type_in("e");
                assert!(said(&user).contains("bit for bit."), "{name}{keys}: {}", user.text());
                let ron = files(&user).into_iter().find(|name| name.ends_with(".ron")).expect("written");
                let scene = open(&user, &ron);
                let mut again = Simulation::new(&scene, scene.solver);
                assert_eq!(again.state().hash(), hash, "{name} {keys} {at}");
                let went_on = frames(&mut again, 30);
                for (frame, hash) in went_on.into_iter().enumerate() {
                    user.type_in(".");
                    assert_eq!(user.snapshot().hash(), hash, "{name} {keys} {at}: frame {frame} from there on");
                }
            }
        }
    }
}

#[test]
fn the_forces_that_act_over_the_next_frame_are_taken_along() {
    let mut user = User::with("paper-0");
    user.type_in("ce");
    let scene = open(&user, "paper-0-1.ron");
    let resume = scene.resume.as_ref().expect("it goes on");
    assert_eq!(resume.t, user.snapshot().t);
    let impulse = user.snapshot().contacts[0].impulse;
    assert_eq!(resume.transient[0], user.snapshot().contacts[0].normal * impulse);
}

#[test]
fn a_state_that_was_opened_is_shown_at_its_time_and_can_be_taken_away_again() {
    let mut user = User::with("paper-3");
    user.type_in("mm:goto 2\ne");
    let hash = user.snapshot().hash();
    let path = user.folder.path().join("paper-3-1.ron");
    let mut again = User::with(path.to_str().expect("a plain path"));
    assert_eq!((again.snapshot().hash(), again.snapshot().t), (hash, user.snapshot().t));
    again.type_in("..,,,");
    assert!(said(&again).contains("This is the start of the run."), "{}", again.text());
    again.type_in(":goto 0\n");
    assert_eq!(again.snapshot().hash(), hash, "there is nothing before it");
    again.type_in(":goto 3\ne");
    user.type_in(":goto 3\n");
    assert_eq!(again.snapshot().hash(), user.snapshot().hash());
    let scene = open(&again, "paper-3-1-1.ron");
    assert_eq!(Simulation::new(&scene, scene.solver).state().hash(), user.snapshot().hash());
    again.type_in("x");
    assert!(again.app.ghost().is_some(), "the exact run goes on from there as well");
}

#[test]
fn settings_in_force_are_taken_along_and_a_state_that_cannot_go_on_to_the_bit_says_so() {
    let mut user = User::with("paper-3");
    user.type_in("m:goto 0.5\n:dt 0.004\n:goto 0.8\ne");
    let scene = open(&user, "paper-3-1.ron");
    assert_eq!((scene.solver.method.name(), scene.solver.dt), ("swept", 0.004));
    user.type_in("t.e");
    assert!(said(&user).contains("to rounding: the tolerance was changed."), "{}", user.text());
}

#[test]
fn a_run_that_goes_on_gives_up_where_the_run_did() {
    // resting in a wedge stalls the printed method near 10.3 s, when it has waited for so many frames
    let mut user = User::with("paper-2");
    user.type_in(":goto 10\ne:goto 20\n");
    let path = user.folder.path().join("paper-2-1.ron");
    let mut again = User::with(path.to_str().expect("a plain path"));
    again.type_in(":goto 20\n");
    assert!(user.snapshot().stall.is_some());
    assert_eq!((again.snapshot().hash(), &again.snapshot().stall), (user.snapshot().hash(), &user.snapshot().stall));
}

#[test]
fn nothing_is_replaced_and_both_files_have_one_number() {
    let mut user = User::with("paper-1");
    std::fs::write(user.folder.path().join("paper-1-2.svg"), "mine").expect("a file");
    user.type_in("ee.e");
    let expected = [
        "paper-1-1.ron",
        "paper-1-1.svg",
        "paper-1-2.svg",
        "paper-1-3.ron",
        "paper-1-3.svg",
        "paper-1-4.ron",
        "paper-1-4.svg",
    ];
    assert_eq!(files(&user), expected);
    assert_eq!(std::fs::read(user.folder.path().join("paper-1-2.svg")).expect("there"), b"mine");
    assert!(said(&user).contains("paper-1-4.svg, and paper-1-4.ron"), "{}", user.text());
    let svg = std::fs::read_to_string(user.folder.path().join("paper-1-1.svg")).expect("there");
    assert!(svg.starts_with("<svg ") && svg.contains("paper-1") && !svg.contains("Written"), "{svg}");
}

#[test]
fn where_nothing_can_be_written_it_is_said() {
    let mut user = User::with("paper-1");
    std::fs::remove_dir_all(user.folder.path()).expect("it was there");
    user.type_in("e");
    assert!(said(&user).contains("Nothing is written: "), "{}", user.text());
}

#[test]
fn a_file_may_say_anything_of_what_goes_on() {
    for transient in [
        "",
        "(1, 2, 3)",
        "(0, 0, 0), (0, 1e30, 1)",
        "(1, 2, 3), (4, 5, 6), (7, 8, 9)",
        "(0, -9, 1)",
        "(0, 1e9, 1)",
        "(0.5, 0, 1)",
        "(-1, 0, 1)",
    ] {
        for method in ["paper", "swept", "exact", "moreau"] {
            let text = format!(
                "Scene(gravity: (0, -9.8, 0), solver: (method: {method}), resume: (t: 1.5, transient: [{transient}]), walls: \
                 [Wall(center: (0, 0, 0), s1: (4, 0, 0), s2: (0, 0, -4))], spheres: [Sphere(x: (0, 0.4, 0), mass: 1, \
                 radius: 0.5)])"
            );
            let scene = scene::parse(&text, "odd").expect("it is a scene");
            let mut run = Simulation::new(&scene, scene.solver);
            assert_eq!(run.time(), 1.5);
            frames(&mut run, 20);
        }
    }
}
