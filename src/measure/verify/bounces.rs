//! The ball that bounces infinitely often in finite time.

use glam::DVec3;

use super::bodies::{G, exact, floor, scene, smooth, sphere};
use super::check::Check;
use super::runner::{Row, Runner, Trouble};
use crate::physics::Class;
use crate::scene::ContactLaw;

/// Height of the drop, m: the fall lasts a second.
const HEIGHT: f64 = 4.9;

/// Radius, m: so small that its rounding hides no hop.
const RADIUS: f64 = 1e-4;

pub(super) const CHECK: Check = Check {
    title: "bouncing ball",
    source: "√(2h/g) (1 + e)/(1 − e), the geometric series of its hops",
    allowed: "each of some 18/(1 − e) bounces rounds its time once",
    measure,
};

pub(super) const RUBBED: Check = Check {
    title: "rubbing ball",
    source: "the geometric series of its hops: each of the infinitely many bounces takes 1 % of the speed along the \
             floor, so that it comes to its end at v_t t₀ + v_t T eτ/(1 − eτ)",
    allowed: "as for the bouncing ball",
    measure: rubbed,
};

/// Share of the tangential velocity that a bounce leaves, and what there is of it at first, m/s.
const TANGENTIAL: f64 = 0.99;
const SLIP: f64 = 0.05;

fn rubbed(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let row = |e: f64| {
        let ball = sphere(DVec3::Y * (RADIUS + HEIGHT), DVec3::X * SLIP, RADIUS);
        let law = ContactLaw { tangential: TANGENTIAL, ..smooth(e) };
        let mut run = exact(&scene(DVec3::Y * -G, law, vec![floor()], vec![ball])?);
        let fall = (2.0 * HEIGHT / G).sqrt();
        let state = runner.go(&mut run, fall * (1.0 + e) / (1.0 - e) + 1.0)?;
        let kept = e * TANGENTIAL;
        let expected = SLIP * fall * (1.0 + 2.0 * kept / (1.0 - kept));
        Ok(Row::new(format!("ends at, e = {e}"), "m", [expected, state.x[0].x], 1e-12))
    };
    [0.5, 0.8, 0.99].into_iter().map(row).collect()
}

fn measure(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    [0.5, 0.8, 0.99].into_iter().map(|e| all_bounces(runner, e)).collect()
}

fn all_bounces(runner: &Runner, e: f64) -> Result<Row, Trouble> {
    let ball = sphere(DVec3::Y * (RADIUS + HEIGHT), DVec3::ZERO, RADIUS);
    let mut run = exact(&scene(DVec3::Y * -G, smooth(e), vec![floor()], vec![ball])?);
    let expected = (2.0 * HEIGHT / G).sqrt() * (1.0 + e) / (1.0 - e);
    runner.go(&mut run, expected + 1.0)?;
    let rest = run.take_events().into_iter().find(|event| event.class == Class::Rest);
    // (1 + e) ulp(t) for each of the bounces is 9e-13 at e = 0.99 if all of them round the same way.
    Ok(Row::new(format!("bounces end, e = {e}"), "s", [expected, rest.map_or(f64::NAN, |rest| rest.time)], 1e-12))
}
