//! What resting contacts carry, for whoever looks: the run itself needs none of it.

use super::*;

/// The support force of a resting contact, and what it has given since the frame began.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Load {
    /// N, along the normal; of a curved rest that of its last settling.
    force: f64,
    /// Since when, s.
    since: f64,
    /// What was given in this frame before that, N s.
    impulse: f64,
}

impl Load {
    /// The impulse of the frame until `time` (s), N s.
    fn given(&self, time: f64) -> f64 {
        self.impulse + self.force * (time - self.since)
    }
}

impl<D: Detector> Exact<D> {
    /// The contacts of an island carry these forces (N) from now on.
    pub(super) fn carry(&mut self, keys: &[Key], forces: &[f64]) {
        let (now, start) = (self.now, self.frame.time);
        for (key, &force) in keys.iter().zip(forces) {
            let Some(held) = self.rests.held.get_mut(key) else { continue };
            held.load.since = held.load.since.max(start);
            held.load = Load { force, since: now, impulse: held.load.given(now) };
        }
    }

    /// The frame is over at `end`, s: adds a row for every rest that goes on, with the impulse that its support has
    /// given in the frame.
    pub(in crate::physics::exact) fn list_rests(&mut self, model: &Model, log: &mut Log, end: f64) {
        let start = self.frame.time;
        for key in self.rests.held.keys().copied().collect::<Vec<Key>>() {
            let Some(held) = self.rests.held.get_mut(&key) else { continue };
            held.load.since = held.load.since.max(start);
            let impulse = held.load.given(end);
            held.load = Load { since: end, impulse: 0.0, ..held.load };
            let begun = |row: &crate::physics::Contact| row.class == Class::Rest && row.key() == key;
            if held.announced && !log.contacts.iter().any(begun) {
                let mut meeting = self.seen(model, key, end);
                meeting.v_n = 0.0;
                log.contacts.push(meeting.row(end, Class::Rest, impulse, 0.0));
            }
        }
    }
}
