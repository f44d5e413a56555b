//! How bodies come to a contact that `exact` tells: when, past what else, and whether others touch at the same time.

use super::course::Course;
use super::ending::{Cause, Ending};
use super::obstacle::{Part, Region};
use super::shadow::{Shadow, ending};
use super::start::{AT_EVENT, AT_LOAD, Start};
use super::support::ROUNDING;
use super::touching::touching;
use super::vector::Vector;
use crate::double::Double;
use crate::physics::{Class, Contact, Kind};

/// Part of a time that passes between events of one instant in `exact`: an ulp or two, of which this is some thirty.
pub(super) const SAME_TIME: f64 = 1e-14;

/// Part of a time that passes between events of one instant in the shadow: rounding of its arithmetic.
const SAME_SHADOW_TIME: f64 = 1e-25;

impl Shadow {
    /// Whether two times (s) differ by no more than rounding.
    pub(super) fn at_one_time(&self, one: Double, two: Double) -> bool {
        (one - two).abs() <= (one.abs() + two.abs()) * Double::from(SAME_SHADOW_TIME)
    }

    /// Whether a sphere of a contact has come to another one at the same instant of `exact`.
    pub(super) fn is_amid(&self, row: &Contact) -> bool {
        let sides = [Some(row.a), (row.kind == Kind::Pair).then_some(row.b)];
        let met = |i: usize| self.bodies[i].since > 0.0 && row.time <= self.bodies[i].since * (1.0 + SAME_TIME);
        sides.into_iter().flatten().any(met)
    }

    /// Whether a contact holds sphere `i`.
    pub(super) fn holds(&self, i: usize, (kind, b): (Kind, usize)) -> bool {
        match kind {
            Kind::Wall => self.bodies[i].holder(b).is_some(),
            Kind::Pair => self.leans.contains(&(i.min(b), i.max(b))),
        }
    }

    /// Whether sphere `i` touches something at `t`, s.
    pub(super) fn touches(&self, i: usize, (kind, b): (Kind, usize), t: Double) -> bool {
        let (body, x) = (&self.bodies[i], self.bodies[i].course(t).at(t));
        if kind == Kind::Pair {
            return self.gap_of_pair([i, b], t).abs() <= self.in_touch([i, b], t);
        }
        let gap = self.plates[b].closest(x).1.arm(x).length() - body.radius;
        gap.value().abs() <= AT_EVENT * body.radius.value()
    }

    /// Distance of two spheres' surfaces at `t` (s), m.
    fn gap_of_pair(&self, [a, b]: [usize; 2], t: Double) -> f64 {
        let [one, two] = [a, b].map(|i| &self.bodies[i]);
        ((one.course(t).at(t) - two.course(t).at(t)).length() - one.radius - two.radius).value()
    }

    /// The gap (m) up to which two spheres touch: more, where the scene has put them a little into or apart from each other
    /// and they have not moved since.
    fn in_touch(&self, [a, b]: [usize; 2], t: Double) -> f64 {
        let [one, two] = [a, b].map(|i| &self.bodies[i]);
        let reach = (one.radius + two.radius).value();
        let at_load = ((one.start - two.start).length() - one.radius - two.radius).value();
        let stays = (self.gap_of_pair([a, b], t) - at_load).abs() <= AT_EVENT * reach;
        if stays && at_load.abs() <= AT_LOAD * reach { AT_LOAD * reach } else { AT_EVENT * reach }
    }

    /// How fast sphere `i` parts from something at `t` (s), m/s.
    pub(super) fn parting(&self, i: usize, (kind, b): (Kind, usize), t: Double) -> Double {
        let course = self.bodies[i].course(t);
        let (x, v) = (course.at(t), course.velocity(t));
        if kind == Kind::Wall {
            return v.dot(self.plates[b].closest(x).1.normal(x));
        }
        let other = self.bodies[b].course(t);
        (v - other.velocity(t)).dot((x - other.at(t)).unit())
    }

    /// Brings two spheres to where they meet: at once, if they touch already.
    pub(super) fn meet_pair(&mut self, row: &Contact) -> Result<(), Ending> {
        let (a, b) = (row.a, row.b);
        let [one, two] = [a, b].map(|i| &self.bodies[i].now);
        let since = if one.t < two.t { two.t } else { one.t };
        let told = self.bodies[a].since.max(self.bodies[b].since);
        let mut t = since;
        if self.gap_of_pair([a, b], since).abs() > self.in_touch([a, b], since) || row.time > told * (1.0 + SAME_TIME) {
            let reach = self.bodies[a].radius + self.bodies[b].radius;
            let relative = |t: Double| {
                let [[x, v, _], [y, w, _]] = [one, two].map(|course| course.state(t));
                [x - y, v - w]
            };
            let met = touching(relative, &Part::Point(Vector::default()), reach, row.time);
            t = self.not_before(row, met.ok_or_else(|| ending(row, Cause::NoContact))?, since)?;
        }
        for (i, other) in [(a, b), (b, a)] {
            self.bring(i, t, row.time, (Kind::Pair, other))?;
        }
        self.count_tie(row, t);
        Ok(())
    }

