//! The motion of spheres that contacts hold whose normals turn, as a Taylor series, and when it changes.
//!
//! A contact that stays closed says of the vector y from the point that it touches to the centre (of a pair, from centre to centre)
//! that |y| does not change, y · y″ + y′ · y′ = 0, and pushes along y; a face, that n · x″ = 0, and pushes along n. Both are
//! polynomials in what is looked for, so that each coefficient follows from those below it: products of series are sums of products
//! of coefficients, and the forces of each order solve one and the same system of equations.

use std::iter::successors;

use super::obstacle::Part;
use super::support::{Prop, forces};
use super::vector::Vector;
use crate::double::Double;

/// Coefficients of a series: t⁰ to t²⁷.
const TERMS: usize = 28;

/// How much the last terms of a piece may make of a radius.
const TAIL: f64 = 1e-32;

/// A piece is shortened by this factor until its last terms are that small.
const SHORTER: f64 = 0.8;

/// How often it is, at most: to 1e-9 of the time in which the motion changes.
const MOST_TRIES: usize = 100;

/// A contact that stays closed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tie {
    /// Index in the island.
    pub(super) body: usize,
    /// The second sphere; none if it is a wall.
    pub(super) other: Option<usize>,
    /// What of the wall; none of a pair.
    pub(super) part: Option<Part>,
}

/// What an island is made of, by sphere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bodies<'a> {
    pub(super) places: &'a [Vector],
    pub(super) velocities: &'a [Vector],
    pub(super) pulls: &'a [Vector],
    pub(super) masses: &'a [Double],
}

/// How an island moves on.
#[derive(Debug, Clone)]
pub(super) struct Series {
    /// Coefficients of the centres, by sphere and power, m/sᵏ.
    pub(super) places: Vec<Vec<Vector>>,
    /// Coefficients of the forces over the lengths that they act along, by contact and power.
    pub(super) forces: Vec<Vec<Double>>,
}

impl Tie {
    /// What a vector between its bodies is without what it does not restrict, by sphere `of`.
    fn relative(&self, of: impl Fn(usize) -> Vector) -> Vector {
        let one = of(self.body);
        match (self.part, self.other) {
            (Some(Part::Line(_, along)), _) => one.across(along),
            (_, Some(other)) => one - of(other),
            _ => one,
        }
    }

    fn is_round(&self) -> bool {
        !matches!(self.part, Some(Part::Plane(..)))
    }

    /// From what it touches to the centre, by sphere at `x`.
    fn arm(&self, x: &[Vector]) -> Vector {
        match self.part {
            Some(part) => part.arm(x[self.body]),
            None => self.relative(|i| x[i]),
        }
    }

    /// What spheres that move with `v` (m/s) make of the gap by moving across the normal, times the radius that it has, m²/s².
    pub(super) fn parting(&self, normal: Vector, v: &[Vector]) -> Double {
        let across = self.relative(|i| v[i]).across(normal);
        if self.is_round() { across.dot(across) } else { Double::ZERO }
    }

    /// Whether its normal turns, where spheres move with `v` and are drawn by `a`, in units of `scales`.
    pub(super) fn turns(&self, normal: Vector, [v, a]: [&[Vector]; 2], scales: [Double; 2]) -> bool {
        let moves = |u: &[Vector], scale: Double| self.relative(|i| u[i]).across(normal).length() > scale;
        self.is_round() && (moves(v, scales[0]) || moves(a, scales[1]))
    }

    /// Coefficients of half the change of |y|², or of the distance from a plane, m or m², from t⁰ on.
    pub(super) fn gap(&self, places: &[Vec<Vector>]) -> Vec<Double> {
        let moved = |k: usize| self.relative(|i| places[i][k]);
        if let Some(Part::Plane(_, normal)) = self.part {
            return (0..TERMS).map(|k| if k == 0 { Double::ZERO } else { normal.dot(moved(k)) }).collect();
        }
        let at_start: Vec<Vector> = places.iter().map(|terms| terms[0]).collect();
        let y: Vec<Vector> = (0..TERMS).map(|k| if k == 0 { self.arm(&at_start) } else { moved(k) }).collect();
        let mut gap: Vec<Double> = (0..TERMS).map(|k| product(&y, &y, k).half()).collect();
        gap[0] = Double::ZERO;
        gap
    }
}

