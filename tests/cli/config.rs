//! Is a configuration read as its own comments say, and a bad one refused by its line and field?

use std::fs;

use carom::{
    app::{Code, Key, table},
    config::{Config, defaults, parse},
    printable::is_printable,
    view::{Colors, Ink, Marker},
};

use crate::program::{Ran, carom, command, folder, in_folder};
use crate::watch;

#[test]
fn the_printed_defaults_read_back_as_the_defaults_with_every_action() {
    let printed = carom(&["config"]).succeeds().out;
    assert_eq!(printed, defaults());
    let read = parse(&printed, "defaults").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(read, Config::default());
    for row in table() {
        assert!(printed.contains(&format!(" {}: [", row.action.name())), "{:?} is not in\n{printed}", row.action);
        assert_eq!(read.keymap.keys(row.action), row.keys);
    }
    assert!(printed.lines().all(|line| line.chars().count() <= 120), "{printed}");
}

#[test]
fn every_line_of_the_defaults_can_be_left_out_and_every_key_of_them_be_given_up() {
    let printed = defaults();
    let keys: Vec<&str> = printed.lines().filter(|line| line.contains(": [\"")).collect();
    assert_eq!(keys.len(), table().count());
    for (line, row) in keys.iter().zip(table()) {
        let (name, _) = line.split_once(": [").expect("a list of keys");
        let rebound = printed.replace(line, &format!("{name}: [\"F12\", \"Alt-x\"],"));
        let read = parse(&rebound, "x").unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(read.keymap.action(Key::plain(Code::F(12))), Some(row.action));
        assert_eq!(read.keymap.action(Key { alt: true, ..Key::char('x') }), Some(row.action));
        assert_eq!(parse(&printed.replace(line, ""), "x"), Ok(Config::default()), "{line}");
    }
    assert_eq!(parse("Config()", "x"), Ok(Config::default()));
    assert_eq!(parse("()", "x"), Ok(Config::default()));
}

#[test]
fn every_value_is_taken() {
    let text = r##"(scene: "stack", marker: "ascii", color: "256", frame_rate: 5, bandwidth: "64k",
        colors: (good: "#ff0000", ghost: "bright-blue", spheres: ["red", "text"]))"##;
    let read = parse(text, "x").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(
        (read.scene.to_str(), read.marker, read.color),
        (Some("stack"), Some(Marker::Ascii), Some(Colors::Ansi256))
    );
    assert_eq!((read.frame_rate, read.bandwidth), (5, Some(64_000)));
    assert_eq!((read.inks.good, read.inks.ghost), (Some(Ink::Rgb(255, 0, 0)), Some(Ink::Ansi(12))));
    assert_eq!(read.inks.spheres[..3], [Some(Ink::Ansi(1)), Some(Ink::Text), None]);
}

/// Text, and what is said of it after the file's name.
const REFUSED: [(&str, &str); 24] = [
    ("", ":1:1: the file holds no configuration"),
    ("Scene()", ":1:1: `Scene` is refused; allowed is `Config`"),
    ("(\n  marker: \"dots\")", ":2:11: marker: `dots` is refused; allowed are `auto`, `braille`, `block`, `ascii`"),
    ("(color: 16)", ":1:9: color: "),
    ("(color: \"many\")", ":1:9: color: `many` is refused; allowed are `auto`, `never`, `16`, `256`, `rgb`"),
    ("(frame_rate: 0)", ":1:14: frame_rate: 0 is refused; allowed is a whole number from 1 to 60"),
    ("(frame_rate: NaN)", ":1:14: frame_rate: NaN is refused; allowed is a whole number from 1 to 60"),
    ("(bandwidth: \"64kb\")", ":1:13: bandwidth: `64kb` is refused; it must be a whole number of bytes per second"),
    ("(colours: ())", ":1:2: colours: there is no field `colours`; allowed are `scene`, `marker`"),
    ("(colors: (good: \"grass\"))", ":1:17: colors.good: `grass` is refused; allowed are black, red"),
    ("(colors: (spheres: [\"auto\"]))", ":1:20: colors.spheres: auto is refused in a list"),
    ("(keys: (stride: [\"w\"]))", ":1:9: keys.stride: there is no field `stride`; allowed are `toggle_pause`, `step`"),
    ("(keys: (step: \"w\"))", ":1:15: keys.step: "),
    ("(keys: (step: [\"y\", \"q\"]))", ":1:21: keys.step[1]: `q` is a key of quit too; allowed is one action per key"),
    ("(keys: (step: [\"y\", \"y\"]))", ":1:16: keys.step[0]: `y` is given twice"),
    ("(keys: (step: [\"y\"], step: [\"v\"]))", ":1:22: keys: the field `step` is given twice"),
    ("(keys: (step: [\"Ctrl-C\"]))", ":1:16: keys.step[0]: `Ctrl-C` is refused; it always does quit"),
    ("(keys: (step: [\"Esc\"]))", ":1:16: keys.step[0]: `Esc` is refused; it always does close"),
    ("(keys: (step: [\"Ctrl-I\"]))", ":1:16: keys.step[0]: `Ctrl-I` is the same as Tab to a terminal"),
    ("(keys: (step: [\"Shift-w\"]))", ":1:16: keys.step[0]: `Shift-w` is written as the character that it types: W"),
    (
        "(keys: (step: [\"\u{200d}\"]))",
        ":1:16: keys.step[0]: `\\u{200d}` holds the character U+200D (a zero-width joiner)",
    ),
    ("(scene: \"a\u{202e}b\")", ":1:9: scene: the character U+202E (a direction mark) is refused"),
    ("(scene: \"\")", ":1:9: scene: an empty text is refused"),
    ("(marker: \"ascii\"", ":1:17: the end of the file is refused; a comma or the closing bracket must stand here"),
];

