//! Equilibrium: which contacts of an island hold, and how its spheres move until something changes.
//!
//! Spheres that rest on faces move on parabolas that keep their distance: one face leaves two directions, a crease one,
//! a corner none. Spheres that rest on each other, on edges or on corners do so too as long as the normals of those
//! contacts stand still: a stack, a row sliding down a slope, a sphere sliding along an edge. Otherwise the motion is
//! curved (`curved`).

use glam::DVec3;

use crate::physics::events::curved::bodies::{Body, Closed, geometry};
use crate::physics::events::curved::equation::{BARELY, OPENED, power, pull};
use crate::physics::events::rounding::{BRUSH, DRIVEN, HOP, SUM, SUMMED_HOP};
use crate::physics::impact_law::is_lossless;
use crate::physics::model::Model;
use crate::physics::support::{
    Bodies, Fate, Resting, Row, Short, Surface, accelerations, restore, restore_unmet, velocities,
};

/// Cost of stopping what opens, in units of what it opens by, or of rounding if that is more, above which it is not stopped.
const DEAR: f64 = 10.0;

/// Most times that an island's accelerations are solved because to clear its velocities closed what had opened.
const ROUNDS: usize = 4;

/// An island after both complementarity problems.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Settled {
    /// Accelerations, m/s², by body; those of this instant if the motion is curved.
    pub(crate) a: Vec<DVec3>,
    /// Impulses that stopped what still approached, N s, by contact.
    pub(crate) impulses: Short<f64>,
    /// Normal velocities before they were stopped, m/s, by contact.
    pub(crate) v_n: Short<f64>,
    /// Whether the impulse of a contact changed a velocity by more than what counts as closed.
    pub(crate) struck: Short<bool>,
    /// Support forces, N, by contact.
    pub(crate) forces: Vec<f64>,
    /// What becomes of every contact.
    pub(crate) fate: Short<Fate>,
    /// Whether the normal of some contact that holds turns.
    pub(crate) curved: bool,
    /// Whether both problems were solved to rounding.
    pub(crate) converged: bool,
    /// Whether the contacts that hold have no normal velocity left but rounding; not where one lets go lest that be dear.
    pub(crate) cleared: bool,
}

/// Stops what still approaches, and finds what holds and how the island moves. Changes the velocities.
///
/// `clock` is what the clock does not tell, s: a contact that opens so slowly that, pressed, it would be closed again before
/// the clock or the coordinates can tell is closed.
/// `loads` (N, by contact) are what they carried last; what is `stuck` will be held even if it opens:
/// by contact, the approach (m/s) from which on it must be closed; infinite of what is not.
/// A contact whose load would end its hop below `low` radii is closed too.
pub(crate) fn solve_island(
    bodies: &mut [Body],
    contacts: &[Closed],
    (loads, stuck): (&[f64], &[f64]),
    (clock, low): (f64, f64),
) -> Settled {
    let (resting, gaps): (Short<Resting>, Short<f64>) =
        contacts.iter().map(|&contact| geometry(bodies, contact)).unzip();
    let inverse_mass: Short<f64> = bodies.iter().map(|body| body.inverse_mass).collect();
    let (applied, velocity): (Short<DVec3>, Short<DVec3>) = bodies.iter().map(|body| (body.applied, body.v)).unzip();
    let all = Bodies { inverse_mass: &inverse_mass, velocity: &velocity, applied: &applied };
    let slack: Short<f64> = bodies.iter().map(|body| closed_speed(body, clock)).collect();
    let (impulses, stopped) = stop_approaches(bodies, all, (&resting, loads), &slack);
    let strikes = |(contact, impulse): (&Resting, &f64)| {
        let change = |body: usize| impulse * inverse_mass[body] > slack[body];
        change(contact.a) || contact.b.is_some_and(change)
    };
    let mut settled = Settled {
        a: applied.to_vec(),
        struck: resting.iter().zip(&impulses).map(strikes).collect(),
        v_n: resting.iter().map(|contact| relative(contact, &|body| velocity[body]).dot(contact.normal)).collect(),
        impulses,
        forces: vec![0.0; contacts.len()],
        fate: Short::from_elem(Fate::Opening, contacts.len()),
        curved: false,
        converged: stopped,
        cleared: true,
    };
    for _ in 0..ROUNDS {
        settled.hold(bodies, all, (&resting, &gaps), (loads, &slack), low);
        let closed = settled.clear_normal_velocity(bodies, &inverse_mass, (&resting, &gaps, stuck), &slack);
        if !closed
            .iter()
            .any(|&index| settled.opening(&resting[index], bodies) < -settled.noise(&resting[index], bodies))
        {
            break;
        }
    }
    settled.stop(bodies, clock);
    settled.let_go(bodies, &resting);
    settled
}

