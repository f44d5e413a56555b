//! Projected Gauss–Seidel: one row after another, to and fro, warm-started; says when it has not converged.
//!
//! Source: Moreau, Jean; Acary, Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 12.4. Good for large
//! islands of similar masses. Each sweep costs O(rows), but a column of n needs O(n²) sweeps, and a heavy sphere on
//! light ones needs about as many as the ratio of the masses: never trust it without the flag.

use super::problem::Problem;

/// Relative size of the residual at which sweeping stops, about 1e-13.
pub(super) const PRECISION: f64 = 512.0 * f64::EPSILON;

/// How many sweeps between looks at the residual: a look costs as much as two sweeps.
const SWEEPS_PER_LOOK: usize = 8;

/// What the sweeps reached.
#[derive(Debug, Clone)]
pub(super) struct Swept {
    pub(super) multipliers: Vec<f64>,
    pub(super) sweeps: usize,
    pub(super) converged: bool,
}

/// Sweeps from `guess` (multipliers ≥ 0) until every residual is below [`PRECISION`] of its terms, or `limit` sweeps.
pub(super) fn solve(problem: &Problem, guess: Vec<f64>, limit: usize) -> Swept {
    let mut multipliers = guess;
    let diagonal: Vec<f64> = (0..problem.rows.len()).map(|row| problem.diagonal(row)).collect();
    let mut sweeps = 0;
    loop {
        let mut u = problem.response(&multipliers);
        if settled(problem, &multipliers, &u) {
            return Swept { multipliers, sweeps, converged: true };
        }
        if sweeps >= limit {
            return Swept { multipliers, sweeps, converged: false };
        }
        for _ in 0..SWEEPS_PER_LOOK {
            // To and fro: a sweep in one direction would lean every island towards its last contact.
            for (row, &diagonal) in diagonal.iter().enumerate() {
                relax(problem, row, diagonal, &mut multipliers, &mut u);
            }
            for (row, &diagonal) in diagonal.iter().enumerate().rev() {
                relax(problem, row, diagonal, &mut multipliers, &mut u);
            }
            sweeps += 2;
        }
    }
}

/// Solves one row for its multiplier, the others held: λ ← max(0, λ − (J u + c)/A_jj).
fn relax(problem: &Problem, row: usize, diagonal: f64, multipliers: &mut [f64], u: &mut [glam::DVec3]) {
    let old = multipliers[row];
    let new = (old - problem.opening(row, u) / diagonal).max(0.0);
    if new != old {
        multipliers[row] = new;
        problem.push(row, new - old, u);
    }
}

/// Whether every row is complementary to [`PRECISION`].
fn settled(problem: &Problem, multipliers: &[f64], u: &[glam::DVec3]) -> bool {
    (0..multipliers.len()).all(|row| problem.residual(row, u, multipliers[row]) <= PRECISION * problem.size(row))
}
