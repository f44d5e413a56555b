//! The bodies at one end of an arc, and what its errors are measured by.

use glam::DVec3;

use super::bodies::Body;

/// How far a chord may be from the path, in radii, so that what meets it by the chord overlaps by no more than that; but
/// no less than [`FINEST`].
pub(super) const DEPARTURE: f64 = 5e-13;

/// What coordinates tell apart, least departure of a chord from the path, relative to them: 16 ulp.
const FINEST: f64 = 16.0 * f64::EPSILON;

/// Mean jerk of an arc, in radii per cube of the time in which the motion changes, from which on spheres that just fit may
/// come into line; of order 1 where a motion is smooth. A polynomial between the ends misses where in between it leaps.
const STEEP: f64 = 10.0;

/// How far the mean acceleration of an arc may be from that of its ends before they come into line too, in radii per fourth
/// power of the time in which the motion changes, times the square of the arc; of order 0.1 (h²/12 of a″) where it is smooth.
const UNEVEN: f64 = 10.0;

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

    /// Whether accelerations change until `end`, `span` (s) later, as where spheres that just fit come into line, all at once or
    /// there and back: the ends do not tell how then, and the middle may not. What leaps there and back shows only where v was
    /// integrated by more than the accelerations of the ends.
    pub(super) fn leap_to(&self, end: &Ends, span: f64) -> bool {
        let scale = self.time_scale();
        let (unit, share) = (scale * scale, span / scale);
        self.bodies.iter().zip(&end.bodies).zip(self.a.iter().zip(&end.a)).any(|((from, to), (first, last))| {
            let change = *last - *first;
            let off = (to.v - from.v) / span - *first - change * 0.5;
            let steady = change.length() * unit <= STEEP * share * from.r;
            !(steady && off.length() * unit <= UNEVEN * share * share * from.r)
        })
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
