//! The horizon of a scene: the time until a displacement of 1e-12 m has grown by 1e6. Beyond it positions mean nothing:
//! two correct programs that round differently have parted.

use std::ops::ControlFlow;

use glam::{DVec3, dvec3};

use super::deviation::Deviation;
use super::reference::Reference;
use super::walk::{Budget, Cut, walk};
use super::{GoOn, Interrupted};
use crate::geometry::Parallelogram;
use crate::physics::{Scene, Simulation};

/// How many displaced runs are tried; the worst counts.
pub(super) const RUNS: u64 = 8;

/// By how much each sphere is displaced, m.
const DISPLACEMENT: f64 = 1e-12;

/// Far from the origin 1e-12 m round to nothing; there it is so many units in the last place of the largest coordinate.
const ULPS: f64 = 16.0;

/// Growth at which positions are given up.
pub(super) const GROWTH: f64 = 1e6;

/// A gap up to so many displacements is touched: a displacement toward that wall would push into it.
const TOUCH: f64 = 4.0;

/// Up to when a reference means something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Horizon {
    /// The time at which the worst displaced run has grown by 1e6, s; none if none has up to the reference's end.
    pub time: Option<f64>,
    /// The largest growth of a displacement up to there, dimensionless.
    pub growth: f64,
}

impl Horizon {
    /// Nothing is known yet.
    pub(super) fn unknown() -> Horizon {
        Horizon { time: None, growth: 1.0 }
    }
}

/// The horizon of a reference's scene: the worst of 8 runs by the reference's own method, each sphere displaced along
/// a seeded unit vector, away from the walls it touches. Resolution: the reference's instants.
///
/// # Errors
/// If `go_on` says no.
pub(super) fn of(scene: &Scene, reference: &Reference, budget: Budget, go_on: GoOn) -> Result<Horizon, Interrupted> {
    let mut worst = Horizon::unknown();
    for seed in 1..=RUNS {
        let found = one(scene, reference, (seed, budget), worst.time, go_on)?;
        worst.growth = worst.growth.max(found.growth);
        worst.time = [worst.time, found.time].into_iter().flatten().min_by(f64::total_cmp);
    }
    Ok(worst)
}

/// One displaced run, watched no longer than to the horizon known so far (s).
fn one(
    scene: &Scene,
    reference: &Reference,
    (seed, budget): (u64, Budget),
    known: Option<f64>,
    go_on: GoOn,
) -> Result<Horizon, Interrupted> {
    let length = displacement(scene);
    let mut simulation = Simulation::new(&displaced(scene, seed, length), reference.settings);
    let mut found = Horizon { time: None, growth: 1.0 };
    let walked = walk(&mut simulation, reference.instants, budget, go_on, |k, state| {
        let Some(positions) = reference.positions(k) else { return ControlFlow::Break(()) };
        found.growth = found.growth.max(Deviation::between(&state.x, positions).distance / length);
        if found.growth >= GROWTH {
            found.time = Some(state.t);
        }
        let enough = found.time.is_some() || known.is_some_and(|known| state.t >= known);
        if enough { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    if matches!(walked.cut, Some(Cut::Stalled(_) | Cut::Spent)) && walked.end < reference.end {
        found.time = Some(walked.end); // what displaced spheres cannot follow, nobody can trust
    }
    Ok(found)
}

/// How far to displace, m.
pub(super) fn displacement(scene: &Scene) -> f64 {
    let largest = scene.spheres.iter().map(|sphere| sphere.x.abs().max_element()).fold(0.0, f64::max);
    DISPLACEMENT.max(ULPS * (largest.next_up() - largest))
}

/// The scene with every sphere `length` m aside.
pub(super) fn displaced(scene: &Scene, seed: u64, length: f64) -> Scene {
    let mut random = Random(seed);
    let mut aside = scene.clone();
    for sphere in &mut aside.spheres {
        let mut way = random.unit_vector();
        for wall in &scene.walls {
            way = away(way, &wall.shape, sphere.x, sphere.radius + TOUCH * length);
        }
        sphere.x += way * length;
    }
    aside
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

/// SplitMix64: the same directions everywhere.
struct Random(u64);

impl Random {
    /// In [−1, 1).
    fn centered(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Evenly over the sphere: points of the cube until one lies in the ball.
    fn unit_vector(&mut self) -> DVec3 {
        loop {
            let point = dvec3(self.centered(), self.centered(), self.centered());
            let length = point.length();
            if (0.1..=1.0).contains(&length) {
                return point / length;
            }
        }
    }
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

    #[test]
    fn directions_are_unit_vectors_and_repeat() {
        let directions = || [0; 9].map(|_| Random(7).unit_vector());
        assert_eq!(directions(), directions());
        // Division by the length rounds each coordinate once: 3 half units in the last place.
        assert!(directions().iter().all(|way| (way.length() - 1.0).abs() < 4e-16));
    }
}
