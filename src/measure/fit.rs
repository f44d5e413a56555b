//! The order at which an error falls: the slope of a line through logarithms, with its interval.

/// An error that goes as the `order`-th power of a knob.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Exponent of the power law.
    pub order: f64,
    /// Half width of the interval around `order` that holds the true exponent with 95 % certainty, if logarithms scatter
    /// normally; none of two points.
    pub margin: Option<f64>,
    /// Number of points that are fitted.
    pub points: usize,
}

/// Student's t for 95 %, by degrees of freedom from 1 (Abramowitz and Stegun, table 26.10).
const STUDENT: [f64; 10] = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228];

/// Student's t for 95 % and more degrees of freedom than [`STUDENT`] lists: that of the normal distribution.
const NORMAL: f64 = 1.96;

/// The least-squares line through log(error) over log(knob); values that are not above 0 and finite are left out. None of
/// fewer than two different knobs.
pub fn fit(points: impl IntoIterator<Item = (f64, f64)>) -> Option<Fit> {
    let usable = |value: f64| value > 0.0 && value.is_finite();
    let points = points.into_iter().filter(|(knob, error)| usable(*knob) && usable(*error));
    let logs: Vec<(f64, f64)> = points.map(|(knob, error)| (knob.ln(), error.ln())).collect();
    let n = logs.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|log| log.0), mean(|log| log.1));
    let sum = |of: &dyn Fn(f64, f64) -> f64| logs.iter().map(|log| of(log.0 - x, log.1 - y)).sum::<f64>();
    let width = sum(&|x, _| x * x);
    if width.is_nan() || width <= 0.0 {
        return None;
    }
    let order = sum(&|x, y| x * y) / width;
    let freedom = logs.len() - 2;
    let scatter = sum(&|x, y| (y - order * x) * (y - order * x));
    let student = STUDENT.get(freedom.wrapping_sub(1)).copied().unwrap_or(NORMAL);
    let margin = (freedom > 0).then(|| student * (scatter / freedom as f64 / width).sqrt());
    Some(Fit { order, margin, points: logs.len() })
}

impl std::fmt::Display for Fit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.2}", self.order)?;
        self.margin.map_or(Ok(()), |margin| write!(f, " ± {margin:.2}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_is_found_with_an_interval_that_holds_it() {
        for power in [0.5_f64, 1.0, 2.0] {
            let exact = fit((0..6).map(|k| 0.1_f64.powi(k)).map(|x| (x, 3.0 * x.powf(power)))).expect("a line");
            assert!(
                (exact.order - power).abs() < 1e-12 && exact.margin.is_some_and(|margin| margin < 1e-12),
                "{exact:?}"
            );
            // every second value a fifth too large
            let bent =
                (0..6).map(|k| (0.1_f64.powi(k), if k % 2 == 0 { 1.2 } else { 1.0 } * 0.1_f64.powi(k).powf(power)));
            let bent = fit(bent).expect("a line");
            let margin = bent.margin.expect("six points");
            assert!((bent.order - power).abs() < margin && margin < 0.1, "{bent:?}");
        }
    }

    #[test]
    fn values_that_have_no_logarithm_are_left_out_and_one_knob_gives_no_order() {
        assert_eq!(fit([(0.1, 0.0), (0.01, f64::NAN)]), None);
        assert_eq!(fit([(0.1, 1.0), (0.1, 2.0)]), None);
        let two = fit([(0.1, 1e-2), (0.01, 1e-4), (0.0, 1.0)]).expect("two points");
        assert_eq!((two.margin, two.points), (None, 2));
        assert!((two.order - 2.0).abs() < 1e-12);
        assert_eq!(two.to_string(), "2.00");
    }
}
