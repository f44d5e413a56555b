//! Does the built binary do what its help says: every command, every exit code, whatever the arguments?

#[path = "cli/bounds.rs"]
mod bounds;
#[path = "cli/certify.rs"]
mod certify;
#[path = "cli/config.rs"]
mod config;
#[path = "cli/files.rs"]
mod files;
#[path = "cli/judge.rs"]
mod judge;
#[path = "cli/outputs.rs"]
mod outputs;
#[path = "cli/program.rs"]
mod program;
#[path = "cli/record.rs"]
mod record;
#[path = "cli/runs.rs"]
mod runs;
#[path = "cli/talk.rs"]
mod talk;
#[path = "cli/text.rs"]
mod text;
#[path = "cli/verify.rs"]
mod verify;
#[path = "support/watch.rs"]
mod watch;

use std::fs;

use program::{Ran, carom, closing, folder, in_folder};

#[test]
fn without_a_terminal_the_screen_is_refused_with_what_to_use_instead() {
    let ran = carom(&[]).fails_with(2);
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    for word in ["not a terminal", "run", "render", "--text"] {
        assert!(ran.err.contains(word), "{word:?} is not in {}", ran.err);
    }
    assert_eq!(ran.out, "");
}

#[test]
fn help_and_version_are_results() {
    for arguments in [&["--help"][..], &["-h"], &["help", "run"], &["run", "--help"], &["--version"]] {
        let ran = carom(arguments).succeeds();
        assert!(ran.out.contains("carom") && ran.err.is_empty(), "{ran:?}");
    }
}

#[test]
fn list_has_a_line_for_each_builtin_scene() {
    let ran = carom(&["list"]).succeeds();
    let names: Vec<&str> = ran.out.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let built_in: Vec<&str> = carom::scene::builtin::ALL.iter().map(|scene| scene.name).collect();
    assert_eq!(names, built_in);
    assert_eq!(&names[..5], ["paper-0", "paper-1", "paper-2", "paper-3", "paper-4"]);
}

#[test]
fn a_scene_that_is_shown_can_be_saved_changed_and_run() {
    let folder = folder();
    let path = in_folder(&folder, "mine.ron");
    let shown = carom(&["show", "paper-1"]).succeeds().out;
    fs::write(&path, &shown).expect("a file");
    let own = carom(&["run", &path, "--until", "1"]).succeeds();
    assert_eq!(own.out, carom(&["run", "paper-1", "--until", "1"]).succeeds().out);
}

#[test]
fn showing_what_is_not_there_names_what_is() {
    let ran = carom(&["show", "paper-9"]).fails_with(1);
    assert!(ran.err.contains("paper-9") && ran.err.contains("paper-0"), "{}", ran.err);
}

#[test]
fn methods_describes_every_method_and_one_alone() {
    let all = carom(&["methods"]).succeeds().out;
    for method in carom::scene::Method::ALL {
        let one = carom(&["methods", method.name()]).succeeds().out;
        assert!(all.contains(&one), "{one}");
        for word in ["order", "knobs", "not for", "source"] {
            assert!(one.lines().any(|line| line.trim_start().starts_with(word)), "{word:?} is not in {one}");
        }
    }
    let paper = carom(&["methods", "paper"]).succeeds().out;
    let differs: Vec<_> = paper.lines().filter(|line| line.trim_start().starts_with("differs")).collect();
    for word in ["becomes 0", "closest point", "really lasted", "frame's start", "impulses that wait", "create energy"]
    {
        assert!(differs.iter().any(|line| line.contains(word)), "{word:?} is not in {differs:?}");
    }
    let ran = carom(&["methods", "magic"]).fails_with(2);
    assert!(ran.err.contains("magic") && ran.err.contains("paper"), "{}", ran.err);
}

#[test]
fn check_says_what_a_scene_requires() {
    let ran = carom(&["check", "paper-0"]).succeeds();
    for word in ["paper-0", "ok", "gravity", "6 walls", "pair"] {
        assert!(ran.out.contains(word), "{word:?} is not in {}", ran.out);
    }
}

#[test]
fn check_looks_at_every_scene_and_fails_if_one_does() {
    let folder = folder();
    let bad = in_folder(&folder, "bad.ron");
    fs::write(&bad, "Scene(spheres: [Sphere(x: (0, 0, 0), mass: -1, radius: 1)])").expect("a file");
    let ran = carom(&["check", "paper-0", &bad, "nowhere", "paper-1"]).fails_with(1);
    assert!(ran.out.contains("paper-0: ok") && ran.out.contains("paper-1: ok"), "{}", ran.out);
    assert!(ran.err.contains("bad.ron:1:") && ran.err.contains("-1") && ran.err.contains("nowhere"), "{}", ran.err);
}

#[test]
fn completions_know_every_command_and_option() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = carom(&["completions", shell]).succeeds().out;
        for word in ["render", "until", "tolerance", "completions"] {
            assert!(script.contains(word), "{word:?} is not in the completions for {shell}");
        }
    }
    carom(&["completions", "cmd"]).fails_with(2);
}

#[test]
fn the_manual_page_has_every_command_and_the_exit_codes() {
    let page = carom(&["man"]).succeeds().out;
    assert!(page.contains(".TH carom 1"), "{page}");
    for command in ["LIST", "SHOW", "METHODS", "CHECK", "RUN", "RENDER", "MEASURE", "COMPLETIONS", "MAN"] {
        assert!(page.contains(&format!(".SH \"CAROM {command}\"")), "{command} is not in the manual page");
    }
    assert!(page.contains("128 + n"), "{page}");
}

