//! One frame: forward by dt, the overlap test, and the search for the collision time.
//!
//! The paper's search goes `Backward(h)`, then `Forward(h/2)`. Both apply the same forces, so the state after them is a
//! function of the frame's start and the time since then alone; it is computed here from the saved start, which is the
//! same map without the rounding that every undo and redo would leave behind.

use super::super::log::Log;
use super::super::model::PairSearch;
use super::super::{Kind, Model, Probe, State, overlap};
use super::response::Kicks;
use super::{Overlap, Paper, Search};

/// `Forward(h)`: P += (ΣF_constant + support) h + J; v = P / m; x += v h (semi-implicit Euler).
pub(super) fn forward(model: &Model, kicks: &Kicks, start: &State, h: f64, end: &mut State) {
    for i in 0..start.x.len() {
        end.v[i] = start.v[i] + model.acceleration(i) * h;
        end.x[i] = start.x[i] + end.v[i] * h;
    }
    for kick in kicks.list() {
        let i = kick.sphere;
        let pull = model.acceleration(i) + kick.support;
        end.v[i] = start.v[i] + pull * h + kick.impulse * model.inverse_masses[i];
        end.x[i] = start.x[i] + end.v[i] * h;
    }
    end.t = start.t + h;
}

impl Paper {
    /// Tries one step; whether the frame may end there, and the work that took.
    pub(super) fn probe(&mut self, model: &Model, log: &mut Log) -> (bool, u64) {
        let h = match self.trial {
            Some(h) => h,
            None => self.open(),
        };
        forward(model, &self.kicks, &self.start, h, &mut self.end);
        let evaluations = self.find(model, Reach::Overlapping);
        log.tallies.evaluations += evaluations;
        let done = self.judge(h, log);
        (done, evaluations + model.len() as u64)
    }

    /// Opens a frame: what was the end is the start, what was computed for the next frame acts now.
    fn open(&mut self) -> f64 {
        std::mem::swap(&mut self.start, &mut self.end);
        std::mem::swap(&mut self.kicks, &mut self.next);
        let limit = self.accepted();
        self.allowed.clear();
        self.allowed.extend(self.found.iter().filter(|o| o.degree > limit));
        self.search = Search::Whole;
        self.probes.clear();
        self.trial = Some(self.settings.dt);
        self.settings.dt
    }

    /// The search (`FindRealCollision`): whether the trial step is accepted; if not, the next one is set.
    fn judge(&mut self, h: f64, log: &mut Log) -> bool {
        let deepest = self.found.iter().map(|o| o.degree).fold(f64::NEG_INFINITY, f64::max);
        let too_deep = self.found.iter().any(|o| o.degree > self.limit(o));
        let (apart, deep) = match (self.search, too_deep) {
            (Search::Whole, false) | (Search::Last, _) => return true,
            (Search::Whole, true) => (0.0, h),
            (Search::Between { deep, .. }, false) => (h, deep),
            (Search::Between { apart, .. }, true) => (apart, h),
        };
        self.probes.push(Probe { step: h, degree: deepest });
        log.tallies.probes += 1;
        if !too_deep && deepest > 0.0 {
            return true;
        }
        let (t, middle) = (self.start.t, 0.5 * (apart + deep));
        let exhausted = t + middle == t + apart || t + middle == t + deep;
        (self.search, self.trial) =
            if exhausted { (Search::Last, Some(deep)) } else { (Search::Between { apart, deep }, Some(middle)) };
        false
    }

    /// Closes the frame at the accepted trial step: responses for the next frame, contacts, tallies.
    pub(super) fn close(&mut self, model: &Model, log: &mut Log) {
        self.step = self.trial.take().unwrap_or(0.0);
        std::mem::swap(&mut log.probes, &mut self.probes);
        log.tallies.frames += 1;
        let deepest = self.found.iter().map(|o| o.degree).fold(0.0, f64::max);
        log.tallies.deepest_degree = log.tallies.deepest_degree.max(deepest);
        self.respond(model, log);
    }

    /// How deep an overlap may be at the end of this frame.
    fn limit(&self, overlap: &Overlap) -> f64 {
        let limit = self.accepted();
        match self.allowed.binary_search_by_key(&overlap.key, |o| o.key) {
            Ok(k) => limit.max(self.allowed[k].degree + ROUNDING),
            Err(_) => limit,
        }
    }

    /// All overlaps of the trial state, sorted; the number of degrees computed.
    pub(super) fn find(&mut self, model: &Model, reach: Reach) -> u64 {
        self.found.clear();
        let (n, x, r) = (model.len(), &self.end.x, &model.radii);
        let slack =
            |size: f64, at: f64| if reach == Reach::Touching { overlap::touching(size, at) / size } else { 0.0 };
        for i in 0..n {
            for (w, face) in model.faces.iter().enumerate() {
                let slack = slack(r[i], x[i].abs().max_element().max(face.shape.center.abs().max_element()));
                let degree = overlap::wall_degree(face, self.start.x[i], x[i], r[i], slack);
                self.found.extend(degree.map(|degree| Overlap { key: (Kind::Wall, i, w), degree }));
            }
        }
        let mut evaluations = (n * model.faces.len()) as u64;
        if model.pairs != PairSearch::None {
            for a in 0..n {
                for b in a + 1..n {
                    let size = r[a] + r[b];
                    let slack = slack(size, x[a].abs().max_element());
                    let degree = overlap::pair_degree(x[a], x[b], size, slack);
                    self.found.extend(degree.map(|degree| Overlap { key: (Kind::Pair, a, b), degree }));
                }
            }
            evaluations += (n * (n - 1) / 2) as u64;
        }
        evaluations
    }
}

/// What counts as a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    /// A gap of at most rounding: at load.
    Touching,
    /// A gap of at most 0: in flight.
    Overlapping,
}

/// What rounding may add to the depth of a contact that must not sink further.
const ROUNDING: f64 = 1e-12;