/// Stops what approaches, by impulses (N s, by contact); whether they were found to rounding. The search begins with the
/// contacts that carry one of the `loads` (N) or approach.
fn stop_approaches(
    bodies: &mut [Body],
    all: Bodies,
    (resting, loads): (&[Resting], &[f64]),
    slack: &[f64],
) -> (Short<f64>, bool) {
    let none = || Short::from_elem(0.0, resting.len());
    if nothing_approaches(resting, all.velocity) {
        return (none(), true);
    }
    // what carried the weight carries most blows too
    let likely = |(contact, &load): (&Resting, &f64)| if approaches(contact, all.velocity) { 1.0 } else { load };
    let guess: Short<f64> = resting.iter().zip(loads).map(likely).collect();
    let stopped = velocities(all, resting, &guess);
    stopped.bodies.iter().zip(&stopped.vectors).for_each(|(&body, v)| bodies[body].v = *v);
    let costs = |((body, v), slack): ((&Body, &DVec3), &f64)| body.v.distance(*v) > DEAR * slack;
    let dear = bodies.iter().zip(all.velocity).zip(slack).any(costs);
    if !(dear && approaches_by_rounding(bodies, resting, all.velocity)) {
        return (Short::from_slice(&stopped.multipliers), stopped.converged());
    }
    let squeezing = resting.iter().zip(&stopped.multipliers).filter(|(_, impulse)| **impulse > 0.0);
    let v = restore(all.inverse_mass, all.velocity, &rows(squeezing.map(|(contact, _)| contact)));
    bodies.iter_mut().zip(v).for_each(|(body, v)| body.v = v);
    (none(), true)
}

/// Whether nothing approaches faster than rounding makes what moves along a wall seem to.
fn nothing_approaches(resting: &[Resting], velocity: &[DVec3]) -> bool {
    !resting.iter().any(|contact| approaches(contact, velocity))
}

/// Whether a contact approaches faster than rounding makes it seem to.
fn approaches(contact: &Resting, velocity: &[DVec3]) -> bool {
    let speed = velocity[contact.a].length() + contact.b.map_or(0.0, |b| velocity[b].length());
    relative(contact, &|body| velocity[body]).dot(contact.normal) < -BRUSH * speed
}

/// Whether nothing approaches but by rounding, that of places too, which turns the normals of edges, corners and pairs.
/// Where to stop that much changes a velocity by far more, its body lies between contacts that oppose each other: at the
/// ends of two walls that a sphere just fits it would take all of its speed.
fn approaches_by_rounding(bodies: &[Body], resting: &[Resting], velocity: &[DVec3]) -> bool {
    !resting.iter().any(|contact| {
        let speed = velocity[contact.a].length() + contact.b.map_or(0.0, |b| velocity[b].length());
        let size = |body: usize| bodies[body].x.abs().max_element();
        let turned = match contact.surface {
            Surface::Face => 1.0,
            Surface::Edge { radius, .. } | Surface::Round { radius } => {
                (contact.b.map_or(0.0, size).max(size(contact.a)) / radius).max(1.0)
            }
        };
        relative(contact, &|body| velocity[body]).dot(contact.normal) < -SUM * speed * turned
    })
}

/// Contacts as rows that hold.
fn rows<'a>(resting: impl Iterator<Item = &'a Resting>) -> Short<Row> {
    resting.map(|contact| Row { a: contact.a, b: contact.b, normal: contact.normal, offset: 0.0 }).collect()
}

/// Fastest v_n (m/s) at which a body is as good as closed on what it rests on: pressed, it would be back before the clock
/// (`clock`, s) or the coordinates can tell.
pub(crate) fn closed_speed(body: &Body, clock: f64) -> f64 {
    let (pull, size) = (body.applied.length(), body.x.abs().max_element() + body.r);
    clock * pull + SUM * body.v.length() + hop_speed(pull, HOP * size)
}

/// Height of hops, in radii, below which what is pressed does not hop at all: they would be summed up. Where nothing is lossy
/// they go on for ever, and none is taken away.
pub(crate) fn lowest_hop(model: &Model) -> f64 {
    if is_lossless(&model.law) { 0.0 } else { SUMMED_HOP }
}

