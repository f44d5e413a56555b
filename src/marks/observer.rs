//! A trajectory looked at by itself, moment by moment: its impacts, overlaps and energy, and what speaks for a mistake.

use std::collections::BTreeMap;

use glam::DVec3;

use super::bodies::{Bodies, Touch};
use super::interval::{Interval, Kick};
use super::mistake::Evidence;
use crate::export::Moment;
use crate::physics::Kind;
use crate::physics::contact::Key;

/// Impacts that are kept: beyond, the file is still looked at, but its impacts are not compared.
const MOST_IMPACTS: usize = 100_000;

/// Part of an impact that is still one: where a frame spreads it over several rows.
const PART: f64 = 0.05;

/// Part of its reach within which a body touches.
const TOUCHES: f64 = 1e-9;

/// Part of its reach within which a body that was put on a surface lies on it.
const ON_IT: f64 = 1e-7;

/// Part of a change of velocity along the normal from which nothing else has changed it.
const ALIGNED: f64 = 0.98;

/// How far from 1, 2 or ½ the impulse over that of the law may be, as a part.
const CLOSE: f64 = 0.12;

/// An impact as the rows show it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seen {
    pub(super) key: Key,
    /// Time of the impact, s.
    pub(super) time: f64,
    /// Approach speed, m/s.
    pub(super) approach: f64,
}

/// An impact of which the rows may show more.
#[derive(Debug, Clone, Copy)]
struct Open {
    kick: Kick,
    jump: f64,
    /// Whether the bodies had overlapped for a whole interval before.
    late: bool,
    alone: bool,
    /// The interval that showed the last part of the impact.
    last: u64,
}

/// A contact in overlap that is not answered, and since how many intervals.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    intervals: u64,
    behind: bool,
    last: u64,
}

/// The deepest overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deepest {
    /// Intersection degree, dimensionless.
    pub degree: f64,
    /// Time of the row, s.
    pub time: f64,
    /// Sphere and wall, or two spheres.
    pub key: Key,
}

/// What was seen so far.
#[derive(Debug)]
pub(super) struct Observer<'a> {
    bodies: &'a Bodies,
    intervals: u64,
    open: BTreeMap<Key, Open>,
    waiting: BTreeMap<Key, Waiting>,
    pub(super) impacts: Vec<Seen>,
    pub(super) evidence: Evidence,
    pub(super) deepest: Option<Deepest>,
    /// When a velocity first changed that no contact and no pull explains, s, and of which sphere.
    pub(super) unexplained: Option<(f64, usize)>,
    /// Largest momentum that an impact of a pair by itself made or lost, as a part of what it exchanged.
    pub(super) imbalance: f64,
}

