//! Delayed states: a sphere's line (x, v at its own time) is rewritten only when something happens to it.
//!
//! Looking never rewrites a line, so that no display rate changes a bit of the trajectory; what a frame rewrote is kept
//! until the next one, so that a state within the frame can be read.
//!
//! What an event needs of a sphere is one record of two cache lines. Records may lie in another order than the scene's,
//! neighbours in space side by side: sphere i has the seat s. All that decides anything goes by i; only who walks through
//! neighbours goes by seats, and finds the same, but for the last digit of searches that what was found first cuts short
//! (`swept`, and pairs with different accelerations). Seats follow from the run alone, so that its bits do too.

use glam::DVec3;

use super::schedule::cells::CellRef;
use super::schedule::prediction::Plan;
use crate::physics::contact::Kind;
use crate::physics::model::{Model, Pull};
use crate::physics::path::Path;
use crate::physics::state::State;

/// Where a sphere was at its own time: 64 bytes, one cache line, twice four numbers for who reads four at once.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub(super) struct Trajectory {
    /// Centre, m.
    pub(super) x: DVec3,
    /// When, s.
    pub(super) t: f64,
    /// Velocity, m/s.
    pub(super) v: DVec3,
    /// Radius, m.
    pub(super) r: f64,
}

impl Trajectory {
    /// The path from time `t` (s) on, with acceleration `a`, m/s².
    #[inline(always)]
    pub(super) fn path(&self, a: DVec3, t: f64) -> Path {
        let dt = t - self.t;
        Path { x: self.x + (self.v + a * (0.5 * dt)) * dt, v: self.v + a * dt, a }
    }

    /// The same line, brought to time `t`, s.
    #[inline(always)]
    pub(super) fn brought(&self, a: DVec3, t: f64) -> Trajectory {
        let Path { x, v, .. } = self.path(a, t);
        if t == self.t { *self } else { Trajectory { x, t, v, r: self.r } }
    }
}

/// All that an event needs of a sphere: two cache lines, of which those who only look at it read the first.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(128))]
pub(super) struct Record {
    pub(super) line: Trajectory,
    pub(super) plan: Plan,
    /// The cube it is in, if there are cells.
    pub(super) spot: CellRef,
    /// How often its motion has changed.
    pub(super) stamp: u32,
    /// Its index in the scene.
    pub(super) sphere: u32,
    /// 1 / m, 1/kg.
    pub(super) inverse_mass: f64,
}

/// A line that was rewritten in this frame.
#[derive(Debug, Clone, Copy)]
struct Past {
    sphere: u32,
    /// When it was replaced, s.
    until: f64,
    line: Trajectory,
    acceleration: DVec3,
}

/// The records of all spheres.
#[derive(Debug, Clone)]
pub(super) struct Trajectories {
    /// By seat.
    pub(super) records: Vec<Record>,
    /// The seat of each sphere; empty as long as each sits at its index.
    seats: Vec<u32>,
    /// What accelerates every sphere alike, m/s², as long as `accelerations` is empty.
    common: DVec3,
    /// Acceleration of each, m/s²: in flight g + F/m, at rest what the supports leave of it. Empty until they differ.
    accelerations: Vec<DVec3>,
    past: Vec<Past>,
}

impl Trajectories {
    pub(super) fn new(model: &Model, state: &State) -> Trajectories {
        let record = |i: usize| Record {
            line: Trajectory { x: state.x[i], t: state.t, v: state.v[i], r: model.radii[i] },
            plan: Plan::IDLE,
            spot: CellRef::default(),
            stamp: 0,
            sphere: i as u32,
            inverse_mass: model.inverse_masses[i],
        };
        let (common, accelerations) = match model.pull {
            Pull::None => (DVec3::ZERO, Vec::new()),
            Pull::Uniform(g) => (g, Vec::new()),
            Pull::PerSphere => (DVec3::ZERO, model.accelerations.clone()),
        };
        let records = (0..model.len()).map(record).collect();
        Trajectories { records, seats: Vec::new(), common, accelerations, past: Vec::new() }
    }

    /// Where sphere `i` sits.
    #[inline]
    pub(super) fn seat(&self, i: usize) -> usize {
        if self.seats.is_empty() { i } else { self.seats[i] as usize }
    }

    /// The sphere at a seat.
    #[inline]
    pub(super) fn sphere(&self, seat: usize) -> usize {
        self.records[seat].sphere as usize
    }

    /// The line of sphere `i`.
    #[inline]
    pub(super) fn line(&self, i: usize) -> &Trajectory {
        &self.records[self.seat(i)].line
    }

    /// 1 / m of sphere `i`, 1/kg.
    #[inline]
    pub(super) fn inverse_mass(&self, i: usize) -> f64 {
        self.records[self.seat(i)].inverse_mass
    }

