//! One body on a few walls: try every set of at most three contacts that could carry it.
//!
//! Source: Karush–Kuhn–Tucker conditions of the projection of u₀ onto {u: nᵢ·u + cᵢ ≥ 0}; in space three independent
//! contacts fix u, so no larger set is needed. Two faces leave the motion along their crease, three leave none. All
//! formulas are symmetric in the contacts, so that mirror images give mirror images up to rounding.

use glam::DVec3;

use super::problem::{Problem, ROUNDING};

/// Most contacts for which all sets are tried (92 sets at 8).
pub(super) const LIMIT: usize = 8;

/// A set of contacts that might carry the body.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    u: DVec3,
    forces: [(usize, f64); 3],
    /// Worst violation over all conditions, in units of u; 0 if none.
    violation: f64,
}

/// Multipliers and u of a problem of one body with at most [`LIMIT`] contacts.
///
/// The smallest set that satisfies every condition to rounding is taken; should rounding refuse all, the one that
/// violates least. Returns the multipliers, u, and the number of sets tried.
pub(super) fn solve(problem: &Problem) -> (Vec<f64>, DVec3, usize) {
    let count = problem.rows.len();
    let mut best: Option<Candidate> = None;
    let mut tried = 0;
    for set in sets(count) {
        tried += 1;
        let Some(candidate) = candidate(problem, &set) else { continue };
        if best.is_none_or(|best| candidate.violation < best.violation) {
            best = Some(candidate);
        }
        if candidate.violation == 0.0 {
            break;
        }
    }
    let mut multipliers = vec![0.0; count];
    let Some(best) = best else { return (multipliers, problem.free[0], tried) };
    for (row, force) in best.forces {
        multipliers[row] += force.max(0.0);
    }
    (multipliers, best.u, tried)
}

/// The sets of 0, 1, 2, 3 of `count` contacts, in lexicographic order within a size.
fn sets(count: usize) -> impl Iterator<Item = Vec<usize>> {
    let one = (0..count).map(|i| vec![i]);
    let two = (0..count).flat_map(move |i| (i + 1..count).map(move |j| vec![i, j]));
    let three =
        (0..count).flat_map(move |i| (i + 1..count).flat_map(move |j| (j + 1..count).map(move |k| vec![i, j, k])));
    std::iter::once(Vec::new()).chain(one).chain(two).chain(three)
}

/// u and multipliers if exactly the contacts of `set` hold (nᵢ·u = −cᵢ); none if they are not independent.
fn candidate(problem: &Problem, set: &[usize]) -> Option<Candidate> {
    let inverse_mass = problem.inverse_mass[0];
    let free = problem.free[0];
    let (u, forces) = match *set {
        [] => (free, [(0, 0.0); 3]),
        [i] => one(problem, i),
        [i, j] => two(problem, i, j)?,
        [i, j, k] => three(problem, i, j, k)?,
        _ => return None,
    };
    let forces = forces.map(|(row, push)| (row, push / inverse_mass));
    Some(Candidate { u, forces, violation: violation(problem, u, &forces) })
}

/// One contact: u keeps its tangential part. Corrected once, so that n·u + c is 0 to the last digit.
fn one(problem: &Problem, i: usize) -> (DVec3, [(usize, f64); 3]) {
    let (free, row) = (problem.free[0], &problem.rows[i]);
    let push = -(row.normal.dot(free) + row.offset);
    let u = free + row.normal * push;
    let u = u - row.normal * (row.normal.dot(u) + row.offset);
    (u, [(i, push), (i, 0.0), (i, 0.0)])
}

/// Two contacts: u = t (t·u₀)/t² along the crease t = n₁ × n₂, plus what the offsets ask across it.
fn two(problem: &Problem, i: usize, j: usize) -> Option<(DVec3, [(usize, f64); 3])> {
    let (free, p, q) = (problem.free[0], &problem.rows[i], &problem.rows[j]);
    let crease = p.normal.cross(q.normal);
    let square = crease.length_squared();
    if square <= ROUNDING * ROUNDING {
        return None;
    }
    // d₁ = (n₂ × t)/t² has n₁·d₁ = 1, n₂·d₁ = 0, and lies across the crease; d₂ likewise.
    let (d1, d2) = (q.normal.cross(crease) / square, crease.cross(p.normal) / square);
    let u = crease * (crease.dot(free) / square) - (d1 * p.offset + d2 * q.offset);
    let change = u - free;
    Some((u, [(i, d1.dot(change)), (j, d2.dot(change)), (i, 0.0)]))
}

/// Three contacts: they fix u; it is 0 if no offset asks otherwise.
fn three(problem: &Problem, i: usize, j: usize, k: usize) -> Option<(DVec3, [(usize, f64); 3])> {
    let [p, q, r] = [i, j, k].map(|row| &problem.rows[row]);
    let (qr, rp, pq) = (q.normal.cross(r.normal), r.normal.cross(p.normal), p.normal.cross(q.normal));
    let volume = p.normal.dot(qr);
    // Contacts through one line are dependent; two of them do as well as three.
    if volume.abs() <= ROUNDING {
        return None;
    }
    let u = -(qr * p.offset + rp * q.offset + pq * r.offset) / volume;
    let change = (u - problem.free[0]) / volume;
    Some((u, [(i, qr.dot(change)), (j, rp.dot(change)), (k, pq.dot(change))]))
}

/// Worst pull of a contact that only pushes, or approach of one that should open; 0 if all within rounding.
fn violation(problem: &Problem, u: DVec3, forces: &[(usize, f64); 3]) -> f64 {
    let inverse_mass = problem.inverse_mass[0];
    let pushed: f64 = forces.iter().map(|(_, force)| force.abs() * inverse_mass).sum();
    let tolerance = ROUNDING * (problem.free[0].length() + pushed);
    let pull = forces.iter().map(|(_, force)| -force * inverse_mass).fold(0.0, f64::max);
    let approach = (0..problem.rows.len()).map(|row| -problem.opening(row, &[u])).fold(0.0, f64::max);
    let offset = problem.rows.iter().map(|row| row.offset.abs()).fold(0.0, f64::max);
    let worst = pull.max(approach);
    if worst <= tolerance + ROUNDING * offset { 0.0 } else { worst }
}
