//! Whether a contact rests: the test of every [`RestReason`] that an approach can have, in order.
//!
//! A contact rests where it has no further event in finite time, or none that numbers can resolve. What rests is tried by
//! its island at once (`islands`): a contact that nothing presses lets go again.

use super::contact_state::ContactState;
use super::curved::bodies::Body;
use super::islands::equilibrium::{closed_speed, hop_speed, lowest_hop};
use super::mechanics::Mechanics;
use super::rest_reason::RestReason;
use super::rounding::{CLOCK_ULPS, LEVEL, SUMMED_HOP};
use crate::physics::contact::{Class, Key, Kind};
use crate::physics::impact_law::{classify, is_lossless};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::wall::touch;

/// What becomes of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Verdict {
    /// The bodies do not approach: nothing to do.
    Leave,
    /// An impact.
    Collide,
    /// The contact rests, if its island agrees.
    Rest(RestReason),
}

impl Mechanics {
    /// What becomes of a contact whose bodies have moved as they do now since `since`, s.
    pub(super) fn verdict(&mut self, model: &Model, log: &mut Log, contact: &ContactState, since: f64) -> Verdict {
        if let Some(reason) = self.is_unresolved(model, contact) {
            return Verdict::Rest(reason);
        }
        if contact.turns_within_the_clock(self.trajectories.clock_ulp()) {
            // an impact that a rest beside it takes back would come again and again, softer, until nothing is left of it
            return Verdict::Leave;
        }
        // what rests on something else would be lifted off it, unseen
        let rubs = model.law.tangential < 1.0 && self.rests.count(contact.key.1) == 0;
        if contact.a_n >= 0.0 && self.trajectories.grazes(model, contact, since, rubs) {
            // an impact would take nothing along the normal, and of a wall that rubs a share of what slides along it; what the
            // wall opposite sends back at this instant again and again is held by both
            let held = self.impacts.instant.is_stuck(contact.key);
            return if held { Verdict::Rest(RestReason::Squeezed) } else { Verdict::Leave };
        }
        let rests = |i: usize| self.rests.count(i) > 0;
        if contact.key.0 == Kind::Pair
            && contact.a_n >= 0.0
            && (rests(contact.key.1) || rests(contact.key.2))
            && self.trajectories.brushes(contact)
        {
            // what a body is driven into by that, because it rests on it, would drive it back: the same impact for ever
            return Verdict::Leave;
        }
        match classify(contact.v_n, contact.a_n < 0.0, &model.law) {
            Class::Collide => {}
            Class::Rest => return Verdict::Rest(RestReason::Slow),
            Class::Leave | Class::Release => return Verdict::Leave,
        }
        if self.is_held_down(model, contact) {
            return Verdict::Rest(RestReason::HeldDown);
        }
        let Mechanics { trajectories, rests, impacts } = self;
        if impacts.chatter.is_endless(model, (trajectories, rests), contact, since) {
            log.tallies.collapses += 1;
            return Verdict::Rest(RestReason::Chatter);
        }
        // of a chain that collapses elastic contacts are a part too, as long as something in the scene is lossy
        if !is_lossless(&model.law) && impacts.instant.collapses(model, trajectories, contact) {
            log.tallies.collapses += 1;
            return Verdict::Rest(RestReason::Collapse);
        }
        Verdict::Collide
    }

    /// Why a contact that is pressed has no event left that is worth one, if that is so.
    fn is_unresolved(&self, model: &Model, contact: &ContactState) -> Option<RestReason> {
        if contact.a_n >= 0.0 || contact.a_n.is_nan() {
            return None;
        }
        if contact.hops_within_the_clock(self.trajectories.clock_ulp()) {
            return Some(RestReason::WithinClock);
        }
        if contact.hops_within_rounding(-contact.a_n) {
            return Some(RestReason::WithinCoordinates);
        }
        let hop = contact.v_n * contact.v_n / (-2.0 * contact.a_n);
        if hop <= SUMMED_HOP * contact.reach {
            if contact.bounce_series_duration(model) > 0.0 {
                return Some(RestReason::SeriesSummed);
            }
            if self.bounces_undamped(model, contact.key) {
                return Some(RestReason::Undamped);
            }
        }
        None
    }

    /// Whether an impact on a wall would lift the sphere off another one that it rests on, nearly level with this one, by
    /// no more than counts as closed there: that rest would take the impulse back, and the same impact would come again.
    #[inline(never)]
    fn is_held_down(&self, model: &Model, contact: &ContactState) -> bool {
        let (kind, i, wall) = contact.key;
        if kind == Kind::Pair || self.rests.count(i) == 0 {
            return false;
        }
        let kick = (1.0 + model.law.wall_restitution) * -contact.v_n;
        let body = Body::of(model, &self.trajectories, i);
        let slack = closed_speed(&body, CLOCK_ULPS * self.trajectories.clock_ulp());
        let holds = |&key: &Key| {
            let (kind, _, other) = key;
            if kind == Kind::Pair || other == wall {
                return false;
            }
            let cosine = touch(&model.faces[other], body.x, body.r).normal.dot(contact.normal);
            let hop = hop_speed(self.rests.pressure(model, key), lowest_hop(model) * body.r);
            cosine >= LEVEL && kick * cosine <= slack.max(hop)
        };
        self.rests.of(i).iter().any(holds)
    }

    /// Whether small bounces that the wall itself does not damp, millions a second, are as good as rest: without friction
    /// they slide like what rests, and beside another wall that the sphere touches, the friction there is their end. Not
    /// where nothing at all is lost.
    #[inline(never)]
    fn bounces_undamped(&self, model: &Model, (kind, a, b): Key) -> bool {
        let (law, line) = (&model.law, self.trajectories.trajectory(a));
        let beside = |wall: usize| touch(&model.faces[wall], line.x, line.r).gap <= SUMMED_HOP * line.r;
        kind == Kind::Wall
            && law.wall_restitution == 1.0
            && !(law.restitution == 1.0 && law.tangential == 1.0)
            && (law.tangential == 1.0
                || self.rests.count(a) > 0
                || (0..model.faces.len()).any(|wall| wall != b && beside(wall)))
    }
}
