//! What a run tells of itself: the contacts and probes of its last frame, its events, its tallies.

use super::approach::Approach;
use super::contact::{Class, Contact, Key, Probe};
use super::state::Tallies;

/// What a method tells of its run; read through [`Simulation`](crate::physics::Simulation).
#[derive(Debug, Clone, Default)]
pub(crate) struct Log {
    /// Every contact of the last frame, in the order in which they were handled.
    pub(crate) contacts: Vec<Contact>,
    /// Trial steps of the last frame's search.
    pub(crate) probes: Vec<Probe>,
    /// How the bodies of the last frame's contacts came together, where that is kept.
    pub(crate) approaches: Vec<Approach>,
    /// Whether approaches are kept.
    pub(crate) explaining: bool,
    /// Collide, rest and release rows not yet taken.
    pub(crate) events: Vec<Contact>,
    /// Whether events are kept.
    pub(crate) recording: bool,
    /// Counted work and outcomes since t = 0.
    pub(crate) tallies: Tallies,
    /// Contacts whose rest has begun and not ended, sorted.
    pub(crate) resting: Vec<Key>,
}

/// Most contacts that a frame lists, a hundred megabytes: a chain of impacts at one instant may have more, which are
/// counted and told as events all the same.
const MOST_ROWS: usize = 1 << 20;

impl Log {
    /// Tells an impact of an event-driven method.
    #[inline(always)]
    pub(crate) fn impact(&mut self, row: Contact) {
        self.tallies.deepest_degree = self.tallies.deepest_degree.max(row.degree);
        self.tell(row);
    }

    /// Tells a row of an event-driven method: as an event, and in the list of the frame's contacts up to a million.
    #[inline(always)]
    pub(crate) fn tell(&mut self, row: Contact) {
        self.event(row);
        if self.contacts.len() < MOST_ROWS {
            self.contacts.push(row);
        }
    }

    /// Counts an event, and keeps it if asked to (what happens at load is kept in any case, up to a million rows: it happens
    /// before a run can be asked to).
    #[inline(always)]
    pub(crate) fn event(&mut self, row: Contact) {
        match row.class {
            Class::Collide => self.tallies.impacts = self.tallies.impacts.saturating_add(row.impacts),
            Class::Rest => self.tallies.rests += 1,
            Class::Release => self.tallies.releases += 1,
            Class::Leave => return,
        }
        if self.recording || self.tallies.frames == 0 && self.events.len() < MOST_ROWS {
            self.events.push(row);
        }
    }

    /// Memory that it takes beside its own size, bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.contacts)
            + size_of_val(&*self.probes)
            + size_of_val(&*self.approaches)
            + size_of_val(&*self.events)
            + size_of_val(&*self.resting)
    }

    /// Compares what rests after a frame, as its contacts (sorted by key) tell, with what rested before: one `rest` row
    /// when a rest begins, one row of `release` when it ends.
    pub(crate) fn follow_rests(&mut self, release: impl Fn(Key) -> Contact) {
        let rests = |c: &&Contact| c.class == Class::Rest;
        if self.resting.is_empty() && !self.contacts.iter().any(|c| rests(&c)) {
            return;
        }
        let now: Vec<Contact> = self.contacts.iter().filter(rests).copied().collect();
        let before = std::mem::replace(&mut self.resting, now.iter().map(Contact::key).collect());
        for row in now.into_iter().filter(|c| before.binary_search(&c.key()).is_err()) {
            self.event(row);
        }
        for gone in before {
            if self.resting.binary_search(&gone).is_err() {
                self.event(release(gone));
            }
        }
    }
}
