//! Frames in which nothing touches: loops with nothing in them that the scene lacks.

use glam::DVec3;

use super::run::{Paper, TimeSearch, TrialStage};
use super::trial_step::{carry_velocities, fly};
use crate::physics::free_flight::{Flight, with_flight};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::overlap::{any_near, evaluations};
use crate::physics::requirements::PairSearch;
use crate::physics::state::State;

/// The step and the end of a flight without contacts.
#[derive(Debug, Clone, Copy)]
struct Leg {
    /// Length of a frame, s.
    dt: f64,
    /// Time at which the flight ends with the frame that reaches it, s.
    goal: f64,
    /// Number of frames after which the flight ends.
    most: u64,
}

impl Paper {
    /// Completes whole frames, one after the other, as long as nothing touches; the work that took. The frame in which
    /// something touches is left in progress, its first trial state complete.
    pub(super) fn complete_free_frames(&mut self, model: &Model, log: &mut Log, goal: f64, work: u64) -> u64 {
        // So many spheres that a frame must be sliced, or that their cells outweigh what is saved here.
        if model.pairs == PairSearch::Cells {
            return self.go_on(model, log);
        }
        carry_velocities(model, &self.kicks, &self.end, &mut self.start);
        self.kicks.clear();
        self.allowed.clear();
        let cost = model.len() as u64 + evaluations(model);
        let leg = Leg { dt: self.settings.dt, goal, most: (work / cost.max(1)).max(1) };
        let (frames, touched) = with_flight!(model, flight => match (model.len() == 1, model.faces.is_empty(), model.pairs) {
            (true, true, _) => self.one_flies::<_, false>(flight, model, leg),
            (true, false, _) => self.one_flies::<_, true>(flight, model, leg),
            (_, true, PairSearch::None) => self.all_fly::<_, false, false>(flight, model, leg),
            (_, false, PairSearch::None) => self.all_fly::<_, true, false>(flight, model, leg),
            (_, true, _) => self.all_fly::<_, false, true>(flight, model, leg),
            (_, false, _) => self.all_fly::<_, true, true>(flight, model, leg),
        });
        if frames > 0 {
            log.tallies.frames += frames;
            log.tallies.evaluations += frames * evaluations(model);
            log.contacts.clear();
            log.probes.clear();
            self.step = leg.dt;
        }
        if touched {
            self.search = TimeSearch::Whole;
            self.probes.clear();
            self.stage = TrialStage::Complete;
            self.trial = Some(leg.dt);
        }
        (frames + u64::from(touched)) * cost
    }

    /// Lets all spheres fly: how many frames, and whether the last trial state, not counted, needs a closer look.
    fn all_fly<F: Flight, const WALLS: bool, const PAIRS: bool>(
        &mut self,
        flight: F,
        model: &Model,
        leg: Leg,
    ) -> (u64, bool) {
        let (mut frames, mut t) = (0, self.end.t);
        loop {
            std::mem::swap(&mut self.start, &mut self.end);
            self.start.t = t;
            t += leg.dt;
            self.end.t = t;
            self.residue = fly(flight, &self.start, &mut self.end, 0..model.len(), leg.dt);
            let odd = self.residue != 0.0 || t <= self.start.t || any_near::<WALLS, PAIRS>(model, &self.end.x);
            if odd && self.needs_judging(model) {
                return (frames, true);
            }
            frames += 1;
            if t >= leg.goal || frames >= leg.most {
                return (frames, false);
            }
        }
    }

    /// Lets a single sphere fly: how many frames, and whether the last trial state, not counted, needs a closer look.
    fn one_flies<F: Flight, const WALLS: bool>(&mut self, flight: F, model: &Model, leg: Leg) -> (u64, bool) {
        let mut now = Point { x: self.end.x[0], v: self.end.v[0], t: self.end.t };
        let (mut frames, mut one_by_one) = (0, 0);
        loop {
            let fits = |size: u64| frames + size < leg.most && now.t + leg.dt * (size as f64) < leg.goal;
            let size = if !WALLS && fits(LONG_BLOCK) { LONG_BLOCK } else { BLOCK };
            if one_by_one == 0 && fits(size) {
                match block::<F, WALLS>(flight, model, now, leg, size) {
                    Some(after) => {
                        now = after;
                        frames += size;
                        continue;
                    }
                    None => one_by_one = size,
                }
            }
            let before = now;
            now = before.forward(flight, leg.dt);
            one_by_one = one_by_one.saturating_sub(1);
            frames += 1;
            let odd = !now.x.is_finite() || now.t <= before.t || any_near::<WALLS, false>(model, &[now.x]);
            let ends = now.t >= leg.goal || frames >= leg.most;
            if odd || ends {
                before.store(&mut self.start);
                now.store(&mut self.end);
                self.residue = (now.x * 0.0).element_sum();
                if odd && self.needs_judging(model) {
                    return (frames - 1, true);
                }
                if ends {
                    return (frames, false);
                }
            }
        }
    }

    /// Whether a trial state that looked odd, from afar, is more than one more undisturbed frame.
    #[cold]
    fn needs_judging(&mut self, model: &Model) -> bool {
        self.finder.begin();
        self.finder.walls(model, &self.start.x, &self.end.x, 0..model.len());
        self.finder.pairs(model, &self.end.x);
        self.residue != 0.0 || self.end.t <= self.start.t || !self.finder.found.is_empty()
    }
}

/// The state of a single sphere, in local variables.
#[derive(Debug, Clone, Copy)]
struct Point {
    x: DVec3,
    v: DVec3,
    t: f64,
}

impl Point {
    #[inline(always)]
    fn forward<F: Flight>(self, flight: F, dt: f64) -> Point {
        let v = flight.velocity(self.v, 0, dt);
        Point { x: self.x + v * dt, v, t: self.t + dt }
    }

    fn store(self, state: &mut State) {
        (state.x[0], state.v[0], state.t) = (self.x, self.v, self.t);
    }
}

/// Frames of a single sphere flown before anything is asked: questions cost more than a frame. With walls, a block that
/// meets one is flown again frame by frame, so it had better be short beside the way between two impacts.
const BLOCK: u64 = 64;

/// Frames of a single sphere flown before anything is asked, where there are no walls.
const LONG_BLOCK: u64 = 4096;

/// State of a single sphere after a block of `size` frames; none if any of them has to be looked at, or reaches the goal.
/// What is no number stays so, and a time that does not change never will, so that asking at the end is enough.
#[inline(always)]
fn block<F: Flight, const WALLS: bool>(flight: F, model: &Model, from: Point, leg: Leg, size: u64) -> Option<Point> {
    let mut now = from;
    let (mut near, mut last) = (false, from.t);
    for _ in 0..size {
        last = now.t;
        now = now.forward(flight, leg.dt);
        near |= any_near::<WALLS, false>(model, &[now.x]);
    }
    let plain = !near && now.x.is_finite() && now.t > last && now.t < leg.goal;
    plain.then_some(now)
}
