//! Contacts that hold both ways: u = u₀ + M⁻¹ Jᵀ λ, J u + c = 0. Solved some fifty times per arc of a curved motion, for
//! few bodies: what takes time here is memory, so that little is asked for.

use glam::DVec3;

use super::active_set::DEPENDENT;
use super::factor::{Append, Factor};
use super::gram;
use super::problem::Row;
use super::short::Short;

/// Solves u = `free` + M⁻¹ Jᵀ λ, J u + c = 0: every row holds and may pull. For the time between events, while it is known
/// which contacts hold. Returns u by body and λ by row; a row that depends on others is left to them, with λ = 0.
pub fn bind(inverse_mass: &[f64], free: &[DVec3], rows: &[Row]) -> (Vec<DVec3>, Vec<f64>) {
    match rows {
        [row] => bind_one(inverse_mass, free, row),
        _ => {
            gram::bind(inverse_mass, free, rows, false).unwrap_or_else(|| bind_all(inverse_mass, free, rows, DEPENDENT))
        }
    }
}

/// A row of which less than this share is new is left out where only rounding is to be put right: to close what rounding
/// has left of a gap, 1e-16 m, between two walls whose normals oppose each other within 1e-9 would move a sphere by 1e-7 m
/// across them.
const NEARLY_DEPENDENT: f64 = 1e-5;

/// Solves as [`bind`] does to put right what rounding has left of rows that hold already: u is changed by no more than 1e5
/// times that.
pub fn restore(inverse_mass: &[f64], free: &[DVec3], rows: &[Row]) -> Vec<DVec3> {
    match rows {
        [row] => bind_one(inverse_mass, free, row).0,
        _ => {
            let found = gram::bind(inverse_mass, free, rows, true);
            found.unwrap_or_else(|| bind_all(inverse_mass, free, rows, NEARLY_DEPENDENT)).0
        }
    }
}

/// Solves as [`restore`] does, and again where rows are `unmet` (index, u) by that although they were left out: those come
/// last. Taken one after another as they stand, what rounding makes new of a row that depends on such a one would stop
/// bodies that slide along both.
pub fn restore_unmet(
    inverse_mass: &[f64],
    free: &[DVec3],
    rows: &[Row],
    unmet: impl Fn(usize, &[DVec3]) -> bool,
) -> Vec<DVec3> {
    let u = restore(inverse_mass, free, rows);
    let late: Short<usize> = (0..rows.len()).filter(|&index| unmet(index, &u)).collect();
    if late.is_empty() {
        return u;
    }
    let early = (0..rows.len()).filter(|index| !late.contains(index)).map(|index| (index, NEARLY_DEPENDENT));
    bind_in_order(inverse_mass, free, rows, early.chain(late.iter().map(|&index| (index, DEPENDENT)))).0
}

/// Restores places and velocities (m/s) at once, as [`restore`] does: the shifts (m) that the rows with their offsets, gaps
/// in m, ask for, and the velocities that they leave with none.
pub fn restore_both(inverse_mass: &[f64], velocity: &[DVec3], rows: &[Row]) -> (Vec<DVec3>, Vec<DVec3>) {
    let still: Short<DVec3> = Short::from_elem(DVec3::ZERO, velocity.len());
    let level = |row: &Row| Row { offset: 0.0, ..*row };
    if let [row] = rows {
        return (bind_one(inverse_mass, &still, row).0, bind_one(inverse_mass, velocity, &level(row)).0);
    }
    let level: Short<Row> = rows.iter().map(level).collect();
    let mut factor = gram::Skyline::empty();
    if factor.take(inverse_mass, rows, true) {
        return (factor.bind(inverse_mass, &still, rows).0, factor.bind(inverse_mass, velocity, &level).0);
    }
    let of = |free: &[DVec3], rows: &[Row]| bind_all(inverse_mass, free, rows, NEARLY_DEPENDENT).0;
    (of(&still, rows), of(velocity, &level))
}

/// The shifts (m) that the rows with their offsets, gaps in m, ask for, of which more than `dependent` is new.
pub fn restore_places(inverse_mass: &[f64], rows: &[Row], dependent: f64) -> Vec<DVec3> {
    bind_all(inverse_mass, &vec![DVec3::ZERO; inverse_mass.len()], rows, dependent).0
}

/// Solves as [`bind`] does for a single row, by far the most frequent case, in closed form: λ = −(J u₀ + c)/A.
fn bind_one(inverse_mass: &[f64], free: &[DVec3], row: &Row) -> (Vec<DVec3>, Vec<f64>) {
    let mut u = free.to_vec();
    let weight = inverse_mass[row.a] + row.b.map_or(0.0, |b| inverse_mass[b]);
    let mut total = 0.0;
    // The second turn takes back what rounding has left of the first.
    for _ in 0..2 {
        let relative = u[row.a] - row.b.map_or(DVec3::ZERO, |b| u[b]);
        let force = -(row.normal.dot(relative) + row.offset) / weight;
        total += force;
        u[row.a] += row.normal * (force * inverse_mass[row.a]);
        if let Some(b) = row.b {
            u[b] -= row.normal * (force * inverse_mass[b]);
        }
    }
    (u, vec![total])
}