impl<'a> Observer<'a> {
    pub(super) fn new(bodies: &'a Bodies) -> Observer<'a> {
        Observer {
            bodies,
            intervals: 0,
            open: BTreeMap::new(),
            waiting: BTreeMap::new(),
            impacts: Vec::new(),
            evidence: Evidence::default(),
            deepest: None,
            unexplained: None,
            imbalance: 0.0,
        }
    }

    /// The contacts of a moment; keeps the deepest of them.
    pub(super) fn touches(&mut self, moment: &Moment) -> Vec<Touch> {
        let near = self.bodies.near(&moment.x, 1e-3);
        for touch in &near {
            let degree = -touch.gap / self.bodies.reach(touch.key);
            if degree > self.deepest.map_or(0.0, |deepest| deepest.degree) {
                self.deepest = Some(Deepest { degree, time: moment.time, key: touch.key });
            }
        }
        near
    }

    /// Looks at what lies between two moments, with the contacts of each.
    pub(super) fn interval(&mut self, interval: &Interval, before: &[Touch], after: &[Touch]) {
        self.intervals += 1;
        let (kicks, unexplained) = interval.kicks();
        if let (None, Some(sphere)) = (self.unexplained, unexplained.first()) {
            self.unexplained = Some((interval.before.time, *sphere));
        }
        for kick in &kicks {
            let alone = !before.iter().any(|touch| {
                let spheres = |(kind, a, b): Key| if kind == Kind::Pair { [a, b] } else { [a, a] };
                touch.key != kick.touch.key && spheres(touch.key).iter().any(|i| spheres(kick.touch.key).contains(i))
            });
            self.kick(interval, kick, alone);
        }
        let bodies = self.bodies;
        let overlaps = |touch: &&Touch| touch.gap < -TOUCHES * bodies.reach(touch.key);
        for touch in before.iter().filter(overlaps) {
            let kick = kicks.iter().find(|kick| kick.touch.key == touch.key);
            if let Some(then) = after.iter().filter(overlaps).find(|then| then.key == touch.key) {
                self.together(interval, [touch, then], kick);
            }
        }
        after.iter().for_each(|touch| self.placed(interval, touch));
        self.passages(interval, before);
        self.close(self.intervals);
    }

    /// The speed below which an approach is not told from what support gives and takes in an interval, m/s.
    pub(super) fn floor(&self, key: Key, h: f64) -> f64 {
        let pull = self.bodies.relative(key, &self.bodies.pulls).length();
        self.bodies.law.rest_speed.max(pull * h)
    }

    fn kick(&mut self, interval: &Interval, kick: &Kick, alone: bool) {
        let (key, now) = (kick.touch.key, self.intervals);
        let law = (1.0 + self.bodies.restitution(key.0)) * kick.approach;
        if let (Kind::Pair, a, b) = key
            && alone
            && kick.along > ALIGNED
        {
            let [p, q] = [a, b].map(|i| interval.changes[i] * self.bodies.masses[i]);
            self.imbalance = self.imbalance.max((p + q).length() / (p.length() + q.length()));
        }
        if let Some(open) = self.open.get_mut(&key).filter(|open| open.last + 1 == now && kick.jump > 0.0) {
            (open.jump, open.last) = (open.jump + kick.jump, now);
            return;
        }
        if kick.approach <= self.floor(key, interval.h) || kick.jump < PART * law {
            return;
        }
        let waited = self.waiting.remove(&key).is_some_and(|waiting| waiting.last + 1 == now && waiting.intervals > 0);
        let deep = -kick.touch.gap > 0.85 * kick.approach * interval.h;
        self.open.insert(key, Open { kick: *kick, jump: kick.jump, late: waited || deep, alone, last: now });
    }

    /// Looks at bodies that overlap at both ends of an interval.
    fn together(&mut self, interval: &Interval, [before, after]: [&Touch; 2], kick: Option<&Kick>) {
        let key = before.key;
        let normal = before.normal;
        let [start, end] = [&interval.before.v, &interval.after.v].map(|v| self.bodies.relative(key, v));
        let (v_n, pull) = (start.dot(normal), self.bodies.relative(key, &self.bodies.pulls));
        let jump = kick.map_or(0.0, |kick| kick.jump);
        if -v_n > self.floor(key, interval.h) {
            let law = (1.0 + self.bodies.restitution(key.0)) * -v_n;
            if jump.abs() < 2.0 * PART * law && end.dot(after.normal) < 0.0 {
                let fresh = Waiting { intervals: 0, behind: before.behind, last: 0 };
                let waiting = self.waiting.entry(key).or_insert(fresh);
                (waiting.intervals, waiting.last) = (waiting.intervals + 1, self.intervals);
            }
            return;
        }
        let lift = -pull.dot(normal) * interval.h;
        let supported = lift > 0.0 && (jump - lift).abs() < 0.2 * lift;
        if key.0 == Kind::Wall && supported {
            let along =
                [start - normal * v_n, end - after.normal * end.dot(after.normal), pull - normal * pull.dot(normal)];
            self.sliding(along, interval.h);
            self.evidence.rests += 1;
            let last = end.dot(after.normal);
            let sinks = v_n < -1e-3 * self.bodies.law.rest_speed && (last - v_n).abs() < 0.05 * v_n.abs();
            self.evidence.sinking += u64::from(sinks);
        }
    }

    /// Looks at a sphere on a wall: the tangential velocities before and after, m/s, and the pull along the wall, m/s².
    fn sliding(&mut self, [start, end, pull]: [DVec3; 3], h: f64) {
        let taken = 1.0 - self.bodies.law.tangential;
        if taken <= 0.0 || start.length() < 0.01 {
            return;
        }
        self.evidence.slides += 1;
        let lost = -(end - start - pull * h).dot(start) / start.length_squared();
        self.evidence.slowed += u64::from(lost > 0.3 * taken);
    }

    /// Counts a sphere that lies on a surface to rounding, whither its velocities do not lead.
    fn placed(&mut self, interval: &Interval, touch: &Touch) {
        let (key, h) = (touch.key, interval.h);
        let reach = self.bodies.reach(key);
        if key.0 != Kind::Wall || touch.gap.abs() > ON_IT * reach {
            return;
        }
        let along = |of: DVec3| of.dot(touch.normal);
        let way = along(interval.after.x[key.1] - interval.before.x[key.1]);
        let fastest = along(interval.before.v[key.1]).max(along(interval.after.v[key.1]));
        let struck = interval.changed.contains(&key.1);
        let bent = if struck { self.bodies.pulls[key.1].length() * h * h } else { 0.0 };
        self.evidence.projected += u64::from(way - fastest * h > 1e-6 * reach + bent);
    }

    fn passages(&mut self, interval: &Interval, before: &[Touch]) {
        for i in 0..self.bodies.radii.len() {
            let Some(wall) = self.bodies.passed(interval.before.x[i], interval.after.x[i]) else { continue };
            let key = (Kind::Wall, i, wall);
            if !before.iter().any(|touch| touch.key == key) {
                self.evidence.passages += 1;
            }
        }
    }

    /// Ends what interval `now` shows no more of.
    fn close(&mut self, now: u64) {
        let (evidence, bodies) = (&mut self.evidence, self.bodies);
        let impacts = &mut self.impacts;
        self.open.retain(|key, open| {
            let goes_on = open.last == now;
            if !goes_on {
                weigh(evidence, open, 1.0 + bodies.restitution(key.0));
                if impacts.len() < MOST_IMPACTS {
                    impacts.push(Seen { key: *key, time: open.kick.time, approach: open.kick.approach });
                }
            }
            goes_on
        });
        self.waiting.retain(|_, waiting| {
            let goes_on = waiting.last == now;
            if !goes_on {
                let count = if waiting.behind { &mut evidence.ignored_behind } else { &mut evidence.ignored };
                *count += 1;
            }
            goes_on
        });
    }

    /// Ends the trajectory.
    pub(super) fn finish(&mut self) {
        self.close(self.intervals + 1);
        self.impacts.sort_by(|one, other| one.time.total_cmp(&other.time));
    }
}

/// Counts what an impact speaks for; `factor` is 1 + e.
fn weigh(evidence: &mut Evidence, open: &Open, factor: f64) {
    let Open { kick, jump, late, alone, .. } = *open;
    let ratio = jump / (factor * kick.approach);
    evidence.answered += 1;
    evidence.answered_behind += u64::from(kick.touch.behind);
    let near = |wanted: f64| (ratio / wanted - 1.0).abs() < CLOSE;
    evidence.late += u64::from(late && near(1.0));
    if kick.touch.key.0 == Kind::Pair && alone && kick.along > ALIGNED {
        evidence.pairs += 1;
        evidence.twice += u64::from(near(2.0));
        evidence.half += u64::from(near(0.5));
    }
}
