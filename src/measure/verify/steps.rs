//! What `paper`'s time step costs: its order, and how often it misses a wall.

use glam::DVec3;

use super::bodies::{ELASTIC, G, scene, sphere, wall};
use super::statistics::slope;
use super::{Check, Lab, Row, Trouble};
use crate::physics::{Method, Settings, Simulation};

pub(super) const ORDER: Check = Check {
    title: "order of paper",
    source: "a drop by Euler frames is off by g t dt/2: first order in dt",
    allowed: "that is exact; what is left is the rounding of the coordinates, relative to the smallest error",
    measure: order,
};

pub(super) const TUNNELLING: Check = Check {
    title: "tunnelling of paper",
    source: "a wall is missed if no frame ends within a radius of it: 1 − 2r/(v dt)",
    allowed: "one in as many phases of the start as were tried",
    measure: tunnelling,
};

fn paper(dt: f64) -> Settings {
    Settings { method: Method::Paper, dt, tolerance: 1e-3 }
}

fn order(lab: &Lab) -> Result<Vec<Row>, Trouble> {
    let ladder = [3, 5, 7, 9].map(|k| 0.5_f64.powi(k));
    let mut errors = Vec::new();
    for dt in ladder {
        let falling = scene(DVec3::Y * -G, ELASTIC, Vec::new(), vec![sphere(DVec3::ZERO, DVec3::ZERO, 0.5)]);
        let state = lab.go(&mut Simulation::new(&falling, paper(dt)), 1.0)?;
        errors.push((state.x[0].y + 0.5 * G).abs());
    }
    let points: Vec<_> = ladder.iter().zip(&errors).map(|(dt, error)| (dt.ln(), error.ln())).collect();
    let (finest, expected) = (errors[errors.len() - 1], 0.5 * G * ladder[ladder.len() - 1]);
    // 512 sums, each rounded at 5 m, against an error of 1e-2 m: 5e-11 if all round the same way.
    Ok(vec![
        Row::new("paper, order in dt", "", [1.0, slope(&points)], 1e-10),
        Row::new("paper, error of a 1 s drop", "m", [expected, finest], 1e-10),
    ])
}

fn tunnelling(lab: &Lab) -> Result<Vec<Row>, Trouble> {
    [25.0, 40.0].into_iter().map(|v| missed(lab, v)).collect()
}

/// Starts at evenly spread phases of a frame, at `v` m/s, in frames of 0.1 s.
fn missed(lab: &Lab, v: f64) -> Result<Row, Trouble> {
    let (r, dt, phases) = (0.5, 0.1, lab.pick(500, 5000));
    let target = wall(DVec3::ZERO, DVec3::Y * 4.0, DVec3::Z * 4.0);
    let mut through = 0;
    for phase in 0..phases {
        let x = -10.0 + v * dt * (f64::from(phase) + 0.5) / f64::from(phases);
        let ball = sphere(DVec3::X * x, DVec3::X * v, r);
        let flight = scene(DVec3::ZERO, ELASTIC, vec![target.clone()], vec![ball]);
        let state = lab.go(&mut Simulation::new(&flight, paper(dt)), 1.0)?;
        through += u32::from(state.v[0].x > 0.0);
    }
    let (expected, found) = (1.0 - 2.0 * r / (v * dt), f64::from(through) / f64::from(phases));
    // Counting k of n even phases is off by less than one of them, relative to the probability.
    Ok(Row::new(format!("paper tunnels, v = {v} m/s"), "", [expected, found], 1.0 / f64::from(phases) / expected))
}
