//! Velocities between two frames: flight and the frame's impacts, done again one by one, give the velocities at its end, as
//! long as nothing rests; and bodies that touch no wall keep their momentum together, whatever happens between them.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::physics::contact::Key;
use crate::physics::{Class, Contact, Kind, Method, Model, Settings, State};

use super::finding::{Bodies, Fault, Findings};
use super::law::reduced_mass;
use super::overlap::{is_summed_up, restitution};
use super::promise::{FLIGHT, ULPS};

/// Share of the speeds that rounding may leave unexplained: impacts of bodies of very different mass lose some digits.
const ROUNDING: f64 = 1e-11;

/// Height of a hop, in radii, below which event-driven methods let a row of bounces end in rest without telling each.
const HOP: f64 = 1e-6;

/// Contacts that touch: something that is no impact of the frame may hold, stop or release their bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Freedom<'a> {
    /// Contacts that touch at the end of the frame before.
    pub(super) before: &'a BTreeSet<Key>,
    /// Contacts that touch at the end of this frame.
    pub(super) after: &'a BTreeSet<Key>,
    /// Contacts of the frame before, which `paper` answers now.
    pub(super) answered: &'a [Contact],
}

/// What the judge knows of a sphere's velocity.
#[derive(Debug, Clone, Copy)]
struct Known {
    /// Velocity at `t`, m/s.
    v: DVec3,
    /// Time up to which it is known, s.
    t: f64,
    /// Whether an impact of the frame has changed it.
    struck: bool,
    /// Whether that impact was on a sphere that something else holds.
    on_held: bool,
}

/// Velocities computed again from impulses and forces.
#[derive(Debug, Clone)]
pub(super) struct Replay {
    known: Vec<Known>,
    /// Fastest speed of each sphere since its last impact, m/s: what rounding is relative to.
    scale: Vec<f64>,
    /// Bound of each sphere's speed in this frame, m/s.
    fastest: Vec<f64>,
}

impl Replay {
    pub(super) fn new(state: &State) -> Replay {
        Replay { known: Vec::new(), scale: state.v.iter().map(|v| v.length()).collect(), fastest: Vec::new() }
    }

    /// Judges the velocities at the ends of two frames, and the contacts between; the energy (J) that impacts and rests may
    /// have taken, where the method answers contacts one by one.
    pub(super) fn judge(
        &mut self,
        model: &Model,
        settings: &Settings,
        [before, after]: [&State; 2],
        (contacts, free): (&[Contact], Freedom),
        findings: &mut Findings,
    ) -> Option<f64> {
        self.known.clear();
        self.known.extend(before.v.iter().map(|&v| Known { v, t: before.t, struck: false, on_held: false }));
        for (scale, (v, w)) in self.scale.iter_mut().zip(before.v.iter().zip(&after.v)) {
            *scale = scale.max(v.length()).max(w.length());
        }
        let bound = free_spheres(model, free, contacts);
        let one_by_one = matches!(settings.method, Method::Exact | Method::Swept);
        let mut taken = bound.slack;
        if one_by_one {
            self.find_fastest(model, &bound, [before, after]);
            for row in contacts {
                taken += match row.class {
                    Class::Collide => self.strike(model, after, row, &bound, findings),
                    // what impulses take that act together: ½ J (v_n before + v_n after), each
                    Class::Rest => 0.5 * row.impulse * row.approach_speed,
                    Class::Leave | Class::Release => 0.0,
                };
            }
            taken += self.rubbed(model, settings, contacts) + self.summed(model, contacts);
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
        one_by_one.then_some(taken)
    }

    /// The energy (J) that series of bounces may take which are summed up: where bounces rub, all that moves along the
    /// wall.
    fn rubbed(&self, model: &Model, settings: &Settings, contacts: &[Contact]) -> f64 {
        let law = &model.law;
        if law.tangential == 1.0 || law.wall_restitution == 0.0 || law.wall_restitution == 1.0 {
            return 0.0;
        }
        let series = |row: &&Contact| match row.class {
            Class::Collide => row.kind == Kind::Wall && is_summed_up(model, settings, row),
            Class::Rest => row.kind == Kind::Wall,
            Class::Leave | Class::Release => false,
        };
        let all = |row: &Contact| 0.5 * model.masses[row.a] * self.fastest[row.a] * self.fastest[row.a];
        contacts.iter().filter(series).map(all).sum()
    }

    /// The energy (J) that impacts may take of which one row tells the sum: all of their bodies'.
    fn summed(&self, model: &Model, contacts: &[Contact]) -> f64 {
        let all = |i: usize| 0.5 * model.masses[i] * self.fastest[i] * self.fastest[i];
        let both = |row: &Contact| all(row.a) + if row.kind == Kind::Pair { all(row.b) } else { 0.0 };
        contacts.iter().filter(|row| row.impact_count() > 1).map(both).sum()
    }

    /// Bounds the speeds within the frame. Contacts do no work, so that √K of bodies that touch each other grows by no more
    /// than t √(½ Σ m a²), and ½ m v² of one is at most all of K.
    fn find_fastest(&mut self, model: &Model, bound: &Bound, [before, after]: [&State; 2]) {
        let h = after.t - before.t;
        let mut sums = vec![(0.0, 0.0); model.len()];
        for i in 0..model.len() {
            let (m, sum) = (model.masses[i], &mut sums[bound.root(i)]);
            sum.0 += 0.5 * m * before.v[i].length_squared();
            sum.1 += 0.5 * m * model.acceleration(i).length_squared();
        }
        let most = |i: usize| {
            let (kinetic, pull): (f64, f64) = sums[bound.root(i)];
            (kinetic.sqrt() + h * pull.sqrt()) * (2.0 / model.masses[i]).sqrt()
        };
        self.fastest = (0..model.len()).map(most).collect();
    }

    /// Lets sphere `i` fly until `t` (s).
    fn fly(&mut self, model: &Model, i: usize, t: f64) {
        let known = &mut self.known[i];
        known.v += model.acceleration(i) * (t - known.t);
        known.t = t;
    }

    /// Does an impact again, from the velocities known; the energy that it takes, J.
    fn strike(&mut self, model: &Model, after: &State, row: &Contact, bound: &Bound, findings: &mut Findings) -> f64 {
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
            let slack = self.slack(model, after, a) + if pair { self.slack(model, after, b) } else { 0.0 };
            // of a slow approach a place rounded by some ulp is worth more: compared as squares
            let worth = self.worth(model, after, a) + if pair { self.worth(model, after, b) } else { 0.0 };
            let off = (v_n + row.approach_speed).abs();
            let bound = slack.max(worth / (v_n.abs() + row.approach_speed.abs()));
            findings.hold(Fault::Approach, row.time, row.into(), [off, bound]);
        }
        let e = restitution(model, row.kind);
        // of what something else holds the velocity is not known, but what the contact told is
        let known = !(bound.holds[a] || (pair && bound.holds[b]));
        let change = (1.0 + e) * if known { -v_n } else { row.approach_speed };
        let mut taken = 0.5 * reduced_mass(model, row) * (1.0 - e * e) * row.approach_speed * row.approach_speed;
        self.known[a].struck = true;
        if pair {
            self.known[b].struck = true;
            self.known[a].on_held |= bound.holds[b];
            self.known[b].on_held |= bound.holds[a];
            let impulse = n * (change * reduced_mass(model, row));
            self.known[a].v += impulse / model.masses[a];
            self.known[b].v -= impulse / model.masses[b];
        } else {
            let (across, keeps) = (relative - n * v_n, model.law.tangential);
            // what rests also may strike with what its support has left of its velocity, or given it
            let most = across.length().max(self.fastest[a]);
            let across_squared = if bound.holds[a] { most * most } else { across.length_squared() };
            taken += 0.5 * model.masses[a] * (1.0 - keeps * keeps) * across_squared;
            self.known[a].v += n * change + across * (keeps - 1.0);
        }
        taken
    }

