//! The ground: parallelograms, closest points, boxes. No import of ours; only + − × ÷ √, so that the same input gives
//! the same bits on every machine.

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

/// Where on a parallelogram the closest point lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feature {
    /// Inside the outline.
    Face,
    /// On an edge, between two corners.
    Edge,
    /// At a corner.
    Corner,
}

/// The point of a parallelogram closest to a given point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// The closest point, m.
    pub point: DVec3,
    /// The way from the closest point to the given one, m; its length is the distance.
    pub offset: DVec3,
    /// What the closest point belongs to.
    pub feature: Feature,
}

impl Parallelogram {
    /// The corners, in order around the outline, m.
    pub fn corners(&self) -> [DVec3; 4] {
        let (h1, h2) = (self.s1 * 0.5, self.s2 * 0.5);
        let c = self.center;
        [c - h1 - h2, c + h1 - h2, c + h1 + h2, c - h1 + h2]
    }

    /// Unit normal, along s1 × s2; NaN if the edges are zero or parallel.
    pub fn normal(&self) -> DVec3 {
        let across = self.s1.cross(self.s2);
        // Divided, not multiplied by a reciprocal: an axis-aligned wall's normal is then exact.
        across / across.length()
    }

    /// Signed distance of `p` (m) from the wall's plane along [`Parallelogram::normal`], m.
    pub fn plane_distance(&self, p: DVec3) -> f64 {
        self.normal().dot(p - self.center)
    }

    /// Coordinates (u, v) of the projection of `p` (m) on the plane, p ≈ c + u s1 + v s2: inside where both lie in
    /// [−½, ½]. Dimensionless.
    pub fn coordinates(&self, p: DVec3) -> (f64, f64) {
        let across = self.s1.cross(self.s2);
        let from_center = p - self.center;
        let area_squared = across.length_squared();
        let u = from_center.cross(self.s2).dot(across) / area_squared;
        let v = self.s1.cross(from_center).dot(across) / area_squared;
        (u, v)
    }

    /// The closest point to `p` (m): on the face if `p` lies over it, else on the outline. For a face the offset comes
    /// from the plane distance, whose rounding does not grow with the wall.
    pub fn closest(&self, p: DVec3) -> Closest {
        let (u, v) = self.coordinates(p);
        if u.abs() <= 0.5 && v.abs() <= 0.5 {
            let normal = self.normal();
            let offset = normal * normal.dot(p - self.center);
            return Closest { point: p - offset, offset, feature: Feature::Face };
        }
        let [a, b, c, d] = self.corners();
        let edges = [(b, c), (c, d), (d, a)].map(|(from, to)| closest_on_segment(from, to, p));
        let nearer = |best: Closest, next: Closest| {
            if next.offset.length_squared() < best.offset.length_squared() { next } else { best }
        };
        edges.into_iter().fold(closest_on_segment(a, b, p), nearer)
    }

    /// The closest point to `p` (m) of face, edges and corners, m.
    pub fn closest_point(&self, p: DVec3) -> DVec3 {
        self.closest(p).point
    }

    /// Distance of `p` (m) from the closest point, m.
    pub fn distance(&self, p: DVec3) -> f64 {
        self.closest(p).offset.length()
    }

    /// The wall as [`Outline::may_touch`] wants it: worth while for more than one box.
    pub fn outline(&self) -> Outline {
        let across = |edge: DVec3| [DVec3::X, DVec3::Y, DVec3::Z].map(|side| side.cross(edge));
        let ([a, b, c], [d, e, f]) = (across(self.s1), across(self.s2));
        let axes = [self.s1.cross(self.s2), a, b, c, d, e, f, DVec3::ZERO];
        Outline {
            bounds: self.bounds(),
            center: self.center,
            axes: [0, 1, 2].map(|k| axes.map(|axis| axis[k])),
            sizes: [0, 1, 2].map(|k| axes.map(|axis| axis[k].abs())),
            reaches: axes.map(|axis| 0.5 * (axis.dot(self.s1).abs() + axis.dot(self.s2).abs())),
        }
    }

