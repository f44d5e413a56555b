//! Pictures wait for the terminal's answers, and nothing else does.

use std::{process::Command, time::Duration};

use crate::{
    HINT, SHELL,
    pty::{self, Pty, Start, carom},
    time, watch,
};

/// Long enough for every picture that is due to have come.
const QUIET: Duration = Duration::from_millis(500);

fn shown_time(pty: &Pty) -> f64 {
    time(pty.screen()).expect("a time is shown")
}

/// Reads until so many simulated seconds have passed; bytes and pictures meanwhile.
fn over(pty: &mut Pty, seconds: f64) -> (usize, usize) {
    let (from, begin) = (pty.output.len(), shown_time(pty));
    pty.until("the run going on", |screen| time(screen).is_some_and(|t| t >= begin + seconds));
    (pty.output.len() - from, pty.pictures_since(from))
}

/// Answers everything up to the request alone that measures the line; bytes by then.
fn measured(pty: &mut Pty) -> usize {
    let mut answered = 0;
    while !pty.output.windows(6).any(|bytes| bytes == b"\x1b[c\x1b[c") {
        assert!(pty.read(pty::PATIENCE).is_some(), "no request came");
        let asked = pty.requests_since(0);
        pty.answer(asked - answered);
        answered = asked;
    }
    pty.output.len()
}

/// Reads what is there, until nothing comes.
fn drain(pty: &mut Pty) {
    while pty.read(QUIET).is_some_and(|bytes| !bytes.is_empty()) {}
}

