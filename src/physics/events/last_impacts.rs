//! The last impacts of a run, which may repeat a round.

use crate::physics::contact::{Key, Kind};

/// Impacts that are compared: a chain is long if its last ones, so many, repeat a round.
pub(super) const COMPARED: usize = 128;

/// Most impacts of a round.
const MOST_IMPACTS: usize = 12;

/// Impacts before one among which its contact is looked for.
const LOOKED_BACK: usize = 32;

/// Impacts in a row, each of a contact that was among the last few, from which on bodies are sent to and fro at one place.
const TO_AND_FRO: usize = 8;

/// The last impacts of a run, up to [`COMPARED`] of them.
#[derive(Debug, Clone)]
pub(super) struct LastImpacts {
    /// Their contacts in one word each, the one that came k-th at place k modulo their number.
    words: [u64; COMPARED],
    /// Number of impacts so far.
    total: usize,
    /// Number of impacts before those that are compared next.
    before: usize,
    /// Time of the first of those, s.
    began: f64,
    /// Number of impacts up to the last one that is known to be of a contact that was not among the few before.
    new: usize,
    /// Number of impacts of which it is known whether they are like that.
    looked_at: usize,
}

impl Default for LastImpacts {
    fn default() -> LastImpacts {
        LastImpacts { words: [u64::MAX; COMPARED], total: 0, before: 0, began: 0.0, new: 0, looked_at: 0 }
    }
}

impl LastImpacts {
    /// Notes an impact at `now`, s.
    #[inline(always)]
    pub(super) fn note(&mut self, key: Key, now: f64) {
        if self.total == self.before {
            self.began = now;
        }
        self.words[self.total % COMPARED] = word(key);
        self.total = self.total.wrapping_add(1);
        // a row of so many takes so many after a new one: one look for so many impacts of a gas
        if self.go_to_and_fro() {
            self.look_back();
        }
    }

    /// Looks which impacts since the last look were of a contact that was among the few before, the last one first.
    #[inline(never)]
    fn look_back(&mut self) {
        let unknown = self.total.wrapping_sub(self.looked_at);
        let new = (1..=unknown).map(|back| self.total.wrapping_sub(back)).find(|&impact| !self.is_again(impact));
        if let Some(impact) = new {
            self.new = impact.wrapping_add(1);
        }
        self.looked_at = self.total;
    }

    /// Whether the contact of an impact, by its number, was among the few before; of the same contact twice in a row, which
    /// is no way to and fro, the second does not count.
    fn is_again(&self, impact: usize) -> bool {
        let word = |impact: usize| self.words[impact % COMPARED];
        (2..=LOOKED_BACK).any(|back| word(impact.wrapping_sub(back)) == word(impact))
    }

    /// Whether there are enough to be compared.
    #[inline(always)]
    pub(super) fn are_many(&self) -> bool {
        self.total.wrapping_sub(self.before) >= COMPARED
    }

    /// Whether there are enough to be compared with one more.
    #[inline(always)]
    pub(super) fn will_be_many(&self) -> bool {
        self.total.wrapping_sub(self.before) + 1 >= COMPARED
    }

    /// Whether bodies are sent to and fro at one place.
    #[inline(always)]
    pub(super) fn go_to_and_fro(&self) -> bool {
        self.total.wrapping_sub(self.new) >= TO_AND_FRO
    }

    /// The impacts of the round that these repeat, in the order in which they come next, and when the first of these was,
    /// s; none if they repeat none. Begins anew.
    pub(super) fn take_round(&mut self) -> Option<(Vec<Key>, f64)> {
        self.before = self.total;
        let mut words = self.words;
        words.rotate_left(self.total % COMPARED);
        let repeats = |period: &usize| words[..COMPARED - period] == words[*period..];
        let period = (2..=MOST_IMPACTS).find(repeats)?;
        Some((words[COMPARED - period..].iter().map(|&word| key(word)).collect(), self.began))
    }
}

/// A contact in one word: its kind in the highest bit, then both indices, of 31 and of 32 bits.
#[inline(always)]
fn word((kind, a, b): Key) -> u64 {
    u64::from(kind == Kind::Pair) << 63 | (a as u64) << 32 | b as u64
}

/// The contact of a word.
fn key(word: u64) -> Key {
    let kind = if word >> 63 == 1 { Kind::Pair } else { Kind::Wall };
    (kind, (word >> 32 & 0x7fff_ffff) as usize, (word & 0xffff_ffff) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix64;

    #[test]
    fn a_word_gives_its_contact_back() {
        for contact in
            [(Kind::Wall, 0, 0), (Kind::Pair, 3, 5), (Kind::Pair, 0x7fff_ffff, 0xffff_ffff), (Kind::Wall, 7, 1)]
        {
            assert_eq!(key(word(contact)), contact);
        }
    }

    #[test]
    fn a_contact_counts_again_if_it_was_among_the_last_few_but_not_as_the_last_of_all() {
        let (mut last, mut met, mut row) = (LastImpacts::default(), Vec::new(), 0);
        let mut draw = SplitMix64::new(1);
        for k in 0..5000 {
            // few contacts for some time, then many
            let among = if k / 100 % 2 == 0 { 6 } else { 4000 };
            let contact = (Kind::Pair, draw.below(among), 7000);
            let before: &[Key] = &met[met.len().saturating_sub(LOOKED_BACK)..];
            let again = before.iter().rev().skip(1).any(|&key| key == contact);
            row = if again { row + 1 } else { 0 };
            last.note(contact, 0.0);
            met.push(contact);
            assert_eq!(last.go_to_and_fro(), row >= TO_AND_FRO, "impact {k}");
        }
    }

    #[test]
    fn a_round_is_told_in_the_order_in_which_it_comes_next() {
        let round = [(Kind::Wall, 1, 0), (Kind::Pair, 1, 2), (Kind::Wall, 1, 4)];
        for beyond in 0..4 {
            let mut last = LastImpacts::default();
            (0..COMPARED + beyond).for_each(|k| last.note(round[k % 3], 0.0));
            let next = (COMPARED + beyond) % 3;
            let expected: Vec<Key> = (0..3).map(|k| round[(next + k) % 3]).collect();
            assert_eq!(last.take_round(), Some((expected, 0.0)));
            assert!(last.go_to_and_fro() && !last.are_many());
        }
    }
}
