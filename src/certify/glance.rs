//! A quick look at two spheres, which shows of most of them that they do not touch.

use glam::DVec3;

use super::course::Course;

/// Part of a distance that the quick look gives away for rounding.
pub(super) const ROUNDING: f64 = 1e-12;

/// A course as the quick look at two spheres sees it, which takes no more than `f64`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Glance {
    x: DVec3,
    /// Largest coordinate of the centre, m.
    size: f64,
    /// Time at which the course begins, s.
    t: f64,
    /// |v| at `t`, m/s; endless where nothing is known.
    speed: f64,
    /// |a|, m/s².
    pull: f64,
}

impl Glance {
    pub(super) fn of(course: &Course) -> Glance {
        let x = course.x.value();
        let speed = if course.bend.is_none() { course.v.value().length() } else { f64::INFINITY };
        let pull = course.a.value().length();
        Glance { x, size: x.abs().max_element(), t: course.t.value(), speed, pull }
    }

    /// Of a course that is about to change: it may be anywhere.
    pub(super) fn unknown(self) -> Glance {
        Glance { speed: f64::INFINITY, ..self }
    }

    /// Whether up to `t` (s) it stays farther than `radius` (m) from another one. Asked of every pair of bodies at every event: it takes
    /// no root.
    pub(super) fn is_apart(&self, other: &Glance, t: f64, radius: f64) -> bool {
        let moves = |glance: &Glance| {
            let h = t - glance.t;
            (glance.speed + 0.5 * glance.pull * h) * h
        };
        let size = self.size + other.size;
        let reach = (radius + moves(self) + moves(other) + size * ROUNDING) * (1.0 + ROUNDING);
        (self.x - other.x).length_squared() > reach * reach
    }
}
