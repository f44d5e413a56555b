//! A set of contacts that might carry one body, and the answer if it does.

use glam::DVec3;

use super::problem::Problem;

/// Pushes in units of u₀ from which on they are computed closely: they have lost four digits.
const SQUEEZED: f64 = 1e4;

/// A set of contacts that might carry the body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    pub(super) u: DVec3,
    /// Row and push m λ, in units of u; a row may stand several times.
    pub(super) pushes: [(usize, f64); 3],
}

impl Candidate {
    /// Whether the contacts push so much harder than u₀ asks that plain formulas have lost digits of the pushes.
    pub(super) fn squeezes(&self, problem: &Problem) -> bool {
        self.pushes.iter().any(|(_, push)| push.abs() > SQUEEZED * problem.free[0].length())
    }
}

/// The answer if one contact carries: u keeps its tangential part. Corrected once, so that n·u + c is 0 to the last digit.
pub(super) fn one(problem: &Problem, i: usize) -> (DVec3, [(usize, f64); 3]) {
    let (free, row) = (problem.free[0], &problem.rows[i]);
    let push = -(row.normal.dot(free) + row.offset);
    let u = free + row.normal * push;
    let u = u - row.normal * (row.normal.dot(u) + row.offset);
    (u, [(i, push), (i, 0.0), (i, 0.0)])
}
