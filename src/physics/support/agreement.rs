//! The solvers against each other: u is unique, so that every solver of an island must find the same.

use glam::DVec3;

use super::active_set::{self, DEPENDENT};
use super::problem::{Problem, Row};
use super::{enumerate, gauss_seidel};

/// SplitMix64 mapped to [−1, 1), the seed first.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A random island: every body in turn on an earlier one or on a wall, masses from 0.3 to 3 kg.
fn island(seed: u64, bodies: usize, contacts: usize) -> Problem {
    let mut next = numbers(seed);
    let mut vector = || DVec3::new(next(), next(), next());
    let free: Vec<DVec3> = (0..bodies).map(|_| vector() * 5.0).collect();
    let normals: Vec<DVec3> = (0..contacts).map(|_| vector().normalize_or(DVec3::Y)).collect();
    let mut next = numbers(!seed);
    let inverse_mass: Vec<f64> = (0..bodies).map(|_| 10.0_f64.powf(0.5 * next())).collect();
    let row = |(index, normal): (usize, DVec3)| {
        let a = index % bodies;
        let other = ((next() + 1.0) * 0.5 * bodies as f64) as usize;
        Row { a, b: (other < a).then_some(other), normal, offset: next().max(0.0) }
    };
    let rows = normals.into_iter().enumerate().map(row).collect();
    let weight: f64 = free.iter().zip(&inverse_mass).map(|(u, w)| u.length_squared() / w).sum();
    Problem { inverse_mass: inverse_mass.into(), free: free.into(), rows, weight: weight.sqrt() }
}

/// Largest distance between two answers, relative to the problem's size.
fn difference(problem: &Problem, one: &[DVec3], other: &[DVec3]) -> f64 {
    let largest = one.iter().zip(other).map(|(u, w)| (*u - *w).length()).fold(0.0, f64::max);
    largest / problem.weight
}

#[test]
fn enumeration_and_active_set_agree_on_single_spheres() {
    for seed in 0..5000 {
        let problem = island(seed, 1, 1 + seed as usize % enumerate::LIMIT);
        let (_, u, _) = enumerate::solve(&problem);
        let direct = active_set::solve(&problem, &[], DEPENDENT);
        // Three random normals have a condition of up to some thousands.
        assert!(difference(&problem, &[u], &direct.u) < 1e-11, "seed {seed}: {u} against {}", direct.u[0]);
    }
}

#[test]
fn sweeping_and_active_set_agree_where_sweeping_converges() {
    let mut converged = 0;
    for seed in 0..500 {
        let problem = island(seed, 2 + seed as usize % 20, 1 + seed as usize % 37);
        let swept = gauss_seidel::solve(&problem, vec![0.0; problem.rows.len()], 10_000);
        if !swept.converged {
            continue;
        }
        converged += 1;
        let direct = active_set::solve(&problem, &[], DEPENDENT);
        let u = problem.response(&swept.multipliers);
        // Sweeping stops at residuals of 1e-13; the condition of the island multiplies them.
        assert!(difference(&problem, &u, &direct.u) < 1e-9, "seed {seed}");
    }
    assert!(converged > 450, "only {converged} of 500 converged");
}

#[test]
fn a_good_guess_is_confirmed_at_once() {
    for seed in 0..200 {
        let problem = island(seed, 10, 25);
        let cold = active_set::solve(&problem, &[], DEPENDENT);
        let warm = active_set::solve(&problem, &cold.multipliers, DEPENDENT);
        assert!(difference(&problem, &cold.u, &warm.u) < 1e-11, "seed {seed}");
        assert!(warm.passes <= 1 + cold.passes / 4, "seed {seed}: {} passes after {}", warm.passes, cold.passes);
    }
}

#[test]
fn sweeping_says_that_a_heavy_sphere_on_a_light_column_has_defeated_it() {
    let mut inverse_mass = vec![1.0; 10];
    inverse_mass[9] = 1e-8;
    let row = |a: usize| Row { a, b: a.checked_sub(1), normal: DVec3::Y, offset: 0.0 };
    let free = vec![DVec3::NEG_Y * 9.8; 10];
    let (inverse_mass, free) = (inverse_mass.into(), free.into());
    let problem = Problem { inverse_mass, free, rows: (0..10).map(row).collect(), weight: 9.8e4 };
    let swept = gauss_seidel::solve(&problem, vec![0.0; 10], 2000);
    assert!(!swept.converged);
}
