//! Does the list of all that has happened tell what the run told, and lead there?

use carom::{
    app::{Code, Input, Key},
    physics::{Class, Contact, Settings, Simulation},
    scene::{self, Method},
    snapshot::{EventFilter, EventLog, Logged},
    view::{EventsView, Popup, Screen},
    worker::Activity,
};

use super::{app::User, stages, store};

/// What a run of its own tells up to the end of the frame that is shown.
fn told(user: &User) -> Vec<Contact> {
    let snapshot = user.snapshot();
    let scene = scene::open(&snapshot.stage.key).expect("built in").scene;
    let method = Method::from_name(snapshot.method).expect("a method");
    let mut run = Simulation::new(&scene, Settings { method, dt: snapshot.dt, tolerance: snapshot.tolerance });
    run.record_events(true);
    while run.tallies().frames < snapshot.tallies.frames {
        run.advance(carom::physics::Until::Frame, u64::MAX);
    }
    run.take_events()
}

fn log(user: &User) -> Vec<Logged> {
    user.app.report().log.iter().map(|(_, event)| *event).collect()
}

#[test]
fn it_lists_every_event_once_however_one_goes_to_and_fro() {
    for keys in ["", "m", "mm", "mmm"] {
        for name in ["paper-3", "newtons-cradle", "zigzag"] {
            let mut user = User::with(name);
            user.type_in(&format!("{keys}:goto 1.5\n<<C,,.G:goto 0.3\nG:goto 2.5\n"));
            let (told, listed) = (told(&user), log(&user));
            assert!(!told.is_empty(), "{name}");
            assert_eq!(listed.len(), told.len(), "{name} {keys}");
            assert!(listed.iter().zip(&told).all(|(logged, event)| logged.is(event)), "{name} {keys}: {listed:?}");
        }
    }
}

#[test]
fn what_happens_at_load_is_listed_at_once_and_not_twice_by_another_method() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rests.ron");
    let scene = "Scene(walls: [Wall(center: (0, 0, 0), s1: (4, 0, 0), s2: (0, 0, -4))], gravity: (0, -9.8, 0), \
                 solver: (method: exact), spheres: [Sphere(x: (0, 0.5, 0), mass: 1, radius: 0.5)])";
    std::fs::write(&path, scene).expect("a file");
    let mut user = User::with(path.to_str().expect("a plain path"));
    assert_eq!(log(&user).iter().map(|event| event.class).collect::<Vec<_>>(), [Class::Rest]);
    user.type_in("mmmm");
    assert_eq!((user.snapshot().method, log(&user).len()), ("exact", 1));
    user.type_in("..,,r");
    assert_eq!(log(&user).len(), 1);
}

#[test]
fn enter_goes_to_the_event_with_its_sphere_selected_and_its_card_open() {
    for (name, keys) in ["paper-3", "newtons-cradle"].iter().flat_map(|name| ["", "m", "mm", "mmm"].map(|m| (name, m)))
    {
        let mut user = User::with(name);
        user.type_in(&format!("{keys}:goto 3\n"));
        let all = log(&user);
        assert!(all.len() > 8, "{name} {keys}: {}", all.len());
        for (place, event) in all.iter().enumerate() {
            go_to(&mut user, place);
            if event.class == Class::Release || event.time == 0.0 {
                continue; // none of a frame's contacts: its rest is over, or it was before the first frame
            }
            let there = user.snapshot().contacts.iter().any(|contact| event.is(contact));
            assert!(there, "{name} {keys} {place}: {event:?} is not in {:?}", user.snapshot().contacts);
            let settings = user.app.view_settings();
            assert_eq!(settings.selected, Some(event.a as usize), "{name} {keys} {place}");
            let card = settings.card.expect("it is open");
            let order = carom::view::order(user.snapshot(), settings.selected);
            assert!(event.is(&user.snapshot().contacts[order[card.cursor]]), "{name} {keys} {place}");
        }
    }
}

/// Goes to the event of that place in the list, from 0.
fn go_to(user: &mut User, place: usize) {
    user.type_in("GL");
    let _ = user.press(Key::plain(Code::Home));
    for _ in 0..place {
        let _ = user.press(Key::plain(Code::Down));
    }
    user.type_in("\n");
    assert_eq!(user.app.report().activity, Activity::Paused);
}

#[test]
fn what_is_to_come_again_stays_in_the_list_until_it_is_dropped() {
    let mut user = User::with("paper-0");
    user.type_in("ccc");
    let first = log(&user)[0];
    user.type_in("L");
    let _ = user.press(Key::plain(Code::Home));
    user.type_in("\n");
    assert!(user.row(0).contains("BACK"), "{}", user.text());
    assert!(user.text().contains("sphere 0 hits wall 0.") && user.snapshot().t >= first.time, "{}", user.text());
    user.type_in("L");
    assert!(user.row(1).contains("1 of 3"), "the cursor is where one is: {}", user.text());
    assert_eq!(user.text().matches("collides").count(), 3, "{}", user.text());
    user.type_in("\x1bs");
    assert_eq!(log(&user), [first]);
    user.type_in("L");
    assert!(user.row(1).contains("1 of 1"), "{}", user.text());
}

