//! How a quantity went over time.

use super::bins::{self, bin};

/// Bins of a [`Trend`]: more than any terminal has columns.
const BINS: usize = 512;

/// The largest values of a quantity over time: bins of equal width that double when the run outgrows them.
#[derive(Debug, Clone, PartialEq)]
pub struct Trend {
    /// Time covered by all bins, s, from 0.
    pub span: f64,
    /// The largest amount (|value|) per bin; NaN where none is known.
    pub values: Vec<f64>,
    /// The value last added, with its sign.
    pub last: Option<f64>,
}

impl Trend {
    /// A trend without values, in bins that cover `span` seconds (1 s if that is not a positive number).
    pub fn new(span: f64) -> Trend {
        Trend { span: bins::span(span), values: vec![f64::NAN; BINS], last: None }
    }

    /// Adds a value at `time`, s; the bins double until they reach it. What is not finite is left out.
    pub fn add(&mut self, time: f64, value: f64) {
        if !(time.is_finite() && value.is_finite()) {
            return;
        }
        self.last = Some(value);
        let bin = bin(&mut self.values, &mut self.span, time, f64::NAN, f64::max);
        self.values[bin] = self.values[bin].max(value.abs());
    }
}

/// What accuracy was bought with what work, over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Trade {
    /// Largest distance of a sphere from the exact run, m; up to the horizon.
    pub deviation: Trend,
    /// Relative energy error against the exact run, dimensionless.
    pub energy_error: Trend,
    /// Deepest intersection degree so far, dimensionless.
    pub deepest_degree: Trend,
    /// Degree evaluations per frame.
    pub evaluations: Trend,
    /// CPU time per simulated second, ms/s.
    pub cost: Trend,
}

impl Trade {
    /// The trade of a run that is expected to last `span` seconds, without values yet.
    pub fn new(span: f64) -> Trade {
        let none = Trend::new(span);
        Trade {
            deviation: none.clone(),
            energy_error: none.clone(),
            deepest_degree: none.clone(),
            evaluations: none.clone(),
            cost: none,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bin_keeps_the_largest_amount_and_the_last_value_its_sign() {
        let mut trend = Trend::new(20.0);
        trend.add(5.0, -3.0);
        trend.add(5.0, 1.0);
        assert_eq!((trend.values[BINS / 4], trend.last), (3.0, Some(1.0)));
        trend.add(79.0, 2.0);
        assert_eq!((trend.span, trend.values.len()), (80.0, BINS));
        assert_eq!(trend.values[BINS / 16], 3.0);
        assert_eq!(trend.values.iter().filter(|value| !value.is_nan()).count(), 2);
    }

    #[test]
    fn what_is_not_finite_is_left_out() {
        let mut trend = Trend::new(f64::NAN);
        for (time, value) in [(f64::NAN, 1.0), (f64::INFINITY, 1.0), (0.5, f64::NAN)] {
            trend.add(time, value);
        }
        assert!(trend.values.iter().all(|value| value.is_nan()));
        trend.add(1e308, 1.0);
        assert_eq!(trend.values.len(), BINS);
    }
}
