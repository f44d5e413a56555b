//! Does one get back to what was, on the screen, and does a run stop where it was told to?

use carom::{
    app::{Code, Key},
    snapshot::Kept,
    view::{Mode, Screen},
    worker::Activity,
};

use super::{app::User, stages, store};

/// The hash of the frame shown.
fn hash(user: &User) -> u64 {
    user.snapshot().hash()
}

/// What the keys have led to, in one line.
fn said(user: &User) -> String {
    let text = user.text();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_comma_is_one_frame_back_and_the_status_says_so() {
    let mut user = User::with("paper-2");
    let mut hashes = vec![hash(&user)];
    for _ in 0..30 {
        user.type_in(".");
        hashes.push(hash(&user));
    }
    for (frame, seen) in hashes.iter().enumerate().rev().skip(1) {
        user.type_in(",");
        assert_eq!((user.snapshot().tallies.frames, hash(&user)), (frame as u64, *seen));
        assert!(user.row(0).contains("BACK"), "{}", user.row(0));
        assert!(user.row(-2).contains(&format!("frame {frame} of 30")), "{}", user.row(-2));
    }
    user.type_in(",");
    assert!(user.row(-1).contains("This is the start of the run."), "{}", user.row(-1));
    user.type_in(">>");
    assert_eq!((user.snapshot().tallies.frames, hash(&user)), (20, hashes[20]));
    user.type_in("<.");
    assert_eq!((user.snapshot().tallies.frames, hash(&user)), (11, hashes[11]));
    user.type_in(">>");
    assert_eq!((user.snapshot().tallies.frames, hash(&user)), (30, hashes[30]), "no further than the newest");
    assert!(user.row(0).contains("PAUSE"), "{}", user.row(0));
    user.type_in("g");
    assert_eq!((user.snapshot().tallies.frames, hash(&user)), (0, hashes[0]));
    user.type_in("G");
    assert_eq!((user.snapshot().tallies.frames, hash(&user)), (30, hashes[30]));
    user.type_in("G");
    assert!(user.row(-1).contains("This is the newest frame."), "{}", user.row(-1));
}

#[test]
fn a_capital_c_goes_back_from_collision_to_collision() {
    for method in ["", "m", "mm", "mmm"] {
        let mut user = User::with("paper-3");
        user.type_in(method);
        let mut met = Vec::new();
        for _ in 0..6 {
            user.type_in("c");
            met.push((user.snapshot().tallies.frames, user.snapshot().tallies.impacts, hash(&user)));
        }
        user.type_in(".");
        for was in met.iter().rev() {
            user.type_in("C");
            assert_eq!(&(user.snapshot().tallies.frames, user.snapshot().tallies.impacts, hash(&user)), was);
        }
        user.type_in("C");
        assert!(user.row(-1).contains("There is no collision before this one."), "{}", user.row(-1));
        assert_eq!(hash(&user), met[0].2, "it stays where it was");
        user.type_in("c");
        assert_eq!(hash(&user), met[1].2, "on through what is kept");
    }
}

#[test]
fn settings_that_were_changed_on_the_way_are_changed_again_and_shown() {
    let mut user = User::with("paper-4");
    user.type_in(":goto 0.5\ns:goto 1\nmm:goto 1.5\n:tolerance 1e-7\nm:goto 2\n");
    let end = hash(&user);
    user.type_in(":goto 0.7\n");
    assert_eq!((user.snapshot().method, user.snapshot().dt), ("paper", 0.005));
    let at = hash(&user);
    user.type_in(":goto 0.2\n");
    assert_eq!((user.snapshot().method, user.snapshot().dt), ("paper", 0.01));
    user.type_in(":goto 0.7\n");
    assert_eq!(hash(&user), at, "and on again");
    user.type_in(":goto 1.2\n");
    assert_eq!((user.snapshot().method, user.snapshot().tolerance), ("exact", 1e-3));
    user.type_in("G");
    assert_eq!((user.snapshot().method, user.snapshot().tolerance, hash(&user)), ("moreau", 1e-7, end));
    user.type_in(":goto 0.2\nS");
    assert_eq!(user.snapshot().dt, 0.02, "knobs turn from what is in force there");
}

#[test]
fn a_run_from_the_past_on_drops_what_came_later_and_says_so() {
    let mut user = User::with("paper-0");
    user.type_in("...........<");
    let at = hash(&user);
    let _ = user.app.handle(carom::app::Input::Key(Key::char(' ')));
    user.until("running on", |app| app.report().snapshot.tallies.frames > 1 && !app.report().kept.is_past);
    assert!(said(&user).contains("The run goes on from t = 0.01 s; 10 later frames are dropped."), "{}", user.text());
    user.type_in(" ,");
    while user.snapshot().tallies.frames > 1 {
        user.type_in(",");
    }
    assert_eq!(hash(&user), at);
    user.type_in("t");
    assert!(said(&user).contains("later frame"), "{}", user.text());
    assert!(user.row(0).contains("PAUSE") && user.row(0).contains("1e-4"), "{}", user.row(0));
}

#[test]
fn collisions_of_dropped_frames_leave_the_timeline() {
    let mut user = User::with("paper-0");
    user.type_in("ccc");
    let ticks = |user: &User| user.app.report().ticks.impacts.iter().sum::<u32>();
    assert_eq!(ticks(&user), 3);
    user.type_in("C,");
    assert_eq!(ticks(&user), 3, "they are still there to be gone to");
    user.type_in("s");
    assert_eq!(ticks(&user), 1);
    user.type_in("cc");
    assert_eq!(ticks(&user), 3);
}

#[test]
fn a_search_that_finds_nothing_says_so_and_stays_where_it_was() {
    let mut user = User::with("paper-0");
    user.type_in(":goto 15\n"); // its last impact is at 12 s, its duration 20 s
    let at = hash(&user);
    for _ in 0..2 {
        user.type_in("c");
        assert!(said(&user).contains("No collision within 20 s: the run stays at t = 15"), "{}", user.text());
        assert_eq!(hash(&user), at);
        assert!(
            user.row(0).contains("PAUSE") && !user.row(-2).contains("frame"),
            "as if nothing had been: {}",
            user.text()
        );
    }
    user.type_in(":goto 25\nc");
    assert!(said(&user).contains("No collision within another 20 s: the run stays at t = 25"), "{}", user.text());
    assert!(said(&user).contains("past the scene's duration"), "{}", user.text());
    user.type_in(":goto 2\n");
    let at = hash(&user);
    user.type_in(":until collision 0 wall 1\n");
    assert!(said(&user).contains("No collision of sphere 0 with wall 1 within 20 s"), "{}", user.text());
    assert_eq!(hash(&user), at);
    assert!(user.row(0).contains("BACK"), "the frames after are still kept: {}", user.row(0));
}

#[test]
fn a_run_stops_where_it_was_told_to_and_says_why() {
    for (orders, why) in [
        (":until collision\n", "sphere 0 hits wall 6."),
        (":until collision 0 1\n", "spheres 0 and 1 collide."),
        ("\t\t:until collision selected\n", "sphere 1 hits wall"),
        (":until t=1.5\n", "Stopped at t = 1.5"),
        (":until speed>3\n", "m/s, a speed above 3 m/s."),
        (":until energy>0.01\n", "the energy is off by"),
        ("m:until degree>1e-4\n", "overlap by"),
    ] {
        let mut user = User::with("paper-3");
        user.type_in(orders);
        assert!(said(&user).contains("Stopped at t = ") && said(&user).contains(why), "{orders}: {}", user.text());
        assert_eq!(user.app.report().activity, Activity::Paused);
    }
}

#[test]
fn rests_and_releases_are_waited_for() {
    let mut user = User::with("paper-0");
    user.type_in("mm:until rest\n"); // exact: the last impact is at 12.0974 s
    assert!(said(&user).contains("sphere 0 comes to rest on wall"), "{}", user.text());
    assert!((12.0..12.2).contains(&user.snapshot().t), "{}", user.snapshot().t);
    user.type_in(":until release\n");
    assert!(said(&user).contains("No release within 20 s"), "{}", user.text());
    user.type_in(":until t=3\n");
    assert!(said(&user).contains("t = 3 s is past; :goto 3 goes back."), "{}", user.text());
}

#[test]
fn a_sphere_that_leaves_the_room_stops_the_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("open.ron");
    let scene = "Scene(walls: [Wall(center: (0, 0, 0), s1: (4, 0, 0), s2: (0, 0, -4))], \
                 spheres: [Sphere(x: (0, 0.6, 0), v: (1, 0, 0), mass: 1, radius: 0.5)])";
    std::fs::write(&path, scene).expect("a file");
    let mut user = User::with(path.to_str().expect("a plain path"));
    user.type_in(":until exit\n");
    assert!(said(&user).contains("leaves the box around the walls"), "{}", user.text());
}

