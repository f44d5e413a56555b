//! A trial state: `Forward(h)` from the frame's start and the overlaps there, computed in slices.
//!
//! The paper's search goes `Backward(h)`, then `Forward(h/2)`. Both apply the same forces, so the state after them is a
//! function of the frame's start and the time since then alone; it is computed here from the saved start, which is the
//! same map without the rounding that every undo and redo would leave behind.

use std::ops::Range;

use super::Paper;
use super::kicks::{Kick, Kicks};
use super::run::TrialStage;
use crate::physics::free_flight::{Flight, with_flight};
use crate::physics::model::{Model, Pull};
use crate::physics::overlap::CHUNK;
use crate::physics::state::State;

/// Moves these spheres by `Forward(h)`, h in s: P += (ΣF_constant + support) h + J; v = P / m; x += v h (semi-implicit
/// Euler). Returns 0 if all new positions are finite, else NaN. In straight flight `end` holds the velocities already.
#[inline(always)]
pub(super) fn fly<F: Flight>(flight: F, start: &State, end: &mut State, range: Range<usize>, h: f64) -> f64 {
    let (x0, v0) = (&start.x[range.clone()], &start.v[range.clone()]);
    let (x1, v1) = (&mut end.x[range.clone()], &mut end.v[range.clone()]);
    let mut residue = glam::DVec3::ZERO;
    for (k, i) in range.enumerate() {
        let v = flight.velocity(v0[k], i, h);
        if F::BENDS {
            v1[k] = v;
        }
        x1[k] = x0[k] + v * h;
        residue += x1[k] * 0.0;
    }
    residue.element_sum()
}

/// Applies this frame's impulses and support forces: `Forward(h)` of the spheres that have any. Returns 0 if all their new
/// positions are finite, else NaN.
fn kick(model: &Model, kicks: &[Kick], start: &State, end: &mut State, h: f64) -> f64 {
    let mut residue = 0.0;
    for kick in kicks {
        let i = kick.sphere;
        let pull = model.acceleration(i) + kick.support;
        end.v[i] = start.v[i] + pull * h + kick.impulse * model.inverse_masses[i];
        end.x[i] = start.x[i] + end.v[i] * h;
        residue += (end.x[i] * 0.0).element_sum();
    }
    residue
}

/// Brings the velocities of the kicked spheres up to date in the state that comes next, in straight flight: all other
/// velocities are equal in both.
pub(super) fn carry_velocities(model: &Model, kicks: &Kicks, now: &State, next: &mut State) {
    if model.pull == Pull::None {
        for kick in kicks.list() {
            next.v[kick.sphere] = now.v[kick.sphere];
        }
    }
}

/// Moves all spheres by `Forward(h)`, h in s.
pub(super) fn forward(model: &Model, kicks: &Kicks, start: &State, end: &mut State, h: f64) {
    with_flight!(model, flight => fly(flight, start, end, 0..model.len(), h));
    kick(model, kicks.list(), start, end, h);
}

impl Paper {
    /// Sets out to try a step, s.
    pub(super) fn attempt(&mut self, step: f64) {
        self.trial = Some(step);
        self.stage = TrialStage::Fly(0);
        self.residue = 0.0;
        self.end.t = self.start.t + step;
        self.finder.begin();
    }

    /// Computes the next slice of the trial state; the work that took.
    pub(super) fn compute(&mut self, model: &Model, step: f64) -> u64 {
        match self.stage {
            TrialStage::Fly(from) => {
                let range = from..model.len().min(from + CHUNK);
                let work = (range.len() * (1 + model.faces.len())) as u64;
                self.stage = if range.end < model.len() { TrialStage::Fly(range.end) } else { TrialStage::Meet };
                let (start, end) = (&self.start, &mut self.end);
                self.residue += with_flight!(model, flight => fly(flight, start, end, range.clone(), step));
                self.residue += kick(model, self.kicks.of_spheres(&range), start, end, step);
                self.finder.walls(model, &start.x, &end.x, range);
                work
            }
            TrialStage::Meet => {
                let (complete, work) = self.finder.pairs(model, &self.end.x);
                if complete {
                    self.stage = TrialStage::Complete;
                }
                work
            }
            TrialStage::Complete => 0,
        }
    }
}
