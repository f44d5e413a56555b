//! The path of a centre between events: a parabola.

use glam::DVec3;

/// The path of a centre, or of one centre seen from another: x + v t + a t²/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Path {
    /// Position at t = 0, m.
    pub x: DVec3,
    /// Velocity at t = 0, m/s.
    pub v: DVec3,
    /// Acceleration, m/s².
    pub a: DVec3,
}

impl Path {
    /// Position at `t` (s), m.
    #[inline]
    pub fn at(&self, t: f64) -> DVec3 {
        self.x + (self.v + self.a * (0.5 * t)) * t
    }

    /// Velocity at `t` (s), m/s.
    #[inline]
    pub fn velocity(&self, t: f64) -> DVec3 {
        self.v + self.a * t
    }

    /// The path relative to a centre that moves on `other`: the differences of position, velocity and acceleration.
    #[inline]
    pub fn relative_to(&self, other: &Path) -> Path {
        Path { x: self.x - other.x, v: self.v - other.v, a: self.a - other.a }
    }

    /// Second derivative of the distance from the origin, m/s²: n·a + |v_⊥|²/|x|, for the unit vector `normal` along x and
    /// the distance |x|, m.
    #[inline]
    pub(super) fn distance_acceleration(&self, normal: DVec3, distance: f64) -> f64 {
        let across = self.v - normal * normal.dot(self.v);
        normal.dot(self.a) + across.length_squared() / distance
    }

    /// True if the displacement certainly stays below `way` (m) until `time` (s), by the triangle inequality: the cheap
    /// rejection before a quartic.
    #[inline]
    pub(super) fn stays_within(&self, way: f64, time: f64) -> bool {
        way > self.way_until(time)
    }

    /// A bound of the displacement until `time` (s), m, by the triangle inequality and with room for rounding.
    #[inline]
    pub(super) fn way_until(&self, time: f64) -> f64 {
        (self.v.length() + 0.5 * self.a.length() * time) * time * (1.0 + 1e-9)
    }

    /// Least and largest coordinate along `axis` (any vector) over [from, to] (s), m times the length of the axis.
    pub(super) fn reach(&self, axis: DVec3, from: f64, to: f64) -> (f64, f64) {
        let (v, a) = (axis.dot(self.v), axis.dot(self.a));
        let start = axis.dot(self.at(from));
        // for ever: 0 · ∞ is no place
        let end = match to.is_finite() {
            true => axis.dot(self.at(to)),
            false if a != 0.0 => a * f64::INFINITY,
            false if v != 0.0 => v * f64::INFINITY,
            false => start,
        };
        let apex = -v / a;
        let turn = if apex > from && apex < to { axis.dot(self.at(apex)) } else { start };
        (start.min(end).min(turn), start.max(end).max(turn))
    }
}