#[test]
fn u_asks_until_what_and_capital_u_asks_no_more() {
    let mut user = User::with("paper-3");
    user.type_in("U");
    assert!(said(&user).contains("Nothing was waited for yet"), "{}", user.text());
    user.type_in("ucollision 0 wall 0\n");
    let first = user.snapshot().t;
    assert!(said(&user).contains("sphere 0 hits wall 0."), "{}", user.text());
    user.type_in("U");
    assert!(user.snapshot().t > first && said(&user).contains("sphere 0 hits wall 0."), "{}", user.text());
    user.type_in("ubounce\n");
    assert!(said(&user).contains("bounce is not allowed: :until takes collision"), "{}", user.text());
}

#[test]
fn the_hint_line_says_what_is_useful_where_one_is() {
    let mut user = User::with("paper-0");
    assert!(user.row(-1).starts_with(" space pause/run  . step"), "{}", user.row(-1));
    user.type_in("c\x1b");
    assert!(user.row(-1).contains("w why  ) search  c next  C before  ? help  q quit"), "{}", user.row(-1));
    user.type_in(",");
    assert!(user.row(-1).contains("space go on here  . on  , back  C collision before  G newest"), "{}", user.row(-1));
    user.type_in("o");
    assert!(user.row(-1).contains("j k move  / filter  Enter open  Esc close"), "{}", user.row(-1));
    user.type_in("\x1b?");
    assert!(user.row(-1).contains("j k scroll  Esc close"), "{}", user.row(-1));
}

