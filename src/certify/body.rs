//! A sphere of the shadow run.

use glam::DVec3;

use super::course::Course;
use super::double::Double;
use super::vector::Vector;
use crate::physics::Kind;

/// A sphere, its motion, and where `exact` has it.
#[derive(Debug, Clone)]
pub(super) struct Body {
    /// Mass, kg.
    pub(super) mass: Double,
    /// Radius, m.
    pub(super) radius: Double,
    /// Centre at t = 0, m.
    pub(super) start: Vector,
    /// Motion since the last event.
    pub(super) now: Course,
    /// Motion before the last event.
    pub(super) before: Course,
    /// Acceleration in flight, m/s².
    pub(super) pull: Vector,
    /// Walls whose faces hold the sphere.
    pub(super) held: Vec<usize>,
    /// What the sphere touches at the beginning of its motion.
    pub(super) met: Vec<(Kind, usize)>,
    /// Whether contacts of this instant have changed the sphere since it was last settled.
    pub(super) open: bool,
    /// Time of the sphere's last event in `exact`, s.
    pub(super) since: f64,
    /// Time (s), place (m) and velocity (m/s) that `exact` gave the sphere at its last event.
    pub(super) told: (f64, DVec3, DVec3),
}

impl Body {
    /// The sphere's course at `t`, s: the one before, if the last event was later.
    pub(super) fn course(&self, t: Double) -> &Course {
        if t < self.now.t { &self.before } else { &self.now }
    }

    /// Lets the sphere go on from `t` (s), where it meets something.
    pub(super) fn meet(&mut self, t: Double, with: (Kind, usize)) {
        if t != self.now.t {
            self.before = self.now;
            self.now = self.now.from(t);
            self.met.clear();
            self.met.extend(self.held.iter().map(|&wall| (Kind::Wall, wall)));
        }
        self.met.push(with);
        self.open = true;
    }

    /// Distance (m) of where `exact` has the sphere at `t` (s), by its last event and the shadow's acceleration, from where
    /// it is; 0 if that event is later, and the distance then has been looked at.
    pub(super) fn error(&self, t: Double) -> f64 {
        let (time, x, v) = self.told;
        if t < time.into() {
            return 0.0;
        }
        let course = self.course(t);
        let told = Course { t: time.into(), x: x.into(), v: v.into(), a: course.a };
        (told.at(t) - course.at(t)).length().value()
    }
}
