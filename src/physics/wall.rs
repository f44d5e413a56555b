//! A wall as the physics sees it, and the part of it that is closest to a sphere.

use glam::DVec3;

use super::support::Surface;
use crate::geometry::Parallelogram;

/// Rounding of a distance from a wall, relative to the coordinates: 64 ulp.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A wall with what its tests need: unit normal and the dual vectors of its edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Centre and edges, m.
    pub shape: Parallelogram,
    /// Unit normal s1 × s2 / |s1 × s2|; contacts flip it to the sphere's side.
    pub normal: DVec3,
    /// d1 with d1·s1 = 1, d1·s2 = d1·n = 0, 1/m.
    pub dual1: DVec3,
    /// d2 with d2·s2 = 1, d2·s1 = d2·n = 0, 1/m.
    pub dual2: DVec3,
    /// Unit vectors along d1 and d2: outwards from the edges, in the plane.
    pub outward: [DVec3; 2],
    /// Distances between opposite edges, 1/|d1| and 1/|d2|, m.
    pub widths: [f64; 2],
    /// Whether no sphere can reach its edges, as long as none passes a wall.
    pub sealed: bool,
}

impl Face {
    /// What the tests of a wall of this shape need, its edges taken as within reach.
    pub fn new(shape: Parallelogram) -> Face {
        let normal = shape.normal();
        let (row1, row2) = (shape.s2.cross(normal), normal.cross(shape.s1));
        let (dual1, dual2) = (row1 / row1.dot(shape.s1), row2 / row2.dot(shape.s2));
        let lengths = [dual1.length(), dual2.length()];
        let outward = [dual1 / lengths[0], dual2 / lengths[1]];
        Face { shape, normal, dual1, dual2, outward, widths: lengths.map(|length| 1.0 / length), sealed: false }
    }

    /// Signed distance of `p` (m) from the wall's plane, m; positive on the side of `normal`.
    #[inline]
    pub fn height(&self, p: DVec3) -> f64 {
        (p - self.shape.center).dot(self.normal)
    }

    /// What rounding of the corners is relative to, m: no coordinate of a corner is larger.
    pub fn size(&self) -> f64 {
        let Parallelogram { center, s1, s2 } = self.shape;
        (center.abs() + 0.5 * (s1.abs() + s2.abs())).max_element()
    }

    /// What the distance of `p` (m) from the wall is at least, m: that from the strips between its opposite edges.
    #[inline]
    pub fn at_least(&self, p: DVec3) -> f64 {
        let q = p - self.shape.center;
        let beyond = |dual: DVec3, width: f64| (q.dot(dual).abs() - 0.5) * width;
        let (aside, height) =
            (beyond(self.dual1, self.widths[0]).max(beyond(self.dual2, self.widths[1])), q.dot(self.normal));
        if aside > 0.0 { (aside * aside + height * height).sqrt() } else { height.abs() }
    }

    /// Whether the wall is certainly farther than `distance` (m) from `p` (m), rounding included: tiles beside the one that a
    /// sphere touches, of which the closest point takes longer to find.
    #[inline]
    pub(crate) fn is_farther(&self, p: DVec3, distance: f64) -> bool {
        self.at_least(p) > distance + ROUNDING * self.size().max(p.abs().max_element())
    }

    /// Whether the foot of `p` (m) on the plane lies within the parallelogram, its boundary included.
    #[inline]
    pub fn shades(&self, p: DVec3) -> bool {
        let q = p - self.shape.center;
        q.dot(self.dual1).abs() <= 0.5 && q.dot(self.dual2).abs() <= 0.5
    }
}

/// The part of a parallelogram that is closest to a point. Edges and corners are numbered along the outline: edge k
/// runs from corner k to corner k + 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Part {
    /// The inside of the parallelogram.
    Face,
    /// An edge without its ends.
    Edge(u8),
    /// A corner.
    Corner(u8),
}

/// A sphere against a wall: where, along which normal, how far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The part of the wall that is touched.
    pub part: Part,
    /// The point of the wall that is closest to the centre, m.
    pub point: DVec3,
    /// Unit normal from the closest point to the centre.
    pub normal: DVec3,
    /// Distance of the centre from the closest point − r, m.
    pub gap: f64,
}

