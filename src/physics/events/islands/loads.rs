//! What resting contacts carry: for whoever looks, and to tell a blow from rounding.

use super::resting::{Load, Rests};
use crate::physics::contact::{Class, Key, Kind};
use crate::physics::events::detector::Detector;
use crate::physics::events::engine::EventDriven;
use crate::physics::log::Log;
use crate::physics::model::Model;

impl Rests {
    /// A frame begins at `time`, s.
    pub(crate) fn begin_frame(&mut self, time: f64) {
        for held in self.held.values_mut() {
            held.load = Load { since: time, impulse: 0.0, ..held.load };
        }
    }
}

impl<D: Detector> EventDriven<D> {
    /// The contacts of an island carry these forces (N) from now on.
    pub(crate) fn carry(&mut self, keys: &[Key], forces: &[f64]) {
        let (now, start) = (self.now, self.frame.time);
        for (key, &force) in keys.iter().zip(forces) {
            let Some(held) = self.rests.held.get_mut(key) else { continue };
            held.load.since = held.load.since.max(start);
            held.load = Load { force, since: now, impulse: held.load.given(now) };
        }
    }

    /// What the load of a resting contact does to its two bodies, m/s²: with it they fall back together after a hop.
    pub(crate) fn pressure(&self, model: &Model, key: Key) -> f64 {
        let other = if key.0 == Kind::Pair { model.inverse_masses[key.2] } else { 0.0 };
        let force = self.rests.held.get(&key).map_or(0.0, |held| held.load.force);
        force * (model.inverse_masses[key.1] + other)
    }

    /// The frame is over at `end`, s: adds a row for every rest that goes on, with the impulse that its support has
    /// given in the frame.
    pub(crate) fn list_rests(&mut self, model: &Model, log: &mut Log, end: f64) {
        let (start, met) = (self.frame.time, log.contacts.len());
        for (&key, held) in &self.rests.held {
            let impulse = Load { since: held.load.since.max(start), ..held.load }.given(end);
            let begun = |row: &crate::physics::Contact| row.class == Class::Rest && row.key() == key;
            if held.announced && (impulse > 0.0 || !log.contacts[..met].iter().any(begun)) {
                let row = self.contact_geometry(model, key, end).row(end, Class::Rest, impulse, 0.0);
                log.contacts.push(crate::physics::Contact { approach_speed: 0.0, ..row });
            }
        }
        self.rests.begin_frame(end);
    }
}
