//! The energy and momentum of a trajectory. Energy never rises, since restitutions are at most 1 and forces are constant.

use glam::DVec3;

/// What all spheres have at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Totals {
    /// Energy, J.
    pub(super) energy: f64,
    /// Momentum, kg m/s.
    pub(super) momentum: DVec3,
}

/// What became of the energy and the momentum.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ledger {
    /// Energy at the first row, J.
    pub start: f64,
    /// Energy at the last row, J.
    pub end: f64,
    /// Most that the energy rose above the least before, J.
    pub rise: f64,
    /// Time at which it rose so, s.
    pub rise_time: f64,
    /// Largest |E − E_exact| up to the horizon, J; none against another trajectory.
    pub error: Option<f64>,
    /// Largest |E|, J.
    pub scale: f64,
    /// Momentum of all spheres at the first row, kg m/s.
    pub momentum_start: DVec3,
    /// Momentum of all spheres at the last row, kg m/s.
    pub momentum_end: DVec3,
    /// Largest |p − p_exact| up to the horizon, kg m/s; none against another trajectory.
    pub momentum_error: Option<f64>,
    least: f64,
    rows: u64,
}

impl Ledger {
    /// Enters what there is at a time (s), and what `exact` has if that is known.
    pub(super) fn enter(&mut self, time: f64, Totals { energy, momentum }: Totals, exact: Option<Totals>) {
        if self.rows == 0 {
            (self.start, self.least, self.momentum_start) = (energy, energy, momentum);
        }
        self.momentum_end = momentum;
        self.rows += 1;
        if energy - self.least > self.rise {
            (self.rise, self.rise_time) = (energy - self.least, time);
        }
        self.least = self.least.min(energy);
        self.end = energy;
        self.scale = self.scale.max(energy.abs());
        if let Some(exact) = exact {
            self.error = Some(self.error.unwrap_or(0.0).max((energy - exact.energy).abs()));
            let off = momentum.distance(exact.momentum);
            self.momentum_error = Some(self.momentum_error.unwrap_or(0.0).max(off));
        }
    }
}
