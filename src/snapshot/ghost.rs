//! Where the exact run is.

use glam::DVec3;

/// The exact run of the same scene beside a run, at a moment that both have reached.
#[derive(Debug, Clone, PartialEq)]
pub struct Ghost {
    /// Time of the moment, s; the run itself may be further by now.
    pub t: f64,
    /// Centres in the exact run then, m.
    pub x: Vec<DVec3>,
    /// Distance of each sphere from where it is in the exact run, m.
    pub deviations: Vec<f64>,
    /// (energy − the exact run's) over the largest |energy| of that one, dimensionless; the difference, J, where it is 0.
    pub energy_error: f64,
    /// Time from which on positions in this scene say nothing, s, once the exact run has come that far.
    pub horizon: Option<f64>,
    /// Why the exact run cannot go on, if it cannot: a full sentence. The rest is then as it was before.
    pub stall: Option<String>,
}

impl Ghost {
    /// The sphere that was furthest from its place in the exact run, and how far, m; `None` without spheres.
    pub fn worst(&self) -> Option<(usize, f64)> {
        let further = |worst: (usize, f64), next: (usize, f64)| if next.1 > worst.1 { next } else { worst };
        self.deviations.iter().copied().enumerate().reduce(further)
    }

    /// Whether positions said nothing at that moment: a displacement of a picometre would have grown a millionfold.
    pub fn is_past_horizon(&self) -> bool {
        self.horizon.is_some_and(|horizon| self.t > horizon)
    }
}
