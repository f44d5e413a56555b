//! One island as a complementarity problem in local indices.
//!
//! Unknowns are a vector u per body (velocity or acceleration) and a multiplier λ per row:
//! u = u₀ + M⁻¹ Jᵀ λ, 0 ≤ λ ⊥ J u + c ≥ 0. A row of J is +n for body `a` and −n for body `b`.
//! u is unique (a projection in the metric of the masses); λ need not be.

use glam::DVec3;

use super::island::Island;
use super::short::Short;

/// Relative size below which what is left of cancelling terms counts as rounding: 64 ulp. A pile's sphere has at most
/// twelve neighbours, each of three products; smaller and noise reads as motion, larger and slow releases are missed.
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// What velocities are scaled up by where their squares would underflow: an even power of two, so that it rounds nothing.
const HUGE: f64 = f64::from_bits((1023 + 900) << 52);

/// Numbers below this have lost digits, or lose them in the next product: they count as 0.
const FAINTEST: f64 = f64::MIN_POSITIVE / f64::EPSILON;

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

/// One island's problem.
#[derive(Debug, Clone)]
pub(super) struct Problem {
    pub(super) inverse_mass: Short<f64>,
    pub(super) free: Short<DVec3>,
    /// In local indices.
    pub(super) rows: Short<Row>,
    /// √(Σ m u₀²): every projection is smaller, so rounding of a body's u is this times ulp/√m.
    pub(super) weight: f64,
}

impl Problem {
    /// The part of the whole problem that concerns `island`.
    pub(super) fn new(inverse_mass: &[f64], free: &[DVec3], rows: &[Row], island: &Island) -> Problem {
        let local = |body: usize| island.bodies.partition_point(|&other| other < body);
        let rows = island.contacts.iter().map(|&index| {
            let row = rows[index];
            Row { a: local(row.a), b: row.b.map(local), normal: row.normal, offset: row.offset }
        });
        let seen = |body: usize| {
            let faint = |part: f64| if part.abs() < FAINTEST { 0.0 } else { part };
            DVec3::from_array(free[body].to_array().map(faint))
        };
        let sum = |scale: f64| -> f64 {
            island.bodies.iter().map(|&body| (seen(body) * scale).length_squared() / inverse_mass[body]).sum()
        };
        let weight = match sum(1.0) {
            // velocities that a collapse has left may be too small for f64 to square
            squares if squares < f64::MIN_POSITIVE / f64::EPSILON => sum(HUGE).sqrt() / HUGE,
            squares => squares.sqrt(),
        };
        Problem {
            rows: rows.collect(),
            inverse_mass: island.bodies.iter().map(|&body| inverse_mass[body]).collect(),
            free: island.bodies.iter().map(|&body| seen(body)).collect(),
            weight,
        }
    }

    /// u = u₀ + M⁻¹ Jᵀ λ. Forces are summed before u₀ is added: of two forces of 1e9 N that cancel, the difference is
    /// exact, while u₀ between them would lose its last seven digits.
    pub(super) fn response(&self, multipliers: &[f64]) -> Vec<DVec3> {
        let mut force = vec![DVec3::ZERO; self.free.len()];
        for (row, &multiplier) in self.rows.iter().zip(multipliers) {
            force[row.a] += row.normal * multiplier;
            if let Some(b) = row.b {
                force[b] -= row.normal * multiplier;
            }
        }
        (0..force.len()).map(|body| self.free[body] + force[body] * self.inverse_mass[body]).collect()
    }

    /// (J u + c) of one row: how fast that contact opens.
    pub(super) fn opening(&self, row: usize, u: &[DVec3]) -> f64 {
        let row = &self.rows[row];
        let relative = u[row.a] - row.b.map_or(DVec3::ZERO, |b| u[b]);
        row.normal.dot(relative) + row.offset
    }

    /// Size of the terms of [`Problem::opening`]: what its rounding is relative to.
    pub(super) fn size(&self, row: usize) -> f64 {
        self.weight * self.diagonal(row).sqrt() + self.rows[row].offset.abs()
    }

    /// A diagonal element of A = J M⁻¹ Jᵀ for unit normals.
    pub(super) fn diagonal(&self, row: usize) -> f64 {
        let row = &self.rows[row];
        (self.inverse_mass[row.a] + row.b.map_or(0.0, |b| self.inverse_mass[b])) * row.normal.length_squared()
    }

    /// Moves u by the multiplier of one row changing by `change`.
    pub(super) fn push(&self, row: usize, change: f64, u: &mut [DVec3]) {
        let row = &self.rows[row];
        u[row.a] += row.normal * (change * self.inverse_mass[row.a]);
        if let Some(b) = row.b {
            u[b] -= row.normal * (change * self.inverse_mass[b]);
        }
    }

    /// How far a row is from complementarity, |min(J u + c, λ A_jj)|, in units of u.
    pub(super) fn residual(&self, row: usize, u: &[DVec3], multiplier: f64) -> f64 {
        self.opening(row, u).min(multiplier * self.diagonal(row)).abs()
    }

    /// Largest ratio of two masses.
    pub(super) fn mass_ratio(&self) -> f64 {
        let largest = self.inverse_mass.iter().copied().fold(0.0, f64::max);
        largest / self.inverse_mass.iter().copied().fold(f64::INFINITY, f64::min)
    }
}
