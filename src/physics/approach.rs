//! How two bodies came together, as the root of a polynomial: what `exact` solves, kept to be shown.

use super::contact::Key;
use super::contact_time::distance_polynomial;
use super::path::Path;
use super::wall::{Face, Part, edge_direction, touch};
use crate::roots;

/// What the distance of an approach is measured between.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A centre and the plane of a wall: the polynomial is the gap, m, of degree 2.
    Face,
    /// A centre and the line of a wall's edge: the polynomial is its square − r², m², of degree 4.
    Edge,
    /// A centre and a wall's corner: the polynomial is its square − r², m², of degree 4.
    Corner,
    /// Two centres: the polynomial is its square − (r₁ + r₂)², m², of degree 4.
    Centers,
}

/// The approach that led to a contact, while nothing else changed the motion of its bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// The two bodies that approached.
    pub key: Key,
    /// When they touched, s.
    pub time: f64,
    /// When the motion of one of them last changed, s: τ = t − this.
    pub since: f64,
    /// What the distance is measured between.
    pub shape: Shape,
    /// Σ cᵢ τⁱ, lowest power first, in m or m² over sⁱ: 0 where they touch, negative where they overlap.
    pub polynomial: [f64; 5],
}

impl Approach {
    /// Two spheres: the first seen from the second from `since` (s) on, `reach` = r₁ + r₂ (m).
    pub(super) fn of_pair(key: Key, [since, time]: [f64; 2], path: &Path, reach: f64) -> Approach {
        Approach { key, time, since, shape: Shape::Centers, polynomial: distance_polynomial(path, reach) }
    }

    /// A sphere of radius `r` (m) on this path from `since` (s) on, and the part of a wall that it touches at `time` (s).
    pub(super) fn of_wall(key: Key, [since, time]: [f64; 2], path: &Path, (face, r): (&Face, f64)) -> Approach {
        let at = touch(face, path.at(time - since), r);
        let corner = |k: u8| face.shape.corners()[usize::from(k)];
        let seen = |k: u8| Path { x: path.x - corner(k), ..*path };
        let (shape, polynomial) = match at.part {
            Part::Face => {
                let normal = at.normal;
                let height = normal.dot(path.x - face.shape.center) - r;
                (Shape::Face, [height, normal.dot(path.v), 0.5 * normal.dot(path.a), 0.0, 0.0])
            }
            Part::Edge(k) => {
                let along = edge_direction(face, k);
                let across = |y: glam::DVec3| y - along * along.dot(y);
                let Path { x, v, a } = seen(k);
                let line = Path { x: across(x), v: across(v), a: across(a) };
                (Shape::Edge, distance_polynomial(&line, r))
            }
            Part::Corner(k) => (Shape::Corner, distance_polynomial(&seen(k), r)),
        };
        Approach { key, time, since, shape, polynomial }
    }

    /// The times τ ≥ 0 at which the polynomial is 0, s, ascending: four at most.
    pub fn roots(&self) -> Vec<f64> {
        roots::in_interval(&self.polynomial, 0.0, f64::INFINITY).to_vec()
    }

    /// How fast the polynomial grows at `tau` (s); negative: the bodies approach there.
    pub fn slope(&self, tau: f64) -> f64 {
        roots::slope(&self.polynomial, tau)
    }
}
