//! Does the built program treat a real terminal well? Each test runs it in a pseudo-terminal of its own.

#[path = "terminal/bounds.rs"]
mod bounds;
#[path = "terminal/config.rs"]
mod config;
#[path = "terminal/detection.rs"]
mod detection;
#[path = "terminal/dumb.rs"]
mod dumb;
#[path = "terminal/input.rs"]
mod input;
#[path = "terminal/mouse.rs"]
mod mouse;
#[path = "terminal/pacing.rs"]
mod pacing;
#[allow(dead_code)] // each test crate uses what it needs
#[path = "support/pty.rs"]
mod pty;
#[path = "support/random.rs"]
mod random;
#[path = "support/watch.rs"]
mod watch;

use std::time::Duration;

use pty::{Pty, Start, carom};
use rustix::process::Signal;

/// A word that every complete first frame shows in its last row.
const HINT: &str = "space pause";

/// A paused program with its first frame on the screen, and the modes its terminal had before.
fn paused() -> Pty {
    let mut pty = carom(&["paper-1", "--paused"]).run();
    pty.until_text(HINT);
    pty
}

fn running() -> Pty {
    let mut pty = carom(&["paper-0"]).run();
    pty.until_text(HINT);
    pty
}

/// Simulated time on the status line, s.
fn time(screen: &vt100::Screen) -> Option<f64> {
    let contents = screen.contents();
    let mut words = contents.lines().next()?.split_whitespace().skip_while(|word| *word != "t");
    words.nth(1)?.parse().ok()
}

#[test]
fn the_first_frame_shows_the_scene_and_quitting_gives_the_terminal_back() {
    let start = carom(&["paper-1", "--paused"]);
    let mut shell = Start { program: "sh", arguments: &["-c", "read line"], ..start }.run();
    let before = shell.modes();
    shell.send("\r");
    assert_eq!(shell.exit(), 0);
    let mut pty = paused();
    let status = pty.text().lines().next().unwrap_or_default().to_owned();
    assert!(status.contains("PAUSE") && status.contains("paper-1"), "{status}");
    assert_ne!(pty.modes(), before, "raw mode is on");
    assert!(pty.screen().alternate_screen() && pty.screen().hide_cursor());
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
    assert_eq!(pty.modes(), before);
}

