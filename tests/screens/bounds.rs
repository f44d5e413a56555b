//! Does nothing grow without bound, however fast things come and however slowly they are taken?

use std::sync::{Arc, Weak, mpsc};

use carom::{
    physics::{Simulation, Until},
    scene,
    snapshot::{Snapshot, Stage},
    worker::ExactFollower,
};

/// As many snapshots as a run sends in a quarter of an hour.
const MANY: usize = 50_000;

#[test]
fn an_exact_run_that_falls_behind_holds_a_few_snapshots_at_most() {
    let scene = Arc::new(scene::open("elastic-666").expect("built in").scene);
    let stage = Arc::new(Stage::of("elastic-666", &scene));
    let mut run = Simulation::new(&scene, scene.solver);
    let _ = run.advance(Until::Frame, u64::MAX);
    // The exact run has a long way to go to this moment, and each snapshot sends it there anew.
    let far = Snapshot { t: 1e6, ..Snapshot::of(&stage, &run, None) };
    let beside = ExactFollower::start(scene, None, Arc::new(|| {})).expect("a thread");
    let mut sent: Vec<Weak<Snapshot>> = Vec::new();
    for _ in 0..MANY {
        let snapshot = Arc::new(far.clone());
        beside.compare(&snapshot);
        sent.push(Arc::downgrade(&snapshot));
        drop(snapshot);
        sent.retain(|snapshot| snapshot.strong_count() > 0);
        // And a fourth for the moment in which the one that is next gives way to the one just read.
        assert!(sent.len() <= 4, "one in the mailbox, one that is next, one under way; not {}", sent.len());
    }
}

#[test]
fn an_exact_run_asked_for_and_given_up_again_and_again_begins_once_at_a_time() {
    let scene = Arc::new(scene::open("paper-2").expect("built in").scene);
    let (told, news) = mpsc::channel();
    let mut before = None;
    for _ in 0..200 {
        let told = told.clone();
        let notify = Arc::new(move || {
            let _ = told.send(());
        });
        before = Some(ExactFollower::start(Arc::clone(&scene), before, notify).expect("a thread").end());
    }
    let told_last = told.clone();
    let notify = Arc::new(move || {
        let _ = told_last.send(());
    });
    let last = ExactFollower::start(Arc::clone(&scene), before, notify).expect("a thread");
    let stage = Arc::new(Stage::of("paper-2", &scene));
    last.compare(&Arc::new(Snapshot::of(&stage, &Simulation::new(&scene, scene.solver), None)));
    // None of the others has a snapshot to compare with: only the last tells anything, after all of them have ended.
    news.recv_timeout(std::time::Duration::from_secs(60)).expect("the last one's ghost");
    assert!(last.take().is_some());
    // The threads that ended hold the scene no more: the last one has it, and this test.
    assert_eq!(Arc::strong_count(&scene), 2);
}
