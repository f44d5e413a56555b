//! What a trial step sees: how far apart two bodies are, how fast that changes, and what their shapes allow it to become.

use glam::DVec3;

use crate::physics::impact_law::{normal_velocity, pair_normal_velocity};
use crate::physics::path::Path;
use crate::physics::wall::{Face, curvature, touch};
use crate::physics::wall_parts::part_ahead;

/// Two bodies at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gap {
    /// Gap, m; negative: overlap.
    pub(super) gap: f64,
    /// Normal velocity, m/s, in the response's own expression.
    pub(super) v_n: f64,
    /// Acceleration along the normal, m/s². Both bodies lie on their sides of the plane through the contact point, so
    /// that gap + v_n s + a_n s²/2 is never more than the gap s seconds later.
    pub(super) a_n: f64,
}

/// Two bodies that move freely from now on.
pub(super) trait Separation {
    /// Gap, normal velocity and acceleration `s` seconds from now.
    fn at(&self, s: f64) -> Gap;
    /// Rate at which v_n grows just from `s` seconds from now on, m/s², curvature included.
    fn acceleration(&self, s: f64) -> f64;
    /// What the degree is measured by, m: r, or r₁ + r₂.
    fn reach(&self) -> f64;
    /// Size of the coordinates that the gap is a difference of, m.
    fn size(&self) -> f64;
    /// Largest acceleration along any normal, m/s².
    fn max_acceleration(&self) -> f64;
    /// Size of the velocities that v_n is a difference of `s` seconds from now, m/s.
    fn speed(&self, s: f64) -> f64;
}

/// A sphere of radius `r` (m) and a wall.
pub(super) struct WallSeparation<'a> {
    pub(super) path: &'a Path,
    pub(super) r: f64,
    pub(super) face: &'a Face,
}

impl Separation for WallSeparation<'_> {
    fn at(&self, s: f64) -> Gap {
        let touch = touch(self.face, self.path.at(s), self.r);
        let v_n = normal_velocity(self.path.velocity(s), DVec3::ZERO, touch.normal);
        Gap { gap: touch.gap, v_n, a_n: touch.normal.dot(self.path.a) }
    }

    fn acceleration(&self, s: f64) -> f64 {
        let (x, v) = (self.path.at(s), self.path.velocity(s));
        let normal = touch(self.face, x, self.r).normal;
        let part = part_ahead(self.face, &Path { x, v, a: self.path.a }, self.r);
        normal.dot(self.path.a) + curvature(self.face, part, normal, v, self.r)
    }

    fn reach(&self) -> f64 {
        self.r
    }

    fn size(&self) -> f64 {
        self.path.x.abs().max_element() + self.r
    }

    fn max_acceleration(&self) -> f64 {
        self.path.a.length()
    }

    fn speed(&self, s: f64) -> f64 {
        self.path.velocity(s).length()
    }
}

/// Two spheres whose radii sum to `reach` (m).
pub(super) struct PairSeparation<'a> {
    paths: [&'a Path; 2],
    /// Path of the first centre relative to the second.
    path: Path,
    reach: f64,
}

impl<'a> PairSeparation<'a> {
    pub(super) fn new(a: &'a Path, b: &'a Path, reach: f64) -> PairSeparation<'a> {
        PairSeparation { paths: [a, b], path: a.relative_to(b), reach }
    }

    /// Whether two spheres that part go on doing so: without relative acceleration, distances are convex in time. The
    /// answer for half of all pairs, without a root.
    pub(super) fn parts_for_good(&self) -> bool {
        self.path.a == DVec3::ZERO && self.path.x.dot(self.path.v) >= 0.0
    }
}

impl Separation for PairSeparation<'_> {
    fn at(&self, s: f64) -> Gap {
        let (x, v) = (self.path.at(s), self.path.velocity(s));
        let distance = x.length();
        let a_n = (x / distance).dot(self.path.a);
        Gap { gap: distance - self.reach, v_n: pair_normal_velocity(x, v), a_n }
    }

    fn acceleration(&self, s: f64) -> f64 {
        let (x, v) = (self.path.at(s), self.path.velocity(s));
        let distance = x.length();
        Path { x, v, a: self.path.a }.distance_acceleration(x / distance, distance)
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn size(&self) -> f64 {
        self.paths.iter().map(|path| path.x.abs().max_element()).fold(self.reach, f64::max)
    }

    fn max_acceleration(&self) -> f64 {
        self.path.a.length()
    }

    fn speed(&self, s: f64) -> f64 {
        self.paths.iter().map(|path| path.velocity(s).length()).sum()
    }
}
