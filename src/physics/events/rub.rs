//! What is left of a tangential velocity by bounces on a wall that rubs, once they are over.

use glam::DVec3;

/// What bounces that were summed up do to the tangential velocity of a sphere when they are over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rub {
    /// What they leave of what was added meanwhile.
    pub(crate) keeps: f64,
    /// The tangential velocity that the sphere would have then if nothing else happened, m/s.
    pub(crate) expected: DVec3,
    /// The tangential velocity that it gets then, m/s.
    pub(crate) slip: DVec3,
    /// How much of the acceleration along the face acts until then.
    pub(crate) share: f64,
}

impl Rub {
    /// The velocity (m/s) after the bounces on a face with this normal, from the one that it had come to.
    pub(crate) fn end(&self, v: DVec3, normal: DVec3) -> DVec3 {
        let across = normal * normal.dot(v);
        across + self.slip + (v - across - self.expected) * self.keeps
    }
}
