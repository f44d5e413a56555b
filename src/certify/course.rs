//! How a sphere moves between two events: x + v t + a t²/2.

use super::double::Double;
use super::vector::Vector;

/// A parabola from one moment on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Course {
    /// Time at which the parabola begins, s.
    pub(super) t: Double,
    /// Centre at `t`, m.
    pub(super) x: Vector,
    /// Velocity at `t`, m/s.
    pub(super) v: Vector,
    /// Acceleration, m/s².
    pub(super) a: Vector,
}

impl Course {
    /// The centre at `t` (s), m.
    pub(super) fn at(&self, t: Double) -> Vector {
        let h = t - self.t;
        self.x + (self.v + self.a * h.half()) * h
    }

    /// The velocity at `t` (s), m/s.
    pub(super) fn velocity(&self, t: Double) -> Vector {
        self.v + self.a * (t - self.t)
    }

    /// The motion with `t` (s) as its origin of time.
    pub(super) fn from(&self, t: Double) -> Course {
        Course { t, x: self.at(t), v: self.velocity(t), a: self.a }
    }

    /// The motion relative to `other`, from `t` (s) on.
    pub(super) fn relative(&self, other: &Course, t: Double) -> Course {
        let (one, two) = (self.from(t), other.from(t));
        Course { t, x: one.x - two.x, v: one.v - two.v, a: one.a - two.a }
    }
}
