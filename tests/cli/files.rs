//! Files that are replaced as a whole or not at all, and streams whose readers go, sleep or are full.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

use rustix::process::{Pid, Signal, kill_process};

use crate::program::{self, Ran, carom, folder, in_folder, names_in, spawn};

/// Long enough for a pipe to be full many times over, whatever the machine.
const LONG: [&str; 6] = ["run", "paper-0", "--until", "1e6", "--every", "1e-4"];

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
        out.read_to_end(&mut Vec::new()).expect("the rest, so that it is not held up by a full pipe");
        let ended = child.wait_with_output().expect("its end");
        assert_eq!(ended.status.code(), Some(code), "{ended:?}");
        assert!(ended.stderr.is_empty(), "{ended:?}");
        assert_eq!(fs::read_to_string(&path).expect("the file"), "precious");
        assert_eq!(names_in(&folder), ["events.csv"]);
    }
}

#[test]
fn a_signal_ends_a_run_whose_reader_has_fallen_asleep() {
    let mut child = spawn(&[&LONG[..], &["--states", "-"]].concat());
    let mut out = BufReader::new(child.stdout.take().expect("its stdout"));
    out.read_line(&mut String::new()).expect("the first line: it has begun");
    kill_process(Pid::from_child(&child), Signal::TERM).expect("a living process");
    assert_eq!(child.wait().expect("its end").code(), Some(143));
}

#[test]
fn a_closed_pipe_ends_a_run_in_silence() {
    let mut child = spawn(&[&LONG[..], &["--states", "-"]].concat());
    let mut out = BufReader::new(child.stdout.take().expect("its stdout"));
    out.read_line(&mut String::new()).expect("the first line");
    drop(out);
    let ended = child.wait_with_output().expect("its end");
    assert_eq!((ended.status.code(), ended.stderr.as_slice()), (Some(141), &b""[..]), "{ended:?}");
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
        let ended = command.stdout(writer).output().expect("its end");
        assert_eq!((ended.status.code(), ended.stderr.as_slice()), (Some(141), &b""[..]), "{arguments:?}: {ended:?}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_a_failure_that_is_said() {
    for arguments in [&["list"][..], &["man"], &["run", "paper-0", "--until", "1"], &["render", "paper-0"]] {
        let full = fs::File::options().write(true).open("/dev/full").expect("the full device");
        let ended = program::command(arguments).stdout(full).output().expect("its end");
        let ran = Ran::from(ended).fails_with(1);
        assert_eq!(ran.err, "carom: cannot write standard output: No space left on device\n");
    }
}
