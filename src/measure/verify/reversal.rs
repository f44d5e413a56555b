//! Time reversal: what loses nothing finds back to where it began.

use super::bodies::{ELASTIC, EXACT};
use super::gas::continued;
use super::{Check, Lab, Row, Trouble};
use crate::physics::{Scene, Simulation, State};
use crate::scene;

pub(super) const CHECK: Check = Check {
    title: "time reversal",
    source: "Newton's laws with e = 1 are the same backwards: with all velocities turned, a run returns to its start",
    allowed: "a rounding of the room's 10 m at each impact there and back, grown as a displacement was seen to grow",
    measure,
};

/// How long the runs last before they turn, s.
const UNTIL: f64 = 10.0;

/// A displacement that is small, yet far above rounding, m.
const NUDGE: f64 = 1e-9;

/// Rounding of a coordinate of 10 m, m.
const ROUNDING: f64 = 10.0 * f64::EPSILON;

fn measure(lab: &Lab) -> Result<Vec<Row>, Trouble> {
    ["paper-0", "paper-2"].into_iter().map(|name| returned(lab, name)).collect()
}

fn returned(lab: &Lab, name: &str) -> Result<Row, Trouble> {
    let opened = scene::open(name).map_err(|error| Trouble::Failed(error.to_string()))?;
    let forth = Scene { contact: ELASTIC, ..opened.scene };
    let (mut turned, impacts) = end(lab, &forth)?;
    turned.v.iter_mut().for_each(|v| *v = -*v);
    let (back, _) = end(lab, &continued(&forth, &turned, ELASTIC))?;
    let start = Simulation::new(&forth, EXACT).state();

    let mut nudged = turned.clone();
    nudged.x.iter_mut().for_each(|x| x.z += NUDGE);
    let (astray, _) = end(lab, &continued(&forth, &nudged, ELASTIC))?;
    let growth = (apart(&astray, &back) / NUDGE).max(1.0);
    let allowed = ROUNDING * 2.0 * (impacts + 1.0) * growth;
    Ok(Row::new(format!("{name}, off after there and back"), "m", [0.0, apart(&back, &start)], allowed))
}

/// The state at the end, and the impacts until then.
fn end(lab: &Lab, scene: &Scene) -> Result<(State, f64), Trouble> {
    let mut run = Simulation::new(scene, EXACT);
    let state = lab.go(&mut run, UNTIL)?;
    Ok((state, run.tallies().impacts as f64))
}

/// Largest distance between the same spheres of two states, m.
fn apart(one: &State, other: &State) -> f64 {
    one.x.iter().zip(&other.x).map(|(x, y)| x.distance(*y)).fold(0.0, f64::max)
}