    /// The smallest box around the outline, m.
    pub fn bounds(&self) -> Bounds {
        let half = (self.s1.abs() + self.s2.abs()) * 0.5;
        Bounds { min: self.center - half, max: self.center + half }
    }
}

/// A parallelogram, and the axes on which a box can lie apart from it (the separating axis theorem): the sides of the
/// box, the normal, and the cross products of a side and an edge. Eight at a time, the last of which tells nothing.
#[derive(Debug, Clone, Copy)]
pub struct Outline {
    /// The smallest box around the parallelogram, m.
    bounds: Bounds,
    /// Centre, m.
    center: DVec3,
    /// Components of the axes (m², or m for a cross product with a side), of any length.
    axes: [[f64; 8]; 3],
    /// Absolute values of the components of the axes.
    sizes: [[f64; 8]; 3],
    /// Half the width of the parallelogram along each axis, m times the axis.
    reaches: [f64; 8],
}

impl Outline {
    /// Whether a box (m) may share a point with the wall: never false if it does, and true for no box that an edge, a
    /// face or a cross product of edges clearly separates from it.
    pub fn may_touch(&self, other: &Bounds) -> bool {
        let (half, between) = (other.size() * 0.5, other.center() - self.center);
        // Rounding of the difference grows with the coordinates: 1e-12 of them is some thousand units of it.
        let slack = 1e-12 * (other.center().abs().max(self.center.abs()).max_element() + half.max_element());
        if !other.grown(slack).touches(&self.bounds.grown(slack)) {
            return false;
        }
        let ([x, y, z], [a, b, c]) = (&self.axes, &self.sizes);
        let mut apart = false;
        // All eight and no branch, so that the compiler takes some at once.
        for k in 0..8 {
            let reach = half.x * a[k] + half.y * b[k] + half.z * c[k] + self.reaches[k];
            let distance = (x[k] * between.x + y[k] * between.y + z[k] * between.z).abs();
            apart |= distance > reach * (1.0 + 1e-12) + slack * (a[k] + b[k] + c[k]);
        }
        !apart
    }
}

/// The closest point to `p` of the segment between two points, m; a segment of length 0 is its first end.
pub fn closest_on_segment(from: DVec3, to: DVec3, p: DVec3) -> Closest {
    let along = to - from;
    let t = along.dot(p - from) / along.length_squared();
    let (point, feature) = if t > 0.0 && t < 1.0 {
        (from + along * t, Feature::Edge)
    } else {
        (if t >= 1.0 { to } else { from }, Feature::Corner)
    };
    Closest { point, offset: p - point, feature }
}

/// An axis-aligned box, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Smallest corner, m.
    pub min: DVec3,
    /// Largest corner, m.
    pub max: DVec3,
}

impl Bounds {
    /// The box of a sphere of centre `x` and radius `r`, m.
    pub fn around(x: DVec3, r: f64) -> Bounds {
        Bounds { min: x - DVec3::splat(r), max: x + DVec3::splat(r) }
    }

    /// The smallest box around both, m.
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The smallest box around all; none if there are none.
    pub fn of(boxes: impl IntoIterator<Item = Bounds>) -> Option<Bounds> {
        boxes.into_iter().reduce(Bounds::union)
    }

