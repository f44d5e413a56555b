//! Runs of a scene whose spheres begin a little aside, and how far they part from the run as it is.

use glam::DVec3;

use super::deviation::Deviation;
use crate::geometry::Parallelogram;
use crate::physics::Simulation;
use crate::random::SplitMix64;
use crate::scene::{Scene, Settings, Wall};

/// How many displaced runs are tried; the worst counts.
pub(super) const RUNS: u64 = 8;

/// Displacement of each sphere, m.
const DISPLACEMENT: f64 = 1e-12;

/// Displacement far from the origin, in units in the last place of the largest coordinate: 1e-12 m would round to nothing.
const ULPS: f64 = 16.0;

/// Growth at which positions are given up.
const GROWTH: f64 = 1e6;

/// Largest gap to a wall that counts as touched, in displacements: a displacement toward that wall would push into it.
const TOUCH: f64 = 4.0;

/// How far a displaced run has parted from the run that it is compared with.
#[derive(Debug, Clone)]
pub(super) struct Parting {
    /// Displacement of each sphere at the start, m.
    length: f64,
    /// Largest growth of the displacement up to now, dimensionless.
    pub(super) growth: f64,
}

impl Parting {
    /// Compares the centres (m) of both runs at one time; whether positions are to be given up from here on.
    pub(super) fn compare(&mut self, displaced: &[DVec3], as_it_is: &[DVec3]) -> bool {
        self.growth = self.growth.max(Deviation::between(displaced, as_it_is).distance / self.length);
        self.growth >= GROWTH
    }
}

/// A run of the scene with every sphere displaced by 1e-12 m along a seeded unit vector, away from the walls it touches.
pub(super) fn displaced(scene: &Scene, settings: Settings, seed: u64) -> (Simulation, Parting) {
    let length = displacement(scene);
    (Simulation::new(&aside(scene, seed, length), settings), Parting { length, growth: 1.0 })
}

/// How far to displace, m.
fn displacement(scene: &Scene) -> f64 {
    let largest = scene.spheres.iter().map(|sphere| sphere.x.abs().max_element()).fold(0.0, f64::max);
    DISPLACEMENT.max(ULPS * (largest.next_up() - largest))
}

/// The scene with every sphere `length` m aside.
pub(super) fn aside(scene: &Scene, seed: u64, length: f64) -> Scene {
    let mut random = SplitMix64::new(seed);
    let places = scene.spheres.iter().map(|sphere| {
        let reach = sphere.radius + TOUCH * length;
        let turned = |way, wall: &Wall| away(way, &wall.shape, sphere.x, reach);
        sphere.x + scene.walls.iter().fold(random.unit_vector(), turned) * length
    });
    let places: Vec<DVec3> = places.collect();
    let v: Vec<DVec3> = scene.spheres.iter().map(|sphere| sphere.v).collect();
    scene.moved(&places, &v).expect("a displacement of some ulp keeps a coordinate finite")
}

/// The direction, turned back where it points into a wall whose closest point is within `reach` (m) of `x`.
fn away(way: DVec3, wall: &Parallelogram, x: DVec3, reach: f64) -> DVec3 {
    let offset = wall.closest(x).offset;
    let distance = offset.length();
    if distance > reach || distance == 0.0 {
        return way;
    }
    let normal = offset / distance;
    let toward = way.dot(normal).min(0.0);
    way - normal * (2.0 * toward)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_displacement_never_points_into_a_wall_that_is_touched() {
        let floor = Parallelogram { center: DVec3::ZERO, s1: DVec3::X, s2: DVec3::Z };
        for (way, turned) in [(-DVec3::Y, DVec3::Y), (DVec3::Y, DVec3::Y), (DVec3::X, DVec3::X)] {
            assert_eq!(away(way, &floor, DVec3::Y * 0.5, 0.5 + 4e-12), turned);
            assert_eq!(away(way, &floor, DVec3::Y * 0.6, 0.5 + 4e-12), way, "a wall out of reach");
        }
    }
}
