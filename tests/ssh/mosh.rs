//! Does it work in a real mosh session, whose server answers for the terminal?

use std::fs;
use std::process::Command;

use crate::{
    CAROM, ends, process,
    screen::{SIZE, Screen},
    server::tool,
};

/// A session of mosh with a command; lost clients are waited for one second.
fn session(command: &str) -> Screen {
    let server = Command::new(tool("mosh-server"))
        .args(["new", "-i", "127.0.0.1", "-p", "60001:60999", "--", "sh", "-c", command])
        .env("LC_ALL", "C.UTF-8")
        .env("TERM", "xterm-256color")
        .env("MOSH_SERVER_NETWORK_TMOUT", "1")
        .output()
        .expect("mosh-server");
    let said = String::from_utf8_lossy(&server.stdout).into_owned() + &String::from_utf8_lossy(&server.stderr);
    let line = said.lines().find_map(|line| line.strip_prefix("MOSH CONNECT "));
    let (port, key) = line.and_then(|line| line.split_once(' ')).unwrap_or_else(|| panic!("no session: {said}"));
    let arguments = ["LC_ALL=C.UTF-8".into(), format!("MOSH_KEY={key}"), tool("mosh-client"), "127.0.0.1".into()];
    let arguments: Vec<String> = arguments.into_iter().chain([port.to_string()]).collect();
    Screen::start(&tool("env"), &arguments, SIZE)
}

#[test]
fn in_mosh_a_frame_comes_a_key_is_obeyed_and_q_ends_it() {
    let mut screen = session(&format!("exec {CAROM} box-gas"));
    screen.wait_for("first frame", |shown| shown.contains("RUN") && shown.contains("box-gas"));
    screen.press("?");
    screen.wait_for("help", |shown| shown.contains("Esc closes"));
    screen.press(" ");
    screen.wait_for("pause", |shown| shown.contains("PAUSE"));
    screen.press("q");
    assert_eq!(screen.end(), 0);
}

#[test]
fn a_lost_mosh_client_leaves_no_process_behind() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let note = folder.path().join("pid");
    let mut screen = session(&format!("echo $$ > {}; exec {CAROM} box-gas", note.display()));
    screen.wait_for("first frame", |shown| shown.contains("RUN") && shown.contains("box-gas"));
    let process = process(&fs::read_to_string(note).expect("its number"));
    screen.kill();
    assert!(ends(&process), "it still runs without a terminal");
}
