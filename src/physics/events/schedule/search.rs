//! The search for the next contact of one sphere: with walls, and with the spheres near it.

use glam::DVec3;

use super::candidates::Candidates;
use super::simd::{MOST, PairBatch, Query, Simd};
use crate::physics::contact::Kind;
use crate::physics::contact_time::straight_pair;
use crate::physics::events::detector::{Detector, Due, Span};
use crate::physics::events::islands::resting::Rests;
use crate::physics::events::record::Plan;
use crate::physics::events::trajectories::Trajectories;
use crate::physics::model::Model;
use crate::physics::path::Path;

/// The sphere that looks for its next contact, and what it looks with.
pub(super) struct Search<'a, D> {
    pub(super) model: &'a Model,
    pub(super) trajectories: &'a Trajectories,
    pub(super) rests: &'a Rests,
    pub(super) detector: &'a D,
    pub(super) simd: Simd,
    /// The sphere's seat.
    pub(super) seat: usize,
    /// The sphere's path from now on.
    pub(super) path: Path,
    /// End of the sphere's current parabola, s; later contacts are not searched for.
    pub(super) until: f64,
}

impl<D: Detector> Search<'_, D> {
    /// Looks at some walls, in ascending order; returns how many.
    #[inline]
    pub(super) fn walls(&self, walls: impl Iterator<Item = usize>, plan: &mut Plan) -> u64 {
        let (i, r) = (self.trajectories.sphere(self.seat), self.trajectories.records[self.seat].line.r);
        let mut count = 0;
        for wall in walls {
            if self.rests.holds((Kind::Wall, i, wall)) {
                continue;
            }
            count += 1;
            let span = self.span_for_walls(plan);
            let Some(due) = self.detector.wall(&self.path, r, &self.model.faces[wall], span) else {
                continue;
            };
            let time = self.trajectories.now + due.after;
            if time < plan.contact || (time == plan.contact && plan.kind == Kind::Pair) {
                (plan.contact, plan.kind, plan.other, plan.sure) = (time, Kind::Wall, wall as u32, due.sure);
            }
        }
        count
    }

    /// Until when a wall is worth a look, s from now: walls come before pairs of the same time, and times that round to
    /// the same are the same.
    #[inline]
    fn span_for_walls(&self, plan: &Plan) -> Span {
        let now = self.trajectories.now;
        match plan.kind {
            Kind::Pair if D::PAIRS_FIRST => {
                Span { now, before: (plan.contact.min(self.until).next_up() - now).next_up() }
            }
            _ => self.span_before(plan.contact),
        }
    }

    #[inline]
    fn span_before(&self, time: f64) -> Span {
        let now = self.trajectories.now;
        Span { now, before: time.min(self.until) - now }
    }

    /// Looks at the pairs of the sphere and its candidates, itself among them; returns how many.
    #[inline]
    pub(super) fn pairs(&self, candidates: &mut Candidates, plan: &mut Plan) -> u64 {
        if D::STRAIGHT_PAIRS && self.trajectories.common().is_some() {
            self.straight_pairs(candidates, plan);
        } else {
            for &other in candidates.seats().iter().filter(|&&other| other as usize != self.seat) {
                self.pair(other as usize, plan);
            }
        }
        candidates.seats().len() as u64
    }

    /// Looks at pairs whose relative motion is straight.
    #[inline(always)]
    fn straight_pairs(&self, candidates: &mut Candidates, plan: &mut Plan) {
        let records = &self.trajectories.records[..];
        let query = Query { path: &self.path, r: records[self.seat].line.r, now: self.trajectories.now };
        let (seats, batches) = candidates.padded(self.seat);
        let mut rest = seats;
        while !rest.is_empty() {
            let (seats, later) = rest.split_at(rest.len().min(MOST));
            rest = later;
            let first = self.simd.look(query, records, seats, batches);
            if first.doubtful || !self.rests.is_empty() {
                self.one_by_one(seats, batches, first.meet, plan);
            } else if first.time < f64::INFINITY {
                self.offer(first.with as usize, first.time, true, plan);
            }
        }
    }

    /// Looks at the pairs with a bit in `meet` one by one: one overlaps by rounding, some may rest, or several meet at the
    /// same time.
    #[cold]
    #[inline(never)]
    fn one_by_one(&self, seats: &[u32], batches: &[PairBatch], mut meet: u64, plan: &mut Plan) {
        while meet != 0 {
            let k = meet.trailing_zeros() as usize;
            meet &= meet - 1;
            let (batch, lane, other) = (&batches[k / 4], k % 4, seats[k] as usize);
            let (b, c) = (batch.b[lane], batch.c[lane]);
            let time = self.trajectories.now + c / (batch.discriminant[lane].sqrt() - b);
            if c <= 0.0 {
                // whether they approach is for the handler's own expression to say
                self.pair(other, plan);
            } else if time <= self.trajectories.records[other].plan.contact && time < f64::INFINITY {
                self.offer(other, time, true, plan);
            }
        }
    }

    /// Looks at one pair; returns 1 if there was anything to look at.
    #[inline]
    pub(super) fn pair(&self, other: usize, plan: &mut Plan) -> u64 {
        let (records, now) = (&self.trajectories.records, self.trajectories.now);
        let line = &records[other].line;
        let reach = records[self.seat].line.r + line.r;
        let found = if D::STRAIGHT_PAIRS && self.trajectories.common() == Some(DVec3::ZERO) {
            let t = straight_pair(self.path.x - (line.x + line.v * (now - line.t)), self.path.v - line.v, reach);
            t.map(|after| Due { after, sure: true })
        } else {
            let before = D::pair_horizon(plan.contact, records[other].plan.contact);
            self.detector.pair(&self.path, &self.trajectories.path_from(other), reach, self.span_before(before))
        };
        let Some(due) = found else { return 1 };
        self.offer(other, now + due.after, due.sure, plan)
    }

    /// Plans to meet the sphere at `other` at `time` (s) if nothing is planned before; returns 0 if the two rest on each
    /// other.
    #[inline]
    fn offer(&self, other: usize, time: f64, sure: bool, plan: &mut Plan) -> u64 {
        if time < plan.contact || time == plan.contact && self.wins_tie(other, plan) {
            if !self.rests.is_empty() {
                let (i, j) = (self.trajectories.sphere(self.seat), self.trajectories.sphere(other));
                if self.rests.holds((Kind::Pair, i.min(j), i.max(j))) {
                    return 0;
                }
            }
            (plan.contact, plan.kind, plan.sure) = (time, Kind::Pair, sure);
            (plan.other, plan.stamp) = (other as u32, self.trajectories.records[other].stamp);
        }
        1
    }

    /// Among pairs at one time the lower (a, b) comes first; walls come before pairs.
    #[cold]
    fn wins_tie(&self, other: usize, plan: &Plan) -> bool {
        let new = Plan { kind: Kind::Pair, other: other as u32, ..*plan };
        let key = |plan: &Plan| self.trajectories.key(self.seat, plan);
        plan.kind == Kind::Pair && plan.contact.is_finite() && key(&new) < key(plan)
    }
}
