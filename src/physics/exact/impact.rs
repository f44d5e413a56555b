//! A contact happens: the impact law acts, or a rest may begin.

use glam::DVec3;

use super::Exact;
use super::bounce::{along, pair_push};
use crate::physics::contact::Key;
use crate::physics::contact_time::{Part, curvature, pair_normal_velocity, touch};
use crate::physics::detector::Detector;
use crate::physics::log::Log;
use crate::physics::motion::{normal_velocity, separation_speed};
use crate::physics::parts::part_ahead;
use crate::physics::state::runaway;
use crate::physics::{Class, Contact, Kind, Model, Stall};

/// Flights shorter than this many times the clock's rounding, over 1 − e, never decay (Zeno).
pub(super) const ZENO: f64 = 10.0;

/// Hops no higher than this, relative to the coordinates, are rounding: 4 ulp.
pub(super) const HOP: f64 = 4.0 * f64::EPSILON;

/// Normal velocities below this share of the speed may be those of a sphere that slides.
const SLOW: f64 = 1e-6;

/// Two bodies that touch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    pub(super) key: Key,
    pub(super) point: DVec3,
    pub(super) normal: DVec3,
    /// Gap, m, and what it is measured by: r, or r₁ + r₂.
    pub(super) gap: f64,
    pub(super) reach: f64,
    /// Normal velocity, m/s: the predictor's own expression.
    pub(super) v_n: f64,
    /// How fast v_n grows as things are, m/s²; negative: pressed together.
    pub(super) a_n: f64,
    /// Whether that stays so as the bodies move: the face of a wall.
    pub(super) flat: bool,
}

impl Meeting {
    /// Whether bodies pressed together with `pull` (m/s²) would part by less than coordinates can tell, flying off at the
    /// speed at which they approach or part.
    pub(super) fn hops_within_rounding(&self, pull: f64) -> bool {
        self.v_n * self.v_n <= 2.0 * pull * HOP * self.size()
    }

    /// What rounding of its coordinates is relative to, m.
    pub(super) fn size(&self) -> f64 {
        self.point.abs().max_element().max(self.reach)
    }

    /// The row of this contact: `impulse` in N s, v_n afterwards in m/s.
    pub(super) fn row(&self, time: f64, class: Class, impulse: f64, separation_speed: f64) -> Contact {
        let (kind, a, b) = self.key;
        Contact {
            time,
            kind,
            a,
            b,
            point: self.point,
            normal: self.normal,
            approach_speed: -self.v_n,
            separation_speed,
            impulse,
            degree: -self.gap / self.reach,
            class,
        }
    }
}

/// Most contacts that a frame lists, a hundred megabytes: a chain of impacts at one instant may have more, which are
/// counted and told as events all the same.
const MOST_ROWS: usize = 1 << 20;

/// Tells the log of an impact.
#[inline]
pub(super) fn note(log: &mut Log, row: Contact) {
    log.tallies.deepest_degree = log.tallies.deepest_degree.max(row.degree);
    if log.contacts.len() < MOST_ROWS {
        log.contacts.push(row);
    }
    log.event(row);
}

impl<D: Detector> Exact<D> {
    /// The contact that the sphere at a seat planned is due.
    pub(super) fn contact(&mut self, model: &Model, log: &mut Log, seat: usize) -> Result<(), Stall> {
        let plan = self.flight.records[seat].plan;
        let stale = plan.kind == Kind::Pair && self.flight.records[plan.other as usize].stamp != plan.stamp;
        let rests = !self.rests.is_empty() && self.rests.holds(self.key(seat, &plan));
        if !plan.sure || stale || rests {
            self.predict_first(model, seat);
            return Ok(());
        }
        if !self.strike(model, log, seat, &plan)? {
            self.meet(model, log, self.key(seat, &plan))?;
        }
        // whatever became of the contact, this plan is used up
        if self.flight.records[seat].plan == plan {
            self.predict_at(model, seat);
        }
        Ok(())
    }

