//! Velocities between two frames: flight and the frame's impacts, done again one by one, give the velocities at its end, as
//! long as nothing rests; and bodies that touch no wall keep their momentum together, whatever happens between them.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::physics::contact::Key;
use crate::physics::{Class, Contact, Kind, Method, Model, State};

use super::finding::{Bodies, Fault, Findings};
use super::law::reduced_mass;
use super::overlap::restitution;
use super::promise::ULPS;

/// Share of the speeds that rounding may leave unexplained: impacts of bodies of very different mass lose some digits.
const ROUNDING: f64 = 1e-11;

/// Who touches, and so may be held, stopped or released by what is no impact of the frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Freedom<'a> {
    /// At the end of the frame before.
    pub(super) before: &'a BTreeSet<Key>,
    /// At the end of this one.
    pub(super) after: &'a BTreeSet<Key>,
    /// Contacts of the frame before, which `paper` answers now.
    pub(super) answered: &'a [Contact],
}

/// What the judge knows of a sphere's velocity.
#[derive(Debug, Clone, Copy)]
struct Known {
    v: DVec3,
    t: f64,
    /// Whether an impact of the frame has changed it.
    struck: bool,
}

/// Velocities done again.
#[derive(Debug, Clone)]
pub(super) struct Replay {
    known: Vec<Known>,
    /// Fastest since the last impact, m/s: what rounding is relative to.
    scale: Vec<f64>,
}

impl Replay {
    pub(super) fn new(state: &State) -> Replay {
        Replay { known: Vec::new(), scale: state.v.iter().map(|v| v.length()).collect() }
    }

    /// Judges the velocities at the ends of two frames, and the contacts between.
    pub(super) fn judge(
        &mut self,
        model: &Model,
        method: Method,
        [before, after]: [&State; 2],
        (contacts, free): (&[Contact], Freedom),
        findings: &mut Findings,
    ) {
        self.known.clear();
        self.known.extend(before.v.iter().map(|&v| Known { v, t: before.t, struck: false }));
        for (scale, (v, w)) in self.scale.iter_mut().zip(before.v.iter().zip(&after.v)) {
            *scale = scale.max(v.length()).max(w.length());
        }
        let bound = free_spheres(model, free, contacts);
        if matches!(method, Method::Exact | Method::Swept) {
            for row in contacts.iter().filter(|row| row.class == Class::Collide) {
                self.strike(model, after, row, &bound, findings);
            }
            for i in (0..model.len()).filter(|&i| !bound.holds[i]) {
                self.fly(model, i, after.t);
                let off = (after.v[i] - self.known[i].v).length();
                findings.hold(Fault::Velocity, after.t, Bodies::Sphere(i), [off, self.slack(model, after, i)]);
            }
        }
        self.momentum(model, [before, after], &bound, findings);
        for (scale, (known, v)) in self.scale.iter_mut().zip(self.known.iter().zip(&after.v)) {
            if known.struck {
                *scale = v.length();
            }
        }
    }

    /// Lets sphere `i` fly until `t` (s).
    fn fly(&mut self, model: &Model, i: usize, t: f64) {
        let known = &mut self.known[i];
        known.v += model.acceleration(i) * (t - known.t);
        known.t = t;
    }

    /// Does an impact again, from the velocities known.
    fn strike(&mut self, model: &Model, after: &State, row: &Contact, bound: &Bound, findings: &mut Findings) {
        let pair = row.kind == Kind::Pair;
        let (a, b, n) = (row.a, row.b, row.normal);
        self.fly(model, a, row.time);
        if pair {
            self.fly(model, b, row.time);
            let both = self.scale[a].max(self.scale[b]);
            (self.scale[a], self.scale[b]) = (both, both);
        }
        let relative = self.known[a].v - if pair { self.known[b].v } else { DVec3::ZERO };
        let v_n = relative.dot(n);
        if !(bound.holds[a] || (pair && bound.holds[b])) {
            // a place rounded by some ulp is worth so much of a small normal velocity
            let slack = self.slack(model, after, a) + if pair { self.slack(model, after, b) } else { 0.0 };
            findings.hold(Fault::Approach, row.time, row.into(), [(v_n + row.approach_speed).abs(), slack]);
        }
        let change = -(1.0 + restitution(model, row.kind)) * v_n;
        self.known[a].struck = true;
        if pair {
            self.known[b].struck = true;
            let impulse = n * (change * reduced_mass(model, row));
            self.known[a].v += impulse / model.masses[a];
            self.known[b].v -= impulse / model.masses[b];
        } else {
            let across = relative - n * v_n;
            self.known[a].v += n * change + across * (model.law.tangential - 1.0);
        }
    }

    /// What may stay unexplained of a velocity, m/s: rounding of speeds and of the clock, and for what has been struck what
    /// rounding of its place is worth.
    fn slack(&self, model: &Model, after: &State, i: usize) -> f64 {
        let pull = model.acceleration(i).length();
        let flight = ROUNDING * self.scale[i] + ULPS * after.t.abs() * pull;
        let place = (2.0 * pull * 4.0 * ULPS * (after.x[i].abs().max_element() + model.radii[i])).sqrt();
        if self.known[i].struck { flight + place } else { flight }
    }

    /// Bodies joined by contacts, none of them with a wall, keep their momentum but for what forces give.
    fn momentum(&self, model: &Model, [before, after]: [&State; 2], bound: &Bound, findings: &mut Findings) {
        let h = after.t - before.t;
        let mut sums = vec![(DVec3::ZERO, 0.0, 0_usize); model.len()];
        for i in 0..model.len() {
            let m = model.masses[i];
            let change = after.v[i] - before.v[i] - model.acceleration(i) * h;
            let sum = &mut sums[bound.root(i)];
            sum.0 += change * m;
            sum.1 += m * (self.scale[i] * ROUNDING + ULPS * after.t.abs() * model.acceleration(i).length());
            sum.2 += 1;
        }
        for (i, (change, slack, count)) in sums.into_iter().enumerate() {
            if count > 1 && !bound.walled[i] {
                findings.hold(Fault::Momentum, after.t, Bodies::Sphere(i), [change.length(), slack]);
            }
        }
    }
}

/// What binds spheres in a frame.
struct Bound {
    /// Whether something that is no impact may have changed the velocity.
    holds: Vec<bool>,
    /// Who belongs together: another one of the group, or itself.
    parent: Vec<usize>,
    /// By the group's root, whether one of it touches a wall.
    walled: Vec<bool>,
}

impl Bound {
    fn root(&self, mut i: usize) -> usize {
        while self.parent[i] != i {
            i = self.parent[i];
        }
        i
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        let (low, high) = (a.min(b), a.max(b));
        self.parent[high] = low;
        self.walled[low] |= self.walled[high];
    }
}

/// Who is bound by what touches, rests or collides in a frame.
fn free_spheres(model: &Model, free: Freedom, contacts: &[Contact]) -> Bound {
    let n = model.len();
    let mut bound = Bound { holds: vec![false; n], parent: (0..n).collect(), walled: vec![false; n] };
    let mut held = Vec::new();
    for &(kind, a, b) in free.before.iter().chain(free.after) {
        held.push((kind, a, b));
        bound.holds[a] = true;
        if kind == Kind::Pair {
            bound.holds[b] = true;
        }
    }
    let rows = contacts.iter().chain(free.answered).map(Contact::key);
    for (kind, a, b) in held.into_iter().chain(rows) {
        match kind {
            Kind::Pair => bound.join(a, b),
            Kind::Wall => {
                let root = bound.root(a);
                bound.walled[root] = true;
            }
        }
    }
    bound
}