#[test]
fn orders_are_completed_recalled_and_named() {
    let mut user = User::with("paper-3");
    user.type_in(":unt\tcol\t1\n");
    assert!(said(&user).contains("sphere 1 hits wall"), "{}", user.text());
    let first = user.snapshot().t;
    user.type_in(":");
    let _ = user.press(Key::plain(Code::Up));
    assert!(user.row(-1).starts_with(":until collision 1"), "{}", user.row(-1));
    user.type_in("\n");
    assert!(user.snapshot().t > first, "{}", user.text());
    user.type_in(":until ");
    assert!(user.row(-1).contains("collision  rest  release  exit  t=  speed>"), "{}", user.row(-1));
    user.type_in("\x1b:method exact\n:select 1\n");
    assert_eq!((user.snapshot().method, user.app.view_settings().selected), ("exact", Some(1)));
    user.type_in(":select 7\n");
    assert!(said(&user).contains("7 is not allowed: :select takes a sphere, 0 to 1, or none."), "{}", user.text());
    user.type_in(":scene paper-4\n");
    assert_eq!(user.snapshot().stage.key, "paper-4");
}

#[test]
fn a_run_that_cannot_go_on_can_be_gone_back_in() {
    let mut user = User::with("paper-2");
    user.type_in(":goto 20\n");
    let (at, t) = (hash(&user), user.snapshot().t);
    assert_eq!(user.app.report().activity, Activity::Stalled);
    user.type_in("<");
    assert!(user.row(0).contains("BACK") && user.snapshot().stall.is_none(), "{}", user.text());
    user.type_in("G");
    assert_eq!((user.app.report().activity, hash(&user), user.snapshot().t), (Activity::Stalled, at, t));
    user.type_in("C");
    assert!(user.snapshot().t < t);
    let _ = user.press(Key::plain(Code::Left));
    assert!(user.row(0).contains("BACK"), "{}", user.row(0));
}

#[test]
fn a_time_past_the_duration_is_said_to_be_so() {
    let mut user = User::with("paper-0");
    user.type_in(":goto 2\n");
    assert!(user.row(-1).starts_with(" space"), "it is there, and there is nothing to say: {}", user.row(-1));
    user.type_in(":goto 25\n");
    assert!(said(&user).contains("s is past the scene's duration, 20 s."), "{}", user.text());
    user.type_in("m:goto 1e9\n");
    assert!(
        said(&user).contains("Frames on the way were too many to be kept: the past begins at t = "),
        "{}",
        user.text()
    );
    user.type_in("g");
    assert!(said(&user).contains("Nothing before t = "), "{}", user.text());
}

#[test]
fn what_a_newcomer_sees_first_is_there_whole() {
    for (width, height) in [(80, 24), (110, 30), (120, 40)] {
        let user = User::new_here(width, height);
        let (text, all) = (user.text(), said(&user));
        assert_eq!(user.snapshot().contacts.len(), 1, "{text}");
        assert!(user.row(-1).contains("A collision taken apart. space runs on, c goes to the next, ? lists the keys."));
        assert!(user.row(-2).contains("1 impact") && !all.contains("Stopped"), "a row of message, no more: {text}");
        for word in ["why", "point", "J  ", "lost", "overlap", "gap", "roots", "chosen", "approach"] {
            assert!(text.contains(word), "{width}x{height}: {word} is missing in\n{text}");
        }
    }
}

#[test]
fn an_earlier_frame_looks_as_stored() {
    let mut scene = stages::wedge();
    scene.pace.mode = Mode::Back;
    scene.kept = Kept { oldest: 120, from: 1.18, newest: 1204, until: 11.9, is_past: true };
    for (bin, impacts) in [(20, 1), (21, 3), (30, 2), (44, 1)] {
        scene.ticks.impacts[bin] = impacts;
    }
    let message = "Stopped at t = 3.5072 s: sphere 0 hits wall 6.";
    store("back", &Screen { message: Some(message), ..scene.screen() });
}
