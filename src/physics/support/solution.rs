//! The answer to a complementarity problem, and how good it is, island by island.

use glam::DVec3;

use super::problem::{ROUNDING, Row};

/// How an island was solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Solver {
    /// One contact, in closed form; or one sphere on a few walls, every set of contacts tried.
    Enumeration,
    /// Block principal pivoting on a skyline.
    Pivoting,
    /// Active set on an orthogonal factor.
    ActiveSet,
    /// Projected Gauss–Seidel.
    GaussSeidel,
}

/// What became of one island.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Number of contacts in the island.
    pub contacts: usize,
    /// The solver that gave the answer.
    pub solver: Solver,
    /// Number of the solver's passes, sweeps, or sets tried.
    pub passes: usize,
    /// Largest |min(J u + c, λ A_jj)| over the contacts, in units of u, before rounding was cleared away.
    pub residual: f64,
    /// Whether the residual is no more than rounding. If not, the answer must not be trusted.
    pub converged: bool,
}

/// The solution over all islands.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solution {
    /// The bodies that some contact names, ascending.
    pub bodies: Vec<usize>,
    /// Vectors u of those bodies, m/s or m/s²; exactly 0 where less than rounding was left.
    pub vectors: Vec<DVec3>,
    /// Size below which a component of u is rounding, by body, in units of u.
    pub rounding: Vec<f64>,
    /// Multipliers λ of all contacts, ≥ 0, N s or N.
    pub multipliers: Vec<f64>,
    /// One report per island, in the order of [`islands`](super::islands).
    pub reports: Vec<Report>,
}

impl Solution {
    /// Whether every island converged.
    pub fn converged(&self) -> bool {
        self.reports.iter().all(|report| report.converged)
    }

    /// Largest residual of any island, in units of u.
    pub fn residual(&self) -> f64 {
        self.reports.iter().map(|report| report.residual).fold(0.0, f64::max)
    }

    /// The vector u of `body`, m/s or m/s²; none if no contact names the body.
    pub fn vector(&self, body: usize) -> Option<DVec3> {
        self.place(body).map(|place| self.vectors[place])
    }

    pub(super) fn place(&self, body: usize) -> Option<usize> {
        self.bodies.binary_search(&body).ok()
    }

    /// The opening J u + c of `row`, in units of u; exactly 0 if it is less than rounding.
    pub(super) fn opening(&self, row: &Row) -> f64 {
        let of = |body: usize| self.place(body).map_or((DVec3::ZERO, 0.0), |p| (self.vectors[p], self.rounding[p]));
        let ((u, rounding), (w, more)) = (of(row.a), row.b.map_or((DVec3::ZERO, 0.0), of));
        let opening = row.normal.dot(u - w) + row.offset;
        if opening.abs() <= rounding + more + ROUNDING * row.offset.abs() { 0.0 } else { opening }
    }
}
