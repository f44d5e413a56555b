//! How a sphere moves between two events: x + v t + a t²/2, and higher powers where what holds it is curved.

use std::rc::Rc;

use super::vector::Vector;
use crate::double::Double;

/// A motion from one moment on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Course {
    /// Time at which the parabola begins, s.
    pub(super) t: Double,
    /// Centre at `t`, m.
    pub(super) x: Vector,
    /// Velocity at `t`, m/s.
    pub(super) v: Vector,
    /// Acceleration then, m/s²; in flight, and on faces, at all times.
    pub(super) a: Vector,
    /// Coefficients of t³, t⁴, … of the centre, m/sᵏ; none of a parabola.
    pub(super) bend: Option<Rc<[Vector]>>,
}

impl Course {
    /// A parabola.
    pub(super) fn parabola(t: Double, [x, v, a]: [Vector; 3]) -> Course {
        Course { t, x, v, a, bend: None }
    }

    /// Centre (m), velocity (m/s) and acceleration (m/s²) at `t`, s.
    pub(super) fn state(&self, t: Double) -> [Vector; 3] {
        let h = t - self.t;
        let parabola = [self.x + (self.v + self.a * h.half()) * h, self.v + self.a * h, self.a];
        let Some(bend) = &self.bend else { return parabola };
        let mut sums = [Vector::default(); 3];
        for (k, &term) in bend.iter().enumerate().rev() {
            let power = k as f64 + 3.0;
            sums[0] = sums[0] * h + term;
            sums[1] = sums[1] * h + term * Double::from(power);
            sums[2] = sums[2] * h + term * Double::from(power * (power - 1.0));
        }
        let square = h * h;
        [parabola[0] + sums[0] * (square * h), parabola[1] + sums[1] * square, parabola[2] + sums[2] * h]
    }

    /// The centre at `t` (s), m.
    pub(super) fn at(&self, t: Double) -> Vector {
        if self.bend.is_some() {
            return self.state(t)[0];
        }
        let h = t - self.t;
        self.x + (self.v + self.a * h.half()) * h
    }

    /// The velocity at `t` (s), m/s.
    pub(super) fn velocity(&self, t: Double) -> Vector {
        if self.bend.is_some() { self.state(t)[1] } else { self.v + self.a * (t - self.t) }
    }

    /// The parabola that is closest to this motion at `t`, s: the same motion, where it is one.
    pub(super) fn from(&self, t: Double) -> Course {
        Course::parabola(t, self.state(t))
    }

    /// The parabola of the motion relative to `other` at `t`, s.
    pub(super) fn relative(&self, other: &Course, t: Double) -> Course {
        let ([x, v, a], [y, w, b]) = (self.state(t), other.state(t));
        Course::parabola(t, [x - y, v - w, a - b])
    }

    /// The most that the acceleration changes by up to `length` (s) after the beginning, m/s³.
    #[inline]
    pub(super) fn jerk(&self, length: f64) -> f64 {
        let Some(bend) = &self.bend else { return 0.0 };
        bend.iter().enumerate().rev().fold(0.0, |sum, (k, term)| {
            let power = k as f64 + 3.0;
            sum * length + power * (power - 1.0) * (power - 2.0) * term.value().length()
        })
    }

    /// Coefficients of t⁰, t¹, … of the centre, m/sᵏ.
    pub(super) fn terms(&self) -> Vec<Vector> {
        let bend = self.bend.as_deref().unwrap_or_default();
        [self.x, self.v, self.a * Double::from(0.5)].into_iter().chain(bend.iter().copied()).collect()
    }
}
