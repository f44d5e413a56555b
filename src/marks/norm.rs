//! What runs of a crowd have in common, and how far a trajectory is from that: where places mean nothing any longer.

use crate::export::{CrowdRow, FIGURES};
use crate::measure::Figures;

/// Deviations by which one run may differ from the mean of others.
const DEVIATIONS: f64 = 3.0;

/// Part of itself by which a figure may differ and count as equal: what rounding leaves of a sum.
const SAME: f64 = 1e-9;

/// A figure of many runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Normal {
    /// Mean of the runs.
    pub mean: f64,
    /// Standard deviation of a run.
    pub deviation: f64,
    /// Number of runs.
    pub runs: u64,
    /// The setting that made the runs: its method, dt (s) and tolerance.
    pub by: (String, Option<f64>, Option<f64>),
}

/// What many runs of a scene do, by figure in the order of [`FIGURES`]; none where nothing is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Norm(Vec<Option<Normal>>);

/// A figure of a trajectory beside that of many runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Beside {
    /// Place of the figure in [`FIGURES`].
    pub figure: usize,
    /// Value in the trajectory; none if it does not tell.
    pub value: Option<f64>,
    /// Value in the runs; none if they do not tell.
    pub normal: Option<Normal>,
}

impl Norm {
    /// The settings of a table that others are held against, for the scene of this key; none if it has none of that scene.
    pub fn of<'a>(rows: impl IntoIterator<Item = &'a CrowdRow>, key: &str) -> Option<Norm> {
        let mut found = vec![None; FIGURES.len()];
        for row in rows.into_iter().filter(|row| row.scene == key && row.standard) {
            let place = FIGURES.iter().position(|figure| figure.0 == row.figure);
            if let (Some(place), Some(mean), Some(error)) = (place, row.mean, row.standard_error) {
                let deviation = error * (row.seeds as f64).sqrt();
                let by = (row.method.clone(), row.dt, row.tolerance);
                found[place] = Some(Normal { mean, deviation, runs: row.seeds, by });
            }
        }
        found.iter().any(Option::is_some).then_some(Norm(found))
    }

    /// A trajectory's figures beside those of the norm.
    pub(super) fn beside(&self, figures: &Figures) -> Vec<Beside> {
        let all = figures.iter().zip(&self.0).enumerate();
        all.map(|(figure, (value, normal))| Beside { figure, value: *value, normal: normal.clone() }).collect()
    }
}

impl Beside {
    /// By how many deviations of one more run the trajectory is from the mean; 0 if by no more than rounding.
    pub fn apart(&self) -> Option<f64> {
        let (value, Normal { mean, deviation, runs, .. }) = (self.value?, self.normal.as_ref()?);
        let apart = (value - mean).abs();
        // a further run differs from a mean of n by its own scatter and that of the mean
        let expected = deviation * (1.0 + 1.0 / *runs as f64).sqrt();
        Some(if apart <= SAME * (value.abs() + mean.abs()) { 0.0 } else { apart / expected })
    }

    /// Whether the trajectory may be one of such runs.
    pub fn agrees(&self) -> Option<bool> {
        self.apart().map(|apart| apart <= DEVIATIONS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(mean: f64, error: f64) -> CrowdRow {
        CrowdRow {
            scene: "heap".into(),
            method: "moreau".into(),
            dt: Some(5e-3),
            tolerance: None,
            runs: 25,
            reached: 10.0,
            figure: "packing".into(),
            unit: String::new(),
            mean: Some(mean),
            standard_error: Some(error),
            seeds: 25,
            standard: true,
            agrees: None,
            agrees_with_half: None,
        }
    }

    #[test]
    fn one_run_may_differ_by_three_deviations_of_a_run_and_not_of_the_mean() {
        let norm = Norm::of(&[row(0.5, 0.01)], "heap").expect("a row");
        let mut figures = [None; FIGURES.len()];
        let place = FIGURES.iter().position(|figure| figure.0 == "packing").expect("a figure");
        // The deviation is 0.01 √25, and with that of the mean √(1 + 1/25) as much.
        for (value, agrees) in
            [(0.5 + 2.99 * 0.05 * 1.04_f64.sqrt(), true), (0.5 + 3.01 * 0.05 * 1.04_f64.sqrt(), false)]
        {
            figures[place] = Some(value);
            let beside = norm.beside(&figures);
            assert_eq!((beside[place].agrees(), beside[0].agrees()), (Some(agrees), None), "{value}");
        }
        assert_eq!(Norm::of(&[row(0.5, 0.01)], "stack"), None);
    }
}
