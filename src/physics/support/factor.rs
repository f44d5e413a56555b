//! An orthogonal factor G = Q R that grows and shrinks by single columns: the working matrix of the active set.
//!
//! R is the Cholesky factor of GᵀG, but found without forming GᵀG, whose condition is the square of G's: piles of
//! unlike masses need those digits. Gram–Schmidt, each column twice ("twice is enough", Parlett; Golub, Van Loan,
//! Matrix Computations, 5.2 and 6.5), and Givens rotations when a column leaves: both backward stable, O(d k) each
//! for k columns of length d.

/// Q, column by column, and the upper triangle R, column by column.
#[derive(Debug, Clone, Default)]
pub(super) struct Factor {
    q: Vec<Vec<f64>>,
    r: Vec<Vec<f64>>,
}

/// What became of a column that was to be appended.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Append {
    /// The factor has grown by it.
    Added,
    /// The column depends on those already there: column = Σ cᵢ columnᵢ with these c. The factor is as before.
    Dependent(Vec<f64>),
}

impl Factor {
    /// Appends a unit column, unless less than `threshold` of it is new.
    pub(super) fn append(&mut self, mut column: Vec<f64>, threshold: f64) -> Append {
        let mut inside = self.project_out(&mut column);
        let rest = self.project_out(&mut column);
        inside.iter_mut().zip(rest).for_each(|(sum, part)| *sum += part);
        let new = dot(&column, &column).sqrt();
        if new <= threshold {
            return Append::Dependent(self.back_substitute(inside));
        }
        column.iter_mut().for_each(|value| *value /= new);
        inside.push(new);
        self.q.push(column);
        self.r.push(inside);
        Append::Added
    }

    /// Removes the column `at`.
    pub(super) fn remove(&mut self, at: usize) {
        self.r.remove(at);
        for row in at..self.r.len() {
            let (x, y) = (self.r[row][row], self.r[row][row + 1]);
            let length = (x * x + y * y).sqrt();
            let (cos, sin) = (x / length, y / length);
            for column in &mut self.r[row..] {
                (column[row], column[row + 1]) = turned(cos, sin, column[row], column[row + 1]);
            }
            self.r[row].truncate(row + 1);
            let (head, tail) = self.q.split_at_mut(row + 1);
            for (x, y) in head[row].iter_mut().zip(&mut tail[0]) {
                (*x, *y) = turned(cos, sin, *x, *y);
            }
        }
        self.q.pop();
    }

    /// Removes from `vector` what lies in the columns' span, and returns its parts along Q.
    pub(super) fn project_out(&self, vector: &mut [f64]) -> Vec<f64> {
        let mut parts: Vec<f64> = Vec::with_capacity(self.q.len() + 1);
        let (quads, others) = self.q.as_chunks::<4>();
        quads.iter().for_each(|quad| parts.extend(dots(quad, vector)));
        parts.extend(others.iter().map(|q| dot(q, vector)));
        let (shares, rest) = parts.as_chunks::<4>();
        for (quad, share) in quads.iter().zip(shares) {
            combined(quad, vector, |value, k, q| value - share[k] * q);
        }
        for (q, part) in others.iter().zip(rest) {
            vector.iter_mut().zip(q).for_each(|(value, q)| *value -= part * q);
        }
        parts
    }

    /// The product Q y.
    pub(super) fn combine(&self, y: &[f64], length: usize) -> Vec<f64> {
        let mut sum = vec![0.0; length];
        let (quads, others) = self.q.as_chunks::<4>();
        let (shares, rest) = y.as_chunks::<4>();
        for (quad, share) in quads.iter().zip(shares) {
            combined(quad, &mut sum, |value, k, q| value + share[k] * q);
        }
        for (q, part) in others.iter().zip(rest) {
            sum.iter_mut().zip(q).for_each(|(value, q)| *value += part * q);
        }
        sum
    }

