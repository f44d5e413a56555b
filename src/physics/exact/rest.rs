//! Rest: which contacts of an island hold, and how its spheres move until something changes.
//!
//! Spheres that rest on faces move on parabolas that keep their distance: one face leaves two directions, a crease one,
//! a corner none. Spheres that rest on each other, on edges or on corners do so too as long as the normals of those
//! contacts stand still: a stack, a row sliding down a slope, a sphere sliding along an edge. Otherwise the motion is
//! curved (`curved`).

use glam::DVec3;

use super::super::Model;
use super::super::contact_time::{Part, Path, edge_direction, touch, touch_part};
use super::super::model::Face;
use super::super::support::{Bodies, Fate, Held, Resting, Surface, hold};

/// What a sphere rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::physics) enum On {
    /// This part of this wall.
    Wall(usize, Part),
    /// This sphere, of higher index.
    Sphere(usize),
}

/// A contact that rests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::physics) struct Rest {
    /// The sphere.
    pub(in crate::physics) a: usize,
    /// What it rests on.
    pub(in crate::physics) on: On,
}

/// Spheres connected by resting contacts, at one instant.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::physics) struct Group {
    /// Indices of the spheres, ascending.
    pub(in crate::physics) spheres: Vec<usize>,
    /// Centres, m, in that order.
    pub(in crate::physics) x: Vec<DVec3>,
    /// Velocities, m/s, in that order.
    pub(in crate::physics) v: Vec<DVec3>,
    /// The contacts, by scene indices.
    pub(in crate::physics) rests: Vec<Rest>,
}

/// How a group moves until the next event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::physics) enum Motion {
    /// Not at all.
    Asleep,
    /// Every sphere on a parabola of its own.
    Parabolas,
    /// Some contact turns.
    Curved,
}

/// A group after both complementarity problems.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::physics) struct Settled {
    /// Accelerations, m/s², by sphere of the group; those of this instant if the motion is curved.
    pub(in crate::physics) a: Vec<DVec3>,
    /// Impulses that stopped what still approached, N s, by contact.
    pub(in crate::physics) impulses: Vec<f64>,
    /// Support forces, N, by contact.
    pub(in crate::physics) forces: Vec<f64>,
    /// What becomes of every contact.
    pub(in crate::physics) fate: Vec<Fate>,
    /// How the group moves from here.
    pub(in crate::physics) motion: Motion,
    /// Whether both problems were solved to rounding.
    pub(in crate::physics) converged: bool,
}

impl Group {
    /// The place of a sphere in the group's lists; it must be one of the group.
    pub(in crate::physics) fn place(&self, sphere: usize) -> usize {
        self.spheres.partition_point(|&other| other < sphere)
    }

    /// A contact as `support` sees it, in the group's own indices, and its gap, m.
    pub(super) fn contact(&self, model: &Model, rest: Rest) -> (Resting, f64) {
        let a = self.place(rest.a);
        match rest.on {
            On::Wall(wall, part) => {
                let face = &model.faces[wall];
                let touch = touch_part(face, part, self.x[a], model.radii[rest.a]);
                let radius = model.radii[rest.a] + touch.gap;
                let surface = match part {
                    Part::Face => Surface::Face,
                    Part::Edge(k) => Surface::Edge { along: edge_direction(face, k), radius },
                    Part::Corner(_) => Surface::Round { radius },
                };
                (Resting { a, b: None, normal: touch.normal, surface }, touch.gap)
            }
            On::Sphere(other) => {
                let b = self.place(other);
                let arm = self.x[a] - self.x[b];
                let radius = arm.length();
                let gap = radius - (model.radii[rest.a] + model.radii[other]);
                (Resting { a, b: Some(b), normal: arm / radius, surface: Surface::Round { radius } }, gap)
            }
        }
    }

    /// 1/m by sphere of the group, 1/kg.
    pub(super) fn inverse_masses(&self, model: &Model) -> Vec<f64> {
        self.spheres.iter().map(|&sphere| model.inverse_masses[sphere]).collect()
    }

    /// Accelerations by everything but contacts, m/s².
    pub(super) fn applied(&self, model: &Model) -> Vec<DVec3> {
        self.spheres.iter().map(|&sphere| model.acceleration(sphere)).collect()
    }

    /// Stops what still approaches, and finds what holds and how the group moves. Changes the velocities.
    pub(in crate::physics) fn settle(&mut self, model: &Model) -> Settled {
        let contacts: Vec<Resting> = self.rests.iter().map(|&rest| self.contact(model, rest).0).collect();
        let (inverse_mass, applied) = (self.inverse_masses(model), self.applied(model));
        let bodies = Bodies { inverse_mass: &inverse_mass, velocity: &self.v, applied: &applied };
        let mut held = hold(bodies, &contacts, &[]);
        let mut a = applied.clone();
        for (place, &body) in held.velocity.bodies.iter().enumerate() {
            self.v[body] = held.velocity.vectors[place];
            a[body] = held.acceleration.vectors[place];
        }
        let mut motion =
            if self.v.iter().chain(&a).all(|u| *u == DVec3::ZERO) { Motion::Asleep } else { Motion::Parabolas };
        for (index, contact) in contacts.iter().enumerate() {
            if held.fate[index] != Fate::Opening && self.turns(contact, &a, &held) {
                // Unpressed, it lets go: the next approach is a contact like any other.
                match held.fate[index] {
                    Fate::Loaded => motion = Motion::Curved,
                    _ => held.fate[index] = Fate::Opening,
                }
            }
        }
        let converged = held.converged();
        let (impulses, forces) = (held.velocity.multipliers, held.acceleration.multipliers);
        Settled { a, impulses, forces, fate: held.fate, motion, converged }
    }

