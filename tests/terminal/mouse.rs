//! Is the mouse reported when it is asked for, off at every way out, and harmless however it is reported?

use std::time::Duration;

use rustix::process::Signal;

use crate::{
    HINT, SHELL,
    pty::{Pty, Start, carom},
    time,
};

/// Switches reports on: buttons and motion while one is pressed, in the form without an end of columns.
const ON: &[u8] = b"\x1b[?1002h\x1b[?1006h";

/// A paused program that has the mouse reported.
fn with_mouse(arguments: &[&str]) -> Pty {
    let mut pty = carom(arguments).run();
    pty.until_text(HINT);
    assert!(pty.modes_left_on().iter().all(|mode| !matches!(mode, 1000..=1006)), "off by default");
    pty.send("%");
    pty.until_text("Mouse on");
    assert!(pty.modes_left_on().contains(&1002) && pty.modes_left_on().contains(&1006));
    pty
}

#[test]
fn it_is_off_at_first_and_off_again_with_its_key() {
    let mut pty = with_mouse(&["paper-2", "--paused"]);
    pty.send("%");
    pty.until_text("Mouse off");
    assert!(!pty.modes_left_on().iter().any(|mode| matches!(mode, 1002 | 1006)));
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn every_way_out_turns_it_off() {
    for (leave, code) in [("q", 0), ("\x03", 0), ("", 143), (":panic\r", 101), (":panic simulation\r", 1)] {
        if leave.contains("panic") && cfg!(not(debug_assertions)) {
            continue; // the release program has no such order
        }
        let mut pty = with_mouse(&["paper-2", "--paused"]);
        if leave.is_empty() {
            pty.signal(Signal::TERM);
        } else {
            pty.send(leave);
        }
        assert_eq!(pty.exit(), code, "{leave:?}");
        pty.assert_given_back();
    }
}

#[test]
fn stopped_it_is_off_and_continued_it_is_on_again() {
    let arguments = ["-c", SHELL, carom(&[]).program, "paper-1", "--paused"];
    let mut pty = Start { program: "bash", arguments: &arguments, ..carom(&[]) }.run();
    pty.until_text(HINT);
    pty.send("%");
    pty.until_text("Mouse on");
    pty.send("\x1a");
    pty.until_text("echoke"); // the last word of `stty -a`
    pty.assert_given_back();
    let from = pty.output.len();
    pty.send("\n");
    pty.until_bytes(from, ON);
    pty.send("q");
    pty.until_text("ended 0");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn reports_under_way_when_it_quits_are_not_typed_at_the_shell() {
    let arguments = ["-c", SHELL, carom(&[]).program, "paper-1", "--paused"];
    let mut pty = Start { program: "bash", arguments: &arguments, ..carom(&[]) }.run();
    pty.until_text(HINT);
    pty.send("%");
    pty.until_text("Mouse on");
    while pty.read(Duration::from_millis(200)).is_some() {} // all is answered
    pty.answers = false;
    pty.send("q");
    pty.until_bytes(0, b"\x1b[?1049l");
    pty.send("\x1b[<65;10;5M\x1b[<65;11;6M");
    pty.answer(1);
    pty.until_text("stopped 0");
    pty.until_text("echoke"); // the last word of `stty -a`
    assert!(!pty.text().contains("<65") && !pty.text().contains("5M"), "{}", pty.text());
    pty.send("\n");
    pty.until_text("ended");
    pty.exit();
}

#[test]
fn a_click_selects_however_its_report_is_torn() {
    // The sphere of `paper-0` hangs in the upper left corner of both views.
    let mut pty = with_mouse(&["paper-0", "--paused"]);
    for byte in "\x1b[<0;4;5M\x1b[<0;4;5m".bytes() {
        pty.send_bytes(&[byte]);
    }
    pty.until_text("Sphere 0 is selected");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn a_click_on_the_timeline_goes_to_its_time() {
    let mut pty = with_mouse(&["paper-0", "--paused"]);
    pty.send("\x1b[<0;30;23M\x1b[<0;30;23m");
    pty.until("the time", |screen| time(screen).is_some_and(|t| (8.0..12.0).contains(&t)));
    pty.send("\x1b[<0;4;23M\x1b[<0;4;23m");
    pty.until("the start", |screen| time(screen) == Some(0.0));
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn hostile_reports_freeze_and_end_nothing() {
    let mut pty = with_mouse(&["paper-0", "--paused"]);
    let places = ["0;0", "1;1", "65535;65535", "65536;65536", "99999999999999999999;1", "1;4294967296", "-1;-1", ";"];
    for button in ["0", "32", "64", "65", "35", "255", "4294967295", ""] {
        for place in places {
            for end in ["M", "m", ";1M", ""] {
                pty.send(&format!("\x1b[<{button};{place}{end}"));
            }
        }
    }
    pty.send("\x1b[M\u{7f}\u{7f}\u{7f}\x1b[<0;1;1");
    while pty.read(Duration::from_millis(200)).is_some() {} // longer than a torn sequence is waited for
    pty.send("?");
    pty.until_text("Esc closes");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn a_flood_of_motion_is_no_typing() {
    let mut pty = with_mouse(&["box-gas", "--paused"]);
    let motion = (0..20_000).map(|i| format!("\x1b[<32;{};{}M", 10 + i % 20, 5 + i % 10));
    pty.send(&("\x1b[<0;10;5M".to_owned() + &motion.collect::<String>()));
    pty.send("?");
    pty.until_text("Esc closes");
    assert!(!pty.text().contains("left out"), "{}", pty.text());
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}
