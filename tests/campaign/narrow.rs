//! Where little room is left: funnels with redundant supports, tubes as wide as the sphere, stacks on seams.

use std::f64::consts::TAU;

use carom::physics::Scene;
use carom::scene::{Sphere, Wall};
use glam::{DVec3, dvec3};

use crate::joints::{Axes, law};
use crate::place::{free_spheres, pull, room_around};
use crate::random::Random;
use crate::support::{G, scene, sphere, wall};

/// A funnel of 3 to 8 walls that meet at the origin, and spheres above it.
pub(crate) fn funnel_scene(seed: u64) -> Scene {
    let random = &mut Random::new(seed.wrapping_mul(0x9e6c_63d0_876a_68ee) ^ 0x1234_5678_9abc_def1);
    let count = random.pick(&[3, 4, 4, 5, 6, 7, 8]);
    let regular = random.unit() < 0.6;
    let (steep, turn) = (random.between(0.15, 1.2), random.pick(&[0.0, 1.0]) * random.between(0.0, TAU));
    let mut walls: Vec<Wall> = Vec::new();
    for k in 0..count {
        let bend = if regular { 0.0 } else { random.between(-0.25, 0.25) };
        let (sin, cos) = (turn + (f64::from(k) + bend) * TAU / f64::from(count)).sin_cos();
        let steep = if regular { steep } else { steep * random.between(0.8, 1.2) };
        let up = dvec3(cos * steep.cos(), steep.sin(), sin * steep.cos());
        let side = dvec3(-sin, 0.0, cos);
        walls.push(wall(up * 3.0, up * 6.0, side * 12.0));
    }
    let law = law(random);
    let count = random.pick(&[1, 1, 1, 2, 4]);
    let spheres = free_spheres(random, &walls, count, |random, r| {
        let off = random.pick(&[0.0, 0.0, 1.0]) * random.between(0.0, 1.0);
        let away = random.vector() * off;
        let x = dvec3(away.x, (r / steep.cos()) * random.pick(&[1.0, 1.5, 3.0]) + 2.0 * off, away.z);
        (x, random.vector() * random.pick(&[0.0, 0.0, 1.0, 3.0]))
    });
    scene(G, law, walls, spheres)
}

/// Spheres between two parallel walls, or in a tube of four, as wide as they are or nearly so. Where nothing is lost the gap
/// is 1e-4 r at least, or none: across a narrower one the law itself has up to a billion impacts a second.
pub(crate) fn tube_scene(seed: u64) -> Scene {
    let random = &mut Random::new(seed.wrapping_mul(0xd6e8_feb8_6659_fd93) ^ 0x0f0f_1e1e_2d2d_3c3c);
    let axes = Axes::pick(random);
    let r = random.pick(&[0.5, 0.3, 0.1]);
    let play = match random.pick(&[0, 0, 1, 2]) {
        0 => 0.0,
        1 => random.decade(-15.0, -9.0),
        _ => random.decade(-9.0, -1.0),
    };
    let law = law(random);
    let play = if law.wall_restitution == 1.0 && play < 1e-4 { 0.0 } else { play };
    let half = r * (1.0 + play);
    let plate = |n: DVec3, other: DVec3| wall(n * half, other * 4.0, axes.along * 20.0);
    let mut walls = vec![plate(axes.up, axes.across), plate(-axes.up, axes.across)];
    if random.unit() < 0.5 {
        walls.extend([plate(axes.across, axes.up), plate(-axes.across, axes.up)]);
    }
    if random.unit() < 0.5 {
        walls.push(wall(axes.along * 4.0, axes.up * 2.0, axes.across * 2.0));
    }
    let count = random.pick(&[1, 1, 2, 3]);
    let (mut spheres, mut free): (Vec<Sphere>, f64) = (Vec::new(), f64::NEG_INFINITY);
    for k in 0..count {
        let place = f64::from(k) * (2.0 * r + random.pick(&[0.0, 0.3, 0.7])) - 1.0;
        let place = if place < free - 1e-9 * r { free } else { place }; // not into the one before
        free = place + 2.0 * r;
        let x = axes.along * place + axes.up * (half - r) * random.pick(&[0.0, 1.0, -1.0]);
        let slide = axes.along * random.between(-3.0, 3.0);
        let rattle = axes.up * random.pick(&[0.0, 0.0, 0.0, 1.0]) * random.between(-1.0, 1.0);
        spheres.push(Sphere { mass: random.pick(&[1.0, 1.0, 10.0]), ..sphere(x, slide + rattle, r) });
    }
    scene(pull(random), law, walls, spheres)
}

/// A stack, a row or a pyramid of equal spheres that touch, on the seams of a floor.
pub(crate) fn stack_scene(seed: u64) -> Scene {
    let random = &mut Random::new(seed.wrapping_mul(0xa076_1d64_78bd_642f) ^ 0x5555_aaaa_3333_cccc);
    let r = random.pick(&[0.25, 0.3, 0.5]);
    let width = random.pick(&[2.0 * r, 1.0, 0.7]);
    let tile = |k: i32| wall(dvec3((f64::from(k) + 0.5) * width, 0.0, 0.0), DVec3::X * width, DVec3::Z * 8.0);
    let mut walls: Vec<Wall> = (-6..6).map(tile).collect();
    let gap = random.pick(&[0.0, 0.0, 1e-9, 0.01]);
    let step = 2.0 * r * (1.0 + gap);
    let places: Vec<DVec3> = match random.pick(&[0, 1, 2, 3]) {
        0 => (0..random.pick(&[2, 3, 5])).map(|k| dvec3(0.0, r + f64::from(k) * step, 0.0)).collect(),
        1 => (0..random.pick(&[2, 4, 6])).map(|k| dvec3(f64::from(k) * step - 2.0 * r, r, 0.0)).collect(),
        2 => {
            let rise = 0.75_f64.sqrt() * step;
            let at =
                |row: u32, k: u32| dvec3((f64::from(k) + 0.5 * f64::from(row)) * step, r + f64::from(row) * rise, 0.0);
            (0..3).flat_map(|row| (0..3 - row).map(move |k| (row, k))).map(|(row, k)| at(row, k)).collect()
        }
        _ => {
            let (side, height) = (step / 3_f64.sqrt(), (2.0_f64 / 3.0).sqrt() * step);
            let corner = |k: u32| {
                let (sin, cos) = (f64::from(k) * TAU / 3.0).sin_cos();
                dvec3(side * cos, r, side * sin)
            };
            (0..3).map(corner).chain([dvec3(0.0, r + height, 0.0)]).collect()
        }
    };
    if random.unit() < 0.5 {
        walls.extend(room_around(8.0));
    }
    let law = law(random);
    let push = random.vector() * random.pick(&[0.0, 0.0, 0.1, 2.0]);
    let body = |(k, x): (usize, DVec3)| sphere(x, if k == 0 { dvec3(push.x, 0.0, push.z) } else { DVec3::ZERO }, r);
    let mut spheres: Vec<Sphere> = places.into_iter().enumerate().map(body).collect();
    if random.unit() < 0.3 {
        spheres.push(sphere(dvec3(random.between(-0.2, 0.2), 6.0, 0.0), DVec3::ZERO, r));
    }
    scene(G, law, walls, spheres)
}
