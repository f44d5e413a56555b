//! Spheres that roll, slide, rest and fall over the places where walls meet or end: ridges and valleys from 1e-12 rad to a
//! knife's edge, seams, cracks, T-junctions, doubled and crossing walls, free edges and corners.

use std::f64::consts::TAU;

use carom::physics::Scene;
use carom::scene::{ContactLaw, Wall};
use glam::{DVec3, dvec3};

use crate::place::{free_spheres, pull, room_around};
use crate::random::Random;
use crate::support::{scene, wall};

/// A unit frame: the joint runs along `along`, what it joins lies across, `up` is away from it.
#[derive(Clone, Copy)]
pub(crate) struct Axes {
    pub(crate) across: DVec3,
    pub(crate) up: DVec3,
    pub(crate) along: DVec3,
}

impl Axes {
    /// Along the coordinates, turned about the vertical, or any.
    pub(crate) fn pick(random: &mut Random) -> Axes {
        match random.pick(&[0, 0, 1, 1, 2]) {
            0 => Axes { across: DVec3::X, up: DVec3::Y, along: DVec3::Z },
            1 => {
                let (sin, cos) = random.between(0.0, TAU).sin_cos();
                Axes { across: dvec3(cos, 0.0, sin), up: DVec3::Y, along: dvec3(-sin, 0.0, cos) }
            }
            _ => {
                let up = (DVec3::Y + random.vector() * 0.3).normalize();
                let across = up.cross(random.vector()).normalize_or(up.any_orthonormal_vector());
                Axes { across, up, along: across.cross(up) }
            }
        }
    }

    /// Across turned upwards by an angle, rad.
    pub(crate) fn slope(&self, angle: f64) -> DVec3 {
        self.across * angle.cos() + self.up * angle.sin()
    }

    /// A wall from the joint outwards along `out` (m), `from` its corner.
    fn leaf(&self, from: DVec3, out: DVec3, length: f64) -> Wall {
        let side = self.along * length;
        wall(from + (out + side) * 0.5, out, side)
    }
}

/// Any angle, from 1e-12 rad to a knife's edge, up or down.
pub(crate) fn angle(random: &mut Random) -> f64 {
    let sign = random.pick(&[1.0, -1.0]);
    sign * if random.unit() < 0.5 { random.decade(-12.0, -1.0) } else { random.between(0.05, 1.5) }
}

/// Two leaves that share an edge, each at its own angle.
fn bend(random: &mut Random, axes: Axes) -> Vec<Wall> {
    let first: f64 = random.pick(&[0.0, 0.0, 0.2, -0.2]);
    let second = angle(random);
    let corner = axes.along * -4.0;
    let left = axes.across * -first.cos() + axes.up * first.sin();
    vec![axes.leaf(corner, left * 5.0, 8.0), axes.leaf(corner, axes.slope(second) * 5.0, 8.0)]
}

/// A floor of tiles with the same edges or with cracks between them; some halved, which makes T-junctions.
fn tiles(random: &mut Random, axes: Axes) -> Vec<Wall> {
    let crack = if random.unit() < 0.5 { 0.0 } else { random.decade(-12.0, -2.0) };
    let (width, skew) = (random.between(0.3, 2.0), random.pick(&[0.0, 0.0, 0.5]));
    let halved = random.unit() < 0.4;
    let mut walls = Vec::new();
    for k in -3..3 {
        let from = axes.across * (f64::from(k) * (width + crack)) - axes.along * 4.0;
        let out = axes.across * width;
        let side = axes.along * 8.0 + axes.across * skew;
        if halved && k % 2 == 0 {
            let split = random.between(0.3, 0.7);
            walls.push(wall(from + (out + side * split) * 0.5, out, side * split));
            walls.push(wall(from + side * split + (out + side * (1.0 - split)) * 0.5, out, side * (1.0 - split)));
        } else {
            walls.push(wall(from + (out + side) * 0.5, out, side));
        }
    }
    walls
}

