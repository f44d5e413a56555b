//! How a motion begins that is in touch with a wall and at rest along its normal.

use super::course::Course;
use super::obstacle::Plate;
use super::support;
use super::vector::Vector;
use crate::double::Double;

/// Overlap at t = 0 that a scene may have and counts as touching, in radii.
pub(super) const AT_LOAD: f64 = 1e-9;

/// Gap that counts as touching after an event, in radii: the shadow has it to 1e-30.
pub(super) const AT_EVENT: f64 = 1e-20;

/// How a course begins that is in touch with the plane of a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Start {
    /// At rest along the normal and drawn neither way: it stays as far from the plane, and no contact comes of
    /// it, beside the wall as over it.
    Glides,
    /// At rest along the normal and drawn away.
    Lifts,
    /// In motion along the normal, drawn towards the plane, or not in touch.
    Open,
}

/// How far (m) spheres of this radius (or sum of radii, m) may overlap at `t` (s) and count as touching.
pub(super) fn overlap(t: Double, radius: f64) -> f64 {
    if t == Double::ZERO { AT_LOAD * radius } else { AT_EVENT * radius }
}

impl Start {
    /// How `course` begins beside a wall that a sphere of this radius (m) may touch.
    pub(super) fn of(course: &Course, plate: &Plate, radius: Double) -> Start {
        let behind = (course.x - plate.center).dot(plate.normal) < Double::ZERO;
        let normal = if behind { -plate.normal } else { plate.normal };
        let gap = (normal.dot(course.x - plate.center) - radius).value().abs();
        let nothing = |u: Vector| normal.dot(u).abs() <= u.length() * Double::from(support::ROUNDING);
        if gap > overlap(course.t, radius.value()) || !nothing(course.v) {
            return Start::Open;
        }
        let bend = course.bend.as_deref().unwrap_or_default();
        if nothing(course.a) && bend.iter().all(|&term| nothing(term)) {
            Start::Glides
        } else if normal.dot(course.a) > Double::ZERO {
            Start::Lifts
        } else {
            Start::Open
        }
    }
}
