//! Rest: which contacts of an island hold, and how its spheres move until something changes.
//!
//! Spheres that rest on faces move on parabolas that keep their distance: one face leaves two directions, a crease one,
//! a corner none. Spheres that rest on each other, on edges or on corners do so too as long as the normals of those
//! contacts stand still: a stack, a row sliding down a slope, a sphere sliding along an edge. Otherwise the motion is
//! curved (`curved`).

use glam::DVec3;

use super::curved::{Body, Closed, geometry};
use crate::physics::support::{Bodies, Fate, Resting, Row, Surface, accelerations, bind, velocities};

/// Below this share of what they are sums of, velocities and accelerations are rounding: 256 ulp.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// An island after both complementarity problems.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Settled {
    /// Accelerations, m/s², by body; those of this instant if the motion is curved.
    pub(super) a: Vec<DVec3>,
    /// Impulses that stopped what still approached, N s, by contact.
    pub(super) impulses: Vec<f64>,
    /// Support forces, N, by contact.
    pub(super) forces: Vec<f64>,
    /// What becomes of every contact.
    pub(super) fate: Vec<Fate>,
    /// Whether some contact that holds turns.
    pub(super) curved: bool,
    /// Whether both problems were solved to rounding.
    pub(super) converged: bool,
}

/// Stops what still approaches, and finds what holds and how the island moves. Changes the velocities.
///
/// `tick` is the clock's rounding, s: a contact that opens so slowly that it would be closed again before the clock can
/// tell is closed.
pub(super) fn settle(bodies: &mut [Body], contacts: &[Closed], tick: f64) -> Settled {
    let resting: Vec<Resting> = contacts.iter().map(|&contact| geometry(bodies, contact).0).collect();
    let inverse_mass: Vec<f64> = bodies.iter().map(|body| body.inverse_mass).collect();
    let applied: Vec<DVec3> = bodies.iter().map(|body| body.applied).collect();
    let velocity: Vec<DVec3> = bodies.iter().map(|body| body.v).collect();
    let all = Bodies { inverse_mass: &inverse_mass, velocity: &velocity, applied: &applied };
    let stopped = velocities(all, &resting);
    for (place, &body) in stopped.bodies.iter().enumerate() {
        bodies[body].v = stopped.vectors[place];
    }
    let slack = |body: usize| tick * applied[body].length() + ROUNDING * velocity[body].length();
    let opens = |contact: &Resting| {
        let slack = slack(contact.a) + contact.b.map_or(0.0, slack);
        relative(contact, &|body| bodies[body].v).dot(contact.normal) > slack
    };
    let closed: Vec<usize> = (0..resting.len()).filter(|&index| !opens(&resting[index])).collect();
    let touching: Vec<Resting> = closed.iter().map(|&index| resting[index]).collect();
    let after: Vec<DVec3> = bodies.iter().map(|body| body.v).collect();
    let held = accelerations(Bodies { velocity: &after, ..all }, &touching, &[]);
    let mut settled = Settled {
        a: applied.clone(),
        impulses: stopped.multipliers.clone(),
        forces: vec![0.0; contacts.len()],
        fate: vec![Fate::Opening; contacts.len()],
        curved: false,
        converged: stopped.converged() && held.converged(),
    };
    for (place, &body) in held.bodies.iter().enumerate() {
        settled.a[body] = held.vectors[place];
    }
    for (place, &index) in closed.iter().enumerate() {
        settled.forces[index] = held.multipliers[place];
        settled.judge(index, &touching[place], bodies);
    }
    settled.still(bodies, &inverse_mass, &resting);
    settled
}

/// u of the first body less u of the second.
fn relative(contact: &Resting, u: &dyn Fn(usize) -> DVec3) -> DVec3 {
    u(contact.a) - contact.b.map_or(DVec3::ZERO, u)
}

impl Settled {
    /// What becomes of a contact that is closed.
    fn judge(&mut self, index: usize, contact: &Resting, bodies: &[Body]) {
        let v = relative(contact, &|body| bodies[body].v);
        let a = relative(contact, &|body| self.a[body]);
        let size = |u: &dyn Fn(usize) -> DVec3| u(contact.a).length() + contact.b.map_or(0.0, |b| u(b).length());
        let noise = ROUNDING * (size(&|body| bodies[body].applied) + size(&|body| self.a[body]));
        let opening = contact.normal.dot(a) + contact.surface.curvature_term(contact.normal, v);
        let turning = turning(contact, v).length() > ROUNDING * size(&|body| bodies[body].v)
            || turning(contact, a).length() > noise;
        self.fate[index] = match self.forces[index] > 0.0 {
            true => Fate::Loaded,
            // unpressed and turning, it lets go: the next approach is a contact like any other
            false if turning || opening > noise => Fate::Opening,
            false => Fate::Idle,
        };
        self.curved |= turning && self.fate[index] == Fate::Loaded;
    }

    /// Takes what rounding left of the normal velocities of contacts that hold.
    fn still(&self, bodies: &mut [Body], inverse_mass: &[f64], resting: &[Resting]) {
        let rows: Vec<Row> = (resting.iter().zip(&self.fate))
            .filter(|(_, fate)| **fate == Fate::Loaded)
            .map(|(contact, _)| Row { a: contact.a, b: contact.b, normal: contact.normal, offset: 0.0 })
            .collect();
        let off = rows.iter().any(|row| {
            let v = bodies[row.a].v - row.b.map_or(DVec3::ZERO, |b| bodies[b].v);
            row.normal.dot(v) != 0.0
        });
        if off {
            let velocity: Vec<DVec3> = bodies.iter().map(|body| body.v).collect();
            let v = bind(inverse_mass, &velocity, &rows).0;
            bodies.iter_mut().zip(v).for_each(|(body, v)| body.v = v);
        }
    }
}

/// The part of a relative vector that turns the normal of a contact.
fn turning(contact: &Resting, u: DVec3) -> DVec3 {
    let tangential = u - contact.normal * contact.normal.dot(u);
    match contact.surface {
        Surface::Face => DVec3::ZERO,
        Surface::Edge { along, .. } => tangential - along * along.dot(tangential),
        Surface::Round { .. } => tangential,
    }
}
