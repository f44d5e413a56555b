//! The numbers that three independent codes found for the paper's scenes. Closed forms: `exact_laws`; bits, symmetry and
//! conservation: `exact_repeat`.

use crate::support::paper_scene;
use carom::physics::{Class, Contact, Method, Progress, Scene, Settings, Simulation, Until};

const EXACT: Settings = Settings { method: Method::Exact, dt: 0.01, tolerance: 1e-3 };

/// Runs to `until` (s) and returns the run with all its events.
fn run(scene: &Scene, until: f64) -> (Simulation, Vec<Contact>) {
    let mut run = Simulation::new(scene, Settings { dt: 1.0, ..EXACT });
    run.record_events(true);
    let progress = run.advance(Until::Time(until), u64::MAX);
    assert_eq!(progress, Progress::Reached, "at {}", run.time());
    let events = run.take_events().into_iter().filter(|e| e.time <= until).collect();
    (run, events)
}

fn impacts(events: &[Contact]) -> Vec<Contact> {
    events.iter().filter(|e| e.class == Class::Collide).copied().collect()
}

#[test]
fn the_papers_scenes_end_as_three_independent_codes_found() {
    let expected = [
        (22, 12.097_356_014_9, 4.9),
        (56, 15.445_750_111, 5.526_971_042),
        (163, 17.877_133_170, 56.812_120_545),
        (91, 16.973_8, 9.836_084),
    ];
    for (k, (count, last, energy)) in expected.into_iter().enumerate() {
        let scene = paper_scene(k);
        let (run, events) = run(&scene, 20.0);
        let impacts = impacts(&events);
        let state = run.at(20.0);
        assert_eq!(impacts.len(), count, "paper-{k}");
        // the cited digits, no more: half a unit of the last one
        let digits = if k == 3 { 5e-5 } else { 1e-9 };
        assert!((impacts[count - 1].time - last).abs() < digits, "paper-{k}: {:?}", impacts.last());
        let found = state.energy(run.model());
        assert!((found - energy).abs() < 1e-6, "paper-{k}: {found}");
    }
}
