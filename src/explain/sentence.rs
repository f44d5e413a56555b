//! A contact in one line.

use crate::format;
use crate::snapshot::{Class, Contact, Kind, Logged};

/// An event in one line: when, what did what, how fast and with what impulse.
pub fn event(event: &Logged) -> String {
    let Logged { time, a, b, .. } = *event;
    let did = match (event.kind, event.class) {
        (Kind::Wall, Class::Collide) => format!("sphere {a} hits wall {b}"),
        (Kind::Wall, Class::Rest) => format!("sphere {a} comes to rest on wall {b}"),
        (Kind::Wall, Class::Release | Class::Leave) => format!("sphere {a} leaves wall {b}"),
        (Kind::Pair, Class::Collide) => format!("spheres {a} and {b} collide"),
        (Kind::Pair, Class::Rest) => format!("spheres {a} and {b} come to rest on each other"),
        (Kind::Pair, Class::Release | Class::Leave) => format!("spheres {a} and {b} leave each other"),
    };
    let how = match event.class {
        Class::Collide => format!(
            ", approach {} m/s, separation {} m/s, impulse {} N s",
            format::rounded(event.approach_speed),
            format::rounded(event.separation_speed),
            format::rounded(event.impulse)
        ),
        _ => String::new(),
    };
    format!("At {} s {did}{how}.", format::number(time))
}

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
