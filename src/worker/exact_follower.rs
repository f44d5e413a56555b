//! The exact run beside a run: a second thread that follows the first one's snapshots and says how far they are off.
//!
//! The exact run never slows the run down: snapshots are handed over, not asked for; a snapshot that comes while the exact
//! run is still on its way to an earlier one replaces the one waiting; and the thread is the last to get a processor.
//!
//! Nor does it grow: three snapshots are held (in the mailbox, next, under way), a fourth for the moment in which one gives
//! way to another; and of two exact runs the later begins only when the earlier has ended, however often it is asked for.

use std::{
    sync::Arc,
    thread::{self, JoinHandle},
};

use super::{
    mailbox::{Reader, Sender, mailbox},
    message::Notify,
    slot::Slot,
};
use crate::{
    measure::Growth,
    physics::{Progress, Simulation},
    scene::{Method, Scene, Settings},
    snapshot::{Ghost, Snapshot},
};

/// The exact run of a scene, seen from the run that is measured by it. Dropping it ends its thread.
pub struct ExactFollower {
    snapshots: Sender<Arc<Snapshot>>,
    slot: Arc<Slot<Option<Ghost>>>,
    thread: JoinHandle<()>,
}

/// An exact run that was told to end, which it does within some milliseconds, or once its scene is set up.
pub struct Ending(JoinHandle<()>);

impl ExactFollower {
    /// Starts an exact run of `scene` in a thread, which calls `notify` when there is a ghost that has not been taken.
    /// The run begins when the one `before` it has ended, so that the memory of one is enough.
    ///
    /// # Errors
    /// If the system has no thread to give.
    pub fn start(scene: Arc<Scene>, before: Option<Ending>, notify: Notify) -> std::io::Result<ExactFollower> {
        let (snapshots, inbox) = mailbox();
        let slot = Arc::new(Slot::new(None, notify));
        let theirs = Arc::clone(&slot);
        let thread = thread::Builder::new().name("exact".into()).spawn(move || {
            step_back();
            if let Some(Ending(before)) = before {
                let _ = before.join(); // a panic of that thread has been reported by itself
            }
            let Some(mut follower) = Follower::new(scene, inbox) else { return };
            while follower.follow(&theirs).is_some() {}
        })?;
        Ok(ExactFollower { snapshots, slot, thread })
    }

    /// Tells the thread to end; what is returned is for the [`ExactFollower::start`] of the next run.
    pub fn end(self) -> Ending {
        Ending(self.thread)
    }

    /// Says where the run is; the answer is a later ghost, or none if a newer snapshot comes first.
    pub fn compare(&self, snapshot: &Arc<Snapshot>) {
        self.snapshots.put(Arc::clone(snapshot));
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

/// The exact run and what it is compared with, in its own thread.
struct Follower {
    scene: Arc<Scene>,
    inbox: Reader<Arc<Snapshot>>,
    exact: Simulation,
    growth: Growth,
    /// The ghost that was handed over last.
    ghost: Option<Ghost>,
    /// Largest |energy| that the exact run was seen with, J: what energy errors are relative to.
    energy_scale: f64,
    /// The newest snapshot that has arrived and waits.
    next: Option<Arc<Snapshot>>,
}

impl Follower {
    /// Sets the run up, which takes seconds in a scene of a million spheres; `None` if it is not wanted any more.
    fn new(scene: Arc<Scene>, inbox: Reader<Arc<Snapshot>>) -> Option<Follower> {
        let first = inbox.wait().ok()?;
        let exact = begin(&scene);
        let next = inbox.look().ok()?.or(Some(first));
        let growth = Growth::of(&scene);
        let energy_scale = exact.initial_energy().abs();
        Some(Follower { scene, inbox, exact, growth, ghost: None, energy_scale, next })
    }

    /// Waits for a snapshot, goes as far as it is, and compares; `None` if no sender is left.
    fn follow(&mut self, slot: &Slot<Option<Ghost>>) -> Option<()> {
        self.listen()?;
        let Some(target) = self.next.take() else { return self.look_ahead(slot) };
        if target.t < self.exact.time() - self.exact.step() {
            self.exact = begin(&self.scene);
        }
        let mut end = Progress::Reached;
        if self.exact.time() < target.t {
            let Follower { exact, inbox, next, .. } = self;
            end = exact.run_to(target.t, |_| {
                if let Some(snapshot) = inbox.look().ok()? {
                    *next = Some(snapshot);
                }
                (!is_before(next, target.t)).then_some(Simulation::SLICE)
            });
        }
        self.listen()?;
        if is_before(&self.next, target.t) {
            return Some(()); // the run has begun again
        }
        let stall = if let Progress::Stalled(stall) = end { Some(stall.reason) } else { None };
        self.ghost = Some(self.compare(&target, stall));
        slot.put(self.ghost.clone());
        Some(())
    }

    /// Looks, with nothing to compare, for the horizon up to where the run is, then waits for a snapshot.
    fn look_ahead(&mut self, slot: &Slot<Option<Ghost>>) -> Option<()> {
        let Some(ghost) = self.ghost.as_mut().filter(|ghost| self.growth.is_behind(ghost.t)) else {
            self.next = Some(self.inbox.wait().ok()?);
            return Some(());
        };
        self.growth.advance(Simulation::SLICE);
        if self.growth.horizon().is_some() {
            ghost.horizon = self.growth.horizon();
            slot.put(self.ghost.clone());
        }
        Some(())
    }

    /// Keeps the newest snapshot that has arrived; `None` if no sender is left.
    fn listen(&mut self) -> Option<()> {
        if let Some(snapshot) = self.inbox.look().ok()? {
            self.next = Some(snapshot);
        }
        Some(())
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

/// Whether there is a snapshot of an earlier time than `t`, s.
fn is_before(snapshot: &Option<Arc<Snapshot>>, t: f64) -> bool {
    snapshot.as_ref().is_some_and(|snapshot| snapshot.t < t)
}

/// The exact run from the start; dt only sets its frames, which need not be more than its events.
fn begin(scene: &Scene) -> Simulation {
    let dt = scene.duration.max(f64::MIN_POSITIVE);
    Simulation::new(scene, Settings { method: Method::Exact, dt, ..scene.solver })
}
