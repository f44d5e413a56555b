//! What the watch over a run has found wrong is on the screen.

use carom::audit::{Bodies, Fault, Finding};

use super::{stages, text};

#[test]
fn an_alarm_says_what_when_and_which_bodies_at_every_size() {
    let mut scene = stages::wedge();
    scene.snapshot.alarm.overlap = Some(Finding {
        fault: Fault::Overlap,
        time: 1.25,
        bodies: Bodies::Wall(0, 6),
        value: 0.316,
        bound: 1e-9,
        times: 3,
    });
    for (width, height) in [(30, 8), (40, 12), (60, 16), (80, 24), (120, 40), (200, 60)] {
        let frame = text(&scene, width, height);
        let words: Vec<&str> = frame.split_whitespace().collect();
        assert!(words.contains(&"ALARM") && words.contains(&"1.25"), "{width}x{height}:\n{frame}");
        assert!(frame.contains("wall") && words.contains(&"overlap"), "{width}x{height}:\n{frame}");
    }
    assert!(!text(&stages::wedge(), 80, 24).contains("ALARM"));
}