#[test]
fn a_reader_stalled_for_ten_seconds_finds_two_stale_pictures_at_most_and_is_told() {
    let mut pty = Start { size: (120, 40), ..carom(&["box-gas"]) }.run();
    pty.until_text(HINT);
    over(&mut pty, 1.0);
    let (from, before) = (pty.output.len(), shown_time(&pty));
    assert_eq!(pty.look_away(Duration::from_secs(10)), None);
    pty.until_text("The line was silent for");
    let stale = pty.pictures_since(from) - 1; // the last is the one that tells
    assert!(stale <= 2, "{stale} pictures of long ago were shown");
    assert!(shown_time(&pty) > before + 5.0, "the run went on: {} s, then {} s", before, shown_time(&pty));
    let said = pty.text();
    let said = said.lines().last().expect("the message");
    let skipped: Vec<u32> = said.split(' ').filter_map(|word| word.parse().ok()).collect();
    assert!(skipped.len() == 1 && skipped[0] > 100, "{said}");
    assert!(said.contains("frames were skipped"), "{said}");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn on_a_silent_line_one_key_is_answered_and_the_rest_when_it_returns() {
    let mut pty = Start { answers: false, ..carom(&["box-gas"]) }.run();
    let from = measured(&mut pty);
    pty.until("the next picture", |screen| time(screen).is_some_and(|t| t > 0.0));
    drain(&mut pty);
    assert_eq!((pty.pictures_since(from), pty.requests_since(from)), (1, 1), "one that is not answered");
    pty.send("?");
    pty.until_text("Esc closes");
    pty.send("?");
    drain(&mut pty);
    assert_eq!(pty.pictures_since(from), 2, "no more than one ahead of the answers");
    pty.answer(2);
    pty.until("the second key obeyed", |screen| !screen.contents().contains("Esc closes"));
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn a_terminal_that_never_answers_gets_ten_pictures_a_second() {
    let mut pty = Start { answers: false, ..carom(&["box-gas"]) }.run();
    pty.until("it being given up", |screen| time(screen).is_some_and(|t| t > 2.5));
    // Half as many again: a run that does not keep up with the wall passes its seconds later.
    let (_, pictures) = over(&mut pty, 3.0);
    assert!((5..=45).contains(&pictures), "{pictures} pictures in 3 s");
    pty.send("?");
    pty.until_text("Esc closes");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn inside_a_multiplexer_pictures_and_bytes_are_few() {
    for name in ["TMUX", "STY", "NCURSES_NO_UTF8_ACS"] {
        let mut pty = Start { environment: &[(name, "1")], size: (200, 60), ..carom(&["elastic-666"]) }.run();
        pty.until_text(HINT);
        let (bytes, pictures) = over(&mut pty, 3.0);
        // Half as many again, as above, and a whole picture.
        assert!(pictures <= 45 && bytes <= 3 * 32_000 * 3 / 2 + 16_000, "{name}: {pictures} pictures, {bytes} bytes");
        pty.send("q");
        assert_eq!(pty.exit(), 0);
    }
}

#[test]
fn a_cap_on_bytes_is_kept() {
    let mut pty = Start { size: (120, 40), ..carom(&["box-gas", "--bandwidth", "20k"]) }.run();
    pty.until_text(HINT);
    over(&mut pty, 1.0);
    let (bytes, _) = over(&mut pty, 8.0);
    // The lower bound is loose: a busy machine may draw less.
    assert!((80_000..=176_000).contains(&bytes), "{bytes} bytes in 8 s");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn the_trajectory_is_bit_equal_whatever_the_line_does() {
    let thin: &[&str] = &["elastic-666", "--bandwidth", "2k"];
    for (arguments, answers, stalls) in
        [(thin, true, false), (&thin[..1], false, false), (&thin[..1], true, false), (&thin[..1], true, true)]
    {
        let mut pty = Start { answers, ..carom(arguments) }.run();
        pty.until_text(HINT);
        if stalls {
            assert_eq!(pty.look_away(Duration::from_secs(2)), None);
        } else {
            over(&mut pty, 1.0);
        }
        pty.send(" ");
        pty.until_text("PAUSE");
        pty.send(":hash\r");
        pty.until_text("hash=");
        let text = pty.text();
        // In the last row, or above it if there is news behind it.
        let said: Vec<&str> = text.split_whitespace().collect();
        let value = |name: &str| said.iter().find_map(|word| word.strip_prefix(name)).expect("it is said").to_owned();
        let mut alone = Command::new(env!("CARGO_BIN_EXE_carom"));
        let ran = watch::output(alone.args(["run", "elastic-666", "--until", &value("t=")]));
        let closing = String::from_utf8(ran.stdout).expect("text");
        assert!(closing.trim().ends_with(&value("hash=")), "{said:?}, alone {closing}");
        pty.send("q");
        assert_eq!(pty.exit(), 0);
    }
}

#[test]
fn an_answer_under_way_when_it_quits_or_stops_is_not_typed_at_the_shell() {
    for leave in ["q", "\x1a"] {
        let program = carom(&[]).program;
        let start = carom(&[]);
        let arguments = ["-c", SHELL, program, "box-gas"];
        let mut pty = Start { program: "bash", arguments: &arguments, answers: false, ..start }.run();
        let from = measured(&mut pty);
        drain(&mut pty);
        let asked = pty.requests_since(from);
        assert_eq!(asked, 1, "and not answered");
        pty.send(leave);
        pty.until_bytes(from, b"\x1b[?1049l");
        pty.answer(asked);
        pty.until_text(if leave == "q" { "stopped 0" } else { "stopped 147" });
        pty.until_text("echoke");
        assert!(!pty.text().contains("62;22c") && !pty.text().contains("[?"), "{}", pty.text());
        pty.send("\n");
        if leave == "\x1a" {
            pty.until_text(HINT);
            pty.answers = true;
            let from = shown_time(&pty);
            pty.answer(1);
            pty.until("the run going on", |screen| time(screen).is_some_and(|t| t > from + 0.5));
            pty.send("q");
        }
        pty.until_text("ended");
        assert!(!pty.text().contains("62;22c"), "{}", pty.text());
        pty.exit();
    }
}

#[test]
fn a_lost_terminal_is_not_waited_for() {
    let mut pty = Start { answers: false, ..carom(&["box-gas"]) }.run();
    pty.until_text(HINT);
    assert_eq!(pty.hang_up(), 129);
}

#[test]
fn requests_end_with_the_program() {
    let mut pty = carom(&["paper-0"]).run();
    pty.until_text(HINT);
    over(&mut pty, 0.2);
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    let end = pty.output.windows(8).rposition(|bytes| bytes == b"\x1b[?1049l").expect("it leaves the screen");
    assert_eq!(pty.requests_since(end), 0);
}
