//! What a state adds up to by its model: energy, momentum; and whether its numbers are in range.

use glam::DVec3;

use super::model::Model;
use super::state::{Stall, State, runaway};

impl State {
    /// Σ ½ m v² − m g·x − F·x, J, summed in index order.
    pub fn energy(&self, model: &Model) -> f64 {
        let of = |i: usize| model.masses[i] * (0.5 * self.v[i].length_squared() - model.acceleration(i).dot(self.x[i]));
        (0..self.x.len()).map(of).sum()
    }

    /// Whether some sphere is out of the range of numbers, or accelerated so that it would be soon.
    pub(super) fn runaway(&self, model: &Model) -> Option<Stall> {
        let begin = "begin with smaller coordinates and speeds";
        let pulled = "with its acceleration in place of its velocity; begin with smaller forces";
        (0..self.x.len()).find_map(|i| {
            let (x, v, a) = (self.x[i], self.v[i], model.acceleration(i));
            runaway(i, self.t, [x, v], begin).or_else(|| runaway(i, self.t, [x, a], pulled))
        })
    }

    /// Σ m v, kg m/s, summed in index order.
    pub fn momentum(&self, model: &Model) -> DVec3 {
        self.v.iter().zip(&model.masses).map(|(v, m)| *v * *m).sum()
    }
}
