//! One frame: opened, ended by the dt or by the search for the collision time, closed with its responses.

use super::run::{Paper, TimeSearch, TrialStage};
use super::trial_step::carry_velocities;
use crate::physics::contact::Probe;
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::overlap::Overlap;

/// What rounding may add to the degree of a contact that must not sink further, dimensionless.
const ROUNDING: f64 = 1e-12;

impl Paper {
    /// Goes on with the frame in progress, or opens one; the work that took.
    pub(super) fn go_on(&mut self, model: &Model, log: &mut Log) -> u64 {
        let step = match self.trial {
            Some(step) => step,
            None => self.open(model),
        };
        let work = self.compute(model, step);
        if self.stage == TrialStage::Complete && self.residue == 0.0 {
            log.tallies.evaluations += self.finder.evaluations;
            if self.judge(step, log) {
                self.close(model, log);
            }
        }
        work
    }

    /// Opens a frame: what was the end is the start, and what the last responses gave acts now. The first step to try, s.
    fn open(&mut self, model: &Model) -> f64 {
        let limit = self.accepted();
        self.allowed.clear();
        self.allowed.extend(self.finder.found.iter().filter(|o| o.degree > limit));
        std::mem::swap(&mut self.start, &mut self.end);
        std::mem::swap(&mut self.kicks, &mut self.next);
        carry_velocities(model, &self.next, &self.start, &mut self.end);
        self.search = TimeSearch::Whole;
        self.probes.clear();
        self.attempt(self.settings.dt);
        self.settings.dt
    }

    /// The search (`FindRealCollision`): whether the trial step is accepted; if not, the next one is set out for.
    fn judge(&mut self, step: f64, log: &mut Log) -> bool {
        let found = &self.finder.found;
        let deepest = found.iter().map(|o| o.degree).fold(f64::NEG_INFINITY, f64::max);
        let too_deep = found.iter().any(|o| o.degree > self.limit(o));
        let (apart, deep) = match (self.search, too_deep) {
            (TimeSearch::Whole, false) | (TimeSearch::Last, _) => return true,
            (TimeSearch::Whole, true) => (0.0, step),
            (TimeSearch::Between { deep, .. }, false) => (step, deep),
            (TimeSearch::Between { apart, .. }, true) => (apart, step),
        };
        self.probes.push(Probe { step, degree: deepest });
        log.tallies.probes += 1;
        if !too_deep && deepest > 0.0 {
            return true;
        }
        let (t, middle) = (self.start.t, 0.5 * (apart + deep));
        if t + middle == t + apart || t + middle == t + deep {
            self.search = TimeSearch::Last;
            self.attempt(deep);
        } else {
            self.search = TimeSearch::Between { apart, deep };
            self.attempt(middle);
        }
        false
    }

    /// Largest degree that an overlap may have at the end of this frame, dimensionless.
    fn limit(&self, overlap: &Overlap) -> f64 {
        let limit = self.accepted();
        if overlap.degree <= limit {
            return limit;
        }
        match self.allowed.binary_search_by_key(&overlap.key, |o| o.key) {
            Ok(k) => self.allowed[k].degree + ROUNDING,
            Err(_) => limit,
        }
    }

    /// Closes the frame at the accepted step: responses for the next frame, contacts, tallies.
    fn close(&mut self, model: &Model, log: &mut Log) {
        self.step = self.trial.take().expect("a frame closes at its trial step");
        std::mem::swap(&mut log.probes, &mut self.probes);
        let deepest = self.finder.found.iter().map(|o| o.degree).fold(0.0, f64::max);
        log.tallies.deepest_degree = log.tallies.deepest_degree.max(deepest);
        log.tallies.frames += 1;
        self.respond(model, log);
        self.watch.note(self.end.t - self.start.t, self.step < self.settings.dt, self.settings.dt, log);
    }

    /// Whether nothing is left of any contact: such frames go by in [`Paper::complete_free_frames`](super::free_frames).
    pub(super) fn is_calm(&self, log: &Log) -> bool {
        self.finder.found.is_empty() && self.next.list().is_empty() && log.resting.is_empty()
    }
}
