//! The exact run beside a run: a second thread that follows the first one's snapshots and says how far they are off.
//!
//! It never slows the run down: snapshots are handed over, not asked for; a snapshot that comes while the exact run is
//! still on its way to an earlier one replaces the one waiting; and the thread is the last to get a processor.

use std::{
    sync::{
        Arc,
        mpsc::{self, Receiver, Sender, TryRecvError},
    },
    thread,
};

use super::{Notify, slot::Slot};
use crate::{
    measure::Growth,
    physics::{Method, Progress, Settings, Simulation, Until},
    scene::Scene,
    snapshot::{Ghost, Snapshot},
};

/// Work between two looks at what has arrived: some milliseconds. No bit of a result depends on it.
const SLICE: u64 = 10_000;

/// The exact run of a scene, seen from the run that is measured by it. Dropping it ends its thread.
pub struct Beside {
    snapshots: Sender<Arc<Snapshot>>,
    slot: Arc<Slot<Option<Ghost>>>,
}

impl Beside {
    /// Starts an exact run of `scene` in a thread, which calls `notify` when there is a ghost that nobody has taken.
    ///
    /// # Errors
    /// If the system has no thread to give.
    pub fn start(scene: Arc<Scene>, notify: Notify) -> std::io::Result<Beside> {
        let (snapshots, inbox) = mpsc::channel();
        let slot = Arc::new(Slot::new(None, notify));
        let theirs = Arc::clone(&slot);
        thread::Builder::new().name("exact".into()).spawn(move || {
            step_back();
            let mut follower = Follower::new(scene, inbox);
            while follower.follow(&theirs).is_some() {}
        })?;
        Ok(Beside { snapshots, slot })
    }

    /// Says where the run is; the answer is a later ghost, or none if a newer snapshot comes first.
    pub fn compare(&self, snapshot: &Arc<Snapshot>) {
        let _ = self.snapshots.send(Arc::clone(snapshot)); // a thread that has ended has said why
    }

    /// The latest ghost, if there is one yet.
    pub fn take(&self) -> Arc<Option<Ghost>> {
        self.slot.take()
    }
}

/// Lets all other threads go first, where the system knows priorities of threads.
fn step_back() {
    #[cfg(target_os = "linux")]
    let _ = rustix::process::setpriority_process(Some(rustix::thread::gettid()), 19);
}

/// What the thread knows.
struct Follower {
    scene: Arc<Scene>,
    inbox: Receiver<Arc<Snapshot>>,
    exact: Simulation,
    growth: Growth,
    /// What was said last.
    ghost: Option<Ghost>,
    /// Largest |energy| that the exact run was seen with, J: what energy errors are relative to.
    energy_scale: f64,
    /// The newest snapshot that has arrived and waits.
    next: Option<Arc<Snapshot>>,
}

impl Follower {
    fn new(scene: Arc<Scene>, inbox: Receiver<Arc<Snapshot>>) -> Follower {
        let (exact, growth) = (begin(&scene), Growth::of(&scene));
        let energy_scale = exact.initial_energy().abs();
        Follower { scene, inbox, exact, growth, ghost: None, energy_scale, next: None }
    }

    /// Waits for a snapshot, goes as far as it is, and compares; `None` if nobody is left to send one.
    fn follow(&mut self, slot: &Slot<Option<Ghost>>) -> Option<()> {
        self.listen()?;
        let Some(target) = self.next.take() else { return self.look_ahead(slot) };
        if target.t < self.exact.time() - self.exact.step() {
            self.exact = begin(&self.scene);
        }
        let mut stall = None;
        while self.exact.time() < target.t && stall.is_none() {
            if let Progress::Stalled(reason) = self.exact.advance(Until::Time(target.t), SLICE) {
                stall = Some(reason.reason);
            }
            self.listen()?;
            if self.next.as_ref().is_some_and(|next| next.t < target.t) {
                return Some(()); // the run has begun again
            }
        }
        self.ghost = Some(self.compare(&target, stall));
        slot.put(self.ghost.clone());
        Some(())
    }

    /// With nothing to compare: looks for the horizon up to where the run is, then waits for a snapshot.
    fn look_ahead(&mut self, slot: &Slot<Option<Ghost>>) -> Option<()> {
        let Some(ghost) = self.ghost.as_mut().filter(|ghost| self.growth.is_behind(ghost.t)) else {
            self.next = Some(self.inbox.recv().ok()?);
            return Some(());
        };
        self.growth.advance(SLICE);
        if self.growth.horizon().is_some() {
            ghost.horizon = self.growth.horizon();
            slot.put(self.ghost.clone());
        }
        Some(())
    }

    /// Keeps the newest snapshot that has arrived; `None` if nobody is left to send one.
    fn listen(&mut self) -> Option<()> {
        loop {
            match self.inbox.try_recv() {
                Ok(snapshot) => self.next = Some(snapshot),
                Err(TryRecvError::Empty) => return Some(()),
                Err(TryRecvError::Disconnected) => return None,
            }
        }
    }

    fn compare(&mut self, run: &Snapshot, stall: Option<String>) -> Ghost {
        let state = self.exact.at(run.t);
        let energy = state.energy(self.exact.model());
        self.energy_scale = self.energy_scale.max(energy.abs());
        let off = run.energy - energy;
        Ghost {
            t: state.t,
            deviations: run.x.iter().zip(&state.x).map(|(x, exact)| x.distance(*exact)).collect(),
            energy_error: if self.energy_scale > 0.0 { off / self.energy_scale } else { off },
            horizon: self.growth.horizon(),
            x: state.x,
            stall,
        }
    }
}

/// The exact run from the start; dt only sets its frames, which need not be more than its events.
fn begin(scene: &Scene) -> Simulation {
    let dt = scene.duration.max(f64::MIN_POSITIVE);
    Simulation::new(scene, Settings { method: Method::Exact, dt, ..scene.solver })
}
