//! The horizon of a scene: the time until a displacement of 1e-12 m has grown by 1e6. Beyond it positions mean nothing:
//! two correct programs that round differently have parted.

use std::ops::ControlFlow;

use glam::DVec3;

use super::deviation::Deviation;
use super::interrupt::{GoOn, Interrupted};
use super::reference::{Horizon, Reference};
use super::sample::{Budget, EndReason, sample};
use crate::geometry::Parallelogram;
use crate::physics::Simulation;
use crate::random::SplitMix64;
use crate::scene::{Scene, Wall};

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
    let sampled = sample(&mut simulation, reference.instants, budget, go_on, |k, state| {
        let Some(positions) = reference.positions(k) else { return ControlFlow::Break(()) };
        found.growth = found.growth.max(Deviation::between(&state.x, positions).distance / length);
        if found.growth >= GROWTH {
            found.time = Some(state.t);
        }
        let enough = found.time.is_some() || known.is_some_and(|known| state.t >= known);
        if enough { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    if matches!(sampled.end_reason, Some(EndReason::Stalled(_) | EndReason::Spent)) && sampled.end < reference.end {
        found.time = Some(sampled.end); // beyond the end of a displaced run, positions cannot be trusted
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
    let mut random = SplitMix64::new(seed);
    let aside = scene.spheres.iter().map(|sphere| {
        let reach = sphere.radius + TOUCH * length;
        let turned = |way, wall: &Wall| away(way, &wall.shape, sphere.x, reach);
        sphere.x + scene.walls.iter().fold(random.unit_vector(), turned) * length
    });
    let aside: Vec<DVec3> = aside.collect();
    let v: Vec<DVec3> = scene.spheres.iter().map(|sphere| sphere.v).collect();
    scene.moved(&aside, &v).expect("a displacement of some ulp keeps a coordinate finite")
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
