//! The sets of `enumerate` for normals that nearly coincide or nearly oppose each other.
//!
//! n₁ × n₂ = n₁ × (n₂ ∓ n₁), and the difference of nearly equal numbers is exact (Sterbenz): so taken, the cross product
//! keeps all its digits at any angle. So does n₁·(n₂ × n₃) = (n₁ ∓ n₂)·(n₂ × n₃). What rounding leaves of J u + c is
//! taken back by two steps of iterative refinement.

use glam::DVec3;

use super::candidate::{Candidate, one};
use super::problem::Problem;

/// Sines and volumes of normals below this are rounding of the normals themselves: 2 ulp.
const PARALLEL: f64 = 2.0 * f64::EPSILON;

/// Steps of iterative refinement.
const REFINEMENTS: usize = 2;

/// u and pushes if exactly the contacts of `set` hold (nᵢ·u = −cᵢ); none if they are not independent.
pub(super) fn candidate(problem: &Problem, set: &[usize]) -> Option<Candidate> {
    let (free, normal) = (problem.free[0], |row: usize| problem.rows[row].normal);
    match *set {
        [] => Some(Candidate { u: free, pushes: [(0, 0.0); 3] }),
        [i] => {
            let (u, pushes) = one(problem, i);
            Some(Candidate { u, pushes })
        }
        [i, j] => {
            let t = cross(normal(i), normal(j));
            let square = t.length_squared();
            if square <= PARALLEL * PARALLEL {
                return None;
            }
            let duals = [normal(j).cross(t) / square, t.cross(normal(i)) / square];
            let along = t * (t.dot(free) / square);
            Some(held(problem, set, &duals, along))
        }
        [i, j, k] => {
            let (p, q, r) = (normal(i), normal(j), normal(k));
            let faces = [cross(q, r), cross(r, p), cross(p, q)];
            let volume = volume([p, q, r], faces);
            let largest = faces.iter().map(|face| face.length()).fold(0.0, f64::max);
            if volume.abs() <= PARALLEL * largest {
                return None;
            }
            Some(held(problem, set, &faces.map(|face| face / volume), DVec3::ZERO))
        }
        _ => None,
    }
}

/// The answer u with nᵢ·u = −cᵢ for the rows of `set`, from `along`, which moves none of them. `duals` are the vectors dᵢ
/// with nᵢ·dⱼ = 1 for i = j and 0 otherwise.
fn held(problem: &Problem, set: &[usize], duals: &[DVec3], along: DVec3) -> Candidate {
    let mut u = along;
    for (&row, &dual) in set.iter().zip(duals) {
        u -= dual * problem.rows[row].offset;
    }
    for _ in 0..REFINEMENTS {
        let left: Vec<f64> = set.iter().map(|&row| problem.opening(row, &[u])).collect();
        for (left, &dual) in left.into_iter().zip(duals) {
            u -= dual * left;
        }
    }
    let change = u - problem.free[0];
    let mut pushes = [(set[0], 0.0); 3];
    for ((push, &row), dual) in pushes.iter_mut().zip(set).zip(duals) {
        *push = (row, dual.dot(change));
    }
    Candidate { u, pushes }
}

/// Cross product p × q, by the difference or the sum of the two, whichever is shorter.
fn cross(p: DVec3, q: DVec3) -> DVec3 {
    p.cross(nearer(q, p))
}

/// Difference q − p or sum q + p, whichever is shorter.
fn nearer(q: DVec3, p: DVec3) -> DVec3 {
    if p.dot(q) < 0.0 { q + p } else { q - p }
}

/// Volume p·(q × r) of three normals, whose cross products are given, by the two that are nearest to a line.
fn volume([p, q, r]: [DVec3; 3], faces: [DVec3; 3]) -> f64 {
    // the third vector may be changed by any multiple of the other two
    let ways = [(nearer(p, q), faces[0]), (nearer(q, r), faces[1]), (nearer(r, p), faces[2])];
    let least = |one: (DVec3, DVec3), two: (DVec3, DVec3)| {
        let size = |(edge, face): (DVec3, DVec3)| edge.length_squared() * face.length_squared();
        if size(two) < size(one) { two } else { one }
    };
    let (edge, face) = least(least(ways[0], ways[1]), ways[2]);
    edge.dot(face)
}
