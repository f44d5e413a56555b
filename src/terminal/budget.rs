//! How many bytes per second may go to the terminal: for lines that are shared or dear.

use std::time::Duration;

/// Time that a picture may come late without its bytes being lost to the average.
const CREDIT: Duration = Duration::from_millis(50);

/// A cap, kept on the average: after each picture nothing is sent until its bytes are paid for.
#[derive(Debug)]
pub(super) struct Budget {
    /// Bytes per second; `None`: no cap.
    rate: Option<u64>,
    /// When all that was sent is paid for.
    paid: Duration,
    /// Whether an answer to a key was sent before `paid`.
    overdrawn: bool,
}

impl Budget {
    pub(super) fn new(rate: Option<u64>) -> Budget {
        Budget { rate, paid: Duration::ZERO, overdrawn: false }
    }

    /// Time from which on a picture may be sent. An answer to a key (`urgent`) waits only if another did not.
    pub(super) fn allows_from(&self, urgent: bool) -> Duration {
        if urgent && !self.overdrawn { Duration::ZERO } else { self.paid }
    }

    /// Counts bytes that are sent at `now`.
    pub(super) fn spend(&mut self, bytes: usize, now: Duration) {
        let Some(rate) = self.rate else { return };
        self.overdrawn = self.paid > now;
        self.paid =
            self.paid.max(now.saturating_sub(CREDIT)) + Duration::from_secs_f64(bytes as f64 / rate.max(1) as f64);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn a_minute_of_pictures_keeps_to_the_cap_whatever_keys_are_pressed() {
        for pressed in [false, true] {
            let mut budget = Budget::new(Some(64_000));
            let (mut sent, mut now) = (0, Duration::ZERO);
            while now < 60_000 * MS {
                if budget.allows_from(pressed) <= now {
                    budget.spend(2000, now);
                    sent += 2000;
                }
                now += MS;
            }
            assert!((3_800_000..=3_844_000).contains(&sent), "{sent} bytes in 60 s");
        }
    }

    #[test]
    fn the_answer_to_a_key_does_not_wait_but_the_second_does() {
        let mut budget = Budget::new(Some(1000));
        budget.spend(2000, Duration::ZERO);
        assert_eq!(budget.allows_from(false), 2000 * MS);
        assert_eq!(budget.allows_from(true), Duration::ZERO);
        budget.spend(500, 10 * MS);
        assert_eq!((budget.allows_from(true), budget.allows_from(false)), (2500 * MS, 2500 * MS));
        budget.spend(500, 2500 * MS);
        assert_eq!(budget.allows_from(true), Duration::ZERO, "paid for, and again");
    }

    #[test]
    fn without_a_cap_nothing_waits() {
        let mut budget = Budget::new(None);
        budget.spend(usize::MAX, Duration::ZERO);
        assert_eq!(budget.allows_from(false), Duration::ZERO);
    }
}
