//! Redundant supports: the complementarity problem of resting contacts where its rows depend on each other, or nearly.
//!
//! The oracle is the definition itself: u = u₀ + M⁻¹ Jᵀ λ, λ ≥ 0, J u + c ≥ 0, and a row that pushes is closed; and for
//! single spheres the nearest point of all those that satisfy J u + c ≥ 0, found by trying every set of rows.

use crate::random::Random;
use carom::physics::support::{Row, Solution, solve};
use glam::{DVec3, dvec3};

/// A problem: inverse masses, u₀, rows.
#[derive(Debug, Clone)]
struct Problem {
    inverse_mass: Vec<f64>,
    free: Vec<DVec3>,
    rows: Vec<Row>,
}

impl Problem {
    /// One sphere of 1 kg with `free` on faces.
    fn single(free: DVec3, normals: &[DVec3]) -> Problem {
        let row = |&normal: &DVec3| Row { a: 0, b: None, normal: normal.normalize(), offset: 0.0 };
        Problem { inverse_mass: vec![1.0], free: vec![free], rows: normals.iter().map(row).collect() }
    }

    /// (J u + c) of a row.
    fn opening(&self, row: &Row, u: &[DVec3]) -> f64 {
        row.normal.dot(u[row.a] - row.b.map_or(DVec3::ZERO, |b| u[b])) + row.offset
    }

    /// √(Σ m u₀²): the size of the problem.
    fn weight(&self) -> f64 {
        self.free.iter().zip(&self.inverse_mass).map(|(u, w)| u.length_squared() / w).sum::<f64>().sqrt()
    }

    fn solved(&self) -> (Solution, Vec<DVec3>) {
        let solution = solve(&self.inverse_mass, &self.free, &self.rows, &[]);
        let u = (0..self.free.len()).map(|body| solution.vector(body).unwrap_or(self.free[body])).collect();
        (solution, u)
    }

    /// Why the solver's answer is none; empty if it is one.
    fn fault(&self) -> String {
        let (solution, u) = self.solved();
        let mut fault = String::new();
        if !solution.converged() {
            fault += &format!("not converged: {:?}; ", solution.reports);
        }
        let mut force = vec![DVec3::ZERO; u.len()];
        let mut pushed = 0.0;
        for (row, &multiplier) in self.rows.iter().zip(&solution.multipliers) {
            for (body, sign) in [(Some(row.a), 1.0), (row.b, -1.0)] {
                let Some(body) = body else { continue };
                force[body] += row.normal * (sign * multiplier);
                pushed += multiplier;
            }
            let inverse = self.inverse_mass[row.a] + row.b.map_or(0.0, |b| self.inverse_mass[b]);
            let opening = self.opening(row, &u);
            // 2 · 64 ulp, and as much again for what is rounded to 0; contacts that depend on others inherit their rounding.
            let allowed = 1e-12 * (self.weight() * inverse.sqrt() + row.offset.abs());
            if multiplier < 0.0 || opening < -allowed || (multiplier * inverse).min(opening) > allowed {
                fault += &format!("{row:?} opens at {opening:e} under {multiplier:e}, {allowed:e} allowed; ");
            }
        }
        for (body, &u) in u.iter().enumerate() {
            let w = self.inverse_mass[body];
            let left = (u - self.free[body] - force[body] * w).length();
            // Normals are known to an ulp, and so are forces, relative to the largest of the island: where a row of spheres
            // is squeezed by 1e11 N, what they carry beside is known to 1e-5 N.
            let allowed = 1e-12 * (self.weight() * w.sqrt() + pushed * w);
            if left > allowed {
                fault += &format!("body {body} lacks {left:e} of {allowed:e} allowed; ");
            }
        }
        fault
    }

    /// The nearest u to u₀ of a single sphere among those that satisfy every row, by trying every set of rows.
    fn nearest(&self) -> DVec3 {
        let free = self.free[0];
        let mut best = (f64::INFINITY, DVec3::ZERO);
        for set in 0_u32..1 << self.rows.len() {
            if set.count_ones() > 3 {
                continue;
            }
            // Gram–Schmidt on the rows of the set: u = u₀ less its parts along them.
            let mut basis: Vec<DVec3> = Vec::new();
            let mut u = free;
            for (index, row) in self.rows.iter().enumerate().filter(|(index, _)| set & (1 << index) != 0) {
                let _ = index;
                let mut rest = row.normal;
                for _ in 0..2 {
                    rest = basis.iter().fold(rest, |rest, &q| rest - q * q.dot(rest));
                }
                let part = rest.length();
                if part > 1e-10 {
                    let q = rest / part;
                    u -= q * ((row.normal.dot(u) + row.offset) / part);
                    basis.push(q);
                }
            }
            let allowed = 1e-12 * free.length();
            let distance = u.distance(free);
            if self.rows.iter().all(|row| self.opening(row, &[u]) >= -allowed) && distance < best.0 {
                best = (distance, u);
            }
        }
        best.1
    }
}