/// Coefficient of tᵏ of the product of two series.
fn product(one: &[Vector], two: &[Vector], k: usize) -> Double {
    (0..=k).fold(Double::ZERO, |sum, j| sum + one[j].dot(two[k - j]))
}

/// The second derivative's coefficient of tᵏ of a series.
fn second(terms: &[Vector], k: usize) -> Vector {
    terms[k + 2] * whole((k + 1) * (k + 2))
}

fn whole(number: usize) -> Double {
    Double::from(number as f64)
}

/// The motion while these contacts stay closed; none if their normals depend on each other.
pub(super) fn series(bodies: Bodies, ties: &[Tie]) -> Option<Series> {
    let Bodies { places, velocities, pulls, masses } = bodies;
    let mut found: Vec<Vec<Vector>> = places.iter().zip(velocities).map(|(&x, &v)| vec![x, v]).collect();
    let mut pushes: Vec<Vec<Double>> = vec![Vec::new(); ties.len()];
    let arm = |tie: &Tie| {
        let part = tie.part.map(|part| part.normal(places[tie.body]));
        if tie.is_round() { tie.arm(places) } else { part.unwrap_or_default() }
    };
    // along which it pushes, and what stays as long as it is
    let mut along: Vec<Vec<Vector>> = ties.iter().map(|tie| vec![arm(tie)]).collect();
    for (tie, along) in ties.iter().zip(&mut along) {
        along.push(if tie.is_round() { tie.relative(|i| velocities[i]) } else { Vector::default() });
    }
    for k in 0..TERMS - 2 {
        let mut w: Vec<Vector> = pulls.iter().map(|&pull| if k == 0 { pull } else { Vector::default() }).collect();
        for ((tie, along), push) in ties.iter().zip(&along).zip(&pushes) {
            let force = (0..k).fold(Vector::default(), |sum, j| sum + along[k - j] * push[j]);
            act(&mut w, tie, force, masses);
        }
        let prop = |(tie, along): (&Tie, &Vec<Vector>)| {
            let from_below = |j: usize| along[j].dot(tie.relative(|i| second(&found[i], k - j)));
            let mut bias = (1..=k).fold(Double::ZERO, |sum, j| sum + from_below(j));
            if tie.is_round() {
                let rate = |j: usize| along[j + 1] * whole(j + 1);
                bias = (0..=k).fold(bias, |sum, j| sum + rate(j).dot(rate(k - j)));
            }
            Prop { body: tie.body, other: tie.other, normal: along[0], bias }
        };
        let props: Vec<Prop> = ties.iter().zip(&along).map(prop).collect();
        let new = forces(&w, masses, &props)?;
        for ((tie, along), &force) in ties.iter().zip(&along).zip(&new) {
            act(&mut w, tie, along[0] * force, masses);
        }
        pushes.iter_mut().zip(new).for_each(|(push, force)| push.push(force));
        found.iter_mut().zip(w).for_each(|(terms, w)| terms.push(w * (Double::ONE / whole((k + 1) * (k + 2)))));
        for (tie, along) in ties.iter().zip(&mut along) {
            along.push(if tie.is_round() { tie.relative(|i| found[i][k + 2]) } else { Vector::default() });
        }
    }
    Some(Series { places: found, forces: pushes })
}

/// A force (N) of a contact on its spheres' accelerations.
fn act(w: &mut [Vector], tie: &Tie, force: Vector, masses: &[Double]) {
    w[tie.body] = w[tie.body] + force * (Double::ONE / masses[tie.body]);
    if let Some(other) = tie.other {
        w[other] = w[other] - force * (Double::ONE / masses[other]);
    }
}

