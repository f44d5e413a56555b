//! What a sphere may meet: a wall, or another sphere. Closest points from the definition of a parallelogram, c + u s₁ + w
//! s₂ with |u|, |w| ≤ ½, and nothing of the solvers.

use super::vector::Vector;
use crate::double::Double;
use crate::scene::Wall;

/// A wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plate {
    pub(super) center: Vector,
    /// Edges, m.
    edges: [Vector; 2],
    /// Unit normal.
    pub(super) normal: Vector,
    /// Vectors (1/m) whose products with x − c are u and w.
    pub(super) duals: [Vector; 2],
}

/// The part of an obstacle that is met: all points whose distance decides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Part {
    /// A plane, by a point and the unit normal towards the sphere.
    Plane(Vector, Vector),
    /// A line, by a point and its unit vector.
    Line(Vector, Vector),
    /// A point.
    Point(Vector),
}

/// Which of the parts of a wall it is: −1, 0 or 1 for u and w, 0 where it is between the edges.
pub(super) type Region = [i8; 2];

/// The face of a wall.
pub(super) const FACE: Region = [0, 0];

/// Where another part of a wall takes over: where n · (x − c) + `offset` falls below 0, c being the wall's centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct Border {
    /// n, 1/m.
    pub(super) normal: Vector,
    pub(super) offset: Double,
    /// The part that takes over.
    pub(super) beyond: Region,
}

impl Plate {
    pub(super) fn new(wall: &Wall) -> Plate {
        let edges = [Vector::from(wall.shape.s1), wall.shape.s2.into()];
        let normal = edges[0].cross(edges[1]).unit();
        let rows = [edges[1].cross(normal), normal.cross(edges[0])];
        let dual = |k: usize| rows[k] * (Double::ONE / rows[k].dot(edges[k]));
        Plate { center: wall.shape.center.into(), edges, normal, duals: [dual(0), dual(1)] }
    }

    /// The part closest to `x`, and where it is: over the face the plane, else the closest point of the outline decides.
    pub(super) fn closest(&self, x: Vector) -> (Region, Part) {
        let q = x - self.center;
        let place = self.duals.map(|dual| q.dot(dual));
        let half = Double::from(0.5);
        if place[0].abs() <= half && place[1].abs() <= half {
            let side = if q.dot(self.normal) < Double::ZERO { -self.normal } else { self.normal };
            return ([0, 0], Part::Plane(self.center, side));
        }
        let mut best: Option<(Double, Region, Part)> = None;
        for along in [0, 1] {
            for sign in [-1_i8, 1] {
                let (distance, region, part) = self.closest_on_edge(q, along, sign);
                if best.is_none_or(|(least, ..)| distance < least) {
                    best = Some((distance, region, part));
                }
            }
        }
        best.map_or(([0, 0], Part::Point(self.center)), |(_, region, part)| (region, part))
    }

    /// The part of the wall in a region, seen from `x`.
    pub(super) fn part(&self, region: Region, x: Vector) -> Part {
        let half = |k: usize| self.edges[k] * Double::from(0.5 * f64::from(region[k]));
        match region.map(|place| place == 0) {
            [true, true] => {
                let behind = (x - self.center).dot(self.normal) < Double::ZERO;
                Part::Plane(self.center, if behind { -self.normal } else { self.normal })
            }
            [true, false] => Part::Line(self.center + half(1), self.edges[0].unit()),
            [false, true] => Part::Line(self.center + half(0), self.edges[1].unit()),
            [false, false] => Part::Point(self.center + half(0) + half(1)),
        }
    }

    /// Where a region ends. Of an edge the first is that to the face.
    pub(super) fn borders(&self, region: Region) -> Vec<Border> {
        let half = Double::from(0.5);
        let with = |k: usize, place: i8| {
            let mut beyond = region;
            beyond[k] = place;
            beyond
        };
        // how far along edge k, which is on side `side` of the wall: from −½ to ½
        let along = |k: usize, side: i8| {
            let normal = self.edges[k] * (Double::ONE / self.edges[k].dot(self.edges[k]));
            let middle = self.edges[1 - k] * Double::from(0.5 * f64::from(side));
            (normal, -normal.dot(middle))
        };
        let inside = |(normal, offset): (Vector, Double), k: usize| {
            [1_i8, -1].map(|place| {
                let sign = Double::from(-f64::from(place));
                Border { normal: normal * sign, offset: half + offset * sign, beyond: with(k, place) }
            })
        };
        let outside = |(normal, offset): (Vector, Double), k: usize| {
            let sign = Double::from(f64::from(region[k]));
            Border { normal: normal * sign, offset: offset * sign - half, beyond: with(k, 0) }
        };
        let face = |k: usize| (self.duals[k], Double::ZERO);
        match region.map(|place| place == 0) {
            [true, true] => inside(face(0), 0).into_iter().chain(inside(face(1), 1)).collect(),
            [false, false] => vec![outside(along(0, region[1]), 0), outside(along(1, region[0]), 1)],
            [first, _] => {
                let k = usize::from(!first); // runs along edge k
                let ends = inside(along(k, region[1 - k]), k);
                [outside(face(1 - k), 1 - k)].into_iter().chain(ends).collect()
            }
        }
    }

    /// Of the edge parallel to edge `along`, on the `sign` side of the other: distance squared of `q` (from the centre), and what
    /// is closest.
    fn closest_on_edge(&self, q: Vector, along: usize, sign: i8) -> (Double, Region, Part) {
        let (edge, aside) = (self.edges[along], self.edges[1 - along]);
        let middle = aside * Double::from(0.5 * f64::from(sign));
        let s = (q - middle).dot(edge) / edge.dot(edge);
        let end = if s > Double::from(0.5) { 1_i8 } else { -i8::from(s < Double::from(-0.5)) };
        let mut region = [sign; 2];
        region[along] = end;
        if end != 0 {
            let corner = middle + edge * Double::from(0.5 * f64::from(end));
            let arm = q - corner;
            return (arm.dot(arm), region, Part::Point(self.center + corner));
        }
        let arm = q - middle - edge * s;
        (arm.dot(arm), region, Part::Line(self.center + middle, edge.unit()))
    }
}

impl Part {
    /// The way from the closest point of the part to `x`, m.
    pub(super) fn arm(&self, x: Vector) -> Vector {
        match *self {
            Part::Plane(point, normal) => normal * normal.dot(x - point),
            Part::Line(point, along) => (x - point).across(along),
            Part::Point(point) => x - point,
        }
    }

    /// The unit normal at `x`, from the part to it.
    pub(super) fn normal(&self, x: Vector) -> Vector {
        match *self {
            Part::Plane(_, normal) => normal,
            Part::Line(..) | Part::Point(_) => self.arm(x).unit(),
        }
    }

    /// What is 0 when the distance of `x` is `reach` (m), and negative below, and how it changes with velocity `v`: along a
    /// plane distances, elsewhere their squares.
    pub(super) fn excess(&self, [x, v]: [Vector; 2], reach: Double) -> [Double; 2] {
        match *self {
            Part::Plane(point, normal) => [normal.dot(x - point) - reach, normal.dot(v)],
            Part::Line(..) | Part::Point(_) => {
                let arm = self.arm(x);
                [arm.dot(arm) - reach * reach, (arm.dot(v)) * Double::from(2.0)]
            }
        }
    }
}
