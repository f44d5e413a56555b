//! What rooms are asked at every half second, curved rest or not: no overlap beyond 1e-12 r, of `swept` beyond its
//! tolerance, and no rise of the energy.

use carom::physics::wall::touch;
use carom::physics::{Method, Model, Settings, Simulation, State};

use crate::judged::{Failure, fail};

/// The looks at one run.
pub(crate) struct Halves {
    /// Half seconds looked at so far.
    count: u32,
    /// Least energy seen, and the most that the sum of its positive terms has been, J.
    least: f64,
    size: f64,
}

impl Halves {
    pub(crate) fn of(run: &Simulation) -> Halves {
        Halves { count: 0, least: run.initial_energy(), size: size(run.model(), &run.state()) }
    }

    /// Looks at the half seconds that the frame just completed holds.
    pub(crate) fn look(&mut self, run: &Simulation) -> Result<(), Failure> {
        while 0.5 * f64::from(self.count + 1) <= run.time() {
            self.count += 1;
            let (model, state) = (run.model(), run.at(0.5 * f64::from(self.count)));
            let deep = depth(model, &state);
            let Settings { method, tolerance, .. } = run.settings();
            if deep > 1e-12 + if method == Method::Swept { tolerance } else { 0.0 } {
                return fail("depth", format!("degree {deep:e} at {} s", state.t));
            }
            let energy = state.energy(model);
            self.size = self.size.max(size(model, &state));
            // an impact changes the energy by some ulp; 1e-12 is a thousand of them
            if energy - self.least > 1e-12 * self.size {
                return fail("gain", format!("energy rose from {} to {energy} J by {} s", self.least, state.t));
            }
            self.least = self.least.min(energy);
        }
        Ok(())
    }
}

/// Largest −gap / r of the state, walls and pairs.
fn depth(model: &Model, state: &State) -> f64 {
    let mut deepest = f64::NEG_INFINITY;
    for i in 0..model.len() {
        for face in &model.faces {
            deepest = deepest.max(-touch(face, state.x[i], model.radii[i]).gap / model.radii[i]);
        }
        for j in 0..i {
            let reach = model.radii[i] + model.radii[j];
            deepest = deepest.max(1.0 - (state.x[i] - state.x[j]).length() / reach);
        }
    }
    deepest
}

/// Σ of what the energy is made of, each term positive: what rounding is relative to, J.
fn size(model: &Model, state: &State) -> f64 {
    let of = |i: usize| {
        let (v, x) = (state.v[i], state.x[i]);
        model.masses[i] * (0.5 * v.length_squared() + model.acceleration(i).length() * (x.length() + 1.0))
    };
    (0..model.len()).map(of).sum()
}
