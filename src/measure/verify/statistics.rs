//! Means, their standard errors, and slopes.

/// Slope of the straight line through these points (x, y) by least squares.
pub(super) fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let product: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    product / points.iter().map(|point| (point.0 - x) * (point.0 - x)).sum::<f64>()
}

/// Mean of independent values, and the standard error of that mean.
pub(super) fn mean(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    (mean, (squares / (n * (n - 1.0))).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_of_a_line_is_its_slope() {
        assert_eq!(slope(&[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)]), 2.0);
    }

    #[test]
    fn one_two_and_three_have_the_mean_two_with_a_standard_error_of_a_root_of_a_third() {
        let (mean, error) = mean(&[1.0, 2.0, 3.0]);
        assert_eq!(mean, 2.0);
        // a sum, a quotient, a root
        assert!((error - (1.0_f64 / 3.0).sqrt()).abs() < 1e-15);
    }
}
