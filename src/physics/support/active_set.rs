//! Active set on an orthogonal factor: exact up to rounding, at any ratio of masses.
//!
//! Source: Lawson, Hanson, Solving Least Squares Problems, ch. 23 (non-negative least squares), with the offsets of
//! curved contacts added. Everything is weighted by √m: w = M^½ u₀, and a row's column is g = M^−½ Jᵀ / √A_jj, a unit
//! vector; then u is the projection of w onto {gⱼ·u + cⱼ ≥ 0}, and comes from Q without the detour of the multipliers,
//! which among unlike masses cancel in their last digits.
//!
//! The contact that closes fastest joins the set of those that hold; those that would have to pull leave it. A contact
//! that depends on the set (several tiles under one sphere, a pile held more often than it can move) stays out, or
//! takes the place of one that then carries nothing. Every step lowers the dual energy, so that the set never repeats;
//! the passes are bounded all the same.

use glam::DVec3;

use super::factor::{Append, Factor};
use super::problem::{Problem, ROUNDING};

/// A column of which less than this is new depends on the others: rounding makes 1e-16 of it, times the condition of
/// the set. What a sphere 1e12 times heavier than the one below it adds is 1e-6.
pub(super) const DEPENDENT: f64 = 1e-11;

/// Other shares than [`DEPENDENT`], where that one finds no answer: normals that differ by 1e-12 rad are told apart in the
/// end, or are not.
pub(super) const OTHERWISE_DEPENDENT: [f64; 4] = [1e-13, 1e-9, 1e-14, 1e-7];

/// Share of a column that must be new while a guessed set is taken over: contacts left out by mistake join later.
const DOUBTFUL: f64 = 1e-6;

/// Weights below this count as no dependence when a contact takes another's place.
const ZERO_WEIGHT: f64 = 1e-9;

/// What the active set found.
#[derive(Debug, Clone)]
pub(super) struct Found {
    pub(super) u: Vec<DVec3>,
    pub(super) multipliers: Vec<f64>,
    pub(super) passes: usize,
    /// How many times more rounding than its own each row has to bear.
    pub(super) slack: Vec<f64>,
}

/// Solves the problem from the multipliers `guess` (≥ 0); columns depend on others of which less than `dependent` is new.
pub(super) fn solve(problem: &Problem, guess: &[f64], dependent: f64) -> Found {
    let mut set = ActiveSet::new(problem, guess, dependent);
    // Each contact joins and leaves once or twice; far beyond that only rounding is at work.
    let limit = 20 * problem.rows.len() + 50;
    let mut passes = 0;
    while passes < limit {
        let Some(row) = set.closing() else { break };
        set.admit(row);
        passes += 1;
    }
    Found { u: set.velocities(), multipliers: set.forces(), passes, slack: set.slack }
}

/// The contacts that hold, and the factor of their columns.
struct ActiveSet<'a> {
    problem: &'a Problem,
    /// The threshold of dependence.
    dependent: f64,
    /// √A_jj of every row.
    lengths: Vec<f64>,
    /// The non-zero entries of every row's column: body, entry.
    columns: Vec<[(usize, DVec3); 2]>,
    /// Weighted opening of each row that is no more than rounding.
    rounding: Vec<f64>,
    /// The holding contacts, in the order of the factor's columns.
    holding: Vec<usize>,
    holds: Vec<bool>,
    /// Contacts that rounding has refused since the last progress.
    refused: Vec<bool>,
    /// Rounding of each row in units of its own: 1; of a refused row = Σ cᵢ rowᵢ, 1 + Σ |cᵢ|: it inherits the rounding of
    /// the rows that it depends on.
    slack: Vec<f64>,
    factor: Factor,
    /// Scaled multipliers λ √A_jj, by row.
    loads: Vec<f64>,
    /// The vector w, three numbers per body.
    free: Vec<f64>,
    /// The projection of w for the set as it is, three numbers per body.
    u: Vec<f64>,
}

