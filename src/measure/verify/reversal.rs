//! Time reversal: what loses nothing finds back to where it began.

use super::bodies::{ELASTIC, EXACT};
use super::check::Check;
use super::gas::continued;
use super::runner::{Row, Runner, Trouble};
use crate::physics::{Simulation, State};
use crate::scene::{self, Scene};

pub(super) const CHECK: Check = Check {
    title: "time reversal",
    source: "Newton's laws with e = 1 are the same backwards: with all velocities turned, a run returns to its start",
    allowed: "a rounding of 10 m and of 10 s at 14 m/s at each impact there and back, grown twelvefold as a small \
              displacement does in paper-2",
    measure,
};

/// How long the runs last before they turn, s.
const UNTIL: f64 = 10.0;

/// How much a displacement grows on the way back at most: 1 in paper-0, where spheres bounce on one spot; 11.6 in paper-2
/// (one of 1e-9 m of any sphere along any axis, unless it changes which wall of a corner is struck first).
const GROWTH: f64 = 12.0;

/// Rounding at one impact, m: of a coordinate of 10 m, and of the time of 10 s, in which what has fallen through the
/// room flies at 14 m/s.
const ROUNDING: f64 = (10.0 + 10.0 * 14.0) * f64::EPSILON;

fn measure(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    ["paper-0", "paper-2"].into_iter().map(|name| returned(runner, name)).collect()
}

fn returned(runner: &Runner, name: &str) -> Result<Row, Trouble> {
    let opened = scene::open(name)?;
    let forth = opened.scene.changed(|draft| draft.contact = ELASTIC)?;
    let (mut turned, impacts) = end(runner, &forth)?;
    turned.v.iter_mut().for_each(|v| *v = -*v);
    let (back, _) = end(runner, &continued(&forth, &turned, ELASTIC)?)?;
    let start = Simulation::new(&forth, EXACT).state();

    let allowed = ROUNDING * 2.0 * (impacts + 1.0) * GROWTH;
    Ok(Row::new(format!("{name}, there and back"), "m", [0.0, apart(&back, &start)], allowed))
}

/// The state at the end, and the impacts until then.
fn end(runner: &Runner, scene: &Scene) -> Result<(State, f64), Trouble> {
    let mut run = Simulation::new(scene, EXACT);
    let state = runner.go(&mut run, UNTIL)?;
    Ok((state, run.tallies().impacts as f64))
}

/// Largest distance between the same spheres of two states, m.
fn apart(one: &State, other: &State) -> f64 {
    one.x.iter().zip(&other.x).map(|(x, y)| x.distance(*y)).fold(0.0, f64::max)
}