    /// Solves Rᵀ y = `right`.
    pub(super) fn forward_substitute(&self, right: &[f64]) -> Vec<f64> {
        let mut y: Vec<f64> = Vec::with_capacity(right.len());
        for (column, &value) in self.r.iter().zip(right) {
            let known = dot(&column[..y.len()], &y);
            y.push((value - known) / column[y.len()]);
        }
        y
    }

    /// Solves R z = y.
    pub(super) fn back_substitute(&self, mut y: Vec<f64>) -> Vec<f64> {
        for i in (0..y.len()).rev() {
            let (head, tail) = y.split_at_mut(i);
            tail[0] /= self.r[i][i];
            head.iter_mut().zip(&self.r[i]).for_each(|(z, r)| *z -= r * tail[0]);
        }
        y
    }
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// The products of `vector` with four columns, each summed as [`dot`] does: side by side, none waits for another.
fn dots([p, q, r, s]: &[Vec<f64>; 4], vector: &[f64]) -> [f64; 4] {
    let n = vector.len();
    let (p, q, r, s) = (&p[..n], &q[..n], &r[..n], &s[..n]);
    let mut sums = [dot(&[], &[]); 4];
    for i in 0..n {
        sums[0] += p[i] * vector[i];
        sums[1] += q[i] * vector[i];
        sums[2] += r[i] * vector[i];
        sums[3] += s[i] * vector[i];
    }
    sums
}

/// Changes every value of `vector` by its entries in four columns, one after another.
#[inline]
fn combined([p, q, r, s]: &[Vec<f64>; 4], vector: &mut [f64], by: impl Fn(f64, usize, f64) -> f64) {
    let n = vector.len();
    let (p, q, r, s) = (&p[..n], &q[..n], &r[..n], &s[..n]);
    for i in 0..n {
        vector[i] = by(by(by(by(vector[i], 0, p[i]), 1, q[i]), 2, r[i]), 3, s[i]);
    }
}

fn turned(cos: f64, sin: f64, x: f64, y: f64) -> (f64, f64) {
    (cos * x + sin * y, cos * y - sin * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Column `i` of a well-conditioned 7 × 6 matrix, of unit length.
    fn column(i: usize) -> Vec<f64> {
        let raw: Vec<f64> = (0..7).map(|row| if row == i { 2.5 } else { 1.0 / (1.0 + (i + 2 * row) as f64) }).collect();
        let length = dot(&raw, &raw).sqrt();
        raw.iter().map(|x| x / length).collect()
    }

    fn grown(order: &[usize]) -> Factor {
        let mut factor = Factor::default();
        for &i in order {
            assert_eq!(factor.append(column(i), 1e-12), Append::Added);
        }
        factor
    }

    #[test]
    fn removing_a_column_leaves_the_factor_of_the_rest() {
        for gone in 0..6 {
            let mut factor = grown(&[0, 1, 2, 3, 4, 5]);
            factor.remove(gone);
            let rest: Vec<usize> = (0..6).filter(|&i| i != gone).collect();
            // GᵀG z = right, by R alone.
            let right = [1.0, -2.0, 3.0, 0.5, 4.0];
            let z = factor.back_substitute(factor.forward_substitute(&right));
            for (&i, right) in rest.iter().zip(right) {
                let left: f64 = rest.iter().zip(&z).map(|(&j, z)| dot(&column(i), &column(j)) * z).sum();
                // Five terms of size 10: a few ulp.
                assert!((left - right).abs() < 1e-13, "column {i}: {left} instead of {right}");
            }
            // What is left of a column after projection is rounding.
            let mut inside = column(rest[2]);
            factor.project_out(&mut inside);
            assert!(dot(&inside, &inside).sqrt() < 1e-15);
        }
    }

    #[test]
    fn a_repeated_column_is_named_as_dependent() {
        let mut factor = grown(&[0, 1, 2]);
        let Append::Dependent(weights) = factor.append(column(1), 1e-12) else {
            panic!("the repeated column was added");
        };
        for (weight, expected) in weights.iter().zip([0.0, 1.0, 0.0]) {
            assert!((weight - expected).abs() < 1e-14, "weight {weight} instead of {expected}");
        }
    }
}
