//! Solves a complementarity problem island by island, each by the solver that suits it.

use glam::DVec3;

use super::gauss_seidel::{self, PRECISION};
use super::island::islands;
use super::problem::{Problem, ROUNDING, Row};
use super::short::Short;
use super::solution::{Report, Solution, Solver};
use super::{active_set, enumerate, pivoting};

/// Rows up to which an island is solved directly at once: a millisecond. Beyond, sweeping is cheaper where it converges.
const DIRECT_ROWS: usize = 160;

/// Rows up to which an island may be solved directly at all: the cost grows with the cube, to seconds here.
const MOST_DIRECT_ROWS: usize = 1500;

/// Ratio of masses from which sweeping is not tried: it would need about as many sweeps.
const UNLIKE_MASSES: f64 = 1e4;

/// Most sweeps over one island.
const MOST_SWEEPS: usize = 5000;

/// Solves u = `free` + M⁻¹ Jᵀ λ, 0 ≤ λ ⊥ J u + c ≥ 0, island by island.
///
/// `guess` holds a multiplier per row to start from, or is empty. Bounded work; the outcome is in the reports.
/// Deterministic: the bits follow from the arguments alone.
pub fn solve(inverse_mass: &[f64], free: &[DVec3], rows: &[Row], guess: &[f64]) -> Solution {
    by_islands(inverse_mass, free, rows, |problem, at| {
        Part::of(problem, at.iter().map(|&row| guess.get(row).map_or(0.0, |&g| g.max(0.0))).collect())
    })
}

/// Solves as [`solve`] does where the loads of a moment ago, `guess`, are nearly those of now: a step or two of pivoting
/// confirm them. Equal u, but for its last bits.
pub(super) fn solve_from(inverse_mass: &[f64], free: &[DVec3], rows: &[Row], guess: &[f64]) -> Solution {
    by_islands(inverse_mass, free, rows, |problem, at| {
        let guess: Short<f64> = at.iter().map(|&row| guess.get(row).map_or(0.0, |&g| g.max(0.0))).collect();
        Part::pivoted(problem, &guess).unwrap_or_else(|| Part::of(problem, guess.into_vec()))
    })
}

/// Solves every island by `part`, which gets its rows too.
fn by_islands(
    inverse_mass: &[f64],
    free: &[DVec3],
    rows: &[Row],
    part: impl Fn(&Problem, &[usize]) -> Part,
) -> Solution {
    let links: Short<_> = rows.iter().map(|row| (row.a, row.b)).collect();
    let islands = islands(&links);
    let mut solution = Solution { multipliers: vec![0.0; rows.len()], ..Solution::default() };
    let mut bodies: Short<(usize, DVec3, f64)> = Short::new();
    for island in &islands {
        let problem = Problem::new(inverse_mass, free, rows, island);
        let part = part(&problem, &island.contacts);
        for (&row, &multiplier) in island.contacts.iter().zip(&part.multipliers) {
            solution.multipliers[row] = multiplier;
        }
        let (report, rounding) = part.report(&problem);
        solution.reports.push(report);
        for ((&body, u), rounding) in island.bodies.iter().zip(part.u).zip(rounding) {
            bodies.push((body, if u.length() <= rounding { DVec3::ZERO } else { u }, rounding));
        }
    }
    if islands.len() > 1 {
        bodies.sort_unstable_by_key(|&(body, ..)| body);
    }
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
    /// Whether the answer is known to be right to rounding.
    converged: bool,
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
        Part {
            u,
            multipliers: swept.multipliers,
            solver: Solver::GaussSeidel,
            passes: swept.sweeps,
            slack: Vec::new(),
            converged: false,
        }
    }

    /// The answer of one body on some walls.
    fn of_single(problem: &Problem) -> Part {
        let (multipliers, u, passes) = enumerate::solve(problem);
        Part { u: vec![u], multipliers, solver: Solver::Enumeration, passes, slack: Vec::new(), converged: false }
    }

    /// The answer by pivoting, where that ends soon and leaves no more than rounding.
    fn pivoted(problem: &Problem, guess: &[f64]) -> Option<Part> {
        if problem.rows.len() == 1 || problem.free.len() == 1 && problem.rows.len() <= enumerate::LIMIT {
            return None; // closed forms
        }
        let (u, multipliers, passes) = pivoting::solve(problem, guess)?;
        let part = Part { u, multipliers, solver: Solver::Pivoting, passes, slack: Vec::new(), converged: false };
        (part.worst(problem) <= 1.0).then_some(Part { converged: true, ..part })
    }

    /// The answer by the active set; where it does not come to an end, or leaves more than rounding, again with other ideas
    /// of what a dependent contact is, since none suits every set of contacts. The best answer counts.
    fn direct(problem: &Problem, guess: &[f64]) -> Part {
        let of = |guess: &[f64], dependent: f64| {
            let found = active_set::solve(problem, guess, dependent);
            let (u, multipliers, slack) = (found.u, found.multipliers, found.slack);
            Part { u, multipliers, solver: Solver::ActiveSet, passes: found.passes, slack, converged: false }
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

    /// The answer of one pair: λ = max(0, −(J u₀ + c)/A), corrected once for what rounding left.
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
            converged: false,
        }
    }

    /// How good the answer is, and the size of rounding per body.
    fn report(&self, problem: &Problem) -> (Report, Short<f64>) {
        let left = |row: usize| problem.residual(row, &self.u, self.multipliers[row]);
        let residual = (0..self.multipliers.len()).map(left).fold(0.0, f64::max);
        let converged = self.converged || self.worst(problem) <= 1.0;
        let (contacts, solver, passes) = (self.multipliers.len(), self.solver, self.passes);
        let report = Report { contacts, solver, passes, residual, converged };
        let precision = self.precision();
        (report, problem.inverse_mass.iter().map(|w| precision * problem.weight * w.sqrt()).collect())
    }
}
