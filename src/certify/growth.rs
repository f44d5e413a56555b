//! When an error became how large, by powers of two.

/// Powers of two that are told apart: from 2⁻¹⁰⁰ m, below which nothing is asked, to 2²⁷ m.
const POWERS: usize = 128;

/// The biased exponent of 2⁻¹⁰⁰.
const LEAST: u64 = 1023 - 100;

/// For each power of two, the earliest time (s) at which an error that large may have begun.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Growth(Box<[f64; POWERS]>);

impl Default for Growth {
    fn default() -> Growth {
        Growth(Box::new([f64::INFINITY; POWERS]))
    }
}

impl Growth {
    /// Notes an error (m) that has come about since `since` (s).
    pub(super) fn note(&mut self, since: f64, error: f64) {
        let time = &mut self.0[power(error)];
        *time = time.min(since);
    }

    /// Notes an error that goes from one value (m) at a time (s) to another one, and between them is not above the straight line.
    pub(super) fn rise(&mut self, from: (f64, f64), to: (f64, f64)) {
        self.note(from.0, from.1);
        for k in power(from.1) + 1..=power(to.1) {
            let level = f64::from_bits((LEAST + k as u64) << 52);
            let share = ((level - from.1) / (to.1 - from.1)).clamp(0.0, 1.0);
            self.0[k] = self.0[k].min(from.0 + share * (to.0 - from.0));
        }
    }

    /// The earliest time (s) at which an error of at least half of `asked` (m) may have begun.
    pub(super) fn first(&self, asked: f64) -> f64 {
        self.0[power(asked)..].iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// Exponent of the power of two of a positive number, from the least on; 0 for 0.
fn power(value: f64) -> usize {
    let exponent = value.abs().to_bits() >> 52;
    (exponent.saturating_sub(LEAST) as usize).min(POWERS - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_never_told_later_than_it_began() {
        let mut growth = Growth::default();
        for (since, error) in [(0.0, 0.0), (1.0, 1e-12), (2.0, 1e-9), (1.5, 3e-6), (5.0, 1e-3)] {
            growth.note(since, error);
        }
        assert_eq!(growth.first(1e-2), f64::INFINITY);
        assert_eq!(growth.first(1e-4), 5.0);
        assert_eq!(growth.first(1e-9), 1.5, "the larger error began before the smaller");
        assert_eq!(growth.first(1e-12), 1.0);
    }

    #[test]
    fn an_error_that_rises_begins_where_the_line_to_its_end_has_it() {
        let mut growth = Growth::default();
        growth.rise((2.0, 0.0), (4.0, 1.0));
        for (asked, began) in [(1.0, 4.0), (0.5, 3.0), (0.25, 2.5), (0.7, 3.0), (2.0, f64::INFINITY)] {
            assert_eq!(growth.first(asked), began, "{asked}");
        }
        assert!((2.0..2.0001).contains(&growth.first(1e-5)));
        growth.rise((1.0, 0.3), (1.5, 0.1));
        assert_eq!((growth.first(0.25), growth.first(0.5)), (1.0, 3.0), "what falls began as it was");
    }
}
