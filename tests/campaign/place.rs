//! What several generators share: free places, gravity, a room around.

use carom::physics::Model;
use carom::physics::wall::touch;
use carom::scene::{Sphere, Wall};
use glam::DVec3;

use crate::random::Random;
use crate::support::{ELASTIC, G, room, scene, sphere};

/// Mostly that of the ground, sometimes none or any.
pub(crate) fn pull(random: &mut Random) -> DVec3 {
    match random.pick(&[0, 0, 0, 0, 1, 2]) {
        0 => G,
        1 => DVec3::ZERO,
        _ => random.vector() * 9.8,
    }
}

/// A cube of so much from the origin to each wall, m.
pub(crate) fn room_around(half: f64) -> Vec<Wall> {
    room(DVec3::splat(-half), DVec3::splat(half))
}

/// Up to `count` spheres at places (and with velocities) proposed for their radii, as far as they are free: touching is.
pub(crate) fn free_spheres(
    random: &mut Random,
    walls: &[Wall],
    count: usize,
    mut propose: impl FnMut(&mut Random, f64) -> (DVec3, DVec3),
) -> Vec<Sphere> {
    let model = Model::new(&scene(DVec3::ZERO, ELASTIC, walls.to_vec(), vec![]));
    let mut spheres: Vec<Sphere> = Vec::new();
    for _ in 0..200 {
        if spheres.len() == count {
            break;
        }
        let r = random.between(0.2, 0.6);
        let (x, v) = propose(random, r);
        // what is meant to touch may be off by rounding
        let free = model.faces.iter().all(|face| touch(face, x, r).gap >= -1e-13 * r)
            && spheres.iter().all(|s| (s.x - x).length() > s.radius + r);
        if free {
            spheres.push(Sphere { mass: random.pick(&[1.0, 1.0, 0.1, 10.0]), ..sphere(x, v, r) });
        }
    }
    spheres
}
