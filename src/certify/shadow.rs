//! The shadow run: it is told which bodies `exact` has brought together, and finds the rest by itself.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::body::{Body, Due, Held};
use super::clear::Shape;
use super::course::Course;
use super::ending::{Cause, Ending};
use super::glance::Glance;
use super::growth::Growth;
use super::law;
use super::obstacle::Plate;
use super::vector::Vector;
use crate::double::Double;
use crate::physics::{Class, Contact, Kind, Simulation, State};
use crate::scene::{ContactLaw, Scene};

/// All bodies of a scene, and how they have moved.
#[derive(Debug)]
pub(super) struct Shadow {
    pub(super) law: ContactLaw,
    pub(super) plates: Vec<Plate>,
    pub(super) shapes: Vec<(DVec3, Shape)>,
    pub(super) bodies: Vec<Body>,
    /// What a quick look sees of each, and its radius, m.
    pub(super) glances: Vec<(Glance, f64)>,
    /// Pairs of bodies looked at.
    pub(super) looks: u64,
    /// Most pairs of bodies that a certificate may look at.
    pub(super) most_looks: u64,
    /// Spheres changed since `exact` was last looked at.
    pub(super) changed: Vec<usize>,
    /// Pairs of spheres, the lower index first, that rest on each other.
    pub(super) leans: BTreeSet<(usize, usize)>,
    /// When the run ends, s.
    pub(super) until: f64,
    /// What comes next by itself, by sphere.
    pub(super) dues: BTreeMap<usize, Due>,
    /// Whether a motion has been curved.
    pub(super) curved: bool,
    /// When (s) and where (m) a sphere was whose curved motion has changed since `exact` was last looked at.
    pub(super) checks: Vec<(f64, usize, Vector)>,
    /// Contacts that `exact` has let go and the shadow has not: sphere, with what, and when, s.
    pub(super) let_go: Vec<(usize, (Kind, usize), f64)>,
    /// Impacts whose order is told by `exact` alone.
    pub(super) ties: u64,
    /// The largest distance of `exact` from the shadow so far, m.
    pub(super) error: f64,
    /// When the error became how large.
    pub(super) growth: Growth,
}

fn shape(plate: &Plate, wall: &crate::scene::Wall) -> (DVec3, Shape) {
    let duals = plate.duals.map(Vector::value);
    (wall.shape.center, Shape::Plate { edges: [wall.shape.s1, wall.shape.s2], normal: plate.normal.value(), duals })
}

impl Shadow {
    pub(super) fn new(scene: &Scene, until: f64, most_looks: u64) -> Shadow {
        let plates: Vec<Plate> = scene.walls.iter().map(Plate::new).collect();
        let body = |sphere: &crate::scene::Sphere| {
            let mass = Double::from(sphere.mass);
            let pull = Vector::from(scene.gravity) + Vector::from(sphere.force) * (Double::ONE / mass);
            let now = Course::parabola(Double::ZERO, [sphere.x.into(), sphere.v.into(), pull]);
            let told = (0.0, sphere.x, sphere.v);
            let start = now.x;
            Body {
                mass,
                radius: sphere.radius.into(),
                start,
                before: now.clone(),
                now,
                pull,
                held: Vec::new(),
                left: Vec::new(),
                met: Vec::new(),
                open: false,
                since: 0.0,
                told,
            }
        };
        let bodies: Vec<Body> = scene.spheres.iter().map(body).collect();
        Shadow {
            law: scene.contact,
            shapes: plates.iter().zip(&scene.walls).map(|(plate, wall)| shape(plate, wall)).collect(),
            plates,
            glances: bodies.iter().map(|body| (Glance::of(&body.now), body.radius.value())).collect(),
            bodies,
            looks: 0,
            most_looks,
            changed: Vec::new(),
            leans: BTreeSet::new(),
            until,
            dues: BTreeMap::new(),
            curved: false,
            checks: Vec::new(),
            let_go: Vec::new(),
            ties: 0,
            error: 0.0,
            growth: Growth::default(),
        }
    }

    /// Follows a contact that `exact` tells.
    pub(super) fn follow(&mut self, row: &Contact) -> Result<(), Ending> {
        self.has_let_go(row)?;
        match (row.class, row.kind) {
            (Class::Leave, _) => Ok(()),
            (Class::Release, _) => self.release(row),
            (Class::Rest, kind) if self.goes_on(row.a, (kind, row.b)) => Ok(()),
            (Class::Collide | Class::Rest, Kind::Pair) => self.pair(row),
            (Class::Collide | Class::Rest, Kind::Wall) => self.wall(row),
        }
    }

    fn pair(&mut self, row: &Contact) -> Result<(), Ending> {
        self.meet_pair(row)?;
        let [one, two] = [&self.bodies[row.a], &self.bodies[row.b]];
        let normal = (one.now.x - two.now.x).unit();
        let velocities = [one.now.v, two.now.v];
        let v_n = (velocities[0] - velocities[1]).dot(normal);
        if row.class == Class::Rest {
            return self.lean(row, v_n);
        }
        self.is_impact(row, v_n)?;
        let after = law::off_each_other(&self.law, velocities, [one.mass, two.mass], normal);
        (self.bodies[row.a].now.v, self.bodies[row.b].now.v) = (after[0], after[1]);
        Ok(())
    }

    /// Lets two spheres rest on each other from here on, if they stay together as the instant ends.
    fn lean(&mut self, row: &Contact, v_n: Double) -> Result<(), Ending> {
        let pair = (row.a, row.b);
        if v_n < -Double::from(self.law.rest_speed) && !self.leans.contains(&pair) {
            return Err(ending(row, Cause::OtherClass));
        }
        self.leans.insert(pair);
        Ok(())
    }

