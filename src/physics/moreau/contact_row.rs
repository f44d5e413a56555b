//! Where and when two bodies meet that move on straight lines for a frame, and what the impact law makes of it.
//!
//! The gap of a sphere to a convex body (a parallelogram, another sphere) is a convex function of time on a straight
//! path, so that Newton's method from the start of the frame comes up to its first root from below and never passes it
//! (for a face in one step). The plane through the touching point, perpendicular to the normal there, has the other
//! body behind it: what stays on its side for the rest of the frame does not touch it, whatever else happens.
//!
//! Every plane with the wall on one side and the path's start on the other is safe in this way, and a sphere that slides
//! on needs the one that does not get in its way: over a tile that lies level with the last one it is the tile's face,
//! not the edge that it comes to first. So a wall whose plane at the end of the path has all of the path before it is no
//! row at all; a wall that is touched already becomes a row with that plane if the start lies before it.

use glam::DVec3;

use crate::physics::contact::{Class, Key, Kind};
use crate::physics::model::{Model, Pull, Settings};
use crate::physics::overlap::touching;
use crate::physics::wall::{self, Face, Part};

/// The largest tolerance of `moreau`, dimensionless; larger ones count as this one: a solver that may miss everything by
/// half solves nothing.
const LARGEST_TOLERANCE: f64 = 0.1;

/// Share of the tolerance by which a row may be missed at most, as a way over the size of the bodies.
const MOST_SLACK: f64 = 0.5;

/// Share of the tolerance that a gap or overlap may have and not be corrected, as a length over the size of the bodies.
const MOST_STILL: f64 = 0.25;

/// Relative size of what rounding leaves of a row: what the tolerance cannot go below.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Steps after which a path that grazes counts as meeting.
const MOST_STEPS: usize = 40;

/// Closing speed over the speed below which a path may only graze a wall.
const GRAZING: f64 = 1e-2;

/// Thirds cut off a path while its deepest point is looked for: (2/3)^64 of a frame is 5e-12 of it.
const GRAZING_STEPS: usize = 64;

/// Square of the difference of two normals up to which walls count as touched at one point.
const ONE_POINT: f64 = 1e-10;

/// Square of the difference of two normals up to which their mean touches both: it is off by an eighth of this, in radii,
/// less than [`TOUCHING`].
const ONE_CRACK: f64 = 1e-12;

/// Gap over the size of the bodies from which they count as touching.
pub(super) const TOUCHING: f64 = 1e-12;

/// Two bodies that meet, or are near each other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    /// Unit normal at the touching point, towards the (first) sphere.
    pub(super) normal: DVec3,
    /// Way along the normal, from the start of the frame, until they touch, m; negative: overlap.
    pub(super) way: f64,
    /// When they touch on this path, s after the start; infinite if they are near and do not.
    pub(super) time: f64,
    /// Whether it is a wall's face that is met.
    pub(super) face: bool,
}

/// A plane that touches a wall grown by the sphere's radius.
#[derive(Debug, Clone, Copy)]
struct Plane {
    /// Unit normal, away from the wall.
    normal: DVec3,
    /// n · x of its points, m.
    level: f64,
}

impl Plane {
    /// The plane at the point closest to `x` (m) of a wall, for spheres of radius `r` (m).
    fn at(touch: &wall::Touch, r: f64) -> Plane {
        Plane { normal: touch.normal, level: touch.normal.dot(touch.point) + r }
    }

    /// How far before the plane `x` (m) lies, m.
    fn height(&self, x: DVec3) -> f64 {
        self.normal.dot(x) - self.level
    }
}

/// What may be missed where spheres touch walls, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Allowance {
    /// How deep a sphere may already be in a wall at the start, m: what the solver may have left.
    pub(super) left: f64,
    /// How much deeper the sphere may get, m.
    pub(super) more: f64,
}

