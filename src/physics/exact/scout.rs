//! A look ahead: what the next events will read is asked for while the present one is handled.
//!
//! With many spheres, nearly all time goes into waiting for memory, and an event waits several times in a row: for its
//! record, then for the places around, then for the lines of who is there. So a list of the next few dozen events is
//! kept, and each is visited three times before it is due. The list is a guess, since events change what follows: it
//! decides when memory is read, and nothing else.

use super::Exact;
use super::near::Near;
use crate::physics::Kind;
use crate::physics::detector::Detector;

/// Fewer spheres are in a fast cache anyhow.
const MANY: usize = 20_000;

/// How many events ahead the places around are asked for, then the lines there, then those around the partner.
const PLACES: usize = 12;
const LINES: usize = 8;
const PARTNER: usize = 4;

/// Events that a list should have.
const LISTED: usize = 64;

/// What is known about what comes next.
#[derive(Debug, Clone, Default)]
pub(super) struct Scout {
    /// Time, s, and seat.
    list: Vec<(f64, u32)>,
    /// Events handled since it was made.
    at: usize,
    /// How far it should reach, s.
    span: f64,
    near: Option<Box<Near>>,
    /// Lent to whoever looks into the queue.
    blocks: [Vec<u32>; 2],
}

impl<D: Detector> Exact<D> {
    /// Called at every event.
    #[inline]
    pub(super) fn scout(&mut self) {
        if self.flight.records.len() >= MANY && self.cells.is_some() {
            self.look_ahead();
        }
    }

    fn look_ahead(&mut self) {
        self.scout.at += 1;
        if self.scout.at + PLACES >= self.scout.list.len().max(2 * PLACES) {
            self.list_events();
        }
        let Exact { cells: Some(cells), flight, scout: Scout { list, at, near, .. }, lanes, .. } = self else { return };
        let records = &flight.records[..];
        let near = near.get_or_insert_with(|| Box::new(Near::nobody()));
        let due = |ahead: usize| list.get(*at + ahead).map(|&(_, seat)| &records[seat as usize]);
        if let Some(record) = due(PLACES) {
            cells.fetch_around(record.spot, *lanes);
            if record.plan.kind == Kind::Pair {
                let partner = &records[record.plan.other as usize];
                lanes.fetch(&partner.line);
                lanes.fetch(&partner.plan);
                self.queue.fetch(record.plan.other as usize);
            }
        }
        let mut lines = |spot| {
            cells.around(spot, near);
            near.seats().iter().for_each(|&seat| lanes.fetch(&records[seat as usize].line));
        };
        if let Some(record) = due(LINES) {
            lines(record.spot);
            flight.fetch_seat(record.sphere as usize, *lanes);
            if record.plan.kind == Kind::Pair {
                let partner = &records[record.plan.other as usize];
                cells.fetch_around(partner.spot, *lanes);
                flight.fetch_seat(partner.sphere as usize, *lanes);
            }
        }
        if let Some(record) = due(PARTNER)
            && record.plan.kind == Kind::Pair
            && record.plan.contact <= record.plan.crossing
        {
            lines(records[record.plan.other as usize].spot);
        }
    }

    fn list_events(&mut self) {
        let Exact { scout: Scout { list, at, span, blocks, .. }, .. } = self;
        list.clear();
        *at = 0;
        self.queue.until(self.now + *span, 4 * LISTED, list, blocks);
        list.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        if list.len() < LISTED {
            *span = 1.25 * *span + f64::EPSILON * self.now.abs() + f64::MIN_POSITIVE;
        } else if list.len() > 2 * LISTED {
            *span *= 0.7;
        }
        for &(_, seat) in list.iter() {
            self.lanes.fetch(&self.flight.records[seat as usize].line);
            self.lanes.fetch(&self.flight.records[seat as usize].plan);
        }
    }
}
