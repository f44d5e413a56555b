//! Rest: which contacts of an island hold, and how its spheres move until something changes.
//!
//! Spheres that rest on faces move on parabolas that keep their distance: one face leaves two directions, a crease one,
//! a corner none. Spheres that rest on each other, on edges or on corners do so too as long as the normals of those
//! contacts stand still: a stack, a row sliding down a slope, a sphere sliding along an edge. Otherwise the motion is
//! curved (`curved`).

use glam::DVec3;

use super::curved::{Body, Closed, geometry};
use crate::physics::support::{Bodies, Fate, Held, Resting, Surface, hold};

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
pub(super) fn settle(bodies: &mut [Body], contacts: &[Closed]) -> Settled {
    let resting: Vec<Resting> = contacts.iter().map(|&contact| geometry(bodies, contact).0).collect();
    let inverse_mass: Vec<f64> = bodies.iter().map(|body| body.inverse_mass).collect();
    let applied: Vec<DVec3> = bodies.iter().map(|body| body.applied).collect();
    let velocity: Vec<DVec3> = bodies.iter().map(|body| body.v).collect();
    let all = Bodies { inverse_mass: &inverse_mass, velocity: &velocity, applied: &applied };
    let mut held = hold(all, &resting, &[]);
    let mut a = applied.clone();
    for (place, &body) in held.velocity.bodies.iter().enumerate() {
        bodies[body].v = held.velocity.vectors[place];
        a[body] = held.acceleration.vectors[place];
    }
    let mut curved = false;
    for (index, contact) in resting.iter().enumerate() {
        if held.fate[index] != Fate::Opening && turns(contact, bodies, &a, &held) {
            match held.fate[index] {
                Fate::Loaded => curved = true,
                // unpressed, it lets go: the next approach is a contact like any other
                _ => held.fate[index] = Fate::Opening,
            }
        }
    }
    let converged = held.converged();
    let (impulses, forces) = (held.velocity.multipliers, held.acceleration.multipliers);
    Settled { a, impulses, forces, fate: held.fate, curved, converged }
}

/// Whether the normal of a contact turns: its bodies move, or begin to move, past each other.
fn turns(contact: &Resting, bodies: &[Body], a: &[DVec3], held: &Held) -> bool {
    let across = |u: &dyn Fn(usize) -> DVec3, rounding: &[f64]| {
        let relative = u(contact.a) - contact.b.map_or(DVec3::ZERO, u);
        let noise = rounding[contact.a] + contact.b.map_or(0.0, |b| rounding[b]);
        let tangential = relative - contact.normal * contact.normal.dot(relative);
        let turning = match contact.surface {
            Surface::Face => DVec3::ZERO,
            Surface::Edge { along, .. } => tangential - along * along.dot(tangential),
            Surface::Round { .. } => tangential,
        };
        turning.length() > noise
    };
    // every body is named by a contact, so the solutions list all of them, in order
    across(&|body| bodies[body].v, &held.velocity.rounding) || across(&|body| a[body], &held.acceleration.rounding)
}