/// The projection of u₀ onto all rows of which more than `dependent` is new, as the active set does it with those that hold.
/// For unlike masses and rows that nearly depend on others; else [`gram`] is quicker.
fn bind_all(inverse_mass: &[f64], free: &[DVec3], rows: &[Row], dependent: f64) -> (Vec<DVec3>, Vec<f64>) {
    bind_in_order(inverse_mass, free, rows, (0..rows.len()).map(|index| (index, dependent)))
}

/// The projection of u₀ onto the rows with these indices, taken in this order, each if more than its share is new: weighted
/// by √m, from Q R of the rows' columns.
fn bind_in_order(
    inverse_mass: &[f64],
    free: &[DVec3],
    rows: &[Row],
    order: impl Iterator<Item = (usize, f64)>,
) -> (Vec<DVec3>, Vec<f64>) {
    let mut factor = Factor::default();
    let (mut holding, mut right) = (Vec::with_capacity(rows.len()), Vec::with_capacity(rows.len()));
    for (index, dependent) in order {
        let row = &rows[index];
        let weight = inverse_mass[row.a] + row.b.map_or(0.0, |b| inverse_mass[b]);
        let length = (weight * row.normal.length_squared()).sqrt();
        if factor.append(column(inverse_mass, row, length), dependent) == Append::Added {
            holding.push((index, length));
            right.push(row.offset / length);
        }
    }
    let y = factor.forward_substitute(&right);
    let mut across = Vec::with_capacity(3 * free.len());
    across.extend(free.iter().zip(inverse_mass).flat_map(|(u, w)| (*u / w.sqrt()).to_array()));
    let parts = factor.project_out(&mut across);
    factor.project_out(&mut across);
    let inside = factor.combine(&y, across.len());
    let at = |body: usize| DVec3::from_slice(&across[3 * body..]) - DVec3::from_slice(&inside[3 * body..]);
    let u = inverse_mass.iter().enumerate().map(|(body, w)| at(body) * w.sqrt()).collect();
    let loads = factor.back_substitute(parts.iter().zip(y).map(|(part, y)| -(part + y)).collect());
    let mut multipliers = vec![0.0; rows.len()];
    for ((index, length), load) in holding.into_iter().zip(loads) {
        multipliers[index] = load / length;
    }
    (u, multipliers)
}

