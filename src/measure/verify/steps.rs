//! What the knobs of the time-steppers cost: their order, and how often they miss a wall.

use glam::DVec3;

use super::bodies::{ELASTIC, G, floor, scene, sphere, wall};
use super::check::Check;
use super::runner::{Row, Runner, Trouble};
use super::statistics::slope;
use crate::physics::Simulation;
use crate::scene::{Method, Settings};

pub(super) const DT: Check = Check {
    title: "order in dt",
    source: "a drop in frames of v += g dt, x += v dt is off by g t dt/2: first order",
    allowed: "that is exact; what is left are the roundings of all frames, relative to the smallest error",
    measure: order_in_dt,
};

pub(super) const TOLERANCE: Check = Check {
    title: "order in the tolerance",
    source: "swept accepts an overlap within the tolerance: each impact is late in proportion",
    allowed: "bisection ends anywhere within the tolerance: twice more or less over eight decades, and averaged",
    measure: order_in_tolerance,
};

pub(super) const TUNNELLING: Check = Check {
    title: "tunnelling",
    source: "paper misses a wall if no frame ends within a radius of it: 1 − 2r/(v dt); swept never",
    allowed: "one in as many phases of the start as were tried",
    measure: tunnelling,
};

/// How long a drop lasts, s.
const FALL: f64 = 1.0;

/// Frames of a power of two, s.
const LADDER: [f64; 4] = [0.125, 0.031_25, 0.007_812_5, 0.001_953_125];

/// 512 frames, each rounded at 5 m, against an error of 1e-2 m: 5e-11 if all round the same way.
const ROUNDED: f64 = 1e-10;

fn order_in_dt(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let rows = [Method::Paper, Method::Moreau].into_iter().map(|method| drop_ladder(runner, method));
    Ok(rows.collect::<Result<Vec<_>, _>>()?.concat())
}

fn drop_ladder(runner: &Runner, method: Method) -> Result<Vec<Row>, Trouble> {
    let (mut points, mut last) = (Vec::new(), f64::NAN);
    for dt in LADDER {
        let falling = scene(DVec3::Y * -G, ELASTIC, Vec::new(), vec![sphere(DVec3::ZERO, DVec3::ZERO, 0.5)])?;
        let state = runner.go(&mut Simulation::new(&falling, Settings { method, dt, tolerance: 1e-3 }), FALL)?;
        last = (state.x[0].y + 0.5 * G * FALL * FALL).abs();
        points.push((dt.ln(), last.ln()));
    }
    let name = method.name();
    let expected = 0.5 * G * FALL * LADDER[LADDER.len() - 1];
    Ok(vec![
        Row::new(format!("{name}, order in dt"), "", [1.0, slope(&points)], ROUNDED),
        Row::new(format!("{name}, off after 1 s"), "m", [expected, last], ROUNDED),
    ])
}

fn order_in_tolerance(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let mut points = Vec::new();
    for tolerance in (1..=9).map(|k| 0.1_f64.powi(k + 1)) {
        let heights = runner.pick(20, 100);
        let mut sum = 0.0;
        for k in 0..heights {
            sum += late(runner, 1.0 + f64::from(k) / f64::from(heights), tolerance)?;
        }
        points.push((tolerance.ln(), sum.ln()));
    }
    // The mean of twenty lags, each anywhere within the tolerance, scatters by an eighth: 2 · 0.13/ln 1e8 at worst.
    Ok(vec![Row::new("swept, order in tolerance", "", [1.0, slope(&points)], 0.015)])
}

/// How far swept is off after a drop from `h` (m) and as much time again, m.
fn late(runner: &Runner, h: f64, tolerance: f64) -> Result<f64, Trouble> {
    let ball = sphere(DVec3::Y * (0.5 + h), DVec3::ZERO, 0.5);
    let dropped = scene(DVec3::Y * -G, ELASTIC, vec![floor()], vec![ball])?;
    let settings = Settings { method: Method::Swept, dt: 0.1, tolerance };
    let fall = (2.0 * h / G).sqrt();
    // Elastic: half a fall after the impact it is back at 3/4 of the height.
    let state = runner.go(&mut Simulation::new(&dropped, settings), 1.5 * fall)?;
    Ok((state.x[0].y - 0.5 - 0.75 * h).abs())
}

/// Starts at evenly spread phases of a frame of 0.1 s.
fn tunnelling(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let phases = runner.pick(500, 5000);
    let missed = |method, v| missed(runner, method, v, phases);
    let paper = |v: f64| {
        let expected = 1.0 - 2.0 * RADIUS / (v * STEP);
        // Counting k of n even phases is off by less than one of them, relative to the probability.
        let allowed = 1.0 / f64::from(phases) / expected;
        missed(Method::Paper, v).map(|found| Row::new(format!("paper, v = {v} m/s"), "", [expected, found], allowed))
    };
    let swept = Row::new("swept, v = 1000 m/s", "", [0.0, missed(Method::Swept, 1000.0)?], 0.0);
    Ok(vec![paper(25.0)?, paper(40.0)?, swept])
}

/// Radius of what flies, m.
const RADIUS: f64 = 0.5;
/// Longest frame, s.
const STEP: f64 = 0.1;

/// The share of spheres that at `v` (m/s) pass a wall unhindered.
fn missed(runner: &Runner, method: Method, v: f64, phases: u32) -> Result<f64, Trouble> {
    let target = wall(DVec3::ZERO, DVec3::Y * 4.0, DVec3::Z * 4.0);
    let mut through = 0;
    for phase in 0..phases {
        let x = -10.0 - v * STEP * (f64::from(phase) + 0.5) / f64::from(phases);
        let ball = sphere(DVec3::X * x, DVec3::X * v, RADIUS);
        let flight = scene(DVec3::ZERO, ELASTIC, vec![target.clone()], vec![ball])?;
        let state = runner.go(&mut Simulation::new(&flight, Settings { method, dt: STEP, tolerance: 1e-3 }), 1.0)?;
        through += u32::from(state.v[0].x > 0.0);
    }
    Ok(f64::from(through) / f64::from(phases))
}
