//! The exact run beside the one shown, followed from the reports of both.

use std::sync::Arc;

use super::current::Current;
use crate::{
    snapshot::{Ghost, Stage, Trade},
    view,
    worker::{Ending, ExactFollower, Notify, Report},
};

/// Bytes per sphere that the exact run beside a run takes, its copies of positions counted: measured with a gas of 10⁶.
const SPHERE: usize = 1100;

/// Fewest spheres for which it is said what the exact run costs before it begins.
const MANY: usize = 50_000;

/// A sentence on what the exact run of `spheres` takes; none if that is not worth a word.
pub(super) fn cost(spheres: usize) -> Option<String> {
    let megabytes = (spheres * SPHERE).div_ceil(1_000_000);
    let said = || format!("The exact run of {spheres} spheres takes about {megabytes} MB and a processor of its own");
    (spheres >= MANY).then(said)
}

/// A comparison under way.
pub(super) struct Comparison {
    /// The scene whose runs are compared: the last reports of another one may still be on their way.
    stage: Arc<Stage>,
    follower: ExactFollower,
    ghost: Arc<Option<Ghost>>,
    trade: Trade,
}

impl Comparison {
    /// Compares from the latest `report` on, once the comparison `before` has ended; `notify` is called when there is
    /// news of the exact run.
    ///
    /// # Errors
    /// If the system has no thread to give.
    pub(super) fn start(
        current: &Current,
        report: &Report,
        before: Option<Ending>,
        notify: Notify,
    ) -> std::io::Result<Comparison> {
        let stage = Arc::clone(&current.stage);
        let follower = ExactFollower::start(Arc::clone(&current.scene), before, notify)?;
        if Arc::ptr_eq(&stage, &report.snapshot.stage) {
            follower.compare(&report.snapshot);
        }
        let trade = Trade::new(stage.duration);
        Ok(Comparison { stage, follower, ghost: Arc::new(None), trade })
    }

    /// Ends the comparison; the next one takes what is returned.
    pub(super) fn end(self) -> Ending {
        self.follower.end()
    }

    /// Takes note of what both threads have reported since `before`.
    pub(super) fn follow(&mut self, before: &Report, after: &Report) {
        let (from, to) = (&before.snapshot, &after.snapshot);
        if Arc::ptr_eq(&self.stage, &to.stage) {
            // a run that was gone back in has told its costs when it was there first
            let shorter = after.kept.newest < before.kept.newest || !Arc::ptr_eq(&from.stage, &to.stage);
            if shorter {
                self.trade = Trade::new(to.stage.duration);
            } else if to.t > from.t && !after.kept.is_past {
                self.add_costs(before, after);
            }
            if !Arc::ptr_eq(from, to) {
                self.follower.compare(to);
            }
        }
        let ghost = self.follower.take();
        if let (Some(ghost), false) = (&*ghost, Arc::ptr_eq(&ghost, &self.ghost)) {
            self.add_errors(ghost);
        }
        self.ghost = ghost;
    }

    fn add_costs(&mut self, before: &Report, after: &Report) {
        let (from, to) = (&before.snapshot, &after.snapshot);
        let frames = to.tallies.frames.saturating_sub(from.tallies.frames);
        if frames == 0 {
            return;
        }
        let evaluations = to.tallies.evaluations.saturating_sub(from.tallies.evaluations);
        self.trade.evaluations.add(to.t, evaluations as f64 / frames as f64);
        self.trade.deepest_degree.add(to.t, to.tallies.deepest_degree);
        self.trade.cost.add(to.t, 1e3 * (after.cpu - before.cpu).max(0.0) / (to.t - from.t));
    }

    fn add_errors(&mut self, ghost: &Ghost) {
        if ghost.stall.is_some() {
            return;
        }
        self.trade.energy_error.add(ghost.t, ghost.energy_error);
        if let (Some((_, deviation)), false) = (ghost.worst(), ghost.is_past_horizon()) {
            self.trade.deviation.add(ghost.t, deviation);
        }
    }

    /// Whether the exact run has said all it can of the run at time `t`, s.
    pub(super) fn is_settled(&self, t: f64) -> bool {
        self.ghost().is_some_and(|ghost| ghost.t == t || ghost.stall.is_some())
    }

    /// Where the exact run is, once it has said so.
    pub(super) fn ghost(&self) -> Option<&Ghost> {
        (*self.ghost).as_ref()
    }

    /// The comparison as the view draws it.
    pub(super) fn shown(&self) -> view::Comparison<'_> {
        view::Comparison { ghost: self.ghost(), trade: &self.trade }
    }
}
