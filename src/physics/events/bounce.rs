//! Corrections at the level of rounding: a bounce keeps its energy; a series of bounces is summed up; an approach by
//! rounding is turned round; a contact that lets go parts.

use glam::DVec3;

use super::bounce_series::Bounces;
use super::contact_state::ContactState;
use super::mechanics::Mechanics;
use super::record::Trajectory;
use super::rest_reason::RestReason;
use super::rounding::{BRUSH, HOP, PULLED, SUM, TOUCHED_GAP};
use super::rub::Rub;
use super::trajectories::Trajectories;
use crate::physics::contact::Kind;
use crate::physics::impact_law::along;
use crate::physics::model::Model;
use crate::physics::overlap::touching;
use crate::physics::path::Path;
use crate::physics::wall::{Face, Part, edge_direction, touch};

impl ContactState {
    /// How long the bounces of a contact still last, s, whose next would go [`SUMMED_HOP`](super::rounding::SUMMED_HOP)
    /// high at most: the sum of their flights, 2 |v_n| (e + e² + … + eᵏ) / g_n, up to the first |v_n| eᵏ that rests; 0
    /// where they would change more than the height. Over so short a time, edges, corners and other spheres are as good as
    /// faces.
    pub(crate) fn bounce_series_duration(&self, model: &Model) -> f64 {
        let (law, wall) = (&model.law, self.key.0 == Kind::Wall);
        let e = if wall { law.wall_restitution } else { law.restitution };
        let closed_form = 0.0 < e && e < 1.0 && (!wall || law.tangential == 1.0);
        if !closed_form || self.a_n >= 0.0 || -self.v_n <= law.rest_speed {
            return 0.0;
        }
        let (speed, press) = (-self.v_n, -self.a_n);
        if speed * speed > 2.0 * press * self.small_hop() {
            // what rests for another reason, hardly pressed at the border of an edge, may have higher ones before it
            return 0.0;
        }
        let bounces = Bounces { e, tangential: 1.0, speed, press, slip: DVec3::ZERO, pull: DVec3::ZERO };
        bounces.ending(law.rest_speed / speed).after
    }
}

impl Trajectories {
    /// A sphere that comes back to the face that it left with v_n = w comes back with −√(w² + 2 a_n (gap − gap then)), by
    /// the gaps as they are stored: the rounding of places by r would otherwise change the energy of the last bounces,
    /// 1e-5 of it each, and the time that they take.
    pub(crate) fn restore_bounce_speed(&mut self, model: &Model, before: &Trajectory, contact: &mut ContactState) {
        let (_, sphere, wall) = contact.key;
        if !contact.flat || contact.v_n >= 0.0 || contact.a_n >= 0.0 || before.t == self.now {
            return;
        }
        let (then, w) = (touch(&model.faces[wall], before.x, before.r), before.v.dot(contact.normal));
        let square = w * w + 2.0 * contact.a_n * (contact.gap - then.gap);
        let came_from_it = then.part == Part::Face && then.gap.abs() <= TOUCHED_GAP * before.r;
        if w <= 0.0 || square <= 0.0 || !came_from_it {
            return;
        }
        let v_n = -square.sqrt();
        self.push(sphere, along(contact.normal, v_n - contact.v_n));
        contact.v_n = v_n;
    }

    /// The bounces on a wall that follow an impact, whose speeds are those of this moment.
    fn bounces(&self, model: &Model, contact: &ContactState) -> Bounces {
        let path = self.path(contact.key.1, self.now);
        let along_face = |u: DVec3| u - contact.normal * contact.normal.dot(u);
        Bounces {
            e: model.law.wall_restitution,
            tangential: model.law.tangential,
            speed: -contact.v_n,
            press: -contact.a_n,
            slip: along_face(path.v),
            pull: along_face(path.a),
        }
    }

    /// Whether a sphere moves along a wall and approaches it by no more than rounding of its speed; of its place too, which
    /// turns the normal of what has struck it, if it has moved so only since `since` (s) and has not left its place. If an
    /// impact `rubs`, it takes a share of the speed however slow the approach: that must not hang on the last bit of a place.
    pub(super) fn grazes(&self, model: &Model, contact: &ContactState, since: f64, rubs: bool) -> bool {
        let (kind, a, wall) = contact.key;
        if kind == Kind::Pair {
            return false;
        }
        let (line, size) = (self.trajectory(a), contact.size());
        let speed = line.v.length();
        let struck_here = speed * (self.now - since) <= touching(contact.reach, size);
        let turned = if struck_here { HOP * size / contact.reach } else { 0.0 };
        // an edge or a corner that it would pass with an overlap of no more than coordinates can tell may as well be missed
        let missed = || (2.0 * HOP * size / contact.reach).sqrt() * across(&model.faces[wall], line).length();
        let missed = if rubs && !contact.flat { missed() } else { 0.0 };
        contact.v_n >= -(BRUSH + turned) * speed - missed
    }

    /// Whether a contact approaches by no more than rounding of its bodies' speeds.
    pub(super) fn brushes(&self, contact: &ContactState) -> bool {
        contact.v_n >= -BRUSH * self.sum_of(contact, |path| path.v)
    }

