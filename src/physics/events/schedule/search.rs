//! The search for the next contact of one sphere: with walls, and with the spheres near it.

use glam::DVec3;

use super::candidates::Candidates;
use super::simd::{MOST, PairBatch, Query, Simd};
use crate::physics::contact::{Key, Kind};
use crate::physics::contact_time::{is_far, straight_pair};
use crate::physics::events::detector::{Detector, Due, Span};
use crate::physics::events::islands::resting::Rests;
use crate::physics::events::record::Plan;
use crate::physics::events::rounding::{BRUSH, HOP, SUM};
use crate::physics::events::trajectories::Trajectories;
use crate::physics::impact_law::{normal_velocity, pair_normal_velocity};
use crate::physics::model::Model;
use crate::physics::path::Path;
use crate::physics::wall::{Face, touch};

/// Square of a distance over that of the sum of the radii up to which spheres may rest on each other: more than any
/// rounding.
const TOUCHES: f64 = 1.01;

/// The sphere that looks for its next contact, and what it looks with.
pub(super) struct Search<'a, D> {
    pub(super) model: &'a Model,
    pub(super) trajectories: &'a Trajectories,
    pub(super) rests: &'a Rests,
    pub(super) detector: &'a D,
    pub(super) simd: Simd,
    /// The sphere's slot.
    pub(super) slot: usize,
    /// Spheres, ascending, that have looked at this one already since their motion and its own changed.
    pub(super) done: &'a [usize],
    /// The sphere's path from now on.
    pub(super) path: Path,
    /// End of the sphere's current parabola, s; later contacts are not searched for.
    pub(super) until: f64,
    /// Bound of the sphere's way until then, m; infinite if the parabola does not end.
    pub(super) way: f64,
}