    /// The bodies of a contact now, their lines brought to the present.
    pub(super) fn meeting(&mut self, model: &Model, key: Key) -> Meeting {
        let (kind, a, b) = key;
        self.bring(model, a);
        if kind == Kind::Pair {
            self.bring(model, b);
        }
        self.seen(model, key, self.now)
    }

    /// The same at `time` (s) without touching the lines.
    pub(super) fn seen(&self, model: &Model, key: Key, time: f64) -> Meeting {
        let (kind, a, b) = key;
        let path = self.flight.path(a, time);
        match kind {
            Kind::Wall => {
                let (face, r) = (&model.faces[b], self.flight.line(a).r);
                let at = touch(face, path.x, r);
                let v_n = normal_velocity(path.v, DVec3::ZERO, at.normal);
                // only what may rest asks on which side of a border it will be
                let slow = v_n.abs() <= SLOW * path.v.length();
                let part = if slow { part_ahead(face, path.x, path.v, path.a, r) } else { at.part };
                let a_n = at.normal.dot(path.a) + curvature(face, part, at.normal, path.v, r);
                let flat = part == Part::Face && at.part == part;
                Meeting { key, point: at.point, normal: at.normal, gap: at.gap, reach: r, v_n, a_n, flat }
            }
            Kind::Pair => {
                let other = self.flight.path(b, time);
                let relative = path.relative_to(&other);
                let (r_a, r_b) = (self.flight.line(a).r, self.flight.line(b).r);
                let (reach, distance) = (r_a + r_b, relative.x.length());
                let (normal, gap) = (relative.x / distance, distance - reach);
                let v_n = pair_normal_velocity(relative.x, relative.v);
                let across = relative.v - normal * v_n;
                let a_n = normal.dot(relative.a) + across.length_squared() / distance;
                let point = other.x + normal * (r_b + 0.5 * gap);
                Meeting { key, point, normal, gap, reach, v_n, a_n, flat: false }
            }
        }
    }

    /// The same for somebody who only looks: without what the impact law asks, which takes far longer to find.
    pub(super) fn shown(&self, model: &Model, key: Key, time: f64) -> Meeting {
        let (kind, a, b) = key;
        if kind == Kind::Pair {
            return self.seen(model, key, time);
        }
        let reach = self.flight.line(a).r;
        let at = touch(&model.faces[b], self.flight.path(a, time).x, reach);
        Meeting { key, point: at.point, normal: at.normal, gap: at.gap, reach, v_n: 0.0, a_n: 0.0, flat: false }
    }

    /// The impact law acts on a contact.
    pub(super) fn meet(&mut self, model: &Model, log: &mut Log, key: Key) -> Result<(), Stall> {
        let before = *self.flight.line(key.1);
        let since = if key.0 == Kind::Pair { before.t.max(self.flight.line(key.2).t) } else { before.t };
        let mut meeting = self.meeting(model, key);
        self.keep_energy(model, &before, &mut meeting);
        if self.is_squeezed(model, &meeting) {
            return Ok(());
        }
        match self.class(model, log, &meeting, since) {
            Class::Collide => self.collide(model, log, &meeting),
            // an island that takes that back brings it again: the two are solved together then
            Class::Rest if self.brushes(&meeting) && !self.instant.is_stuck(key) => {
                self.turn_back(model, &meeting);
                self.follow_up(model, log, key)
            }
            Class::Rest => {
                self.rests.propose(
                    model,
                    &self.flight,
                    self.now,
                    &meeting,
                    self.now + self.bounces_left(model, &meeting),
                );
                Ok(())
            }
            Class::Leave | Class::Release => {
                if meeting.a_n >= 0.0 {
                    self.part(model, key, self.hop_speed(&meeting));
                }
                Ok(())
            }
        }
    }

