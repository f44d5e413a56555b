//! Where a sphere goes next.

use glam::DVec3;

use crate::physics::Contact;

/// Where a sphere goes from the frame shown on, if nothing is changed: up to its next contact, or as far as was looked.
#[derive(Debug, Clone, PartialEq)]
pub struct Ahead {
    /// Index of the sphere.
    pub sphere: usize,
    /// Centre of the sphere in the frame shown, then at the end of every frame to come, last at the contact, m.
    pub path: Vec<DVec3>,
    /// The sphere's next impact, or the next rest that begins; none if there is none until `until`.
    pub contact: Option<Contact>,
    /// Time up to which contacts were looked for, s.
    pub until: f64,
}