    /// What the error of a sphere's place is worth, m²/s²: 2 a · 64 ulp; where it met what moves on a curve, which
    /// event-driven methods follow by chords, what they promise of places, 2 a · 1e-12 r.
    fn worth(&self, model: &Model, after: &State, i: usize) -> f64 {
        let rounding = 4.0 * ULPS * (after.x[i].abs().max_element() + model.radii[i]);
        let chord = if self.known[i].on_held { FLIGHT * model.radii[i] } else { 0.0 };
        2.0 * model.acceleration(i).length() * (rounding + chord)
    }

    /// What may stay unexplained of a velocity, m/s: rounding of speeds and of the clock, for what has been struck what
    /// rounding of its place is worth, and the slow approaches that the law stops without an impact.
    fn slack(&self, model: &Model, after: &State, i: usize) -> f64 {
        let pull = model.acceleration(i).length();
        let flight = ROUNDING * self.scale[i] + ULPS * after.t.abs() * pull + 2.0 * model.law.rest_speed;
        if self.known[i].struck { flight + self.worth(model, after, i).sqrt() } else { flight }
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
    /// By sphere, another sphere of its group, or itself at the group's root.
    parent: Vec<usize>,
    /// By the group's root, whether a sphere of the group touches a wall.
    walled: Vec<bool>,
    /// Energy that slow approaches and ends of bouncing may take without an impact, J.
    slack: f64,
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

/// The spheres that are bound by contacts that touch, rest or collide in a frame.
fn free_spheres(model: &Model, free: Freedom, contacts: &[Contact]) -> Bound {
    let n = model.len();
    let slow = 2.0 * model.law.rest_speed * model.law.rest_speed;
    let slack = model.masses.iter().map(|m| m * slow).sum();
    let mut bound = Bound { holds: vec![false; n], parent: (0..n).collect(), walled: vec![false; n], slack };
    let mut held = Vec::new();
    for &(kind, a, b) in free.before.iter().chain(free.after) {
        held.push((kind, a, b));
        let hop = |i: usize| HOP * model.masses[i] * model.acceleration(i).length() * model.radii[i];
        bound.slack += hop(a) + if kind == Kind::Pair { hop(b) } else { 0.0 };
        bound.holds[a] = true;
        if kind == Kind::Pair {
            bound.holds[b] = true;
        }
    }
    // of impacts that one row sums up, the single velocities are not known
    for row in contacts.iter().filter(|row| row.impact_count() > 1) {
        bound.holds[row.a] = true;
        if row.kind == Kind::Pair {
            bound.holds[row.b] = true;
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
