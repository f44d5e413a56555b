//! Contacts that exist at load: here alone does a gap of rounding's size count as touching.

use super::mechanics::Mechanics;
use super::rest_reason::RestReason;
use super::schedule::candidates::Candidates;
use super::schedule::cells::Cells;
use super::squeezed::{squeezing, walls_touched};
use crate::physics::contact::{Key, Kind};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::overlap::touching;

impl Mechanics {
    /// Lets the impact law act on what touches now, in the order of events. Predicts nothing.
    pub(super) fn meet_at_load(&mut self, model: &Model, log: &mut Log, cells: Option<&Cells>) {
        let touching = self.touching_now(model, cells);
        let squeezing = self.squeezing_now(model, &touching);
        for key in touching {
            let contact = self.advanced_contact(model, key);
            let reason = match squeezing.binary_search(&key) {
                Ok(_) => RestReason::Squeezed,
                // what neither opens nor collides may rest, pressed or not: its island knows
                Err(_) if contact.v_n == 0.0 => RestReason::Touching,
                Err(_) => {
                    // a stall at load shows itself again in the first frame
                    let _ = self.meet(model, log, key);
                    continue;
                }
            };
            self.rests.add(model, &self.trajectories, &contact, reason, self.trajectories.now);
        }
    }

    /// The contacts among `touching` that squeeze a sphere between walls.
    fn squeezing_now(&self, model: &Model, touching: &[Key]) -> Vec<Key> {
        let walls = touching.iter().take_while(|key| key.0 == Kind::Wall).count();
        let by_sphere = touching[..walls].chunk_by(|one, other| one.1 == other.1);
        by_sphere.flat_map(|keys| squeezing(model, &self.trajectories, keys)).collect()
    }

    /// Every contact with a gap of at most max(1e-12 r, 8 ulp of the coordinates): walls before pairs, then a, then b.
    fn touching_now(&self, model: &Model, cells: Option<&Cells>) -> Vec<Key> {
        let mut found = Vec::new();
        let mut candidates = Candidates::empty();
        let records = &self.trajectories.records;
        for record in records {
            let (i, line, cell) = (record.sphere as usize, &record.trajectory, record.cell);
            found.extend(match cells.filter(|_| !cell.is_loose()) {
                Some(cells) => {
                    let walls = cells.walls_near(cell).iter().map(|&wall| wall as usize);
                    walls_touched(model, &self.trajectories, record, walls)
                }
                None => walls_touched(model, &self.trajectories, record, 0..model.faces.len()),
            });
            let mut pair = |slot: usize| {
                let (j, other) = (records[slot].sphere as usize, &records[slot].trajectory);
                let slack = touching(line.r + other.r, line.x.abs().max(other.x.abs()).max_element());
                if i < j && (line.x - other.x).length() - (line.r + other.r) <= slack {
                    found.push((Kind::Pair, i, j));
                }
            };
            match cells {
                None => (i + 1..records.len()).for_each(&mut pair),
                Some(cells) => {
                    cells.look(cell, None, &mut candidates, records.len());
                    candidates.slots().iter().for_each(|&slot| pair(slot as usize));
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }
}
