//! Equipartition: heavy and light spheres come to the same mean energy.

use super::check::Check;
use super::gas::{Gas, SIGMA, gas};
use super::runner::{Row, Runner, Trouble};
use super::statistics::mean;
use crate::physics::State;

pub(super) const CHECK: Check = Check {
    title: "equipartition",
    source: "in an elastic mixture every degree of freedom has the same mean energy, whatever the masses (Maxwell, \
             Boltzmann); they start at equal speeds, that is with a ratio of 1/4",
    allowed: "three standard errors, from the scatter of block averages",
    measure,
};

/// Masses, kg, of one half of the spheres and of the other.
const MASSES: [f64; 2] = [1.0, 4.0];

/// Blocks whose averages count as independent.
const BLOCKS: usize = 20;

fn measure(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let (count, looks) = runner.pick((500, 25), (2000, 100));
    let mut gas = Gas::thermal(runner, &gas(0.2, count, &MASSES)?)?;
    let mut averages = Vec::new();
    for _ in 0..BLOCKS {
        let mut energies = [0.0; 2];
        for _ in 0..looks {
            // A sphere collides several times between two looks, half a diameter's flight apart.
            let state = gas.go(gas.run.time() + 0.5 * SIGMA)?;
            energies = [0, 1].map(|half| energies[half] + energy(&state, half));
        }
        averages.push(energies[0] / energies[1]);
    }
    let (ratio, error) = mean(&averages);
    Ok(vec![Row::new("energy, 1 kg over 4 kg", "", [1.0, ratio], 3.0 * error)])
}

/// Kinetic energy of one half of the spheres, J.
fn energy(state: &State, half: usize) -> f64 {
    let size = state.v.len() / 2;
    let squares: f64 = state.v[half * size..(half + 1) * size].iter().map(|v| v.length_squared()).sum();
    0.5 * MASSES[half] * squares
}
