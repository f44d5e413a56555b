//! A contact in one line.

use crate::format;
use crate::snapshot::{Class, Contact, Kind};

/// A contact in one line: what touches what, when, how fast and with what impulse.
pub fn sentence(contact: &Contact) -> String {
    let bodies = match contact.kind {
        Kind::Wall => format!("Sphere {} and wall {}", contact.a, contact.b),
        Kind::Pair => format!("Spheres {} and {}", contact.a, contact.b),
    };
    let class = match contact.class {
        Class::Collide => "impact",
        Class::Rest => "rest",
        Class::Leave | Class::Release => "leaving",
    };
    format!(
        "{bodies}: {class} at {} s, approach {} m/s, separation {} m/s, impulse {} N s, degree {}.",
        format::time(contact.time),
        format::rounded(contact.approach_speed),
        format::rounded(contact.separation_speed),
        format::rounded(contact.impulse),
        format::rounded(contact.degree)
    )
}