/// The relative motion of two bodies from the start of a frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct FramePath<'a> {
    pub(super) model: &'a Model,
    pub(super) key: Key,
    /// Centre of the sphere; of a pair from the second's to the first's, m.
    pub(super) from: DVec3,
    /// Velocity of the sphere; of a pair of the first relative to the second, m/s.
    pub(super) velocity: DVec3,
    /// Length of the frame, s.
    pub(super) h: f64,
}

impl<'a> FramePath<'a> {
    /// The path of the bodies of `key` with these positions (m) and velocities (m/s).
    pub(super) fn of(model: &'a Model, key: Key, x: &[DVec3], u: &[DVec3], h: f64) -> FramePath<'a> {
        let (kind, a, b) = key;
        let (from, velocity) = match kind {
            Kind::Wall => (x[a], u[a]),
            Kind::Pair => (x[a] - x[b], u[a] - u[b]),
        };
        FramePath { model, key, from, velocity, h }
    }

    /// Sum of the radii, m.
    pub(super) fn size(&self) -> f64 {
        let (kind, a, b) = self.key;
        self.model.radii[a] + if kind == Kind::Pair { self.model.radii[b] } else { 0.0 }
    }

    /// Unit normal and gap (m) a time `t` (s) after the start.
    fn touch(&self, t: f64) -> (DVec3, f64) {
        let (kind, _, b) = self.key;
        let (at, size) = (self.from + self.velocity * t, self.size());
        match kind {
            Kind::Wall => {
                let touch = wall::touch(&self.model.faces[b], at, size);
                (touch.normal, touch.gap)
            }
            Kind::Pair => {
                let distance = at.length();
                // Coincident centres have no normal: any fixed one separates them.
                (if distance > 0.0 { at / distance } else { DVec3::Y }, distance - size)
            }
        }
    }

    /// Where the bodies first touch within the frame; none if they do not. Bodies that are closer than `near` (m) at
    /// the start count as meeting there, whatever they do.
    pub(super) fn meeting(&self, near: f64) -> Option<Meeting> {
        let (normal, gap) = self.touch(0.0);
        if gap <= near {
            return Some(Meeting { normal, way: gap, time: 0.0, face: false });
        }
        self.first_touch(normal, gap)
    }

    /// Where bodies first touch within the frame that are apart by `gap` (m) along `normal` at its start.
    fn first_touch(&self, mut normal: DVec3, mut gap: f64) -> Option<Meeting> {
        let touching = TOUCHING * self.size();
        let mut t = 0.0;
        for _ in 0..MOST_STEPS {
            let closing = -normal.dot(self.velocity);
            if gap <= touching && closing > 0.0 {
                break;
            }
            let ahead = t + gap / closing;
            // Not closing: the gap is convex, it has no root ahead.
            if closing <= 0.0 || ahead > self.h || ahead.is_nan() {
                return None;
            }
            t = ahead;
            (normal, gap) = self.touch(t);
        }
        Some(Meeting { normal, way: gap - t * normal.dot(self.velocity), time: t, face: false })
    }

    /// How a sphere and a wall meet; none if a plane has all of the wall behind it and all of the path before it. Over
    /// faces, what is closer than `near` (m) at the start, if that is given, counts as near.
    pub(super) fn wall_meeting(&self, near: Option<f64>, allowance: Allowance) -> Option<Meeting> {
        let (face, r) = (&self.model.faces[self.key.2], self.size());
        let (from, to) = (self.from, self.from + self.velocity * self.h);
        let rounding = touching(r, from.abs().max_element().max(to.abs().max_element()));
        let left = allowance.left.max(rounding);
        let start = wall::touch(face, from, r);
        let first = Plane::at(&start, r);
        let clear = |plane: &Plane| {
            let height = plane.height(from);
            height >= -left && plane.height(to) >= height.min(0.0) - rounding - allowance.more
        };
        let over = (start.part == Part::Face && near.is_some_and(|near| start.gap <= near)).then_some(Meeting {
            normal: start.normal,
            way: start.gap,
            time: f64::INFINITY,
            face: true,
        });
        if clear(&first) {
            return over;
        }
        let end = wall::touch(face, to, r);
        let last = Plane::at(&end, r);
        if clear(&last) {
            return over;
        }
        let meeting = if start.gap > rounding {
            self.first_touch(start.normal, start.gap)
        } else {
            let (plane, part) = if last.height(from) >= -left { (last, end.part) } else { (first, start.part) };
            let (normal, way) = (plane.normal, plane.height(from));
            Some(Meeting { normal, way, time: 0.0, face: part == Part::Face })
        };
        let deepest = start.gap.min(0.0) - rounding - allowance.more;
        meeting.filter(|meeting| !self.grazes(meeting, deepest)).or(over)
    }

    /// Whether a sphere meets a wall in the plane of this face, to rounding.
    pub(super) fn meets_in_plane_of(&self, face: &Face, meeting: &Meeting) -> bool {
        let along = if meeting.normal.dot(face.normal) < 0.0 { -face.normal } else { face.normal };
        let arm = self.size() + if meeting.time == 0.0 { meeting.way } else { 0.0 };
        let point = self.from + self.velocity * meeting.time - meeting.normal * arm;
        let center = face.shape.center;
        let rounding = touching(self.size(), point.abs().max_element().max(center.abs().max_element()));
        (meeting.normal - along).length_squared() <= ONE_POINT && along.dot(point - center).abs() <= rounding
    }

    /// Whether a path that turns away from what it meets goes no deeper than to a gap of `deepest`, m.
    fn grazes(&self, meeting: &Meeting, deepest: f64) -> bool {
        if -meeting.normal.dot(self.velocity) > GRAZING * self.velocity.length() {
            return false;
        }
        // The gap is convex: a third of the time is cut off at the higher end.
        let (mut from, mut to) = (0.0, self.h);
        for _ in 0..GRAZING_STEPS {
            let (one, two) = (from + (to - from) / 3.0, to - (to - from) / 3.0);
            let (gap_one, gap_two) = (self.touch(one).1, self.touch(two).1);
            if gap_one.min(gap_two) < deepest {
                return false;
            }
            (from, to) = if gap_one < gap_two { (from, two) } else { (one, to) };
        }
        self.touch(to).1 >= deepest && self.touch(from).1 >= deepest
    }
}

/// A contact as a row of the complementarity problem J u + c ≥ 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) key: Key,
    pub(super) normal: DVec3,
    /// Offset c of the problem, m/s.
    pub(super) offset: f64,
    /// Offset c without a rebound, way / h, m/s.
    pub(super) reached: f64,
    /// −v_n that the impact law saw, m/s.
    pub(super) approach: f64,
    pub(super) class: Class,
    /// Largest error of complementarity that is allowed, m/s.
    pub(super) slack: f64,
    /// Impulse Λ, N s.
    pub(super) impulse: f64,
    /// When they touch on the path that they were found on, s after the frame's start; infinite if they do not.
    pub(super) time: f64,
    /// Whether it is a wall's face that is met.
    pub(super) face: bool,
    /// What striking the wall has taken of the sphere's free velocity along it, m/s; opposite to that velocity.
    pub(super) rubbed: DVec3,
}

