//! What one line of a scene expands to: a `Room`, a `Lattice`, the velocities of a gas. A seed means the
//! same bits everywhere: only + − × ÷ √, in a fixed order.

use glam::DVec3;

use super::validated::{Color, Wall};
use crate::geometry::{Bounds, Parallelogram};
use crate::random::SplitMix64;

/// The paper's colours: room, right wall, left wall.
const ROOM: Color = [0.725, 0.71, 0.68];
const GREEN: Color = [0.14, 0.45, 0.091];
const RED: Color = [0.63, 0.065, 0.05];

/// The sides of a room, in the order of its walls.
pub(super) const SIDES: [&str; 6] = ["floor", "ceiling", "back", "front", "right", "left"];

/// The six walls of a room that fills `bounds` (m), in the paper's order and directions; in the paper's colours unless
/// `color` is given.
pub(super) fn room(bounds: Bounds, color: Option<Color>) -> [Wall; 6] {
    let (c, size) = (bounds.center(), bounds.size());
    let (x, y, z) = (DVec3::X * size.x, DVec3::Y * size.y, DVec3::Z * size.z);
    let (low, high) = (bounds.min, bounds.max);
    let wall = |center, s1, s2, own| Wall { shape: Parallelogram { center, s1, s2 }, color: color.or(Some(own)) };
    [
        wall(c.with_y(low.y), x, -z, ROOM),
        wall(c.with_y(high.y), x, z, ROOM),
        wall(c.with_z(low.z), x, y, ROOM),
        wall(c.with_z(high.z), -x, y, ROOM),
        wall(c.with_x(high.x), z, y, GREEN),
        wall(c.with_x(low.x), -z, y, RED),
    ]
}

/// Centres (m) of a lattice: x outermost, z innermost; to each coordinate its own jitter · u (m) is added.
pub(super) fn lattice(
    origin: DVec3,
    counts: [usize; 3],
    spacing: f64,
    jitter: f64,
    draw: &mut SplitMix64,
) -> Vec<DVec3> {
    let mut centers = Vec::with_capacity(counts.iter().product());
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            for k in 0..counts[2] {
                let site = origin + DVec3::new(i as f64, j as f64, k as f64) * spacing;
                centers.push(site + draw.units() * jitter);
            }
        }
    }
    centers
}

/// `count` velocities (m/s) of equal masses: Maxwell's distribution with an rms of `speed` on each axis, and no total
/// momentum (to rounding). A single sphere can't have both, and stands still.
pub(super) fn thermal(count: usize, speed: f64, draw: &mut SplitMix64) -> Vec<DVec3> {
    let mut velocities: Vec<DVec3> = Vec::with_capacity(count);
    for _ in 0..count {
        let x = draw.normal();
        let y = draw.normal();
        velocities.push(DVec3::new(x, y, draw.normal()));
    }
    let mean = velocities.iter().sum::<DVec3>() / count as f64;
    velocities.iter_mut().for_each(|v| *v -= mean);
    let variance = velocities.iter().map(|&v| v * v).sum::<DVec3>() / count as f64;
    let scale = |variance: f64| if variance > 0.0 { speed / variance.sqrt() } else { 0.0 };
    let scales = DVec3::new(scale(variance.x), scale(variance.y), scale(variance.z));
    velocities.iter_mut().for_each(|v| *v *= scales);
    velocities
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_room_is_the_paper_s_table() {
        let bounds = Bounds { min: DVec3::new(-5.0, 0.0, -2.5), max: DVec3::new(5.0, 10.0, 17.5) };
        let table = [
            ([0.0, 0.0, 7.5], [10.0, 0.0, 0.0], [0.0, 0.0, -20.0]),
            ([0.0, 10.0, 7.5], [10.0, 0.0, 0.0], [0.0, 0.0, 20.0]),
            ([0.0, 5.0, -2.5], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0]),
            ([0.0, 5.0, 17.5], [-10.0, 0.0, 0.0], [0.0, 10.0, 0.0]),
            ([5.0, 5.0, 7.5], [0.0, 0.0, 20.0], [0.0, 10.0, 0.0]),
            ([-5.0, 5.0, 7.5], [0.0, 0.0, -20.0], [0.0, 10.0, 0.0]),
        ];
        for (wall, (center, s1, s2)) in room(bounds, None).iter().zip(table) {
            let [center, s1, s2] = [center, s1, s2].map(DVec3::from_array);
            assert_eq!(wall.shape, Parallelogram { center, s1, s2 });
        }
    }

    #[test]
    fn a_lattice_runs_x_then_y_then_z_innermost() {
        let centers = lattice(DVec3::ONE, [2, 2, 3], 0.5, 0.0, &mut SplitMix64::new(0));
        assert_eq!(centers.len(), 12);
        assert_eq!(centers[1], DVec3::new(1.0, 1.0, 1.5));
        assert_eq!(centers[3], DVec3::new(1.0, 1.5, 1.0));
        assert_eq!(centers[6], DVec3::new(1.5, 1.0, 1.0));
    }

    #[test]
    fn thermal_speeds_have_the_rms_asked_for_no_momentum_and_a_normal_kurtosis() {
        let n = 20_000;
        let velocities = thermal(n, 2.5, &mut SplitMix64::new(11));
        let mean = velocities.iter().sum::<DVec3>() / n as f64;
        let square = velocities.iter().map(|&v| v * v).sum::<DVec3>() / n as f64;
        let fourth = velocities.iter().map(|&v| v * v * v * v).sum::<DVec3>() / n as f64;
        // Rounding of 20 000 additions of numbers near 2.5.
        assert!(mean.length() < 1e-12, "{mean}");
        for axis in 0..3 {
            assert!((square[axis].sqrt() - 2.5).abs() < 1e-12);
            // Irwin–Hall of twelve: kurtosis 3 − 6/(5·12) = 2.9; its sampling error √(24/n) = 0.035, four of them.
            assert!((fourth[axis] / (square[axis] * square[axis]) - 2.9).abs() < 0.14);
        }
    }
}
