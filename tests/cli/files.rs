//! Files that are replaced as a whole or not at all, and streams whose readers go, sleep or are full.

use std::fs;
use std::io::{BufRead, BufReader};
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::process::Stdio;

use rustix::process::{Pid, Signal, kill_process};

use crate::program::{self, Ran, carom, folder, in_folder, names_in, piped, spawn};
use crate::watch::{Watch, finish, finish_reading};

/// Long enough for a pipe to be full many times over, whatever the machine.
const LONG: [&str; 7] = ["run", "paper-0", "--until", "1e6", "--every", "1e-4", "--yes"];

/// What is said first of a run of so many rows.
const MANY: &[u8] = b"carom: --every 0.0001 writes 1e10 rows of states\n";

#[test]
fn a_file_is_replaced_with_its_permissions_and_nothing_is_left_beside_it() {
    let folder = folder();
    let path = in_folder(&folder, "states.csv");
    fs::write(&path, "precious").expect("a file");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).expect("its permissions");
    carom(&["run", "paper-0", "--until", "0", "--states", &path]).succeeds();
    assert!(fs::read_to_string(&path).expect("the file").starts_with("time,"));
    assert_eq!(fs::metadata(&path).expect("the file").permissions().mode() & 0o777, 0o640);
    assert_eq!(names_in(&folder), ["states.csv"]);
}

#[test]
fn a_new_file_has_the_permissions_of_any_new_file() {
    let folder = folder();
    let (ours, plain) = (in_folder(&folder, "ours"), in_folder(&folder, "plain"));
    fs::write(&plain, "").expect("a file");
    carom(&["run", "paper-0", "--until", "0", "--events", &ours]).succeeds();
    let mode = |path| fs::metadata(path).expect("the file").permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));
}

#[test]
fn a_link_stays_a_link_and_a_device_a_device() {
    let folder = folder();
    let (file, link) = (in_folder(&folder, "file"), in_folder(&folder, "link"));
    fs::write(&file, "old").expect("a file");
    symlink("file", &link).expect("a link");
    carom(&["run", "paper-0", "--until", "0", "--states", &link, "--events", "/dev/null"]).succeeds();
    assert!(fs::symlink_metadata(&link).expect("the link").is_symlink());
    assert!(fs::read_to_string(&file).expect("the file").starts_with("time,"));
    assert!(fs::metadata("/dev/null").expect("the device").file_type().is_char_device());
}

#[test]
fn what_cannot_be_written_is_said_before_the_run_and_loses_nothing() {
    let folder = folder();
    let nowhere = in_folder(&folder, "no/such/folder.csv");
    let read_only = in_folder(&folder, "read-only.csv");
    fs::write(&read_only, "precious").expect("a file");
    fs::set_permissions(&read_only, fs::Permissions::from_mode(0o444)).expect("its permissions");
    for path in [folder.path().to_str().expect("a plain path"), &nowhere, &read_only, "/", ".."] {
        let ran = carom(&["run", "paper-0", "--until", "1e9", "--states", path]).fails_with(1);
        assert!(ran.err.starts_with("carom: cannot write ") && ran.err.contains(path), "{}", ran.err);
        assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    }
    assert_eq!(fs::read_to_string(&read_only).expect("the file"), "precious");
    assert_eq!(names_in(&folder), ["read-only.csv"]);
}

#[test]
fn a_run_that_fails_to_begin_leaves_the_file_as_it_was() {
    let folder = folder();
    let path = in_folder(&folder, "states.csv");
    fs::write(&path, "precious").expect("a file");
    carom(&["run", "no-such-scene", "--states", &path]).fails_with(1);
    carom(&["run", "paper-0", "--states", &path, "--events", "/no/such/folder/file"]).fails_with(1);
    assert_eq!(fs::read_to_string(&path).expect("the file"), "precious");
    assert_eq!(names_in(&folder), ["states.csv"]);
}

#[test]
fn a_signal_ends_a_run_with_128_and_its_number_and_leaves_the_file_as_it_was() {
    for (signal, code) in [(Signal::INT, 130), (Signal::TERM, 143), (Signal::HUP, 129)] {
        let folder = folder();
        let path = in_folder(&folder, "events.csv");
        fs::write(&path, "precious").expect("a file");
        let mut child = spawn(&[&LONG[..], &["--states", "-", "--events", &path]].concat());
        let mut out = BufReader::new(child.stdout.take().expect("its stdout"));
        out.read_line(&mut String::new()).expect("the first line: it has begun");
        kill_process(Pid::from_child(&child), signal).expect("a living process");
        let ended = finish_reading(child, Some(out)); // the rest, so that it is not held up by a full pipe
        assert_eq!(ended.status.code(), Some(code), "{:?}", ended.status);
        assert_eq!(ended.stderr, MANY);
        assert_eq!(fs::read_to_string(&path).expect("the file"), "precious");
        assert_eq!(names_in(&folder), ["events.csv"]);
    }
}

