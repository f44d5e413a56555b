//! Vectors of three [`Double`]s.

use std::ops::{Add, Mul, Neg, Sub};

use glam::DVec3;

use crate::double::Double;

/// Three components.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Vector {
    x: Double,
    y: Double,
    z: Double,
}

impl Vector {
    /// The nearest `f64` by component.
    pub(super) fn value(self) -> DVec3 {
        DVec3::new(self.x.value(), self.y.value(), self.z.value())
    }

    /// The components x, y and z.
    pub(super) fn components(self) -> [Double; 3] {
        [self.x, self.y, self.z]
    }

    pub(super) fn dot(self, other: Vector) -> Double {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    pub(super) fn cross(self, other: Vector) -> Vector {
        Vector {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    pub(super) fn length(self) -> Double {
        self.dot(self).sqrt()
    }

    /// The vector of length 1 in this direction.
    pub(super) fn unit(self) -> Vector {
        self * (Double::ONE / self.length())
    }

    /// The vector without its part along the unit vector `along`.
    pub(super) fn across(self, along: Vector) -> Vector {
        self - along * self.dot(along)
    }
}

impl From<DVec3> for Vector {
    fn from(v: DVec3) -> Vector {
        Vector { x: v.x.into(), y: v.y.into(), z: v.z.into() }
    }
}

impl Neg for Vector {
    type Output = Vector;

    fn neg(self) -> Vector {
        Vector { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl Add for Vector {
    type Output = Vector;

    fn add(self, other: Vector) -> Vector {
        Vector { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl Sub for Vector {
    type Output = Vector;

    fn sub(self, other: Vector) -> Vector {
        self + -other
    }
}

impl Mul<Double> for Vector {
    type Output = Vector;

    fn mul(self, factor: Double) -> Vector {
        Vector { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}
