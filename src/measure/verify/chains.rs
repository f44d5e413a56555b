//! Chains of impacts: the digits of π, and Newton's cradle.

use std::f64::consts::PI;

use glam::DVec3;

use super::bodies::{ELASTIC, exact, scene, smooth, sphere, wall};
use super::check::Check;
use super::runner::{Row, Runner, Trouble};
use crate::physics::State;
use crate::scene::Sphere;

pub(super) const DIGITS: Check = Check {
    title: "Galperin's billiard",
    source: "⌊π 10^k⌋ impacts of a ball with a wall and one of 100^k times its mass (Galperin, Regul. Chaotic Dyn. 8, \
             375, 2003)",
    allowed: "none: a count",
    measure: digits,
};

pub(super) const SQUEEZE: Check = Check {
    title: "squeeze",
    source: "the impact law, blow by blow: between a wall and a heavy ball a light one is struck thousands of times at \
             one place, and sends the heavy one back",
    allowed: "each of some ten thousand blows rounds twice",
    measure: squeeze,
};

pub(super) const CRADLE: Check = Check {
    title: "Newton's cradle",
    source: "as many balls leave as came in, at their speed: equal masses swap velocities",
    allowed: "none: bit for bit",
    measure: cradle,
};

fn ball(x: f64, v: f64, mass: f64) -> Sphere {
    Sphere { mass, ..sphere(DVec3::X * x, DVec3::X * v, 0.5) }
}

fn digits(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    runner.pick([1, 3, 4], [2, 4, 6]).into_iter().map(|k| count(runner, k)).collect()
}

fn count(runner: &Runner, k: i32) -> Result<Row, Trouble> {
    let stop = wall(DVec3::ZERO, DVec3::Y * 4.0, DVec3::Z * 4.0);
    let balls = vec![ball(2.0, 0.0, 1.0), ball(4.0, -1.0, 100_f64.powi(k))];
    let mut run = exact(&scene(DVec3::ZERO, ELASTIC, vec![stop], balls)?);
    run.record_events(false);
    // After a second of approach and the turn, no impact is left a hundred seconds on.
    runner.go(&mut run, 100.0)?;
    let found = run.tallies().impacts as f64;
    Ok(Row::new(format!("impacts, masses 1 : 100^{k}"), "", [(PI * 10_f64.powi(k)).floor(), found], 0.0))
}

fn squeeze(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let row = |(e, heavy): (f64, f64)| {
        let stop = wall(DVec3::ZERO, DVec3::Y * 10.0, DVec3::Z * 10.0);
        let balls = vec![ball(0.5, 0.0, 1.0), ball(4.0, -1.0, heavy)];
        let state = runner.go(&mut exact(&scene(DVec3::ZERO, smooth(e), vec![stop], balls)?), 4.0)?;
        Ok(Row::new(format!("heavy out, e = {e}"), "m/s", [blow_by_blow(e, heavy), state.v[1].x], 1e-11))
    };
    [(0.99999, 1e7), (0.999, 1e4)].into_iter().map(row).collect()
}

/// Speed (m/s) at which a ball of `heavy` kg leaves that comes in at 1 m/s, with one of 1 kg between it and a wall.
fn blow_by_blow(e: f64, heavy: f64) -> f64 {
    let (mut light, mut v) = (0.0, -1.0);
    while light > v || light < 0.0 {
        if light < 0.0 {
            light *= -e;
        } else {
            let push = (1.0 + e) * (light - v) / (1.0 + 1.0 / heavy);
            (light, v) = (light - push, v + push / heavy);
        }
    }
    v
}

/// Balls in the cradle.
const BALLS: usize = 5;
/// Speed of those that come in, m/s.
const SPEED: f64 = 2.0;

fn cradle(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    (1..=3).map(|incoming| swing(runner, incoming)).collect()
}

fn swing(runner: &Runner, incoming: usize) -> Result<Row, Trouble> {
    let swung = |k: usize| if k < incoming { ball(k as f64 - 5.0, SPEED, 1.0) } else { ball(k as f64, 0.0, 1.0) };
    let mut run = exact(&scene(DVec3::ZERO, ELASTIC, Vec::new(), (0..BALLS).map(swung).collect())?);
    let state = runner.go(&mut run, 6.0)?;
    Ok(Row::new(format!("cradle, balls out for {incoming} in"), "", [incoming as f64, leaving(&state)], 0.0))
}

/// Balls at the far end that have exactly the speed of those that came in, if no other moves.
fn leaving(state: &State) -> f64 {
    let out = state.v.iter().rev().take_while(|v| **v == DVec3::X * SPEED).count();
    let others = &state.v[..BALLS - out];
    if others.iter().all(|v| *v == DVec3::ZERO) { out as f64 } else { f64::NAN }
}
