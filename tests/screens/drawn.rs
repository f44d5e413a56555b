//! Are paths, impulses and forces drawn where and as long as they should be, each by itself?

use std::sync::Arc;

use carom::{
    snapshot::{Ahead, Class, Kind},
    view::{Overlays, Screen},
};
use glam::{DVec3, dvec3};

use super::{app::User, stages, store, text};

/// What the keys have led to, in one line.
fn said(user: &User) -> String {
    user.text().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn overlays_are_shown_and_hidden_by_name_and_combined() {
    let mut user = User::with("paper-0");
    user.type_in("c:show impulses normals\n");
    assert!(said(&user).contains("Shown: contacts, normals, impulses."), "{}", user.text());
    let shown = user.screen.clone();
    user.type_in(":hide normals contacts\n");
    assert!(said(&user).contains("Shown: impulses."), "{}", user.text());
    assert_ne!(user.screen, shown);
    user.type_in("d");
    let overlays = user.app.view_settings().overlays;
    assert!(overlays.impulses && overlays.contacts, "the key leaves what it has not in its round: {overlays:?}");
    user.type_in(":hide all\n");
    assert_eq!(user.app.view_settings().overlays, Overlays::default());
    user.type_in(":show wings\n");
    assert!(
        said(&user).contains("wings is not allowed: :show takes contacts, normals, velocities, ids, impulses"),
        "{}",
        user.text()
    );
    user.type_in(":show\n");
    assert!(said(&user).contains(":show needs what to show"), "{}", user.text());
    user.type_in(":sho\timp\tforc\t\n");
    assert!(said(&user).contains("Shown: impulses, forces."), "{}", user.text());
}

/// The side view's rows of dots in the column of the first sphere's centre, over it.
fn rows_above(screen: &Screen) -> usize {
    let buffer = super::draw(screen, 80, 24);
    let marked = |y: u16| buffer[(20, y)].symbol() != " " && buffer[(20, y)].symbol() != "\u{2800}";
    (3..22).filter(|y| marked(*y)).count()
}

/// A sphere over the middle of the floor, one contact with it.
fn struck(class: Class, impulse: f64) -> stages::Scene {
    let mut scene = stages::scene("struck", &[(dvec3(0.0, 0.5, 0.0), DVec3::ZERO)]);
    let contact = stages::contact(Kind::Wall, 0, 0, class);
    let point = DVec3::ZERO;
    scene.snapshot.contacts =
        vec![carom::snapshot::Contact { point, normal: DVec3::Y, impulse, approach_speed: 0.0, ..contact }];
    scene.snapshot.step = 0.01;
    scene
}

#[test]
fn an_impulse_is_as_long_as_the_scale_says() {
    // the view is 10.4 m wide, so that no arrow is longer than 2.08 m; 2 m are 15 dots, or 4 rows
    for (impulse, scale, rows) in [(2.0, "J 1 N s/m", 3..=5), (1.0, "J 0.5 N s/m", 3..=5), (5.0, "J 5 N s/m", 1..=3)] {
        let mut scene = struck(Class::Collide, impulse);
        let without = rows_above(&scene.screen());
        scene.view_settings.overlays = Overlays { impulses: true, contacts: true, ..Overlays::default() };
        assert!(text(&scene, 80, 24).contains(scale), "{impulse}\n{}", text(&scene, 80, 24));
        let more = rows_above(&scene.screen()) - without;
        assert!(rows.contains(&more), "{impulse} N s: {more} rows\n{}", text(&scene, 80, 24));
        scene.view_settings.overlays = Overlays { forces: true, ..Overlays::default() };
        assert!(!text(&scene, 80, 24).contains("N/m"), "an impact has no support force");
    }
}

#[test]
fn a_support_force_is_the_impulse_of_the_frame_over_its_length() {
    let mut scene = struck(Class::Rest, 0.098); // 9.8 N for 0.01 s
    scene.view_settings.overlays = Overlays { forces: true, ..Overlays::default() };
    assert!(text(&scene, 80, 24).contains("F 5 N/m"), "{}", text(&scene, 80, 24));
    let force = carom::explain::support_force(&scene.snapshot, &scene.snapshot.contacts[0]).expect("it rests");
    assert!((force - 9.8).abs() < 1e-12, "{force}");
    scene.snapshot.contacts[0].approach_speed = 0.05; // 1 kg: 0.05 N s of it have stopped the sphere
    let force = carom::explain::support_force(&scene.snapshot, &scene.snapshot.contacts[0]).expect("it rests");
    assert!((force - 4.8).abs() < 1e-12, "{force}");
}

/// Two views beside each other leave 39 columns: the bar of lengths goes before the scales of what is drawn.
#[test]
fn arrows_are_never_without_their_scale() {
    let mut scene = struck(Class::Rest, 0.098);
    scene.snapshot.v = vec![DVec3::X];
    for zoom in [1.0, 1.5] {
        scene.view_settings.zoom = zoom;
        scene.view_settings.overlays = Overlays { forces: true, velocities: true, ..Overlays::default() };
        let shown = text(&scene, 80, 24);
        let label = shown.lines().nth(1).expect("the views' labels");
        assert!(label.contains("N/m") && label.contains(" s "), "{zoom}\n{shown}");
    }
}

#[test]
fn the_trail_is_that_of_the_last_frames_forwards_and_backwards() {
    for keys in ["", "m", "mm", "mmm"] {
        let mut user = User::with("paper-3");
        user.type_in(&format!("{keys}:show path\n"));
        let mut seen = vec![user.snapshot().x.clone()];
        for _ in 0..60 {
            user.type_in(".");
            seen.push(user.snapshot().x.clone());
        }
        let trail =
            |user: &User| -> Vec<Vec<DVec3>> { user.app.report().trail.iter().map(|x| (**x).clone()).collect() };
        assert_eq!(trail(&user), seen, "{keys}");
        user.type_in("<,");
        assert_eq!(trail(&user), seen[..50], "{keys}");
        user.type_in("s");
        user.type_in(".");
        assert_eq!(trail(&user).len(), 51, "{keys}: what came later is gone");
        assert_eq!(trail(&user).last(), Some(&user.snapshot().x));
        user.type_in(":goto 2\n");
        assert!(trail(&user).len() > 100, "every frame is in it, however fast it went");
        user.type_in(":hide path\n");
        assert!(user.app.report().trail.is_empty());
    }
}

#[test]
fn what_is_predicted_of_the_selected_sphere_comes() {
    for keys in ["", "m", "mm", "mmm"] {
        for name in ["paper-3", "paper-4", "zigzag"] {
            let mut user = User::with(name);
            user.type_in(&format!("{keys}:goto 0.3\n:select 1\n:select 0\n:show predicted\n"));
            for _ in 0..3 {
                user.until("foreseen", |app| app.report().ahead.is_some());
                let ahead = user.app.report().ahead.clone().expect("it is known");
                assert_eq!((ahead.sphere, ahead.path[0]), (0, user.snapshot().x[0]), "{name} {keys}");
                user.type_in(":until collision 0\n");
                let contact = ahead.contact.expect("it has one");
                if contact.class == Class::Rest {
                    break; // `:until` waits for impacts
                }
                let came = user.snapshot().contacts.contains(&contact);
                assert!(came, "{name} {keys}: {contact:?} is not in {:?}", user.snapshot().contacts);
            }
        }
    }
}

#[test]
fn numbers_do_not_stand_in_each_others_way_and_the_selected_one_is_always_there() {
    let mut scene = stages::gas(60);
    scene.view_settings.overlays = Overlays { ids: true, ..Overlays::default() };
    for selected in [0, 17, 59] {
        scene.view_settings.selected = Some(selected);
        let frame = text(&scene, 80, 24);
        assert_eq!(frame.matches(&format!("#{selected}")).count(), 2, "in both views\n{frame}");
        let numbers = frame.split(|c: char| !c.is_ascii_digit()).filter(|word| !word.is_empty());
        let wrong: Vec<&str> = numbers.filter(|word| word.len() > 4 && !frame.contains(&format!("{word} "))).collect();
        assert!(wrong.is_empty(), "{wrong:?}\n{frame}");
    }
}

#[test]
fn paths_impulses_and_forces_look_as_stored() {
    let mut scene = stages::pile();
    scene.view_settings.selected = Some(0);
    scene.view_settings.overlays =
        Overlays { contacts: true, impulses: true, forces: true, path: true, predicted: true, ..Overlays::default() };
    let at = |k: i32| -> Vec<DVec3> {
        let t = f64::from(k) * 0.05;
        scene.snapshot.x.iter().map(|x| *x + dvec3(-1.5 * t, 3.0 * t - 0.5 * t * t, 0.8 * t)).collect()
    };
    let trail: Vec<Arc<Vec<DVec3>>> = (0..30).rev().map(|k| Arc::new(at(k))).collect();
    let path = (0..20).map(|k| scene.snapshot.x[0] + dvec3(0.15, 0.0, -0.05) * f64::from(k)).collect();
    let ahead = Ahead { sphere: 0, path, contact: None, until: 4.0 };
    store("drawn", &Screen { trail: &trail, ahead: Some(&ahead), ..scene.screen() });
}

#[test]
fn in_a_heap_only_the_largest_forces_are_drawn_or_those_near_the_selected_sphere() {
    let mut user = User::with("inelastic-666");
    user.type_in(":goto 3\n:show forces\n"); // by moreau
    let (label, crowd) = (user.row(1), user.screen.clone());
    let resting = user.snapshot().contacts.iter().filter(|contact| contact.class == Class::Rest).count();
    assert!(resting > 100 && label.contains(" N/m top "), "{resting}: {label}");
    user.type_in(":select 100\n");
    assert!(user.row(1).contains(" at #100"), "{}", user.text());
    assert_ne!(user.screen, crowd);
}
