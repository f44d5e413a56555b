//! Does the comparison with the exact run say what it knows, and no more?

use carom::snapshot::Ghost;

use super::{
    stages::{self, Scene},
    text,
};

/// The rows of the comparison at 80×24.
fn comparison(change: impl FnOnce(&mut Scene)) -> String {
    let mut scene = stages::strayed();
    change(&mut scene);
    text(&scene, 80, 24).lines().skip(16).take(6).map(|line| line.to_owned() + "\n").collect()
}

fn ghost(scene: &mut Scene) -> &mut Ghost {
    scene.comparison.as_mut().and_then(|(ghost, _)| ghost.as_mut()).expect("there is one")
}

#[test]
fn the_comparison_says_whose_error_it_is_and_when_it_was() {
    let plain = comparison(|_| ());
    assert!(plain.contains("t  3.457 s  0.05 s behind"), "{plain}");
    assert!(plain.contains("#0 selected, off by 6.71e-1 m"), "{plain}"); // √(0.3² + 0.6²)
    let none = comparison(|scene| scene.view_settings.selected = None);
    assert!(none.contains("#0 is furthest off, by 6.71e-1 m"), "{none}");
    let level = comparison(|scene| ghost(scene).t = scene.snapshot.t);
    assert!(!level.contains("behind"), "{level}");
}

#[test]
fn past_the_horizon_no_error_is_shown() {
    let past = comparison(|scene| ghost(scene).horizon = Some(2.5));
    assert!(past.contains("past this scene's horizon of 2.5 s: positions mean nothing"), "{past}");
    assert!(!past.contains("off by"), "{past}");
    let before = comparison(|scene| ghost(scene).horizon = Some(7.5));
    assert!(!before.contains("horizon"), "{before}");
}

#[test]
fn an_exact_run_that_stops_says_why_and_one_that_has_not_come_yet_says_so() {
    let stopped = comparison(|scene| ghost(scene).stall = Some("Too many events.".into()));
    assert!(stopped.contains("exact run stops: Too many events."), "{stopped}");
    let none = comparison(|scene| scene.comparison.as_mut().expect("there is one").0 = None);
    assert!(none.contains("exact run on its way"), "{none}");
}
