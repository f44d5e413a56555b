//! Equal hops of a sphere on a face, in closed form.
//!
//! Where an impact takes nothing off the wall, a sphere that bounces on a face takes the same hop again and again. Along the
//! face it slides meanwhile as if it flew; or, if the wall rubs, each impact leaves the same share of what is left to slide,
//! and the way that is left is a geometric series.

use glam::DVec3;

use super::record::Trajectory;
use super::rounding::{HOP, SUM, TOUCHED_GAP, UNTOLD};

/// A sphere that hops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hops {
    /// The face, by its index.
    pub(super) wall: usize,
    /// Unit normal of the face, towards the sphere.
    pub(super) normal: DVec3,
    /// The sphere right after the impact with which the first hop begins.
    pub(super) line: Trajectory,
    /// Acceleration of the sphere, m/s².
    pub(super) a: DVec3,
    /// Speed at which each hop leaves the face, m/s.
    pub(super) speed: f64,
    /// Acceleration towards the face, m/s².
    pub(super) press: f64,
    /// Share that an impact leaves of what slides along the face: 1 if the wall does not rub.
    pub(super) keeps: f64,
    /// Number of hops until the last one is over.
    pub(super) count: u64,
}

impl Hops {
    /// How long a hop takes, s.
    pub(super) fn period(&self) -> f64 {
        2.0 * self.speed / self.press
    }

    /// How high a hop is, m.
    pub(super) fn height(&self) -> f64 {
        0.5 * self.speed * self.speed / self.press
    }

    /// When the last hop is over, s.
    pub(super) fn end(&self) -> f64 {
        self.line.t + self.count as f64 * self.period()
    }

    /// Part of a vector along the face.
    fn along(&self, u: DVec3) -> DVec3 {
        u - self.normal * self.normal.dot(u)
    }

    /// Number of hops that are over at time `t`, s.
    pub(super) fn done(&self, t: f64) -> u64 {
        (((t - self.line.t) / self.period()) as u64).min(self.count)
    }

    /// The sphere at time `t`, s.
    pub(super) fn at(&self, t: f64) -> Trajectory {
        let (since, done) = (t - self.line.t, self.done(t));
        let hop = (since - done as f64 * self.period()).clamp(0.0, self.period());
        let [way, slip] = self.slid(since, (done, hop));
        let up = (self.speed - 0.5 * self.press * hop) * hop;
        let x = self.line.x + way + self.normal * up;
        Trajectory { x, v: slip + self.normal * (self.speed - self.press * hop), t, r: self.line.r }
    }

    /// How far along the face the sphere has come (m), and how fast it slides (m/s), `since` the first hop began (s), so many
    /// hops and a part of one (s) later.
    fn slid(&self, since: f64, (done, hop): (u64, f64)) -> [DVec3; 2] {
        let [slip, pull] = [self.along(self.line.v), self.along(self.a)];
        if !self.rubs() {
            return [(slip + pull * (0.5 * since)) * since, slip + pull * since];
        }
        let left = power(self.keeps, done);
        [self.way() * (1.0 - left) + slip * (left * hop), slip * left]
    }

    /// Whether the wall rubs.
    fn rubs(&self) -> bool {
        self.keeps < 1.0
    }

    /// All the way that a wall that rubs leaves the sphere to slide, m: Σ v τᵏ T.
    fn way(&self) -> DVec3 {
        self.along(self.line.v) * (self.period() / (1.0 - self.keeps))
    }

    /// What moves the sphere around the hops along the face: its velocity (m/s), and its acceleration (m/s²).
    pub(super) fn slide(&self) -> [DVec3; 2] {
        if self.rubs() { [DVec3::ZERO; 2] } else { [self.along(self.line.v), self.along(self.a)] }
    }

    /// Where the foot of the sphere begins, and where a wall that rubs lets it come to, m.
    pub(super) fn feet(&self) -> [DVec3; 2] {
        [self.line.x, if self.rubs() { self.line.x + self.way() } else { self.line.x }]
    }

    /// Whether hop follows hop as these tell: the wall does not rub; or nothing pulls the sphere along it, all of the way that
    /// is left is less than its gap may be, and the energy that is left to rub away, untold, is rounding.
    pub(super) fn is_series(&self) -> bool {
        let (slip, r) = (self.along(self.line.v), self.line.r);
        let pulled = self.along(self.a).length() > SUM * self.a.length();
        let near = self.way().length() <= TOUCHED_GAP * r;
        !self.rubs() || (!pulled && near && 0.5 * slip.length_squared() <= UNTOLD * self.press * r)
    }

    /// Rounding of the sphere's place, m.
    fn rounding(&self) -> f64 {
        HOP * self.line.x.abs().max_element().max(self.line.r)
    }

    /// The sphere around all of the hop, and all of what a wall that rubs leaves it to slide, sliding along a face that does
    /// not.
    pub(super) fn hull(&self) -> Trajectory {
        let Trajectory { t, r, .. } = self.line;
        let ([from, to], [slip, _]) = (self.feet(), self.slide());
        let (up, aside) = (0.5 * self.height(), 0.5 * from.distance(to));
        Trajectory { x: (from + to) * 0.5 + self.normal * up, v: slip, t, r: r + up + aside + self.rounding() }
    }
}

/// The power xⁿ, by squares.
fn power(x: f64, mut n: u64) -> f64 {
    let (mut square, mut product) = (x, 1.0);
    while n > 0 {
        product *= if n % 2 == 1 { square } else { 1.0 };
        square *= square;
        n /= 2;
    }
    product
}
