//! Software prefetch of what the next dozen events read; never affects results.
//!
//! With many spheres, nearly all time goes into waiting for memory, and an event waits several times in a row: for its
//! record, then for the cells around, then for the trajectories of the spheres there. So a list of the next few dozen
//! events is kept, and each is visited three times before it is due. The list is a guess, since events change what follows:
//! it decides when memory is read, and nothing else.

use super::candidates::Candidates;
use super::cells::Cells;
use super::queue::Queue;
use super::simd::Simd;
use crate::physics::contact::Kind;
use crate::physics::events::record::{CellRef, Exit, Record};
use crate::physics::events::trajectories::Trajectories;

/// Fewest spheres for which prefetching pays: fewer are in a fast cache without it.
const MANY: usize = 20_000;

/// How many events ahead the places around are asked for, then the lines there, then those around the partner.
const PLACES: usize = 12;
const LINES: usize = 8;
const PARTNER: usize = 4;

/// Number of events that a list should have.
const LISTED: usize = 64;

/// A guess at the next events.
#[derive(Debug, Clone, Default)]
pub(crate) struct Prefetch {
    /// Time, s, and slot of each event.
    list: Vec<(f64, u32)>,
    /// Number of events handled since the list was made.
    at: usize,
    /// Time that the list should reach, s.
    span: f64,
    candidates: Option<Box<Candidates>>,
    /// Scratch buffers for looking into the queue.
    blocks: [Vec<u32>; 2],
}

/// Whether a sphere crosses into another cell before it meets anything.
fn crosses(record: &Record) -> bool {
    record.plan.crossing < record.plan.contact
}

/// The cell around which a sphere will look.
fn next_spot(cells: &Cells, record: &Record) -> CellRef {
    if crosses(record) && !record.cell.is_loose() { cells.beyond(record.cell, record.plan.exit) } else { record.cell }
}

/// The slot of the sphere that a sphere meets, if that comes first.
fn partner(record: &Record) -> Option<usize> {
    (!crosses(record) && record.plan.kind == Kind::Pair).then_some(record.plan.other as usize)
}

impl Prefetch {
    /// Whether `spheres` spheres outgrow a fast cache.
    #[inline]
    pub(crate) fn pays(spheres: usize) -> bool {
        spheres >= MANY
    }

    /// Asks, once one event more is handled, for what those that follow will read.
    pub(crate) fn look_ahead(&mut self, trajectories: &Trajectories, queue: &Queue, cells: &Cells, simd: Simd) {
        self.at += 1;
        if self.at + PLACES >= self.list.len().max(2 * PLACES) {
            self.list_events(trajectories, queue, simd);
        }
        let Prefetch { list, at, candidates, .. } = self;
        let records = &trajectories.records[..];
        let candidates = candidates.get_or_insert_with(|| Box::new(Candidates::empty()));
        let due = |ahead: usize| list.get(*at + ahead).map(|&(_, slot)| &records[slot as usize]);
        if let Some(record) = due(PLACES) {
            cells.fetch_around(next_spot(cells, record), simd);
            if let Some(other) = partner(record) {
                simd.fetch(&records[other].trajectory);
                simd.fetch(&records[other].plan);
                queue.fetch(other);
            }
        }
        let mut lines = |cell: CellRef, way| {
            if cell.is_loose() {
                return;
            }
            match way {
                None => cells.around(cell, candidates),
                Some(way) => cells.ahead(cell, way, candidates),
            }
            candidates.slots().iter().for_each(|&slot| simd.fetch(&records[slot as usize].trajectory));
        };
        if let Some(record) = due(LINES) {
            lines(next_spot(cells, record), crosses(record).then_some(record.plan.exit));
            if let Some(other) = partner(record) {
                cells.fetch_around(records[other].cell, simd);
            }
        }
        if let Some(record) = due(PARTNER)
            && let Some(other) = partner(record)
        {
            // what is around both has been asked for: it is the layers on the partner's side that are missing
            let cell = records[other].cell;
            for axis in 0..3 {
                let step = cell.coordinates[axis] - record.cell.coordinates[axis];
                if step != 0 {
                    lines(cell, Some(Exit { axis: axis as u8, sign: step.signum() as i8 }));
                }
            }
        }
    }

    fn list_events(&mut self, trajectories: &Trajectories, queue: &Queue, simd: Simd) {
        let Prefetch { list, at, span, blocks, .. } = self;
        let now = trajectories.now;
        list.clear();
        *at = 0;
        queue.until(now + *span, 4 * LISTED, list, blocks);
        list.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        if list.len() < LISTED {
            *span = 1.25 * *span + f64::EPSILON * now.abs() + f64::MIN_POSITIVE;
        } else if list.len() > 2 * LISTED {
            *span *= 0.7;
        }
        for &(_, slot) in list.iter() {
            simd.fetch(&trajectories.records[slot as usize].trajectory);
            simd.fetch(&trajectories.records[slot as usize].plan);
        }
    }
}
