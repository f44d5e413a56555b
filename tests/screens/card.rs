//! The card of a contact: every number of it, against closed forms and what the method wrote down.

use std::sync::Arc;

use carom::{
    explain::{self, Card},
    physics::{Method, RestReason, Settings, Simulation, Until},
    scene,
    snapshot::{Class, Contact, Kind, Snapshot, Stage},
    view::CardView,
};
use glam::dvec3;

use super::{stages, store};

/// The text of a card's line.
fn line<'a>(card: &'a Card, label: &str) -> &'a str {
    let line = card.lines.iter().find(|line| line.label == label);
    line.map_or_else(|| panic!("no line {label} in {card:#?}"), |line| line.text.as_str())
}

/// The number before a unit, read from a text.
fn number(text: &str, unit: &str) -> f64 {
    let before = text.split(&format!(" {unit}")).next().expect("split gives a part");
    before.split([' ', '(']).next_back().and_then(|word| word.parse().ok()).unwrap_or_else(|| panic!("{text}"))
}

#[test]
fn the_card_of_an_impact_on_a_wall_can_be_checked_by_hand() {
    let mut scene = stages::wedge();
    stages::edit(&mut scene, |stage| stage.masses[0] = 2.0);
    let mut contact = stages::contact(Kind::Wall, 0, 6, Class::Collide);
    (contact.velocity, contact.normal) = (dvec3(3.0, -5.0, 4.0), dvec3(0.0, 1.0, 0.0));
    (contact.approach_speed, contact.separation_speed, contact.impulse) = (5.0, 4.0, 18.0);
    scene.snapshot.contacts = vec![contact];
    let card = explain::card(&scene.snapshot, 0, " - ").expect("there is one");
    assert_eq!(line(&card, "J"), "(1 + 0.8) × 2 kg × 5 m/s = 18 N s");
    assert_eq!((line(&card, "v_n"), line(&card, "v_t")), ("-5 → 4 m/s", "5 → 4.9 m/s"));
    // 2 kg (25 − 16) m²/s² / 2; and 2 kg (25 − 4.9²) m²/s² / 2.
    assert_eq!(line(&card, "lost"), "9 J along the normal, 0.99 J along the wall");
    assert_eq!(line(&card, "why"), "v_n = -5 m/s < −rest_speed = -0.1 m/s");
    assert_eq!(line(&card, "overlap"), "9.80e-4 of the radius ≤ tolerance + slack = 1e-3 + 1e-4: accepted");
    assert!(line(&card, "acts").contains("next frame"));
}

#[test]
fn the_card_of_an_impact_of_two_spheres_has_both_masses() {
    let mut scene = stages::pile();
    stages::edit(&mut scene, |stage| (stage.masses[0], stage.masses[1]) = (1.0, 3.0));
    let mut contact = stages::contact(Kind::Pair, 0, 1, Class::Collide);
    (contact.velocity, contact.normal) = (dvec3(-2.0, 0.0, 0.0), dvec3(1.0, 0.0, 0.0));
    (contact.approach_speed, contact.separation_speed, contact.impulse) = (2.0, 1.6, 2.7);
    scene.snapshot.contacts = vec![contact];
    (scene.snapshot.method, scene.snapshot.slack) = ("exact", None);
    let card = explain::card(&scene.snapshot, 0, " - ").expect("there is one");
    assert_eq!(line(&card, "J"), "(1 + 0.8) × 1/(1/1 + 1/3) kg × 2 m/s = 2.7 N s");
    // 0.75 kg (4 − 2.56) m²/s² / 2; pairs do not rub.
    assert_eq!(line(&card, "lost"), "0.54 J along the normal");
    assert!(card.lines.iter().all(|line| line.label != "acts"), "exact answers at once");
}

#[test]
fn a_resting_contact_says_why_and_what_it_carries() {
    let mut scene = stages::wedge();
    scene.snapshot.contacts = vec![stages::contact(Kind::Wall, 0, 6, Class::Rest)];
    (scene.snapshot.step, scene.snapshot.contacts[0].impulse) = (0.01, 0.098);
    scene.snapshot.contacts[0].approach_speed = 0.0;
    scene.snapshot.rest_reasons = vec![Some(RestReason::SeriesSummed)];
    let card = explain::card(&scene.snapshot, 0, " - ").expect("there is one");
    assert!(line(&card, "why").ends_with(RestReason::SeriesSummed.words()));
    assert_eq!(line(&card, "support"), "9.8 N, that is 0.098 N s in this frame of 0.01 s");
    assert_eq!(explain::card(&scene.snapshot, 1, " - "), None);
    // What begins to rest is stopped: 0.05 m/s of 1 kg; `paper` holds it in the same frame, `exact` from then on.
    (scene.snapshot.contacts[0].approach_speed, scene.snapshot.contacts[0].impulse) = (0.05, 0.148);
    scene.snapshot.rest_reasons = vec![None];
    let card = explain::card(&scene.snapshot, 0, " - ").expect("there is one");
    assert!(line(&card, "why").starts_with("|v_n| = 0.05 m/s ≤ rest_speed = 0.1 m/s"), "{card:#?}");
    assert_eq!(line(&card, "J"), "0.05 N s, which stop it");
    assert_eq!(line(&card, "support"), "9.8 N, that is 0.098 N s in this frame of 0.01 s");
    (scene.snapshot.method, scene.snapshot.slack) = ("exact", None);
    scene.snapshot.contacts[0].approach_speed = 5.0;
    let card = explain::card(&scene.snapshot, 0, " - ").expect("there is one");
    assert!(!line(&card, "why").contains("rest_speed"), "5 m/s are no slow approach: {card:#?}");
    assert_eq!(line(&card, "J"), "0.148 N s, which stop it");
}

