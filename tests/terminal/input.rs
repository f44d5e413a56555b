//! Whatever arrives as input: only keys are keys, and Ctrl-C is always one.

use std::fs;

use crate::{
    paused,
    pty::{Pty, Start, carom},
    random::Random,
    running, time,
};

/// The run goes on, `?` opens the help, and `q` ends it: no key was pressed before, and none is lost after.
fn works_as_if_nothing_had_come(mut pty: Pty, noise: &str) {
    let before = time(pty.screen()).expect("a time is shown");
    // Half a second: longer than the time after which a torn sequence is given up.
    pty.until("the run going on", |screen| time(screen).is_some_and(|t| t > before + 0.5));
    assert!(pty.text().contains("RUN") && pty.text().contains("paper-0"), "{noise:?}: {}", pty.text());
    pty.send("?");
    pty.until_text("Esc closes");
    pty.send("q");
    assert_eq!(pty.exit(), 0, "{noise:?}");
    pty.assert_given_back();
}

/// A running program whose terminal sends nothing of its own: answers never come in the midst of a key.
fn silent() -> Pty {
    let mut pty = Start { answers: false, ..carom(&["paper-0"]) }.run();
    pty.until("it being shown as to one that never answers", |screen| time(screen).is_some_and(|t| t > 2.5));
    pty
}

#[test]
fn the_payload_of_strings_presses_no_keys() {
    for noise in
        ["\x1bXq\x1b\\", "\x1b_q]\x1b\\", "\x1b^q \x1b\\", "\x1bPq\x18", "\x1b]q\x07", "\x1bq", "\x1b\x1b[24;80R"]
    {
        let mut pty = running();
        pty.send(noise);
        works_as_if_nothing_had_come(pty, noise);
    }
}

#[test]
fn a_string_that_comes_byte_by_byte_presses_no_keys_either() {
    let mut pty = silent();
    pty.send("\x1bP");
    for byte in ["q", "]", " ", "q", "\x1b", "\\"] {
        let before = time(pty.screen()).expect("a time is shown");
        // A run at the pace of the wall: four times the escape time-out.
        pty.until("a tenth of a second", |screen| time(screen).is_some_and(|t| t > before + 0.1));
        pty.send(byte);
    }
    works_as_if_nothing_had_come(pty, "byte by byte");
}

#[test]
fn a_torn_arrow_never_changes_the_scene() {
    let mut pty = silent();
    for piece in ["\x1b", "[", "A"] {
        pty.send(piece);
        let before = time(pty.screen()).expect("a time is shown");
        pty.until("a tenth of a second", |screen| time(screen).is_some_and(|t| t > before + 0.1));
    }
    works_as_if_nothing_had_come(pty, "a torn arrow");
}

#[test]
fn keys_of_the_desktop_and_released_keys_are_not_ours() {
    for noise in [
        "\x1b[113;9u",
        "\x1b[113;17u",
        "\x1b[113;33u",
        "\x1b[27;9;113~",
        "\x1b[113;1:3u",
        "\x1b[93;9u",
        "\x1b[113;256u",
    ] {
        let mut pty = running();
        pty.send(noise);
        works_as_if_nothing_had_come(pty, noise);
    }
}

#[test]
fn ctrl_c_ends_it_whatever_was_begun() {
    for begun in ["\x1b[200~never ending", "\x1bP", "\x1b]0;title", "\x1b[", "\x1bO", "\x1b[1;", "o/box"] {
        let mut pty = paused();
        pty.send(begun);
        pty.send("\x03");
        assert_eq!(pty.exit(), 0, "{begun:?}");
        pty.assert_given_back();
    }
}

#[test]
fn ctrl_c_closes_the_line_however_fast_it_follows_and_a_second_one_ends_it() {
    let mut pty = paused();
    pty.send(":dt 1\x03?");
    pty.until_text("Esc closes"); // by the key behind it, which no line takes any more
    assert!(pty.text().contains("PAUSE") && !pty.text().contains(":dt"), "{}", pty.text());
    pty.send(":dt 1");
    pty.send("\x03\x03");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn ctrl_c_ends_a_paste_that_never_does() {
    let mut pty = paused();
    pty.send("\x1b[200~");
    pty.send(&"a line\r".repeat(10_000));
    pty.send("\x03");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn ctrl_c_overtakes_millions_of_keys() {
    let mut random = Random::new(15);
    // Everything a keyboard and a broken line can send, but what ends the program by itself.
    let any = |random: &mut Random| (random.unit() * 256.0) as u8;
    let bytes = std::iter::repeat_with(|| any(&mut random)).filter(|byte| !matches!(byte, 0x03 | b'q'));
    let bytes: Vec<u8> = bytes.take(2_000_000).collect();
    let mut pty = paused();
    pty.send_bytes(&bytes);
    pty.send("\x03\x03"); // all keys before it may have been obeyed, and the last one may have opened a line
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn more_keys_than_can_be_obeyed_are_left_out_and_that_is_said() {
    let mut pty = paused();
    pty.send(&"]".repeat(20_000));
    pty.until_text("came faster than they could be obeyed");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn a_terminal_without_a_size_is_drawn_in_that_of_the_environment() {
    for (environment, columns, rows) in [(&[][..], 80, 24), (&[("COLUMNS", "100"), ("LINES", "30")][..], 100, 30)] {
        let mut pty = Start { size: (0, 0), environment, ..carom(&["paper-1", "--paused"]) }.run();
        pty.emulate(columns, rows);
        pty.until_text("space pause");
        let last = pty.screen().rows(0, columns).nth(usize::from(rows) - 1).unwrap_or_default();
        assert!(last.contains("space pause"), "{}", pty.text());
        let drawn = |row| pty.screen().cell(row, columns - 1).is_some_and(|cell| cell.contents().trim() != "");
        assert!((0..rows).any(drawn), "as wide as that:\n{}", pty.text());
        pty.send("q");
        assert_eq!(pty.exit(), 0);
    }
}

#[test]
fn keys_are_answered_while_a_large_scene_is_opened() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("grows.ron");
    let scene = |count: u32| {
        let side = 100;
        format!(
            "Scene(walls: [Room(min: (0, 0, 0), max: ({side}, {side}, {side}))], spheres: [Gas(min: (0, 0, 0), \
             max: ({side}, {side}, {side}), count: {count}, seed: 1, mass: 1, radius: 0.1)])"
        )
    };
    fs::write(&path, scene(2)).expect("it can be written");
    let arguments = [path.to_str().expect("its name is text"), "--paused"];
    let mut pty = carom(&arguments).run();
    pty.until_text("space pause");
    fs::write(&path, scene(300_000)).expect("it can be written");
    pty.send("R");
    pty.until_text("Opening");
    pty.send("?");
    pty.until_text("Esc closes");
    pty.send("?");
    pty.until("the help closed", |screen| !screen.contents().contains("Esc closes"));
    pty.send("\x1b");
    pty.until_text("is not opened");
    pty.send("R");
    pty.until_text("Opening");
    pty.send("\x03");
    assert_eq!(pty.exit(), 0, "before the scene is there");
    pty.assert_given_back();
}
