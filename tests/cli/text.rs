//! Text from outside: shown, but never obeyed, whatever way it comes in.

use std::ffi::OsString;
use std::fs;
use std::os::unix::ffi::OsStringExt;

use crate::program::{self, Ran, carom, folder, in_folder};
use crate::watch;

/// Every kind of character that a terminal obeys, hides or turns: controls, bidirectional and joining marks, soft
/// hyphen, separators, format characters of scripts, tags, fillers, selectors, private use, what Unicode does not know.
const EVIL: &str = "\u{1b}]0;owned\u{7}\u{1b}[2J\r\n\t\u{9b}31m\u{7f}\u{202e}\u{202a}\u{2066}\u{2069}\u{61c}\u{200b}\u{200c}\
    \u{200d}\u{200e}\u{200f}\u{ad}\u{2028}\u{2029}\u{2060}\u{2064}\u{206f}\u{600}\u{6dd}\u{70f}\u{8e2}\u{180e}\u{110bd}\u{13430}\
    \u{1343f}\u{1bca0}\u{1d173}\u{e0001}\u{e0041}\u{e007f}\u{e0100}\u{feff}\u{fff9}\u{fe0f}\u{3164}\u{115f}\u{34f}\u{e000}\u{ffff}";

#[track_caller]
fn harmless(ran: &Ran) {
    let bad = |c: &char| EVIL.contains(*c) && *c != '\n' && !c.is_ascii_graphic();
    let found: Vec<char> = ran.err.chars().chain(ran.out.chars()).filter(bad).collect();
    assert!(found.is_empty(), "{found:?} in {ran:?}");
}

#[test]
fn no_message_carries_what_a_terminal_obeys_hides_or_turns() {
    let folder = folder();
    let evil = &EVIL.replace('\u{ffff}', "");
    let short: String = evil.chars().take(30).collect();
    let file = in_folder(&folder, &format!("{short}.ron"));
    fs::write(&file, format!("Scene({evil}: 1)")).expect("a file");
    let named = in_folder(&folder, "named.ron");
    fs::write(&named, format!("Scene(name: \"{evil}\", spheres: [], {evil}: 2)")).expect("a file");
    let missing = in_folder(&folder, &format!("{short}/{short}.csv"));
    let part = in_folder(&folder, &format!("{short}.csv"));
    fs::write(&part, format!("{evil},1\n")).expect("a file");
    let cases: &[&[&str]] = &[
        &["run", evil],
        &["run", &file],
        &["check", &file, &named, evil],
        &["show", evil],
        &["methods", evil],
        &["run", "paper-0", "--dt", evil],
        &["run", "paper-0", "--size", evil],
        &["run", "paper-0", "--until", "0", "--states", &missing],
        &["run", "paper-0", "--until", "0", "--states", &missing, "--events", &missing],
        &["run", &file, "--states", &file],
        &["run", "paper-0", "--until", "0", evil],
        &["measure", "--merge", &part],
        &["measure", "--merge", evil, "--csv", evil],
        &["measure", "paper-0", "--shard", evil],
        &["measure", "paper-0", "--methods", evil],
        &["--text", &file],
        &["--text", evil],
        &[evil, evil],
        &[evil],
        &[&format!("--{evil}")],
        &[&format!("--method{evil}")],
        &[&format!("--dt={evil}")],
        &[&format!("-{evil}")],
        &["completions", evil],
        &["run", "paper-0", "--states", &format!("{evil}/x"), "--every", evil],
        &["render", "paper-0", "--format", evil],
    ];
    for arguments in cases {
        let ran = carom(arguments);
        assert!(matches!(ran.code, Some(1 | 2)), "{ran:?}");
        assert!(!ran.err.is_empty(), "{arguments:?} says nothing");
        harmless(&ran);
    }
}

#[test]
fn each_of_these_characters_is_shown_spelled_out_by_every_reader_of_words() {
    for c in EVIL.chars().filter(|c| !c.is_ascii_graphic()) {
        let word = format!("a{c}b");
        let spelled = format!("a{}b", c.escape_default());
        let cases =
            [&["run", &word][..], &["show", &word], &["run", "paper-0", "--dt", &word], &[&format!("--{word}")]];
        for arguments in cases {
            let ran = carom(arguments);
            assert!(ran.err.contains(&spelled), "{spelled} is not in {ran:?}");
            harmless(&ran);
        }
    }
}

/// A word of bytes that are no UTF-8.
fn broken(folder: &tempfile::TempDir, ending: &str) -> OsString {
    let name = OsString::from_vec([b"caf\xe9 \xff", ending.as_bytes()].concat());
    folder.path().join(name).into_os_string()
}

#[test]
fn files_may_have_names_that_are_no_utf_8() {
    let folder = folder();
    let text = carom(&["show", "paper-0"]).succeeds().out;
    let (scene, states, part) = (broken(&folder, ".ron"), broken(&folder, ".jsonl"), broken(&folder, ".csv"));
    fs::write(&scene, &text).expect("a file");
    let ran = |words: &[&str], more: &[&OsString]| Ran::from(watch::output(program::command(words).args(more)));
    assert!(ran(&["check"], &[&scene]).succeeds().out.starts_with("caf\\xe9 \\xff: ok"));
    ran(&["run", "--until=1", "--states"], &[&states, &scene]).succeeds();
    assert!(fs::read_to_string(&states).expect("the states").starts_with("{\"time\":"), "the ending is seen");
    assert!(ran(&["render", "--at=1"], &[&scene]).succeeds().out.contains("PAUSE"));
    ran(&["--text"], &[&scene]).succeeds();
    let quick = ["measure", "--methods=paper", "--dt=1e-1", "--tolerances=1e-3", "--csv"];
    ran(&quick, &[&part, &scene]).succeeds();
    assert!(ran(&["measure", "--merge"], &[&part]).succeeds().out.contains("caf\\xe9 \\xff"));
    fs::write(&scene, "Scene(").expect("a file");
    let refused = ran(&["check"], &[&scene]).fails_with(1);
    assert!(refused.err.contains("caf\\xe9 \\xff.ron:1:"), "{}", refused.err);
    let same = ran(&["run", "paper-0", "--states"], &[&states, &OsString::from("--events"), &states]).fails_with(2);
    assert!(same.err.contains("the same file"), "{}", same.err);
    ran(&["run"], &[&broken(&folder, "-missing")]).fails_with(1);
}

#[test]
fn system_errors_have_one_form() {
    let folder = folder();
    let nowhere = in_folder(&folder, "no/such");
    let own = folder.path().to_str().expect("a plain path").to_string();
    for (arguments, words) in [
        (&["run", &format!("{nowhere}.ron")][..], "the file cannot be read: No such file or directory"),
        (&["measure", "--merge", &nowhere], "the file cannot be read: No such file or directory"),
        (&["run", "paper-0", "--states", &nowhere], "cannot write "),
        (&["run", "paper-0", "--states", &own], ": Is a directory"),
        (&["run", "paper-0", "--states", &nowhere], ": No such file or directory"),
    ] {
        let ran = carom(arguments).fails_with(1);
        assert!(ran.err.contains(words) && !ran.err.contains("os error"), "{}", ran.err);
        assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    }
}