/// A unit vector, uniform enough.
fn direction(random: &mut Random) -> DVec3 {
    loop {
        let v = random.vector();
        if (0.1..1.0).contains(&v.length()) {
            return v.normalize();
        }
    }
}

/// Asks for the answer to `count` problems, by seed.
fn assert_solved(count: u64, problem: impl Fn(&mut Random) -> Problem) {
    for seed in 0..count {
        let problem = problem(&mut Random::new(seed));
        let fault = problem.fault();
        assert!(fault.is_empty(), "seed {seed}: {fault}\n{problem:?}");
    }
}

/// The normals of `count` slopes around `axis`, the same to rounding for all: cos to the axis is `rise`.
fn funnel(random: &mut Random, count: usize, rise: f64) -> Vec<DVec3> {
    let axis = direction(random);
    let e = axis.any_orthonormal_vector();
    let f = axis.cross(e);
    let side = (1.0 - rise * rise).sqrt();
    let first = random.between(0.0, 1.0);
    let of = |k: usize| {
        let angle = std::f64::consts::TAU * (k as f64 + first) / count as f64;
        (e * angle.cos() + f * angle.sin()) * side + axis * rise
    };
    (0..count).map(of).collect()
}

#[test]
fn a_sphere_in_a_funnel_of_three_to_eight_walls_is_held() {
    assert_solved(4000, |random| {
        let rise = random.decade(-9.0, -0.01);
        let count = 3 + (random.unit() * 6.0) as usize;
        let normals = funnel(random, count, rise);
        let sum: DVec3 = normals.iter().sum();
        let free = if random.unit() < 0.5 { sum.normalize() * -9.8 } else { direction(random) * 9.8 };
        Problem::single(free, &normals)
    });
}

#[test]
fn what_lies_at_the_bottom_of_a_funnel_does_not_move() {
    for seed in 0..2000 {
        let mut random = Random::new(seed);
        let (rise, count) = (random.decade(-6.0, -0.01), 3 + (random.unit() * 6.0) as usize);
        let normals = funnel(&mut random, count, rise);
        let free = normals.iter().sum::<DVec3>().normalize() * -9.8;
        // A tenth of what would lift it off a wall: the least even four walls leave is 1/√2.
        let free = free + free.any_orthonormal_vector() * (0.1 * rise);
        let u = Problem::single(free, &normals).solved().1[0];
        assert_eq!(u, DVec3::ZERO, "seed {seed}: {count} walls that rise {rise:e}");
    }
}

#[test]
fn opposing_walls_leave_what_they_do_not_close() {
    assert_solved(4000, |random| {
        let n = direction(random);
        let tilt = random.vector() * if random.unit() < 0.3 { 0.0 } else { random.decade(-17.0, -1.0) };
        let mut normals = vec![n, tilt - n];
        for _ in 0..(random.unit() * 5.0) as usize {
            let near = if random.unit() < 0.5 { n } else { direction(random) };
            let turned = (near + random.vector() * random.decade(-17.0, 0.0)).normalize();
            normals.push(if random.unit() < 0.5 { turned } else { -turned });
        }
        Problem::single(direction(random) * random.decade(-9.0, 3.0), &normals)
    });
}

#[test]
fn coinciding_and_nearly_coinciding_walls_count_as_one() {
    assert_solved(4000, |random| {
        let first: Vec<DVec3> = (0..1 + (random.unit() * 3.0) as usize).map(|_| direction(random)).collect();
        let mut normals = first.clone();
        while normals.len() < 8 {
            let scatter = if random.unit() < 0.3 { 0.0 } else { random.decade(-17.0, -5.0) };
            normals.push((random.pick(&first) + random.vector() * scatter).normalize());
        }
        Problem::single(direction(random) * 9.8, &normals)
    });
}

#[test]
fn more_walls_than_all_sets_are_tried_for_at_once_hold_as_well() {
    assert_solved(500, |random| {
        let (rise, count) = (random.decade(-9.0, -0.01), 9 + (random.unit() * 12.0) as usize);
        let normals = funnel(random, count, rise);
        let sum: DVec3 = normals.iter().sum();
        Problem::single(if random.unit() < 0.5 { sum.normalize() * -9.8 } else { direction(random) * 9.8 }, &normals)
    });
}

#[test]
fn edges_and_corners_open_at_their_own_pace() {
    assert_solved(4000, |random| {
        let count = 3 + (random.unit() * 6.0) as usize;
        let rise = random.decade(-6.0, -0.01);
        let mut problem = Problem::single(direction(random) * 9.8, &funnel(random, count, rise));
        for row in &mut problem.rows {
            row.offset = if random.unit() < 0.5 { 0.0 } else { random.decade(-12.0, 1.0) };
        }
        problem
    });
}