/// The cards of all contacts of all frames up to a time.
fn cards(name: &str, settings: Settings, until: f64) -> (Vec<Card>, Simulation) {
    let opened = scene::open(name).expect("built in");
    let stage = Arc::new(Stage::of(&opened.key, &opened.scene));
    let mut run = Simulation::new(&opened.scene, settings);
    let mut cards = Vec::new();
    while run.time() < until {
        run.advance(Until::Frame, u64::MAX);
        let snapshot = Snapshot::of(&stage, &run, None);
        cards.extend((0..snapshot.contacts.len()).filter_map(|index| explain::card(&snapshot, index, " - ")));
    }
    (cards, run)
}

#[test]
fn the_energy_that_the_cards_say_is_lost_is_what_the_run_has_lost() {
    // Elastic but for walls and pairs that take some: nothing rests in these spans.
    for (name, until) in [("paper-2", 1.0), ("paper-3", 2.0), ("billiard", 2.0)] {
        let settings = Settings { method: Method::Exact, dt: 1e-3, tolerance: 1e-6 };
        let (cards, run) = cards(name, settings, until);
        let lost: f64 = cards.iter().filter(|card| card.class == Class::Collide).map(lost).sum();
        let gone = run.initial_energy() - run.energy();
        assert!(gone > 0.0 && (lost - gone).abs() <= 1e-3 * gone, "{name}: {lost} J on the cards, {gone} J gone");
    }
}

fn lost(card: &Card) -> f64 {
    let text = line(card, "lost");
    let (normal, along) = (number(text, "J along the normal"), text.split(", ").nth(1));
    normal + along.map_or(0.0, |text| number(text, "J along the wall"))
}

#[test]
fn the_formula_of_an_impact_is_the_laws_but_where_moreau_solves_a_frame_with_gravity() {
    for method in [Method::Paper, Method::Exact, Method::Moreau] {
        let (cards, _) = cards("paper-3", Settings { method, dt: 1e-2, tolerance: 1e-3 }, 3.0);
        let impacts: Vec<&Card> = cards.iter().filter(|card| card.class == Class::Collide).collect();
        assert!(impacts.len() >= 2, "{method:?}: {} impacts", impacts.len());
        let by_law = |card: &Card| line(card, "J").starts_with("(1 + 0.8)");
        for card in &impacts {
            // Gravity changes v_n at the floor by g dt in a frame: the law alone gives another J there.
            assert!(by_law(card) || method == Method::Moreau && card.bodies.contains("wall"), "{method:?}: {card:#?}");
            assert_eq!(card.lines.iter().any(|line| line.label == "lost"), by_law(card), "{card:#?}");
        }
        assert_eq!(impacts.iter().any(|card| !by_law(card)), method == Method::Moreau, "{method:?}");
    }
}

#[test]
fn a_trial_steps_degree_is_that_of_the_centres_that_are_shown_with_it() {
    let opened = scene::open("paper-0").expect("built in");
    let radius = opened.scene.spheres[0].radius;
    let stage = Arc::new(Stage::of(&opened.key, &opened.scene));
    // swept looks ahead, so that few of its trial steps fall into the frame of the impact
    for (method, rounding, fewest) in [(Method::Paper, 1e-12, 6), (Method::Swept, 1e-9, 1)] {
        let mut run = Simulation::new(&opened.scene, Settings { method, dt: 1e-2, tolerance: 1e-6 });
        let mut compared = 0;
        while run.time() < 3.0 {
            run.advance(Until::Frame, u64::MAX);
            let snapshot = Snapshot::of(&stage, &run, None);
            assert_eq!(snapshot.trials.len(), snapshot.probes.len());
            for (probe, trial) in snapshot.probes.iter().zip(&snapshot.trials) {
                // The floor at y = 0, and the wall at x = −5 m that it touches all the way down.
                let degrees = [trial[0].y, trial[0].x + 5.0].map(|distance| (radius - distance) / radius);
                let is = |degree: f64| (probe.degree - degree).abs() <= rounding * (1.0 + degree.abs());
                assert!(degrees.into_iter().any(is), "{method:?}: {probe:?} but {degrees:?}");
                compared += usize::from(probe.degree != 0.0);
            }
        }
        assert!(compared >= fewest, "{method:?}: {compared} trial steps");
    }
}