/// Speed (m/s) with which something hops so high, m, against what pulls it, m/s².
pub(crate) fn hop_speed(pull: f64, height: f64) -> f64 {
    (2.0 * pull * height).sqrt()
}

/// The vector u of the first body less that of the second.
fn relative(contact: &Resting, u: &dyn Fn(usize) -> DVec3) -> DVec3 {
    u(contact.a) - contact.b.map_or(DVec3::ZERO, u)
}

impl Settled {
    /// Finds which of the contacts that are closed hold, and how the island moves.
    fn hold(
        &mut self,
        bodies: &[Body],
        all: Bodies,
        (resting, gaps): (&[Resting], &[f64]),
        (loads, slack): (&[f64], &[f64]),
        low: f64,
    ) {
        let opens = |contact: &Resting, more: &dyn Fn(usize) -> f64| {
            let limit = |body: usize| slack[body].max(more(body));
            let v_n = relative(contact, &|body| bodies[body].v).dot(contact.normal);
            v_n > limit(contact.a) + contact.b.map_or(0.0, limit)
        };
        let hop = |body: usize| hop_speed(bodies[body].applied.length(), low * bodies[body].r);
        let closed: Short<usize> = (0..resting.len()).filter(|&index| !opens(&resting[index], &hop)).collect();
        let touching: Short<Resting> = closed.iter().map(|&index| resting[index]).collect();
        let after: Short<DVec3> = bodies.iter().map(|body| body.v).collect();
        let guess: Short<f64> = closed.iter().map(|&index| loads[index]).collect();
        let held = accelerations(Bodies { velocity: &after, ..all }, &touching, &guess);
        self.converged &= held.converged();
        self.fate.fill(Fate::Opening);
        self.forces.fill(0.0);
        for (place, &body) in held.bodies.iter().enumerate() {
            self.a[body] = held.vectors[place];
        }
        for (place, &index) in closed.iter().enumerate() {
            self.forces[index] = held.multipliers[place];
        }
        self.curved = closed.iter().any(|&index| self.forces[index] > 0.0 && self.turns(&resting[index], bodies));
        for &index in &closed {
            // what opens faster than rounding is closed only if its own load ends its hop as low
            let load = self.forces[index];
            let hop = |body: usize| hop_speed(load * all.inverse_mass[body], low * bodies[body].r);
            if !opens(&resting[index], &hop) {
                self.fate[index] = self.fate_of(index, (&resting[index], gaps[index]), bodies);
            }
        }
    }

    /// What becomes of a contact that is closed, but for its gap (m).
    fn fate_of(&self, index: usize, (contact, gap): (&Resting, f64), bodies: &[Body]) -> Fate {
        if self.forces[index] > 0.0 {
            return Fate::Loaded;
        }
        let (opening, noise) = (self.opening(contact, bodies), self.noise(contact, bodies));
        let v = relative(contact, &|body| bodies[body].v);
        let parts = contact.normal.dot(v) > 0.0 && gap > OPENED * bodies[contact.a].r;
        if self.curved && opening <= BARELY * pull(bodies) && !parts {
            // the chord that stands for a curved motion could press it: it stays until the arc shows that it opens
            return Fate::Idle;
        }
        // unpressed and turning, it lets go: the next approach is a contact like any other
        if opening > noise || parts || self.turns(contact, bodies) { Fate::Opening } else { Fate::Idle }
    }

    /// Rate at which the normal velocity of a contact grows, m/s².
    fn opening(&self, contact: &Resting, bodies: &[Body]) -> f64 {
        let v = relative(contact, &|body| bodies[body].v);
        let a = relative(contact, &|body| self.a[body]);
        contact.normal.dot(a) + contact.surface.curvature_term(contact.normal, v)
    }

    /// Size of the rounding of relative accelerations, m/s², that of the velocities which turn the normal included.
    fn noise(&self, contact: &Resting, bodies: &[Body]) -> f64 {
        let sum = |of: &dyn Fn(&Body, DVec3) -> f64| {
            let of = |body: usize| of(&bodies[body], self.a[body]);
            SUM * (of(contact.a) + contact.b.map_or(0.0, of))
        };
        let slip = sum(&|body, _| body.v.length());
        let turned = match contact.surface {
            Surface::Face => 0.0,
            Surface::Edge { radius, .. } | Surface::Round { radius } => slip * slip / radius,
        };
        sum(&|body, a| body.applied.length() + a.length()) + turned
    }