    /// Edge lengths, m.
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }

    /// Centre, m.
    pub fn center(&self) -> DVec3 {
        // Halved before they are added, so that no sum overflows.
        self.min * 0.5 + self.max * 0.5
    }

    /// The box moved out by `margin` (m) on every side; moved in if negative.
    pub fn grown(&self, margin: f64) -> Bounds {
        Bounds { min: self.min - DVec3::splat(margin), max: self.max + DVec3::splat(margin) }
    }

    /// Whether `p` (m) lies in the closed box.
    pub fn contains(&self, p: DVec3) -> bool {
        p.cmpge(self.min).all() && p.cmple(self.max).all()
    }

    /// Whether the closed boxes share a point.
    pub fn touches(&self, other: &Bounds) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slanted() -> Parallelogram {
        Parallelogram {
            center: DVec3::new(1.0, 2.0, 3.0),
            s1: DVec3::new(4.0, 0.0, 1.0),
            s2: DVec3::new(1.0, 2.0, 0.0),
        }
    }

    #[test]
    fn the_closest_point_is_never_farther_than_any_point_of_a_fine_grid() {
        let wall = slanted();
        for k in 0..512 {
            let at = |shift: u32| f64::from((k >> shift) & 7) - 3.5;
            let p = wall.center + DVec3::new(at(0), at(3), at(6)) * 1.7;
            let best = (0..201 * 201)
                .map(|i| (f64::from(i % 201) / 200.0 - 0.5, f64::from(i / 201) / 200.0 - 0.5))
                .map(|(u, v)| (wall.center + wall.s1 * u + wall.s2 * v).distance(p))
                .fold(f64::INFINITY, f64::min);
            let found = wall.distance(p);
            // The grid's own points are 0.02 m apart, so it can miss by that much, never undercut.
            assert!(found <= best + 1e-12 && found > best - 0.02, "{p}: {found} against {best}");
        }
    }

    #[test]
    fn face_edge_and_corner_are_told_apart_and_the_offset_leads_back() {
        let wall = Parallelogram { center: DVec3::ZERO, s1: DVec3::X * 2.0, s2: DVec3::Z * 2.0 };
        let cases = [
            (DVec3::new(0.3, 2.0, -0.4), DVec3::new(0.3, 0.0, -0.4), Feature::Face),
            (DVec3::new(3.0, 1.0, 0.5), DVec3::new(1.0, 0.0, 0.5), Feature::Edge),
            (DVec3::new(3.0, -1.0, 5.0), DVec3::new(1.0, 0.0, 1.0), Feature::Corner),
        ];
        for (p, point, feature) in cases {
            assert_eq!(wall.closest(p), Closest { point, offset: p - point, feature });
        }
    }

    #[test]
    fn a_wall_of_a_million_kilometres_still_knows_a_micrometre() {
        let wall = Parallelogram { center: DVec3::ZERO, s1: DVec3::X * 1e9, s2: DVec3::NEG_Z * 1e9 };
        let p = DVec3::new(3.0e8, 1e-6, 1.0);
        assert_eq!(wall.distance(p), 1e-6);
        assert_eq!(wall.normal(), DVec3::Y);
    }

    #[test]
    fn the_normal_of_an_axis_aligned_wall_is_exact() {
        for length in [0.1, 0.3, 7.0, 17.5, 20.0, 1e-9, 1e9] {
            let wall = Parallelogram { center: DVec3::ONE, s1: DVec3::X * length, s2: DVec3::Y * 0.7 };
            assert_eq!(wall.normal(), DVec3::Z, "length {length}");
        }
    }

    #[test]
    fn a_box_that_holds_a_point_of_a_wall_may_touch_it_and_a_box_well_off_does_not() {
        let (wall, outline) = (slanted(), slanted().outline());
        for k in 0..4096 {
            let at = |shift: u32| f64::from((k >> shift) & 15) - 7.5;
            let center = wall.center + DVec3::new(at(0), at(4), at(8)) * 0.4;
            for half in [0.01, 0.3, 1.0] {
                let (near, may) = (wall.distance(center), outline.may_touch(&Bounds::around(center, half)));
                // A box holds its inscribed ball and lies within the ball around it.
                assert!(may || near > half, "{center} is {near} m from the wall, half {half}");
                assert!(!may || near <= half * 3f64.sqrt() * (1.0 + 1e-9), "{center} is {near} m off, half {half}");
            }
        }
    }

    #[test]
    fn the_box_of_a_wall_holds_its_corners_and_no_more() {
        let corners = slanted().corners().map(|c| Bounds { min: c, max: c });
        assert_eq!(Some(slanted().bounds()), Bounds::of(corners));
    }
}
