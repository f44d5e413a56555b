//! Does it hold for long? The whole program at full speed on one processor, the exact run beside it, its memory watched.
//!
//! `CAROM_SOAK=18000 cargo test --release --test soak -- --nocapture` looks at 18 000 pictures of each run, ten minutes at
//! thirty a second; without the variable it is some seconds.

#![cfg(target_os = "linux")] // memory by /proc, one processor by affinity

// A soak tells what it met.
#![allow(clippy::print_stdout)]

#[allow(dead_code)] // each test crate uses what it needs
#[path = "support/pty.rs"]
mod pty;
#[path = "support/watch.rs"]
mod watch;

use std::{
    fs,
    sync::{Arc, mpsc},
    time::Duration,
};

use ::carom::{
    scene::{self, Method, Settings},
    snapshot::Stage,
    worker::{Activity, Command, Job, Worker},
};

use pty::{PATIENCE, Pty};
use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};

/// Pictures looked at in the ordinary tests.
const FEW: usize = 150;

/// From so many pictures on all that a run and the exact one beside it ever set up is there after a quarter of them.
const LONG: usize = 9000;

/// How often the memory is read.
const READINGS: usize = 40;

/// A picture takes a thirtieth of a second, and on a busy machine ten times that.
const PICTURE: Duration = Duration::from_millis(333);

/// glibc keeps the holes that large blocks leave, and fills them only if what comes next fits. With this setting every
/// block above 128 KiB goes back to the system when it is freed: what is measured then is what the program holds.
const NO_HOLES: &[(&str, &str)] = &[("MALLOC_MMAP_THRESHOLD_", "131072")];

/// The holes that may be new in the second half of a long run, bytes. Every few seconds the exact run reorders its
/// spheres (1.3 MB in the crowd) into a new block. A snapshot's array that is alive then can keep such a hole from being
/// used again; of those there are a dozen. A run that was left to itself for ten minutes took the last one after two.
const HOLES: u64 = 8 << 20;

/// What may be held beyond the first half of a long run, bytes: a snapshot of the crowd is half a megabyte, and how many
/// are on their way at once is chance. A loss of 10 kB a second is more in ten minutes.
const CHANCE: u64 = 2 << 20;

/// In a short run: all that is set up only when a thread first gets the processor, the exact run's two displaced ones
/// above all. The fault that this test is for took 60 MB a second.
const SETUP: u64 = 24 << 20;

/// Leaves the thread, and what it starts, one processor.
fn on_one_processor() {
    let all = sched_getaffinity(None).expect("the processors that are ours");
    let first = (0..CpuSet::MAX_CPU).find(|processor| all.is_set(*processor)).expect("one at least");
    let mut one = CpuSet::new();
    one.set(first);
    sched_setaffinity(None, &one).expect("a thread may do with less");
}

/// Reads on until so many more pictures have come.
fn look_at(pty: &mut Pty, pictures: usize) {
    let mut seen = 0;
    while seen < pictures {
        let bytes = pty.read(PATIENCE).filter(|bytes| !bytes.is_empty()).expect("pictures go on coming");
        seen += bytes.windows(8).filter(|bytes| *bytes == b"\x1b[?2026h").count();
        pty.forget_output(); // ours must not grow either
    }
}

/// How much more the memory was in the last part of the readings than ever before, bytes: those after a warm-up of a
/// quarter are halved.
fn growth(readings: &[u64]) -> u64 {
    let warm = &readings[readings.len() / 4..];
    let (first, second) = warm.split_at(warm.len() / 2);
    let most = |part: &[u64]| part.iter().copied().max().unwrap_or(0);
    most(second).saturating_sub(most(first))
}