#[test]
fn the_nearest_of_all_motions_is_found() {
    for seed in 0..3000 {
        let mut random = Random::new(seed);
        let count = 1 + (random.unit() * 8.0) as usize;
        let mut normals: Vec<DVec3> = (0..count).map(|_| direction(&mut random)).collect();
        if count > 4 {
            normals[1] = normals[0];
            normals[2] = -normals[3];
        }
        let mut problem = Problem::single(direction(&mut random) * 9.8, &normals);
        problem.rows.iter_mut().for_each(|row| row.offset = random.unit().max(0.5) - 0.5);
        let (u, nearest) = (problem.solved().1[0], problem.nearest());
        // Three random normals have a condition of up to some thousands.
        assert!(u.distance(nearest) < 1e-10, "seed {seed}: {u} instead of {nearest}\n{problem:?}");
    }
}

/// Spheres of unlike masses in a row between two walls, each contact's normal turned by `tilt`.
fn tight_row(random: &mut Random) -> Problem {
    let count = 2 + (random.unit() * 6.0) as usize;
    let axis = direction(random);
    let tilt = if random.unit() < 0.3 { 0.0 } else { random.decade(-17.0, -4.0) };
    let turned = |random: &mut Random| (axis + random.vector() * tilt).normalize();
    let mut rows = vec![Row { a: 0, b: None, normal: turned(random), offset: 0.0 }];
    for a in 1..count {
        rows.push(Row { a, b: Some(a - 1), normal: turned(random), offset: 0.0 });
    }
    rows.push(Row { a: count - 1, b: None, normal: -turned(random), offset: 0.0 });
    let ratio = if random.unit() < 0.5 { 0.0 } else { random.between(0.0, 4.0) };
    let inverse_mass = (0..count).map(|_| random.decade(-ratio, ratio + 1e-9)).collect();
    let free = (0..count).map(|_| direction(random) * random.decade(-6.0, 1.0)).collect();
    Problem { inverse_mass, free, rows }
}

#[test]
fn a_row_of_spheres_that_just_fits_between_two_walls_is_held() {
    assert_solved(4000, tight_row);
}

#[test]
fn stacks_in_tubes_of_doubled_walls_are_held() {
    assert_solved(1500, |random| {
        let (count, sides) = (2 + (random.unit() * 5.0) as usize, 2 + (random.unit() * 4.0) as usize);
        let mut rows = vec![Row { a: 0, b: None, normal: DVec3::Y, offset: 0.0 }];
        let scatter = if random.unit() < 0.3 { 0.0 } else { random.decade(-17.0, -4.0) };
        for a in 0..count {
            for normal in funnel(random, sides, 0.0).into_iter().take(4) {
                let normal = (dvec3(normal.x, 0.0, normal.z) + random.vector() * scatter).normalize_or(DVec3::X);
                rows.extend([normal, -normal].map(|normal| Row { a, b: None, normal, offset: 0.0 }));
            }
            if a > 0 {
                let normal = (DVec3::Y + random.vector() * random.decade(-12.0, -0.5)).normalize();
                rows.push(Row { a, b: Some(a - 1), normal, offset: 0.0 });
            }
        }
        let ratio = if random.unit() < 0.5 { 0.0 } else { 4.0 };
        let inverse_mass = (0..count).map(|_| random.decade(-ratio, ratio + 1e-9)).collect();
        Problem { inverse_mass, free: vec![dvec3(0.0, -9.8, 0.0); count], rows }
    });
}

/// Spheres in a square lattice, all neighbours touching, between four walls and on a floor: held many times over.
fn packed(random: &mut Random) -> Problem {
    let side = 2 + (random.unit() * 3.0) as usize;
    let scatter = if random.unit() < 0.5 { 0.0 } else { random.decade(-17.0, -6.0) };
    let mut rows = Vec::new();
    let mut row = |random: &mut Random, a: usize, b: Option<usize>, normal: DVec3| {
        rows.push(Row { a, b, normal: (normal + random.vector() * scatter).normalize(), offset: 0.0 });
    };
    for a in 0..side * side {
        let (i, j) = (a % side, a / side);
        row(random, a, None, DVec3::Z);
        row(random, a, if i > 0 { Some(a - 1) } else { None }, DVec3::X);
        row(random, a, if j > 0 { Some(a - side) } else { None }, DVec3::Y);
        if i + 1 == side {
            row(random, a, None, DVec3::NEG_X);
        }
        if j + 1 == side {
            row(random, a, None, DVec3::NEG_Y);
        }
    }
    let inverse_mass = (0..side * side).map(|_| random.decade(-1.0, 1.0)).collect();
    let free = (0..side * side).map(|_| direction(random) * random.decade(-3.0, 1.0)).collect();
    Problem { inverse_mass, free, rows }
}

#[test]
fn a_box_packed_full_is_held() {
    assert_solved(1000, packed);
}
