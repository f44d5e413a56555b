//! Crowds from 65 to 400 spheres: dilute ones, of all sizes, a giant among dust, one that escapes into the open.

use carom::physics::Scene;
use carom::scene::Sphere;
use glam::DVec3;

use crate::joints::law;
use crate::place::{pull, room_around};
use crate::random::Random;
use crate::support::{scene, sphere};

/// The scene of this seed.
pub(crate) fn crowd_scene(seed: u64) -> Scene {
    let random = &mut Random::new(seed.wrapping_mul(0xc2b2_ae3d_27d4_eb4f) ^ 0x7777_1111_9999_4242);
    let count = 65 + (335.0 * random.unit() * random.unit()) as usize;
    let half = 5.0;
    let (kind, small) = (random.pick(&[0, 1, 2, 3]), random.decade(-5.0, -1.3));
    let size = |random: &mut Random, k: usize| match kind {
        0 => small,
        1 => random.decade(-4.0, -0.7),
        2 if k == 0 => 2.0,
        _ => small.min(0.1),
    };
    let speed = random.pick(&[0.0, 1.0, 3.0]);
    let mut spheres: Vec<Sphere> = Vec::new();
    for _ in 0..20 * count {
        let r = size(random, spheres.len());
        let x = random.vector() * (half - r) * 0.999;
        let free = spheres.iter().all(|s| (s.x - x).length() > s.radius + r);
        if free {
            let mass = if random.unit() < 0.5 { 1.0 } else { (r / 0.05) * (r / 0.05) * (r / 0.05) };
            spheres.push(Sphere { mass, ..sphere(x, random.vector() * speed, r) });
        }
        if spheres.len() == count {
            break;
        }
    }
    let walls = if kind == 3 { Vec::new() } else { room_around(half) };
    let mut law = law(random);
    // what settles costs its contacts, which is another question
    let gravity = if kind == 3 { DVec3::ZERO } else { pull(random) * random.pick(&[0.0, 0.0, 1.0]) };
    if gravity != DVec3::ZERO {
        (law.restitution, law.wall_restitution) = (1.0, 1.0);
    }
    scene(gravity, law, walls, spheres)
}
