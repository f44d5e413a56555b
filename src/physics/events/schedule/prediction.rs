//! What happens next to one sphere: its earliest contact, its way out of its cube, the end of its island's parabola.

use glam::DVec3;

use super::candidates::Candidates;
use super::cells::Exit;
use super::simd::{MOST, PairBatch, Query};
use crate::physics::contact::{Key, Kind};
use crate::physics::contact_time::straight_pair;
use crate::physics::events::detector::{Detector, Due, Span};
use crate::physics::events::engine::EventDriven;
use crate::physics::model::Model;
use crate::physics::path::Path;

/// The next event of a sphere as predicted with what was known then. One is kept per sphere: whichever of two partners
/// was predicted last knows of their contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plan {
    /// When it touches something, s; infinite if never.
    pub(crate) contact: f64,
    /// When it leaves its cube, s.
    pub(crate) crossing: f64,
    /// The wall or the other sphere.
    pub(crate) other: u32,
    /// How often the other sphere's motion had changed by then: if it has since, the plan is stale.
    pub(crate) stamp: u32,
    /// Wall or pair.
    pub(crate) kind: Kind,
    /// Whether they touch then; else it is time to look again.
    pub(crate) sure: bool,
    /// Into which cube.
    pub(crate) way: Exit,
}

impl Plan {
    /// Nothing happens.
    pub(crate) const IDLE: Plan = Plan {
        contact: f64::INFINITY,
        crossing: f64::INFINITY,
        other: 0,
        stamp: 0,
        kind: Kind::Wall,
        sure: true,
        way: Exit { axis: 0, sign: 1 },
    };
}

/// The order of events at one instant: walls, pairs, ends of parabolas, crossings; then a, then b.
pub(crate) type EventOrder = (u8, usize, usize);

/// What comes next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum EventKind {
    Contact,
    /// An island's parabolas end.
    End,
    Crossing,
}

impl<D: Detector> EventDriven<D> {
    /// Predicts sphere `i` afresh from the present on.
    pub(crate) fn predict(&mut self, model: &Model, i: usize) {
        self.predict_at(model, self.flight.seat(i));
    }

    /// The same for the sphere at a seat.
    pub(crate) fn predict_at(&mut self, model: &Model, seat: usize) {
        self.make_plan(model, seat);
        self.schedule(seat);
    }

    /// The same where the event that is handled was entered for this seat, and everything else is predicted already.
    pub(crate) fn predict_due(&mut self, model: &Model, seat: usize) {
        self.make_plan(model, seat);
        self.enter_due(seat);
    }

    /// Makes the plan of the sphere at a seat.
    fn make_plan(&mut self, model: &Model, seat: usize) {
        let path = self.flight.path_from(seat, self.now);
        self.until = self.rests.end_of(self.flight.sphere(seat)).next_up();
        let mut plan = Plan::IDLE;
        self.catch(seat);
        let count = if self.cells.is_some() {
            self.meet_near(model, seat, &path, None, &mut plan)
        } else {
            let others = (0..model.len()).filter(|&other| other != seat);
            self.walls(model, seat, &path, 0..model.faces.len(), &mut plan)
                + others.map(|other| self.pair(seat, &path, other, &mut plan)).sum::<u64>()
        };
        self.evaluations += count;
        self.wear.look(count);
        self.flight.records[seat].plan = plan;
    }

    /// The sphere at a seat crosses into the next cube: what it was to meet stays, nine cubes and their walls are new.
    pub(crate) fn cross(&mut self, model: &Model, seat: usize) {
        let path = self.flight.path_from(seat, self.now);
        self.until = self.rests.end_of(self.flight.sphere(seat)).next_up();
        let seats = self.flight.records.len();
        let EventDriven { cells: Some(cells), flight, .. } = self else { return };
        let record = &mut flight.records[seat];
        let mut plan = record.plan;
        record.spot = cells.cross(seat, record.spot, plan.way, seats);
        let count = self.meet_near(model, seat, &path, Some(plan.way), &mut plan);
        self.evaluations += count;
        self.wear.cross(count);
        self.flight.records[seat].plan = plan;
        self.enter_due(seat);
    }

