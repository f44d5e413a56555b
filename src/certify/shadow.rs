//! The shadow run: it is told which bodies `exact` has brought together, and finds the rest by itself.

use glam::DVec3;

use super::body::Body;
use super::clear::Shape;
use super::course::Course;
use super::double::Double;
use super::ending::{Cause, Ending};
use super::growth::Growth;
use super::law;
use super::obstacle::{Part, Plate};
use super::start::{AT_LOAD, Start};
use super::support;
use super::touching::touching;
use super::vector::Vector;
use crate::physics::{Class, Contact, Kind, State};
use crate::scene::{ContactLaw, Scene};

/// Part of a time that passes between events of one instant in `exact`: an ulp or two, of which this is some thirty.
const SAME_TIME: f64 = 1e-14;

/// All bodies of a scene, and how they have moved.
#[derive(Debug)]
pub(super) struct Shadow {
    pub(super) law: ContactLaw,
    pub(super) plates: Vec<Plate>,
    pub(super) shapes: Vec<(DVec3, Shape)>,
    pub(super) bodies: Vec<Body>,
    /// Pairs of bodies looked at.
    pub(super) looks: u64,
    /// How many of them a certificate may take.
    pub(super) most_looks: u64,
    /// Spheres changed since `exact` was last looked at.
    changed: Vec<usize>,
    /// The largest distance of `exact` from the shadow so far, m.
    pub(super) error: f64,
    /// When it became how large.
    pub(super) growth: Growth,
}

fn shape(plate: &Plate, wall: &crate::scene::Wall) -> (DVec3, Shape) {
    let duals = plate.duals.map(Vector::value);
    (wall.shape.center, Shape::Plate { edges: [wall.shape.s1, wall.shape.s2], normal: plate.normal.value(), duals })
}

impl Shadow {
    pub(super) fn new(scene: &Scene, most_looks: u64) -> Shadow {
        let plates: Vec<Plate> = scene.walls.iter().map(Plate::new).collect();
        let body = |sphere: &crate::scene::Sphere| {
            let mass = Double::from(sphere.mass);
            let pull = Vector::from(scene.gravity) + Vector::from(sphere.force) * (Double::ONE / mass);
            let now = Course { t: Double::ZERO, x: sphere.x.into(), v: sphere.v.into(), a: pull };
            let told = (0.0, sphere.x, sphere.v);
            let (held, met, open) = (Vec::new(), Vec::new(), false);
            Body { mass, radius: sphere.radius.into(), now, before: now, pull, held, met, open, since: 0.0, told }
        };
        Shadow {
            law: scene.contact,
            shapes: plates.iter().zip(&scene.walls).map(|(plate, wall)| shape(plate, wall)).collect(),
            plates,
            bodies: scene.spheres.iter().map(body).collect(),
            looks: 0,
            most_looks,
            changed: Vec::new(),
            error: 0.0,
            growth: Growth::default(),
        }
    }

    /// A contact that `exact` tells.
    pub(super) fn follow(&mut self, row: &Contact) -> Result<(), Ending> {
        match (row.class, row.kind) {
            (Class::Leave, _) => Ok(()),
            (Class::Release, Kind::Wall) => self.release(row),
            (Class::Rest | Class::Release, Kind::Pair) => Err(ending(row, Cause::CurvedRest)),
            (Class::Collide, Kind::Pair) => self.pair(row),
            (Class::Collide | Class::Rest, Kind::Wall) => self.wall(row),
        }
    }

