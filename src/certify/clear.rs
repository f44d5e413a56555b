//! The proof that a sphere on a parabola stays clear of an obstacle: a plane that has the obstacle behind it, and the whole
//! piece of the path in front.
//!
//! In front of a plane the distance is a quadratic in time, which is positive where its three Bernstein coefficients are.
//! Where no plane is found for a piece it is halved. So a yes is a proof but for rounding, for which there is a margin; a
//! no means only that nothing was shown.

use glam::DVec3;

/// A path relative to the obstacle, from 0 to `length`, s.
#[derive(Debug, Clone, Copy)]
pub(super) struct Way {
    pub(super) x: DVec3,
    pub(super) v: DVec3,
    pub(super) a: DVec3,
    pub(super) length: f64,
    /// Overlap that the path may begin with, m: of a contact that has just been answered.
    pub(super) overlap: f64,
    /// Whether the path is known to begin in touch with the obstacle, at rest along the normal, and to be drawn away.
    pub(super) lifts: bool,
    /// Whether bodies touch as the path ends.
    pub(super) end: bool,
    /// How fast the path may leave this parabola, m/s, from where they agree: the end, if bodies touch there, else the beginning.
    pub(super) sway: f64,
}

/// An obstacle about the origin: the point that stands for another sphere, or a wall by its edges, m.
#[derive(Debug, Clone, Copy)]
pub(super) enum Shape {
    Point,
    Plate { edges: [DVec3; 2], normal: DVec3, duals: [DVec3; 2] },
}

/// Rounding of sums of products, in ulp of the largest.
const ULPS: f64 = 32.0 * f64::EPSILON;

/// Halvings after which a piece is given up.
const MOST_HALVINGS: u32 = 45;

impl Shape {
    /// A vector from the closest point to `x`, as near as rounding has it.
    fn arm(&self, x: DVec3) -> DVec3 {
        let Shape::Plate { edges, normal, duals } = *self else { return x };
        let place = duals.map(|dual| x.dot(dual));
        if place.iter().all(|u| u.abs() <= 0.5) {
            return normal * x.dot(normal);
        }
        let clamped = |along: usize, sign: f64| {
            let (edge, middle) = (edges[along], edges[1 - along] * (0.5 * sign));
            x - middle - edge * ((x - middle).dot(edge) / edge.length_squared()).clamp(-0.5, 0.5)
        };
        let arms = [clamped(0, -1.0), clamped(0, 1.0), clamped(1, -1.0), clamped(1, 1.0)];
        arms.into_iter()
            .fold(DVec3::INFINITY, |best, arm| if arm.length_squared() < best.length_squared() { arm } else { best })
    }

    /// How far the obstacle reaches along the unit vector `n`, m.
    fn reach(&self, n: DVec3) -> f64 {
        match self {
            Shape::Point => 0.0,
            Shape::Plate { edges, .. } => 0.5 * (n.dot(edges[0]).abs() + n.dot(edges[1]).abs()),
        }
    }

    fn size(&self) -> f64 {
        match self {
            Shape::Point => 0.0,
            Shape::Plate { edges, .. } => edges[0].length() + edges[1].length(),
        }
    }
}

impl Way {
    fn at(&self, t: f64) -> DVec3 {
        self.x + (self.v + self.a * (0.5 * t)) * t
    }

    fn velocity(&self, t: f64) -> DVec3 {
        self.v + self.a * t
    }

    /// The largest |v| on the way, at most, m/s.
    fn speed(&self) -> f64 {
        self.v.length() + self.a.length() * self.length + self.sway
    }

    /// How far the path may be from the parabola at `t`, m, and how fast it leaves it, m/s.
    fn stray(&self, t: f64) -> [f64; 2] {
        if self.end { [self.sway * (self.length - t), -self.sway] } else { [self.sway * t, self.sway] }
    }
}

/// The time (s) up to which it is shown that `way` stays clear of a `shape` by `radius` (m); none if it is for the whole
/// way.
pub(super) fn doubt(way: &Way, shape: &Shape, radius: f64) -> Option<f64> {
    let margin = ULPS * (way.x.length() + way.speed() * way.length + shape.size() + radius);
    Search { way, shape, radius, margin }.piece([0.0, way.length], 0)
}

struct Search<'a> {
    way: &'a Way,
    shape: &'a Shape,
    radius: f64,
    margin: f64,
}

impl Search<'_> {
    fn piece(&self, [from, to]: [f64; 2], depth: u32) -> Option<f64> {
        let middle = from + 0.5 * (to - from);
        let at_start = from == 0.0;
        let at_end = self.way.end && to == self.way.length;
        let look = match (at_start, at_end) {
            (true, _) => from,
            (false, true) => to,
            (false, false) => middle,
        };
        if self.in_front([from, to], look) || (at_start && self.in_front([from, to], middle)) {
            return None;
        }
        if depth == MOST_HALVINGS || middle <= from || middle >= to {
            return Some(from);
        }
        self.piece([from, middle], depth + 1).or_else(|| self.piece([middle, to], depth + 1))
    }

    /// Whether the plane that touches the obstacle where it is closest at `look` (s) has the piece in front of it.
    fn in_front(&self, [from, to]: [f64; 2], look: f64) -> bool {
        let (way, length) = (self.way, to - from);
        let arm = self.shape.arm(way.at(look));
        let n = arm / arm.length();
        let distance = |t: f64| n.dot(way.at(t)) - self.shape.reach(n) - self.radius - way.stray(t)[0];
        let (first, last) = (distance(from), distance(to));
        let rates = [from, to].map(|t| n.dot(way.velocity(t)) - way.stray(t)[1]);
        let clearly = ULPS * way.speed();
        // in touch it must part, and before it touches approach; the distance itself is 0 then
        let starts = from == 0.0 && first.abs() <= self.margin.max(way.overlap);
        let parts = rates[0] > clearly || (way.lifts && rates[0] >= -clearly);
        let ends = way.end && to == way.length && last.abs() <= self.margin;
        let inner = match (starts, ends) {
            (true, true) => return parts && rates[1] < -clearly,
            (true, false) => parts,
            (false, true) => rates[1] < -clearly,
            (false, false) => first + 0.5 * rates[0] * length > self.margin,
        };
        inner && (starts || first > self.margin) && (ends || last > self.margin)
    }
}
