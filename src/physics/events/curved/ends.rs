//! The bodies at one end of an arc, and what its errors are measured by.

use glam::DVec3;

use super::bodies::Body;

/// How far a chord may be from the path, in radii, so that what meets it by the chord overlaps by no more than that; but
/// no less than [`FINEST`].
pub(super) const DEPARTURE: f64 = 5e-13;

/// What coordinates tell apart, least departure of a chord from the path, relative to them: 16 ulp.
const FINEST: f64 = 16.0 * f64::EPSILON;

/// The bodies at one end of an arc, and their accelerations, m/s².
#[derive(Debug, Clone)]
pub(super) struct Ends {
    /// The bodies, by place in the island.
    pub(super) bodies: Vec<Body>,
    /// Accelerations of the bodies, m/s².
    pub(super) a: Vec<DVec3>,
}

impl Ends {
    /// The bodies, and their accelerations.
    pub(super) fn moving(&self) -> (&[Body], &[DVec3]) {
        (&self.bodies, &self.a)
    }

    /// The bodies `time` (s) later if their accelerations stay as they are.
    pub(super) fn moved(&self, time: f64) -> Ends {
        let along = |(body, a): (&Body, &DVec3)| Body {
            x: body.x + (body.v + *a * (0.5 * time)) * time,
            v: body.v + *a * time,
            ..*body
        };
        Ends { bodies: self.bodies.iter().zip(&self.a).map(along).collect(), a: self.a.clone() }
    }

    /// Time in which the bodies move, or begin to move, by about a radius, s.
    pub(super) fn time_scale(&self) -> f64 {
        let radius = self.bodies.iter().map(|body| body.r).fold(f64::INFINITY, f64::min);
        let speed = self.bodies.iter().map(|body| body.v.length()).fold(0.0, f64::max);
        let pulls = self.bodies.iter().zip(&self.a).map(|(body, a)| body.applied.length().max(a.length()));
        1.0 / (speed / radius + (pulls.fold(0.0, f64::max) / radius).sqrt())
    }
}

impl Body {
    /// What errors of the bodies' places are measured by, m.
    pub(super) fn size(&self) -> f64 {
        self.r.max(self.x.abs().max_element())
    }

    /// What coordinates tell apart of the body's places, m.
    pub(super) fn finest(&self) -> f64 {
        FINEST * self.size()
    }

    /// How far a chord may be from its path, m.
    pub(super) fn departure(&self) -> f64 {
        (DEPARTURE * self.r).max(self.finest())
    }
}
