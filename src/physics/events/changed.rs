//! What an event has done, as far as the schedule must know.

use crate::physics::contact::{Key, Kind};

/// The spheres whose motion an event has changed, by index: the loop predicts them in this order.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Changed {
    /// No sphere.
    Nothing,
    /// The sphere of a contact with a wall.
    Sphere(usize),
    /// Both spheres of a pair.
    Pair([usize; 2]),
    /// The spheres of islands.
    Spheres(Vec<usize>),
}

impl Changed {
    /// The spheres of a contact.
    pub(crate) fn of((kind, a, b): Key) -> Changed {
        if kind == Kind::Pair { Changed::Pair([a, b]) } else { Changed::Sphere(a) }
    }

    /// The spheres whose motion has changed, by index.
    pub(crate) fn spheres(&self) -> &[usize] {
        match self {
            Changed::Nothing => &[],
            Changed::Sphere(sphere) => std::slice::from_ref(sphere),
            Changed::Pair(pair) => pair,
            Changed::Spheres(spheres) => spheres,
        }
    }
}
