//! Delayed states: a sphere's trajectory (x and v at its own time) is rewritten only when something happens to it; and
//! the clock, the time of the last event.
//!
//! Looking never rewrites a trajectory, so that no display rate changes a bit of the run; what a frame rewrote is kept
//! until the next one, so that a state within the frame can be read.
//!
//! What an event needs of a sphere is one record of two cache lines. Records may lie in another order than the scene's,
//! neighbours in space side by side: sphere i has the slot s. Results depend on sphere indices only; slots fix the order
//! in which neighbours are visited, which may change a last bit where a search stops at the best time so far (`swept`,
//! and pairs with different accelerations). Slots follow from the run alone, so that its bits do too.

use glam::DVec3;

use super::hopping::Hopping;
use super::record::{CellRef, Plan, Record, Trajectory};
use super::rounding::HOP;
use crate::physics::contact::{Key, Kind};
use crate::physics::model::{Model, Pull};
use crate::physics::path::Path;
use crate::physics::state::{Stall, State, runaway};

/// Share of the time scale of its fastest sphere below which a run's clock counts as at its zero: 2⁻⁸.
const BEGINNING: f64 = 1.0 / 256.0;

/// A trajectory that was rewritten in this frame.
#[derive(Debug, Clone, Copy)]
struct PastTrajectory {
    sphere: u32,
    /// When the trajectory was replaced, s.
    until: f64,
    line: Trajectory,
    /// The sphere's acceleration until then, m/s².
    acceleration: DVec3,
}

/// The clock, and the records of all spheres.
#[derive(Debug, Clone)]
pub(crate) struct Trajectories {
    /// Time of the last event, s.
    pub(crate) now: f64,
    /// Whether the last impacts sent bodies to and fro at one place.
    pub(crate) to_and_fro: bool,
    /// The spheres that take the same hop again and again.
    pub(crate) hopping: Hopping,
    /// The record of each sphere, by slot.
    pub(crate) records: Vec<Record>,
    /// Deepest overlap at rest that is put right, in radii ([`Detector::healed`](super::detector::Detector::healed)).
    pub(super) healed: f64,
    /// The time scale of the start, s: the size of the clock's reading at its zero.
    time_scale: f64,
    /// The slot of each sphere; empty as long as each is at its index.
    slots: Vec<u32>,
    /// What accelerates every sphere alike, m/s², as long as `accelerations` is empty.
    common: DVec3,
    /// Acceleration by sphere, m/s²: in flight g + F/m, at rest what the supports leave of it. Empty until they differ.
    accelerations: Vec<DVec3>,
    /// The trajectories that were rewritten in this frame, the earliest first.
    past: Vec<PastTrajectory>,
}

/// The time that matters first after the start, s: a small share of what the first sphere takes to fall, or to go, by its
/// radius. It only keeps the clock from being taken for infinitely fine at its zero; 0 if nothing moves.
fn time_scale(model: &Model, state: &State) -> f64 {
    let of = |i: usize| {
        let r = model.radii[i];
        (r / model.acceleration(i).length()).sqrt().min(r / state.v[i].length())
    };
    let first = (0..model.len()).map(of).fold(f64::INFINITY, f64::min);
    if first.is_finite() { BEGINNING * first } else { 0.0 }
}

impl Trajectories {
    /// The trajectories of spheres at `state`, the clock at its time.
    pub(crate) fn new(model: &Model, state: &State) -> Trajectories {
        let record = |i: usize| Record {
            trajectory: Trajectory { x: state.x[i], t: state.t, v: state.v[i], r: model.radii[i] },
            plan: Plan::IDLE,
            cell: CellRef::default(),
            motion_version: 0,
            sphere: i as u32,
            inverse_mass: model.inverse_masses[i],
        };
        let (common, accelerations) = match model.pull {
            Pull::None => (DVec3::ZERO, Vec::new()),
            Pull::Uniform(g) => (g, Vec::new()),
            Pull::PerSphere => (DVec3::ZERO, model.accelerations.clone()),
        };
        Trajectories {
            to_and_fro: false,
            healed: 0.0,
            hopping: Hopping::default(),
            now: state.t,
            records: (0..model.len()).map(record).collect(),
            time_scale: time_scale(model, state),
            slots: Vec::new(),
            common,
            accelerations,
            past: Vec::new(),
        }
    }

    /// Deepest overlap of the resting contacts of sphere `i` that is put right, m.
    pub(crate) fn healed(&self, i: usize) -> f64 {
        self.healed * self.trajectory(i).r
    }

