//! The end of an instant: what holds each sphere that it has changed, alone or leaning on others, and how it moves on.

use std::collections::BTreeSet;

use super::course::Course;
use super::double::Double;
use super::ending::{Cause, Ending};
use super::shadow::Shadow;
use super::support::{self, MOST_CONTACTS, Prop, ROUNDING};
use super::vector::Vector;
use crate::physics::Kind;

/// Spheres that lean on each other, at one time.
struct Island {
    t: Double,
    bodies: Vec<usize>,
    courses: Vec<Course>,
    /// Contacts that hold the spheres: the first sphere, and the wall or the second.
    contacts: Vec<(Kind, usize, usize)>,
    props: Vec<Prop>,
}

/// Whether two vectors are equal but for rounding in what is as large as `scale`.
fn same(one: Vector, two: Vector, scale: Double) -> bool {
    (one - two).length() <= scale * Double::from(ROUNDING)
}

/// The largest length.
fn largest(vectors: &[Vector]) -> Double {
    vectors.iter().map(|u| u.length()).fold(Double::ZERO, |most, size| if size > most { size } else { most })
}

impl Shadow {
    /// Ends the instant: finds what holds each sphere that it has changed, and how it moves on.
    pub(super) fn settle(&mut self) -> Result<(), Ending> {
        let mut k = 0;
        while k < self.changed.len() {
            let i = self.changed[k];
            k += 1;
            if !self.bodies[i].open {
                continue;
            }
            let island = self.leaning(i);
            if island.iter().any(|&j| self.bodies[j].open && self.is_struck(j)) {
                continue;
            }
            self.hold(i, &island)?;
            for j in island.into_iter().filter(|&j| self.bodies[j].open).collect::<Vec<_>>() {
                self.bodies[j].open = false;
                self.clear_before(j)?;
            }
        }
        Ok(())
    }

    /// Sphere `i` and those that lean on it, in order.
    fn leaning(&self, i: usize) -> Vec<usize> {
        let (mut found, mut open) = (BTreeSet::from([i]), vec![i]);
        while let Some(j) = open.pop() {
            for &(a, b) in self.leans.iter().filter(|(a, b)| *a == j || *b == j) {
                let other = if a == j { b } else { a };
                if found.insert(other) {
                    open.push(other);
                }
            }
        }
        found.into_iter().collect()
    }

    /// Whether an impact has thrown sphere `i` against something that it touches, so that a contact with that comes next,
    /// at the same time: `exact` may tell it an ulp later.
    fn is_struck(&self, i: usize) -> bool {
        let body = &self.bodies[i];
        let speed = body.now.v.length();
        body.met.iter().any(|&with| {
            let limit = match self.holds(i, with) {
                true => Double::from(self.law.rest_speed),
                false => speed * Double::from(ROUNDING),
            };
            self.touches(i, with, body.now.t) && self.parting(i, with, body.now.t) < -limit
        })
    }

    /// Lets the contacts that hold an island take what presses on them of velocity and acceleration; those that open hold
    /// no longer.
    fn hold(&mut self, i: usize, bodies: &[usize]) -> Result<(), Ending> {
        let mut island = self.island(i, bodies)?;
        let time = island.t.value();
        let refused =
            |contacts: &[(Kind, usize, usize)], cause| Err(Ending { time, bodies: contacts.first().copied(), cause });
        if island.contacts.len() > MOST_CONTACTS {
            return refused(&island.contacts, Cause::Support);
        }
        let masses: Vec<Double> = bodies.iter().map(|&j| self.bodies[j].mass).collect();
        let v: Vec<Vector> = island.courses.iter().map(|course| course.v).collect();
        let pulls: Vec<Vector> = bodies.iter().map(|&j| self.bodies[j].pull).collect();
        let scales = [largest(&v), largest(&pulls)];
        let Some((mut v, closed)) = support::held(&v, &masses, &island.props) else {
            return refused(&island.contacts, Cause::Support);
        };
        island.keep(&closed);
        island.curve(&v, |a, b| self.bodies[a].radius + self.bodies[b].radius);
        let Some((mut a, closed)) = support::held(&pulls, &masses, &island.props) else {
            return refused(&island.contacts, Cause::Support);
        };
        island.keep(&closed);
        for (prop, contact) in island.props.iter().zip(&island.contacts) {
            let Some(other) = prop.other else { continue };
            for (u, scale) in [(&mut v, scales[0]), (&mut a, scales[1])] {
                if !same(u[prop.body], u[other], scale) {
                    return refused(&[*contact], Cause::CurvedRest);
                }
                u[other] = u[prop.body];
            }
        }
        let still = |u: &mut Vec<Vector>, scale| {
            u.iter_mut().filter(|u| same(**u, Vector::default(), scale)).for_each(|u| *u = Vector::default());
        };
        if !island.props.is_empty() {
            still(&mut v, scales[0]);
            still(&mut a, scales[1]);
        }
        self.go_on(&island, &v, &a, scales)
    }