/// What rows are made from beside their meeting, equal for all rows of a frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Terms {
    /// Length of the frame, s.
    pub(super) h: f64,
    /// Share of the speeds at hand that a row may be wrong by, dimensionless.
    tolerance: f64,
    /// Fastest at which bodies that overlap are pushed apart, m/s: what the scene itself calls slow, or a frame's fall.
    push: f64,
}

impl Terms {
    pub(super) fn of(model: &Model, settings: &Settings) -> Terms {
        let h = settings.dt;
        let gravity = match model.pull {
            Pull::None => 0.0,
            Pull::Uniform(g) => g.length(),
            Pull::PerSphere => model.accelerations.iter().map(|a| a.length()).fold(0.0, f64::max),
        };
        let tolerance = settings.tolerance.min(LARGEST_TOLERANCE);
        Terms { h, tolerance, push: model.law.rest_speed.max(gravity * h) }
    }

    /// Gap or overlap, m, that the solver may leave and that is not corrected.
    pub(super) fn still(&self, model: &Model, key: Key) -> f64 {
        let size = model.radii[key.1] + if key.0 == Kind::Pair { model.radii[key.2] } else { 0.0 };
        self.tolerance * (model.law.rest_speed + pull(model, key) * self.h).min(MOST_STILL * size / self.h) * self.h
    }

