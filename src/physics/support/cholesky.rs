//! A Cholesky factor A = L Lᵀ that grows and shrinks by single rows: the working matrix of the active set.
//!
//! Growing costs O(k²), shrinking O(k²) by Givens rotations, both backward stable (Golub, Van Loan, Matrix
//! Computations, 6.5), so a change of the active set never costs a new O(k³) factorisation.

/// The lower triangle L, row by row.
#[derive(Debug, Clone, Default)]
pub(super) struct Factor {
    rows: Vec<Vec<f64>>,
}

/// What became of a row that was to be appended.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Append {
    /// The factor has grown by it.
    Added,
    /// It depends on the rows already there: row = Σ cᵢ rowᵢ with these c. The factor is as before.
    Dependent(Vec<f64>),
}

impl Factor {
    /// Appends the row (`couplings` to the rows there, then `diagonal`), unless its pivot is below
    /// `threshold` · `diagonal`.
    pub(super) fn append(&mut self, couplings: &[f64], diagonal: f64, threshold: f64) -> Append {
        let mut row = self.forward(couplings);
        let pivot = diagonal - row.iter().map(|l| l * l).sum::<f64>();
        if pivot <= threshold * diagonal {
            return Append::Dependent(self.backward(row));
        }
        row.push(pivot.sqrt());
        self.rows.push(row);
        Append::Added
    }

    /// Removes row and column `at`.
    pub(super) fn remove(&mut self, at: usize) {
        self.rows.remove(at);
        for column in at..self.rows.len() {
            let (x, y) = (self.rows[column][column], self.rows[column][column + 1]);
            let length = (x * x + y * y).sqrt();
            let (cos, sin) = (x / length, y / length);
            for row in &mut self.rows[column..] {
                let (x, y) = (row[column], row[column + 1]);
                row[column] = cos * x + sin * y;
                row[column + 1] = cos * y - sin * x;
            }
            self.rows[column].truncate(column + 1);
        }
    }

    /// The solution of A z = `right`.
    pub(super) fn solve(&self, right: &[f64]) -> Vec<f64> {
        self.backward(self.forward(right))
    }

    /// Solves L y = `right`.
    fn forward(&self, right: &[f64]) -> Vec<f64> {
        let mut y: Vec<f64> = Vec::with_capacity(right.len() + 1);
        for (row, &value) in self.rows.iter().zip(right) {
            let known: f64 = row.iter().zip(&y).map(|(l, y)| l * y).sum();
            y.push((value - known) / row[y.len()]);
        }
        y
    }

    /// Solves Lᵀ z = y.
    fn backward(&self, mut y: Vec<f64>) -> Vec<f64> {
        for i in (0..y.len()).rev() {
            let (head, tail) = y.split_at_mut(i);
            tail[0] /= self.rows[i][i];
            for (z, l) in head.iter_mut().zip(&self.rows[i]) {
                *z -= l * tail[0];
            }
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A positive definite matrix: the Laplacian of a chain with some extra weight.
    fn element(i: usize, j: usize) -> f64 {
        if i == j { 2.5 + i as f64 } else { -1.0 / (1.0 + i.abs_diff(j) as f64) }
    }

    fn grown(order: &[usize]) -> Factor {
        let mut factor = Factor::default();
        for (count, &i) in order.iter().enumerate() {
            let couplings: Vec<f64> = order[..count].iter().map(|&j| element(i, j)).collect();
            assert_eq!(factor.append(&couplings, element(i, i), 1e-12), Append::Added);
        }
        factor
    }

    #[test]
    fn removing_a_row_leaves_the_factor_of_the_rest() {
        for gone in 0..6 {
            let mut factor = grown(&[0, 1, 2, 3, 4, 5]);
            factor.remove(gone);
            let rest: Vec<usize> = (0..6).filter(|&i| i != gone).collect();
            let z = factor.solve(&[1.0, -2.0, 3.0, 0.5, 4.0]);
            for (row, right) in rest.iter().zip([1.0, -2.0, 3.0, 0.5, 4.0]) {
                let left: f64 = rest.iter().zip(&z).map(|(&j, z)| element(*row, j) * z).sum();
                // Five terms of size 10: a few ulp.
                assert!((left - right).abs() < 1e-14, "row {row}: {left} instead of {right}");
            }
        }
    }

    #[test]
    fn a_repeated_row_is_named_as_dependent() {
        let mut factor = grown(&[0, 1, 2]);
        let couplings: Vec<f64> = (0..3).map(|j| element(1, j)).collect();
        let Append::Dependent(weights) = factor.append(&couplings, element(1, 1), 1e-12) else {
            panic!("the repeated row was added");
        };
        for (weight, expected) in weights.iter().zip([0.0, 1.0, 0.0]) {
            assert!((weight - expected).abs() < 1e-14, "weight {weight} instead of {expected}");
        }
    }
}
