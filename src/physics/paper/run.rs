//! A run under way: what the method keeps between calls.

use super::kicks::Kicks;
use super::watchdog::Watchdog;
use crate::physics::contact::Probe;
use crate::physics::method::LARGEST_TOLERANCE;
use crate::physics::model::{Model, Settings};
use crate::physics::overlap::{Finder, Overlap};
use crate::physics::state::State;

/// Accepted beyond the tolerance, dimensionless, as the paper prints it.
pub(in crate::physics) const SLACK: f64 = 1e-4;

/// How far the search for the collision time has come; steps count from the frame's start, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum TimeSearch {
    /// The whole step is being tried.
    Whole,
    /// The collision lies between the steps `apart` and `deep`, s.
    Between { apart: f64, deep: f64 },
    /// No time lies between the two any more: the later one is taken as it is.
    Last,
}

/// How much of a trial state has been computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TrialStage {
    /// Spheres fly and meet walls, from this one on.
    Fly(usize),
    /// Pairs are searched.
    Meet,
    /// The trial state is complete.
    Complete,
}

/// A run by `paper`.
#[derive(Debug, Clone)]
pub(crate) struct Paper {
    pub(super) settings: Settings,
    /// Start of the frame in progress; between frames: of the last frame.
    pub(super) start: State,
    /// Where the trial step ends; between frames: the end of the last frame.
    pub(super) end: State,
    /// What acts on single spheres in the frame from `start` to `end`, beside what always does.
    pub(super) kicks: Kicks,
    /// What will act in the next frame; while a frame is in progress, what acted in the one before.
    pub(super) next: Kicks,
    /// Overlaps of the trial state.
    pub(super) finder: Finder,
    /// Contacts that began the frame deeper than is accepted, and how deep.
    pub(super) allowed: Vec<Overlap>,
    /// The step being tried, s; none between frames.
    pub(super) trial: Option<f64>,
    /// How much of the trial state has been computed.
    pub(super) stage: TrialStage,
    /// 0 as long as every position of the trial state is finite; else NaN.
    pub(super) residue: f64,
    pub(super) search: TimeSearch,
    /// Trial steps of the frame in progress.
    pub(super) probes: Vec<Probe>,
    /// Length of the last frame, s.
    pub(super) step: f64,
    pub(super) watch: Watchdog,
}

impl Paper {
    /// The largest intersection degree a frame may end with, dimensionless, for contacts without an allowance of their own.
    pub(super) fn accepted(&self) -> f64 {
        self.settings.tolerance.min(LARGEST_TOLERANCE) + SLACK
    }

    /// The kicks that follow the end of the last frame.
    pub(super) fn pending(&self) -> &Kicks {
        if self.trial.is_some() { &self.kicks } else { &self.next }
    }

    /// Gives up the frame in progress: the last one's end stands as it was, with what is to act next.
    pub(super) fn give_up(&mut self, model: &Model) {
        if self.trial.take().is_some() {
            std::mem::swap(&mut self.kicks, &mut self.next);
            self.end.clone_from(&self.start);
            self.finder.all(model, &self.end.x, false);
        }
    }
}
