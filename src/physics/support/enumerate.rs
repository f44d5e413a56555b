//! One body on some walls: try every set of at most three contacts that could carry it.
//!
//! Source: Karush–Kuhn–Tucker conditions of the projection of u₀ onto {u: nᵢ·u + cᵢ ≥ 0}; in space three independent
//! contacts fix u, so no larger set is needed. Two faces leave the motion along their crease, three leave none. All
//! formulas are symmetric in the contacts, so that mirror images give mirror images up to rounding.
//!
//! Walls that nearly face each other, or nearly coincide, carry a body by forces a million times its weight, and the cross
//! product of their normals has lost as many digits. Where the plain formulas find no answer, all sets are tried again
//! with cross products of exact differences (`closely`). What is asked of u is relative to u₀, which bounds it; what is
//! asked of the forces is relative to them.

use glam::DVec3;

use super::candidate::{Candidate, one};
use super::closely;
use super::problem::{Problem, ROUNDING};

/// Most contacts for which all sets are tried at once (92 sets at 8).
pub(super) const LIMIT: usize = 8;

/// Most contacts for which all sets are tried if nothing else finds an answer (43 745 sets at 64).
pub(super) const LAST_RESORT: usize = 64;

/// Multipliers and u of a problem of one body.
///
/// The smallest set that satisfies every condition to rounding is taken; should rounding refuse all, the one that
/// violates least. Returns the multipliers, u, and the number of sets tried.
pub(super) fn solve(problem: &Problem) -> (Vec<f64>, DVec3, usize) {
    let (plain, tried) = best(problem, &|set| candidate(problem, set));
    let (found, tried) = match plain {
        Some((found, violation)) if violation <= 1.0 && !found.squeezes(problem) => (plain, tried),
        _ => {
            let (close, more) = best(problem, &|set| closely::candidate(problem, set));
            let better = close.filter(|close| plain.is_none_or(|plain| close.1 <= plain.1.max(1.0)));
            (better.or(plain), tried + more)
        }
    };
    let mut multipliers = vec![0.0; problem.rows.len()];
    let (best, _) = found.expect("that no contact holds is always a candidate");
    for (row, push) in best.pushes {
        multipliers[row] += (push / problem.inverse_mass[0]).max(0.0);
    }
    (multipliers, best.u, tried)
}

/// The first set of contacts whose violation is rounding (at most 1), or else the one of the least; and how many were
/// tried.
fn best(problem: &Problem, of: &dyn Fn(&[usize]) -> Option<Candidate>) -> (Option<(Candidate, f64)>, usize) {
    let mut best: Option<(Candidate, f64)> = None;
    let mut tried = 0;
    for set in sets(problem.rows.len()) {
        tried += 1;
        let Some(candidate) = of(&set) else { continue };
        let violation = violation(problem, &candidate);
        if best.is_none_or(|(_, least)| violation < least) {
            best = Some((candidate, violation));
        }
        if violation <= 1.0 {
            break;
        }
    }
    (best, tried)
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
    let (u, pushes) = match *set {
        [] => (problem.free[0], [(0, 0.0); 3]),
        [i] => one(problem, i),
        [i, j] => two(problem, i, j)?,
        [i, j, k] => three(problem, i, j, k)?,
        _ => return None,
    };
    Some(Candidate { u, pushes })
}

/// The answer if two contacts carry: u = t (t·u₀)/t² along the crease t = n₁ × n₂, plus what the offsets ask across it.
fn two(problem: &Problem, i: usize, j: usize) -> Option<(DVec3, [(usize, f64); 3])> {
    let (free, p, q) = (problem.free[0], &problem.rows[i], &problem.rows[j]);
    let crease = p.normal.cross(q.normal);
    let square = crease.length_squared();
    if square <= ROUNDING * ROUNDING {
        return None;
    }
    // d₁ = (n₂ × t)/t² has n₁·d₁ = 1, n₂·d₁ = 0, and lies across the crease; so does d₂.
    let (d1, d2) = (q.normal.cross(crease) / square, crease.cross(p.normal) / square);
    let u = crease * (crease.dot(free) / square) - (d1 * p.offset + d2 * q.offset);
    let change = u - free;
    Some((u, [(i, d1.dot(change)), (j, d2.dot(change)), (i, 0.0)]))
}

/// The answer if three contacts carry: they fix u, which is 0 if no offset asks otherwise.
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

/// Worst pull of a contact that only pushes, or approach of one that should open, in units of its rounding.
fn violation(problem: &Problem, candidate: &Candidate) -> f64 {
    let pushes = candidate.pushes.iter().map(|(_, push)| push);
    let scale = problem.free[0].length();
    let pushed: f64 = pushes.clone().map(|push| push.abs()).sum();
    let pull = pushes.fold(0.0, |most: f64, push| most.max(-push));
    let offset = problem.rows.iter().map(|row| row.offset.abs()).fold(0.0, f64::max);
    let approach = |row: usize| -problem.opening(row, &[candidate.u]) / share(scale + problem.rows[row].offset.abs());
    let approach = (0..problem.rows.len()).map(approach).fold(0.0, f64::max);
    let worst = approach.max(pull / share(scale + pushed + offset));
    if worst.is_nan() { f64::INFINITY } else { worst }
}

/// The rounding of terms of this size; more than 0, so that no size is no violation.
fn share(size: f64) -> f64 {
    (ROUNDING * size).max(f64::MIN_POSITIVE)
}