/// Walls that cover or cross each other.
fn doubled(random: &mut Random, axes: Axes) -> Vec<Wall> {
    let corner = axes.along * -4.0;
    let base = axes.leaf(corner - axes.across * 4.0, axes.across * 8.0, 8.0);
    let shift = random.pick(&[0.0, 0.0, 1.0]) * random.between(0.0, 2.0);
    let lower = random.pick(&[0.0, 1.0, -1.0]) * random.decade(-15.0, -6.0);
    match random.pick(&[0, 1]) {
        0 => {
            let other = axes.leaf(corner + axes.across * (shift - 4.0) + axes.up * lower, axes.across * 8.0, 8.0);
            vec![base, other]
        }
        _ => {
            let out = axes.slope(random.between(0.05, 1.5)) * 6.0;
            vec![base, axes.leaf(corner - out * 0.5, out, 8.0)]
        }
    }
}

/// A table that ends, a plank's corner, or three leaves that meet at a peak.
fn ending(random: &mut Random, axes: Axes) -> Vec<Wall> {
    match random.pick(&[0, 1, 2]) {
        0 => vec![axes.leaf(axes.along * -4.0, axes.across * -5.0, 8.0)],
        1 => {
            let (one, two) = (axes.across + axes.along, axes.along - axes.across);
            vec![wall((one + two) * -1.5, one * 3.0, two * 3.0)]
        }
        _ => {
            let drop = angle(random).abs();
            let spoke = |k: u32| {
                let (sin, cos) = (f64::from(k) * TAU / 3.0).sin_cos();
                ((axes.across * cos + axes.along * sin) * drop.cos() - axes.up * drop.sin()) * 4.0
            };
            (0..3).map(|k| (spoke(k), spoke(k + 1))).map(|(one, two)| wall((one + two) * 0.5, one, two)).collect()
        }
    }
}

/// The law of a joint: every restitution, with and without friction.
pub(crate) fn law(random: &mut Random) -> ContactLaw {
    let restitution = match random.pick(&[0, 1, 2, 2]) {
        0 => 0.0,
        1 => 1.0,
        _ => random.unit(),
    };
    let tangential = random.pick(&[1.0, 1.0, 0.99, 0.5]);
    ContactLaw { restitution, wall_restitution: restitution, tangential, rest_speed: random.pick(&[0.0, 0.1]) }
}

/// The scene of this seed.
pub(crate) fn joint_scene(seed: u64) -> Scene {
    let random = &mut Random::new(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ 0x9fb2_1c65_1e98_df25);
    let axes = Axes::pick(random);
    let mut walls = match random.pick(&[0, 0, 0, 1, 1, 2, 3]) {
        0 => bend(random, axes),
        1 => tiles(random, axes),
        2 => doubled(random, axes),
        _ => ending(random, axes),
    };
    if random.unit() < 0.4 {
        walls.extend(room_around(12.0));
    }
    let (law, gravity) = (law(random), pull(random));
    let count = random.pick(&[1, 1, 1, 2, 3]);
    let spheres = free_spheres(random, &walls, count, |random, r| {
        // on the first leaf or over the joint: touching, a little above, or high
        let height = match random.pick(&[0, 0, 1, 2]) {
            0 => 0.0,
            1 => random.decade(-12.0, -1.0),
            _ => random.between(0.1, 2.0),
        };
        let first = &walls[0].shape;
        let n = first.s1.cross(first.s2).normalize();
        let n = if n.dot(axes.up) < 0.0 { -n } else { n };
        let (a, b) = (random.between(-0.49, 0.49), random.between(-0.4, 0.4));
        let x = first.center + first.s1 * a + first.s2 * b + n * (r + height);
        let away = random.vector();
        let toward = away - n * away.dot(n) + (axes.along * b - x) * random.pick(&[0.0, 1.0]);
        let speed = random.pick(&[0.0, 1.0, 1.0, 1.0]) * random.decade(-2.0, 0.8);
        let fall = n * -random.pick(&[0.0, 0.0, 1.0]) * random.between(0.0, 3.0);
        (x, (toward - n * toward.dot(n)).normalize_or_zero() * speed + fall)
    });
    scene(gravity, law, walls, spheres)
}
