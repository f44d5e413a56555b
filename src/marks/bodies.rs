//! What a scene says of its bodies, as a mark needs it: gaps, pulls, energy, momentum. Nothing of the solvers is in it.

use glam::DVec3;

use super::ledger::Totals;
use crate::geometry::Parallelogram;
use crate::physics::Kind;
use crate::physics::contact::Key;
use crate::scene::{ContactLaw, Scene};

/// Most spheres of which every pair is looked at.
const FEW: usize = 16;

/// The bodies of a scene.
#[derive(Debug, Clone)]
pub(super) struct Bodies {
    pub(super) law: ContactLaw,
    pub(super) radii: Vec<f64>,
    pub(super) masses: Vec<f64>,
    /// Accelerations in flight, m/s².
    pub(super) pulls: Vec<DVec3>,
    walls: Vec<(Parallelogram, DVec3)>,
}

/// Two bodies that are near each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Touch {
    pub(super) key: Key,
    /// Gap, m; below 0 the bodies overlap.
    pub(super) gap: f64,
    /// Unit normal, towards the sphere, of a pair towards the first.
    pub(super) normal: DVec3,
    /// Whether the sphere's centre is where s1 × s2 of the wall does not point to.
    pub(super) behind: bool,
}

impl Bodies {
    pub(super) fn of(scene: &Scene) -> Bodies {
        Bodies {
            law: scene.contact,
            radii: scene.spheres.iter().map(|sphere| sphere.radius).collect(),
            masses: scene.spheres.iter().map(|sphere| sphere.mass).collect(),
            pulls: scene.spheres.iter().map(|sphere| scene.gravity + sphere.force / sphere.mass).collect(),
            walls: scene.walls.iter().map(|wall| (wall.shape, wall.shape.normal())).collect(),
        }
    }

    pub(super) fn walls(&self) -> usize {
        self.walls.len()
    }

    /// Radius of the sphere, of a pair the sum of both radii, m.
    pub(super) fn reach(&self, (kind, a, b): Key) -> f64 {
        if kind == Kind::Pair { self.radii[a] + self.radii[b] } else { self.radii[a] }
    }

    /// Restitution of a contact.
    pub(super) fn restitution(&self, kind: Kind) -> f64 {
        if kind == Kind::Wall { self.law.wall_restitution } else { self.law.restitution }
    }

    /// A vector (velocity, pull) of the first body relative to the second, or to the wall, from those by sphere.
    pub(super) fn relative(&self, (kind, a, b): Key, of: &[DVec3]) -> DVec3 {
        if kind == Kind::Pair { of[a] - of[b] } else { of[a] }
    }

    /// The contact of a sphere at `x` (m) and a wall.
    pub(super) fn at_wall(&self, a: usize, b: usize, x: DVec3) -> Touch {
        let (shape, front) = &self.walls[b];
        let offset = shape.closest(x).offset;
        let distance = offset.length();
        let normal = if distance > 0.0 { offset / distance } else { *front };
        let behind = front.dot(x - shape.center) < 0.0;
        Touch { key: (Kind::Wall, a, b), gap: distance - self.radii[a], normal, behind }
    }

    /// The contact of two spheres at these places, m.
    pub(super) fn at_pair(&self, [a, b]: [usize; 2], [x, y]: [DVec3; 2]) -> Touch {
        let arm = x - y;
        let distance = arm.length();
        let normal = if distance > 0.0 { arm / distance } else { DVec3::Y };
        let gap = distance - self.radii[a] - self.radii[b];
        Touch { key: (Kind::Pair, a, b), gap, normal, behind: false }
    }

    /// All contacts of spheres at `x` (m by sphere) whose gap is at most `share` of their reach.
    pub(super) fn near(&self, x: &[DVec3], share: f64) -> Vec<Touch> {
        let mut found = Vec::new();
        for (a, x) in x.iter().enumerate() {
            let most = self.radii[a] * (1.0 + share);
            let close =
                |(_, (shape, front)): &(usize, &(Parallelogram, DVec3))| front.dot(*x - shape.center).abs() <= most;
            let touches = self.walls.iter().enumerate().filter(close).map(|(b, _)| self.at_wall(a, b, *x));
            found.extend(touches.filter(|touch| touch.gap <= self.radii[a] * share));
        }
        self.pairs(x, share, |pair| {
            let touch = self.at_pair(pair, pair.map(|i| x[i]));
            if touch.gap <= self.reach(touch.key) * share {
                found.push(touch);
            }
        });
        found
    }

    /// Calls `meet` for each pair a < b that may be as near as `share` of its reach: in the order of the places along x,
    /// while they are near there.
    fn pairs(&self, x: &[DVec3], share: f64, mut meet: impl FnMut([usize; 2])) {
        if x.len() <= FEW {
            (0..x.len()).for_each(|a| (a + 1..x.len()).for_each(|b| meet([a, b])));
            return;
        }
        let largest = self.radii.iter().copied().fold(0.0, f64::max);
        let mut order: Vec<usize> = (0..x.len()).collect();
        order.sort_by(|&a, &b| x[a].x.total_cmp(&x[b].x));
        for (place, &a) in order.iter().enumerate() {
            let most = x[a].x + (self.radii[a] + largest) * (1.0 + share);
            for &b in order[place + 1..].iter().take_while(|&&b| x[b].x <= most) {
                meet([a.min(b), a.max(b)]);
            }
        }
    }

    /// The wall of lowest index through whose face the way of a centre from `from` to `to` (m) goes; none if it goes
    /// through none.
    pub(super) fn passed(&self, from: DVec3, to: DVec3) -> Option<usize> {
        self.walls.iter().position(|(shape, front)| {
            let [start, end] = [from, to].map(|x| front.dot(x - shape.center));
            if start * end >= 0.0 {
                return false;
            }
            let (u, v) = shape.coordinates(from + (to - from) * (start / (start - end)));
            u.abs() < 0.5 && v.abs() < 0.5
        })
    }

    /// Energy Σ ½ m v² − m pull · x, J, and momentum Σ m v, kg m/s.
    pub(super) fn totals(&self, x: &[DVec3], v: &[DVec3]) -> Totals {
        let of = |i: usize| self.masses[i] * (0.5 * v[i].length_squared() - self.pulls[i].dot(x[i]));
        let momentum = v.iter().zip(&self.masses).map(|(v, mass)| *v * *mass).sum();
        Totals { energy: (0..x.len()).map(of).sum(), momentum }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    #[test]
    fn near_bodies_are_found_however_many_there_are() {
        let bodies = Bodies::of(&scene::open("box-gas").expect("built in").scene);
        let mut x: Vec<DVec3> = scene::open("box-gas").expect("built in").scene.spheres.iter().map(|s| s.x).collect();
        x[7] = x[3] + DVec3::Z * bodies.radii[3];
        let found: Vec<Key> =
            bodies.near(&x, 0.0).into_iter().filter(|touch| touch.gap < 0.0).map(|touch| touch.key).collect();
        assert!(found.contains(&(Kind::Pair, 3, 7)), "{found:?}");
    }

    #[test]
    fn a_way_through_a_face_passes_it_and_one_beside_it_does_not() {
        let bodies = Bodies::of(&scene::open("paper-1").expect("built in").scene);
        let slope = bodies.walls() - 1;
        let (above, below) = (DVec3::new(3.0, 4.0, 5.0), DVec3::new(3.0, 2.0, 5.0));
        assert_eq!(bodies.passed(above, below), Some(slope));
        assert_eq!(bodies.passed(above - DVec3::X * 6.0, below - DVec3::X * 6.0), None);
    }
}
