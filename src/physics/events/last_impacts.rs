//! The last impacts of a run, which may repeat a round.

use crate::physics::contact::{Key, Kind};

/// Impacts that are compared: a chain is long if its last ones, so many, repeat a round.
pub(super) const COMPARED: usize = 128;

/// Most impacts of a round.
const MOST_IMPACTS: usize = 12;

/// The last impacts of a run, up to [`COMPARED`] of them.
#[derive(Debug, Clone)]
pub(super) struct LastImpacts {
    keys: [Key; COMPARED],
    count: usize,
    /// Time of the first of them, s.
    began: f64,
}

impl Default for LastImpacts {
    fn default() -> LastImpacts {
        LastImpacts { keys: [(Kind::Wall, 0, 0); COMPARED], count: 0, began: 0.0 }
    }
}

impl LastImpacts {
    /// Notes an impact at `now`, s.
    #[inline(always)]
    pub(super) fn note(&mut self, key: Key, now: f64) {
        if self.count == 0 {
            self.began = now;
        }
        if let Some(place) = self.keys.get_mut(self.count) {
            *place = key;
        }
        self.count += 1;
    }

    /// Whether there are enough to be compared.
    #[inline(always)]
    pub(super) fn are_many(&self) -> bool {
        self.count >= COMPARED
    }

    /// The impacts of the round that these repeat, in the order in which they come next, and when the first of these was,
    /// s; none if they repeat none. Begins anew.
    pub(super) fn take_round(&mut self) -> Option<(Vec<Key>, f64)> {
        // what is not kept has gone on like the others, or nothing is skipped
        let beyond = std::mem::take(&mut self.count) - COMPARED;
        let keys = &self.keys;
        let repeats = |period: &usize| keys[..COMPARED - period] == keys[*period..];
        let period = (2..=MOST_IMPACTS).find(repeats)?;
        let mut round = keys[COMPARED - period..].to_vec();
        round.rotate_left(beyond % period);
        Some((round, self.began))
    }
}
