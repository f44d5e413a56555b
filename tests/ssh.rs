//! Does it work where it will be used: over SSH and in tmux? Real programs on the loopback, nothing simulated.

#[path = "ssh/lines.rs"]
mod lines;
#[path = "ssh/mosh.rs"]
mod mosh;
#[path = "ssh/screen.rs"]
mod screen;
#[path = "ssh/server.rs"]
mod server;
#[path = "../benches/thin_line/wire.rs"]
mod wire;

use std::fs;
use std::os::fd::OwnedFd;
use std::process::Command;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::process::{Pid, PidfdFlags, pidfd_open};
use screen::{SIZE, Screen};
use server::{Server, tool};

/// Longest life of a program after its terminal, s; reached only by a test that fails.
const PATIENCE: Timespec = Timespec { tv_sec: 30, tv_nsec: 0 };

/// The built binary.
const CAROM: &str = env!("CARGO_BIN_EXE_carom");

/// The status line and the hints of a whole frame.
fn is_frame(shown: &str) -> bool {
    shown.contains("PAUSE") && shown.contains("paper-1") && shown.contains("help")
}

/// What the status line says of the time.
fn time(shown: &str) -> String {
    let words: Vec<&str> = shown.lines().next().unwrap_or("").split_whitespace().collect();
    let at = words.iter().position(|word| *word == "t").unwrap_or_else(|| panic!("no time in {words:?}"));
    words[at + 1].to_string()
}

fn over_ssh(server: &Server, command: &str) -> Screen {
    Screen::start(&tool("ssh"), &server.arguments(server.port(), command), SIZE)
}

#[test]
fn over_ssh_a_frame_comes_a_key_is_obeyed_and_q_ends_it() {
    let server = Server::start();
    let mut screen = over_ssh(&server, &format!("exec {CAROM} paper-1 --paused"));
    let first = screen.wait_for("first frame", is_frame);
    screen.press(".");
    screen.wait_for("step", |shown| is_frame(shown) && time(shown) != time(&first));
    screen.press("q");
    assert_eq!(screen.end(), 0);
}

#[test]
fn over_ssh_the_exit_code_of_a_failure_arrives_with_its_line() {
    let server = Server::start();
    let mut screen = over_ssh(&server, &format!("exec {CAROM} no-such-scene"));
    let shown = screen.wait_for("message", |shown| shown.contains("no-such-scene"));
    assert!(shown.starts_with("carom: "), "{shown}");
    assert_eq!(screen.end(), 1);
}

#[test]
fn a_cut_connection_leaves_no_process_behind() {
    let server = Server::start();
    no_orphan(&server, "");
}

#[test]
fn a_cut_connection_leaves_no_process_behind_even_if_hangups_are_ignored() {
    let server = Server::start();
    no_orphan(&server, "trap '' HUP; ");
}

/// A process whose terminal has gone once lived for ever, with all of one core.
fn no_orphan(server: &Server, before: &str) {
    let note = server.path("pid");
    let command = format!("{before}echo $$ > {}; exec {CAROM} paper-1 --paused", note.display());
    let mut screen = over_ssh(server, &command);
    screen.wait_for("first frame", is_frame);
    let process = process(&fs::read_to_string(note).expect("its number"));
    screen.press(" ");
    screen.wait_for("run", |shown| shown.contains("RUN"));
    screen.kill();
    assert!(ends(&process), "it still runs without a terminal");
}

/// A handle of a process that is not ours to wait for.
fn process(number: &str) -> OwnedFd {
    let pid = number.trim().parse().ok().and_then(Pid::from_raw).expect("a process number");
    pidfd_open(pid, PidfdFlags::empty()).expect("a living process")
}

fn ends(process: &OwnedFd) -> bool {
    poll(&mut [PollFd::new(process, PollFlags::IN)], Some(&PATIENCE)).expect("a poll") == 1
}

/// A tmux server of its own, gone with its owner.
struct Tmux {
    folder: tempfile::TempDir,
}

impl Tmux {
    fn new() -> Tmux {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::write(folder.path().join("conf"), "set -g status off\n").expect("a file");
        Tmux { folder }
    }

    fn arguments(&self, more: &[&str]) -> Vec<String> {
        let path = |name: &str| self.folder.path().join(name).display().to_string();
        let own = ["-u".to_string(), "-S".into(), path("socket"), "-f".into(), path("conf")];
        own.into_iter().chain(more.iter().map(|word| word.to_string())).collect()
    }

    fn tell(&self, words: &[&str]) -> String {
        let ran = Command::new(tool("tmux")).args(self.arguments(words)).output().expect("tmux");
        assert!(ran.status.success(), "{words:?}: {}", String::from_utf8_lossy(&ran.stderr));
        String::from_utf8(ran.stdout).expect("text")
    }
}

impl Drop for Tmux {
    fn drop(&mut self) {
        let _ = Command::new(tool("tmux")).args(self.arguments(&["kill-server"])).output();
    }
}

#[test]
fn in_tmux_a_frame_comes_a_key_is_obeyed_and_q_ends_it() {
    let tmux = Tmux::new();
    let command = format!("exec {CAROM} paper-1 --paused");
    let mut screen = Screen::start(&tool("tmux"), &tmux.arguments(&["new-session", "-s", "carom", &command]), SIZE);
    let first = screen.wait_for("first frame", is_frame);
    tmux.tell(&["send-keys", "-t", "carom", "."]);
    screen.wait_for("step", |shown| is_frame(shown) && time(shown) != time(&first));
    let captured = tmux.tell(&["capture-pane", "-p", "-t", "carom"]);
    assert!(is_frame(&captured) && time(&captured) != time(&first), "{captured}");
    assert_eq!(captured.lines().count(), 24, "{captured}");
    tmux.tell(&["send-keys", "-t", "carom", "q"]);
    assert_eq!(screen.end(), 0);
}

#[test]
fn the_screen_and_render_show_the_same_frame() {
    let tmux = Tmux::new();
    let command = format!("exec {CAROM} paper-1 --paused");
    let mut screen = Screen::start(&tool("tmux"), &tmux.arguments(&["new-session", "-s", "carom", &command]), SIZE);
    screen.wait_for("first frame", is_frame);
    let shown = tmux.tell(&["capture-pane", "-p", "-t", "carom"]);
    let rendered = Command::new(CAROM).args(["render", "paper-1"]).output().expect("the built binary");
    assert_eq!(shown, String::from_utf8(rendered.stdout).expect("text"));
    screen.press("q");
    assert_eq!(screen.end(), 0);
}

#[test]
fn a_killed_tmux_leaves_no_process_behind() {
    let tmux = Tmux::new();
    let note = tmux.folder.path().join("pid");
    let command = format!("echo $$ > {}; exec {CAROM} paper-1 --paused", note.display());
    let mut screen = Screen::start(&tool("tmux"), &tmux.arguments(&["new-session", "-s", "carom", &command]), SIZE);
    screen.wait_for("first frame", is_frame);
    let process = process(&fs::read_to_string(note).expect("its number"));
    tmux.tell(&["kill-server"]);
    assert!(ends(&process), "it still runs without a terminal");
    screen.end();
}
