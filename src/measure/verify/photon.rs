//! A photon among mirrors: what is left of sixteen digits after fourteen impacts with round bodies.

use super::check::Check;
use super::runner::{Row, Runner, Trouble};
use crate::certify::{Double, certify};
use crate::measure::interrupt::Interrupted;
use crate::scene;

pub(super) const CHECK: Check = Check {
    title: "photon",
    source: "distance from the origin after 10 s among mirrors of radius 1/3 (problem 2 of SIAM's 100-digit challenge; \
             Bornemann, Laurie, Wagon, Waldvogel, SIAM, 2004)",
    allowed: "the shadow run's 32 digits lose some ten, the mirrors' recoil comes in the 20th; what is left rounds to f64",
    measure,
};

/// The answer's first digits.
const DISTANCE: f64 = 0.995_262_919_443_354_2;

/// Metres of the scene in one unit of the problem.
const UNIT: f64 = 30.0;

fn measure(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let scene = scene::open("photon")?.scene;
    let certificate = certify(&scene, scene.duration, runner.go_on()).ok_or(Interrupted)?;
    let place = certificate.place(0).filter(|_| certificate.ending.is_none());
    let distance = place.map(|[x, y, _]| (x * x + y * y).sqrt() / Double::from(UNIT));
    let found = distance.map_or(f64::NAN, Double::value);
    Ok(vec![Row::new("distance of the photon", "", [DISTANCE, found], f64::EPSILON)])
}
