//! What happens next to one sphere: its earliest contact, its way out of its cube, the end of its island's parabola.

use glam::DVec3;

use super::Exact;
use super::cells::{Near, Way};
use super::flight::Line;
use crate::physics::contact_time::{Path, straight_pair};
use crate::physics::detector::{Detector, Due, Span};
use crate::physics::{Kind, Model};

/// The next event of a sphere as predicted with what was known then. One is kept per sphere: whichever of two partners
/// was predicted last knows of their contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plan {
    /// When it touches something, s; infinite if never.
    pub(super) contact: f64,
    /// When it leaves its cube, s.
    pub(super) crossing: f64,
    /// The wall or the other sphere.
    pub(super) other: u32,
    /// How often the other sphere's motion had changed by then: if it has since, the plan is stale.
    pub(super) stamp: u32,
    /// Wall or pair.
    pub(super) kind: Kind,
    /// Whether they touch then; else it is time to look again.
    pub(super) sure: bool,
    /// Into which cube.
    pub(super) way: Way,
}

impl Plan {
    /// Nothing happens.
    pub(super) const IDLE: Plan = Plan {
        contact: f64::INFINITY,
        crossing: f64::INFINITY,
        other: 0,
        stamp: 0,
        kind: Kind::Wall,
        sure: true,
        way: Way { axis: 0, sign: 1 },
    };
}

/// The order of events at one instant: walls, pairs, ends of parabolas, crossings; then a, then b.
pub(super) type Rank = (u8, usize, usize);

impl<D: Detector> Exact<D> {
    /// Predicts sphere `i` afresh from the present on.
    pub(super) fn predict(&mut self, model: &Model, i: usize) {
        let path = self.flight.path(i, self.now);
        let mut plan = Plan::IDLE;
        let evaluations = if self.cells.is_some() {
            self.meet_near(model, i, &path, None, &mut plan)
        } else {
            let spheres = (0..model.len()).filter(|&j| j != i);
            self.walls(model, i, &path, 0..model.faces.len(), &mut plan)
                + spheres.map(|j| self.pair(i, &path, j, &mut plan)).sum::<u64>()
        };
        self.evaluations += evaluations;
        self.plans[i] = plan;
        self.schedule(i);
    }

    /// Sphere `i` crosses into the next cube: what it was to meet stays, nine cubes and their walls are new.
    pub(super) fn cross(&mut self, model: &Model, i: usize) {
        let mut plan = self.plans[i];
        let path = self.flight.path(i, self.now);
        let Some(cells) = &mut self.cells else { return };
        cells.cross(i, plan.way);
        self.evaluations += self.meet_near(model, i, &path, Some(plan.way), &mut plan);
        self.plans[i] = plan;
        self.schedule(i);
    }

    /// Looks at the walls near sphere `i`'s cube and at the spheres around it, or only at those that came within reach
    /// when it went `way`; and when it will leave its cube. Returns how many it looked at.
    fn meet_near(&mut self, model: &Model, i: usize, path: &Path, way: Option<Way>, plan: &mut Plan) -> u64 {
        let Some(cells) = &mut self.cells else { return 0 };
        let mut near = std::mem::take(&mut cells.near);
        match way {
            None => cells.around(i, &mut near),
            Some(way) => cells.ahead(i, way, &mut near),
        }
        let (crossing, way) = cells.crossing(i, path);
        (plan.crossing, plan.way) = (self.now + crossing, way);
        let walls = self.cells.iter().flat_map(|cells| cells.walls_near(i)).map(|&wall| wall as usize);
        let count = self.walls(model, i, path, walls, plan) + self.pairs(i, path, &near, plan);
        if let Some(cells) = &mut self.cells {
            cells.near = near;
        }
        count
    }

    /// Enters the earliest of sphere `i`'s plan and its island's end into the queue.
    #[inline]
    pub(super) fn schedule(&mut self, i: usize) {
        let plan = &self.plans[i];
        let contact = plan.contact.min(plan.crossing);
        self.queue.set(i, if self.rests.is_empty() { contact } else { contact.min(self.rests.end_led_by(i)) });
    }

    /// What sphere `i`'s entry at `time` stands for.
    pub(super) fn rank(&self, time: f64, i: usize) -> Rank {
        let plan = &self.plans[i];
        let other = plan.other as usize;
        match plan.kind {
            Kind::Wall if plan.contact == time => (0, i, other),
            Kind::Pair if plan.contact == time => (1, i.min(other), i.max(other)),
            _ if self.rests.end_led_by(i) == time => (2, i, 0),
            _ => (3, i, 0),
        }
    }