#[test]
fn typing_narrows_the_list_and_says_what_cannot_be_typed() {
    let mut user = User::with("paper-3");
    user.type_in(":goto 5\nL");
    let all = log(&user);
    let of = |wanted: &dyn Fn(&Logged) -> bool| format!("of {} ", all.iter().filter(|event| wanted(event)).count());
    assert!(user.row(1).contains(&of(&|_| true)), "{}", user.text());
    user.type_in("wall 6");
    assert!(
        user.row(1).contains(&of(&|event| event.kind == carom::physics::Kind::Wall && event.b == 6)),
        "{}",
        user.row(1)
    );
    assert!(user.text().lines().skip(2).take(20).all(|row| !row.contains("collides") || row.contains("wall 6")));
    user.type_in(" x");
    assert!(user.row(1).contains("x is not allowed: a filter takes"), "{}", user.row(1));
    user.type_in("\x1b0 1");
    assert!(user.row(1).contains(&of(&|event| event.kind == carom::physics::Kind::Pair)), "{}", user.row(1));
    assert!(user.row(-1).contains("Esc show all"), "{}", user.row(-1));
    user.type_in("\n");
    let pair = user.snapshot().contacts.iter().any(|contact| (contact.a, contact.b) == (0, 1));
    assert!(pair, "Enter goes to the last one that is shown\n{}", user.text());
    user.type_in("L\x1b");
    assert!(user.text().contains("side"), "Esc closes\n{}", user.text());
}

#[test]
fn a_search_finds_what_it_waits_for_in_the_newest_frame_too() {
    for keys in ["", "m", "mm", "mmm"] {
        let mut user = User::with("paper-0");
        user.type_in(&format!("{keys}c"));
        let hash = user.snapshot().hash();
        user.type_in(",c");
        assert_eq!(user.snapshot().hash(), hash, "{keys}: {}", user.text());
    }
}

#[test]
fn collisions_asked_for_in_a_burst_are_gone_to_one_after_the_other() {
    for (name, keys) in
        [("paper-3", "cccc"), ("paper-3", "ccCcC"), ("galton", "cccccC"), ("paper-0", "ccCCCC"), ("paper-0", ".c.,c")]
    {
        let (mut slow, mut fast) = (User::with(name), User::with(name));
        slow.type_in(keys);
        for key in keys.chars() {
            let _ = fast.app.handle(Input::Key(Key::char(key)));
        }
        fast.settle();
        assert_eq!(
            fast.snapshot().hash(),
            slow.snapshot().hash(),
            "{name} {keys}: {} and {} s",
            fast.snapshot().t,
            slow.snapshot().t
        );
    }
}

#[test]
fn escape_gives_up_the_collisions_that_were_asked_for() {
    let mut user = User::with("galton");
    for _ in 0..900 {
        let _ = user.app.handle(Input::Key(Key::char('c')));
    }
    user.until("under way", |app| app.report().snapshot.t > 0.0);
    user.type_in("\x1b");
    let t = user.snapshot().t;
    user.type_in("v");
    assert_eq!(user.snapshot().t, t, "nothing goes on");
    assert!(user.row(0).contains("PAUSE"), "{}", user.row(0));
}

#[test]
fn what_collides_is_selected_and_an_open_card_turns_to_it() {
    let mut user = User::with("newtons-cradle");
    user.type_in("mmw");
    for key in ["c", "c", "c", "C", "c"] {
        user.type_in(key);
        let settings = user.app.view_settings();
        let (selected, card) = (settings.selected.expect("it is selected"), settings.card.expect("it is open"));
        let order = carom::view::order(user.snapshot(), Some(selected));
        let contact = user.snapshot().contacts[order[card.cursor]];
        assert_eq!(contact.class, Class::Collide, "{key}: {}", user.text());
        assert!([contact.a, contact.b].contains(&selected), "{key}: {contact:?}");
    }
    let mut user = User::with("paper-3");
    user.type_in("\t\tf");
    user.type_in("ccc");
    assert_eq!(user.app.view_settings().selected, Some(1), "a sphere that is followed stays selected");
}

#[test]
fn the_list_looks_as_stored() {
    let scene = stages::wedge();
    let mut log = EventLog::default();
    for (i, contact) in stages::pile().snapshot.contacts.iter().cycle().take(30).enumerate() {
        log.add(&Contact { time: 0.13 * i as f64, ..*contact });
    }
    let filter = EventFilter::read("rest coll").expect("it is one");
    let list = EventsView { log: &log, filter: &filter, typed: "rest coll", wrong: None, cursor: Some(20) };
    store("log", &Screen { popup: Popup::Events(list), ..scene.screen() });
}