    /// Looks at the spheres around a sphere's cube and at the walls near it, or only at those that came within reach
    /// when it went `way`; and when it will leave its cube. Returns how many it looked at.
    fn meet_near(&mut self, model: &Model, seat: usize, path: &Path, way: Option<Exit>, plan: &mut Plan) -> u64 {
        let Some(cells) = &self.cells else { return 0 };
        let spot = self.flight.records[seat].spot;
        let Some(mut near) = self.near.take() else { return 0 };
        cells.look(spot, way, &mut near, self.flight.records.len());
        // pairs first where that is quick: what they are to meet soon spares most walls the search for edges
        let early = if D::SOLVES { self.pairs(seat, path, &mut near, plan) } else { 0 };
        let mut count = early;
        if spot.is_loose() {
            count += self.walls(model, seat, path, 0..model.faces.len(), plan);
        } else {
            let (crossing, way) = cells.crossing(spot.cube, path);
            (plan.crossing, plan.way) = (self.now + crossing, way);
            let walls = cells.walls_near(spot).iter().map(|&wall| wall as usize);
            count += self.walls(model, seat, path, walls, plan);
        }
        if !D::SOLVES {
            count += self.pairs(seat, path, &mut near, plan);
        }
        self.near = Some(near);
        count
    }

    /// Enters the earliest of a sphere's plan and its island's end into the queue.
    pub(crate) fn schedule(&mut self, seat: usize) {
        let due = self.due(seat);
        self.queue.set(seat, due);
        self.next = None;
        self.tie(seat, due);
    }

    /// The same where the event that is handled was entered for this seat, and everything else is entered already: then
    /// it is known what comes next.
    #[inline]
    fn enter_due(&mut self, seat: usize) {
        let due = self.due(seat);
        self.next = self.queue.replace_first(seat, due);
        self.tie(seat, due);
    }

    #[inline]
    fn due(&self, seat: usize) -> f64 {
        let record = &self.flight.records[seat];
        let time = record.plan.contact.min(record.plan.crossing);
        if self.rests.is_empty() { time } else { time.min(self.rests.end_led_by(record.sphere as usize)) }
    }

    /// What the entry of a seat at `time` stands for.
    #[inline]
    pub(crate) fn sort(&self, time: f64, seat: usize) -> EventKind {
        if time == f64::INFINITY {
            // nothing ever happens, perhaps because there is nobody
            return EventKind::Crossing;
        }
        let record = &self.flight.records[seat];
        if record.plan.contact == time {
            EventKind::Contact
        } else if !self.rests.is_empty() && self.rests.end_led_by(record.sphere as usize) == time {
            EventKind::End
        } else {
            EventKind::Crossing
        }
    }

    /// Its place in the order of events.
    pub(crate) fn rank(&self, time: f64, seat: usize) -> EventOrder {
        let (record, i) = (&self.flight.records[seat], self.flight.sphere(seat));
        match self.sort(time, seat) {
            EventKind::Contact => {
                let (kind, a, b) = self.key(seat, &record.plan);
                (if kind == Kind::Wall { 0 } else { 1 }, a, b)
            }
            EventKind::End => (2, i, 0),
            EventKind::Crossing => (3, i, 0),
        }
    }

    /// Which contact a plan for a seat means.
    #[inline]
    pub(crate) fn key(&self, seat: usize, plan: &Plan) -> Key {
        let i = self.flight.sphere(seat);
        match plan.kind {
            Kind::Wall => (Kind::Wall, i, plan.other as usize),
            Kind::Pair => {
                let j = self.flight.sphere(plan.other as usize);
                (Kind::Pair, i.min(j), i.max(j))
            }
        }
    }

