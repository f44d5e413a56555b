//! Active set with a Cholesky factor: exact up to rounding, at any ratio of masses.
//!
//! Source: Lawson, Hanson, Solving Least Squares Problems, ch. 23 (non-negative least squares), with the offsets of
//! curved contacts added. The contact that closes fastest joins the set of those that hold; those that would have to
//! pull leave it. A contact that depends on the set (a zero pivot: several tiles under one sphere, a pile held more
//! often than it can move) stays out, or takes the place of one that then carries nothing. Every step lowers the dual
//! energy, so that the set never repeats; the passes are bounded all the same.

use super::cholesky::{Append, Factor};
use super::problem::{Problem, ROUNDING};

/// Pivots below this share of the diagonal count as zero. A sphere 1e12 times heavier than what it stands on still
/// has pivots of 1e-12.
const ZERO_PIVOT: f64 = 64.0 * f64::EPSILON;

/// The same while a guessed set is taken over: contacts left out by mistake join later.
const DOUBTFUL_PIVOT: f64 = 1e-10;

/// Weights below this count as no dependence when a contact takes another's place.
const ZERO_WEIGHT: f64 = 1e-9;

/// Multipliers, and how many passes they took. Starts from `guess` (≥ 0).
pub(super) fn solve(problem: &Problem, guess: &[f64]) -> (Vec<f64>, usize) {
    let mut set = ActiveSet::new(problem, guess);
    // Each contact joins and leaves once or twice; far beyond that only rounding is at work.
    let limit = 20 * problem.rows.len() + 50;
    let mut passes = 0;
    while passes < limit {
        let Some(row) = set.closing() else { break };
        set.admit(row);
        passes += 1;
    }
    set.refine();
    (set.multipliers, passes)
}

/// The contacts that hold, and the factor of their part of A.
struct ActiveSet<'a> {
    problem: &'a Problem,
    /// The holding contacts, in the order of the factor's rows.
    holding: Vec<usize>,
    holds: Vec<bool>,
    /// Contacts that rounding has refused since the last progress.
    refused: Vec<bool>,
    factor: Factor,
    multipliers: Vec<f64>,
}

impl ActiveSet<'_> {
    fn new<'a>(problem: &'a Problem, guess: &[f64]) -> ActiveSet<'a> {
        let count = problem.rows.len();
        let mut set = ActiveSet {
            problem,
            holding: Vec::new(),
            holds: vec![false; count],
            refused: vec![false; count],
            factor: Factor::default(),
            multipliers: vec![0.0; count],
        };
        for (row, &multiplier) in guess.iter().enumerate() {
            if multiplier > 0.0 && set.append(row, DOUBTFUL_PIVOT) == Append::Added {
                set.multipliers[row] = multiplier;
            }
        }
        set.settle();
        set
    }

    /// The contact outside the set that closes fastest, beyond rounding; the lowest index of equals.
    fn closing(&self) -> Option<usize> {
        let u = self.problem.response(&self.multipliers);
        let magnitudes = self.problem.magnitudes(&self.multipliers);
        let mut worst: Option<(usize, f64)> = None;
        for row in (0..self.holds.len()).filter(|&row| !self.holds[row] && !self.refused[row]) {
            let opening = self.problem.opening(row, &u);
            let speed = opening / self.problem.diagonal(row).sqrt();
            let beyond = opening < -ROUNDING * self.problem.size(row, &magnitudes);
            if beyond && worst.is_none_or(|(_, fastest)| speed < fastest) {
                worst = Some((row, speed));
            }
        }
        worst.map(|(row, _)| row)
    }

    /// Lets `row` join, in the place of another if it depends on the set.
    fn admit(&mut self, row: usize) {
        if let Append::Dependent(weights) = self.append(row, ZERO_PIVOT)
            && !self.replace(row, &weights)
        {
            self.refused[row] = true;
            return;
        }
        self.settle();
        // A new contact that rounding throws out at once would be chosen again for ever.
        if self.holds[row] {
            self.refused.fill(false);
        } else {
            self.refused[row] = true;
        }
    }

    /// Appends `row` to the factor and the set.
    fn append(&mut self, row: usize, threshold: f64) -> Append {
        let couplings: Vec<f64> = self.holding.iter().map(|&other| self.problem.coupling(row, other)).collect();
        let outcome = self.factor.append(&couplings, self.problem.diagonal(row), threshold);
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
            let share = self.multipliers[self.holding[at]] / weight;
            if weight > ZERO_WEIGHT && first.is_none_or(|(_, least)| share < least) {
                first = Some((at, share));
            }
        }
        let Some((gone, load)) = first else { return false };
        for (&other, weight) in self.holding.iter().zip(weights) {
            self.multipliers[other] = (self.multipliers[other] - weight * load).max(0.0);
        }
        self.drop(gone);
        if self.append(row, ZERO_PIVOT) != Append::Added {
            return false;
        }
        self.multipliers[row] = load;
        true
    }

    /// Drops the contact at this place of the set.
    fn drop(&mut self, at: usize) {
        let row = self.holding.remove(at);
        self.holds[row] = false;
        self.multipliers[row] = 0.0;
        self.factor.remove(at);
    }

    /// Solves A z = −(J u₀ + c) for the set, dropping on the way every contact that would have to pull.
    fn settle(&mut self) {
        while !self.holding.is_empty() {
            let right: Vec<f64> =
                self.holding.iter().map(|&row| -self.problem.opening(row, &self.problem.free)).collect();
            let target = self.factor.solve(&right);
            let Some(step) = self.step(&target) else {
                for (&row, z) in self.holding.iter().zip(target) {
                    self.multipliers[row] = z;
                }
                return;
            };
            for (&row, z) in self.holding.iter().zip(&target) {
                self.multipliers[row] += step.1 * (z - self.multipliers[row]);
            }
            self.multipliers[self.holding[step.0]] = 0.0;
            for at in (0..self.holding.len()).rev() {
                if self.multipliers[self.holding[at]] <= 0.0 {
                    self.drop(at);
                }
            }
        }
    }

    /// The place of the first multiplier to reach 0 on the way to `target`, and the share of the way; none if none does.
    fn step(&self, target: &[f64]) -> Option<(usize, f64)> {
        let mut first: Option<(usize, f64)> = None;
        for (at, (&row, &z)) in self.holding.iter().zip(target).enumerate() {
            let multiplier = self.multipliers[row];
            let share = if multiplier > 0.0 { multiplier / (multiplier - z) } else { 0.0 };
            if z <= 0.0 && first.is_none_or(|(_, least)| share < least) {
                first = Some((at, share));
            }
        }
        first
    }

    /// One step of iterative refinement: takes back what rounding has left on the contacts that hold.
    fn refine(&mut self) {
        let u = self.problem.response(&self.multipliers);
        let left: Vec<f64> = self.holding.iter().map(|&row| -self.problem.opening(row, &u)).collect();
        for (&row, change) in self.holding.iter().zip(self.factor.solve(&left)) {
            self.multipliers[row] = (self.multipliers[row] + change).max(0.0);
        }
    }
}
