//! A contact happens: the impact law acts, or a rest may begin.

use super::changed::Changed;
use super::contact_state::ContactState;
use super::mechanics::Mechanics;
use super::rest_criteria::Verdict;
use super::rest_reason::RestReason;
use crate::physics::contact::{Class, Key, Kind};
use crate::physics::impact_law::{along, pair_push, separation_speed};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::state::Stall;

impl Mechanics {
    /// Handles two bodies that touch while they approach, or are pressed together: an impact, or a rest that may begin.
    /// Returns the spheres whose motion that has changed.
    pub(super) fn meet(&mut self, model: &Model, log: &mut Log, key: Key) -> Result<Changed, Stall> {
        if self.leave_hops(model, log, key) {
            return Ok(Changed::of(key));
        }
        if let Some(changed) = self.meet_covered(model, log, key) {
            return changed;
        }
        let interrupted = self.interrupt_series(model, log, key);
        match self.met(model, log, key)? {
            Changed::Nothing if interrupted => Ok(Changed::of(key)),
            changed => Ok(changed),
        }
    }

    fn met(&mut self, model: &Model, log: &mut Log, key: Key) -> Result<Changed, Stall> {
        let before = *self.trajectories.trajectory(key.1);
        let since = if key.0 == Kind::Pair { before.t.max(self.trajectories.trajectory(key.2).t) } else { before.t };
        let mut contact = self.advanced_contact(model, key);
        self.trajectories.restore_bounce_speed(model, &before, &mut contact);
        if self.is_squeezed(model, &contact, since) {
            return Ok(Changed::Nothing);
        }
        match self.verdict(model, log, &contact, since) {
            Verdict::Collide => self.collide(model, log, &contact, since),
            // an island that takes that back brings it again: the two are solved together then
            Verdict::Rest(_)
                if self.trajectories.is_rounding_approach(&contact) && !self.impacts.instant.is_stuck(key) =>
            {
                self.reflect_rounding_approach(model, &contact);
                self.break_rests(model, log, key)
            }
            Verdict::Rest(reason) => {
                // what was struck at this instant already comes back by other contacts: that is no bounce of a series
                let now = self.trajectories.now;
                let until = if since < now { now + contact.bounce_series_duration(model) } else { now };
                self.rests.add(model, &self.trajectories, &contact, reason, until);
                Ok(Changed::Nothing)
            }
            Verdict::Leave => {
                let least = self.trajectories.min_separation_speed(&contact);
                let pushed = contact.a_n >= 0.0 && self.ensure_separating(model, key, least);
                // what a body is pushed into, if it rests on that, sees no approach; an island that pushes back again and again
                // by rounding is left alone
                let rests = |i: usize| self.rests.count(i) > 0;
                let pressed = pushed && key.0 == Kind::Pair && (rests(key.1) || rests(key.2));
                if pressed && !self.impacts.instant.is_stuck(key) {
                    self.break_rests(model, log, key)
                } else {
                    Ok(Changed::Nothing)
                }
            }
        }
    }

    /// Gives both bodies of an impact their impulse. Returns the spheres whose motion that has changed.
    fn collide(&mut self, model: &Model, log: &mut Log, contact: &ContactState, since: f64) -> Result<Changed, Stall> {
        let (kind, a, b) = contact.key;
        let trajectories = &mut self.trajectories;
        let target = separation_speed(contact.v_n, Class::Collide, kind, &model.law);
        let change = target - contact.v_n;
        let impulse = match kind {
            Kind::Wall => {
                let v = trajectories.trajectory(a).v;
                let slip = (v - contact.normal * contact.v_n) * (model.law.tangential - 1.0);
                trajectories.push(a, along(contact.normal, change) + slip);
                change * model.masses[a]
            }
            Kind::Pair => {
                let (one, two) = (*trajectories.trajectory(a), *trajectories.trajectory(b));
                let (arm, w) = (one.x - two.x, one.v - two.v);
                let (share_a, share_b) = (trajectories.inverse_mass(a), trajectories.inverse_mass(b));
                let share = share_a + share_b;
                let push = pair_push(arm, w, share, model.law.restitution);
                trajectories.push(a, push * share_a);
                trajectories.push(b, push * -share_b);
                change / share
            }
        };
        self.ensure_separating(model, contact.key, 0.0);
        let row = contact.row(self.trajectories.now, Class::Collide, impulse, target);
        log.impact(row);
        self.impacts.instant.count_impact(&self.trajectories, contact);
        self.impacts.last.note(contact.key, self.trajectories.now);
        self.trajectories.to_and_fro = self.impacts.last.go_to_and_fro();
        let changed = self.break_rests(model, log, contact.key)?;
        if target == 0.0 && contact.a_n < 0.0 {
            // from an ulp above the face it would take √(2 ulp/g) to fall
            let stopped = ContactState { v_n: 0.0, ..*contact };
            self.rests.add(model, &self.trajectories, &stopped, RestReason::Stopped, self.trajectories.now);
        }
        self.sum_up(model, contact);
        if self.impacts.last.are_many()
            && let Some(spheres) = self.skip_rounds(model, log)
        {
            spheres.iter().try_for_each(|&i| self.trajectories.check_range(i))?;
            return Ok(Changed::Spheres(spheres));
        }
        self.take_hops(model, contact, since);
        Ok(changed)
    }

    /// Ends the rests that the new velocities of a contact's bodies break, and makes stale what others planned with these
    /// bodies.
    fn break_rests(&mut self, model: &Model, log: &mut Log, key: Key) -> Result<Changed, Stall> {
        let changed = Changed::of(key);
        for &i in changed.spheres() {
            self.trajectories.check_range(i)?;
            self.trajectories.mark_changed(i);
            self.disturb(model, log, i);
        }
        Ok(changed)
    }
}