#[test]
fn keys_work_and_the_cursor_shows_where_text_is_typed() {
    let mut pty = paused();
    pty.send("?");
    pty.until_text("Esc closes");
    pty.send("\x1b");
    pty.until("the help closed", |screen| !screen.contents().contains("Esc closes"));
    pty.send(":dt 1e-4");
    pty.until("the prompt", |screen| screen.contents().contains(":dt 1e-4") && !screen.hide_cursor());
    assert_eq!(pty.screen().cursor_position(), (23, 8));
    pty.send("\r");
    pty.until("the new dt", |screen| screen.contents().contains("dt 1e-4") && screen.hide_cursor());
    pty.send("]");
    pty.until_text("paper-2");
    pty.send(" ");
    pty.until("the run", |screen| time(screen).is_some_and(|t| t > 0.0));
    pty.send("\x03");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn signals_end_it_with_their_code_and_a_clean_terminal() {
    for (signal, code) in [(Signal::TERM, 143), (Signal::INT, 130), (Signal::HUP, 129), (Signal::QUIT, 131)] {
        for arguments in [&["paper-0"][..], &["paper-0", "--paused"]] {
            let mut pty = carom(arguments).run();
            pty.until_text(HINT);
            pty.signal(signal);
            assert_eq!(pty.exit(), code, "{signal:?}");
            pty.assert_given_back();
        }
    }
}

#[test]
fn a_signal_ends_a_recording_under_way_and_keeps_it() {
    for (signal, code) in [(Signal::TERM, 143), (Signal::HUP, 129)] {
        let mut pty = carom(&["paper-0", "--paused"]).run();
        pty.until_text(HINT);
        pty.send("E...");
        pty.until_text("REC");
        pty.until("three frames", |screen| time(screen).is_some_and(|t| t >= 0.03));
        pty.signal(signal);
        assert_eq!(pty.exit(), code);
        let recording = pty.folder().join("paper-0-1.carom");
        let bytes = std::fs::read(&recording).unwrap_or_else(|error| panic!("{}: {error}", recording.display()));
        assert_eq!(carom::recording::Recording::from_bytes(&bytes).expect("whole").frames.len(), 4);
    }
}

#[test]
fn what_a_newcomer_sees_first_is_a_collision_taken_apart() {
    let mut pty = carom(&[]).run();
    pty.until_text("A collision taken apart");
    pty.until_text("collides");
    pty.until_text("J       (1 + 0.96)");
    pty.send(" ");
    pty.until("the run", |screen| screen.contents().contains("RUN"));
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn a_hang_up_that_is_ignored_at_the_start_stays_ignored() {
    let start = carom(&["-c", r#"trap "" HUP; exec "$0" paper-1 --paused"#, env!("CARGO_BIN_EXE_carom")]);
    let mut pty = Start { program: "sh", ..start }.run();
    pty.until_text(HINT);
    pty.signal(Signal::HUP);
    pty.send("?");
    pty.until_text("Esc closes");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn it_ends_with_its_terminal() {
    assert_eq!(running().hang_up(), 129);
}

#[test]
fn it_draws_at_every_size_and_survives_a_storm_of_them() {
    let mut pty = paused();
    let sizes = [(1, 1), (2, 1), (1, 40), (11, 2), (12, 3), (29, 7), (30, 8), (59, 15), (60, 16), (110, 30), (300, 90)];
    for (cols, rows) in sizes {
        let from = pty.output.len();
        pty.resize(cols, rows);
        pty.until_bytes(from, b"\x1b[2J");
    }
    for i in 0..40 {
        pty.resize(80 + i, 24 + i);
    }
    pty.resize(80, 24);
    pty.send("?");
    pty.until("the help on 80x24", |screen| screen.contents().contains("Esc closes"));
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn a_paused_program_writes_nothing() {
    let mut pty = paused();
    while pty.read(Duration::from_millis(200)).is_some() {}
    assert_eq!(pty.read(Duration::from_millis(700)), None);
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn a_terminal_that_takes_nothing_stops_neither_the_run_nor_its_end() {
    let mut pty = Start { size: (300, 90), ..carom(&["bouncing-49"]) }.run();
    pty.until_text(HINT);
    let before = time(pty.screen()).expect("a time is shown");
    let from = pty.output.len();
    // Pictures of this size fill a pseudo-terminal (18 KB on Linux) within the first of these seconds.
    assert_eq!(pty.look_away(Duration::from_secs(3)), None);
    // Slow machines may run this scene slower than the wall, but not that much slower.
    pty.until("the run having gone on", |screen| time(screen).is_some_and(|t| t > before + 0.3));
    let replayed = pty.output[from..].windows(8).filter(|bytes| *bytes == b"\x1b[?2026h").count();
    assert!(replayed < 45, "of 90 pictures due in 3 s {replayed} were replayed");
    assert_eq!(pty.look_away(Duration::from_secs(1)), None);
    pty.signal(Signal::TERM);
    assert_eq!(pty.look_away(pty::PATIENCE), Some(143), "it does not wait for a reader");
}

#[test]
fn torn_unknown_and_unasked_sequences_freeze_nothing() {
    for noise in
        ["\x1b[", "\x1b[?2026;2$y", "\x1b[0n", "\x1b[?62;22c", "\x1b]11;rgb:00/00/00\x1b\\", "\x1bP1$r0m\x1b\\"]
    {
        let mut pty = running();
        pty.send(noise);
        let before = time(pty.screen()).expect("a time is shown");
        // Half a second: longer than the time after which a torn sequence is given up.
        pty.until("the run going on", |screen| time(screen).is_some_and(|t| t > before + 0.5));
        pty.send("?");
        pty.until_text("Esc closes");
        pty.send("q");
        assert_eq!(pty.exit(), 0, "{noise:?}");
    }
}

#[test]
fn pasted_text_presses_no_keys() {
    let mut pty = paused();
    pty.send("\x1b[200~q:quit\r\x1b[201~:");
    pty.send("\x1b[200~dt 1e-4\x1b[201~");
    pty.until_text(":dt 1e-4");
    pty.send("\x03"); // closes the line
    pty.until_text("space pause");
    pty.send("\x03");
    assert_eq!(pty.exit(), 0);
}

/// A shell with job control that starts the program, says when it has stopped, and continues it.
const SHELL: &str = r#"set -m; "$0" "$@"; echo "stopped $?"; stty -a; read line; fg; echo "ended $?""#;

#[test]
fn it_can_be_suspended_and_continued() {
    let program = carom(&[]).program;
    let mut pty =
        Start { program: "bash", arguments: &["-c", SHELL, program, "paper-1", "--paused"], ..carom(&[]) }.run();
    pty.until_text(HINT);
    pty.send("\x1a");
    pty.until_text("stopped 147"); // 128 + SIGSTOP
    pty.until_text("echoke"); // the last word of `stty -a`
    pty.assert_given_back();
    assert!(pty.text().contains(" icanon") && !pty.text().contains("-echo "), "{}", pty.text());
    pty.send("\n");
    pty.until_text(HINT);
    assert!(pty.screen().alternate_screen() && pty.screen().hide_cursor());
    pty.send("q");
    pty.until_text("ended 0");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

/// How a picture begins that needs nothing on the screen.
const WHOLE: &[u8] = b"\x1b[?2026h\x1b[m\x1b[2J";

#[test]
fn continued_it_sends_a_whole_picture_first() {
    let mut pty = running();
    for _ in 0..10 {
        pty.signal(Signal::STOP);
        while pty.read(Duration::from_millis(100)).is_some() {} // what it had sent before
        let from = pty.output.len();
        pty.signal(Signal::CONT);
        pty.until_bytes(from, b"\x1b[?2026l");
        let sent = &pty.output[from..];
        let first = sent.windows(8).position(|bytes| bytes == b"\x1b[?2026h").expect("a picture");
        assert!(sent[first..].starts_with(WHOLE), "{:?}", String::from_utf8_lossy(sent));
    }
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn after_fg_a_running_program_sends_a_whole_picture_first() {
    let program = carom(&[]).program;
    let mut pty = Start { program: "bash", arguments: &["-c", SHELL, program, "bouncing-49"], ..carom(&[]) }.run();
    pty.until_text(HINT);
    pty.send("\x1a");
    pty.until_text("echoke"); // the last word of `stty -a`
    let from = pty.output.len();
    pty.send("\n");
    pty.until_bytes(from, b"\x1b[?2026l");
    let sent = &pty.output[from..];
    let first = sent.windows(8).position(|bytes| bytes == b"\x1b[?2026h").expect("a picture");
    assert!(sent[first..].starts_with(WHOLE), "{:?}", String::from_utf8_lossy(sent));
    pty.send("q");
    pty.until_text("ended 0");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn without_a_shell_to_continue_it_a_suspend_says_so_and_goes_on() {
    let mut pty = paused();
    for suspend in [|pty: &mut Pty| pty.send("\x1a"), |pty: &mut Pty| pty.signal(Signal::TSTP)] {
        suspend(&mut pty);
        pty.until_text("no shell that could continue");
        pty.send("v");
        pty.until_text(HINT);
    }
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn stopped_from_outside_it_takes_the_terminal_again_when_continued() {
    let mut pty = paused();
    let raw = pty.modes();
    pty.signal(Signal::STOP);
    let from = pty.output.len();
    pty.signal(Signal::CONT);
    pty.until_bytes(from, b"\x1b[2J");
    assert_eq!(pty.modes(), raw);
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[cfg(debug_assertions)]
#[test]
fn a_panic_in_any_thread_gives_the_terminal_back_and_is_seen() {
    for (order, code) in [(":panic\r", 101), (":panic simulation\r", 1)] {
        let mut pty = paused();
        pty.send(order);
        assert_eq!(pty.exit(), code, "{}", pty.text());
        pty.assert_given_back();
        assert!(pty.text().contains("asked to panic"), "{}", pty.text());
    }
}

#[test]
fn in_the_c_locale_every_byte_is_ascii() {
    let mut pty = Start { environment: &[("LANG", "C")], ..carom(&["paper-1"]) }.run();
    for keys in ["", "?", "\x1bo", "\x1b:", "\x1bidd"] {
        pty.send(keys);
        drop(pty.read(pty::PATIENCE));
    }
    pty.send("\x03");
    assert_eq!(pty.exit(), 0);
    assert!(pty.output.is_ascii(), "{}", pty.text());
}

#[test]
fn with_no_color_set_there_is_none() {
    let colored = |environment| {
        let mut pty = Start { environment, ..carom(&["paper-1", "--paused"]) }.run();
        pty.until_text(HINT);
        let screen = pty.screen();
        let cells = (0..24).flat_map(|row| (0..80).map(move |column| (row, column)));
        let count = cells
            .filter_map(|(row, column)| screen.cell(row, column))
            .filter(|cell| (cell.fgcolor(), cell.bgcolor()) != (vt100::Color::Default, vt100::Color::Default))
            .count();
        pty.send("q");
        assert_eq!(pty.exit(), 0);
        count
    };
    assert_eq!(colored(&[("NO_COLOR", "1"), ("COLORTERM", "truecolor")]), 0);
    assert_ne!(colored(&[]), 0, "the test can see colours");
}

#[test]
fn without_a_terminal_one_line_says_what_to_use_instead() {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_carom"));
    let output = watch::output(command.args(["paper-0"]).env("TERM", "xterm").stdin(std::process::Stdio::null()));
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let said = String::from_utf8(output.stderr).expect("text");
    assert!(said.lines().count() == 1 && said.contains("use carom run, carom render or --text"), "{said}");
}
