//! A look ahead: what the next events will read is asked for while the present one is handled.
//!
//! With many spheres, nearly all time goes into waiting for memory, and an event waits several times in a row: for its
//! record, then for the places around, then for the lines of who is there. So a list of the next few dozen events is
//! kept, and each is visited three times before it is due. The list is a guess, since events change what follows: it
//! decides when memory is read, and nothing else.

use super::candidates::Candidates;
use super::cells::{CellRef, Cells, Exit};
use crate::physics::contact::Kind;
use crate::physics::events::detector::Detector;
use crate::physics::events::engine::EventDriven;
use crate::physics::events::trajectories::Record;

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
pub(crate) struct Prefetch {
    /// Time, s, and seat.
    list: Vec<(f64, u32)>,
    /// Events handled since it was made.
    at: usize,
    /// How far it should reach, s.
    span: f64,
    near: Option<Box<Candidates>>,
    /// Lent to whoever looks into the queue.
    blocks: [Vec<u32>; 2],
}

/// Whether a sphere crosses into another cube before it meets anybody.
fn crosses(record: &Record) -> bool {
    record.plan.crossing < record.plan.contact
}

/// Where a sphere will look around.
fn next_spot(cells: &Cells, record: &Record) -> CellRef {
    if crosses(record) && !record.spot.is_loose() { cells.beyond(record.spot, record.plan.way) } else { record.spot }
}

/// The seat of the sphere that it meets, if that comes first.
fn partner(record: &Record) -> Option<usize> {
    (!crosses(record) && record.plan.kind == Kind::Pair).then_some(record.plan.other as usize)
}

impl<D: Detector> EventDriven<D> {
    /// Called at every event.
    #[inline]
    pub(crate) fn scout(&mut self) {
        if self.flight.records.len() >= MANY && self.cells.is_some() {
            self.look_ahead();
        }
    }

    fn look_ahead(&mut self) {
        self.scout.at += 1;
        if self.scout.at + PLACES >= self.scout.list.len().max(2 * PLACES) {
            self.list_events();
        }
        let EventDriven { cells: Some(cells), flight, scout: Prefetch { list, at, near, .. }, lanes, .. } = self else {
            return;
        };
        let records = &flight.records[..];
        let near = near.get_or_insert_with(|| Box::new(Candidates::empty()));
        let due = |ahead: usize| list.get(*at + ahead).map(|&(_, seat)| &records[seat as usize]);
        if let Some(record) = due(PLACES) {
            cells.fetch_around(next_spot(cells, record), *lanes);
            if let Some(other) = partner(record) {
                lanes.fetch(&records[other].line);
                lanes.fetch(&records[other].plan);
                self.queue.fetch(other);
            }
        }
        let mut lines = |spot: CellRef, way| {
            if spot.is_loose() {
                return;
            }
            match way {
                None => cells.around(spot, near),
                Some(way) => cells.ahead(spot, way, near),
            }
            near.seats().iter().for_each(|&seat| lanes.fetch(&records[seat as usize].line));
        };
        if let Some(record) = due(LINES) {
            lines(next_spot(cells, record), crosses(record).then_some(record.plan.way));
            if let Some(other) = partner(record) {
                cells.fetch_around(records[other].spot, *lanes);
            }
        }
        if let Some(record) = due(PARTNER)
            && let Some(other) = partner(record)
        {
            // what is around both has been asked for: it is the layers on the partner's side that are missing
            let spot = records[other].spot;
            for axis in 0..3 {
                let step = spot.cube[axis] - record.spot.cube[axis];
                if step != 0 {
                    lines(spot, Some(Exit { axis: axis as u8, sign: step.signum() as i8 }));
                }
            }
        }
    }

    fn list_events(&mut self) {
        let EventDriven { scout: Prefetch { list, at, span, blocks, .. }, .. } = self;
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