    /// Looks at some walls, in ascending order; returns how many.
    #[inline]
    fn walls(
        &self,
        model: &Model,
        seat: usize,
        path: &Path,
        walls: impl Iterator<Item = usize>,
        plan: &mut Plan,
    ) -> u64 {
        let (i, r) = (self.flight.sphere(seat), self.flight.records[seat].line.r);
        let mut count = 0;
        for wall in walls {
            if self.rests.holds((Kind::Wall, i, wall)) {
                continue;
            }
            count += 1;
            let Some(due) = self.detector.wall(path, r, &model.faces[wall], self.span_for_walls(plan)) else {
                continue;
            };
            let time = self.now + due.after;
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
        match plan.kind {
            Kind::Pair if D::SOLVES => {
                Span { now: self.now, before: (plan.contact.min(self.until).next_up() - self.now).next_up() }
            }
            _ => self.span_before(plan.contact),
        }
    }

    #[inline]
    fn span_before(&self, time: f64) -> Span {
        Span { now: self.now, before: time.min(self.until) - self.now }
    }

    /// Looks at the pairs of a sphere and those near it, itself among them; returns how many.
    #[inline]
    fn pairs(&self, seat: usize, path: &Path, near: &mut Candidates, plan: &mut Plan) -> u64 {
        if D::SOLVES && self.flight.common().is_some() {
            self.alike(seat, path, near, plan);
        } else {
            for &other in near.seats().iter().filter(|&&other| other as usize != seat) {
                self.pair(seat, path, other as usize, plan);
            }
        }
        near.seats().len() as u64
    }

    /// Looks at pairs whose relative motion is straight.
    #[inline(always)]
    fn alike(&self, seat: usize, path: &Path, near: &mut Candidates, plan: &mut Plan) {
        let records = &self.flight.records[..];
        let eye = Query { path, r: records[seat].line.r, now: self.now };
        let (seats, fours) = near.padded(seat);
        let mut rest = seats;
        while !rest.is_empty() {
            let (seats, later) = rest.split_at(rest.len().min(MOST));
            rest = later;
            let first = self.lanes.look(eye, records, seats, fours);
            if first.doubtful || !self.rests.is_empty() {
                self.choose(seat, path, seats, fours, first.meet, plan);
            } else if first.time < f64::INFINITY {
                self.offer(seat, first.with as usize, first.time, true, plan);
            }
        }
    }

    /// Looks at the pairs with a bit in `meet` one by one: one overlaps by rounding, some may rest, or several meet at the
    /// same time.
    #[cold]
    #[inline(never)]
    fn choose(&self, seat: usize, path: &Path, seats: &[u32], fours: &[PairBatch], mut meet: u64, plan: &mut Plan) {
        while meet != 0 {
            let k = meet.trailing_zeros() as usize;
            meet &= meet - 1;
            let (four, lane, other) = (&fours[k / 4], k % 4, seats[k] as usize);
            let (b, c) = (four.b[lane], four.c[lane]);
            let time = self.now + c / (four.discriminant[lane].sqrt() - b);
            if c <= 0.0 {
                // whether they approach is for the handler's own expression to say
                self.pair(seat, path, other, plan);
            } else if time <= self.flight.records[other].plan.contact && time < f64::INFINITY {
                self.offer(seat, other, time, true, plan);
            }
        }
    }

    /// Looks at one pair; returns 1 if there was anything to look at.
    #[inline]
    fn pair(&self, seat: usize, path: &Path, other: usize, plan: &mut Plan) -> u64 {
        let line = &self.flight.records[other].line;
        let reach = self.flight.records[seat].line.r + line.r;
        let found = if D::SOLVES && self.flight.common() == Some(DVec3::ZERO) {
            let t = straight_pair(path.x - (line.x + line.v * (self.now - line.t)), path.v - line.v, reach);
            t.map(|after| Due { after, sure: true })
        } else {
            // what the other meets before makes it look around anew, and find this one then
            let theirs = self.flight.records[other].plan.contact;
            let before = if D::SOLVES { plan.contact } else { plan.contact.min(theirs) };
            self.detector.pair(path, &self.flight.path_from(other, self.now), reach, self.span_before(before))
        };
        let Some(due) = found else { return 1 };
        self.offer(seat, other, self.now + due.after, due.sure, plan)
    }

    /// Plans to meet the sphere at `other` at `time` (s) if nothing is planned before; returns 0 if the two rest on each
    /// other.
    #[inline]
    fn offer(&self, seat: usize, other: usize, time: f64, sure: bool, plan: &mut Plan) -> u64 {
        if time < plan.contact || time == plan.contact && self.wins_tie(seat, other, plan) {
            if !self.rests.is_empty() {
                let (i, j) = (self.flight.sphere(seat), self.flight.sphere(other));
                if self.rests.holds((Kind::Pair, i.min(j), i.max(j))) {
                    return 0;
                }
            }
            (plan.contact, plan.kind, plan.sure) = (time, Kind::Pair, sure);
            (plan.other, plan.stamp) = (other as u32, self.flight.records[other].stamp);
        }
        1
    }

    /// Among pairs at one time the lower (a, b) comes first; walls come before pairs.
    #[cold]
    fn wins_tie(&self, seat: usize, other: usize, plan: &Plan) -> bool {
        let new = Plan { kind: Kind::Pair, other: other as u32, ..*plan };
        plan.kind == Kind::Pair && plan.contact.is_finite() && self.key(seat, &new) < self.key(seat, plan)
    }
}
