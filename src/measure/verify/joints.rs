//! Where walls meet: over a ridge, over the seams of tiles, at the bottom of a funnel.

use glam::DVec3;

use super::bodies::{G, exact, floor, scene, smooth, sphere, wall};
use super::check::Check;
use super::runner::{Row, Runner, Trouble};
use crate::physics::{Class, Until};
use crate::scene::{Scene, Wall};

/// Radius of every ball, m.
const R: f64 = 0.5;

pub(super) const RIDGE: Check = Check {
    title: "over a ridge",
    source: "a ball rolls over the edge of two walls: on a steep slope it lets go where v² = g r cos θ, that is at \
             cos θ = ⅔ (1 + v₀²/2gr); a gentle slope it reaches with v² = v₀² + 2gr(1 − cos θ), and keeps its energy",
    allowed: "rolling over an edge is integrated to 1e-12, its end overshot by 1e-10 of a step",
    measure: ridge,
};

/// Speed on the plateau, m/s.
const SPEED: f64 = 0.5;

fn ridge(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let mut steep = exact(&plateau_and_slope(DVec3::new(0.6, -0.8, 0.0))?);
    runner.go(&mut steep, 2.0)?;
    let release = steep.take_events().into_iter().rfind(|event| event.class == Class::Release);
    let cosine = 2.0 / 3.0 * (1.0 + SPEED * SPEED / (2.0 * G * R));
    let gentle = plateau_and_slope(DVec3::new(0.8, -0.6, 0.0))?;
    let mut run = exact(&gentle);
    let end = runner.go(&mut run, 2.0)?;
    let (x, v) = (end.x[0], end.v[0]);
    let fallen = R - x.y;
    let height = DVec3::new(0.6, 0.8, 0.0).dot(x);
    Ok(vec![
        Row::new("steep, lets go at cos θ", "", [cosine, release.map_or(f64::NAN, |row| row.normal.y)], 1e-11),
        Row::new("gentle, height over slope", "m", [R, height], 1e-12),
        Row::new("gentle, v² after 2 s", "m²/s²", [SPEED * SPEED + 2.0 * G * fallen, v.length_squared()], 1e-12),
    ])
}

/// A ball on its way over a plateau to the slope that goes on from its edge along `down`.
fn plateau_and_slope(down: DVec3) -> Result<Scene, Trouble> {
    let plateau = wall(DVec3::NEG_X * 5.0, DVec3::X * 10.0, DVec3::Z * 10.0);
    let slope = wall(down * 5.0, down * 10.0, DVec3::Z * 10.0);
    let ball = sphere(DVec3::new(-0.5, R, 0.0), DVec3::X * SPEED, R);
    scene(DVec3::Y * -G, smooth(0.5), vec![plateau, slope], vec![ball])
}

pub(super) const TILES: Check = Check {
    title: "over tiles",
    source: "cracks of a nanometre hold and drop nothing: a ball that bounces and slides over tiles goes where it goes \
             over one wall",
    allowed: "the far edge of each crack turns its way by v 1e-9/r at most, for the time of a hop of 1e-16 m",
    measure: tiles,
};

fn tiles(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let law = smooth(0.5);
    let ball = sphere(DVec3::new(-7.0, R + 0.2, -7.0), DVec3::new(1.5, 0.0, 1.5), R);
    let over = |walls: Vec<Wall>| {
        let tiles = scene(DVec3::Y * -G, law, walls, vec![ball.clone()])?;
        runner.go(&mut exact(&tiles), 9.0)
    };
    let one = over(vec![floor()])?;
    let row = |(what, crack): (&str, f64)| {
        let many = over(tiled(crack))?;
        Ok(Row::new(what, "m", [0.0, many.x[0].distance(one.x[0])], 1e-12))
    };
    [("tiles without cracks", 0.0), ("cracks of a nanometre", 1e-9)].into_iter().map(row).collect()
}

/// 8 × 8 square tiles of 2.5 m, less `crack` (m), at y = 0.
fn tiled(crack: f64) -> Vec<Wall> {
    let at = |k: u8| 2.5 * (f64::from(k) - 3.5);
    let side = 2.5 - crack;
    let tile = |k: u8| wall(DVec3::new(at(k % 8), 0.0, at(k / 8)), DVec3::X * side, DVec3::NEG_Z * side);
    (0..64).map(tile).collect()
}

pub(super) const FUNNEL: Check = Check {
    title: "in a funnel",
    source: "statics: whatever the number of slopes that hold it, a ball at the bottom lies still, and what they give it \
             is its weight",
    allowed: "forces are solved to rounding, places are rounded to 64 ulp of 10 m",
    measure: funnels,
};

fn funnels(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let mut rows = Vec::new();
    for sides in runner.pick(&[3, 4, 6][..], &[3, 4, 5, 6, 7, 8][..]) {
        let mut run = exact(&funnel(*sides)?);
        let before = runner.go(&mut run, 20.0)?;
        run.advance(Until::Frame, u64::MAX);
        let resting = run.contacts().iter().filter(|contact| contact.class == Class::Rest);
        let given: DVec3 = resting.map(|contact| contact.normal * contact.impulse).sum();
        let moved = run.state().x[0].distance(before.x[0]);
        rows.push(Row::new(format!("{sides} slopes, weight"), "N", [G, given.y / run.step()], 1e-12));
        rows.push(Row::new(format!("{sides} slopes, drift"), "m", [0.0, moved], 64.0 * 10.0 * f64::EPSILON));
    }
    Ok(rows)
}

/// A ball that falls into a funnel of so many slopes of 3 : 4, side by side around the axis.
fn funnel(sides: u32) -> Result<Scene, Trouble> {
    let slope = |k: u32| {
        let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / f64::from(sides)).sin_cos();
        let (out, along) = (DVec3::new(cos, 0.0, sin), DVec3::new(-sin, 0.0, cos));
        wall((out * 0.8 + DVec3::Y * 0.6) * 2.5, (out * 0.8 + DVec3::Y * 0.6) * 5.0, along * 10.0)
    };
    let ball = sphere(DVec3::new(0.3, 2.0, 0.2), DVec3::ZERO, R);
    scene(DVec3::Y * -G, smooth(0.5), (0..sides).map(slope).collect(), vec![ball])
}