    /// The time at which the clock's rounding is taken, s: now, or at the clock's zero the time scale of the start.
    pub(crate) fn clock_size(&self) -> f64 {
        self.now.abs().max(self.time_scale)
    }

    /// Rounding of the clock: one ulp, s.
    pub(crate) fn clock_ulp(&self) -> f64 {
        let t = self.clock_size();
        t.next_up() - t
    }

    /// How near the border of a wall's part the foot of a sphere of radius `r` (m) on this path is at it, m: rounding of
    /// coordinates and of the clock.
    pub(crate) fn border_rounding(&self, path: &Path, r: f64) -> f64 {
        HOP * path.x.abs().max_element().max(r) + path.v.length() * self.clock_ulp()
    }

    /// The slot of sphere `i`.
    #[inline]
    pub(crate) fn slot(&self, i: usize) -> usize {
        if self.slots.is_empty() { i } else { self.slots[i] as usize }
    }

    /// The sphere at a slot.
    #[inline]
    pub(crate) fn sphere(&self, slot: usize) -> usize {
        self.records[slot].sphere as usize
    }

    /// The trajectory of sphere `i`.
    #[inline]
    pub(crate) fn trajectory(&self, i: usize) -> &Trajectory {
        &self.records[self.slot(i)].trajectory
    }

    /// 1 / m of sphere `i`, 1/kg.
    #[inline]
    pub(crate) fn inverse_mass(&self, i: usize) -> f64 {
        self.records[self.slot(i)].inverse_mass
    }

    /// Notes that the motion of sphere `i` has changed: what others planned with it is stale.
    #[inline]
    pub(crate) fn mark_changed(&mut self, i: usize) {
        let slot = self.slot(i);
        let version = &mut self.records[slot].motion_version;
        *version = version.wrapping_add(1);
    }

    /// Reorders the records: the one at slot `order[s]` comes to slot s.
    pub(crate) fn reorder(&mut self, order: &[u32]) {
        self.records = order.iter().map(|&slot| self.records[slot as usize]).collect();
        let mut now = vec![0; order.len()];
        for (slot, &before) in order.iter().enumerate() {
            now[before as usize] = slot as u32;
        }
        for record in &mut self.records {
            if record.plan.kind == Kind::Pair {
                record.plan.other = now[record.plan.other as usize];
            }
        }
        self.slots = vec![0; order.len()];
        for (slot, record) in self.records.iter().enumerate() {
            self.slots[record.sphere as usize] = slot as u32;
        }
    }

    /// Acceleration of sphere `i`, m/s².
    #[inline]
    pub(crate) fn acceleration(&self, i: usize) -> DVec3 {
        if self.accelerations.is_empty() { self.common } else { self.accelerations[i] }
    }

    /// What accelerates every sphere alike, m/s²; none once they differ.
    #[inline]
    pub(crate) fn common(&self) -> Option<DVec3> {
        self.accelerations.is_empty().then_some(self.common)
    }

    /// The path of sphere `i` from time `t` (s) on.
    #[inline]
    pub(crate) fn path(&self, i: usize, t: f64) -> Path {
        let record = &self.records[self.slot(i)];
        record.trajectory.path(self.acceleration(i), t)
    }

    /// The path of the sphere at a slot from now on.
    #[inline]
    pub(crate) fn path_from(&self, slot: usize) -> Path {
        let record = &self.records[slot];
        record.trajectory.path(self.acceleration(record.sphere as usize), self.now)
    }

    /// Rewrites the trajectory of sphere `i`: from now on it starts at `x` (m) with `v` (m/s).
    #[inline]
    pub(crate) fn rewrite(&mut self, i: usize, x: DVec3, v: DVec3) {
        let t = self.now;
        self.keep(i, t);
        let slot = self.slot(i);
        let line = &mut self.records[slot].trajectory;
        *line = Trajectory { x, v, t, r: line.r };
    }

    /// Brings the trajectory of sphere `i` to the present.
    #[inline]
    pub(crate) fn advance(&mut self, i: usize) {
        let t = self.now;
        let (slot, acceleration) = (self.slot(i), self.acceleration(i));
        let line = &mut self.records[slot].trajectory;
        if line.t != t {
            self.past.push(PastTrajectory { sphere: i as u32, until: t, line: *line, acceleration });
            *line = line.advanced_to(acceleration, t);
        }
    }

    /// Puts the sphere at a slot, which shares what accelerates all, on another trajectory from now on: what others planned
    /// with it is stale.
    #[inline(always)]
    pub(crate) fn redirect(&mut self, slot: usize, line: Trajectory) {
        let record = &mut self.records[slot];
        if record.trajectory.t != line.t {
            let past = PastTrajectory {
                sphere: record.sphere,
                until: line.t,
                line: record.trajectory,
                acceleration: self.common,
            };
            self.past.push(past);
        }
        (record.trajectory, record.motion_version) = (line, record.motion_version.wrapping_add(1));
    }