    /// The island of spheres that lean on each other: where they are when sphere `i` is, and what they touch.
    fn island(&self, i: usize, bodies: &[usize]) -> Result<Island, Ending> {
        let t = self.bodies[i].now.t;
        if let Some(&j) =
            bodies.iter().find(|&&j| self.bodies[j].now.t > t && !self.at_one_time(self.bodies[j].now.t, t))
        {
            let cause = Cause::OtherOrder;
            return Err(Ending { time: t.value(), bodies: Some((Kind::Pair, i.min(j), i.max(j))), cause });
        }
        let courses: Vec<Course> = bodies.iter().map(|&j| self.bodies[j].now.from(t)).collect();
        let (mut contacts, mut props) = (Vec::new(), Vec::new());
        let mut add = |contact, body, other, normal| {
            contacts.push(contact);
            props.push(Prop { body, other, normal, bias: Double::ZERO });
        };
        for (k, &j) in bodies.iter().enumerate() {
            let x = courses[k].x;
            for &w in &self.bodies[j].held {
                add((Kind::Wall, j, w), k, None, self.plates[w].closest(x).1.normal(x));
            }
            for &(_, b) in self.leans.iter().filter(|lean| lean.0 == j) {
                let Some(other) = bodies.iter().position(|&body| body == b) else { continue };
                add((Kind::Pair, j, b), k, Some(other), (x - courses[other].x).unit());
            }
        }
        Ok(Island { t, bodies: bodies.to_vec(), courses, contacts, props })
    }

    /// Lets the spheres of an island move on with velocities `v` (m/s) and accelerations `a` (m/s²), which were as large as
    /// `scales` before.
    fn go_on(&mut self, island: &Island, v: &[Vector], a: &[Vector], scales: [Double; 2]) -> Result<(), Ending> {
        for (k, &j) in island.bodies.iter().enumerate() {
            let course = &island.courses[k];
            let moves_on = !self.bodies[j].open && same(course.v, v[k], scales[0]) && same(course.a, a[k], scales[1]);
            if !moves_on && !self.bodies[j].open {
                let lean = self.leans.iter().find(|(a, b)| *a == j || *b == j);
                let with = lean.map_or(j, |&(a, b)| if a == j { b } else { a });
                let also = self.clear_until(j, island.t, Some((Kind::Pair, with)))?;
                self.change(j, island.t, island.t.value(), (Kind::Pair, with));
                self.bodies[j].met.extend(also);
            }
            if !moves_on {
                (self.bodies[j].now.v, self.bodies[j].now.a) = (v[k], a[k]);
            }
            let holds = |w: &usize| island.contacts.contains(&(Kind::Wall, j, *w));
            self.bodies[j].held.retain(holds);
        }
        let opened =
            |(a, b): &(usize, usize)| island.bodies.contains(a) && !island.contacts.contains(&(Kind::Pair, *a, *b));
        self.leans.retain(|lean| !opened(lean));
        Ok(())
    }
}

impl Island {
    /// Keeps the contacts that stay closed, and no other.
    fn keep(&mut self, closed: &[bool]) {
        let (mut contacts, mut props) = (closed.iter(), closed.iter());
        self.contacts.retain(|_| contacts.next() == Some(&true));
        self.props.retain(|_| props.next() == Some(&true));
    }

    /// Adds the acceleration at which spheres that move across each other's normal part by themselves: v²/R, where R (m) is
    /// the sum of two radii.
    fn curve(&mut self, v: &[Vector], reach: impl Fn(usize, usize) -> Double) {
        for prop in &mut self.props {
            let Some(other) = prop.other else { continue };
            let across = (v[prop.body] - v[other]).across(prop.normal);
            let bodies = [prop.body, other].map(|k| self.bodies[k]);
            prop.bias = across.dot(across) / reach(bodies[0], bodies[1]);
        }
    }
}
