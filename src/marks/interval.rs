//! What has happened between two moments: which velocities have changed by more than pulls explain, and which bodies did
//! it.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::bodies::{Bodies, Touch};
use crate::export::Moment;
use crate::physics::Kind;
use crate::physics::contact::Key;

/// Part of a speed below which a change of it is rounding or an integrator's.
const ROUNDING: f64 = 1e-6;

/// Least part of a change of velocity that lies along the normal of the contact that made it.
const ALONG: f64 = 0.3;

/// Part of the momenta exchanged by which those of a pair may differ, to be called one impact.
const BALANCED: f64 = 0.3;

/// A change of velocity and the contact that made it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Kick {
    /// The contact, with its gap and normal at the time of the kick.
    pub(super) touch: Touch,
    /// Time of the kick, s: where the parabolas from before and after come closest.
    pub(super) time: f64,
    /// Approach speed before the kick, m/s.
    pub(super) approach: f64,
    /// Change of the normal speed, m/s.
    pub(super) jump: f64,
    /// Part of the change that lies along the normal.
    pub(super) along: f64,
}

/// Two moments that follow each other.
#[derive(Debug)]
pub(super) struct Interval<'a> {
    bodies: &'a Bodies,
    pub(super) before: &'a Moment,
    pub(super) after: &'a Moment,
    /// Length of the interval, s.
    pub(super) h: f64,
    /// Changes of velocity that pulls do not explain, m/s by sphere.
    pub(super) changes: Vec<DVec3>,
    /// Spheres whose change of velocity is more than rounding.
    pub(super) changed: Vec<usize>,
}