impl<D: Detector> Search<'_, D> {
    /// Looks at all walls, first at the one that the sphere was to meet last, then at those that it is above: where it bounces
    /// on one of them, millions of times a second, the others need no long look. Returns how many.
    pub(super) fn all_walls(&self, plan: &mut Plan) -> u64 {
        let (before, count) = (&self.trajectories.records[self.slot].plan, self.model.faces.len());
        if !D::PAIRS_FIRST {
            return self.walls(0..count, plan);
        }
        let first = if before.kind == Kind::Wall { before.other as usize } else { count };
        let above = |wall: usize| self.model.faces[wall].shades(self.path.x);
        let others = || (0..count).filter(|&wall| wall != first);
        let walls = (0..count).filter(|&wall| wall == first);
        self.walls(walls.chain(others().filter(|&wall| above(wall))).chain(others().filter(|&wall| !above(wall))), plan)
    }

    /// Looks at some walls; returns how many.
    #[inline]
    pub(super) fn walls(&self, walls: impl Iterator<Item = usize>, plan: &mut Plan) -> u64 {
        let (i, r) = (self.trajectories.sphere(self.slot), self.trajectories.records[self.slot].trajectory.r);
        let mut count = 0;
        for wall in walls {
            if self.rests.holds((Kind::Wall, i, wall)) || self.trajectories.hopping.strikes(i, wall) {
                continue;
            }
            count += 1;
            if self.model.faces[wall].height(self.path.x).abs() - r > self.way {
                continue;
            }
            let there = self.trajectories.to_and_fro && self.is_there(wall, r) || self.is_in_the_way(wall, r);
            let found = if there {
                Some(Due { after: 0.0, is_contact: true })
            } else {
                self.detector.wall(&self.path, r, &self.model.faces[wall], self.span_for_wall(wall, plan))
            };
            let Some(due) = found else { continue };
            let time = self.time_of(&due, || (Kind::Wall, i, wall));
            if time < plan.contact || (time == plan.contact && wins_over(wall, plan)) {
                (plan.contact, plan.kind, plan.other, plan.is_contact) =
                    (time, Kind::Wall, wall as u32, due.is_contact);
            }
        }
        count
    }

    /// Whether the sphere, of radius `r` (m), approaches a wall from no farther than its coordinates tell: of one that is sent
    /// to and fro there the clock would go on without its coming closer, and what else moves meanwhile would overlap it. An
    /// approach that stops by itself sooner than the clock can tell is none.
    #[inline]
    fn is_there(&self, wall: usize, r: f64) -> bool {
        let (face, x) = (&self.model.faces[wall], self.path.x);
        let least = HOP * x.abs().max_element().max(r);
        let away = face.height(x).abs() - r;
        away > -least && away <= least && !face.is_farther(x, r + least) && {
            let at = touch(face, x, r);
            let v_n = normal_velocity(self.path.v, DVec3::ZERO, at.normal);
            let turns = at.normal.dot(self.path.a).max(0.0) * self.trajectories.clock_ulp();
            at.gap > 0.0 && at.gap <= least && -v_n > turns.max(BRUSH * self.path.v.length())
        }
    }

    /// Whether a wall is within the sphere, of radius `r` (m), around all of the hops of the one that looks: what it nears from
    /// there on is not found. The next tile of the floor that it hops on is none.
    #[inline]
    fn is_in_the_way(&self, wall: usize, r: f64) -> bool {
        let (i, hopping) = (self.trajectories.sphere(self.slot), &self.trajectories.hopping);
        let is_beside = |own: usize| self.is_beside(&self.model.faces[own], &self.model.faces[wall], r);
        hopping.holds(i) && hopping.moving_on(i).is_some_and(|mut own| own.all(is_beside))
    }

    /// Whether a sphere of radius `r` (m) that hops on its `own` face is within a face that does not lie in the same plane.
    #[cold]
    #[inline(never)]
    fn is_beside(&self, own: &Face, face: &Face, r: f64) -> bool {
        let x = self.path.x;
        let least = HOP * x.abs().max_element().max(r);
        let level = (face.height(x).abs() - own.height(x).abs()).abs() <= least;
        let parallel = face.normal.cross(own.normal).length() <= SUM;
        touch(face, x, r).gap <= 0.0 && !(level && parallel)
    }

    /// Time up to which a wall is worth a look, s from now: walls come before pairs of the same time, and times that round
    /// to one number are the same.
    #[inline]
    fn span_for_wall(&self, wall: usize, plan: &Plan) -> Span {
        let now = self.trajectories.now;
        let late = if plan.kind == Kind::Pair { D::PAIRS_FIRST } else { wins_over(wall, plan) };
        if late && plan.contact < f64::INFINITY {
            return Span { now, before: (plan.contact.min(self.until).next_up() - now).next_up() };
        }
        self.span_before(plan.contact)
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
            for &other in candidates.slots().iter().filter(|&&other| other as usize != self.slot) {
                self.pair(other as usize, plan);
            }
        }
        candidates.slots().len() as u64
    }

    /// Looks at pairs whose relative motion is straight.
    #[inline(always)]
    fn straight_pairs(&self, candidates: &mut Candidates, plan: &mut Plan) {
        let records = &self.trajectories.records[..];
        let query = Query { path: &self.path, r: records[self.slot].trajectory.r, now: self.trajectories.now };
        let (slots, batches) = candidates.padded(self.slot);
        let mut rest = slots;
        while !rest.is_empty() {
            let (slots, later) = rest.split_at(rest.len().min(MOST));
            rest = later;
            let first = self.simd.look(query, records, slots, batches);
            // first without the radius of the other, which takes longer to read than all the rest
            let far =
                || is_far(first.c, query.r) && is_far(first.c, query.r + records[first.with as usize].trajectory.r);
            if first.doubtful || !self.rests.is_empty() || first.time < f64::INFINITY && far() {
                self.one_by_one(slots, batches, first.meet, plan);
            } else if first.time < f64::INFINITY {
                self.offer(first.with as usize, first.time, true, plan);
            }
        }
    }

    /// Looks at the pairs with a bit in `meet` one by one: one overlaps by rounding, some may rest, several meet at the
    /// same time, or the first comes from far, where what finds four at a time cancels.
    #[cold]
    #[inline(never)]
    fn one_by_one(&self, slots: &[u32], batches: &[PairBatch], mut meet: u64, plan: &mut Plan) {
        while meet != 0 {
            let k = meet.trailing_zeros() as usize;
            meet &= meet - 1;
            let (batch, lane, other) = (&batches[k / 4], k % 4, slots[k] as usize);
            let (b, c) = (batch.b[lane], batch.c[lane]);
            let time = self.trajectories.now + c / (batch.discriminant[lane].sqrt() - b);
            let reach =
                self.trajectories.records[self.slot].trajectory.r + self.trajectories.records[other].trajectory.r;
            if c <= 0.0 || is_far(c, reach) {
                // whether those that overlap approach is for the handler's own expression to say
                self.pair(other, plan);
            } else if time <= self.trajectories.records[other].plan.contact && time < f64::INFINITY {
                self.offer(other, time, true, plan);
            }
        }
    }

    /// Looks at one pair; returns 1 if there was anything to look at.
    #[inline]
    pub(super) fn pair(&self, other: usize, plan: &mut Plan) -> u64 {
        let records = &self.trajectories.records;
        if D::ONE_LOOK && self.done.binary_search(&self.trajectories.sphere(other)).is_ok() {
            return 1;
        }
        let reach = records[self.slot].trajectory.r + records[other].trajectory.r;
        let seen = self.trajectories.path_from(other);
        let near = self.path.x.distance_squared(seen.x) <= TOUCHES * (reach * reach);
        if near && !self.rests.is_empty() && self.rest_on_each_other(other) {
            return 0;
        }
        if near && self.hops_around(other, (&seen, reach)) {
            return self.offer(other, self.trajectories.now, true, plan);
        }
        let found = if D::STRAIGHT_PAIRS && self.trajectories.common() == Some(DVec3::ZERO) {
            let t = straight_pair(self.path.x - seen.x, self.path.v - seen.v, reach);
            t.map(|after| Due { after, is_contact: true })
        } else {
            let before = D::pair_horizon(plan.contact, records[other].plan.contact);
            // beyond the end of its island's parabola the other is looked at anew, and looks for this one
            let end = self.rests.end_of(self.trajectories.sphere(other)).next_up();
            self.detector.pair(&self.path, &seen, reach, self.span_before(before.min(end)))
        };
        let Some(due) = found else { return 1 };
        let now = self.trajectories.now;
        let at_once = now + due.after <= now;
        if at_once && due.after == 0.0 && self.approaches_by_rounding(&seen) {
            return 1;
        }
        if at_once && self.turns_at_once(&seen) {
            // they may meet again later, which shows as soon as they part
            return self.offer(other, now + 2.0 * self.trajectories.clock_ulp(), false, plan);
        }
        let pair = |i: usize, j: usize| (Kind::Pair, i.min(j), i.max(j));
        let sphere = |slot: usize| self.trajectories.sphere(slot);
        let time = self.time_of(&due, || pair(sphere(self.slot), sphere(other)));
        self.offer(other, time, due.is_contact, plan)
    }

    /// Whether the sphere or the one at `other`, on the path `seen`, hops and the other is within what is around all of its
    /// hops, `reach` (m) being the sum of the radii: what they near from there on is not found.
    #[inline]
    fn hops_around(&self, other: usize, (seen, reach): (&Path, f64)) -> bool {
        let hops = |slot: usize| self.trajectories.hopping.holds(self.trajectories.sphere(slot));
        (hops(self.slot) || hops(other)) && self.path.x.distance_squared(seen.x) <= reach * reach
    }

    /// Time of what is due, s: of a contact that begins sooner than the clock can tell, and would be left as it is now, the
    /// next one that the clock can tell. It would be found and left for ever.
    #[inline]
    fn time_of(&self, due: &Due, key: impl Fn() -> Key) -> f64 {
        let now = self.trajectories.now;
        let time = now + due.after;
        let at_once = time <= now && due.after > 0.0 && due.is_contact;
        if at_once && self.is_left(key()) { now.next_up() } else { time }
    }

    /// Whether a contact opens now, if only by rounding, and goes on opening.
    #[cold]
    #[inline(never)]
    fn is_left(&self, key: Key) -> bool {
        let contact = self.trajectories.contact_state(self.model, key);
        contact.a_n >= 0.0 && contact.v_n >= self.trajectories.min_separation_speed(&contact)
    }

    /// Whether the sphere and one on the path `seen`, which touch and accelerate alike, approach by rounding alone. What
    /// lies between two others would be sent from the one to the other for ever, and nothing that holds all three would
    /// take that little.
    #[cold]
    #[inline(never)]
    fn approaches_by_rounding(&self, seen: &Path) -> bool {
        let speeds = self.path.v.length() + seen.v.length();
        self.path.a == seen.a && pair_normal_velocity(self.path.x - seen.x, self.path.v - seen.v) >= -BRUSH * speeds
    }

    /// Whether the sphere and one on the path `seen`, which touch, stop their approach by themselves sooner than the clock can
    /// tell. To part them would send what lies between two others from the one to the other for ever.
    #[cold]
    #[inline(never)]
    fn turns_at_once(&self, seen: &Path) -> bool {
        let relative = self.path.relative_to(seen);
        let distance = relative.x.length();
        let grows = relative.distance_acceleration(relative.x / distance, distance);
        -pair_normal_velocity(relative.x, relative.v) <= grows * self.trajectories.clock_ulp()
    }

    /// Plans to meet the sphere at `other` at `time` (s) if nothing is planned before; returns 0 if the two rest on each
    /// other.
    #[inline]
    fn offer(&self, other: usize, time: f64, is_contact: bool, plan: &mut Plan) -> u64 {
        if time < plan.contact || time == plan.contact && self.wins_tie(other, plan) {
            if !self.rests.is_empty() && self.rest_on_each_other(other) {
                return 0;
            }
            (plan.contact, plan.kind, plan.is_contact) = (time, Kind::Pair, is_contact);
            (plan.other, plan.motion_version) = (other as u32, self.trajectories.records[other].motion_version);
        }
        1
    }

    /// Whether the sphere and the one at `other` rest on each other. Out of the way of a gas, in which nothing rests.
    #[cold]
    #[inline(never)]
    fn rest_on_each_other(&self, other: usize) -> bool {
        let (i, j) = (self.trajectories.sphere(self.slot), self.trajectories.sphere(other));
        self.rests.holds((Kind::Pair, i.min(j), i.max(j)))
    }

    /// Among pairs at one time the lower (a, b) comes first; walls come before pairs.
    #[cold]
    fn wins_tie(&self, other: usize, plan: &Plan) -> bool {
        let new = Plan { kind: Kind::Pair, other: other as u32, ..*plan };
        let key = |plan: &Plan| self.trajectories.key(self.slot, plan);
        plan.kind == Kind::Pair && plan.contact.is_finite() && key(&new) < key(plan)
    }
}

/// Whether a wall comes before what is planned for the same time: walls before pairs, the lower index before the higher.
#[inline]
fn wins_over(wall: usize, plan: &Plan) -> bool {
    plan.kind == Kind::Pair || wall < plan.other as usize
}