#[test]
fn the_polynomial_of_a_fall_is_that_of_the_closed_form() {
    // From 9.5 m with 0 m/s: gap 9 m − 4.9 m/s² τ², so that it touches at √(9/4.9) s.
    let opened = scene::open("paper-0").expect("built in");
    let stage = Arc::new(Stage::of(&opened.key, &opened.scene));
    let mut run = Simulation::new(&opened.scene, Settings { method: Method::Exact, dt: 1e-2, tolerance: 1e-3 });
    run.explain(true);
    while run.tallies().impacts == 0 {
        run.advance(Until::Frame, u64::MAX);
    }
    let snapshot = Snapshot::of(&stage, &run, None);
    let index = snapshot.contacts.iter().position(|contact| contact.class == Class::Collide).expect("an impact");
    let approach = snapshot.approaches[index].expect("it is kept");
    assert_eq!(approach.roots().len(), 1);
    assert!((approach.roots()[0] + approach.since - (9.0_f64 / 4.9).sqrt()).abs() < 1e-14, "{approach:?}");
    let card = explain::card(&snapshot, index, " - ").expect("there is one");
    assert_eq!(line(&card, "gap"), "the gap to its face: 9 − 4.9 τ² m, τ = t − 0 s");
    assert_eq!(line(&card, "roots"), "τ = 1.3553 s");
    assert!(line(&card, "chosen").starts_with("τ = 1.3553 s, the first root at which it falls"), "{card:#?}");
}

#[test]
fn every_impact_of_exact_is_a_root_of_its_polynomial_and_its_bodies_approach_there() {
    for (name, until) in [("billiard", 3.0), ("paper-3", 10.0), ("galton", 4.0), ("newtons-cradle", 3.0)] {
        let opened = scene::open(name).expect("built in");
        let mut run = Simulation::new(&opened.scene, Settings { method: Method::Exact, dt: 1e-2, tolerance: 1e-3 });
        run.explain(true);
        let mut impacts = 0;
        while run.time() < until {
            run.advance(Until::Frame, u64::MAX);
            let struck = run.contacts().iter().filter(|contact| contact.class == Class::Collide);
            for contact in struck {
                let approach = run.approaches().iter().find(|one| one.key == contact.key() && one.time == contact.time);
                let Some(approach) = approach else { continue }; // struck by an impact at the same instant
                let tau = approach.time - approach.since;
                let value = approach.polynomial.iter().rev().fold(0.0, |sum, c| sum * tau + c);
                // Of squares of metres: rounding of positions, and of a wall touched while the sphere slides.
                let is_root = value.abs() <= 1e-12 && approach.slope(tau) <= 1e-9;
                assert!(is_root, "{name}: {approach:?}, {value}");
                impacts += 1;
            }
        }
        assert!(impacts > 3, "{name}: {impacts}");
    }
}

#[test]
fn a_snapshot_finds_for_each_contact_the_first_approach_that_led_there() {
    let mut found = 0;
    for (name, until) in [("galton", 4.0), ("newtons-cradle", 2.0), ("elastic-666", 0.3)] {
        let opened = scene::open(name).expect("built in");
        let stage = Arc::new(Stage::of(name, &opened.scene));
        // frames of many impacts
        let mut run = Simulation::new(&opened.scene, Settings { method: Method::Exact, dt: 0.1, tolerance: 1e-3 });
        run.explain(true);
        while run.time() < until {
            run.advance(Until::Frame, u64::MAX);
            let led_to = |contact: &Contact| {
                run.approaches().iter().find(|one| one.key == contact.key() && one.time == contact.time).copied()
            };
            let expected: Vec<_> = run.contacts().iter().take(1000).map(led_to).collect();
            let snapshot = Snapshot::of(&stage, &run, None);
            assert_eq!(snapshot.approaches, expected, "{name}");
            found += expected.into_iter().flatten().count();
        }
    }
    assert!(found > 100, "{found}");
}

#[test]
fn a_card_looks_as_stored() {
    let mut scene = stages::wedge();
    scene.snapshot.contacts.push(stages::contact(Kind::Wall, 0, 0, Class::Rest));
    scene.view_settings.card = Some(CardView::default());
    store("card", &scene.screen());
}
