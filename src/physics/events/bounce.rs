//! What the last digits of an impact need: bounces that keep their energy, series of them in closed form, approaches that
//! are but rounding, impulses along normals that are rounded.

use glam::DVec3;

use super::bounce_series::Bounces;
use super::detector::Detector;
use super::engine::EventDriven;
use super::impact::ContactState;
use super::islands::equilibrium::ROUNDING;
use super::trajectories::Trajectory;
use crate::physics::contact::Kind;
use crate::physics::impact_law::along;
use crate::physics::model::Model;
use crate::physics::path::Path;
use crate::physics::wall::{Part, touch};

/// A sphere this many radii from a face has just touched it.
const SMALL_GAP: f64 = 1e-9;

/// How far a sphere that something else holds may be pulled while bounces that are summed up go on, in radii.
const PULLED: f64 = 1e-9;

/// What bounces that were summed up do to the tangential velocity of a sphere when they are over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rub {
    /// What they leave of what was added meanwhile.
    pub(super) keeps: f64,
    /// The tangential velocity that the sphere would have then if nothing else happened, and the one that it gets, m/s.
    pub(super) expected: DVec3,
    pub(super) slip: DVec3,
    /// How much of the acceleration along the face acts until then.
    pub(super) share: f64,
}

impl Rub {
    /// The velocity (m/s) after the bounces on a face with this normal, from the one that it had come to.
    pub(super) fn end(&self, v: DVec3, normal: DVec3) -> DVec3 {
        let across = normal * normal.dot(v);
        across + self.slip + (v - across - self.expected) * self.keeps
    }
}

impl<D: Detector> EventDriven<D> {
    /// A sphere that comes back to the face that it left with v_n = w comes back with −√(w² + 2 a_n (gap − gap then)), by
    /// the gaps as they are stored: the rounding of places by r would otherwise change the energy of the last bounces,
    /// 1e-5 of it each, and the time that they take.
    pub(super) fn restore_bounce_speed(&mut self, model: &Model, before: &Trajectory, meeting: &mut ContactState) {
        let (_, sphere, wall) = meeting.key;
        if !meeting.flat || meeting.v_n >= 0.0 || meeting.a_n >= 0.0 || before.t == self.now {
            return;
        }
        let (then, w) = (touch(&model.faces[wall], before.x, before.r), before.v.dot(meeting.normal));
        let square = w * w + 2.0 * meeting.a_n * (meeting.gap - then.gap);
        let came_from_it = then.part == Part::Face && then.gap.abs() <= SMALL_GAP * before.r;
        if w <= 0.0 || square <= 0.0 || !came_from_it {
            return;
        }
        let v_n = -square.sqrt();
        self.push(sphere, along(meeting.normal, v_n - meeting.v_n));
        meeting.v_n = v_n;
    }

    /// How long the bounces of a contact still last whose next would go `SMALL_HOP` high at most, s: the sum of their
    /// flights, 2 |v_n| (e + e² + … + eᵏ) / g_n, up to the first |v_n| eᵏ that rests. Only where they change nothing but
    /// the height. Over so short a time, edges, corners and other spheres are as good as faces.
    pub(super) fn bounce_series_duration(&self, model: &Model, meeting: &ContactState) -> f64 {
        let (law, wall) = (&model.law, meeting.key.0 == Kind::Wall);
        let e = if wall { law.wall_restitution } else { law.restitution };
        let closed_form = 0.0 < e && e < 1.0 && (!wall || law.tangential == 1.0);
        if !closed_form || meeting.a_n >= 0.0 || -meeting.v_n <= law.rest_speed {
            return 0.0;
        }
        let (speed, press) = (-meeting.v_n, -meeting.a_n);
        let bounces = Bounces { e, tangential: 1.0, speed, press, slip: DVec3::ZERO, pull: DVec3::ZERO };
        bounces.ending(law.rest_speed / speed).after
    }

    /// The bounces on a wall that follow an impact, whose speeds are those of this moment.
    fn bounces(&self, model: &Model, meeting: &ContactState) -> Bounces {
        let path = self.flight.path(meeting.key.1, self.now);
        let along_face = |u: DVec3| u - meeting.normal * meeting.normal.dot(u);
        Bounces {
            e: model.law.wall_restitution,
            tangential: model.law.tangential,
            speed: -meeting.v_n,
            press: -meeting.a_n,
            slip: along_face(path.v),
            pull: along_face(path.a),
        }
    }