/// Whether a polynomial of time is nothing but rounding in what is as large as `size`, up to `length`, s.
pub(super) fn is_nothing(terms: &[Double], size: f64, length: f64) -> bool {
    let powers = successors(Some(1.0), |power| Some(power * length));
    terms.iter().zip(powers).all(|(term, power)| term.value().abs() * power <= 1e-24 * size)
}

impl Series {
    /// How long (s) the series has all the digits of the places of spheres of this radius (m), at most `longest`; none if that is no time at all.
    pub(super) fn length(&self, radius: f64, longest: f64) -> Option<f64> {
        let sizes: Vec<Vec<f64>> =
            self.places.iter().map(|terms| terms.iter().map(|term| term.value().length()).collect()).collect();
        let tail = |length: f64| {
            let of = |sizes: &Vec<f64>| {
                let powers = successors(Some(1.0), |power| Some(power * length));
                sizes.iter().zip(powers).skip(TERMS - 4).map(|(size, power)| size * power).sum::<f64>()
            };
            sizes.iter().map(of).fold(0.0, f64::max)
        };
        let speed = sizes.iter().map(|sizes| sizes[1]).fold(0.0, f64::max) / radius;
        let pull = (sizes.iter().map(|sizes| sizes[2]).fold(0.0, f64::max) / radius).sqrt();
        let scale = (2.0 / (speed + pull)).min(longest);
        successors(Some(scale), |length| Some(length * SHORTER))
            .take(MOST_TRIES)
            .find(|&length| tail(length) <= TAIL * radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_sphere_at_an_edge_swings_as_the_separatrix_of_a_pendulum_has_it() {
        // From the top, with no energy left over: tan(θ/4) grows as e^(√(g/r) t); at g = 8 and r = ½ as e^(4 t).
        let (r, g, p) = (Double::from(0.5), Double::from(8.0), Double::from(0.125));
        let (sin, cos) = angle(p);
        let turns = (g / r).sqrt();
        // θ′ = 2 √(g/r) sin(θ/2)
        let half = p * Double::from(2.0) / (Double::ONE + p * p);
        let rate = turns * half * Double::from(2.0);
        let vector = |x: Double, y: Double| {
            Vector::from(DVec3::X) * x + Vector::from(DVec3::Y) * y + Vector::from(DVec3::Z) * Double::from(0.25)
        };
        let flat = |x: Double, y: Double| vector(x, y).across(Vector::from(DVec3::Z));
        let (places, velocities) = ([vector(r * sin, r * cos)], [flat(r * rate * cos, -(r * rate * sin))]);
        let pulls = [Vector::from(DVec3::NEG_Y * 8.0)];
        let tie = Tie { body: 0, other: None, part: Some(Part::Line(Vector::default(), DVec3::Z.into())) };
        let bodies = Bodies { places: &places, velocities: &velocities, pulls: &pulls, masses: &[Double::from(3.0)] };
        let found = series(bodies, &[tie]).expect("one contact");
        let length = found.length(0.5, 1.0).expect("it moves on");
        assert!(length > 0.01, "{length}");
        let t = Double::from(length);
        let place = found.places[0].iter().rev().fold(Vector::default(), |sum, &term| sum * t + term);
        let (sin, cos) = angle(p * exponential(turns * t));
        let off = (place - vector(r * sin, r * cos)).length().value();
        assert!(off < 1e-30, "{off:e} m");
    }

    /// Sine and cosine of θ, of tan(θ/4).
    fn angle(p: Double) -> (Double, Double) {
        let half = p * Double::from(2.0) / (Double::ONE + p * p);
        let half_cos = (Double::ONE - p * p) / (Double::ONE + p * p);
        (half * half_cos * Double::from(2.0), half_cos * half_cos - half * half)
    }

    /// eˣ of a small number, by its series.
    fn exponential(x: Double) -> Double {
        (1..60).rev().fold(Double::ONE, |sum, k| Double::ONE + sum * x / whole(k))
    }
}
