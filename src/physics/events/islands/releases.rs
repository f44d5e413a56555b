//! Contacts that rest and let go again and again: at one instant, or every time the clock can just tell.

use std::collections::BTreeMap;

use crate::physics::contact::Key;
use crate::physics::events::rounding::STUCK;

/// How often each contact has let go within the moment for which it would be held.
#[derive(Debug, Clone, Default)]
pub(super) struct Releases {
    /// The count, and when that moment ends (s), by contact.
    counts: BTreeMap<Key, (u32, f64)>,
}

impl Releases {
    /// Number of contacts remembered.
    pub(super) fn entries(&self) -> usize {
        self.counts.len()
    }

    /// Whether a contact that lets go `now` (s) has done so too often: each time brings back another contact of its island,
    /// which brings back this one. Held together for a moment, they are solved together. The moment began with the first
    /// release, and ends `pause` (s) after any of them at the latest.
    pub(super) fn is_stuck(&mut self, key: Key, now: f64, pause: f64) -> bool {
        if !self.counts.get(&key).is_some_and(|&(_, until)| now <= until) {
            self.counts.retain(|_, (_, until)| now <= *until);
            self.counts.insert(key, (0, now + pause));
        }
        let (count, until) = self.counts.get_mut(&key).expect("a contact whose moment is over was inserted anew");
        *until = until.min(now + pause);
        *count += 1;
        *count > STUCK
    }

    /// Whether a contact has let go so often that it will be held if it opens once more `now`, s.
    pub(super) fn sticks(&self, key: Key, now: f64) -> bool {
        self.counts.get(&key).is_some_and(|&(count, until)| now <= until && count >= STUCK)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::contact::Kind;

    const PAUSE: f64 = 1e-8;

    /// Which of some releases of one contact, this far apart (s), is the first that finds it stuck, from 1 on.
    fn first_stuck(releases: u32, apart: f64) -> Option<u32> {
        let mut counts = Releases::default();
        let key = (Kind::Wall, 1, 6);
        (1..=releases).find(|&n| counts.is_stuck(key, 1.0 + f64::from(n) * apart, PAUSE))
    }

    #[test]
    fn what_lets_go_more_than_twenty_times_within_a_pause_is_stuck() {
        // at one instant, every hundred ulp of the clock, and 21 times in 0.95 of a pause
        for apart in [0.0, 2e-14, PAUSE / 21.0] {
            assert_eq!(first_stuck(1000, apart), Some(STUCK + 1), "{apart}");
        }
    }

    #[test]
    fn what_lets_go_now_and_then_is_never_stuck() {
        assert_eq!(first_stuck(1000, PAUSE / 19.0), None);
        assert_eq!(first_stuck(1000, 1.0), None);
    }

    #[test]
    fn each_contact_is_counted_by_itself_and_forgotten_after_the_pause() {
        let mut counts = Releases::default();
        let (wall, pair) = ((Kind::Wall, 1, 6), (Kind::Pair, 0, 3));
        for _ in 0..STUCK {
            assert!(!counts.is_stuck(wall, 1.0, PAUSE));
        }
        assert!(counts.sticks(wall, 1.0) && !counts.sticks(pair, 1.0) && !counts.sticks(wall, 1.0 + 2.0 * PAUSE));
        // the moment of a contact that hardly moves is long, and lengthens no other's
        assert!(!counts.is_stuck(pair, 1.0, 1e3) && counts.is_stuck(wall, 1.0, PAUSE));
        assert!(!counts.is_stuck(wall, 1.0 + 2.0 * PAUSE, PAUSE));
        // once it moves, its moment is as short as that of any other, and what is over is forgotten
        assert!(!counts.is_stuck(pair, 2.0, PAUSE) && counts.counts[&pair] == (2, 2.0 + PAUSE));
        assert!(!counts.is_stuck(wall, 3.0, PAUSE) && counts.entries() == 1);
    }
}