/// The closest point of a wall to a centre `x` (m) of a sphere of radius `r` (m).
#[inline]
pub fn touch(face: &Face, x: DVec3, r: f64) -> Touch {
    if face.shades(x) { touch_face(face, x, r) } else { touch_outline(face, x, r) }
}

/// The closest point of a wall's edges and corners. A corner counts only where the feet on both its edges are outside them,
/// and an edge where the centre is beyond it: within 1e-8 of a corner, relative to the distance, rounding would not tell it
/// from a foot beside it, nor the feet on its two edges from each other.
fn touch_outline(face: &Face, x: DVec3, r: f64) -> Touch {
    let corners = face.shape.corners();
    let shares = [0, 1, 2, 3].map(|k: usize| share_along(x, corners[k], corners[(k + 1) % 4]));
    let q = x - face.shape.center;
    let (one, two) = (q.dot(face.dual1), q.dot(face.dual2));
    let beyond = [two < -0.5, one > 0.5, two > 0.5, one < -0.5];
    let (mut closest, mut least) = ((Part::Corner(0), corners[0]), (true, f64::INFINITY));
    for (k, (&corner, &share)) in corners.iter().zip(&shares).enumerate() {
        let (candidate, behind) = if share > 0.0 && share < 1.0 {
            ((Part::Edge(k as u8), corner + (corners[(k + 1) % 4] - corner) * share), !beyond[k])
        } else if share <= 0.0 && shares[(k + 3) % 4] >= 1.0 {
            ((Part::Corner(k as u8), corner), false)
        } else {
            continue;
        };
        let squared = (x - candidate.1).length_squared();
        if (behind, squared) < least {
            (closest, least) = (candidate, (behind, squared));
        }
    }
    touch_point(closest, x, r)
}

/// Where the foot of `x` on the line through two corners lies: 0 at `from`, 1 at `to`.
#[inline]
fn share_along(x: DVec3, from: DVec3, to: DVec3) -> f64 {
    (x - from).dot(to - from) / (to - from).length_squared()
}

/// The foot of a centre on the plane of a wall.
#[inline]
fn touch_face(face: &Face, x: DVec3, r: f64) -> Touch {
    let height = face.height(x);
    let side = if height < 0.0 { -1.0 } else { 1.0 };
    let point = x - face.normal * height;
    Touch { part: Part::Face, point, normal: face.normal * side, gap: side * height - r }
}

/// The point of a given part of a wall that is closest to a centre `x` (m) of a sphere of radius `r` (m): a contact that
/// rolls over an edge stays with the part that it was handed to.
pub fn touch_part(face: &Face, part: Part, x: DVec3, r: f64) -> Touch {
    let point = match part {
        Part::Face => return touch_face(face, x, r),
        Part::Edge(k) => {
            let corners = face.shape.corners();
            let (from, to) = (corners[k as usize], corners[(k as usize + 1) % 4]);
            from + (to - from) * share_along(x, from, to)
        }
        Part::Corner(k) => face.shape.corners()[k as usize],
    };
    touch_point((part, point), x, r)
}

/// A point of an edge, or a corner.
fn touch_point((part, point): (Part, DVec3), x: DVec3, r: f64) -> Touch {
    let arm = x - point;
    let distance = arm.length();
    Touch { part, point, normal: arm / distance, gap: distance - r }
}

/// Unit vector along edge `k` of a wall.
pub fn edge_direction(face: &Face, k: u8) -> DVec3 {
    let side = if k.is_multiple_of(2) { face.shape.s1 } else { face.shape.s2 };
    side / side.length()
}

/// The shape of a part of a wall, `radius` (m) from a sphere's centre.
pub(crate) fn surface(face: &Face, part: Part, radius: f64) -> Surface {
    match part {
        Part::Face => Surface::Face,
        Part::Edge(k) => Surface::Edge { along: edge_direction(face, k), radius },
        Part::Corner(_) => Surface::Round { radius },
    }
}

/// What the curvature of a touched part adds to the second derivative of the gap, m/s²: |v_⊥|²/r at an edge or corner.
pub fn curvature(face: &Face, part: Part, normal: DVec3, v: DVec3, r: f64) -> f64 {
    surface(face, part, r).curvature_term(normal, v)
}