/// The column M^−½ Jᵀ / √A of one row: a unit vector.
fn column(inverse_mass: &[f64], row: &Row, length: f64) -> Vec<f64> {
    let mut column = vec![0.0; 3 * inverse_mass.len()];
    let mut set = |body: usize, normal: DVec3| {
        let part = normal * (inverse_mass[body].sqrt() / length);
        column[3 * body..3 * body + 3].copy_from_slice(&part.to_array());
    };
    set(row.a, row.normal);
    if let Some(b) = row.b {
        set(b, -row.normal);
    }
    column
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix64;

    /// Numbers in [−1, 1).
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut draw = SplitMix64::new(seed);
        move || draw.centered()
    }

    #[test]
    fn the_quick_factor_finds_what_the_orthogonal_one_finds() {
        let mut quick = 0;
        for seed in 0..400_u64 {
            let mut next = numbers(seed);
            let bodies = 2 + seed as usize % 40;
            let mut vector = || DVec3::new(next(), next(), next());
            let free: Vec<DVec3> = (0..bodies).map(|_| vector()).collect();
            // every body on a wall or an earlier one, and half of them once more
            let normals: Vec<DVec3> = (0..bodies + bodies / 2).map(|_| vector().normalize_or(DVec3::Y)).collect();
            let mut next = numbers(!seed);
            let inverse_mass: Vec<f64> = (0..bodies).map(|_| 2.0 + next()).collect();
            let row = |(index, normal): (usize, DVec3)| {
                let (a, other) = (index % bodies, ((next() + 1.0) * 0.5 * bodies as f64) as usize);
                Row { a, b: (other < a).then_some(other), normal, offset: next() }
            };
            let rows: Vec<Row> = normals.into_iter().enumerate().map(row).collect();
            let Some((u, loads)) = gram::bind(&inverse_mass, &free, &rows, false) else { continue };
            quick += 1;
            let (expected, forces) = bind_all(&inverse_mass, &free, &rows, DEPENDENT);
            let size = forces.iter().fold(1.0_f64, |most, force| most.max(force.abs()));
            // the condition of such rows is some thousands at most, and the loads are as large then
            let off = u.iter().zip(&expected).map(|(u, w)| u.distance(*w)).fold(0.0, f64::max);
            assert!(off <= 1e-13 * size, "seed {seed}: u differs by {off:e}, loads of {size}");
            let off = loads.iter().zip(&forces).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
            assert!(off <= 1e-11 * size * size, "seed {seed}: loads differ by {off:e} of {size}");
            for row in &rows {
                let left = row.normal.dot(u[row.a] - row.b.map_or(DVec3::ZERO, |b| u[b])) + row.offset;
                assert!(left.abs() <= 1e-14 * size, "seed {seed}: {left:e} is left");
            }
        }
        assert!(quick > 300, "only {quick} of 400 were independent enough");
    }

    #[test]
    fn the_quick_factor_leaves_a_row_that_depends_on_others_to_them_and_no_other() {
        // two spheres on a floor of two tiles each, the second on the first as well
        let row = |a: usize, b: Option<usize>, normal: DVec3, offset: f64| Row { a, b, normal, offset };
        let slanted = DVec3::new(0.6, 0.8, 0.0);
        let tiles = [row(0, None, DVec3::Y, 0.0), row(0, None, DVec3::Y, 0.0), row(1, Some(0), slanted, 0.25)];
        let free = [DVec3::new(0.3, -9.8, 0.1), DVec3::new(0.0, -9.8, 0.0)];
        let (u, loads) = gram::bind(&[1.0, 0.5], &free, &tiles, false).expect("an answer");
        let expected = bind_all(&[1.0, 0.5], &free, &tiles, DEPENDENT).0;
        assert!(u.iter().zip(&expected).all(|(u, w)| u.distance(*w) < 1e-14), "{u:?} instead of {expected:?}");
        assert_eq!(loads[1], 0.0);
        // what two equal rows ask for differently, or what leans by 1e-7, is not left out
        let torn = [tiles[0], row(0, None, DVec3::Y, 1e-9), tiles[2]];
        assert_eq!(gram::bind(&[1.0, 0.5], &free, &torn, false), None);
        let leaning = [tiles[0], row(0, None, DVec3::new(1e-7, 1.0, 0.0).normalize(), 0.0), tiles[2]];
        assert_eq!(gram::bind(&[1.0, 0.5], &free, &leaning, false), None);
    }

    #[test]
    fn what_rounding_left_between_two_walls_that_oppose_each_other_moves_nothing_across_them() {
        // a sphere between a wall at its left and one at its right that leans by 3e-10: a gap of 1e-16 m is left of the second
        let lean = 3e-10;
        let row = |normal: DVec3, offset: f64| Row { a: 0, b: None, normal, offset };
        let rows = [row(DVec3::X, 0.0), row(DVec3::new(-1.0, lean, 0.0), 1e-16)];
        let shift = restore(&[1.0], &[DVec3::ZERO], &rows)[0];
        assert!(shift.length() <= 1e-16, "{shift}");
        // with normals that differ, both are closed
        let rows = [row(DVec3::X, 1e-16), row(DVec3::Y, 2e-16)];
        let shift = restore(&[1.0], &[DVec3::ZERO], &rows)[0];
        assert!(shift.distance(DVec3::new(-1e-16, -2e-16, 0.0)) < 1e-30, "{shift}");
    }

    #[test]
    fn a_row_that_was_left_out_is_closed_where_it_is_unmet_and_stops_no_other() {
        // Between two rows that oppose each other within 2e-9 rad lies a body that leaves the one by 1e-14 m/s, which is 1e-5
        // m/s across them; another slides along a row of its own.
        let lever = 1e-9;
        let row = |a: usize, normal: DVec3| Row { a, b: None, normal, offset: 0.0 };
        let rows = [
            row(0, DVec3::new(1.0, 0.0, lever)),
            row(0, DVec3::new(-1.0, 0.0, lever)),
            row(1, DVec3::new(0.0, 1.0, 0.0)),
        ];
        let free = [DVec3::new(0.0, 0.5, 1e-5), DVec3::new(0.7, 1e-16, 0.0)];
        let left = restore_unmet(&[1.0, 1.0], &free, &rows, |_, _| false);
        assert!(
            (left[0].z / 1e-5 - 1.0).abs() < 1e-6,
            "no more than a share of 1e-5 is new of the second row: {}",
            left[0]
        );
        let closed =
            restore_unmet(&[1.0, 1.0], &free, &rows, |index, u| rows[index].normal.dot(u[rows[index].a]).abs() > 1e-15);
        for (u, [y, slides]) in closed.iter().zip([[0.5, 0.0], [0.0, 0.7]]) {
            // an ulp of the speeds; across the two rows, over their angle
            assert!((u.x - slides).abs() <= 1e-15 && (u.y - y).abs() <= 1e-15 && u.z.abs() <= 1e-15 / lever, "{u}");
        }
        let met = |row: &Row| row.normal.dot(closed[row.a]).abs() <= 1e-15;
        assert!(rows.iter().all(met), "{closed:?}");
    }
}