    /// Looks at some walls, in ascending order; returns how many.
    #[inline]
    fn walls(&self, model: &Model, i: usize, path: &Path, walls: impl Iterator<Item = usize>, plan: &mut Plan) -> u64 {
        let mut count = 0;
        for wall in walls {
            if self.rests.holds((Kind::Wall, i, wall)) {
                continue;
            }
            count += 1;
            let span = self.span_before(plan.contact);
            let Some(due) = self.detector.wall(path, model.radii[i], &model.faces[wall], span) else { continue };
            let time = self.now + due.after;
            if time < plan.contact {
                (plan.contact, plan.kind, plan.other, plan.sure) = (time, Kind::Wall, wall as u32, due.sure);
            }
        }
        count
    }

    /// Looks at the pairs of sphere `i` and those near it, itself among them or not; returns how many.
    #[inline]
    fn pairs(&self, i: usize, path: &Path, near: &Near, plan: &mut Plan) -> u64 {
        match self.flight.common().filter(|_| D::SOLVES) {
            Some(DVec3::ZERO) => self.alike(i, path, near.slots(), |line, dt| (line.x + line.v * dt, line.v), plan),
            Some(a) => {
                let then = |line: &Line, dt: f64| (line.x + (line.v + a * (0.5 * dt)) * dt, line.v + a * dt);
                self.alike(i, path, near.slots(), then, plan);
            }
            None => {
                for &j in near.slots().iter().filter(|&&j| j as usize != i) {
                    self.pair(i, path, j as usize, plan);
                }
            }
        }
        for &j in near.spilled().iter().filter(|&&j| j as usize != i) {
            self.pair(i, path, j as usize, plan);
        }
        (near.slots().len() + near.spilled().len()) as u64
    }

    /// Looks at pairs whose relative motion is straight. One in ten meets at all: that is the only branch, a weaker
    /// question than that of [`straight_pair`].
    #[inline(always)]
    fn alike(&self, i: usize, path: &Path, near: &[u32], then: impl Fn(&Line, f64) -> (DVec3, DVec3), plan: &mut Plan) {
        let lines = &self.flight.lines[..];
        let r = lines[i].r;
        for &j in near {
            let line = &lines[j as usize];
            let (x, v) = then(line, self.now - line.t);
            let (x, v, reach) = (path.x - x, path.v - v, r + line.r);
            // a pair that parts counts as one that passes by, as sphere i itself does
            let b = x.dot(v).min(0.0);
            let c = x.length_squared() - reach * reach;
            if b * b > v.length_squared() * c
                && let Some(t) = straight_pair(x, v, reach)
            {
                let time = self.now + t;
                // what j meets before makes it look around anew, and find i then
                if time <= self.plans[j as usize].contact {
                    self.offer(i, j as usize, Due { after: t, sure: true }, plan);
                }
            }
        }
    }

    /// Looks at one pair; returns 1 if there was anything to look at.
    #[inline]
    fn pair(&self, i: usize, path: &Path, j: usize, plan: &mut Plan) -> u64 {
        let line = &self.flight.lines[j];
        let reach = self.flight.lines[i].r + line.r;
        let found = if D::SOLVES && self.flight.common() == Some(DVec3::ZERO) {
            let t = straight_pair(path.x - (line.x + line.v * (self.now - line.t)), path.v - line.v, reach);
            t.map(|after| Due { after, sure: true })
        } else {
            // what j meets before makes it look around anew, and find i then
            let before = if D::SOLVES { plan.contact } else { plan.contact.min(self.plans[j].contact) };
            self.detector.pair(path, &self.flight.path(j, self.now), reach, self.span_before(before))
        };
        let Some(due) = found else { return 1 };
        self.offer(i, j, due, plan)
    }

    /// Plans to meet sphere `j` if nothing is planned before; returns 0 if the two rest on each other.
    #[inline]
    fn offer(&self, i: usize, j: usize, due: Due, plan: &mut Plan) -> u64 {
        let time = self.now + due.after;
        if time < plan.contact || time == plan.contact && self.wins_tie(i, j, plan) {
            if self.rests.holds((Kind::Pair, i.min(j), i.max(j))) {
                return 0;
            }
            (plan.contact, plan.kind, plan.sure) = (time, Kind::Pair, due.sure);
            (plan.other, plan.stamp) = (j as u32, self.stamps[j]);
        }
        1
    }

    fn span_before(&self, time: f64) -> Span {
        Span { now: self.now, before: time - self.now }
    }

    /// Among pairs at one time the lower (a, b) comes first; walls come before pairs.
    fn wins_tie(&self, i: usize, j: usize, plan: &Plan) -> bool {
        let other = plan.other as usize;
        plan.kind == Kind::Pair && plan.contact.is_finite() && (i.min(j), i.max(j)) < (i.min(other), i.max(other))
    }
}