    /// Right after an impact on a wall that rubs: if the bounces that follow are too low to be worth a look, the sphere
    /// goes on along the wall with their mean velocity, and will have, when they are over, the velocity that they leave.
    pub(super) fn sum_up(&mut self, model: &Model, meeting: &ContactState) {
        let a = meeting.key.1;
        if !self.leaves_a_series(model, meeting) {
            return;
        }
        let bounces = self.bounces(model, meeting);
        let lone = meeting.flat && self.rests.count(a) == 0;
        // what else holds the sphere decides how it is pulled: that must not matter before the bounces are over
        let (still, pulled) = (Bounces { pull: DVec3::ZERO, ..bounces }, bounces.pull.length());
        let ending = if lone { bounces } else { still }.ending(model.law.rest_speed / -meeting.v_n);
        if !lone && 0.5 * pulled * ending.after * ending.after > PULLED * meeting.reach {
            return;
        }
        let share = if lone { bounces.share_of_pull() } else { 1.0 };
        let change = bounces.pull * (share * ending.after);
        let mean = ending.way / ending.after - if lone { change * 0.5 } else { DVec3::ZERO };
        if !mean.is_finite() {
            // the whole series is over before anything moves
            return;
        }
        let line = *self.flight.line(a);
        self.flight.rewrite(a, self.now, line.x, mean);
        let rub = Rub { keeps: ending.keeps, expected: mean + change, slip: ending.slip, share };
        let until = self.now + ending.after;
        self.rests.add(model, &self.flight, self.now, &ContactState { v_n: 0.0, ..*meeting }, until);
        self.rests.rub(meeting.key, rub);
    }

    /// Whether an impact on a wall that rubs, no rounding itself, is followed by bounces that only sums tell apart.
    fn leaves_a_series(&self, model: &Model, meeting: &ContactState) -> bool {
        let (law, e) = (&model.law, model.law.wall_restitution);
        let series = meeting.key.0 == Kind::Wall && meeting.a_n < 0.0 && 0.0 < e && e < 1.0 && law.tangential < 1.0;
        let hop = meeting.v_n * meeting.v_n / (-2.0 * meeting.a_n);
        series && e * -meeting.v_n > law.rest_speed && e * e * hop <= Self::small_hop(meeting) && self.hops(meeting)
    }

    /// Whether a contact approaches by no more than rounding, while it is about to open by far more than that.
    pub(super) fn is_rounding_approach(&self, meeting: &ContactState) -> bool {
        let (kind, a, b) = meeting.key;
        let path = |i: usize| self.flight.path(i, self.now);
        let size = |of: fn(&Path) -> DVec3| {
            of(&path(a)).length() + if kind == Kind::Pair { of(&path(b)).length() } else { 0.0 }
        };
        meeting.v_n >= -8.0 * f64::EPSILON * size(|path| path.v) && meeting.a_n > ROUNDING * size(|path| path.a)
    }

    /// Turns an approach by rounding round, without loss: were it stopped, in a crowd the next contact would approach by
    /// rounding, and then again this one, for ever. So it is handed on like a blow in a cradle, until it has gone.
    pub(super) fn reflect_rounding_approach(&mut self, model: &Model, meeting: &ContactState) {
        let (kind, a, b) = meeting.key;
        let change = -meeting.v_n + self.min_separation_speed(meeting).max(-meeting.v_n);
        if kind == Kind::Wall {
            self.push(a, meeting.normal * change);
        } else {
            let push = meeting.normal * (change / (model.inverse_masses[a] + model.inverse_masses[b]));
            self.push(a, push * model.inverse_masses[a]);
            self.push(b, push * -model.inverse_masses[b]);
        }
        self.ensure_separating(model, meeting.key, 0.0);
    }

    /// Slowest v_n (m/s) at which a contact that lets go has left: rounding, and enough that what still presses, where
    /// the sphere is about to pass over an edge, brings it back no sooner than the clock can tell.
    pub(super) fn min_separation_speed(&self, meeting: &ContactState) -> f64 {
        let path = self.flight.path(meeting.key.1, self.now);
        let pressing = (-meeting.normal.dot(path.a)).max(0.0);
        f64::EPSILON * path.v.length() + self.clock_ulp() * pressing
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_along_a_rounded_normal_is_made_to_far_below_an_ulp() {
        // Normals of one direction, off by more than rounding ever is: n·(n change / n²) is the change in both.
        let n = DVec3::new(2.0, 3.0, 6.0) / 7.0;
        for size in [1.0, 1.0 + 1e-12, 1.0 - 1e-12] {
            let change = (n * size).dot(along(n * size, 3.0));
            // Five products and sums of numbers under 3 round.
            assert!((change - 3.0).abs() <= 8.0 * f64::EPSILON, "{size}: {change}");
        }
    }
}