fn soak(scene: &str, environment: &[(&str, &str)], slack: u64) {
    let pictures = std::env::var("CAROM_SOAK").map_or(FEW, |count| count.parse().expect("CAROM_SOAK is a number"));
    let slack = if pictures < LONG { SETUP } else { slack };
    let mut pty = pty::Start { environment, ..pty::carom(&[scene]) }.run();
    pty.allow(PATIENCE + PICTURE * pictures as u32);
    pty.until_text("space pause");
    pty.send(":speed 1e9\rx");
    let readings: Vec<u64> = (0..READINGS)
        .map(|_| {
            look_at(&mut pty, pictures.div_ceil(READINGS));
            pty.memory()
        })
        .collect();
    let told: Vec<String> = readings.iter().map(|bytes| format!("{:.1}", *bytes as f64 / f64::from(1 << 20))).collect();
    println!("{scene}, {pictures} pictures, {environment:?}: {} MiB", told.join(" "));
    assert!(readings.iter().all(|&bytes| bytes > 0), "the memory is measured");
    assert!(growth(&readings) <= slack, "{scene}: {slack} bytes more are allowed than {told:?} MiB");
    pty.send("\x03");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn what_grows_without_end_is_told_from_what_has_come_to_an_end() {
    let mebibytes = |of: fn(u64) -> u64| (0..READINGS as u64).map(of).map(|n| n << 20).collect::<Vec<_>>();
    assert_eq!(growth(&mebibytes(|_| 20)), 0);
    assert_eq!(growth(&mebibytes(|n| if n < 12 { 20 + n } else { 32 })), 0, "it has come to an end");
    assert_eq!(growth(&mebibytes(|n| 20 + n % 3)), 0, "it comes and goes");
    assert_eq!(growth(&mebibytes(|n| 20 + n)), 15 << 20, "a mebibyte in each of the last fifteen readings");
    assert!(growth(&mebibytes(|n| 20 + n / 4)) > CHANCE, "a quarter of that");
    assert_eq!(growth(&mebibytes(|n| if n == 39 { 60 } else { 20 })), 40 << 20, "at the very end");
}

/// A crowd of which a moment takes a third of a megabyte, so that some hundred frames fill the room for the past.
const CROWD: &str = "Scene(duration: 100, contact: (restitution: 1, tangential: 1, rest_speed: 0), \
                     walls: [Room(min: (-10, 0, -10), max: (10, 20, 10))], spheres: [Gas(min: (-10, 0, -10), \
                     max: (10, 20, 10), count: 10000, seed: 7, speed: 1, mass: 1, radius: 0.1)])";

/// Resident memory of this process, bytes.
fn resident() -> u64 {
    let pages = fs::read_to_string("/proc/self/statm").expect("the system tells");
    let pages: u64 = pages.split(' ').nth(1).and_then(|pages| pages.parse().ok()).expect("a number");
    pages * 4096
}

#[test]
fn the_past_of_a_crowd_stays_within_its_64_mebibytes_of_the_process() {
    let scene = Arc::new(scene::parse(CROWD, "crowd").expect("a scene"));
    let stage = Arc::new(Stage::of("crowd", &scene));
    let settings = Settings { method: Method::Paper, ..scene.solver };
    let before = resident();
    let (sender, news) = mpsc::channel();
    let notify = Arc::new(move || {
        let _ = sender.send(());
    });
    let mut worker = Worker::start(Job { stage, scene, settings, recording: None }, 1.0, notify).expect("a thread");
    worker.send(Command::Forward(600));
    let report = loop {
        let report = worker.take();
        if report.obeyed == worker.sent() && report.activity != Activity::Running {
            break report;
        }
        news.recv_timeout(PATIENCE).expect("it goes on");
    };
    let grown = resident() - before;
    assert!(report.kept.oldest > 0, "the room was full: frames from {} on are kept", report.kept.oldest);
    // beside the past there are the run itself and its snapshots
    assert!((40 << 20..(64 << 20) + SETUP).contains(&grown), "{grown} bytes");
}

#[test]
fn at_full_speed_with_the_exact_run_beside_it_the_memory_stays_flat() {
    on_one_processor();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("crowd.ron");
    // Snapshots of half a megabyte, and far more work than one processor does.
    let crowd = "Scene(duration: 1000, contact: (restitution: 1, rest_speed: 0), \
                 walls: [Room(min: (0, 0, 0), max: (50, 50, 50))], spheres: [Gas(min: (0, 0, 0), max: (50, 50, 50), \
                 count: 10000, seed: 1, speed: 1, mass: 1, radius: 0.1)])";
    fs::write(&path, crowd).expect("it can be written");
    let crowd = path.to_str().expect("its name is text");
    soak(crowd, NO_HOLES, CHANCE);
    soak(crowd, &[], HOLES);
    soak("box-gas", &[], CHANCE);
}
