//! Rooms with free-standing walls and a few spheres.

use carom::physics::wall::touch;
use carom::physics::{Model, Scene};
use carom::scene::{ContactLaw, Sphere, Wall};
use glam::{DVec3, dvec3};

use crate::random::Random;
use crate::support::{room, scene, wall};

pub(crate) fn law(random: &mut Random) -> ContactLaw {
    let mut restitution = || match random.pick(&[0, 1, 2, 2, 2, 3]) {
        0 => 0.0,
        1 => 1.0,
        2 => random.unit(),
        _ => random.between(0.0, 0.1),
    };
    let (restitution, wall_restitution) = (restitution(), restitution());
    let tangential = random.pick(&[1.0, 0.99, 0.5]);
    ContactLaw { restitution, wall_restitution, tangential, rest_speed: random.pick(&[0.0, 0.1, 0.1]) }
}

/// Free-standing walls: anything, or a V to roll into.
fn obstacles(random: &mut Random) -> Vec<Wall> {
    match random.pick(&[0, 1, 1, 2, 2, 3]) {
        0 => vec![],
        1 => (0..=(3.0 * random.unit()) as usize)
            .map(|_| {
                let center = dvec3(random.between(-4.0, 4.0), random.between(1.0, 8.0), random.between(-4.0, 4.0));
                let s1 = random.vector().normalize_or(DVec3::X) * random.between(0.5, 6.0);
                let s2 = random.vector().normalize_or(DVec3::Z).cross(s1).normalize_or(DVec3::Y);
                wall(center, s1, (s2 + s1 * random.between(-0.1, 0.1)) * random.between(0.5, 4.0))
            })
            .collect(),
        2 => {
            let (a, b) = (random.between(0.2, 1.5), random.between(0.2, 1.5));
            let along = dvec3(0.0, random.pick(&[0.0, 0.0, 0.3]), 6.0);
            vec![
                wall(dvec3(-1.5, 2.0 + 1.5 * a, 0.0), along, dvec3(-3.0, 3.0 * a, 0.0)),
                wall(dvec3(1.5, 2.0 + 1.5 * b, 0.0), along, dvec3(3.0, 3.0 * b, 0.0)),
            ]
        }
        _ => {
            // a bench: flat or tilted, with edges to fall from
            let tilt = random.pick(&[0.0, 0.0, 0.1, 0.3]);
            vec![wall(dvec3(0.0, 3.0, 0.0), dvec3(random.between(1.0, 4.0), tilt, 0.0), dvec3(0.0, 0.0, -2.0))]
        }
    }
}

/// The scene of this seed.
pub(crate) fn room_scene(seed: u64) -> Scene {
    let random = &mut Random::new(seed.wrapping_mul(0x5851_f42d_4c95_7f2d) ^ 0x1405_7b7e_f767_814f);
    let mut walls = room(dvec3(-5.0, 0.0, -5.0), dvec3(5.0, 10.0, 5.0));
    walls.extend(obstacles(random));
    let gravity = match random.pick(&[0, 1, 1, 1, 1, 2]) {
        0 => DVec3::ZERO,
        1 => dvec3(0.0, -9.8, 0.0),
        _ => random.vector() * 9.8,
    };
    let law = law(random);
    let model = Model::new(&scene(gravity, law, walls.clone(), vec![]));
    let mut spheres: Vec<Sphere> = Vec::new();
    let (count, in_line) = (1 + (6.0 * random.unit()) as usize, random.unit() < 0.15);
    let speed = random.pick(&[0.0, 1.0, 5.0, 17.0]);
    for _ in 0..1000 {
        let radius = if in_line { 0.3 } else { random.between(0.2, 0.6) };
        let mut x = dvec3(random.between(-4.4, 4.4), random.between(0.6, 9.4), random.between(-4.4, 4.4));
        let mut v = random.vector() * speed;
        if in_line {
            // on one line: cradles and collapses
            (x.y, x.z, v) = (3.5, 0.0, dvec3(v.x, 0.0, 0.0));
        }
        let free = model.faces.iter().all(|face| touch(face, x, radius).gap > 0.0)
            && spheres.iter().all(|s| (s.x - x).length() > s.radius + radius);
        if free {
            let mass = if in_line { 1.0 } else { random.pick(&[1.0, 1.0, 0.1, 10.0, 3.7]) };
            let force = if random.unit() < 0.1 { random.vector() } else { DVec3::ZERO };
            spheres.push(Sphere { x, v, mass, radius, force, color: None, name: None });
        }
        if spheres.len() == count {
            break;
        }
    }
    scene(gravity, law, walls, spheres)
}
