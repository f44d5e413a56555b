//! What faces that hold a sphere leave of its velocity or acceleration u: w = u + Σ λ n with λ ≥ 0, n·w ≥ 0, and λ = 0
//! where n·w > 0. Every set of faces is tried; with independent normals one alone fits.

use super::double::Double;
use super::vector::Vector;

/// Most faces that hold one sphere here: more normals depend on each other.
pub(super) const MOST_FACES: usize = 3;

/// A part of |u| that stands for rounding: a thousand times what the sums here round.
pub(super) const ROUNDING: f64 = 1e-27;

/// What is left of `u`, and by face whether it stays closed; none if no set of faces fits.
pub(super) fn held(u: Vector, normals: &[Vector]) -> Option<(Vector, Vec<bool>)> {
    let small = Double::from(ROUNDING) * u.length();
    (0..1_u32 << normals.len()).find_map(|set| {
        let chosen: Vec<Vector> = (0..normals.len()).filter(|k| set >> k & 1 == 1).map(|k| normals[k]).collect();
        let forces = forces(u, &chosen)?;
        let w = chosen.iter().zip(&forces).fold(u, |sum, (n, force)| sum + *n * *force);
        let fits = forces.iter().all(|force| *force >= -small) && normals.iter().all(|n| n.dot(w) >= -small);
        fits.then(|| (w, normals.iter().map(|n| n.dot(w) <= small).collect()))
    })
}

/// The forces (per mass) of faces that all stay closed, by elimination in the matrix of their normals' products; none if
/// these depend on each other.
fn forces(u: Vector, normals: &[Vector]) -> Option<Vec<Double>> {
    let count = normals.len();
    let mut rows: Vec<Vec<Double>> =
        normals.iter().map(|n| normals.iter().map(|other| n.dot(*other)).chain([-n.dot(u)]).collect()).collect();
    for k in 0..count {
        // of a matrix of products every pivot is the square of a distance: none, where normals depend on each other
        if rows[k][k] <= Double::from(1e-12) {
            return None;
        }
        let pivot = rows[k].clone();
        for row in rows.iter_mut().skip(k + 1) {
            let factor = row[k] / pivot[k];
            row.iter_mut().zip(&pivot).skip(k).for_each(|(value, above)| *value = *value - factor * *above);
        }
    }
    let mut found = vec![Double::ZERO; count];
    for k in (0..count).rev() {
        let rest = (k + 1..count).fold(rows[k][count], |sum, column| sum - rows[k][column] * found[column]);
        found[k] = rest / rows[k][k];
    }
    Some(found)
}