    fn pair(&mut self, row: &Contact) -> Result<(), Ending> {
        let (a, b) = (row.a, row.b);
        if self.bodies[a].open || self.bodies[b].open {
            return Err(ending(row, Cause::Simultaneous));
        }
        let reach = self.bodies[a].radius + self.bodies[b].radius;
        let [one, two] = [a, b].map(|i| self.bodies[i].now);
        let since = if one.t < two.t { two.t } else { one.t };
        let relative = one.relative(&two, since);
        let met = touching(&relative, &Part::Point(Vector::default()), reach, row.time);
        let t = met.ok_or_else(|| ending(row, Cause::NoContact))?;
        self.in_order(row, t, since)?;
        self.clear_until(a, t, Some((Kind::Pair, b)))?;
        self.clear_until(b, t, Some((Kind::Pair, a)))?;
        self.change(a, t, row.time, (Kind::Pair, b));
        self.change(b, t, row.time, (Kind::Pair, a));
        let [one, two] = [&self.bodies[a], &self.bodies[b]];
        let normal = (one.now.x - two.now.x).unit();
        let velocities = [one.now.v, two.now.v];
        let v_n = (velocities[0] - velocities[1]).dot(normal);
        self.is_impact(row, v_n)?;
        let after = law::off_each_other(&self.law, velocities, [one.mass, two.mass], normal);
        (self.bodies[a].now.v, self.bodies[b].now.v) = (after[0], after[1]);
        Ok(())
    }

    fn wall(&mut self, row: &Contact) -> Result<(), Ending> {
        let (i, w) = (row.a, row.b);
        let part = self.meet_wall(row)?;
        let now = self.bodies[i].now;
        let normal = part.normal(now.x);
        let v_n = now.v.dot(normal);
        if row.class == Class::Collide {
            self.is_impact(row, v_n)?;
            self.bodies[i].now.v = law::off_wall(&self.law, now.v, normal);
            return Ok(());
        }
        if v_n < -Double::from(self.law.rest_speed) && !self.bodies[i].held.contains(&w) {
            return Err(ending(row, Cause::OtherClass));
        }
        if !matches!(part, Part::Plane(..)) {
            return Err(ending(row, Cause::CurvedRest));
        }
        if !self.bodies[i].held.contains(&w) {
            self.bodies[i].held.push(w);
        }
        Ok(())
    }

    /// Brings a sphere to a wall, unless it is in touch with it; the part of the wall that it touches.
    fn meet_wall(&mut self, row: &Contact) -> Result<Part, Ending> {
        let (i, w) = (row.a, row.b);
        let (contact, body) = ((Kind::Wall, w), &self.bodies[i]);
        let (now, radius) = (body.now, body.radius);
        let holds = body.held.contains(&w);
        let at_load = row.time == 0.0 && {
            let part = self.plates[w].closest(now.x).1;
            (part.arm(now.x).length() - radius).value().abs() <= AT_LOAD * radius.value()
        };
        let glided = || Start::of(&body.before, &self.plates[w], radius) == Start::Glides;
        if at_load || (body.open && (holds || body.met.contains(&contact) || glided())) {
            if row.time > body.since * (1.0 + SAME_TIME) {
                return Err(ending(row, Cause::OtherOrder));
            }
            self.change(i, now.t, row.time, contact);
            return Ok(self.plates[w].closest(now.x).1);
        }
        if holds {
            return Err(ending(row, Cause::OtherClass));
        }
        if body.open {
            return Err(ending(row, Cause::Simultaneous));
        }
        let mut found = (Double::from(row.time), self.plates[w].closest(now.at(row.time.into())));
        for _ in 0..2 {
            let (_, (region, part)) = found;
            let t = touching(&now, &part, radius, row.time).ok_or_else(|| ending(row, Cause::NoContact))?;
            found = (t, self.plates[w].closest(now.at(t)));
            if found.1.0 == region {
                self.in_order(row, t, now.t)?;
                self.clear_until(i, t, Some(contact))?;
                self.change(i, t, row.time, contact);
                return Ok(part);
            }
        }
        Err(ending(row, Cause::NoContact))
    }

    /// A sphere goes on from `t` (s), at which `exact` has `time`, where it meets something.
    fn change(&mut self, i: usize, t: Double, time: f64, with: (Kind, usize)) {
        self.bodies[i].meet(t, with);
        self.bodies[i].since = time;
        if !self.changed.contains(&i) {
            self.changed.push(i);
        }
    }