    /// An impact: both bodies get their impulse.
    pub(super) fn collide(&mut self, model: &Model, log: &mut Log, meeting: &Meeting) -> Result<(), Stall> {
        let (kind, a, b) = meeting.key;
        let target = separation_speed(meeting.v_n, Class::Collide, kind, &model.law);
        let change = target - meeting.v_n;
        let impulse = match kind {
            Kind::Wall => {
                let v = self.flight.line(a).v;
                let slip = (v - meeting.normal * meeting.v_n) * (model.law.tangential - 1.0);
                self.push(a, along(meeting.normal, change) + slip);
                change * model.masses[a]
            }
            Kind::Pair => {
                let (one, two) = (*self.flight.line(a), *self.flight.line(b));
                let (arm, w) = (one.x - two.x, one.v - two.v);
                let (share_a, share_b) = (self.flight.inverse_mass(a), self.flight.inverse_mass(b));
                let share = share_a + share_b;
                let push = pair_push(arm, w, share, model.law.restitution);
                self.push(a, push * share_a);
                self.push(b, push * -share_b);
                change / share
            }
        };
        self.part(model, meeting.key, 0.0);
        let row = meeting.row(self.now, Class::Collide, impulse, target);
        note(log, row);
        self.count_impact(meeting);
        self.follow_up(model, log, meeting.key)?;
        if target == 0.0 && meeting.a_n < 0.0 {
            // nothing is left to wait for; from an ulp above the face it would take √(2 ulp/g) to fall
            self.rests.propose(model, &self.flight, self.now, &Meeting { v_n: 0.0, ..*meeting }, self.now);
        }
        self.sum_up(model, meeting);
        Ok(())
    }

    /// The bodies of a contact have got new velocities: rests that this breaks end, and what comes next is predicted.
    fn follow_up(&mut self, model: &Model, log: &mut Log, (kind, a, b): Key) -> Result<(), Stall> {
        let touched = if kind == Kind::Pair { &[a, b][..] } else { &[a][..] };
        for &i in touched {
            self.finite(i)?;
            self.flight.stamp(i);
            self.disturb(model, log, i);
        }
        for &i in touched {
            self.predict(model, i);
        }
        Ok(())
    }

    /// Changes the velocity of sphere `i`, whose line is at the present, m/s.
    pub(super) fn push(&mut self, i: usize, change: DVec3) {
        let line = *self.flight.line(i);
        self.flight.rewrite(i, self.now, line.x, line.v + change);
    }

    /// Sees to it that a contact that is over opens at `least` (m/s, rounding) at least: the predictor would find it
    /// again and again. The body that is freer gives way.
    pub(super) fn part(&mut self, model: &Model, key: Key, least: f64) {
        let (kind, a, b) = key;
        let yields = kind == Kind::Pair && self.rests.count(b) < self.rests.count(a);
        let (i, sign) = if yields { (b, -1.0) } else { (a, 1.0) };
        let mut nudge = f64::EPSILON * self.flight.line(i).v.length().max(f64::MIN_POSITIVE);
        for _ in 0..64 {
            let v_n = self.v_n(model, key);
            if v_n >= least || v_n.is_nan() {
                return;
            }
            let normal = self.seen(model, key, self.now).normal;
            self.push(i, normal * (sign * nudge.max(least - v_n)));
            nudge *= 2.0;
        }
    }

    /// The normal velocity of a contact whose lines are at the present, m/s.
    fn v_n(&self, model: &Model, key: Key) -> f64 {
        let (kind, a, b) = key;
        if kind == Kind::Wall {
            return self.seen(model, key, self.now).v_n;
        }
        let (one, two) = (self.flight.line(a), self.flight.line(b));
        pair_normal_velocity(one.x - two.x, one.v - two.v)
    }

    /// Says so if what has just happened sends sphere `i` out of the range of numbers.
    pub(super) fn finite(&self, i: usize) -> Result<(), Stall> {
        self.finite_at(self.flight.seat(i))
    }

    /// The same for the sphere at a seat.
    #[inline]
    pub(super) fn finite_at(&self, seat: usize) -> Result<(), Stall> {
        let line = &self.flight.records[seat].line;
        let cause = "a contact has sent it there; begin with smaller speeds, or change the method from here";
        runaway(self.flight.sphere(seat), self.now, [line.x, line.v], cause).map_or(Ok(()), Err)
    }
}