    /// Whether the normal of a contact turns: its bodies move, or begin to move, past each other.
    fn turns(&self, contact: &Resting, a: &[DVec3], held: &Held) -> bool {
        let across = |u: &[DVec3], rounding: &[f64]| {
            let relative = u[contact.a] - contact.b.map_or(DVec3::ZERO, |b| u[b]);
            let noise = rounding[contact.a] + contact.b.map_or(0.0, |b| rounding[b]);
            let tangential = relative - contact.normal * contact.normal.dot(relative);
            let turning = match contact.surface {
                Surface::Face => DVec3::ZERO,
                Surface::Edge { along, .. } => tangential - along * along.dot(tangential),
                Surface::Round { .. } => tangential,
            };
            turning.length() > noise
        };
        // Every sphere of a group is named by a contact, so the solutions list all of them, in order.
        across(&self.v, &held.velocity.rounding) || across(a, &held.acceleration.rounding)
    }

    /// Moves every sphere along its parabola for `time`, s.
    pub(in crate::physics) fn fly(&mut self, a: &[DVec3], time: f64) {
        for ((x, v), &a) in self.x.iter_mut().zip(&mut self.v).zip(a) {
            let path = Path { x: *x, v: *v, a };
            (*x, *v) = (path.at(time), path.velocity(time));
        }
    }
}

/// How far the closest point of a sphere's centre `x` is inside a part of a wall, m: the least distance to where another
/// part takes over; negative beyond.
pub(in crate::physics) fn room(face: &Face, part: Part, x: DVec3) -> f64 {
    let corners = face.shape.corners();
    let along = |k: usize, from: usize| edge_direction(face, k as u8 % 4).dot(x - corners[from % 4]);
    match part {
        Part::Face => (0..4).map(|k| -outside(face, k, x)).fold(f64::INFINITY, f64::min),
        Part::Edge(k) => {
            let k = k as usize;
            // Directions are those of s1, s2; edges 2 and 3 run against them.
            let (from, to) = if k < 2 { (k, k + 1) } else { (k + 1, k) };
            along(k, from).min(-along(k, to)).min(outside(face, k, x))
        }
        Part::Corner(k) => {
            let k = k as usize;
            let (next, last) = (k % 4, (k + 3) % 4);
            let beyond_next = if next < 2 { -along(next, k) } else { along(next, k) };
            let beyond_last = if last < 2 { along(last, k) } else { -along(last, k) };
            beyond_next.min(beyond_last)
        }
    }
}

/// Distance of the foot of `x` outside the line of edge `k`, m.
fn outside(face: &Face, k: usize, x: DVec3) -> f64 {
    let q = x - face.shape.center;
    let (dual, sign) = match k {
        0 => (face.dual2, -1.0),
        1 => (face.dual1, 1.0),
        2 => (face.dual2, 1.0),
        _ => (face.dual1, -1.0),
    };
    (sign * dual.dot(q) - 0.5) / dual.length()
}

/// When a centre on `path`, whose closest point lies on `part` of a wall, comes to where another part takes over, s from
/// now: the first time at which it is on the border or beyond and moving outwards. The borders are planes, so this is a
/// quadratic. Only times below `before` (s) matter.
pub(in crate::physics) fn part_end(face: &Face, part: Part, path: &Path, before: f64) -> Option<f64> {
    let mut first: Option<f64> = None;
    let mut border = |value: f64, direction: DVec3| {
        let c = [value, direction.dot(path.v), 0.5 * direction.dot(path.a)];
        if let Some(t) = super::super::contact_time::quadratic_fall(c).filter(|&t| t < first.unwrap_or(before)) {
            first = Some(t);
        }
    };
    let corners = face.shape.corners();
    let outward = |k: usize| match k {
        0 => -face.dual2,
        1 => face.dual1,
        2 => face.dual2,
        _ => -face.dual1,
    };
    let ends = |k: usize| (corners[k % 4], (corners[(k + 1) % 4] - corners[k % 4]).normalize());
    match part {
        Part::Face => (0..4).for_each(|k| border(-outside(face, k, path.x), -outward(k) / outward(k).length())),
        Part::Edge(k) => {
            let (from, direction) = ends(k as usize);
            let to = ends(k as usize + 1).0;
            border((path.x - from).dot(direction), direction);
            border((to - path.x).dot(direction), -direction);
            border(outside(face, k as usize, path.x), outward(k as usize) / outward(k as usize).length());
        }
        Part::Corner(k) => {
            let (corner, next) = ends(k as usize);
            let last = ends(k as usize + 3).1;
            border((corner - path.x).dot(next), -next);
            border((path.x - corner).dot(last), last);
        }
    }
    first
}

/// The part of a wall that is closest to a sphere of radius `r` (m) at `x` just from now on, given how it moves: on a
/// border it is the part that the motion leads to.
pub(in crate::physics) fn part_ahead(face: &Face, x: DVec3, v: DVec3, a: DVec3, r: f64) -> Part {
    // Far enough to be clear of the rounding of x, near enough not to change anything but a border's side.
    let ahead = 1e-9 * r;
    let direction = if v == DVec3::ZERO { a } else { v };
    let length = direction.length();
    let look = if length > 0.0 { x + direction * (ahead / length) } else { x };
    touch(face, look, r).part
}
