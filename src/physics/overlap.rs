//! How deep now? Gaps, degrees, normals of spheres with walls and each other.
//!
//! Gap: distance of a sphere's centre to the **closest point** of the parallelogram (face, edge or corner) minus r; of
//! a pair: distance of the centres minus r1 + r2. Degree: −gap / r, −gap / (r1 + r2) (source: paper 2.2; its distance
//! to the plane alone jumps at edges and has no root there).

use glam::DVec3;

use super::model::Face;

/// Where and how deep two bodies touch (negative degree: apart).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Contact point, m: on the wall, or on the line of centres in the middle of the overlap.
    pub point: DVec3,
    /// Unit normal, from the contact point to the (first) sphere's centre.
    pub normal: DVec3,
    /// −gap / r or −gap / (r1 + r2), dimensionless.
    pub degree: f64,
}

/// A sphere of radius `r` (m) at `x` against a wall. The side of the wall it is on is that of `from`, its centre at the
/// frame's start: past the plane the degree goes on growing beyond 1, so that a search never accepts the far side.
pub fn wall_touch(face: &Face, from: DVec3, x: DVec3, r: f64) -> Touch {
    let height = face.height(x);
    if face.shades(x) {
        let side = if face.height(from) < 0.0 { -1.0 } else { 1.0 };
        let degree = 1.0 - side * height / r;
        return Touch { point: x - face.normal * height, normal: face.normal * side, degree };
    }
    let point = closest_on_outline(face, x);
    let arm = x - point;
    let distance = arm.length();
    Touch { point, normal: arm / distance, degree: 1.0 - distance / r }
}

/// Gap, m, up to which bodies of size `r` (m) at coordinates of size `at` (m) touch at load: what rounding may leave
/// between bodies that are meant to touch, 1e-12 r or 8 ulp of the coordinates.
pub fn touching(r: f64, at: f64) -> f64 {
    (1e-12 * r).max(8.0 * f64::EPSILON * at)
}

/// Degree of a sphere of radius `r` (m) at `x` with a wall, or nothing if it is below −`slack`. `from` as in
/// [`wall_touch`].
#[inline]
pub fn wall_degree(face: &Face, from: DVec3, x: DVec3, r: f64, slack: f64) -> Option<f64> {
    let height = face.height(x);
    // The plane is never farther than the parallelogram: most spheres are done here.
    if height.abs() > r * (1.0 + slack) {
        return None;
    }
    let degree = wall_touch(face, from, x, r).degree;
    (degree >= -slack).then_some(degree)
}

/// Spheres at `a` and `b` whose radii sum to `reach` (m).
pub fn pair_touch(a: DVec3, b: DVec3, r_b: f64, reach: f64) -> Touch {
    let arm = a - b;
    let distance = arm.length();
    // Coincident centres have no normal: any fixed one separates them.
    let normal = if distance > 0.0 { arm / distance } else { DVec3::Y };
    let degree = 1.0 - distance / reach;
    Touch { point: b + normal * (r_b - 0.5 * degree * reach), normal, degree }
}

/// Degree of two spheres whose radii sum to `reach` (m), or nothing if it is below −`slack`.
#[inline]
pub fn pair_degree(a: DVec3, b: DVec3, reach: f64, slack: f64) -> Option<f64> {
    let squared = (a - b).length_squared();
    let limit = reach * (1.0 + slack);
    if squared > limit * limit {
        return None;
    }
    let degree = 1.0 - squared.sqrt() / reach;
    (degree >= -slack).then_some(degree)
}

/// The point of the parallelogram's outline closest to `p`, m.
fn closest_on_outline(face: &Face, p: DVec3) -> DVec3 {
    let corners = face.shape.corners();
    let mut best = corners[0];
    let mut least = f64::INFINITY;
    for (k, &start) in corners.iter().enumerate() {
        let edge = corners[(k + 1) % 4] - start;
        let along = ((p - start).dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
        let point = start + edge * along;
        let squared = (p - point).length_squared();
        if squared < least {
            (best, least) = (point, squared);
        }
    }
    best
}
