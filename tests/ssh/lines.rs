//! Does a thin or a long line leave the program quick? Counters and texts decide; the bounds of time are ten times what is
//! aimed at and only end a test that has failed.

use std::time::Duration;

use crate::{
    CAROM,
    screen::Screen,
    server::{Server, tool},
    wire::{LONG, THIN, THINNEST, Wire, timed},
};

/// The running scene at the far end of a line.
fn running(server: &Server, wire: Wire, size: (u16, u16)) -> Screen {
    let arguments = server.arguments(wire.lay(server.port()), &format!("exec {CAROM} box-gas"));
    let mut screen = Screen::start(&tool("ssh"), &arguments, size);
    screen.wait_for("first frame", |shown| shown.contains("box-gas") && shown.contains("help"));
    screen
}

/// Shows so many pictures.
fn show(screen: &mut Screen, pictures: usize) {
    let last = screen.complete + pictures;
    while screen.complete < last {
        assert_eq!(screen.read(Duration::from_secs(30)), Ok(()), "no picture came:\n{}", screen.text());
    }
}

/// Every key is answered by the next picture but so many, and in time; `q` ends it.
fn answers_keys(wire: Wire, size: (u16, u16), ahead: usize, target: Duration) {
    let server = Server::start();
    let mut screen = running(&server, wire, size);
    for _ in 0..3 {
        show(&mut screen, 5);
        let before = screen.begun;
        screen.press("?");
        let (_, time) = timed(|| screen.wait_for("help", |shown| shown.contains("Esc closes")));
        let pictures = screen.begun - before;
        assert!(pictures <= ahead + 1, "{pictures} pictures until the answer");
        assert!(time <= 10 * target, "{time:?}");
        screen.press("?");
        screen.wait_for("scene", |shown| !shown.contains("Esc closes"));
    }
    screen.press("q");
    let (code, time) = timed(|| screen.end());
    assert_eq!(code, 0);
    assert!(time <= 10 * (wire.trip + Duration::from_millis(100)), "{time:?}");
}

#[test]
fn on_256_kilobits_a_key_is_answered_before_all_but_the_picture_under_way() {
    answers_keys(THIN, (80, 24), 2, Duration::from_millis(400));
}

#[test]
fn on_256_kilobits_so_it_is_on_a_large_screen() {
    answers_keys(THIN, (120, 40), 2, Duration::from_millis(400));
}

#[test]
fn on_64_kilobits_too() {
    answers_keys(THINNEST, (80, 24), 2, Duration::from_millis(1200));
}

#[test]
fn on_a_fast_and_long_line_pictures_are_under_way_and_keys_do_not_wait_for_them() {
    // Three under way each way, and what was drawn while the key travelled.
    answers_keys(LONG, (80, 24), 7, Duration::from_millis(130));
}

/// The reader looks away for ten seconds; then so many pictures of long ago come, and a word about it.
fn is_current_after_a_stall(wire: Wire, most: usize) {
    let server = Server::start();
    let mut screen = running(&server, wire, (80, 24));
    show(&mut screen, 10);
    let before = screen.begun;
    screen.look_away(Duration::from_secs(10));
    screen.wait_for("word about it", |shown| shown.contains("The line was silent for"));
    let stale = screen.begun - before - 1; // the last is the one that tells
    assert!(stale <= most, "{stale} pictures of long ago");
    screen.press("q");
    assert_eq!(screen.end(), 0);
}

#[test]
fn after_a_stall_on_256_kilobits_two_pictures_are_stale_at_most() {
    is_current_after_a_stall(THIN, 2);
}

#[test]
fn after_a_stall_on_64_kilobits_two_pictures_are_stale_at_most() {
    is_current_after_a_stall(THINNEST, 2);
}

#[test]
fn after_a_stall_on_a_fast_and_long_line_what_a_round_trip_holds_is_stale() {
    // 25 pictures a second and 100 ms: three are under way at any time.
    is_current_after_a_stall(LONG, 3);
}
