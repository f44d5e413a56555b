//! A sphere of the shadow run.

use glam::DVec3;

use super::course::Course;
use super::double::Double;
use super::vector::Vector;
use crate::physics::Kind;

/// A sphere, its motion, and where `exact` has it.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub(super) mass: Double,
    pub(super) radius: Double,
    /// Where it was at t = 0, m.
    pub(super) start: Vector,
    /// Its motion since its last event, and before that.
    pub(super) now: Course,
    pub(super) before: Course,
    /// Acceleration in flight, m/s².
    pub(super) pull: Vector,
    /// Walls whose faces hold it.
    pub(super) held: Vec<usize>,
    /// What it touches at the beginning of its motion.
    pub(super) met: Vec<(Kind, usize)>,
    /// Whether contacts of this instant have changed it since it was last settled.
    pub(super) open: bool,
    /// When its last event was in `exact`, s.
    pub(super) since: f64,
    /// Time (s), place (m) and velocity (m/s) that `exact` gave it at its last event.
    pub(super) told: (f64, DVec3, DVec3),
}

impl Body {
    /// Its course at `t`, s: the one before, if the last event was later.
    pub(super) fn course(&self, t: Double) -> &Course {
        if t < self.now.t { &self.before } else { &self.now }
    }

    /// It goes on from `t` (s), where it meets something.
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

    /// Distance (m) of where `exact` has it at `t` (s), by its last event and the shadow's acceleration, from where it is; 0
    /// if that event is later, and the distance then has been looked at.
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
