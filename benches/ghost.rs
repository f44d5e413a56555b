//! Does the exact run beside a run slow it down? Simulated time that a worker reaches in a second of wall time with and
//! without the other thread, turn and turn about; the ratio of the best of each. `cargo bench --bench ghost`

// Results go to stdout: this is a program for people.
#![allow(clippy::print_stdout)]

use std::{
    sync::{Arc, mpsc},
    time::{Duration, Instant},
};

use carom::{
    scene,
    snapshot::Stage,
    worker::{Command, ExactFollower, Job, Worker},
};

/// Length of a turn.
const TURN: Duration = Duration::from_secs(1);

/// Turns of each kind.
const TURNS: usize = 7;

fn main() {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    println!("simulated seconds in one second, {cores} cores   alone   beside exact   ratio");
    for name in ["paper-0", "paper-2", "box-gas"] {
        let (mut alone, mut beside) = (0.0_f64, 0.0_f64);
        for _ in 0..TURNS {
            alone = alone.max(reached(name, false));
            beside = beside.max(reached(name, true));
        }
        println!("{name:<40} {alone:>10.2} {beside:>14.2} {:>7.3}", beside / alone);
    }
}

/// How far a run as fast as possible comes in a turn, s, its snapshots handed on as the application does.
fn reached(name: &str, compared: bool) -> f64 {
    let scene = Arc::new(scene::open(name).expect("built in").scene);
    let (sender, news) = mpsc::channel();
    let notify = Arc::new(move || {
        let _ = sender.send(());
    });
    let (stage, settings) = (Arc::new(Stage::of(name, &scene)), scene.solver);
    let job = Job { stage, scene: Arc::clone(&scene), settings, recording: None };
    let mut worker = Worker::start(job, 1e9, notify.clone()).expect("a thread");
    let beside = compared.then(|| ExactFollower::start(scene, None, notify).expect("a thread"));
    worker.send(Command::Run(true));
    let start = Instant::now();
    while start.elapsed() < TURN {
        let _ = news.recv_timeout(TURN.saturating_sub(start.elapsed()));
        let report = worker.take();
        if let Some(beside) = &beside {
            beside.compare(&report.snapshot);
            let _ = beside.take();
        }
    }
    worker.take().snapshot.t
}
