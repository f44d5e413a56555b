//! The energy of a trajectory: it never rises, since restitutions are at most 1 and forces are constant.

/// What became of the energy.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ledger {
    /// At the first row, J.
    pub start: f64,
    /// At the last row, J.
    pub end: f64,
    /// By how much it rose above the least before, at most, J.
    pub rise: f64,
    /// When it did, s.
    pub rise_time: f64,
    /// Largest |E − E_exact| up to the horizon, J; none against another trajectory.
    pub error: Option<f64>,
    /// Largest |E|, J.
    pub scale: f64,
    least: f64,
    rows: u64,
}

impl Ledger {
    /// Enters the energy (J) at a time (s), and that of `exact` if it is known.
    pub(super) fn enter(&mut self, time: f64, energy: f64, exact: Option<f64>) {
        if self.rows == 0 {
            (self.start, self.least) = (energy, energy);
        }
        self.rows += 1;
        if energy - self.least > self.rise {
            (self.rise, self.rise_time) = (energy - self.least, time);
        }
        self.least = self.least.min(energy);
        self.end = energy;
        self.scale = self.scale.max(energy.abs());
        if let Some(exact) = exact {
            self.error = Some(self.error.unwrap_or(0.0).max((energy - exact).abs()));
        }
    }
}
