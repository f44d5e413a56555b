//! Is the first picture there before the terminal has said a word, and better once it has?

use crate::{
    HINT, SHELL,
    pty::{Pty, Start, carom},
};

/// What a terminal is asked of which nothing is known, in this order.
const QUESTIONS: [&str; 5] = ["\x1b[6n", "\x1bP$qm\x1b\\", "\x1bP+q524742\x1b\\", "\x1b]11;?\x1b\\", "\x1b[?2026$p"];

const BARE: &[(&str, &str)] = &[("TERM", "xterm"), ("LANG", "")];

/// A paused program on a terminal that has said nothing, with its first picture.
fn silent(environment: &[(&str, &str)], arguments: &[&str]) -> Pty {
    let arguments = [&["paper-2", "--paused"], arguments].concat();
    let mut pty = Start { environment, answers: false, ..carom(&arguments) }.run();
    pty.until_text(HINT);
    pty
}

fn count(pty: &Pty, text: &str) -> usize {
    pty.output.windows(text.len()).filter(|bytes| *bytes == text.as_bytes()).count()
}

/// The colour of the badge, which is reversed.
fn badge(screen: &vt100::Screen) -> vt100::Color {
    screen.cell(0, 2).expect("the badge").fgcolor()
}

/// Whether anything is drawn in 24 bits.
fn in_24_bits(screen: &vt100::Screen) -> bool {
    let cells = (0..24).flat_map(|row| (0..80).map(move |column| (row, column)));
    cells
        .filter_map(|(row, column)| screen.cell(row, column))
        .any(|cell| matches!(cell.fgcolor(), vt100::Color::Rgb(..)))
}