    /// Changes the velocity of sphere `i`, whose trajectory is at the present, by `change`, m/s.
    pub(crate) fn push(&mut self, i: usize, change: DVec3) {
        let line = *self.trajectory(i);
        self.rewrite(i, line.x, line.v + change);
    }

    /// Gives sphere `i`, whose trajectory is at the present, another acceleration, m/s².
    pub(crate) fn accelerate(&mut self, i: usize, a: DVec3) {
        if a == self.acceleration(i) {
            return;
        }
        self.keep(i, self.trajectory(i).t);
        self.accelerations.resize(self.records.len(), self.common);
        self.accelerations[i] = a;
    }

    /// A copy of which states from `time` (s) on can be read, and none before.
    pub(crate) fn since(&self, time: f64) -> Trajectories {
        Trajectories {
            to_and_fro: self.to_and_fro,
            healed: self.healed,
            hopping: self.hopping.since(time),
            now: self.now,
            records: self.records.clone(),
            time_scale: self.time_scale,
            slots: self.slots.clone(),
            common: self.common,
            accelerations: self.accelerations.clone(),
            past: self.past.iter().filter(|past| past.until > time).copied().collect(),
        }
    }

    /// Memory that they take beside their own size, bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.records)
            + size_of_val(&*self.slots)
            + size_of_val(&*self.accelerations)
            + size_of_val(&*self.past)
            + self.hopping.bytes()
    }

    /// Forgets the trajectories of earlier frames, whose states can no longer be read then: a frame begins.
    #[inline(always)]
    pub(crate) fn forget_past(&mut self) {
        self.past.clear();
        self.hopping.forget_past();
    }

    /// The state at time `t` (s) by the trajectories of now.
    fn by_current(&self, t: f64) -> State {
        let paths = || (0..self.records.len()).map(|i| self.path(i, t));
        State { t, x: paths().map(|p| p.x).collect(), v: paths().map(|p| p.v).collect() }
    }

    /// The state at a time `t` (s) of this frame, by the trajectories that held then.
    pub(crate) fn state_at(&self, t: f64) -> State {
        let mut state = self.by_current(t);
        // latest first, so that the oldest trajectory still in force at t is applied last
        for past in self.past.iter().rev().filter(|past| past.until > t) {
            let (i, a, dt) = (past.sphere as usize, past.acceleration, t - past.line.t);
            state.x[i] = past.line.x + (past.line.v + a * (0.5 * dt)) * dt;
            state.v[i] = past.line.v + a * dt;
        }
        state
    }

    /// Remembers the trajectory that sphere `i` was on until `until`, s.
    fn keep(&mut self, i: usize, until: f64) {
        // a trajectory replaced at its own time was never in force
        let line = *self.trajectory(i);
        if line.t == until {
            return;
        }
        self.past.push(PastTrajectory { sphere: i as u32, until, line, acceleration: self.acceleration(i) });
    }

    /// Which contact a plan of the sphere at a slot means.
    #[inline]
    pub(crate) fn key(&self, slot: usize, plan: &Plan) -> Key {
        let i = self.sphere(slot);
        match plan.kind {
            Kind::Wall => (Kind::Wall, i, plan.other as usize),
            Kind::Pair => {
                let j = self.sphere(plan.other as usize);
                (Kind::Pair, i.min(j), i.max(j))
            }
        }
    }

    /// The speeds of the bodies of a contact in all, m/s.
    pub(crate) fn speeds(&self, (kind, a, b): Key) -> f64 {
        let other = if kind == Kind::Pair { self.trajectory(b).v.length() } else { 0.0 };
        self.trajectory(a).v.length() + other
    }

    /// A stall if what has just happened sends sphere `i` out of the range of numbers.
    pub(crate) fn check_range(&self, i: usize) -> Result<(), Stall> {
        self.check_range_at(self.slot(i))
    }

    /// A stall if what has just happened sends the sphere at a slot out of the range of numbers.
    #[inline(always)]
    pub(crate) fn check_range_at(&self, slot: usize) -> Result<(), Stall> {
        let line = &self.records[slot].trajectory;
        let cause = "a contact has sent it there; begin with smaller speeds, or change the method from here";
        runaway(self.sphere(slot), self.now, [line.x, line.v], cause).map_or(Ok(()), Err)
    }
}