    /// The motion of sphere `i` has changed: what others planned with it is stale.
    #[inline]
    pub(super) fn stamp(&mut self, i: usize) {
        let seat = self.seat(i);
        let stamp = &mut self.records[seat].stamp;
        *stamp = stamp.wrapping_add(1);
    }

    /// Seats everybody anew: who sat at `order[s]` now sits at s.
    pub(super) fn reseat(&mut self, order: &[u32]) {
        self.records = order.iter().map(|&seat| self.records[seat as usize]).collect();
        let mut now = vec![0; order.len()];
        for (seat, &before) in order.iter().enumerate() {
            now[before as usize] = seat as u32;
        }
        for record in &mut self.records {
            if record.plan.kind == Kind::Pair {
                record.plan.other = now[record.plan.other as usize];
            }
        }
        self.seats = vec![0; order.len()];
        for (seat, record) in self.records.iter().enumerate() {
            self.seats[record.sphere as usize] = seat as u32;
        }
    }

    /// Acceleration of sphere `i`, m/s².
    #[inline]
    pub(super) fn acceleration(&self, i: usize) -> DVec3 {
        if self.accelerations.is_empty() { self.common } else { self.accelerations[i] }
    }

    /// What accelerates every sphere alike, m/s²; none once they differ.
    #[inline]
    pub(super) fn common(&self) -> Option<DVec3> {
        self.accelerations.is_empty().then_some(self.common)
    }

    /// The path of sphere `i` from time `t` (s) on.
    #[inline]
    pub(super) fn path(&self, i: usize, t: f64) -> Path {
        self.path_from(self.seat(i), t)
    }

    /// The path of the sphere at a seat from time `t` (s) on.
    #[inline]
    pub(super) fn path_from(&self, seat: usize, t: f64) -> Path {
        let record = &self.records[seat];
        record.line.path(self.acceleration(record.sphere as usize), t)
    }

    /// Rewrites the line of sphere `i`: from time `t` on it starts at `x` with `v`.
    #[inline]
    pub(super) fn rewrite(&mut self, i: usize, t: f64, x: DVec3, v: DVec3) {
        self.keep(i, t);
        let seat = self.seat(i);
        let line = &mut self.records[seat].line;
        *line = Trajectory { x, v, t, r: line.r };
    }

    /// Brings the line of sphere `i` to time `t`, s.
    #[inline]
    pub(super) fn bring(&mut self, i: usize, t: f64) {
        let (seat, acceleration) = (self.seat(i), self.acceleration(i));
        let line = &mut self.records[seat].line;
        if line.t != t {
            self.past.push(Past { sphere: i as u32, until: t, line: *line, acceleration });
            *line = line.brought(acceleration, t);
        }
    }

    /// From now on the sphere at a seat, which shares what accelerates all, is on another line: what others planned with it is stale.
    #[inline]
    pub(super) fn turn(&mut self, seat: usize, line: Trajectory) {
        let record = &mut self.records[seat];
        if record.line.t != line.t {
            let past = Past { sphere: record.sphere, until: line.t, line: record.line, acceleration: self.common };
            self.past.push(past);
        }
        (record.line, record.stamp) = (line, record.stamp.wrapping_add(1));
    }

    /// Gives sphere `i`, whose line is at the present, another acceleration, m/s².
    pub(super) fn accelerate(&mut self, i: usize, a: DVec3) {
        if a == self.acceleration(i) {
            return;
        }
        self.keep(i, self.line(i).t);
        self.accelerations.resize(self.records.len(), self.common);
        self.accelerations[i] = a;
    }

    /// From here on, frames before are forgotten.
    pub(super) fn forget(&mut self) {
        self.past.clear();
    }

    /// Every sphere's path from time `t` on, by the lines of now.
    pub(super) fn now(&self, t: f64) -> State {
        let paths = || (0..self.records.len()).map(|i| self.path(i, t));
        State { t, x: paths().map(|p| p.x).collect(), v: paths().map(|p| p.v).collect() }
    }

    /// The state at a time `t` (s) of this frame, by the lines that held then.
    pub(super) fn then(&self, t: f64) -> State {
        let mut state = self.now(t);
        // latest first, so that the oldest line still in force at t is applied last
        for past in self.past.iter().rev().filter(|past| past.until > t) {
            let (i, a, dt) = (past.sphere as usize, past.acceleration, t - past.line.t);
            state.x[i] = past.line.x + (past.line.v + a * (0.5 * dt)) * dt;
            state.v[i] = past.line.v + a * dt;
        }
        state
    }

    fn keep(&mut self, i: usize, until: f64) {
        // a line replaced at its own time was never in force
        let line = *self.line(i);
        if line.t == until {
            return;
        }
        self.past.push(Past { sphere: i as u32, until, line, acceleration: self.acceleration(i) });
    }
}
