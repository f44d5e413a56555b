//! A logarithmic axis: whole decades around the figures, and a place below them for 0.

/// Powers of ten from `low` to `high`, `low` < `high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    pub(super) low: i32,
    pub(super) high: i32,
    /// Whether the lowest decade stands for 0.
    pub(super) zero: bool,
}

/// Errors below this are called 0: less than rounding leaves of any position.
const NOTHING: f64 = 1e-17;

impl Scale {
    /// The decades that hold all these values (≥ 0; what is not finite is left out).
    pub(super) fn around(values: impl Iterator<Item = f64> + Clone) -> Scale {
        let positive = values.clone().filter(|value| value.is_finite() && *value > NOTHING).map(f64::log10);
        let (least, most) = positive.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let zero = values.into_iter().any(|value| value <= NOTHING);
        if least > most {
            return Scale { low: -1, high: 0, zero };
        }
        let (low, high) = (least.floor() as i32, most.ceil() as i32);
        Scale { low: low - i32::from(zero), high: high.max(low + 1), zero }
    }

    /// Where a value lies, 0 at the low end and 1 at the high one; what is not finite is at the high end.
    pub(super) fn place(&self, value: f64) -> f64 {
        if value <= NOTHING {
            return 0.0;
        }
        let place = (value.log10() - f64::from(self.low)) / f64::from(self.high - self.low);
        if place.is_nan() { 1.0 } else { place.clamp(0.0, 1.0) }
    }

    /// The decades to be marked, `room` of them at most, each with its place and label.
    pub(super) fn ticks(&self, room: usize) -> Vec<(f64, String)> {
        let span = self.high - self.low;
        let step = (1..=span).find(|step| (span / step) < room as i32).unwrap_or(span);
        let label = |power: i32| if self.zero && power == self.low { "0".into() } else { format!("1e{power}") };
        let place = |power: i32| f64::from(power - self.low) / f64::from(span);
        (self.low..=self.high).rev().filter(|p| (self.high - p) % step == 0).map(|p| (place(p), label(p))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_holds_its_values_in_whole_decades() {
        let scale = Scale::around([3e-5, 0.5].into_iter());
        assert_eq!(scale, Scale { low: -5, high: 0, zero: false });
        assert_eq!((scale.place(1e-5), scale.place(1.0)), (0.0, 1.0));
        assert_eq!(scale.ticks(10).len(), 6);
        assert_eq!(scale.ticks(3).iter().map(|tick| tick.1.as_str()).collect::<Vec<_>>(), ["1e0", "1e-2", "1e-4"]);
    }

    #[test]
    fn zero_has_a_place_of_its_own_below() {
        let scale = Scale::around([0.0, 2e-3].into_iter());
        assert_eq!(scale, Scale { low: -4, high: -2, zero: true });
        assert_eq!(scale.place(0.0), 0.0);
        assert_eq!(scale.ticks(9).last(), Some(&(0.0, "0".to_string())));
    }

    #[test]
    fn no_values_and_equal_values_have_a_scale() {
        assert_eq!(Scale::around([].into_iter()), Scale { low: -1, high: 0, zero: false });
        assert_eq!(Scale::around([1.0].into_iter()), Scale { low: 0, high: 1, zero: false });
        assert_eq!(Scale::around([f64::INFINITY].into_iter()).place(f64::INFINITY), 1.0);
    }
}
