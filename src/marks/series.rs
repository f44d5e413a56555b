//! An error over time in so many values, however long the file.

/// Values that are kept at most; half of them once they are reached.
const MOST: usize = 1024;

/// The largest error of each of equal numbers of rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Series {
    points: Vec<(f64, f64)>,
    /// Rows that a point stands for, and rows of the last point so far.
    rows: u64,
    last: u64,
}

impl Series {
    /// Enters an error (m) at a time (s).
    pub(super) fn enter(&mut self, time: f64, error: f64) {
        self.rows = self.rows.max(1);
        match self.points.last_mut().filter(|_| self.last < self.rows) {
            Some(point) if point.1 >= error => self.last += 1,
            Some(point) => {
                *point = (time, error);
                self.last += 1;
            }
            None => {
                self.halve();
                self.points.push((time, error));
                self.last = 1;
            }
        }
    }

    fn halve(&mut self) {
        if self.points.len() < MOST {
            return;
        }
        let larger = |pair: &[(f64, f64)]| pair.iter().copied().max_by(|one, other| one.1.total_cmp(&other.1));
        self.points = self.points.chunks(2).filter_map(larger).collect();
        self.rows *= 2;
    }

    /// Points in the order of time: time, s, and largest error of some rows there, m.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// The largest error (m), and when (s).
    pub fn largest(&self) -> (f64, f64) {
        let largest = self.points.iter().copied().max_by(|one, other| one.1.total_cmp(&other.1));
        largest.map_or((0.0, 0.0), |(time, error)| (error, time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_series_keeps_its_largest_values_in_bounded_memory() {
        let mut series = Series::default();
        for k in 0..1_000_000 {
            series.enter(f64::from(k), if k == 123_457 { 7.0 } else { f64::from(k % 10) * 0.1 });
        }
        assert!(series.points().len() <= MOST, "{}", series.points().len());
        assert_eq!(series.largest(), (7.0, 123_457.0));
        assert!(series.points().is_sorted_by(|a, b| a.0 < b.0));
    }
}