    /// What accelerates the bodies of `key` changes in their speed in a frame, m/s.
    pub(super) fn pulled(&self, model: &Model, key: Key) -> f64 {
        pull(model, key) * self.h
    }

    /// Gap, m, within which bodies are rows from the start: others may push them together.
    pub(super) fn near(&self, model: &Model, key: Key) -> f64 {
        self.h * (pull(model, key) * self.h + model.law.rest_speed)
    }
}

/// Speeds at which two bodies meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Speeds {
    /// −v_n as the impact law takes it, m/s.
    pub(super) approach: f64,
    /// −u_n without the row, m/s.
    pub(super) closing: f64,
    /// Whether the meeting is an impact.
    pub(super) struck: bool,
}

impl Row {
    /// Whether this row is the one to keep of two rows of one sphere that touches two walls at one point: of faces and
    /// edges the face, of alike ones the first.
    pub(super) fn stands_for(&self, other: &Row) -> bool {
        let one_point = (self.normal - other.normal).length_squared() <= ONE_POINT;
        one_point && if self.face == other.face { self.key < other.key } else { self.face }
    }

    /// Whether another row of the same sphere touches it at what is the same point to rounding, on an edge or a corner.
    pub(super) fn shares_crack_with(&self, other: &Row) -> bool {
        !other.face && (self.normal - other.normal).length_squared() <= ONE_CRACK
    }

    /// Whether this row comes before `best`: what is met earlier, of what is met at one time what holds.
    pub(super) fn comes_before(&self, best: &Row) -> bool {
        self.time < best.time || (self.time == best.time && self.holds() && !best.holds())
    }

    /// Whether the row only keeps bodies apart that touch, or are near each other.
    pub(super) fn holds(&self) -> bool {
        self.class == Class::Rest && (self.time == 0.0 || self.time == f64::INFINITY)
    }

    /// The row of bodies that were held by `carried` (N s, 0 if by nothing) in the last frame.
    pub(super) fn new(path: &FramePath, meeting: Meeting, speeds: Speeds, carried: f64, terms: &Terms) -> Row {
        let law = &path.model.law;
        let e = if path.key.0 == Kind::Wall { law.wall_restitution } else { law.restitution };
        let gravity = pull(path.model, path.key) * terms.h;
        // What the solver may miss is not corrected: the problem of bodies at rest is then the same in every frame, and
        // the sweeps of all frames converge on one solution instead of chasing their own corrections.
        let still = terms.still(path.model, path.key);
        let reached = if meeting.way.abs() <= still { 0.0 } else { (meeting.way / terms.h).max(-terms.push) };
        let share = terms.tolerance * (law.rest_speed + gravity + speeds.closing.abs());
        let rounding = ROUNDING * (path.velocity.length() + gravity + reached.abs());
        Row {
            key: path.key,
            normal: meeting.normal,
            // v_n⁺ ≥ e · approach, or closing no more than the way that is left.
            offset: if speeds.struck && e > 0.0 { -e * speeds.approach } else { reached },
            reached,
            approach: speeds.approach,
            class: if speeds.struck { Class::Collide } else { Class::Rest },
            slack: share.min(MOST_SLACK * terms.tolerance * path.size() / terms.h).max(rounding),
            impulse: carried,
            time: meeting.time,
            face: meeting.face,
            rubbed: DVec3::ZERO,
        }
    }
}

/// Sum of the accelerations of the bodies of `key`, m/s².
fn pull(model: &Model, (kind, a, b): Key) -> f64 {
    model.acceleration(a).length() + if kind == Kind::Pair { model.acceleration(b).length() } else { 0.0 }
}