    /// Whether the normal of a contact turns: its bodies move, or begin to move, past each other.
    fn turns(&self, contact: &Resting, bodies: &[Body]) -> bool {
        let speed = |body: usize| bodies[body].v.length();
        let noise = SUM * (speed(contact.a) + contact.b.map_or(0.0, speed));
        turning(contact, relative(contact, &|body| bodies[body].v)).length() > noise
            || turning(contact, relative(contact, &|body| self.a[body])).length() > self.noise(contact, bodies)
    }

    /// Takes what rounding left of the velocities of an island that has come to rest: less than what presses it would give
    /// any of its bodies before the clock can tell. Nothing turns then.
    fn stop(&mut self, bodies: &mut [Body], clock: f64) {
        let pull = pull(bodies);
        let rests = |(body, a): (&Body, &DVec3)| *a == DVec3::ZERO && body.v.length() <= clock * pull;
        if bodies.iter().zip(&self.a).all(rests) {
            bodies.iter_mut().for_each(|body| body.v = DVec3::ZERO);
            self.curved = false;
        }
    }

    /// Takes what rounding left of the normal velocities of contacts that hold, and stops what then approaches another
    /// contact of the island, idle or between bodies that just open: nothing else would, and to part them afterwards would
    /// push one body alone, out of nothing. A wall that opens is closed too, lest the sphere be driven into it, unless that
    /// is [`DEAR`]: of two walls that are nearly one, to stand still on both would stop the motion along them, and the
    /// one that opens lets go instead; so does the floor whose hold would drive the sphere into a step. Returns the contacts
    /// that were open and are closed by that.
    fn clear_normal_velocity(
        &mut self,
        bodies: &mut [Body],
        inverse_mass: &[f64],
        (resting, gaps, stuck): (&[Resting], &[f64], &[f64]),
        slack: &[f64],
    ) -> Short<usize> {
        let before: Short<DVec3> = bodies.iter().map(|body| body.v).collect();
        let v_n = |index: usize, v: &[DVec3]| relative(&resting[index], &|body| v[body]).dot(resting[index].normal);
        let loaded = |index: &usize| self.fate[*index] == Fate::Loaded;
        let (v, holds, dear) = self.cleared_at_cost((bodies, &before), inverse_mass, (resting, gaps, stuck), slack);
        let has = |index: usize, body: usize| resting[index].a == body || resting[index].b == Some(body);
        let meets = |index: usize, other: usize| {
            has(other, resting[index].a) || resting[index].b.is_some_and(|body| has(other, body))
        };
        let beside =
            |index: usize| (0..holds.len()).any(|other| holds[other] && !loaded(&other) && meets(index, other));
        let opens = |index: usize| {
            // a contact that stays open because another one would be driven in cannot hold with that
            let stays = || v_n(index, &v) > 0.5 * v_n(index, &before) && beside(index);
            holds[index] && v_n(index, &before) > SUM * before[resting[index].a].length() && (dear || stays())
        };
        let opening: Short<usize> = (0..holds.len()).filter(|&index| opens(index)).collect();
        self.cleared = opening.is_empty();
        if !self.cleared {
            opening.into_iter().for_each(|index| self.fate[index] = Fate::Opening);
            return Short::new();
        }
        bodies.iter_mut().zip(v).for_each(|(body, v)| body.v = v);
        let mut closed = Short::new();
        for index in (0..holds.len()).filter(|&index| holds[index]) {
            // what accelerates apart does so whatever rounding has made of its velocity: on parabolas nothing looks again
            let parts = !self.curved && self.opening(&resting[index], bodies) > self.noise(&resting[index], bodies);
            if self.fate[index] == Fate::Opening && !parts {
                self.fate[index] = Fate::Idle;
                closed.push(index);
            }
        }
        closed
    }

