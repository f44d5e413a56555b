//! The ground: parallelograms, closest points, boxes. No import of ours.

use glam::DVec3;

/// A static two-sided parallelogram, edges `s1` and `s2` (m) about its centre (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parallelogram {
    /// Centre, m.
    pub center: DVec3,
    /// First edge vector, m.
    pub s1: DVec3,
    /// Second edge vector, m.
    pub s2: DVec3,
}

impl Parallelogram {
    /// The corners, in order around the outline, m.
    pub fn corners(&self) -> [DVec3; 4] {
        let (h1, h2) = (self.s1 * 0.5, self.s2 * 0.5);
        let c = self.center;
        [c - h1 - h2, c + h1 - h2, c + h1 + h2, c - h1 + h2]
    }
}

/// An axis-aligned box, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Smallest corner, m.
    pub min: DVec3,
    /// Largest corner, m.
    pub max: DVec3,
}
