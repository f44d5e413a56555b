//! Spheres right beside a place where walls meet, by up to 1e-7 m, where the closest points of two walls nearly coincide:
//! tiles, ridges, steps, T-junctions, walls that cover each other, off each other by as little.

use carom::physics::Scene;
use carom::scene::Wall;
use glam::DVec3;

use crate::joints::{Axes, angle, law};
use crate::place::{free_spheres, pull};
use crate::random::Random;
use crate::support::{scene, wall};

/// Length of a wall along the seam, m.
const LENGTH: f64 = 8.0;

/// Nothing, or up to 1e-7 m to either side.
fn hair(random: &mut Random) -> f64 {
    random.pick(&[0.0, 1.0, -1.0]) * random.decade(-16.0, -7.0)
}

/// A wall from a place across the seam and above it (m) outwards along `out` (m), as long as `share` of the seam from
/// `first` of it on.
fn leaf(axes: Axes, (across, up): (f64, f64), out: DVec3, (first, share): (f64, f64)) -> Wall {
    let corner = axes.across * across + axes.up * up + axes.along * ((first - 0.5) * LENGTH);
    let side = axes.along * (share * LENGTH);
    wall(corner + (out + side) * 0.5, out, side)
}

/// What lies beyond the seam of a floor, and where along the seam (m) it is divided, if it is.
fn beyond(random: &mut Random, axes: Axes) -> (Vec<Wall>, Option<f64>) {
    let whole = (0.0, 1.0);
    let at = (hair(random), hair(random));
    let flat = axes.across * 4.0;
    match random.pick(&[0, 0, 1, 1, 2, 3, 4, 5]) {
        0 => (vec![leaf(axes, at, flat, whole)], None),
        1 => {
            let angle = angle(random);
            (vec![leaf(axes, at, axes.slope(angle) * 4.0, whole)], None)
        }
        2 => {
            let split = random.between(0.3, 0.7);
            let other = (at.0, if random.unit() < 0.5 { at.1 } else { hair(random) });
            let walls = vec![leaf(axes, at, flat, (0.0, split)), leaf(axes, other, flat, (split, 1.0 - split))];
            (walls, Some((split - 0.5) * LENGTH))
        }
        3 => {
            let step = random.pick(&[1.0, -1.0]) * random.decade(-4.0, -0.5);
            (vec![leaf(axes, (at.0, step), flat, whole)], None)
        }
        4 => {
            // it begins below the floor, or above it
            let overlap = random.between(0.1, 3.0);
            (vec![leaf(axes, (-overlap, at.1), flat, whole)], None)
        }
        _ => {
            let width = random.decade(-3.0, -0.3);
            let strip = |k: u32| leaf(axes, (at.0 + f64::from(k) * width, at.1), axes.across * width, whole);
            let rest = leaf(axes, (at.0 + 3.0 * width, at.1), flat, whole);
            ((0..3).map(strip).chain([rest]).collect(), None)
        }
    }
}

/// A speed to either side, m/s, or none.
fn speed(random: &mut Random) -> f64 {
    let sign = random.pick(&[0.0, 1.0, -1.0, 1.0, -1.0]);
    sign * if random.unit() < 0.4 { random.decade(-12.0, -3.0) } else { random.decade(-3.0, 0.8) }
}

/// The scene of this seed.
pub(crate) fn seam_scene(seed: u64) -> Scene {
    let random = &mut Random::new(seed.wrapping_mul(0xd134_2543_de82_ef95) ^ 0x6a09_e667_f3bc_c909);
    let axes = Axes::pick(random);
    let (mut walls, corner) = beyond(random, axes);
    let floor = leaf(axes, (0.0, 0.0), axes.across * -4.0, (0.0, 1.0));
    walls.insert(random.below(walls.len() + 1), floor);
    let (law, gravity) = (law(random), pull(random));
    let count = random.pick(&[1, 1, 1, 2, 3, 5]);
    let mut before: Option<(DVec3, f64)> = None;
    let spheres = free_spheres(random, &walls, count, |random, r| {
        let height = match random.pick(&[0, 0, 1, 2]) {
            0 => 0.0,
            1 => hair(random).abs(),
            _ => random.decade(-6.0, 0.0),
        };
        let along = match corner {
            Some(corner) if random.unit() < 0.5 => corner + hair(random),
            _ => random.between(-3.0, 3.0),
        };
        let beside = axes.across * hair(random) + axes.along * along + axes.up * (r + height);
        let x = match (before, random.pick(&[0, 1, 2])) {
            // on the sphere before, or beside it on the floor, touching it to a hair
            (Some((other, radius)), 1) => {
                let lean = axes.across * hair(random) + axes.along * hair(random);
                other + (axes.up + lean).normalize() * (r + radius + hair(random).abs())
            }
            (Some((other, radius)), 2) => {
                let way = random.pick(&[axes.along, -axes.along, axes.across, -axes.across]);
                other + axes.up * (r - radius) + way * (2.0 * (r * radius).sqrt() + hair(random).abs())
            }
            _ => beside,
        };
        before = Some((x, r));
        let fall = random.pick(&[0.0, 0.0, 1.0]) * random.between(0.0, 3.0);
        (x, axes.across * speed(random) + axes.along * speed(random) - axes.up * fall)
    });
    scene(gravity, law, walls, spheres)
}