impl ActiveSet<'_> {
    fn new<'a>(problem: &'a Problem, guess: &[f64], dependent: f64) -> ActiveSet<'a> {
        let count = problem.rows.len();
        let weighted = |(u, w): (&DVec3, &f64)| (*u / w.sqrt()).to_array();
        let free: Vec<f64> = problem.free.iter().zip(&problem.inverse_mass).flat_map(weighted).collect();
        let lengths: Vec<f64> = (0..count).map(|row| problem.diagonal(row).sqrt()).collect();
        let mut set = ActiveSet {
            problem,
            dependent,
            columns: (0..count).map(|row| column(problem, row, lengths[row])).collect(),
            rounding: (0..count).map(|row| ROUNDING * problem.size(row) / lengths[row]).collect(),
            lengths,
            holding: Vec::new(),
            holds: vec![false; count],
            refused: vec![false; count],
            slack: vec![1.0; count],
            factor: Factor::default(),
            loads: vec![0.0; count],
            u: free.clone(),
            free,
        };
        for (row, &multiplier) in guess.iter().enumerate() {
            if multiplier > 0.0 && set.append(row, dependent.max(DOUBTFUL)) == Append::Added {
                set.loads[row] = multiplier * set.lengths[row];
            }
        }
        set.settle();
        set
    }

    /// The opening g·u + c of a row, weighted.
    fn opening(&self, row: usize, u: &[f64]) -> f64 {
        let at = |body: usize| DVec3::from_slice(&u[3 * body..]);
        let [p, q] = self.columns[row];
        p.1.dot(at(p.0)) + q.1.dot(at(q.0)) + self.problem.rows[row].offset / self.lengths[row]
    }

    /// The contact outside the set that closes fastest, beyond rounding; the lowest index of equals.
    fn closing(&self) -> Option<usize> {
        let mut worst: Option<(usize, f64)> = None;
        for row in (0..self.holds.len()).filter(|&row| !self.holds[row] && !self.refused[row]) {
            let opening = self.opening(row, &self.u);
            if opening < -self.rounding[row] && worst.is_none_or(|(_, fastest)| opening < fastest) {
                worst = Some((row, opening));
            }
        }
        worst.map(|(row, _)| row)
    }

    /// Lets `row` join, in the place of another if it depends on the set by more than rounding.
    fn admit(&mut self, row: usize) {
        if let Append::Dependent(weights) = self.append(row, self.dependent) {
            let slack = 1.0 + weights.iter().map(|weight| weight.abs()).sum::<f64>();
            let rounding = self.rounding[row] * slack;
            let size = self.holding.len();
            if self.opening(row, &self.u) >= -rounding || !self.replace(row, &weights) {
                self.refused[row] = true;
                self.slack[row] = slack;
                // one has left, and none has come in its place: the loads are for the others
                if self.holding.len() < size {
                    self.settle();
                }
                return;
            }
        }
        self.settle();
        // A new contact that rounding throws out at once would be chosen again for ever.
        if self.holds[row] {
            self.refused.fill(false);
            self.slack.fill(1.0);
        } else {
            self.refused[row] = true;
        }
    }

    /// Appends `row` to the factor and the set.
    fn append(&mut self, row: usize, threshold: f64) -> Append {
        let mut column = vec![0.0; self.free.len()];
        for (body, part) in self.columns[row] {
            column[3 * body..3 * body + 3].iter_mut().zip(part.to_array()).for_each(|(sum, part)| *sum += part);
        }
        let outcome = self.factor.append(column, threshold);
        if outcome == Append::Added {
            self.holding.push(row);
            self.holds[row] = true;
        }
        outcome
    }

    /// Shifts load to the dependent `row` = Σ cᵢ rowᵢ until one of the set carries nothing, and puts `row` in its
    /// place. False if there is none.
    fn replace(&mut self, row: usize, weights: &[f64]) -> bool {
        let mut first: Option<(usize, f64)> = None;
        for (at, &weight) in weights.iter().enumerate() {
            let share = self.loads[self.holding[at]] / weight;
            if weight > ZERO_WEIGHT && first.is_none_or(|(_, least)| share < least) {
                first = Some((at, share));
            }
        }
        let Some((gone, load)) = first else { return false };
        for (&other, weight) in self.holding.iter().zip(weights) {
            self.loads[other] = (self.loads[other] - weight * load).max(0.0);
        }
        self.drop(gone);
        if self.append(row, self.dependent) != Append::Added {
            return false;
        }
        self.loads[row] = load;
        true
    }

    /// Drops the contact at this place of the set.
    fn drop(&mut self, at: usize) {
        let row = self.holding.remove(at);
        self.holds[row] = false;
        self.loads[row] = 0.0;
        self.factor.remove(at);
    }

    /// Projects w onto the set, dropping on the way every contact that would have to pull.
    fn settle(&mut self) {
        loop {
            let target = self.project();
            let Some((last, share)) = self.step(&target) else {
                for (&row, z) in self.holding.iter().zip(target) {
                    self.loads[row] = z;
                }
                return;
            };
            for (&row, z) in self.holding.iter().zip(&target) {
                self.loads[row] += share * (z - self.loads[row]);
            }
            self.loads[self.holding[last]] = 0.0;
            for at in (0..self.holding.len()).rev() {
                if self.loads[self.holding[at]] <= 0.0 {
                    self.drop(at);
                }
            }
        }
    }

    /// Sets u = w − Q (Qᵀ w + y) with Rᵀ y = c, and returns the loads z = −R⁻¹ (Qᵀ w + y) that do it.
    fn project(&mut self) -> Vec<f64> {
        let offsets: Vec<f64> =
            self.holding.iter().map(|&row| self.problem.rows[row].offset / self.lengths[row]).collect();
        let y = self.factor.forward_substitute(&offsets);
        let mut across = self.free.clone();
        let parts = self.factor.project_out(&mut across);
        self.factor.project_out(&mut across);
        self.u = self.factor.combine(&y, across.len());
        self.u.iter_mut().zip(across).for_each(|(u, across)| *u = across - *u);
        self.factor.back_substitute(parts.iter().zip(y).map(|(part, y)| -(part + y)).collect())
    }

    /// The place of the first load to reach 0 on the way to `target`, and the share of the way; none if none does.
    fn step(&self, target: &[f64]) -> Option<(usize, f64)> {
        let mut first: Option<(usize, f64)> = None;
        for (at, (&row, &z)) in self.holding.iter().zip(target).enumerate() {
            let load = self.loads[row];
            let share = if load > 0.0 { load / (load - z) } else { 0.0 };
            if z <= 0.0 && first.is_none_or(|(_, least)| share < least) {
                first = Some((at, share));
            }
        }
        first
    }

    /// The vectors u by body, unweighted.
    fn velocities(&self) -> Vec<DVec3> {
        let weights = self.problem.inverse_mass.iter();
        self.u.chunks_exact(3).zip(weights).map(|(u, w)| DVec3::from_slice(u) * w.sqrt()).collect()
    }

    /// The multipliers λ by row, unweighted.
    fn forces(&self) -> Vec<f64> {
        self.loads.iter().zip(&self.lengths).map(|(load, length)| load / length).collect()
    }
}

/// The non-zero entries of a row's column, which is this long before it is scaled: body, entry.
fn column(problem: &Problem, row: usize, length: f64) -> [(usize, DVec3); 2] {
    let row = &problem.rows[row];
    let part = |body: usize| row.normal * (problem.inverse_mass[body].sqrt() / length);
    [(row.a, part(row.a)), row.b.map_or((row.a, DVec3::ZERO), |b| (b, -part(b)))]
}
