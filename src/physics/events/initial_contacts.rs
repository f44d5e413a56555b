//! Contacts that exist at load: here alone does a gap of rounding's size count as touching.

use super::detector::Detector;
use super::engine::EventDriven;
use super::schedule::candidates::Candidates;
use super::trajectories::Record;
use crate::physics::contact::{Key, Kind};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::overlap::touching;
use crate::physics::state::Stall;

/// Events at the very start after which the rest is left to the first frame.
const MOST_AT_LOAD: usize = 1_000_000;

impl<D: Detector> EventDriven<D> {
    /// Handles what touches at the start, in the order of events, and predicts everything.
    pub(super) fn load(&mut self, model: &Model, log: &mut Log) {
        let touching = self.touching_now(model);
        let squeezing = self.squeezing_now(model, &touching);
        for key in touching {
            if squeezing.binary_search(&key).is_ok() {
                let meeting = self.meeting(model, key);
                self.rests.add(model, &self.flight, self.now, &meeting, self.now);
                continue;
            }
            // a stall at load shows itself again in the first frame
            let _ = self.meet_at_load(model, log, key);
        }
        for i in 0..model.len() {
            self.predict(model, i);
        }
        for _ in 0..MOST_AT_LOAD {
            let next = self.queue.earliest().0;
            let idle = next > self.now && !self.rests.is_dirty();
            if idle || self.turn(model, log).is_err() {
                break;
            }
        }
        log.contacts.clear();
    }

    /// A contact that neither opens nor collides may rest, pressed or not: its island knows.
    fn meet_at_load(&mut self, model: &Model, log: &mut Log, key: Key) -> Result<(), Stall> {
        let meeting = self.meeting(model, key);
        if meeting.v_n == 0.0 {
            self.rests.add(model, &self.flight, self.now, &meeting, self.now);
            return Ok(());
        }
        self.meet(model, log, key)
    }

    /// Of these contacts those that squeeze a sphere between walls.
    fn squeezing_now(&self, model: &Model, touching: &[Key]) -> Vec<Key> {
        let walls = touching.iter().take_while(|key| key.0 == Kind::Wall).count();
        touching[..walls].chunk_by(|one, other| one.1 == other.1).flat_map(|keys| self.squeezing(model, keys)).collect()
    }

    /// Every contact with a gap of at most max(1e-12 r, 8 ulp of the coordinates): walls before pairs, then a, then b.
    fn touching_now(&self, model: &Model) -> Vec<Key> {
        let mut found = Vec::new();
        let mut near = Candidates::empty();
        let records = &self.flight.records;
        for record in records {
            let Record { line, spot, sphere, .. } = record;
            let i = *sphere as usize;
            found.extend(self.walls_touched(model, record).into_iter().map(|wall| (Kind::Wall, i, wall)));
            let mut pair = |seat: usize| {
                let (j, other) = (records[seat].sphere as usize, &records[seat].line);
                let slack = touching(line.r + other.r, line.x.abs().max(other.x.abs()).max_element());
                if i < j && (line.x - other.x).length() - (line.r + other.r) <= slack {
                    found.push((Kind::Pair, i, j));
                }
            };
            match &self.cells {
                None => (i + 1..records.len()).for_each(&mut pair),
                Some(cells) => {
                    cells.look(*spot, None, &mut near, records.len());
                    near.seats().iter().for_each(|&seat| pair(seat as usize));
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }
}