    /// Brings a sphere to a wall; the part of the wall that it touches.
    pub(super) fn meet_wall(&mut self, row: &Contact) -> Result<(Region, Part), Ending> {
        let (i, w) = (row.a, row.b);
        let (contact, body) = ((Kind::Wall, w), &self.bodies[i]);
        let (now, radius) = (body.now.clone(), body.radius);
        let holds = body.holder(w).is_some();
        let at_load = row.time == 0.0 && {
            let part = self.plates[w].closest(now.x).1;
            (part.arm(now.x).length() - radius).value().abs() <= AT_LOAD * radius.value()
        };
        let glided = || Start::of(&body.before, &self.plates[w], radius) == Start::Glides;
        if at_load || (body.open && (holds || body.met.contains(&contact) || glided())) {
            if row.time > body.since * (1.0 + SAME_TIME) {
                return Err(ending(row, Cause::OtherOrder));
            }
            self.change(i, now.t, row.time, contact);
            self.count_tie(row, now.t);
            return Ok(self.plates[w].closest(now.x));
        }
        if holds {
            return Err(ending(row, Cause::OtherClass));
        }
        let mut found = (Double::from(row.time), self.plates[w].closest(now.at(row.time.into())));
        for _ in 0..2 {
            let (_, (region, part)) = found;
            let t = touching(|t| [now.at(t), now.velocity(t)], &part, radius, row.time)
                .ok_or_else(|| ending(row, Cause::NoContact))?;
            found = (t, self.plates[w].closest(now.at(t)));
            if found.1.0 == region {
                let t = self.not_before(row, t, now.t)?;
                self.bring(i, t, row.time, contact)?;
                self.count_tie(row, t);
                return Ok((region, part));
            }
        }
        Err(ending(row, Cause::NoContact))
    }

    /// Brings sphere `i` to `t` (s), past what it does not touch on the way.
    fn bring(&mut self, i: usize, t: Double, time: f64, with: (Kind, usize)) -> Result<(), Ending> {
        if self.dues.get(&i).is_some_and(|due| due.t < t && !self.at_one_time(due.t, t)) {
            return Err(Ending { time, bodies: Some((with.0, i, with.1)), cause: Cause::OtherOrder });
        }
        let also = if t == self.bodies[i].now.t { Vec::new() } else { self.clear_until(i, t, Some(with))? };
        self.change(i, t, time, with);
        self.bodies[i].met.extend(also);
        Ok(())
    }

    /// The time `t` (s) of a contact of spheres that have moved as they do only since `since` (s), if it is not before
    /// that; the same, where they differ by rounding.
    fn not_before(&self, row: &Contact, t: Double, since: Double) -> Result<Double, Ending> {
        if self.at_one_time(t, since) {
            return Ok(since);
        }
        let open = [Some(row.a), (row.kind == Kind::Pair).then_some(row.b)];
        if open.into_iter().flatten().any(|i| self.bodies[i].open) {
            return Err(ending(row, Cause::Simultaneous));
        }
        if t > since { Ok(t) } else { Err(ending(row, Cause::OtherOrder)) }
    }

    /// Counts an impact of which `exact` alone says that it comes before another one of the same sphere at the same time.
    fn count_tie(&mut self, row: &Contact, t: Double) {
        if row.class != Class::Collide {
            return;
        }
        let (kind, a, b) = row.key();
        let sides = [Some((a, (kind, b))), (kind == Kind::Pair).then_some((b, (kind, a)))];
        let tied = sides.into_iter().flatten().any(|(i, this)| {
            let body = &self.bodies[i];
            let small = -(body.now.v.length() * Double::from(ROUNDING));
            let leans = self.leans.iter().filter(|(one, two)| *one == i || *two == i);
            let leans = leans.map(|&(one, two)| (Kind::Pair, if one == i { two } else { one }));
            body.met.iter().copied().chain(leans).any(|other| {
                other != this
                    && self.touches(i, other, t)
                    && self.parting(i, other, t) < small
                    && !self.commute(&body.now, this, other)
            })
        });
        self.ties += u64::from(tied);
    }

    /// Whether the order of two contacts of a sphere makes no difference: walls at right angles.
    fn commute(&self, now: &Course, one: (Kind, usize), two: (Kind, usize)) -> bool {
        let (Kind::Wall, Kind::Wall) = (one.0, two.0) else { return false };
        let [n, m] = [one.1, two.1].map(|w| self.plates[w].closest(now.x).1.normal(now.x));
        n.dot(m).value().abs() <= AT_EVENT
    }
}
