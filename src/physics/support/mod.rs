//! What holds resting spheres up: the two complementarity problems of an island of resting contacts.
//!
//! With A = J M⁻¹ Jᵀ, per island (Acary, Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, ch. 3 and 12):
//! velocity v⁺ = v + M⁻¹ Jᵀ Λ, 0 ≤ Λ ⊥ J v⁺ ≥ 0; then, for the contacts with J v⁺ = 0 alone, acceleration
//! a = a_applied + M⁻¹ Jᵀ λ, 0 ≤ λ ⊥ J a + k ≥ 0, where k is what the curvature of the contact adds to the second
//! derivative of its gap. No friction. v⁺ and a are unique; Λ and λ are not where contacts are redundant.
//!
//! One contact: closed form. One sphere on few walls: enumeration. Small islands, and those of unlike masses: active set.
//! Large islands of like masses: projected Gauss–Seidel, and the active set if that has not converged.
//!
//! Plain data in, plain data out; nothing here knows of scenes, walls or time.

mod active_set;
mod bind;
mod closely;
mod enumerate;
mod factor;
mod gauss_seidel;
mod hold;
mod island;
mod problem;

pub use bind::{bind, restore};
pub use hold::{Bodies, Fate, Held, Resting, Surface, accelerations, hold, velocities};
pub use island::{Island, islands};

use glam::DVec3;

use gauss_seidel::PRECISION;
use problem::{Problem, ROUNDING};

/// Rows up to which an island is solved directly at once: a millisecond. Beyond, sweeping is cheaper where it converges.
const DIRECT_ROWS: usize = 160;

/// Rows up to which an island may be solved directly at all: the cost grows with the cube, to seconds here.
const MOST_DIRECT_ROWS: usize = 1500;

/// Ratio of masses from which sweeping is not tried: it would need about as many sweeps.
const UNLIKE_MASSES: f64 = 1e4;

/// Most sweeps over one island.
const MOST_SWEEPS: usize = 5000;

/// One row of J and its offset c: contact `a` on `b` (or on a wall).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The sphere.
    pub a: usize,
    /// The other sphere; none for a wall.
    pub b: Option<usize>,
    /// Unit normal, from `b` (or the wall) to `a`.
    pub normal: DVec3,
    /// c in J u + c ≥ 0, in units of u (m/s or m/s²).
    pub offset: f64,
}

/// How an island was solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Solver {
    /// One contact, in closed form; or one sphere on a few walls, every set of contacts tried.
    Enumeration,
    /// Active set on an orthogonal factor.
    ActiveSet,
    /// Projected Gauss–Seidel.
    GaussSeidel,
}

/// What became of one island.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Contacts in the island.
    pub contacts: usize,
    /// The solver that gave the answer.
    pub solver: Solver,
    /// Its passes, sweeps, or sets tried.
    pub passes: usize,
    /// Largest |min(J u + c, λ A_jj)| over the contacts, in units of u, before rounding was cleared away.
    pub residual: f64,
    /// Whether that is no more than rounding. If not, the answer must not be trusted.
    pub converged: bool,
}

/// The solution over all islands.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Solution {
    /// The bodies that some contact names, ascending.
    pub bodies: Vec<usize>,
    /// u of those bodies, m/s or m/s²; exactly 0 where less than rounding was left.
    pub vectors: Vec<DVec3>,
    /// Of those bodies, the size below which a component of u is rounding.
    pub rounding: Vec<f64>,
    /// λ of every contact, ≥ 0, N s or N.
    pub multipliers: Vec<f64>,
    /// One report per island, in the order of [`islands`].
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

    /// u of `body`; none if no contact names it.
    pub fn vector(&self, body: usize) -> Option<DVec3> {
        self.place(body).map(|place| self.vectors[place])
    }

    fn place(&self, body: usize) -> Option<usize> {
        self.bodies.binary_search(&body).ok()
    }

    /// J u + c of `row`, exactly 0 if it is less than rounding.
    fn opening(&self, row: &Row) -> f64 {
        let of = |body: usize| self.place(body).map_or((DVec3::ZERO, 0.0), |p| (self.vectors[p], self.rounding[p]));
        let ((u, rounding), (w, more)) = (of(row.a), row.b.map_or((DVec3::ZERO, 0.0), of));
        let opening = row.normal.dot(u - w) + row.offset;
        if opening.abs() <= rounding + more + ROUNDING * row.offset.abs() { 0.0 } else { opening }
    }
}

/// Solves u = `free` + M⁻¹ Jᵀ λ, 0 ≤ λ ⊥ J u + c ≥ 0, island by island.
///
/// `guess` holds a multiplier per row to start from, or is empty. Bounded work; the outcome is in the reports.
/// Deterministic: the bits follow from the arguments alone.
pub fn solve(inverse_mass: &[f64], free: &[DVec3], rows: &[Row], guess: &[f64]) -> Solution {
    let links: Vec<_> = rows.iter().map(|row| (row.a, row.b)).collect();
    let islands = islands(&links);
    let mut solution = Solution { multipliers: vec![0.0; rows.len()], ..Solution::default() };
    let mut bodies: Vec<(usize, DVec3, f64)> = Vec::new();
    for island in &islands {
        let problem = Problem::new(inverse_mass, free, rows, island);
        let start = island.contacts.iter().map(|&row| guess.get(row).map_or(0.0, |&g| g.max(0.0))).collect();
        let part = Part::of(&problem, start);
        for (&row, &multiplier) in island.contacts.iter().zip(&part.multipliers) {
            solution.multipliers[row] = multiplier;
        }
        let (report, rounding) = part.report(&problem);
        solution.reports.push(report);
        for ((&body, u), rounding) in island.bodies.iter().zip(part.u).zip(rounding) {
            bodies.push((body, if u.length() <= rounding { DVec3::ZERO } else { u }, rounding));
        }
    }
    bodies.sort_unstable_by_key(|&(body, ..)| body);
    solution.bodies = bodies.iter().map(|entry| entry.0).collect();
    solution.vectors = bodies.iter().map(|entry| entry.1).collect();
    solution.rounding = bodies.iter().map(|entry| entry.2).collect();
    solution
}

