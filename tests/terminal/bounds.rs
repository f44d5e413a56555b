//! Does it stay small: bytes of a drag, memory, processor time? Counters decide; bounds are wide where machines differ.

use std::{fs, time::Duration};

use crate::{
    HINT, Start,
    pty::{Pty, carom},
};

/// The value in kB of a line of the program's status.
fn status(pty: &Pty, name: &str) -> Option<u64> {
    let text = fs::read_to_string(format!("/proc/{}/status", pty.pid())).ok()?;
    text.lines().find_map(|line| line.strip_prefix(name))?.split_whitespace().next()?.parse().ok()
}

/// Processor time of all its threads, ms; none where the system does not tell.
fn processor_time(pty: &Pty) -> Option<f64> {
    let threads = fs::read_dir(format!("/proc/{}/task", pty.pid())).ok()?;
    let of = |thread: fs::DirEntry| fs::read_to_string(thread.path().join("schedstat")).ok();
    let times = threads.filter_map(|thread| of(thread.ok()?)?.split(' ').next()?.parse::<f64>().ok());
    Some(times.sum::<f64>() / 1e6)
}

#[test]
fn forty_sizes_in_a_second_of_a_running_gas_are_few_pictures() {
    let mut pty = carom(&["box-gas"]).run();
    pty.until_text(HINT);
    let from = pty.output.len();
    for i in 0..40 {
        pty.resize(80 + i % 20, 24 + i % 10);
        let _ = pty.read(Duration::from_millis(25)); // the pace of a hand, or as soon as something comes
    }
    pty.until("the last size", |screen| screen.contents().lines().count() >= 33);
    let (bytes, pictures) = (pty.output.len() - from, pty.pictures_since(from));
    // Two whole pictures of 7 KB; half a second later at most would be another one, and a busy machine is slower.
    assert!(pictures <= 5 && bytes <= 40_000, "{pictures} pictures, {bytes} bytes");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}

#[test]
fn memory_beyond_the_scene_is_six_megabytes_at_most() {
    for scene in ["paper-0", "box-gas"] {
        let mut pty = Start { size: (200, 60), ..carom(&[scene]) }.run();
        pty.until_text(HINT);
        for keys in ["?", "\x1b", "o", "\x1b", "i", "d", "v", "zzz"] {
            pty.send(keys);
            let _ = pty.read(Duration::from_millis(100));
        }
        let Some(memory) = status(&pty, "RssAnon:") else { return }; // only Linux tells
        assert!(memory <= 6000, "{scene}: {memory} kB");
        pty.send("q");
        assert_eq!(pty.exit(), 0);
    }
}

#[test]
fn the_first_picture_costs_little_and_a_pause_nothing() {
    let mut pty = carom(&["paper-2", "--paused"]).run();
    pty.until_text(HINT);
    let Some(first) = processor_time(&pty) else { return }; // only Linux tells
    assert!(first <= 80.0, "{first} ms, ten times what it should be");
    while pty.read(Duration::from_millis(300)).is_some() {}
    let (before, from) = (processor_time(&pty).expect("it told"), pty.output.len());
    assert_eq!(pty.look_away(Duration::from_secs(2)), None);
    let spent = processor_time(&pty).expect("it told") - before;
    assert!(spent <= 20.0, "{spent} ms in 2 s, ten times what it should be");
    assert_eq!(pty.read(Duration::from_millis(50)), None, "after {from} bytes nothing");
    pty.send("q");
    assert_eq!(pty.exit(), 0);
}