    /// Whether a contact approaches by no more than rounding, while it is about to open by far more than that.
    pub(crate) fn is_rounding_approach(&self, contact: &ContactState) -> bool {
        self.brushes(contact) && contact.a_n > SUM * self.sum_of(contact, |path| path.a)
    }

    /// Sum of the lengths of a vector of both bodies of a contact.
    fn sum_of(&self, contact: &ContactState, of: fn(&Path) -> DVec3) -> f64 {
        let (kind, a, b) = contact.key;
        let length = |i: usize| of(&self.path(i, self.now)).length();
        length(a) + if kind == Kind::Pair { length(b) } else { 0.0 }
    }

    /// Slowest v_n (m/s) at which a contact that lets go has left: rounding, and enough that what still presses, where
    /// the sphere is about to pass over an edge, brings it back no sooner than the clock can tell.
    pub(crate) fn min_separation_speed(&self, contact: &ContactState) -> f64 {
        let path = self.path(contact.key.1, self.now);
        let pressing = (-contact.normal.dot(path.a)).max(0.0);
        f64::EPSILON * path.v.length() + self.clock_ulp() * pressing
    }
}

impl Mechanics {
    /// Right after an impact on a wall that rubs: if the bounces that follow are too low to be worth a look, the sphere
    /// goes on along the wall with their mean velocity, and will have, when they are over, the velocity that they leave.
    #[inline]
    pub(crate) fn sum_up(&mut self, model: &Model, contact: &ContactState) {
        if self.leaves_a_series(model, contact) {
            self.sum_up_series(model, contact);
        }
    }

    #[cold]
    #[inline(never)]
    fn sum_up_series(&mut self, model: &Model, contact: &ContactState) {
        let a = contact.key.1;
        let bounces = self.trajectories.bounces(model, contact);
        let lone = contact.flat && self.rests.count(a) == 0;
        // what else holds the sphere decides how it is pulled: that must not matter before the bounces are over
        let (still, pulled) = (Bounces { pull: DVec3::ZERO, ..bounces }, bounces.pull.length());
        let summed = if lone { bounces } else { still };
        let ending = summed.ending(model.law.rest_speed / -contact.v_n);
        if !lone && 0.5 * pulled * ending.after * ending.after > PULLED * contact.reach {
            return;
        }
        let share = if lone { bounces.share_of_pull() } else { 1.0 };
        let change = bounces.pull * (share * ending.after);
        let mean = ending.way / ending.after - if lone { change * 0.5 } else { DVec3::ZERO };
        if !mean.is_finite() {
            // the whole series is over before anything moves
            return;
        }
        let line = *self.trajectories.trajectory(a);
        self.trajectories.rewrite(a, line.x, mean);
        let rub = Rub::new(summed, ending, self.trajectories.now, mean, (bounces.pull, share));
        let until = self.trajectories.now + ending.after;
        self.rests.add(
            model,
            &self.trajectories,
            &ContactState { v_n: 0.0, ..*contact },
            RestReason::SeriesSummed,
            until,
        );
        self.rests.rub(contact.key, rub);
    }

    /// Whether an impact on a wall that rubs, no rounding itself, is followed by bounces that only sums tell apart.
    fn leaves_a_series(&self, model: &Model, contact: &ContactState) -> bool {
        let (law, e) = (&model.law, model.law.wall_restitution);
        let series = contact.key.0 == Kind::Wall && contact.a_n < 0.0 && 0.0 < e && e < 1.0 && law.tangential < 1.0;
        let hop = contact.v_n * contact.v_n / (-2.0 * contact.a_n);
        series
            && e * -contact.v_n > law.rest_speed
            && e * e * hop <= contact.small_hop()
            && !contact.hops_within_the_clock(self.trajectories.clock_ulp())
            && !contact.hops_within_rounding(-contact.a_n)
    }

    /// Turns an approach by rounding round, without loss: were it stopped, in a crowd the next contact would approach by
    /// rounding, and then again this one, for ever. So it is handed on like a blow in a cradle, until it has gone.
    #[cold]
    #[inline(never)]
    pub(crate) fn reflect_rounding_approach(&mut self, model: &Model, contact: &ContactState) {
        let (kind, a, b) = contact.key;
        let change = -contact.v_n + self.trajectories.min_separation_speed(contact).max(-contact.v_n);
        if kind == Kind::Wall {
            self.trajectories.push(a, contact.normal * change);
        } else {
            let push = contact.normal * (change / (model.inverse_masses[a] + model.inverse_masses[b]));
            self.trajectories.push(a, push * model.inverse_masses[a]);
            self.trajectories.push(b, push * -model.inverse_masses[b]);
        }
        self.ensure_separating(model, contact.key, 0.0);
    }
}

/// Velocity of a sphere without its part along the edge of a wall that is closest to it, m/s.
fn across(face: &Face, line: &Trajectory) -> DVec3 {
    let Part::Edge(k) = touch(face, line.x, line.r).part else { return line.v };
    let along = edge_direction(face, k);
    line.v - along * along.dot(line.v)
}
