//! Two bodies that touch: how they stand and move at one instant.

use glam::DVec3;

use super::record::Trajectory;
use super::rounding::{CLOCK_ULPS, HOP, SLOW, SUMMED_HOP};
use super::trajectories::Trajectories;
use crate::physics::approach::Approach;
use crate::physics::contact::{Class, Contact, Key, Kind};
use crate::physics::impact_law::{normal_velocity, pair_normal_velocity};
use crate::physics::model::Model;
use crate::physics::path::Path;
use crate::physics::wall::{Part, curvature, touch};
use crate::physics::wall_parts::part_ahead;

/// Two bodies that touch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactState {
    /// The two bodies that touch.
    pub(crate) key: Key,
    /// Contact point, m.
    pub(crate) point: DVec3,
    /// Unit normal, from the contact point to the first sphere's centre.
    pub(crate) normal: DVec3,
    /// Gap, m; negative: overlap.
    pub(crate) gap: f64,
    /// What the gap is measured by, m: r, or r₁ + r₂.
    pub(crate) reach: f64,
    /// Velocity of the first sphere relative to the other body, m/s.
    pub(crate) velocity: DVec3,
    /// Normal velocity v_n, m/s, by the expression that the prediction uses; negative: approaching.
    pub(crate) v_n: f64,
    /// Rate at which v_n grows with the present accelerations, m/s²; negative: pressed together.
    pub(crate) a_n: f64,
    /// Whether a_n stays as it is while the bodies move: at the face of a wall.
    pub(crate) flat: bool,
}

impl ContactState {
    /// Whether bodies pressed together with `pull` (m/s²) would part by less than coordinates can tell, flying off at the
    /// speed at which they approach or part.
    pub(crate) fn hops_within_rounding(&self, pull: f64) -> bool {
        self.v_n * self.v_n <= 2.0 * pull * HOP * self.size()
    }

    /// Whether bodies pressed together would be apart for no longer than the clock can tell, of which one ulp is
    /// `clock_ulp`, s.
    pub(crate) fn hops_within_the_clock(&self, clock_ulp: f64) -> bool {
        self.v_n.abs() <= CLOCK_ULPS * -self.a_n * clock_ulp
    }

    /// Whether bodies that accelerate apart would stop their approach by themselves sooner than the clock can tell, of
    /// which one ulp is `clock_ulp`, s.
    pub(crate) fn turns_within_the_clock(&self, clock_ulp: f64) -> bool {
        -self.v_n <= self.a_n * clock_ulp
    }

    /// How high a hop may be (m) to be one of a series that is summed up: what coordinates resolve, at least, and out of
    /// an overlap, which hides the rest of the series.
    pub(crate) fn small_hop(&self) -> f64 {
        (SUMMED_HOP * self.reach).max(HOP * self.size()).max(-self.gap)
    }

    /// What rounding of its coordinates is relative to, m.
    pub(crate) fn size(&self) -> f64 {
        self.point.abs().max_element().max(self.reach)
    }

    /// The row of this contact at `time` (s): `impulse` in N s, v_n afterwards in m/s.
    pub(crate) fn row(&self, time: f64, class: Class, impulse: f64, separation_speed: f64) -> Contact {
        let (kind, a, b) = self.key;
        Contact {
            time,
            kind,
            a,
            b,
            point: self.point,
            normal: self.normal,
            velocity: self.velocity,
            approach_speed: -self.v_n,
            separation_speed,
            impulse,
            degree: -self.gap / self.reach,
            class,
            impacts: 1,
        }
    }
}

impl Trajectories {
    /// The bodies of a contact now; their trajectories stay as they are.
    pub(crate) fn contact_state(&self, model: &Model, key: Key) -> ContactState {
        let (kind, a, b) = key;
        match kind {
            Kind::Wall => self.wall_state(model, key),
            Kind::Pair => {
                pair_state(key, [self.trajectory(a), self.trajectory(b)], [a, b].map(|i| self.path(i, self.now)))
            }
        }
    }

    fn wall_state(&self, model: &Model, key: Key) -> ContactState {
        let (_, a, b) = key;
        let path = self.path(a, self.now);
        let (face, r) = (&model.faces[b], self.trajectory(a).r);
        let at = touch(face, path.x, r);
        let v_n = normal_velocity(path.v, DVec3::ZERO, at.normal);
        // only what may rest asks on which side of a border it will be
        let slow = v_n.abs() <= SLOW * path.v.length();
        let part = if slow { part_ahead(face, &path, r) } else { at.part };
        let a_n = at.normal.dot(path.a) + curvature(face, part, at.normal, path.v, r);
        let flat = part == Part::Face && at.part == part;
        let (point, normal, gap) = (at.point, at.normal, at.gap);
        ContactState { key, point, normal, gap, reach: r, velocity: path.v, v_n, a_n, flat }
    }

    /// Point, normal, gap and velocity of a contact at `time` (s); v_n and a_n of a wall, which take far longer to find,
    /// stay 0.
    pub(crate) fn contact_geometry(&self, model: &Model, key: Key, time: f64) -> ContactState {
        let (kind, a, b) = key;
        if kind == Kind::Pair {
            return pair_state(key, [self.trajectory(a), self.trajectory(b)], [a, b].map(|i| self.path(i, time)));
        }
        let (reach, path) = (self.trajectory(a).r, self.path(a, time));
        let at = touch(&model.faces[b], path.x, reach);
        let (point, normal, gap) = (at.point, at.normal, at.gap);
        ContactState { key, point, normal, gap, reach, velocity: path.v, v_n: 0.0, a_n: 0.0, flat: false }
    }

    /// How the bodies of a contact that touch now came together since the motion of one of them last changed.
    pub(crate) fn approach(&self, model: &Model, key: Key) -> Approach {
        let (kind, a, b) = key;
        let (one, since) = (self.trajectory(a), self.trajectory(a).t);
        if kind == Kind::Wall {
            return Approach::of_wall(key, [since, self.now], &self.path(a, since), (&model.faces[b], one.r));
        }
        let since = since.max(self.trajectory(b).t);
        let path = self.path(a, since).relative_to(&self.path(b, since));
        Approach::of_pair(key, [since, self.now], &path, one.r + self.trajectory(b).r)
    }

    /// The normal velocity of a contact whose trajectories are at the present, m/s.
    pub(crate) fn v_n(&self, model: &Model, key: Key) -> f64 {
        let (kind, a, b) = key;
        if kind == Kind::Wall {
            let path = self.path(a, self.now);
            let normal = touch(&model.faces[b], path.x, self.trajectory(a).r).normal;
            return normal_velocity(path.v, DVec3::ZERO, normal);
        }
        let (one, two) = (self.trajectory(a), self.trajectory(b));
        pair_normal_velocity(one.x - two.x, one.v - two.v)
    }
}

/// The contact of two spheres on these trajectories, at the beginning of these paths.
fn pair_state(key: Key, lines: [&Trajectory; 2], [one, two]: [Path; 2]) -> ContactState {
    let relative = one.relative_to(&two);
    let [r_a, r_b] = lines.map(|line| line.r);
    let (reach, distance) = (r_a + r_b, relative.x.length());
    let (normal, gap) = (relative.x / distance, distance - reach);
    let v_n = pair_normal_velocity(relative.x, relative.v);
    let a_n = relative.distance_acceleration(normal, distance);
    let point = two.x + normal * (r_b + 0.5 * gap);
    ContactState { key, point, normal, gap, reach, velocity: relative.v, v_n, a_n, flat: false }
}
