//! How quick is the program at the far end of a thin or a long line? A real sshd behind a proxy that shapes rate and delay.
//!
//! A row of the table is a session: `?` is pressed at all moments of the rhythm while the scene runs, and the time until
//! the whole picture with the help has come is taken; the time from `q` to the end of ssh; pictures per second; and how
//! many pictures of long ago come after the reader has looked away for ten seconds. The scene and the line can be named:
//! `cargo bench --bench thin_line -- box-gas 64`.

// Not a test: it prints, and it reads the clock.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[allow(dead_code)] // the tests use the rest
#[path = "../../tests/ssh/screen.rs"]
mod screen;
#[allow(dead_code)]
#[path = "../../tests/ssh/server.rs"]
mod server;
mod wire;

use std::time::{Duration, Instant};

use screen::Screen;
use server::{Server, tool};
use wire::{LONG, THIN, THINNEST, Wire, timed};

const CAROM: &str = env!("CARGO_BIN_EXE_carom");

/// Keys per session.
const KEYS: usize = 20;

/// The sessions: scene, columns and rows.
const SESSIONS: [(&str, (u16, u16)); 3] = [("box-gas", (80, 24)), ("box-gas", (120, 40)), ("elastic-666", (80, 24))];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let chosen = |name: &str| words.iter().any(|word| word == name);
    let none_of = |names: &[&str]| !names.iter().any(|name| chosen(name));
    println!("| line | scene | key to screen, median | p95 | `q` | frames/s | stale after 10 s |");
    println!("|---|---|---|---|---|---|---|");
    for wire in [THIN, THINNEST, LONG] {
        let lines = ["256", "64", "10000"];
        if !chosen(&wire.kilobits.to_string()) && !none_of(&lines) {
            continue;
        }
        for (scene, size) in SESSIONS {
            if chosen(scene) || none_of(&["box-gas", "elastic-666"]) {
                println!("{}", row(wire, scene, size));
            }
        }
    }
}

fn row(wire: Wire, scene: &str, size: (u16, u16)) -> String {
    let server = Server::start();
    let mut screen = start(&server, wire, scene, size);
    watch(&mut screen, Duration::from_secs(2));
    let (before, span) = (screen.complete, Duration::from_secs(4));
    watch(&mut screen, span);
    let rate = (screen.complete - before) as f64 / span.as_secs_f64();
    let mut keys: Vec<Duration> = (0..KEYS).map(|i| press(&mut screen, i)).collect();
    keys.sort();
    let begun = screen.begun;
    screen.look_away(Duration::from_secs(10));
    screen.wait_for("word about the silence", |shown| shown.contains("The line was silent for"));
    let stale = screen.begun - begun - 1; // the last is the one that tells
    watch(&mut screen, Duration::from_secs(2));
    let mut ends: Vec<Duration> = (0..3).map(|_| quit(&server, wire, scene, size)).collect();
    ends.sort();
    format!(
        "| {} kbit/s, {} ms | {scene} {}×{} | {} ms | {} ms | {} ms | {rate:.1} | {stale} |",
        wire.kilobits,
        wire.trip.as_millis(),
        size.0,
        size.1,
        keys[KEYS / 2].as_millis(),
        keys[KEYS * 95 / 100].as_millis(),
        ends[1].as_millis(),
    )
}

fn start(server: &Server, wire: Wire, scene: &str, size: (u16, u16)) -> Screen {
    let arguments = server.arguments(wire.lay(server.port()), &format!("exec {CAROM} {scene}"));
    let mut screen = Screen::start(&tool("ssh"), &arguments, size);
    screen.wait_for("first frame", |shown| shown.contains(scene) && shown.contains("help"));
    screen
}

/// Looks on for that long.
fn watch(screen: &mut Screen, time: Duration) {
    let end = Instant::now() + time;
    while screen.read(end.saturating_duration_since(Instant::now())).is_ok() {}
}

/// From `?` to the whole picture with the help; then the help is closed.
fn press(screen: &mut Screen, index: usize) -> Duration {
    // Some moment of the rhythm, the same ones each time.
    watch(screen, Duration::from_millis(500 + 37 * index as u64 % 501));
    let wait_for = |screen: &mut Screen, help: bool| {
        while screen.text().contains("Esc closes") != help || screen.begun != screen.complete {
            screen.read(Duration::from_secs(60)).expect("an answer");
        }
    };
    let ((), time) = timed(|| {
        screen.press("?");
        wait_for(screen, true);
    });
    screen.press("?");
    wait_for(screen, false);
    time
}

/// From `q` to the end of ssh, in a session of its own.
fn quit(server: &Server, wire: Wire, scene: &str, size: (u16, u16)) -> Duration {
    let mut screen = start(server, wire, scene, size);
    watch(&mut screen, Duration::from_millis(2500));
    let (code, time) = timed(|| {
        screen.press("q");
        screen.end()
    });
    assert_eq!(code, 0);
    time
}
