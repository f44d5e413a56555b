//! What the impact law makes of a contact, and where it has no further event in finite time or none that numbers can
//! resolve: there the contact rests.

use super::detector::Detector;
use super::engine::EventDriven;
use super::impact::{ContactState, HOP, ZENO};
use super::islands::equilibrium::closed_speed;
use crate::physics::contact::{Class, Key, Kind};
use crate::physics::impact_law::classify;
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::wall::touch;

/// Bounces whose hops are lower than this many radii are summed up in closed form.
pub(super) const SMALL_HOP: f64 = 1e-12;

/// Cosine of the angle between two walls up to which an impulse off the one is mostly one off the other: 45°.
const LEVEL: f64 = 0.7;

impl<D: Detector> EventDriven<D> {
    /// What becomes of a contact whose bodies moved on as they do now since `since`, s.
    pub(super) fn class(&mut self, model: &Model, log: &mut Log, meeting: &ContactState, since: f64) -> Class {
        let pressed = meeting.a_n < 0.0;
        if pressed && (self.hops_within_the_clock(meeting) || meeting.hops_within_rounding(-meeting.a_n)) {
            return Class::Rest;
        }
        let hop = meeting.v_n * meeting.v_n / (-2.0 * meeting.a_n);
        let dies_out =
            || self.bounce_series_duration(model, meeting) > 0.0 || self.bounces_undamped(model, meeting.key);
        if pressed && hop <= SMALL_HOP * meeting.reach && dies_out() {
            return Class::Rest;
        }
        let class = classify(meeting.v_n, pressed, &model.law);
        if class == Class::Collide && self.is_held_down(model, meeting) {
            return Class::Rest;
        }
        if class == Class::Collide && self.chatters(model, meeting, since) {
            log.tallies.collapses += 1;
            return Class::Rest;
        }
        // of a chain that collapses elastic contacts are a part too, as long as something in the scene is lossy
        let lossy = model.law.restitution < 1.0 || model.law.wall_restitution < 1.0;
        if class == Class::Collide && lossy && self.collapses(model, meeting) {
            log.tallies.collapses += 1;
            return Class::Rest;
        }
        class
    }

    /// Whether an impact on a wall would lift the sphere off another one that it rests on, nearly level with this one, by
    /// no more than counts as closed there: that rest would take the impulse back, and the same impact would come again.
    fn is_held_down(&self, model: &Model, meeting: &ContactState) -> bool {
        let (kind, i, wall) = meeting.key;
        if kind == Kind::Pair || self.rests.count(i) == 0 {
            return false;
        }
        let kick = (1.0 + model.law.wall_restitution) * -meeting.v_n;
        let body = self.body(model, i);
        let level = |&(kind, _, other): &Key| {
            let cosine = || touch(&model.faces[other], body.x, body.r).normal.dot(meeting.normal);
            kind == Kind::Wall && other != wall && cosine() >= LEVEL
        };
        kick <= closed_speed(&body, ZENO * self.clock_ulp()) && self.rests.of(i).iter().any(level)
    }

    /// Whether bodies pressed together would be apart for no longer than the clock can tell.
    fn hops_within_the_clock(&self, meeting: &ContactState) -> bool {
        meeting.v_n.abs() <= ZENO * -meeting.a_n * self.clock_ulp()
    }

    /// Whether a hop, pressed together, is one that coordinates and clock can tell from none.
    pub(super) fn hops(&self, meeting: &ContactState) -> bool {
        !self.hops_within_the_clock(meeting) && !meeting.hops_within_rounding(-meeting.a_n)
    }

    /// How high a hop may be (m) to be one of a series that is summed up: what coordinates resolve, at least, and out of
    /// an overlap, which hides the rest of the series.
    pub(super) fn small_hop(meeting: &ContactState) -> f64 {
        (SMALL_HOP * meeting.reach).max(HOP * meeting.size()).max(-meeting.gap)
    }

    /// Whether small bounces that the wall itself does not damp, millions a second, are as good as rest: without friction
    /// they slide like what rests, and beside another wall that the sphere touches, the friction there is their end. Not
    /// where nothing at all is lost.
    fn bounces_undamped(&self, model: &Model, (kind, a, b): Key) -> bool {
        let law = &model.law;
        let beside = |wall| {
            touch(&model.faces[wall], self.flight.line(a).x, self.flight.line(a).r).gap
                <= SMALL_HOP * self.flight.line(a).r
        };
        kind == Kind::Wall
            && law.wall_restitution == 1.0
            && !(law.restitution == 1.0 && law.tangential == 1.0)
            && (law.tangential == 1.0
                || self.rests.count(a) > 0
                || (0..model.faces.len()).any(|wall| wall != b && beside(wall)))
    }
}