    /// Velocities (m/s, by body) without what rounding left of those along the normals, which contacts hold then, and whether
    /// that is dear: it takes velocity by more than rounding, or drives a body into what it did not approach. The bodies are
    /// given with their velocities `before`, m/s.
    fn cleared_at_cost(
        &self,
        (bodies, before): (&[Body], &[DVec3]),
        inverse_mass: &[f64],
        (resting, gaps, stuck): (&[Resting], &[f64], &[f64]),
        slack: &[f64],
    ) -> (Vec<DVec3>, Short<bool>, bool) {
        let loaded = |index: &usize| self.fate[*index] == Fate::Loaded;
        let v_n = |index: usize| relative(&resting[index], &|body| before[body]).dot(resting[index].normal);
        let most = (0..resting.len()).filter(loaded).map(v_n).fold(0.0, f64::max);
        let costs = |(body, v): (usize, &DVec3)| v.distance(before[body]) > DEAR * slack[body].max(most);
        let every = Short::from_elem(0.0, resting.len());
        let (mut v, mut holds) = self.cleared(before, inverse_mass, (resting, &every), power(bodies));
        let wall_opens = |index: usize| self.fate[index] == Fate::Opening && resting[index].b.is_none();
        // of two edges that are nearly one, to clear the one would drive the body into the other: on the way past both by 1e-12 r
        let drives = |v: &[DVec3], holds: &[bool]| {
            (0..resting.len()).any(|k| holds[k] && !loaded(&k) && is_driven(&resting[k], before, v, DRIVEN))
        };
        let mut driven = drives(&v, &holds);
        if (0..holds.len()).any(|index| holds[index] && wall_opens(index)) && v.iter().enumerate().any(costs) {
            (v, holds) = self.cleared(before, inverse_mass, (resting, stuck), power(bodies));
            let strikes = |k: usize| {
                is_driven(&resting[k], before, &v, SUM) && overlaps(&resting[k], gaps[k], &bodies[resting[k].a], &v)
            };
            driven = drives(&v, &holds) || (0..resting.len()).any(|k| !holds[k] && wall_opens(k) && strikes(k));
        }
        let dear = driven || v.iter().enumerate().any(costs);
        (v, holds, dear)
    }

    /// Velocities (m/s, by body) without what rounding left of those along the normals, and which contacts hold then: those
    /// that carry, and those that would approach. The `power` that moves the island, W, tells what rounding is.
    fn cleared(
        &self,
        before: &[DVec3],
        inverse_mass: &[f64],
        (resting, stuck): (&[Resting], &[f64]),
        power: f64,
    ) -> (Vec<DVec3>, Short<bool>) {
        let mut holds: Short<bool> = self.fate.iter().map(|fate| *fate == Fate::Loaded).collect();
        let mut v = before.to_vec();
        // of what keeps its velocity what is left of it would add up for as long as it slides along its walls
        let steady = !self.curved && self.a.iter().all(|a| *a == DVec3::ZERO);
        let precision = |contact: &Resting| if steady && contact.b.is_none() { BRUSH } else { SUM };
        loop {
            let held: Short<usize> = (0..holds.len()).filter(|&index| holds[index]).collect();
            let rows = rows(held.iter().map(|&index| &resting[index]));
            if rows.iter().any(|row| row.normal.dot(v[row.a] - row.b.map_or(DVec3::ZERO, |b| v[b])) != 0.0) {
                let unmet = |place: usize, v: &[DVec3]| self.is_unmet(held[place], &resting[held[place]], v, power);
                v = restore_unmet(inverse_mass, before, &rows, unmet);
            }
            let approaches = |index: usize| {
                let contact = &resting[index];
                let noise = precision(contact) * (v[contact.a].length() + contact.b.map_or(0.0, |b| v[b].length()));
                let may_close = self.fate[index] == Fate::Idle || contact.b.is_some();
                let least = if may_close { noise } else { stuck[index].max(noise) };
                relative(contact, &|body| v[body]).dot(contact.normal) < -least
            };
            let new: Short<usize> = (0..holds.len()).filter(|&index| !holds[index] && approaches(index)).collect();
            if new.is_empty() {
                return (v, holds);
            }
            new.into_iter().for_each(|index| holds[index] = true);
        }
    }

    /// Whether a contact that holds is not closed at these velocities (m/s): its load would work more than rounding of all
    /// the `power` (W) that moves the island, or it would be pressed in.
    fn is_unmet(&self, index: usize, contact: &Resting, v: &[DVec3], power: f64) -> bool {
        let v_n = relative(contact, &|body| v[body]).dot(contact.normal);
        match self.fate[index] {
            Fate::Loaded => self.forces[index] * v_n.abs() > SUM * power,
            Fate::Idle | Fate::Opening => approaches(contact, v),
        }
    }

