//! Does it hold for long? The whole program at full speed on one processor, the exact run beside it, its memory watched.
//!
//! `CAROM_SOAK=18000 cargo test --release --test soak -- --nocapture` looks at 18 000 pictures of each scene, ten minutes
//! at thirty a second; without the variable it is some seconds.

#![cfg(target_os = "linux")] // memory by /proc, one processor by affinity

// A soak tells what it met.
#![allow(clippy::print_stdout)]

#[allow(dead_code)] // each test crate uses what it needs
#[path = "support/pty.rs"]
mod pty;
#[path = "support/watch.rs"]
mod watch;

use std::fs;

use pty::{PATIENCE, Pty, carom};
use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};

/// Pictures looked at in the ordinary tests.
const FEW: usize = 150;

/// The memory may grow by this much after the first quarter, bytes: what allocators keep, and a few snapshots. The fault
/// that this test is for took 60 MB a second.
const SLACK: u64 = 24 << 20;

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
        pty.output.clear(); // ours must not grow either
    }
}

fn soak(scene: &str) {
    let pictures = std::env::var("CAROM_SOAK").map_or(FEW, |count| count.parse().expect("CAROM_SOAK is a number"));
    let mut pty = carom(&[scene]).run();
    pty.until_text("space pause");
    pty.send(":speed 1e9\rx");
    look_at(&mut pty, pictures / 4);
    let early = pty.memory();
    let mut most = early;
    for _ in 0..10 {
        look_at(&mut pty, pictures * 3 / 40);
        most = most.max(pty.memory());
    }
    println!("{scene}: {pictures} pictures, {} MiB after a quarter, then {} MiB at most", early >> 20, most >> 20);
    assert!(early > 0, "the memory is measured");
    assert!(most <= early + SLACK, "{scene}: from {early} to {most} bytes");
    pty.send("\x03");
    assert_eq!(pty.exit(), 0);
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
    soak(path.to_str().expect("its name is text"));
    soak("box-gas");
}