    /// Whether a rest that `exact` tells has begun before, of a sphere that this instant has not changed.
    fn goes_on(&self, i: usize, with: (Kind, usize)) -> bool {
        let open = self.bodies[i].open || (with.0 == Kind::Pair && self.bodies[with.1].open);
        self.holds(i, with) && !open
    }

    fn wall(&mut self, row: &Contact) -> Result<(), Ending> {
        let (i, w) = (row.a, row.b);
        let (region, part) = self.meet_wall(row)?;
        let now = &self.bodies[i].now;
        let normal = part.normal(now.x);
        let v_n = now.v.dot(normal);
        if row.class == Class::Collide {
            self.is_impact(row, v_n)?;
            self.bodies[i].now.v = law::off_wall(&self.law, self.bodies[i].now.v, normal);
            return Ok(());
        }
        let held = self.bodies[i].holder(w).is_some();
        if v_n < -Double::from(self.law.rest_speed) && !held {
            return Err(ending(row, Cause::OtherClass));
        }
        if !held {
            self.bodies[i].held.push(Held { wall: w, region, part });
        }
        Ok(())
    }

    /// Lets a sphere go on from `t` (s), at which `exact` has `time` (s), where it meets something.
    pub(super) fn change(&mut self, i: usize, t: Double, time: f64, with: (Kind, usize)) {
        self.bodies[i].meet(t, with);
        self.dues.remove(&i);
        self.glances[i].0 = self.glances[i].0.unknown();
        self.bodies[i].since = time;
        if !self.changed.contains(&i) {
            self.changed.push(i);
        }
    }

    fn release(&mut self, row: &Contact) -> Result<(), Ending> {
        let (kind, a, b) = row.key();
        let open = self.bodies[a].open || (kind == Kind::Pair && self.bodies[b].open);
        if open || !self.holds(a, (kind, b)) {
            return Ok(()); // whether it lets go is found as the instant ends
        }
        self.let_go.push((a, (kind, b), row.time));
        Ok(())
    }

    /// Refuses if the shadow still holds what `exact` has let go before, of a sphere of which it now tells something else.
    fn has_let_go(&mut self, row: &Contact) -> Result<(), Ending> {
        let sides = [Some(row.a), (row.kind == Kind::Pair).then_some(row.b)];
        let found = self.let_go.iter().position(|(a, (kind, b), time)| {
            let told = sides.contains(&Some(*a)) || (*kind == Kind::Pair && sides.contains(&Some(*b)));
            told && row.time > *time
        });
        found.map_or(Ok(()), |found| self.still_holds(found))
    }

    /// Refuses if the shadow still holds what `exact` has let go.
    pub(super) fn still_holds(&mut self, found: usize) -> Result<(), Ending> {
        let (a, (kind, b), time) = self.let_go.swap_remove(found);
        if !self.holds(a, (kind, b)) {
            return Ok(());
        }
        Err(Ending { time, bodies: Some((kind, a, b)), cause: Cause::Pressed })
    }

    fn is_impact(&self, row: &Contact, v_n: Double) -> Result<(), Ending> {
        if v_n < -Double::from(self.law.rest_speed) { Ok(()) } else { Err(ending(row, Cause::OtherClass)) }
    }

    /// Holds what `exact` says of the spheres that changed, and of those in curved motion, against the shadow.
    pub(super) fn compare(&mut self, state: &State) -> Result<(), Ending> {
        let all = if self.curved { self.bodies.len() } else { 0 };
        let curved = (0..all).filter(|&i| self.bodies[i].now.bend.is_some());
        let compared: BTreeSet<usize> = self.changed.iter().copied().chain(curved).collect();
        for i in compared {
            self.differs(i, state, self.bodies[i].course(state.t.into()).at(state.t.into()))?;
            self.bodies[i].told = (state.t, state.x[i], state.v[i]);
        }
        self.changed.retain(|&i| self.bodies[i].open);
        Ok(())
    }

    /// Holds curved motions against the last frame of `exact` as the certificate ends at `until`, s, where no event of it compares them:
    /// where their pieces end, and there. False if the frame has none of that.
    pub(super) fn look(&mut self, run: &Simulation, until: f64) -> bool {
        let t = Double::from(until);
        let curved: Vec<usize> = (0..self.bodies.len()).filter(|&i| self.bodies[i].course(t).bend.is_some()).collect();
        if curved.is_empty() || until < run.time() - run.step() {
            return curved.is_empty();
        }
        let ends = std::mem::take(&mut self.checks).into_iter().filter(|check| check.0 <= until);
        let last = curved.into_iter().map(|i| (until, i, self.bodies[i].course(t).at(t)));
        for (time, i, place) in ends.chain(last).collect::<Vec<_>>() {
            let error = (Vector::from(run.at(time).x[i]) - place).length().value();
            self.growth.note(self.bodies[i].told.0.min(time), error);
            self.error = self.error.max(error);
        }
        true
    }

    /// Holds where `exact` has sphere `i` against its place in the shadow, m.
    pub(super) fn differs(&mut self, i: usize, state: &State, place: Vector) -> Result<(), Ending> {
        let body = &self.bodies[i];
        let error = (Vector::from(state.x[i]) - place).length().value();
        if error.is_nan() || error > body.radius.value() {
            return Err(Ending { time: body.now.t.value(), bodies: None, cause: Cause::Parted });
        }
        let changed = state.t.min(body.now.t.value());
        let since = body.rises(&body.before, changed, &mut self.growth);
        self.growth.note(since, error);
        self.error = self.error.max(error);
        Ok(())
    }
}

pub(super) fn ending(row: &Contact, cause: Cause) -> Ending {
    Ending { time: row.time, bodies: Some(row.key()), cause }
}
