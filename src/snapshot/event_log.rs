//! What has happened in a run from its start on, in a list that holds so many and no more.

use std::{collections::VecDeque, sync::Arc};

use crate::physics::{Class, Contact, Kind};

/// Events of one piece of the list: a copy that is shared is copied piece by piece, and only the last one ever.
const PIECE: usize = 1024;

/// An event as the list keeps it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Logged {
    /// Time of the event, s.
    pub time: f64,
    /// Approach speed −v_n before the response, m/s.
    pub approach_speed: f64,
    /// Separation speed v_n after the response, m/s.
    pub separation_speed: f64,
    /// Normal impulse on `a`, N s.
    pub impulse: f64,
    /// The sphere; of a pair the lower index.
    pub a: u32,
    /// The wall, or the pair's higher index.
    pub b: u32,
    /// Whether a sphere touches a wall or another sphere.
    pub kind: Kind,
    /// An impact, the begin of a rest, or its end.
    pub class: Class,
}

impl Logged {
    fn of(event: &Contact) -> Logged {
        // a scene has a million bodies at most
        let index = |index: usize| u32::try_from(index).unwrap_or(u32::MAX);
        Logged {
            time: event.time,
            approach_speed: event.approach_speed,
            separation_speed: event.separation_speed,
            impulse: event.impulse,
            a: index(event.a),
            b: index(event.b),
            kind: event.kind,
            class: event.class,
        }
    }

    /// Whether the event is this contact of a frame.
    pub fn is(&self, contact: &Contact) -> bool {
        let bodies = (contact.kind, contact.a, contact.b) == (self.kind, self.a as usize, self.b as usize);
        bodies && contact.time == self.time && contact.class == self.class
    }
}

/// The events of a run, numbered from 1 in the order in which they happened; when there are too many the oldest go.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EventLog {
    pieces: VecDeque<Arc<Vec<Logged>>>,
    /// Events that are not kept any more.
    dropped: u64,
}

impl EventLog {
    /// Memory that the events may take, bytes.
    pub const MOST_BYTES: usize = 8 << 20;

    /// Most pieces of the list, within [`EventLog::MOST_BYTES`].
    const MOST_PIECES: usize = Self::MOST_BYTES / (PIECE * size_of::<Logged>());

    /// Adds the event that comes next.
    pub fn add(&mut self, event: &Contact) {
        if self.pieces.back().is_none_or(|last| last.len() >= PIECE) {
            if self.pieces.len() >= Self::MOST_PIECES {
                self.dropped += self.pieces.pop_front().map_or(0, |first| first.len() as u64);
            }
            self.pieces.push_back(Arc::new(Vec::with_capacity(PIECE)));
        }
        if let Some(last) = self.pieces.back_mut() {
            own(last).push(Logged::of(event));
        }
    }

    /// Forgets all events but the first so many.
    pub fn cut(&mut self, events: u64) {
        let keep = events.saturating_sub(self.dropped) as usize;
        let pieces = keep.div_ceil(PIECE);
        self.pieces.truncate(pieces);
        let reached = self.pieces.len() == pieces;
        if let Some(last) = self.pieces.back_mut().filter(|_| reached) {
            let left = keep - (pieces - 1) * PIECE;
            if left < last.len() {
                own(last).truncate(left);
            }
        }
        self.dropped = self.dropped.min(events);
    }

    /// Number of events so far, those that are not kept any more included.
    pub fn total(&self) -> u64 {
        let last = self.pieces.back().map_or(0, |last| last.len());
        self.dropped + (self.pieces.len().saturating_sub(1) * PIECE + last) as u64
    }

    /// Number of the oldest events that are not kept any more.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// The event of this number, if it is kept.
    pub fn get(&self, number: u64) -> Option<&Logged> {
        let index = number.checked_sub(self.dropped + 1)? as usize;
        self.pieces.get(index / PIECE)?.get(index % PIECE)
    }

    /// The events that are kept, each with its number, the oldest first.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (u64, &Logged)> + Clone {
        let first = self.dropped + 1;
        let pieces = self.pieces.iter().enumerate();
        pieces.flat_map(move |(piece, events)| {
            let first = first + (piece * PIECE) as u64;
            events.iter().enumerate().map(move |(index, event)| (first + index as u64, event))
        })
    }
}

/// The piece to be changed: a copy of its own if it is shared, with room for all of a piece and no more.
fn own(piece: &mut Arc<Vec<Logged>>) -> &mut Vec<Logged> {
    if Arc::get_mut(piece).is_none() {
        let mut copy = Vec::with_capacity(PIECE);
        copy.extend_from_slice(piece);
        *piece = Arc::new(copy);
    }
    Arc::make_mut(piece)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn event(number: u64) -> Contact {
        Contact {
            time: number as f64,
            kind: Kind::Pair,
            a: 3,
            b: 5,
            point: DVec3::ZERO,
            normal: DVec3::X,
            velocity: -DVec3::X,
            approach_speed: 1.0,
            separation_speed: 0.5,
            impulse: 2.0,
            degree: 0.0,
            class: Class::Collide,
            impacts: 1,
        }
    }

    fn filled(events: u64) -> EventLog {
        let mut log = EventLog::default();
        (1..=events).for_each(|number| log.add(&event(number)));
        log
    }

    /// Whether the list is that of the first `total` events, as far as it keeps them.
    fn assert_is(log: &EventLog, total: u64) {
        assert_eq!(log.total(), total);
        let all: Vec<(u64, f64)> = log.iter().map(|(number, event)| (number, event.time)).collect();
        assert_eq!(all.len() as u64, total - log.dropped());
        assert!(all.iter().all(|(number, time)| *number as f64 == *time), "each has its number");
        assert_eq!(all.last().map(|(number, _)| *number), (total > log.dropped()).then_some(total));
        let got = |number: u64| log.get(number).map(|event| event.time);
        assert_eq!((got(total), got(total + 1)), ((total > log.dropped()).then_some(total as f64), None));
    }

    #[test]
    fn events_keep_their_numbers_and_the_oldest_go_when_there_are_too_many() {
        for total in [0, 1, 1023, 1024, 1025, 5000] {
            assert_is(&filled(total), total);
        }
        let most = (EventLog::MOST_PIECES * PIECE) as u64;
        assert!(most >= 100_000, "{most}");
        let mut log = filled(most - 5);
        for number in most - 4..=most + 1 {
            let shared = log.clone();
            log.add(&event(number));
            assert_is(&shared, number - 1);
        }
        assert_is(&log, most + 1);
        assert_eq!(log.dropped(), PIECE as u64);
        let bytes: usize = log.pieces.iter().map(|piece| piece.capacity() * size_of::<Logged>()).sum();
        assert!(bytes <= EventLog::MOST_BYTES, "{bytes}");
    }

    #[test]
    fn what_came_after_an_event_is_forgotten_and_a_copy_that_was_shared_stays() {
        for keep in [0, 1, 1023, 1024, 1025, 2047, 2048, 2049, 2999, 3000, 4000] {
            let mut log = filled(3000);
            let shared = log.clone();
            log.cut(keep);
            assert_is(&log, keep.min(3000));
            log.add(&event(keep.min(3000) + 1));
            assert_is(&log, keep.min(3000) + 1);
            assert_is(&shared, 3000);
        }
        let mut log = filled((EventLog::MOST_PIECES * PIECE) as u64 + 1);
        log.cut(10);
        assert_eq!((log.total(), log.dropped(), log.iter().count()), (10, 10, 0), "what is gone does not come back");
    }
}