#[test]
fn a_hang_up_that_is_ignored_at_the_start_stays_ignored() {
    // What nohup does, and it is passed on; the program must not take it back.
    let nohup = r#"trap "" HUP; exec "$@""#;
    let run = [&["sh", "-c", nohup, "sh", env!("CARGO_BIN_EXE_carom")], &LONG[..], &["--states", "-"]].concat();
    let mut command = std::process::Command::new("env");
    command.args(["--default-signal=TERM"]).args(run).env("TERM", "xterm");
    let mut child = piped(command);
    let mut out = BufReader::new(child.stdout.take().expect("its stdout"));
    out.read_line(&mut String::new()).expect("the first line: it has begun");
    kill_process(Pid::from_child(&child), Signal::HUP).expect("a living process");
    // More than its pipe and our buffer hold: it goes on.
    for _ in 0..20_000 {
        assert!(out.read_line(&mut String::new()).expect("a line") > 0, "it has ended");
    }
    kill_process(Pid::from_child(&child), Signal::TERM).expect("a living process");
    assert_eq!(finish_reading(child, Some(out)).status.code(), Some(143));
}

#[test]
fn a_signal_ends_a_run_whose_reader_has_fallen_asleep() {
    let mut child = spawn(&[&LONG[..], &["--states", "-"]].concat());
    let mut out = BufReader::new(child.stdout.take().expect("its stdout"));
    out.read_line(&mut String::new()).expect("the first line: it has begun");
    kill_process(Pid::from_child(&child), Signal::TERM).expect("a living process");
    let _watch = Watch::over(Pid::from_child(&child));
    assert_eq!(child.wait().expect("its end").code(), Some(143));
}

#[test]
fn a_closed_pipe_ends_a_run_in_silence() {
    let mut child = spawn(&[&LONG[..], &["--states", "-"]].concat());
    let mut out = BufReader::new(child.stdout.take().expect("its stdout"));
    out.read_line(&mut String::new()).expect("the first line");
    drop(out);
    let ended = finish(child);
    assert_eq!((ended.status.code(), ended.stderr.as_slice()), (Some(141), MANY), "{ended:?}");
}

#[test]
fn no_command_minds_a_reader_that_has_gone() {
    for arguments in [
        &["list"][..],
        &["show", "paper-0"],
        &["methods"],
        &["check", "paper-0"],
        &["run", "paper-0", "--until", "1"],
        &["render", "paper-0"],
        &["completions", "bash"],
        &["man"],
        &["--help"],
        &["--text", "paper-0"],
    ] {
        let mut command = program::command(arguments);
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let ended = finish(command.stdout(writer).stderr(Stdio::piped()).spawn().expect("the built binary"));
        drop(command);
        assert_eq!((ended.status.code(), ended.stderr.as_slice()), (Some(141), &b""[..]), "{arguments:?}: {ended:?}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_a_failure_that_is_said() {
    for arguments in [&["list"][..], &["man"], &["run", "paper-0", "--until", "1"], &["render", "paper-0"]] {
        let full = fs::File::options().write(true).open("/dev/full").expect("the full device");
        let ended = program::command(arguments).stdout(full).stderr(Stdio::piped()).spawn().expect("the built binary");
        let ended = finish(ended);
        let ran = Ran::from(ended).fails_with(1);
        assert_eq!(ran.err, "carom: cannot write standard output: No space left on device\n");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn an_exit_code_tells_even_if_nobody_can_read_why() {
    let cases: [(&[&str], i32); 5] = [
        (&["--nonsense"], 2),
        (&["run"], 2),
        (&["run", "paper-0", "--states", "-", "--events", "-"], 2),
        (&["run", "nowhere"], 1),
        (&["measure", "--merge", "nowhere.csv"], 1),
    ];
    for (arguments, code) in cases {
        let full = fs::File::options().write(true).open("/dev/full").expect("the full device");
        let child = program::command(arguments).stdout(Stdio::piped()).stderr(full).spawn().expect("the built binary");
        assert_eq!(finish(child).status.code(), Some(code), "stderr is full: {arguments:?}");
        let words = [&["-c", r#"exec "$0" "$@" 2>&-"#, env!("CARGO_BIN_EXE_carom")], arguments].concat();
        let child = std::process::Command::new("sh").args(words).stdout(Stdio::piped()).spawn().expect("a shell");
        assert_eq!(finish(child).status.code(), Some(code), "stderr is closed: {arguments:?}");
    }
    let full = fs::File::options().write(true).open("/dev/full").expect("the full device");
    let help = program::command(&["--help"]).stdout(full).stderr(Stdio::piped()).spawn().expect("the built binary");
    let said = Ran::from(finish(help)).fails_with(1).err;
    assert_eq!(said, "carom: cannot write standard output: No space left on device\n");
}
