//! Heaps of 12 to 30 spheres that fall into bins and come to rest on each other: on both sides of the number from which
//! spheres are kept in cells.

use carom::physics::Scene;
use carom::scene::{ContactLaw, Sphere, Wall};
use glam::{DVec3, dvec3};

use crate::random::Random;
use crate::support::{G, room, scene, sphere, wall};

/// The scene of this seed.
pub(crate) fn heap_scene(seed: u64) -> Scene {
    let random = &mut Random::new(seed.wrapping_mul(0x9fb2_1c65_1e98_df25) ^ 0x3333_7777_0f0f_5a5a);
    let count = 12 + (18.0 * random.unit()) as usize;
    let alike = random.unit() < 0.5;
    // bins no wider than three spheres, or one wide box; sometimes as thin as a sphere
    let bins = random.pick(&[1, 2, 4, 6]);
    let half = dvec3(0.45 * f64::from(bins), 3.0, random.pick(&[0.2, 0.25, 0.5, 0.9]));
    let mut walls = room(dvec3(-half.x, 0.0, -half.z), half);
    walls.extend((1..bins).map(|k| divider(-half.x + 0.9 * f64::from(k), random.between(0.5, 1.5), half.z)));
    let mut spheres: Vec<Sphere> = Vec::new();
    for _ in 0..50 * count {
        let r = if alike { 0.15 } else { random.between(0.08, 0.2) };
        let place = |random: &mut Random, half: f64| random.between(r - half, half - r);
        let x = dvec3(place(random, half.x), random.between(r, 2.9 - r), place(random, half.z.max(1.01 * r)));
        let free = |wall: &Wall| wall.shape.distance(x) > r;
        if walls.iter().all(free) && spheres.iter().all(|s| s.x.distance(x) > s.radius + r) {
            spheres.push(Sphere { mass: random.pick(&[1.0, 1.0, 1.0, 5.0]), ..sphere(x, DVec3::ZERO, r) });
        }
        if spheres.len() == count {
            break;
        }
    }
    let law = ContactLaw {
        restitution: random.pick(&[0.0, 0.2, 0.5, 0.8]),
        wall_restitution: random.pick(&[0.0, 0.2, 0.5, 0.8]),
        tangential: random.pick(&[0.0, 0.3, 1.0]),
        rest_speed: random.pick(&[0.05, 0.25]),
    };
    scene(G, law, walls, spheres)
}

/// An upright wall across the box at `x`, so high, m.
fn divider(x: f64, height: f64, depth: f64) -> Wall {
    wall(dvec3(x, 0.5 * height, 0.0), DVec3::Y * height, DVec3::Z * (2.0 * depth))
}
