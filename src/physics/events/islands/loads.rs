//! What resting contacts carry: told at the end of a frame, and what tells a blow from rounding.

use super::resting::{Load, RestingContact, Rests};
use crate::physics::contact::{Class, Contact, Key, Kind};
use crate::physics::events::contact_state::ContactState;
use crate::physics::events::rounding::APART;
use crate::physics::events::trajectories::Trajectories;
use crate::physics::log::Log;
use crate::physics::model::Model;

impl Rests {
    /// Begins a frame at `time`, s: loads are counted from then on.
    #[inline]
    pub(crate) fn begin_frame(&mut self, time: f64) {
        self.frame_start = time;
        // a walk through an empty map costs a gas more than this question
        if !self.held.is_empty() {
            self.begin_loads(time);
        }
    }

    fn begin_loads(&mut self, time: f64) {
        for held in self.held.values_mut() {
            held.load = Load { since: time, impulse: 0.0, ..held.load };
        }
    }

    /// Lets the contacts of an island carry these forces (N) from `now` (s) on.
    pub(super) fn carry(&mut self, keys: &[Key], forces: &[f64], now: f64) {
        for (key, &force) in keys.iter().zip(forces) {
            let frame_start = self.frame_start;
            let held = self.kept_mut(*key);
            held.load.since = held.load.since.max(frame_start);
            held.load = Load { force, since: now, impulse: held.load.given(now) };
        }
    }

    /// Relative acceleration that the load of a resting contact gives its two bodies, m/s²: with it they fall back together
    /// after a hop.
    pub(crate) fn pressure(&self, model: &Model, key: Key) -> f64 {
        let other = if key.0 == Kind::Pair { model.inverse_masses[key.2] } else { 0.0 };
        let force = self.held.get(&key).map_or(0.0, |held| held.load.force);
        force * (model.inverse_masses[key.1] + other)
    }

    /// Energy (J) at `time` (s) of bounces that are summed up: the state shows their mean velocity.
    #[inline(always)]
    pub(crate) fn hidden_energy(&self, model: &Model, trajectories: &Trajectories, time: f64) -> f64 {
        // only bounces that rub are summed up so that the state hides some
        if model.law.tangential == 1.0 { 0.0 } else { self.energy_of_sums(model, trajectories, time) }
    }

    /// Energy (J) at `time` (s) of bounces on walls that rub, as far as they are summed up.
    fn energy_of_sums(&self, model: &Model, trajectories: &Trajectories, time: f64) -> f64 {
        let of = |(&key, held): (&Key, &RestingContact)| {
            let rub = held.rub.filter(|rub| rub.has_begun(time) && held.settles_at > time)?;
            let (v, normal) =
                (trajectories.path(key.1, time).v, trajectories.contact_geometry(model, key, time).normal);
            Some(model.masses[key.1] * rub.hidden_energy(v, normal, time, model.acceleration(key.1)))
        };
        self.held.iter().filter_map(of).sum()
    }

    /// Adds a row for every rest that goes on as the frame ended at `end`, s, with the impulse that its support has given in
    /// the frame.
    pub(crate) fn list(&self, model: &Model, trajectories: &Trajectories, log: &mut Log, end: f64) {
        let met = log.contacts.len();
        for (&key, held) in self.held.iter().filter(|(_, held)| held.announced) {
            let impulse = Load { since: held.load.since.max(self.frame_start), ..held.load }.given(end);
            let shown = trajectories.contact_geometry(model, key, end);
            // what has come apart since it carried anything, or does so, is held for the solver's sake alone
            let touches = held.load.force > 0.0 || shown.gap <= APART * shown.reach && !leaves(model, &shown);
            let begun = |row: &Contact| row.class == Class::Rest && row.key() == key;
            if touches && (impulse > 0.0 || !log.contacts[..met].iter().any(begun)) {
                let row = shown.row(end, Class::Rest, impulse, 0.0);
                log.contacts.push(Contact { approach_speed: 0.0, ..row });
            }
        }
    }
}

/// Whether bodies open faster than what pulls them gives them over the gap that a contact may have.
fn leaves(model: &Model, shown: &ContactState) -> bool {
    let (kind, a, b) = shown.key;
    let pull = |i: usize| model.acceleration(i).length();
    let both = pull(a) + if kind == Kind::Pair { pull(b) } else { 0.0 };
    let v_n = shown.normal.dot(shown.velocity);
    v_n > 0.0 && v_n * v_n > 2.0 * both * APART * shown.reach
}
