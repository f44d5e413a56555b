//! The bodies of an island and what they touch, as the solvers of rest see them.

use glam::DVec3;

use crate::physics::events::trajectories::Trajectories;
use crate::physics::model::Model;
use crate::physics::support::{Resting, Surface};
use crate::physics::wall::{Face, Part, surface, touch_part};

/// A body of the island.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Body {
    /// Centre, m.
    pub(crate) x: DVec3,
    /// Velocity, m/s.
    pub(crate) v: DVec3,
    /// Acceleration by everything but contacts, m/s².
    pub(crate) applied: DVec3,
    /// Inverse mass, 1/kg.
    pub(crate) inverse_mass: f64,
    /// Radius, m.
    pub(crate) r: f64,
    /// Deepest overlap of its contacts that is put right, m.
    pub(crate) healed: f64,
}

impl Body {
    /// Sphere `i`, whose trajectory is at the present, as a body of an island.
    pub(crate) fn of(model: &Model, trajectories: &Trajectories, i: usize) -> Body {
        let line = trajectories.trajectory(i);
        Body {
            x: line.x,
            v: line.v,
            applied: model.acceleration(i),
            inverse_mass: model.inverse_masses[i],
            r: model.radii[i],
            healed: trajectories.healed(i),
        }
    }
}

/// What a body of the island touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum On<'a> {
    /// A wall, and the part of it.
    Wall(&'a Face, Part),
    /// Another body of the island.
    Body(usize),
}

/// A closed contact of the island.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Closed<'a> {
    /// Place of the body in the island.
    pub(crate) a: usize,
    /// What the body touches.
    pub(crate) on: On<'a>,
}

impl Closed<'_> {
    /// Places of its bodies in the island.
    pub(crate) fn spheres(&self) -> impl Iterator<Item = usize> {
        let other = match self.on {
            On::Wall(..) => None,
            On::Body(b) => Some(b),
        };
        std::iter::once(self.a).chain(other)
    }
}

/// A contact as `support` sees it, and its gap, m.
pub(crate) fn geometry(bodies: &[Body], contact: Closed) -> (Resting, f64) {
    let body = &bodies[contact.a];
    match contact.on {
        On::Wall(face, part) => {
            let touch = touch_part(face, part, body.x, body.r);
            let radius = body.r + touch.gap;
            let surface = surface(face, part, radius);
            (Resting { a: contact.a, b: None, normal: touch.normal, surface }, touch.gap)
        }
        On::Body(b) => {
            let arm = body.x - bodies[b].x;
            let radius = arm.length();
            let surface = Surface::Round { radius };
            (Resting { a: contact.a, b: Some(b), normal: arm / radius, surface }, radius - (body.r + bodies[b].r))
        }
    }
}
