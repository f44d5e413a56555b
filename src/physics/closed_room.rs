//! Which walls' edges no sphere can reach: those of a closed room around all spheres.

use glam::DVec3;

use crate::geometry::{Bounds, Parallelogram};

/// How far a wall may fall short of the room's corner, in units of the smallest radius: centres stay farther than that
/// from every wall, so no foot ever lands in the missing strip.
const SHORTFALL: f64 = 1e-9;

/// By wall, whether none of its edges can be reached from inside the room.
///
/// Claimed only for the simplest case: an axis-aligned box holds all centres, and each of its six faces lies wholly in
/// one axis-aligned rectangular wall. As long as a centre stays in the box, its foot on each of these walls lies on the
/// face; to leave, it would have to pass a wall. (`paper` lets fast spheres do just that, so it goes on asking for the
/// closest point where a foot does fall off the face.)
pub(super) fn edges_unreachable(walls: &[Parallelogram], centers: &[DVec3], radii: &[f64]) -> Vec<bool> {
    let mut sealed = vec![false; walls.len()];
    let Some(spheres) = Bounds::of(centers.iter().map(|&c| Bounds { min: c, max: c })) else { return sealed };
    let short = SHORTFALL * radii.iter().copied().fold(f64::INFINITY, f64::min);
    let flat: Vec<(usize, usize, Bounds)> = walls
        .iter()
        .enumerate()
        .filter_map(|(w, wall)| flat_axis(wall).map(|axis| (w, axis, wall.bounds())))
        .filter(|(_, axis, wall)| covers(wall, &spheres, *axis, 0.0))
        .collect();
    let Some(six) = nearest(&flat, &spheres) else { return sealed };
    let room = Bounds {
        min: DVec3::from_array([0, 2, 4].map(|k| six[k].2.max[k / 2])),
        max: DVec3::from_array([1, 3, 5].map(|k| six[k].2.min[k / 2])),
    };
    if six.iter().all(|(_, axis, wall)| covers(wall, &room, *axis, short)) {
        for (w, ..) in six {
            sealed[w] = true;
        }
    }
    sealed
}

/// The axis a wall is perpendicular to, if it is an axis-aligned rectangle.
fn flat_axis(wall: &Parallelogram) -> Option<usize> {
    let along = |s: DVec3| (0..3).find(|&k| s[k].abs() == s.abs().element_sum());
    let (a, b) = (along(wall.s1)?, along(wall.s2)?);
    (a != b).then_some(3 - a - b)
}

/// Whether a wall perpendicular to an axis covers the shadow of a box, but for `short` (m) at its sides.
fn covers(wall: &Bounds, shadow: &Bounds, axis: usize, short: f64) -> bool {
    let within = |k: usize| wall.min[k] <= shadow.min[k] + short && wall.max[k] >= shadow.max[k] - short;
    (0..3).filter(|&k| k != axis).all(within)
}

/// The nearest wall below and above all spheres on each axis: x−, x+, y−, y+, z−, z+.
fn nearest(flat: &[(usize, usize, Bounds)], spheres: &Bounds) -> Option<[(usize, usize, Bounds); 6]> {
    let mut six = Vec::with_capacity(6);
    for axis in 0..3 {
        let on_axis = || flat.iter().filter(move |f| f.1 == axis);
        let below = on_axis().filter(|f| f.2.max[axis] < spheres.min[axis]);
        let above = on_axis().filter(|f| f.2.min[axis] > spheres.max[axis]);
        six.push(*below.max_by(|a, b| a.2.max[axis].total_cmp(&b.2.max[axis]))?);
        six.push(*above.min_by(|a, b| a.2.min[axis].total_cmp(&b.2.min[axis]))?);
    }
    six.try_into().ok()
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, dvec3};

    use super::edges_unreachable;
    use crate::geometry::Parallelogram;

    fn wall(center: DVec3, s1: DVec3, s2: DVec3) -> Parallelogram {
        Parallelogram { center, s1, s2 }
    }

    /// The walls of a box about the origin.
    fn room(size: DVec3) -> Vec<Parallelogram> {
        let (x, y, z) = (DVec3::X * size.x, DVec3::Y * size.y, DVec3::Z * size.z);
        [(x, y, z), (y, z, x), (z, x, y)]
            .into_iter()
            .flat_map(|(n, a, b)| [wall(n * 0.5, a, b), wall(n * -0.5, a, -b)])
            .collect()
    }

    #[test]
    fn a_closed_room_around_all_spheres_is_sealed() {
        let centers = [dvec3(0.5, 0.5, 0.5), dvec3(-2.0, 1.0, 3.0)];
        assert_eq!(edges_unreachable(&room(dvec3(10.0, 8.0, 9.0)), &centers, &[0.5, 0.5]), [true; 6]);
    }

    #[test]
    fn a_wall_in_the_middle_stays_open_and_leaves_the_room_sealed() {
        let mut walls = room(DVec3::splat(10.0));
        walls.push(wall(DVec3::ZERO, dvec3(4.0, 3.0, 0.0), DVec3::Z));
        let expected = [true, true, true, true, true, true, false];
        assert_eq!(edges_unreachable(&walls, &[DVec3::splat(3.0)], &[0.5]), expected);
    }

    #[test]
    fn a_room_with_a_gap_a_missing_wall_or_a_sphere_outside_is_not() {
        let inside = [DVec3::ZERO];
        let whole = room(DVec3::splat(10.0));
        let mut gap = whole.clone();
        gap[0].s1 *= 0.999;
        let mut tilted = whole.clone();
        tilted[2].s1 += DVec3::Y * 1e-3;
        for walls in [&gap, &tilted, &whole[..5].to_vec()] {
            assert!(!edges_unreachable(walls, &inside, &[0.5]).contains(&true));
        }
        assert!(!edges_unreachable(&whole, &[DVec3::ZERO, DVec3::X * 6.0], &[0.5, 0.5]).contains(&true));
    }
}