    /// Lets go every idle contact whose bodies drift apart, however slowly: what would meet there again must be seen.
    fn let_go(&mut self, bodies: &[Body], resting: &[Resting]) {
        if self.curved {
            return;
        }
        for (contact, fate) in resting.iter().zip(&mut self.fate).filter(|(_, fate)| **fate == Fate::Idle) {
            let speed = bodies[contact.a].v.length() + contact.b.map_or(0.0, |b| bodies[b].v.length());
            if relative(contact, &|body| bodies[body].v).dot(contact.normal) > SUM * speed {
                *fate = Fate::Opening;
            }
        }
    }
}

/// Whether the velocities `after` (m/s, by body) drive a body into what it did not approach with those `before`, by more than
/// this share of its speed.
fn is_driven(contact: &Resting, before: &[DVec3], after: &[DVec3], share: f64) -> bool {
    let noise = share * before[contact.a].length();
    let v_n = |v: &[DVec3]| relative(contact, &|body| v[body]).dot(contact.normal);
    v_n(after) < -noise && v_n(before) >= -noise
}

/// Whether this body, gone straight on at these velocities (m/s, by body), would overlap what it has this gap (m) to by more
/// than coordinates can tell. It strikes the edge of a step; that of a level tile beyond a crack it only passes.
fn overlaps(contact: &Resting, gap: f64, body: &Body, v: &[DVec3]) -> bool {
    let u = relative(contact, &|body| v[body]);
    let (v_n, slip) = (contact.normal.dot(u), turning(contact, u).length());
    let radius = match contact.surface {
        Surface::Face => return true,
        Surface::Edge { radius, .. } | Surface::Round { radius } => radius,
    };
    0.5 * radius * v_n * v_n > (gap + HOP * (body.x.abs().max_element() + body.r)) * slip * slip
}

/// The part of a relative vector that turns the normal of a contact.
fn turning(contact: &Resting, u: DVec3) -> DVec3 {
    let tangential = u - contact.normal * contact.normal.dot(u);
    match contact.surface {
        Surface::Face => DVec3::ZERO,
        Surface::Edge { along, .. } => tangential - along * along.dot(tangential),
        Surface::Round { .. } => tangential,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Parallelogram;
    use crate::physics::events::curved::bodies::On;
    use crate::physics::wall::{Face, Part};

    const G: f64 = 9.8;
    const R: f64 = 0.5;

    /// What becomes of a sphere that leaves the floor it rests on with `v_n` (m/s), pressed on it by `pressed` (m/s²) of
    /// what pulls it, where hops below `low` radii need not begin: its normal velocity then, m/s, and its contact.
    fn leaves(v_n: f64, pressed: f64, low: f64) -> (f64, Fate) {
        let floor = Face::new(Parallelogram { center: DVec3::ZERO, s1: DVec3::X * 2.0, s2: DVec3::NEG_Z * 2.0 });
        let applied = DVec3::new((G * G - pressed * pressed).sqrt(), -pressed, 0.0);
        let mut bodies = [Body { x: DVec3::Y * R, v: DVec3::Y * v_n, applied, inverse_mass: 0.5, r: R, healed: 0.0 }];
        let contacts = [Closed { a: 0, on: On::Wall(&floor, Part::Face) }];
        let settled = solve_island(&mut bodies, &contacts, (&[0.0], &[f64::INFINITY]), (1e-15, low));
        (bodies[0].v.y, settled.fate[0])
    }

    #[test]
    fn a_hop_below_the_least_height_does_not_begin_and_a_higher_one_does() {
        // v_n² = 2 a h, of an h of 0.9 and 1.1 times 1e-12 r: 3e-6 m/s, twenty times what coordinates do not tell
        let speed = |share: f64| (2.0 * G * share * SUMMED_HOP * R).sqrt();
        assert_eq!(leaves(speed(0.9), G, SUMMED_HOP), (0.0, Fate::Loaded));
        assert_eq!(leaves(speed(1.1), G, SUMMED_HOP), (speed(1.1), Fate::Opening));
        // where nothing is lossy only what coordinates do not tell is closed
        assert_eq!(leaves(speed(0.9), G, 0.0), (speed(0.9), Fate::Opening));
        assert_eq!(leaves(1e-8, G, 0.0), (0.0, Fate::Loaded));
    }

    #[test]
    fn what_hardly_presses_ends_no_hop() {
        // on a steep wall a hop of the same speed goes a million times as far: 5e-7 m
        let speed = (2.0 * G * 0.9 * SUMMED_HOP * R).sqrt();
        assert_eq!(leaves(speed, 1e-6 * G, SUMMED_HOP), (speed, Fate::Opening));
    }
}
