//! The equation of state of hard spheres, by two roads: the virial of the impacts, and how often they happen.

use std::f64::consts::PI;

use glam::DVec3;

use super::check::Check;
use super::gas::{Gas, SIGMA, gas, side};
use super::runner::{Row, Runner, Trouble};

pub(super) const CHECK: Check = Check {
    title: "hard spheres",
    source: "Z = p/(n kT) at the density found three diameters and more from the walls, where the box is as good as \
             endless: Kolafa, Labík, Malijevský, PCCP 6, 2335 (2004); Z from the virial, and from the rate of impacts \
             by Enskog's contact value",
    allowed: "three standard errors of some 10⁵ to 10⁶ impacts and of the density, and 4e-5 of the source",
    measure,
};

/// Distance from the walls within which nothing is counted, m: walls order the spheres near them.
const MARGIN: f64 = 3.0 * SIGMA;

/// Z, relative. Impulses scatter by half their mean, and the number of impacts as its root at most: of 2e5 impacts or
/// more, Z − 1 is known to 2.5e-3 and Z, at the lower packings, to half of that. At the higher ones Z goes with the
/// 2.4th power of the density, which is known to 5e-4.
const ALLOWED: f64 = 3e-3;

fn measure(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let rows = runner.pick(&[0.2][..], &[0.1, 0.2, 0.3, 0.4]).iter().map(|&packing| both(runner, packing));
    Ok(rows.collect::<Result<Vec<_>, _>>()?.concat())
}

fn both(runner: &Runner, packing: f64) -> Result<Vec<Row>, Trouble> {
    let found = Bulk::of(runner, packing)?;
    let expected = compressibility(found.packing);
    let row =
        |road: &str, z: f64| Row::new(format!("Z, {road}, packing {:.4}", found.packing), "", [expected, z], ALLOWED);
    Ok(vec![row("virial", found.virial), row("rate", found.rate)])
}

/// Z of the hard-sphere fluid at a packing fraction (Kolafa, Labík, Malijevský 2004), good to 4e-5 up to freezing.
fn compressibility(packing: f64) -> f64 {
    let x = packing / (1.0 - packing);
    let terms = [
        (1, 4.0),
        (2, 6.0),
        (3, 2.364_768_4),
        (4, -0.869_855_1),
        (5, 1.106_280_3),
        (6, -1.101_422_1),
        (7, 0.666_058_66),
        (8, -0.036_334_31),
        (10, -0.209_651_64),
        (14, 0.105_555_69),
        (22, -0.008_723_8),
    ];
    terms.iter().fold(1.0, |z, &(power, factor)| z + factor * x.powi(power))
}

/// What was found away from the walls.
struct Bulk {
    packing: f64,
    /// Z = 1 + Σ |Δp| σ / (3 N kT t).
    virial: f64,
    /// Z = 1 + √π/6 ω σ √(m/kT), ω the impacts of one sphere in unit time.
    rate: f64,
}

impl Bulk {
    fn of(runner: &Runner, packing: f64) -> Result<Bulk, Trouble> {
        let (count, looks) = runner.pick((4000, 1000), (10_000, 1200));
        let scene = gas(packing, count, &[1.0])?;
        let mut gas = Gas::thermal(runner, &scene)?;
        let region = Region { half: 0.5 * side(packing, count) - MARGIN };
        let start = gas.run.time();
        let (mut spheres, mut squares, mut impulses, mut impacts) = (0.0, 0.0, 0.0, 0.0);
        for _ in 0..looks {
            // Ten looks while a sphere of mean speed passes its diameter.
            let state = gas.go(gas.run.time() + 0.1 * SIGMA)?;
            for (x, v) in state.x.iter().zip(&state.v) {
                spheres += region.weight(*x);
                squares += region.weight(*x) * v.length_squared();
            }
            for impact in gas.impacts() {
                impacts += region.weight(impact.point);
                impulses += region.weight(impact.point) * impact.impulse;
            }
        }
        // The temperature of the same place, too: the middle may be warmer than the rest for as long as heat needs.
        let (kt, time) = (squares / (3.0 * spheres), gas.run.time() - start);
        let mean = spheres / f64::from(looks);
        Ok(Bulk {
            packing: mean / region.volume() * PI * SIGMA * SIGMA * SIGMA / 6.0,
            virial: 1.0 + impulses * SIGMA / (3.0 * mean * kt * time),
            rate: 1.0 + PI.sqrt() / 6.0 * 2.0 * impacts / (mean * time) * SIGMA / kt.sqrt(),
        })
    }
}

/// A cube about the origin that fades out towards its faces: with a sharp edge, the order among neighbours that happen
/// to lie across it would blur the density for as long as dense spheres need to change places.
struct Region {
    /// Half of the cube's edge, m; at least [`FADE`].
    half: f64,
}

/// Depth over which the weight fades, m: some layers of neighbours.
const FADE: f64 = 3.0 * SIGMA;

impl Region {
    /// What counts at `x` (m): 0 outside, 1 well inside, smoothly in between.
    fn weight(&self, x: DVec3) -> f64 {
        let share = ((DVec3::splat(self.half) - x.abs()) / FADE).clamp(DVec3::ZERO, DVec3::ONE);
        (share * share * (DVec3::splat(3.0) - 2.0 * share)).element_product()
    }

    /// Integral of the weight, m³: each fading layer counts for a half.
    fn volume(&self) -> f64 {
        let edge = 2.0 * self.half - FADE;
        edge * edge * edge
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_equation_of_state_has_the_published_values() {
        for (packing, z) in [(0.05, 1.22749), (0.1, 1.52165), (0.2, 2.40940), (0.3, 3.98398), (0.4, 6.94546)] {
            // five decimals were given
            assert!((compressibility(packing) - z).abs() < 6e-6, "{packing}: {}", compressibility(packing));
        }
    }

    #[test]
    fn the_volume_of_a_region_is_what_its_weights_sum_up_to() {
        let region = Region { half: 1.0 };
        let at = |k: usize| (k as f64 + 0.5) / 20.0 - 1.25;
        let places = (0..50 * 50 * 50).map(|k| DVec3::new(at(k / 2500), at(k / 50 % 50), at(k % 50)));
        let sum: f64 = places.map(|x| region.weight(x)).sum::<f64>() / 8000.0;
        // midpoints of 0.05 m: the second derivative of the weight, 6 / FADE² at most, times 0.05² / 24
        assert!((sum / region.volume() - 1.0).abs() < 6e-3, "{sum}");
    }

    #[test]
    fn it_begins_with_the_virial_coefficients_four_and_ten() {
        // B2 = 4 and B3 = 10 (Boltzmann 1899); the next, 18.36, is 2e-7 of it here.
        let x = 1e-4;
        assert!((compressibility(x) - 1.0 - 4.0 * x - 10.0 * x * x).abs() < 2e-11);
    }
}
