//! Does the program look and answer as the configuration says, and the command line against it?

use std::fs;

use crate::{
    HINT, Start,
    pty::{Pty, carom},
    time,
};

/// A paused program with a configuration of that text.
fn configured(text: &str, arguments: &[&str]) -> Pty {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("config.ron");
    fs::write(&path, text).expect("it can be written");
    let all = [&["--paused", "--config", path.to_str().expect("its name is text")], arguments].concat();
    let mut pty = carom(&all).run();
    pty.until(HINT, |screen| screen.contents().contains("pause") && screen.contents().contains("PAUSE"));
    pty
}

#[test]
fn scene_marker_keys_and_colours_are_those_of_the_configuration() {
    let text = r##"(scene: "stack", marker: "ascii", color: "rgb", colors: (notice: "#123456"),
        keys: (toggle_pause: ["F5", "b"], help: ["H"]))"##;
    let mut pty = configured(text, &[]);
    assert!(pty.text().contains("stack") && pty.text().contains("F5 pause/run"), "{}", pty.text());
    assert!(pty.text().is_ascii(), "{}", pty.text());
    assert!(
        pty.output.windows(15).any(|bytes| bytes == b"38;2;18;52;86;7" || bytes == b";38;2;18;52;86m"),
        "the badge"
    );
    pty.send("H");
    pty.until_text("Esc closes");
    assert!(pty.text().contains("F5 b"), "{}", pty.text());
    pty.send("H");
    pty.until("the help closed", |screen| !screen.contents().contains("Esc closes"));
    pty.send("\x1b[15~");
    pty.until_text(" RUN ");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
    pty.assert_given_back();
}

#[test]
fn the_command_line_wins_over_the_configuration_and_that_over_the_environment() {
    let text = r#"(scene: "stack", marker: "ascii", color: "rgb")"#;
    let mut pty = configured(text, &["paper-2", "--marker", "braille", "--color", "never"]);
    assert!(pty.text().contains("paper-2") && !pty.text().is_ascii(), "{}", pty.text());
    assert!(!pty.output.windows(3).any(|bytes| bytes == b"[3;" || bytes == b"38;"), "no colours");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn pictures_are_as_few_as_the_configuration_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("config.ron");
    fs::write(&path, "(frame_rate: 2)").expect("it can be written");
    let mut pty = carom(&["box-gas", "--config", path.to_str().expect("its name is text")]).run();
    pty.until_text(HINT);
    let from = pty.output.len();
    pty.until("three seconds", |screen| time(screen).is_some_and(|t| t > 3.0));
    // Six are due; half as many again: a run that does not keep up with the wall passes its seconds later.
    let pictures = pty.pictures_since(from);
    assert!((3..=10).contains(&pictures), "{pictures} pictures in 3 s");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn a_bad_configuration_never_touches_the_screen() {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let arguments = ["--config", manifest];
    let start = carom(&arguments);
    let mut pty = Start { environment: &[("NO_COLOR", "1")], ..start }.run();
    assert_eq!(pty.exit(), 2);
    assert!(!pty.output.contains(&0x1b), "{}", pty.text());
    assert!(pty.text().contains("Cargo.toml:1:"), "{}", pty.text());
}
