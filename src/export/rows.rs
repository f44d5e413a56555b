//! The rows of a run: its states and its events.

use serde::Serialize;

use super::table::Row;
use crate::physics::{Class, Contact, Kind, State};

/// One sphere at one time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StateRow {
    /// Time, s.
    pub time: f64,
    /// Index of the sphere.
    pub sphere: usize,
    /// Centre, m.
    pub x: f64,
    /// Centre, m; up.
    pub y: f64,
    /// Centre, m.
    pub z: f64,
    /// Velocity, m/s.
    pub vx: f64,
    /// Velocity, m/s; up.
    pub vy: f64,
    /// Velocity, m/s.
    pub vz: f64,
}

impl Row for StateRow {
    const COLUMNS: &'static [&'static str] = &["time", "sphere", "x", "y", "z", "vx", "vy", "vz"];
}

impl StateRow {
    /// A row for each sphere, in the order of their indices.
    pub fn all(state: &State) -> impl Iterator<Item = StateRow> {
        state.x.iter().zip(&state.v).enumerate().map(|(sphere, (x, v))| StateRow {
            time: state.t,
            sphere,
            x: x.x,
            y: x.y,
            z: x.z,
            vx: v.x,
            vy: v.y,
            vz: v.z,
        })
    }
}

/// One event.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EventRow {
    /// Time, s.
    pub time: f64,
    /// `wall` or `pair`.
    pub kind: &'static str,
    /// The sphere; of a pair the lower index.
    pub a: usize,
    /// The wall, or the pair's higher index.
    pub b: usize,
    /// Contact point, m.
    pub px: f64,
    /// Contact point, m; up.
    pub py: f64,
    /// Contact point, m.
    pub pz: f64,
    /// Unit normal towards `a`.
    pub nx: f64,
    /// Unit normal towards `a`.
    pub ny: f64,
    /// Unit normal towards `a`.
    pub nz: f64,
    /// Approach speed before the response, m/s.
    pub approach_speed: f64,
    /// Normal impulse on `a`, N s.
    pub impulse: f64,
    /// Intersection degree, dimensionless.
    pub degree: f64,
    /// `collide`, `rest` or `release`.
    pub class: &'static str,
}

impl Row for EventRow {
    const COLUMNS: &'static [&'static str] =
        &["time", "kind", "a", "b", "px", "py", "pz", "nx", "ny", "nz", "approach_speed", "impulse", "degree", "class"];
}

impl From<&Contact> for EventRow {
    fn from(contact: &Contact) -> EventRow {
        let (p, n) = (contact.point, contact.normal);
        EventRow {
            time: contact.time,
            kind: kind(contact.kind),
            a: contact.a,
            b: contact.b,
            px: p.x,
            py: p.y,
            pz: p.z,
            nx: n.x,
            ny: n.y,
            nz: n.z,
            approach_speed: contact.approach_speed,
            impulse: contact.impulse,
            degree: contact.degree,
            class: class(contact.class),
        }
    }
}

const fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Wall => "wall",
        Kind::Pair => "pair",
    }
}

const fn class(class: Class) -> &'static str {
    match class {
        Class::Leave => "leave",
        Class::Rest => "rest",
        Class::Collide => "collide",
        Class::Release => "release",
    }
}
