//! Does the inspector tell of the selected sphere what can be checked by hand?

use std::sync::Arc;

use carom::{
    frame,
    physics::Simulation,
    scene,
    snapshot::{Class, Snapshot, Stage},
};
use ratatui::{buffer::Buffer, layout::Rect};

use super::{app::User, stages};

/// The screen at 140×50, where the inspector has room for all.
fn wide(user: &mut User) -> String {
    user.screen = Buffer::empty(Rect::new(0, 0, 140, 50));
    user.look();
    user.type_in(":select 0\n"); // asked for with the inspector in view
    user.until("foreseen", |app| app.report().ahead.is_some());
    frame::text(&user.screen)
}

/// The numbers of the first row that holds a label, of those behind it.
fn numbers(text: &str, label: &str) -> Vec<f64> {
    let row = text.lines().find_map(|row| row.split_once(label)).unwrap_or_else(|| panic!("no {label} in\n{text}")).1;
    row.split_whitespace().filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn a_falling_sphere_has_weight_momentum_and_energy_and_its_next_contact_is_known() {
    let mut user = User::with("paper-0");
    user.type_in("mm:goto 0.5\n"); // exact: from y = 9.5 m at rest, 1 kg
    let text = wide(&mut user);
    let (t, g) = (user.snapshot().t, 9.8);
    let near =
        |numbers: Vec<f64>, value: f64| assert!((numbers[0] - value).abs() < 1e-4, "{value}: {numbers:?}\n{text}");
    near(numbers(&text, "momentum "), g * t);
    near(numbers(&text, "kinetic "), 0.5 * g * t * g * t);
    near(numbers(&text, "potential "), g * (9.5 - 0.5 * g * t * t));
    assert_eq!(numbers(&text, "gravity "), [0.0, -g, 0.0], "{text}");
    // √(2 · 9 / 9.8) s = 1.35526 s
    assert!(text.contains("next  collides, wall 0, 1.35526 s"), "{text}");
    assert!(text.contains("last  -"), "{text}");
    assert!(text.contains("leaves out") && text.contains("pairs"), "{text}");
}

#[test]
fn a_sphere_at_rest_is_held_by_what_it_lies_on() {
    let mut user = User::with("paper-0");
    user.type_in("mm:until rest\n..");
    let text = wide(&mut user);
    assert!(user.snapshot().contacts.iter().any(|contact| contact.class == Class::Rest));
    assert_eq!(numbers(&text, " wall 0 "), [0.0, 9.8, 0.0], "{text}");
    assert!(text.contains("last  rests, wall 0, 12.11"), "{text}");
    assert!(text.contains("next  nothing until "), "{text}");
    user.type_in("C,");
    let text = wide(&mut user);
    assert!(text.contains("last  collides, wall 0, ") && text.contains("next  collides, wall 0, "), "{text}");
}

/// The chart of a scene by its own method at a time, 120×40.
fn chart(name: &str, until: f64) -> Buffer {
    let opened = scene::open(name).expect("built in");
    let mut run = Simulation::new(&opened.scene, opened.scene.solver);
    run.run_to(until, |_| Some(Simulation::SLICE));
    let stage = Arc::new(Stage::of(&opened.key, &opened.scene));
    let scene = stages::Scene { snapshot: Snapshot::of(&stage, &run, None), ..stages::drop() };
    super::draw(&scene.screen(), 120, 40)
}

#[test]
fn a_gas_shows_its_speeds_beside_maxwells() {
    let gas = frame::text(&chart("box-gas", 0.5));
    assert!(gas.contains("speeds  line: Maxwell's"), "{gas}");
    let heap = frame::text(&chart("zigzag", 15.0));
    assert!(!heap.contains("places"), "five balls make no chart\n{heap}");
}

#[test]
fn a_galton_board_ends_as_a_bell_that_the_inspector_counts_by_bins() {
    let opened = scene::open("galton").expect("built in");
    let mut run = Simulation::new(&opened.scene, opened.scene.solver);
    run.run_to(opened.scene.duration, |_| Some(Simulation::SLICE));
    let state = run.state();
    // seven bins of half a metre, 2 m high
    let mut bins = [0_usize; 7];
    for x in &state.x {
        assert!(x.y < 2.0, "a ball is on its way: {x}");
        bins[((x.x + 1.75) / 0.5) as usize] += 1;
    }
    let count: usize = bins.iter().sum();
    let n = opened.scene.spheres.len();
    let most = (0..7).max_by_key(|bin| bins[*bin]).expect("seven");
    assert_eq!(count, n);
    assert!(bins[..=most].is_sorted() && bins[most..].iter().rev().is_sorted(), "one hill: {bins:?}");
    // The mean of n places has a standard error of σ/√n; three of them from the middle are a board that is not straight.
    let mean = bins.iter().enumerate().map(|(bin, count)| bin as f64 * *count as f64).sum::<f64>() / n as f64;
    let square = |(bin, count): (usize, &usize)| (bin as f64 - mean) * (bin as f64 - mean) * *count as f64;
    let variance = bins.iter().enumerate().map(square).sum::<f64>() / n as f64;
    assert!((mean - 3.0).abs() < 3.0 * (variance / n as f64).sqrt(), "{bins:?}: mean {mean}");
    assert!(variance < 4.0, "seven bins alike have 4: {bins:?}: {variance}");
    let stage = Arc::new(Stage::of(&opened.key, &opened.scene));
    let scene = stages::Scene { snapshot: Snapshot::of(&stage, &run, None), ..stages::drop() };
    let text = frame::text(&super::draw(&scene.screen(), 120, 40));
    let told = bins.map(|count| count.to_string()).join(" ");
    assert!(text.contains(&format!("bins  {told}\n")), "{told}\n{text}");
}