#[test]
fn a_bad_file_is_refused_by_its_line_and_field_and_ends_the_program_with_2() {
    let folder = folder();
    let path = in_folder(&folder, "bad.ron");
    for (text, said) in REFUSED {
        let refusal = parse(text, "bad.ron").expect_err(text).to_string();
        assert!(refusal.starts_with(&format!("bad.ron{said}")), "{text}:\n{refusal}\nis not\nbad.ron{said}");
        assert!(refusal.chars().all(is_printable), "{refusal}");
        fs::write(&path, text).expect("a file");
        let ran = carom(&["--text", "paper-0", "--config", &path]).fails_with(2);
        assert_eq!((ran.err, ran.out), (format!("carom: {}{}\n", path, &refusal["bad.ron".len()..]), String::new()));
    }
}

#[test]
fn a_file_that_cannot_be_read_or_is_too_large_is_refused() {
    let folder = folder();
    let path = in_folder(&folder, "large.ron");
    fs::write(&path, " ".repeat((1 << 20) + 1)).expect("a file");
    let missing = in_folder(&folder, "missing.ron");
    let not_text = in_folder(&folder, "latin.ron");
    fs::write(&not_text, b"(scene: \"\xff\")").expect("a file");
    let inside = folder.path().to_str().expect("text").to_owned();
    for (path, said) in [
        (&path, "the file of 1048577 bytes is refused; allowed are up to 1 MiB"),
        (&missing, "the file cannot be read: No such file or directory"),
        (&not_text, "the byte 0xff is refused; allowed is text in UTF-8"),
        (&inside, "it is a folder; allowed is a configuration"),
        (&"/dev/zero".to_owned(), "it is a device or pipe; allowed is a configuration"),
    ] {
        let ran = carom(&["--text", "paper-0", "--config", path]).fails_with(2);
        assert!(ran.err.contains(said), "{}", ran.err);
    }
}

/// Runs `carom --text --config …` or without an option, in an environment.
fn first_line(option: Option<&str>, environment: &[(&str, &str)]) -> String {
    let arguments = option.map_or(vec!["--text"], |path| vec!["--text", "--config", path]);
    let mut command = command(&arguments);
    command.env_remove("CAROM_CONFIG").env_remove("XDG_CONFIG_HOME").env("HOME", "/nowhere");
    command.envs(environment.iter().copied());
    let ran = Ran::from(watch::output(&mut command));
    ran.out.lines().next().unwrap_or_default().to_owned()
}

#[test]
fn the_option_wins_over_the_variable_and_both_over_the_usual_place() {
    let folder = folder();
    let usual = folder.path().join("carom");
    fs::create_dir(&usual).expect("a folder");
    fs::write(usual.join("config.ron"), "(scene: \"paper-1\")").expect("a file");
    let (by_variable, by_option) = (in_folder(&folder, "variable.ron"), in_folder(&folder, "option.ron"));
    fs::write(&by_variable, "(scene: \"stack\")").expect("a file");
    fs::write(&by_option, "(scene: \"mine.ron\")").expect("a file");
    let shown = carom(&["show", "zeno"]).succeeds().out;
    fs::write(in_folder(&folder, "mine.ron"), &shown).expect("a file");
    let home = folder.path().to_str().expect("text");
    let name = |scene: &str| carom::scene::open(scene).expect("built in").scene.name.clone();
    assert_eq!(first_line(None, &[]), name("billiard"), "no file anywhere");
    let xdg = ("XDG_CONFIG_HOME", home);
    assert_eq!(first_line(None, &[xdg]), name("paper-1"));
    assert_eq!(first_line(None, &[xdg, ("CAROM_CONFIG", "")]), name("paper-1"), "empty is unset");
    let variable = ("CAROM_CONFIG", by_variable.as_str());
    assert_eq!(first_line(None, &[xdg, variable]), name("stack"));
    assert_eq!(first_line(Some(&by_option), &[xdg, variable]), name("zeno"), "beside the configuration");
    assert_eq!(first_line(Some("/dev/null"), &[xdg, variable]), name("billiard"), "no configuration");
    let mut help = command(&["--help"]);
    help.env("XDG_CONFIG_HOME", home);
    let said = Ran::from(watch::output(&mut help)).succeeds().out;
    let said: String = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains(&format!("Configuration: {home}/carom/config.ron")), "{said}");
}