/// One island's answer.
struct Part {
    u: Vec<DVec3>,
    multipliers: Vec<f64>,
    solver: Solver,
    passes: usize,
    /// By how much a row's rounding may exceed its own; empty: by nothing.
    slack: Vec<f64>,
}

impl Part {
    /// Chooses the solver by the island's size and masses.
    fn of(problem: &Problem, guess: Vec<f64>) -> Part {
        let (count, single) = (problem.rows.len(), problem.free.len() == 1);
        if single && count <= enumerate::LIMIT {
            return Part::of_single(problem);
        }
        if count == 1 {
            return Part::of_one(problem);
        }
        if count <= DIRECT_ROWS || (problem.mass_ratio() >= UNLIKE_MASSES && count <= MOST_DIRECT_ROWS) {
            let found = Part::direct(problem, &guess);
            let last = single && count <= enumerate::LAST_RESORT && found.worst(problem) > 1.0;
            return if last { found.or(Part::of_single(problem), problem) } else { found };
        }
        let swept = gauss_seidel::solve(problem, guess, MOST_SWEEPS);
        if !swept.converged && count <= MOST_DIRECT_ROWS {
            return Part::direct(problem, &swept.multipliers);
        }
        let u = problem.response(&swept.multipliers);
        Part { u, multipliers: swept.multipliers, solver: Solver::GaussSeidel, passes: swept.sweeps, slack: Vec::new() }
    }

    /// One body on some walls.
    fn of_single(problem: &Problem) -> Part {
        let (multipliers, u, passes) = enumerate::solve(problem);
        Part { u: vec![u], multipliers, solver: Solver::Enumeration, passes, slack: Vec::new() }
    }

    /// The active set; where it does not come to an end, or leaves more than rounding, again with other ideas of what a
    /// dependent contact is, since none suits every set of contacts. The best answer counts.
    fn direct(problem: &Problem, guess: &[f64]) -> Part {
        let of = |guess: &[f64], dependent: f64| {
            let found = active_set::solve(problem, guess, dependent);
            let (u, multipliers, slack) = (found.u, found.multipliers, found.slack);
            Part { u, multipliers, solver: Solver::ActiveSet, passes: found.passes, slack }
        };
        let mut best = of(guess, active_set::DEPENDENT);
        for dependent in active_set::OTHERWISE_DEPENDENT {
            if best.worst(problem) <= 1.0 {
                break;
            }
            best = best.or(of(&[], dependent), problem);
        }
        best
    }

    /// The better one of two answers.
    fn or(self, other: Part, problem: &Problem) -> Part {
        let passes = self.passes + other.passes;
        let better = if other.worst(problem) < self.worst(problem) { other } else { self };
        Part { passes, ..better }
    }

    /// The worst row's distance from complementarity, in units of what rounding may leave.
    fn worst(&self, problem: &Problem) -> f64 {
        if !self.u.iter().all(|u| u.is_finite()) {
            return f64::INFINITY;
        }
        let of = |row: usize| {
            let allowed = self.precision() * problem.size(row) * self.slack.get(row).copied().unwrap_or(1.0);
            let left = problem.residual(row, &self.u, self.multipliers[row]);
            if left <= allowed { 0.0 } else { left / allowed }
        };
        (0..self.multipliers.len()).map(of).fold(0.0, f64::max)
    }

    /// Relative size of what is left at best.
    fn precision(&self) -> f64 {
        if self.solver == Solver::GaussSeidel { 2.0 * PRECISION } else { 2.0 * ROUNDING }
    }

    /// One pair: λ = max(0, −(J u₀ + c)/A), corrected once for what rounding left.
    fn of_one(problem: &Problem) -> Part {
        let mut multipliers = vec![0.0];
        for _ in 0..2 {
            let opening = problem.opening(0, &problem.response(&multipliers));
            multipliers[0] = (multipliers[0] - opening / problem.diagonal(0)).max(0.0);
        }
        Part {
            u: problem.response(&multipliers),
            multipliers,
            solver: Solver::Enumeration,
            passes: 1,
            slack: Vec::new(),
        }
    }

    /// How good the answer is, and the size of rounding per body.
    fn report(&self, problem: &Problem) -> (Report, Vec<f64>) {
        let left = |row: usize| problem.residual(row, &self.u, self.multipliers[row]);
        let residual = (0..self.multipliers.len()).map(left).fold(0.0, f64::max);
        let converged = self.worst(problem) <= 1.0;
        let (contacts, solver, passes) = (self.multipliers.len(), self.solver, self.passes);
        let report = Report { contacts, solver, passes, residual, converged };
        let precision = self.precision();
        (report, problem.inverse_mass.iter().map(|w| precision * problem.weight * w.sqrt()).collect())
    }
}

#[cfg(test)]
mod agreement;
