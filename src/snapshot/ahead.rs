//! Where a sphere goes next.

use glam::DVec3;

use crate::physics::Contact;

/// Where a sphere goes from the frame shown on, if nothing is changed: up to its next contact, or as far as was looked.
#[derive(Debug, Clone, PartialEq)]
pub struct Ahead {
    /// The sphere.
    pub sphere: usize,
    /// Its centre in the frame shown, then at the end of every frame to come, last at the contact, m.
    pub path: Vec<DVec3>,
    /// Its next impact, or the next rest that begins; none if it has none until then.
    pub contact: Option<Contact>,
    /// Until when was looked, s.
    pub until: f64,
}
