//! Resting contacts: first the velocities, then the accelerations of the contacts that stay closed.

use glam::DVec3;

use super::problem::Row;
use super::short::Short;
use super::solution::Solution;
use super::solve::solve_from;

/// The shape of what touches, as far as the gap's second derivative feels it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surface {
    /// A wall's face: flat.
    Face,
    /// A wall's edge along this unit vector, at this distance (m, the sphere's radius).
    Edge {
        /// Unit vector along the edge.
        along: DVec3,
        /// Distance of the sphere's centre, m.
        radius: f64,
    },
    /// A wall's corner (distance r) or another sphere (distance r₁ + r₂), m.
    Round {
        /// Distance of the sphere's centre from the corner or the other centre, m.
        radius: f64,
    },
}

impl Surface {
    /// The term k = |v_t|² / radius, m/s², for relative velocity `v` (m/s) at a contact of unit `normal`: v_t is the part
    /// of `v` across the normal and, on an edge, across the edge.
    pub fn curvature_term(self, normal: DVec3, v: DVec3) -> f64 {
        let across = v - normal * normal.dot(v);
        match self {
            Surface::Face => 0.0,
            Surface::Edge { along, radius } => (across - along * along.dot(across)).length_squared() / radius,
            Surface::Round { radius } => across.length_squared() / radius,
        }
    }
}

/// A resting contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resting {
    /// The sphere.
    pub a: usize,
    /// The other sphere; none for a wall.
    pub b: Option<usize>,
    /// Unit normal, from `b` (or the wall) to `a`.
    pub normal: DVec3,
    /// What touches.
    pub surface: Surface,
}

/// Bodies by index; the three slices have equal lengths.
#[derive(Debug, Clone, Copy)]
pub struct Bodies<'a> {
    /// Inverse masses, 1/kg, > 0.
    pub inverse_mass: &'a [f64],
    /// Velocities, m/s.
    pub velocity: &'a [DVec3],
    /// Accelerations by everything but contacts, m/s².
    pub applied: &'a [DVec3],
}

/// The velocity problem: v⁺ = v + M⁻¹ Jᵀ Λ, 0 ≤ Λ ⊥ J v⁺ ≥ 0. It never adds kinetic energy. `guess` as in
/// [`solve`](super::solve()).
pub fn velocities(bodies: Bodies, contacts: &[Resting], guess: &[f64]) -> Solution {
    let rows: Short<Row> = contacts.iter().map(|contact| row(contact, 0.0)).collect();
    solve_from(bodies.inverse_mass, bodies.velocity, &rows, guess)
}

/// The acceleration problem for contacts that neither open nor close: a = a_applied + M⁻¹ Jᵀ λ, 0 ≤ λ ⊥ J a + k ≥ 0,
/// with k from `bodies.velocity`. `guess` as in [`solve`](super::solve()).
pub fn accelerations(bodies: Bodies, contacts: &[Resting], guess: &[f64]) -> Solution {
    let relative =
        |contact: &Resting| bodies.velocity[contact.a] - contact.b.map_or(DVec3::ZERO, |other| bodies.velocity[other]);
    let curved = |contact| row(contact, contact.surface.curvature_term(contact.normal, relative(contact)));
    let rows: Short<Row> = contacts.iter().map(curved).collect();
    solve_from(bodies.inverse_mass, bodies.applied, &rows, guess)
}

/// The solutions of both problems.
#[derive(Debug, Clone, PartialEq)]
pub struct Held {
    /// v⁺ and Λ, m/s and N s.
    pub velocity: Solution,
    /// a and λ, m/s² and N, of the same bodies and contacts.
    pub acceleration: Solution,
    /// What each contact does from now on.
    pub fate: Vec<Fate>,
}

/// What a contact does after both problems are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// The contact carries a load: λ > 0.
    Loaded,
    /// The contact stays closed without carrying anything: redundant, or unpressed.
    Idle,
    /// The contact opens: J v⁺ > 0, or J a + k > 0 beyond rounding.
    Opening,
}

impl Held {
    /// Whether both problems converged on every island.
    pub fn converged(&self) -> bool {
        self.velocity.converged() && self.acceleration.converged()
    }
}

/// Solves the velocity problem of `contacts`, then the acceleration problem of those with J v⁺ = 0.
pub fn hold(bodies: Bodies, contacts: &[Resting], guess: &[f64]) -> Held {
    let velocity = velocities(bodies, contacts, &[]);
    let mut after = bodies.velocity.to_vec();
    for (&body, &v) in velocity.bodies.iter().zip(&velocity.vectors) {
        after[body] = v;
    }
    let closed: Vec<usize> =
        (0..contacts.len()).filter(|&i| velocity.opening(&row(&contacts[i], 0.0)) <= 0.0).collect();
    let pick = |values: &[f64]| closed.iter().map(|&i| values.get(i).copied().unwrap_or(0.0)).collect::<Vec<_>>();
    let touching: Vec<Resting> = closed.iter().map(|&i| contacts[i]).collect();
    let part = accelerations(Bodies { velocity: &after, ..bodies }, &touching, &pick(guess));
    let mut fate = vec![Fate::Opening; contacts.len()];
    for (place, &contact) in closed.iter().enumerate() {
        let pair = &touching[place];
        let relative = after[pair.a] - pair.b.map_or(DVec3::ZERO, |other| after[other]);
        let row = row(pair, pair.surface.curvature_term(pair.normal, relative));
        fate[contact] = match (part.multipliers[place] > 0.0, part.opening(&row) > 0.0) {
            (true, _) => Fate::Loaded,
            (false, false) => Fate::Idle,
            (false, true) => Fate::Opening,
        };
    }
    let acceleration = spread(part, &velocity.bodies, bodies.applied, &closed, contacts.len());
    Held { velocity, acceleration, fate }
}

/// A solution over `closed` contacts as one over all `count` contacts and `bodies`; bodies left alone fall freely.
fn spread(part: Solution, bodies: &[usize], free: &[DVec3], closed: &[usize], count: usize) -> Solution {
    let mut multipliers = vec![0.0; count];
    for (&contact, &multiplier) in closed.iter().zip(&part.multipliers) {
        multipliers[contact] = multiplier;
    }
    let vectors = bodies.iter().map(|&body| part.vector(body).unwrap_or(free[body])).collect();
    let rounding = bodies.iter().map(|&body| part.place(body).map_or(0.0, |place| part.rounding[place])).collect();
    Solution { bodies: bodies.to_vec(), vectors, rounding, multipliers, reports: part.reports }
}

/// A contact as a row with offset `c`.
fn row(contact: &Resting, c: f64) -> Row {
    Row { a: contact.a, b: contact.b, normal: contact.normal, offset: c }
}
