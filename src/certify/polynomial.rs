//! Where a polynomial of time falls below 0, and how long it stays above: the ends of rest, and of what follows it.

use crate::double::Double;

/// Part of the size of a polynomial's terms that stands for rounding in `f64`.
const ROUNDING: f64 = 1e-14;

/// Part of the size of a polynomial's terms that stands for rounding in [`Double`], after what has been rounded before.
const SHADOW_ROUNDING: f64 = 1e-24;

/// Halvings after which a piece is given up.
const MOST_HALVINGS: u32 = 60;

/// Steps of Newton's iteration, at most.
const MOST_STEPS: u32 = 20;

/// The polynomial's value, Σ cₖ tᵏ.
pub(super) fn value(terms: &[Double], t: Double) -> Double {
    terms.iter().rev().fold(Double::ZERO, |sum, &term| sum * t + term)
}

/// The polynomial's rate of change, Σ k cₖ tᵏ⁻¹.
fn rate(terms: &[Double], t: Double) -> Double {
    let powers = terms.iter().enumerate().skip(1).rev();
    powers.fold(Double::ZERO, |sum, (k, &term)| sum * t + term * Double::from(k as f64))
}

/// What becomes of a polynomial that begins at 0 or above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Fall {
    /// The polynomial stays there.
    Never,
    /// The polynomial falls below 0 at this time, s.
    At(Double),
    /// The polynomial is too near to 0 at this time (s) to tell.
    Unclear(f64),
}

/// When a polynomial, at 0 or above at 0 s, falls below 0 first, up to `length`, s.
pub(super) fn fall(terms: &[Double], length: f64) -> Fall {
    let mut power = 1.0;
    let mut sizes = Vec::with_capacity(terms.len());
    for term in terms {
        sizes.push(term.value().abs() * power);
        power *= length;
    }
    let size = sizes.iter().sum::<f64>();
    if sizes.iter().skip(1).all(|&part| part <= SHADOW_ROUNDING * size) {
        return Fall::Never;
    }
    let bend = sizes.iter().enumerate().map(|(k, part)| (k * k.saturating_sub(1)) as f64 * part).sum::<f64>();
    let bend = bend / (length * length);
    Search { terms, small: ROUNDING * size, bend }.piece([0.0, length], 0)
}

struct Search<'a> {
    terms: &'a [Double],
    small: f64,
    /// The most that its rate changes by in a second.
    bend: f64,
}

impl Search<'_> {
    fn piece(&self, [from, to]: [f64; 2], depth: u32) -> Fall {
        let ends = [from, to].map(|t| value(self.terms, t.into()).value());
        let rates = [from, to].map(|t| rate(self.terms, t.into()).value());
        let width = to - from;
        let least = ends[0].min(ends[1]) - self.bend * width * width / 8.0;
        let rises = from == 0.0 && ends[0] >= -self.small && rates[0] > self.bend * width;
        if least > self.small || rises {
            return Fall::Never;
        }
        let falls = rates[0] < -self.bend * width;
        if falls && ends[0] >= -self.small && ends[1] < -self.small {
            return self.root(from + width * (ends[0] / (ends[0] - ends[1])).clamp(0.0, 1.0));
        }
        let middle = from + 0.5 * width;
        if depth == MOST_HALVINGS || middle <= from || middle >= to {
            return Fall::Unclear(from);
        }
        match self.piece([from, middle], depth + 1) {
            Fall::Never => self.piece([middle, to], depth + 1),
            found => found,
        }
    }

    fn root(&self, guess: f64) -> Fall {
        let mut t = Double::from(guess);
        for _ in 0..MOST_STEPS {
            let step = value(self.terms, t) / rate(self.terms, t);
            t = t - step;
            if step.value().abs() <= SHADOW_ROUNDING * t.value().abs() {
                return Fall::At(t);
            }
        }
        if t.value().is_finite() { Fall::At(t) } else { Fall::Unclear(guess) }
    }
}

/// Up to when, s, at most `length`, a polynomial that begins at 0 but for rounding in what is as large as `size` is shown to
/// be above 0; none if it is not.
pub(super) fn above(terms: &[Double], size: f64, length: f64) -> Option<f64> {
    let mut until = length;
    for _ in 0..MOST_HALVINGS {
        let mut power = 1.0;
        let mut parts = terms.iter().map(|term| {
            let part = term.value() * power;
            power *= until;
            part
        });
        let first = parts.find(|part| part.abs() > SHADOW_ROUNDING * size)?;
        if first > 2.0 * parts.map(f64::abs).sum::<f64>() {
            return Some(until);
        }
        until *= 0.5;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn terms<const N: usize>(values: [f64; N]) -> Vec<Double> {
        values.into_iter().map(Double::from).collect()
    }

    #[test]
    fn the_first_fall_is_found_to_thirty_digits() {
        // (1 − t)(3 − t) falls at 1 and rises at 3; 2 − t² at √2.
        falls_at(&[3.0, -4.0, 1.0], Double::ONE);
        falls_at(&[2.0, 0.0, -1.0], Double::from(2.0).sqrt());
    }

    fn falls_at(coefficients: &[f64], expected: Double) {
        let terms: Vec<Double> = coefficients.iter().map(|&value| value.into()).collect();
        let Fall::At(root) = fall(&terms, 5.0) else { panic!("{coefficients:?} falls") };
        assert!((root - expected).abs() < Double::from(1e-30), "{root:?}");
    }

    #[test]
    fn what_begins_at_zero_and_rises_falls_when_it_comes_back() {
        // t (2 − t)
        assert_eq!(fall(&terms([0.0, 2.0, -1.0]), 1.5), Fall::Never);
        falls_at(&[0.0, 2.0, -1.0], Double::from(2.0));
        assert_eq!(fall(&terms([0.0, 0.0, 0.0]), 3.0), Fall::Never);
    }

    #[test]
    fn what_touches_zero_is_not_told_either_way() {
        // (1 − t)²
        assert!(matches!(fall(&terms([1.0, -2.0, 1.0]), 3.0), Fall::Unclear(t) if (t - 1.0).abs() < 1e-6));
    }

    #[test]
    fn what_leaves_zero_is_above_it_as_long_as_its_first_term_outweighs_the_others() {
        // t³ − t⁴, and something that is rounding
        let until = above(&terms([1e-30, 0.0, 0.0, 1.0, -1.0]), 1.0, 8.0).expect("it rises");
        assert!((0.125..0.5).contains(&until), "{until}");
        assert_eq!(above(&terms([0.0, -1e-10, 1.0]), 1.0, 8.0), None);
    }
}