#[test]
fn numbers_out_of_range_are_wrong_usage_and_named() {
    let positive = ["0", "-1", "-0", "nan", "inf", "-inf", "1e999", "", "two", "1e-999"];
    let not_negative = ["-1", "-1e-300", "NaN", "infinity", "1e999", "", "two"];
    for (option, values) in [("--dt", &positive[..]), ("--every", &positive)] {
        refuses(option, values);
    }
    for option in ["--tolerance", "--until"] {
        refuses(option, &not_negative);
    }
    for size in ["80", "80x", "0x24x1", "-1x24", "1001x24", "80x501", "1e2x24", "99999999x9"] {
        let ran = carom(&["render", "paper-0", &format!("--size={size}")]).fails_with(2);
        assert!(ran.err.contains("80x24"), "{}", ran.err);
    }
}

fn refuses(option: &str, values: &[&str]) {
    for value in values {
        let ran = carom(&["run", "paper-0", &format!("{option}={value}")]).fails_with(2);
        assert!(ran.err.contains(option), "{option} {value}: {}", ran.err);
    }
}

#[test]
fn negative_numbers_are_values_not_options() {
    let ran = carom(&["run", "paper-0", "--dt", "-1e-3"]).fails_with(2);
    assert!(ran.err.contains("-1e-3") && ran.err.contains("above 0"), "{}", ran.err);
}

#[test]
fn unknown_words_are_wrong_usage() {
    for arguments in [
        &["run"][..],
        &["run", "paper-0", "--fast"],
        &["run", "paper-0", "paper-1"],
        &["run", "paper-0", "--method", "magic"],
        &["check"],
        &["render", "paper-0", "--format", "png"],
        &["render", "paper-0", "--color", "17"],
        &["--marker", "dots"],
        &["run", "paper-0", "--states"],
        &["run", "paper-0", "--states", ""],
    ] {
        let ran = carom(arguments).fails_with(2);
        assert!(ran.out.is_empty(), "{}", ran.out);
    }
}

#[test]
fn a_scene_that_is_not_there_is_a_failure() {
    for command in ["run", "check", "render"] {
        let ran = carom(&[command, "no-such-scene"]).fails_with(1);
        assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
        assert!(ran.err.starts_with("carom: ") && ran.err.contains("no-such-scene"), "{}", ran.err);
    }
}

#[test]
fn a_frame_has_the_size_that_was_asked_for() {
    for (size, columns, rows) in [("80x24", 80, 24), ("120x40", 120, 40), ("200x60", 200, 60), ("20x5", 20, 5)] {
        let frame = carom(&["render", "paper-2", "--at", "1", "--size", size]).succeeds().out;
        assert_eq!(frame.lines().count(), rows, "{frame}");
        assert!(frame.lines().all(|line| line.chars().count() <= columns), "{frame}");
        assert!(!frame.contains('\u{1b}'), "text is text");
    }
    for size in ["0x0", "0x5", "5x0", "1x1", "1000x500"] {
        carom(&["render", "paper-2", "--size", size]).succeeds();
    }
}

#[test]
fn a_frame_shows_where_the_run_is_and_the_keys() {
    let frame = carom(&["render", "paper-2", "--at", "1.5"]).succeeds().out;
    let (first, last) = (frame.lines().next().unwrap_or(""), frame.lines().last().unwrap_or(""));
    for word in ["paper-2", "1.5", "paper"] {
        assert!(first.contains(word), "{word:?} is not in {first:?}");
    }
    assert!(last.contains("help") && last.contains("quit"), "{last:?}");
}

#[test]
fn frames_come_as_text_colours_and_pictures() {
    let frame = |more: &[&str]| carom(&[&["render", "paper-0"], more].concat()).succeeds().out;
    let (text, ansi, svg) = (frame(&[]), frame(&["--format", "ansi"]), frame(&["--format", "svg"]));
    assert_eq!(text, frame(&["--format", "text"]));
    assert!(ansi.contains("\u{1b}["), "{ansi:?}");
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{svg}");
    let ascii = frame(&["--marker", "ascii"]);
    assert!(ascii.is_ascii(), "{ascii}");
    let rgb = frame(&["--format", "ansi", "--color", "rgb"]);
    assert!(rgb.contains("38;2;"), "{rgb:?}");
    let plain = frame(&["--format", "ansi", "--color", "never"]);
    assert!(!plain.contains("38;") && !plain.contains("[3"), "{plain:?}");
}

#[test]
fn text_mode_tells_each_event_in_a_line_and_the_end() {
    let told = carom(&["--text", "paper-1"]).succeeds().out;
    let events = carom(&["run", "paper-1", "--events", "-"]).succeeds();
    let lines = told.lines().filter(|line| line.starts_with("At ")).count();
    assert_eq!(lines, events.out.lines().count() - 1, "a line for each row");
    let end = format!("The run ends at 20 seconds, after {} impacts.", closing(&events.err).impacts);
    assert!(told.contains(&end), "{told}");
    assert!(told.chars().all(|c| !c.is_control() || c == '\n'), "{told:?}");
}

#[test]
fn a_dumb_terminal_gets_text_mode() {
    let dumb = watch::output(program::command(&["paper-1"]).env("TERM", "dumb"));
    assert_eq!(Ran::from(dumb).succeeds().out, carom(&["--text", "paper-1"]).succeeds().out);
}

#[test]
fn text_mode_says_why_a_run_stops() {
    let ran = carom(&["--text", "paper-2"]).fails_with(1);
    assert!(ran.out.lines().last().is_some_and(|line| line.starts_with("The run stops at 10.")), "{}", ran.out);
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
}