fn quit(mut pty: Pty) {
    pty.send("\x03");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn the_first_picture_comes_with_the_questions_and_waits_for_no_answer() {
    let pty = silent(BARE, &[]);
    let places: Vec<usize> = QUESTIONS
        .iter()
        .map(|question| {
            assert_eq!(count(&pty, question), 1, "{question:?}");
            pty.output.windows(question.len()).position(|bytes| bytes == question.as_bytes()).expect("asked")
        })
        .collect();
    assert!(places.is_sorted(), "{places:?}");
    let picture = pty.output.windows(8).position(|bytes| bytes == b"\x1b[?2026h").expect("a picture");
    assert!(places[4] < picture, "what the questions leave on the screen is drawn over");
    assert!(!in_24_bits(pty.screen()) && badge(pty.screen()) == vt100::Color::Idx(3), "the terminal's own colours");
    quit(pty);
}

#[test]
fn answers_change_the_picture_however_late_and_torn_they_come() {
    let light = ["\x1b]11;rgb:ffff/ffff/ffff\x1b\\", "\x1b]11;rgb:ff/ff/ff\x07"];
    for (i, answer) in light.into_iter().enumerate() {
        let mut pty = silent(BARE, &[]);
        for byte in answer.bytes() {
            pty.send_bytes(&[byte]);
        }
        pty.until("a badge for a light background", |screen| badge(screen) == vt100::Color::Idx(5));
        if i == 0 {
            pty.send("\x1bP1$r0;48:2::1:2:3m\x1b\\");
            pty.until("24 bits", in_24_bits);
        }
        quit(pty);
    }
    let mut pty = silent(BARE, &[]);
    pty.send("\x1bP1+r524742=38\x1b\\");
    pty.until("24 bits", in_24_bits);
    quit(pty);
}

#[test]
fn a_terminal_without_utf_8_gets_ascii_once_it_has_said_where_its_cursor_is() {
    let mut pty = silent(BARE, &[]);
    assert!(!pty.text().is_ascii());
    pty.send("\x1b[1;4R");
    pty.until("ASCII alone", |screen| screen.contents().is_ascii());
    quit(pty);
    let mut pty = silent(BARE, &[]);
    pty.send("\x1b[1;2R?");
    pty.until_text("Esc closes");
    pty.send("?");
    pty.until("braille", |screen| !screen.contents().is_ascii() && !screen.contents().contains("Esc closes"));
    quit(pty);
}

#[test]
fn brackets_of_synchronized_updates_end_when_the_terminal_does_not_know_them() {
    for (answer, kept) in [("\x1b[?2026;2$y", true), ("\x1b[?2026;0$y", false)] {
        let mut pty = silent(&[], &[]);
        pty.send(answer);
        pty.answer(1);
        let from = pty.output.len();
        pty.send("?");
        pty.until_text("Esc closes");
        assert_eq!(pty.pictures_since(from) > 0, kept, "{answer:?}");
        quit(pty);
    }
}

#[test]
fn flag_configuration_no_color_and_term_win_over_answers() {
    let all = "\x1b[1;4R\x1bP1$r0;48:2::1:2:3m\x1b\\\x1b]11;rgb:ffff/ffff/ffff\x1b\\\x1b[?2026;0$y?";
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("config.ron");
    std::fs::write(&path, r#"(color: "16", marker: "braille")"#).expect("a file");
    let path = path.to_str().expect("text");
    for (environment, arguments) in [
        (BARE, &["--color", "16", "--marker", "braille"][..]),
        (BARE, &["--config", path]),
        (&[("TERM", "xterm"), ("NO_COLOR", "1")][..], &[]),
        (&[("TERM", "xterm-mono")][..], &[]),
    ] {
        let mut pty = silent(environment, arguments);
        pty.send(all);
        pty.until_text("Esc closes");
        pty.send("?");
        pty.until("the views", |screen| !screen.contents().contains("Esc closes"));
        assert!(!in_24_bits(pty.screen()) && !pty.text().is_ascii(), "{environment:?} {arguments:?}\n{}", pty.text());
        quit(pty);
    }
}

#[test]
fn the_linux_console_is_asked_nothing_and_shows_what_its_font_has() {
    let pty = silent(&[("TERM", "linux"), ("LANG", "")], &[]);
    assert!(QUESTIONS.iter().all(|question| count(&pty, question) == 0));
    assert!(pty.text().is_ascii(), "{}", pty.text());
    quit(pty);
}

#[test]
fn answers_without_end_and_answers_that_were_not_asked_do_no_harm() {
    let mut pty = silent(&[("TERM", "xterm"), ("COLORTERM", "truecolor")], &["--color", "never"]);
    pty.send("\x1b]11;rgb:ffff/ffff/ffff\x1b\\\x1bP1$r0;48:2::1:2:3m\x1b\\\x1b[1;4R");
    pty.send(&format!("\x1bP1$r{}m\x1b\\", "48:2:1:2:3;".repeat(20_000)));
    pty.send(&format!("\x1b]11;rgb:{}\x07", "f/".repeat(20_000)));
    pty.send("?");
    pty.until_text("Esc closes");
    let cells = (0..24).flat_map(|row| (0..80).map(move |column| (row, column)));
    let colored = |cell: &vt100::Cell| cell.fgcolor() != vt100::Color::Default;
    assert!(!cells.filter_map(|(row, column)| pty.screen().cell(row, column)).any(colored), "{}", pty.text());
    quit(pty);
}

#[test]
fn answers_under_way_when_it_quits_are_not_typed_at_the_shell() {
    let arguments = ["-c", SHELL, carom(&[]).program, "paper-1", "--paused"];
    let mut pty =
        Start { program: "bash", arguments: &arguments, answers: false, environment: BARE, ..carom(&[]) }.run();
    pty.until_text(HINT);
    pty.send("q");
    pty.until_bytes(0, b"\x1b[?1049l");
    pty.send("\x1b[1;2R\x1bP1$r0;48:2::1:2:3m\x1b\\\x1bP0+r524742\x1b\\\x1b]11;rgb:0000/0000/0000\x1b\\\x1b[?2026;2$y");
    pty.answer(1);
    pty.until_text("stopped 0");
    pty.until_text("echoke"); // the last word of `stty -a`
    for piece in ["48:2", "524742", "rgb:", "2026", "1;2R", "62;22c"] {
        assert!(!pty.text().contains(piece), "{piece}\n{}", pty.text());
    }
    pty.send("\n");
    pty.until_text("ended");
    pty.exit();
}