impl<'a> Interval<'a> {
    pub(super) fn new(bodies: &'a Bodies, before: &'a Moment, after: &'a Moment) -> Interval<'a> {
        let h = after.time - before.time;
        let change = |i: usize| after.v[i] - before.v[i] - bodies.pulls[i] * h;
        let changes: Vec<DVec3> = (0..bodies.radii.len()).map(change).collect();
        let speed = |i: usize| before.v[i].length() + after.v[i].length() + bodies.pulls[i].length() * h;
        let is_changed = |i: &usize| changes[*i].length() > ROUNDING * speed(*i);
        let changed = (0..changes.len()).filter(is_changed).collect();
        Interval { bodies, before, after, h, changes, changed }
    }

    /// Where the parabola of sphere `i` from the first moment is after `s` (s), m.
    fn forward(&self, i: usize, s: f64) -> DVec3 {
        self.before.x[i] + (self.before.v[i] + self.bodies.pulls[i] * (0.5 * s)) * s
    }

    /// Where the parabola of sphere `i` back from the second moment is after `s` (s), m.
    fn backward(&self, i: usize, s: f64) -> DVec3 {
        let back = self.h - s;
        self.after.x[i] - (self.after.v[i] - self.bodies.pulls[i] * (0.5 * back)) * back
    }

    /// After which time (s) the parabolas from both moments are closest, for the bodies of `key`.
    fn kink(&self, key: Key) -> f64 {
        let of = |i: usize| self.forward(i, 0.0) - self.backward(i, 0.0);
        let (kind, a, b) = key;
        let apart = if kind == Kind::Pair { of(a) - of(b) } else { of(a) };
        let change = self.bodies.relative(key, &self.changes);
        let at = apart.dot(change) / change.length_squared();
        if at.is_nan() { 0.0 } else { at.clamp(0.0, self.h) }
    }

    /// Where sphere `i` is at the time `t` (s) within, m: on the parabola from before until the kink, then on that to the
    /// next; and how far apart both are there, m, by which the place is uncertain.
    pub(super) fn place(&self, i: usize, t: f64) -> (DVec3, f64) {
        let (s, alone) = (t - self.before.time, (Kind::Wall, i, 0));
        let kink = self.kink(alone);
        let apart = self.forward(i, kink).distance(self.backward(i, kink));
        (if s <= kink { self.forward(i, s) } else { self.backward(i, s) }, apart)
    }

    /// The contact `key` as a kick of its bodies.
    fn kick(&self, key: Key) -> Kick {
        let (kind, a, b) = key;
        let s = self.kink(key);
        let touch = match kind {
            Kind::Wall => self.bodies.at_wall(a, b, self.forward(a, s)),
            Kind::Pair => self.bodies.at_pair([a, b], [a, b].map(|i| self.forward(i, s))),
        };
        let change = self.bodies.relative(key, &self.changes);
        let pull = self.bodies.relative(key, &self.bodies.pulls);
        let v = self.bodies.relative(key, &self.before.v) + pull * s;
        let jump = change.dot(touch.normal);
        let along = jump.abs() / change.length();
        Kick { touch, time: self.before.time + s, approach: -v.dot(touch.normal), jump, along }
    }

    /// Each contact that has changed velocities, the likeliest for each sphere; and the spheres that changed with nothing
    /// near.
    pub(super) fn kicks(&self) -> (Vec<Kick>, Vec<usize>) {
        let mut best: BTreeMap<usize, (f64, Kick)> = BTreeMap::new();
        let mut alone: BTreeSet<usize> = self.changed.iter().copied().collect();
        let mut propose = |i: usize, kick: Kick, is_one: bool| {
            if !self.reaches(&kick) {
                return;
            }
            alone.remove(&i);
            let score = self.score(&kick);
            if is_one && kick.along >= ALONG && best.get(&i).is_none_or(|found| score > found.0) {
                best.insert(i, (score, kick));
            }
        };
        for (place, &a) in self.changed.iter().enumerate() {
            (0..self.bodies.walls()).for_each(|b| propose(a, self.kick((Kind::Wall, a, b)), true));
            for &b in &self.changed[place + 1..] {
                let (kick, balanced) = (self.kick((Kind::Pair, a, b)), self.is_balanced(a, b));
                propose(a, kick, balanced);
                propose(b, kick, balanced);
            }
        }
        let mut kicks: Vec<Kick> = best.into_values().map(|(_, kick)| kick).collect();
        kicks.sort_by_key(|kick| kick.touch.key);
        kicks.dedup_by_key(|kick| kick.touch.key);
        kicks.sort_by(|one, other| one.time.total_cmp(&other.time));
        (kicks, alone.into_iter().collect())
    }

    /// Whether the bodies of a kick can have met.
    fn reaches(&self, kick: &Kick) -> bool {
        let v = self.bodies.relative(kick.touch.key, &self.before.v).length();
        kick.touch.gap <= 0.1 * self.bodies.reach(kick.touch.key) + 0.5 * v * self.h
    }

    fn score(&self, kick: &Kick) -> f64 {
        kick.along - kick.touch.gap.abs() / self.bodies.reach(kick.touch.key)
    }

    fn is_balanced(&self, a: usize, b: usize) -> bool {
        let [p, q] = [a, b].map(|i| self.changes[i] * self.bodies.masses[i]);
        (p + q).length() <= BALANCED * (p.length() + q.length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    #[test]
    fn a_bounce_within_an_interval_is_found_at_its_time() {
        // Down at 4 m/s to the floor in half of 0.1 s, and up at 0.8 of what it then has; by hand, in closed form.
        let bodies = Bodies::of(&scene::open("paper-0").expect("built in").scene);
        let (g, s, h) = (DVec3::NEG_Y * 9.8, 0.05, 0.1);
        let met = DVec3::Y * 0.5;
        let v = DVec3::new(0.0, -4.0 - 9.8 * s, 0.0);
        let before = Moment { x: vec![met - (v - g * s * 0.5) * s], v: vec![v - g * s], ..Moment::default() };
        let after_v = v * -0.8;
        let rest = h - s;
        let x = vec![met + (after_v + g * rest * 0.5) * rest];
        let after = Moment { time: h, line: 0, x, v: vec![after_v + g * rest] };
        let interval = Interval::new(&bodies, &before, &after);
        let (kicks, unexplained) = interval.kicks();
        assert!(kicks.len() == 1 && unexplained.is_empty(), "{kicks:?}");
        let kick = kicks[0];
        assert!((kick.time - s).abs() < 1e-12 && kick.touch.gap.abs() < 1e-12, "{kick:?}");
        assert!((kick.jump / kick.approach - 1.8).abs() < 1e-12, "{kick:?}");
        let (place, apart) = interval.place(0, 0.075);
        assert!(apart < 1e-12 && (place - (met + (after_v + g * 0.0125) * 0.025)).length() < 1e-12, "{place}");
    }
}