    fn release(&mut self, row: &Contact) -> Result<(), Ending> {
        let body = &self.bodies[row.a];
        if !body.held.contains(&row.b) {
            return Ok(());
        }
        if body.open {
            return Ok(()); // whether it lets go is found when the sphere is settled
        }
        self.clear_until(row.a, row.time.into(), None)?;
        Err(ending(row, Cause::Pressed))
    }

    fn is_impact(&self, row: &Contact, v_n: Double) -> Result<(), Ending> {
        if v_n < -Double::from(self.law.rest_speed) { Ok(()) } else { Err(ending(row, Cause::OtherClass)) }
    }

    /// Refuses a contact at `t` (s) of spheres that have moved as they do only since `since` (s).
    fn in_order(&self, row: &Contact, t: Double, since: Double) -> Result<(), Ending> {
        if t > since { Ok(()) } else { Err(ending(row, Cause::OtherOrder)) }
    }

    /// The instant is over: what holds each sphere that it has changed, and how it moves on.
    pub(super) fn settle(&mut self) -> Result<(), Ending> {
        for k in 0..self.changed.len() {
            let i = self.changed[k];
            if self.bodies[i].open && !self.is_struck(i) {
                self.hold(i)?;
                self.bodies[i].open = false;
                self.clear_before(i)?;
            }
        }
        Ok(())
    }

    /// Whether an impact has thrown sphere `i` against a face that held it, so that an impact with that comes next, at the same
    /// time: `exact` may tell it an ulp later.
    fn is_struck(&self, i: usize) -> bool {
        let body = &self.bodies[i];
        let v_n = |w: &usize| body.now.v.dot(self.plates[*w].closest(body.now.x).1.normal(body.now.x));
        body.held.iter().any(|w| v_n(w) < -Double::from(self.law.rest_speed))
    }

    /// Faces take what presses on them of velocity and acceleration; those that open hold no longer.
    fn hold(&mut self, i: usize) -> Result<(), Ending> {
        let Shadow { bodies, plates, .. } = self;
        let body = &mut bodies[i];
        let refused = |cause| Ending { time: body.now.t.value(), bodies: Some((Kind::Wall, i, body.held[0])), cause };
        let mut held = body.held.clone();
        if held.len() > support::MOST_FACES {
            return Err(refused(Cause::Support));
        }
        let x = body.now.x;
        let normals =
            |held: &[usize]| -> Vec<Vector> { held.iter().map(|&w| plates[w].closest(x).1.normal(x)).collect() };
        let mut motion = [body.now.v, body.pull];
        for u in &mut motion {
            let (left, closed) = support::held(*u, &normals(&held)).ok_or_else(|| refused(Cause::Support))?;
            *u = left;
            let mut closed = closed.into_iter();
            held.retain(|_| closed.next() == Some(true));
        }
        (body.now.v, body.now.a) = (motion[0], motion[1]);
        body.held = held;
        Ok(())
    }

    /// Holds what `exact` says of the spheres that changed against the shadow.
    pub(super) fn compare(&mut self, state: &State) -> Result<(), Ending> {
        for &i in &self.changed {
            let body = &mut self.bodies[i];
            let t = Double::from(state.t);
            let error = (Vector::from(state.x[i]) - body.course(t).at(t)).length().value();
            if error.is_nan() || error > body.radius.value() {
                return Err(Ending { time: body.now.t.value(), bodies: None, cause: Cause::Parted });
            }
            self.growth.note(body.told.0, error);
            body.told = (state.t, state.x[i], state.v[i]);
            self.error = self.error.max(error);
        }
        self.changed.retain(|&i| self.bodies[i].open);
        Ok(())
    }
}

fn ending(row: &Contact, cause: Cause) -> Ending {
    Ending { time: row.time, bodies: Some(row.key()), cause }
}
