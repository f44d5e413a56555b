//! A sphere of the shadow run.

use glam::DVec3;

use super::course::Course;
use super::ending::Cause;
use super::growth::Growth;
use super::obstacle::{FACE, Part, Plate, Region};
use super::vector::Vector;
use crate::double::Double;
use crate::physics::Kind;

/// The part of a way within which the shadow may come to its beginning later than `exact`.
const SLIVER: f64 = 0.01;

/// A wall that holds a sphere, by one of its parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Held {
    pub(super) wall: usize,
    pub(super) region: Region,
    pub(super) part: Part,
}

impl Held {
    /// The part of a wall in `region` that holds a sphere at `x`, m.
    pub(super) fn new(wall: usize, region: Region, plate: &Plate, x: Vector) -> Held {
        Held { wall, region, part: plate.part(region, x) }
    }

    pub(super) fn is_round(&self) -> bool {
        self.region != FACE
    }
}

/// What comes next by itself of a sphere that rests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Change {
    /// Another part of a wall takes over.
    Border(usize, Region),
    /// A contact lets go.
    Release((Kind, usize)),
    /// The series of a curved motion has run out.
    Piece,
    /// A contact of which cannot be told what comes.
    Unclear(Cause, (Kind, usize, usize)),
}

/// A change, and when it is due, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Due {
    pub(super) t: Double,
    pub(super) change: Change,
}

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
    /// Parts of walls that hold the sphere.
    pub(super) held: Vec<Held>,
    /// Edges and corners that have let go of the sphere as its motion began.
    pub(super) left: Vec<Held>,
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
        let now = self.now.from(t);
        let before = std::mem::replace(&mut self.now, now);
        if t != before.t {
            self.before = before;
            self.met.clear();
            self.met.extend(self.held.iter().map(|held| (Kind::Wall, held.wall)));
            self.left.clear();
        }
        self.met.push(with);
        self.open = true;
    }

    /// By what a wall holds it; none if it does not.
    pub(super) fn holder(&self, wall: usize) -> Option<&Held> {
        self.held.iter().find(|held| held.wall == wall)
    }

    /// Notes how the distance of where `exact` has it from where it is has grown on its way along `course` up to `t`, s: both are
    /// parabolas of one acceleration, so that it is not above the line between its values at the ends. From when on anything may have
    /// happened since, s: `t`, or the last event in `exact`, where the way is curved or no such parabola.
    pub(super) fn rises(&self, course: &Course, t: f64, growth: &mut Growth) -> f64 {
        let told = self.told.0;
        let since = told.max(course.t.value());
        // a sliver of a time lies between an event and the same event in the shadow; a whole flight does not
        let is_this_way = course.t.value() <= told + SLIVER * (t - told);
        if course.bend.is_some() || since >= t || !is_this_way {
            return told;
        }
        let [first, last] = [since, t].map(|t| self.distance(course, t.into()));
        growth.note(told, first);
        growth.rise((since, first), (t, last));
        t
    }

    /// Distance (m) of where `exact` has it at `t` (s), by its last event and the acceleration of `course`, from there.
    fn distance(&self, course: &Course, t: Double) -> f64 {
        let (time, x, v) = self.told;
        let told = Course::parabola(time.into(), [x.into(), v.into(), course.a]);
        (told.at(t) - course.at(t)).length().value()
    }

    /// Distance (m) of where `exact` has it at `t` (s), by its last event and the shadow's acceleration, from where it is; 0
    /// if that event is later, or where the motion is curved: the distance then has been looked at.
    pub(super) fn error(&self, t: Double) -> f64 {
        let course = self.course(t);
        if t < self.told.0.into() || course.bend.is_some() { 0.0 } else { self.distance(course, t) }
    }
}
