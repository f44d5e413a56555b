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
}
