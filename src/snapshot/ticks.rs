//! When the impacts were.

use super::bins::{self, bin};

/// Bins of a [`Ticks`]: more than any terminal has columns, and a few kilobytes however long the run lasts.
const BINS: usize = 1024;

/// Collisions over time, for the timeline: bins of equal width that double when the run outgrows them.
#[derive(Debug, Clone, PartialEq)]
pub struct Ticks {
    /// Time covered by all bins, s, from 0.
    pub span: f64,
    /// Impacts per bin.
    pub impacts: Vec<u32>,
}

impl Ticks {
    /// Ticks without collisions, in bins that cover `span` seconds (1 s if that is not a positive number).
    pub fn new(span: f64) -> Ticks {
        Ticks { span: bins::span(span), impacts: vec![0; BINS] }
    }

    /// Counts an impact at `time`, s; the bins double until they reach it. A time that is no number is left out.
    pub fn add(&mut self, time: f64) {
        if !time.is_finite() {
            return;
        }
        let bin = bin(&mut self.impacts, &mut self.span, time, 0, u32::saturating_add);
        self.impacts[bin] = self.impacts[bin].saturating_add(1);
    }

    /// Forgets the impacts after `time` (s), up to which there were so many in all.
    pub fn cut(&mut self, time: f64, impacts: u64) {
        let last = bin(&mut self.impacts, &mut self.span, time, 0, u32::saturating_add);
        let before: u64 = self.impacts[..last].iter().map(|&impacts| u64::from(impacts)).sum();
        self.impacts[last] = u32::try_from(impacts.saturating_sub(before)).unwrap_or(u32::MAX);
        self.impacts[last + 1..].fill(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn total(ticks: &Ticks) -> u32 {
        ticks.impacts.iter().sum()
    }

    #[test]
    fn an_impact_is_counted_in_the_bin_of_its_time() {
        let mut ticks = Ticks::new(20.0);
        ticks.add(5.0);
        assert_eq!(ticks.impacts[BINS / 4], 1);
        assert_eq!(total(&ticks), 1);
    }

    #[test]
    fn the_bins_double_when_the_run_outgrows_them_and_lose_no_impact() {
        let mut ticks = Ticks::new(20.0);
        for time in [0.0, 1.0, 5.0, 19.9, 20.0, 79.0] {
            ticks.add(time);
        }
        assert_eq!((ticks.span, ticks.impacts.len()), (80.0, BINS));
        assert_eq!(total(&ticks), 6);
        assert_eq!(ticks.impacts[BINS / 4], 1, "20 s of 80 s");
    }

    #[test]
    fn what_came_after_a_time_is_forgotten_to_the_impact() {
        let mut ticks = Ticks::new(20.0);
        let times = [1.0, 5.0, 5.001, 5.002, 5.003, 9.0];
        times.into_iter().for_each(|time| ticks.add(time));
        ticks.cut(5.0015, 3);
        assert_eq!((total(&ticks), ticks.impacts[BINS / 4]), (3, 2));
    }

    #[test]
    fn odd_spans_and_times_are_survived() {
        for span in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
            let mut ticks = Ticks::new(span);
            for time in [f64::NAN, f64::INFINITY, -3.0, 0.0, 1e308, f64::MAX] {
                ticks.add(time);
            }
            assert_eq!(total(&ticks), 4);
        }
    }
}
