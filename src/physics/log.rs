//! What a run tells of itself: the contacts and probes of its last frame, its events, its tallies.

use super::{Class, Contact, Kind, Probe, Tallies};

/// A contact's two bodies: wall before pair, then a, then b.
pub(crate) type Key = (Kind, usize, usize);

/// The key of a contact.
pub(crate) fn key(contact: &Contact) -> Key {
    (contact.kind, contact.a, contact.b)
}

/// Filled by the method, read through the door.
#[derive(Debug, Clone, Default)]
pub(crate) struct Log {
    /// Every contact of the last frame, in the order in which they were handled.
    pub(crate) contacts: Vec<Contact>,
    /// Trial steps of the last frame's search.
    pub(crate) probes: Vec<Probe>,
    /// Collide, rest and release rows not yet taken.
    pub(crate) events: Vec<Contact>,
    /// Whether events are kept.
    pub(crate) recording: bool,
    /// Counted since t = 0.
    pub(crate) tallies: Tallies,
}

impl Log {
    /// Counts an event, and keeps it if asked to (what happens at load is kept in any case: nobody can have asked yet).
    pub(crate) fn event(&mut self, row: Contact) {
        match row.class {
            Class::Collide => self.tallies.impacts += 1,
            Class::Rest => self.tallies.rests += 1,
            Class::Release => self.tallies.releases += 1,
            Class::Leave => return,
        }
        if self.recording || self.tallies.frames == 0 {
            self.events.push(row);
        }
    }
}
