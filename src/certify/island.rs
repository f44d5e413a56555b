//! The end of an instant: what holds each sphere that it has changed, alone or leaning on others, and how it moves on.

use std::collections::BTreeSet;

use super::bend::{self, Bodies, Series, Tie};
use super::body::Held;
use super::course::Course;
use super::ending::{Cause, Ending};
use super::glance::Glance;
use super::shadow::Shadow;
use super::support::{self, MOST_CONTACTS, Prop, ROUNDING};
use super::vector::Vector;
use crate::double::Double;
use crate::physics::Kind;

/// As how many looks at pairs of bodies a contact in a series counts: it takes as long.
const SERIES: u64 = 5000;

/// Spheres that lean on each other, at one time.
pub(super) struct Island {
    pub(super) t: Double,
    pub(super) bodies: Vec<usize>,
    courses: Vec<Course>,
    /// What holds them: the first sphere, and the wall or the second.
    pub(super) contacts: Vec<(Kind, usize, usize)>,
    props: Vec<Prop>,
    pub(super) ties: Vec<Tie>,
    /// By contact, whether it pushes.
    pub(super) pushes: Vec<bool>,
}

/// How the spheres of an island move on, by sphere.
pub(super) struct Motion {
    v: Vec<Vector>,
    a: Vec<Vector>,
    /// Where contacts turn, the series.
    pub(super) series: Option<Series>,
    /// How long it holds, s.
    pub(super) length: f64,
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
        self.looks += 2 * support::looks(island.contacts.len()); // of velocities, and of accelerations
        let masses: Vec<Double> = bodies.iter().map(|&j| self.bodies[j].mass).collect();
        let v: Vec<Vector> = island.courses.iter().map(|course| course.v).collect();
        let pulls: Vec<Vector> = bodies.iter().map(|&j| self.bodies[j].pull).collect();
        let scales = [largest(&v), largest(&pulls)];
        let Some(kept) = support::held(&v, &masses, &island.props) else {
            return refused(&island.contacts, Cause::Support);
        };
        island.keep(&kept.closed);
        let mut v = kept.left;
        island.curve(&v, |a| self.bodies[a].radius);
        let Some(kept) = support::held(&pulls, &masses, &island.props) else {
            return refused(&island.contacts, Cause::Support);
        };
        let mut a = kept.left;
        island.pushes = kept.pushes;
        island.keep(&kept.closed);
        if let Some(turning) = island.turning([&v, &a], scales) {
            self.looks += SERIES * island.contacts.len() as u64 + support::looks(island.contacts.len());
            let motion = island.bend(v, &pulls, &masses).and_then(|series| {
                let radius = bodies.iter().map(|&j| self.bodies[j].radius.value()).fold(f64::INFINITY, f64::min);
                let length = series.length(radius, self.until - time)?;
                Some(Motion { v: Vec::new(), a: Vec::new(), series: Some(series), length })
            });
            let Some(motion) = motion else { return refused(&[turning], Cause::CurvedRest) };
            return self.go_on(&island, &motion, scales);
        }
        for prop in &island.props {
            let Some(other) = prop.other else { continue };
            (v[other], a[other]) = (v[prop.body], a[prop.body]);
        }
        let still = |u: &mut Vec<Vector>, scale| {
            u.iter_mut().filter(|u| same(**u, Vector::default(), scale)).for_each(|u| *u = Vector::default());
        };
        if !island.props.is_empty() {
            still(&mut v, scales[0]);
            still(&mut a, scales[1]);
        }
        self.go_on(&island, &Motion { v, a, series: None, length: f64::INFINITY }, scales)
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
        let (mut contacts, mut props, mut ties) = (Vec::new(), Vec::new(), Vec::new());
        let mut add = |contact, tie: Tie, normal| {
            contacts.push(contact);
            props.push(Prop { body: tie.body, other: tie.other, normal, bias: Double::ZERO });
            ties.push(tie);
        };
        for (k, &j) in bodies.iter().enumerate() {
            let x = courses[k].x;
            for held in &self.bodies[j].held {
                let tie = Tie { body: k, other: None, part: Some(held.part) };
                add((Kind::Wall, j, held.wall), tie, held.part.normal(x));
            }
            for &(_, b) in self.leans.iter().filter(|lean| lean.0 == j) {
                let Some(other) = bodies.iter().position(|&body| body == b) else { continue };
                let tie = Tie { body: k, other: Some(other), part: None };
                add((Kind::Pair, j, b), tie, (x - courses[other].x).unit());
            }
        }
        let pushes = vec![false; contacts.len()];
        Ok(Island { t, bodies: bodies.to_vec(), courses, contacts, props, ties, pushes })
    }

    /// The spheres of an island move on; their velocities (m/s) and accelerations (m/s²) were as large as `scales` before.
    fn go_on(&mut self, island: &Island, motion: &Motion, scales: [Double; 2]) -> Result<(), Ending> {
        for (k, &j) in island.bodies.iter().enumerate() {
            let course = &island.courses[k];
            let moves_on = !self.bodies[j].open
                && motion.series.is_none()
                && self.bodies[j].now.bend.is_none()
                && same(course.v, motion.v[k], scales[0])
                && same(course.a, motion.a[k], scales[1]);
            if !moves_on && !self.bodies[j].open {
                let lean = self.leans.iter().find(|(a, b)| *a == j || *b == j);
                let with = lean.map_or(j, |&(a, b)| if a == j { b } else { a });
                let also = self.clear_until(j, island.t, Some((Kind::Pair, with)))?;
                self.change(j, island.t, island.t.value(), (Kind::Pair, with));
                self.bodies[j].met.extend(also);
            }
            if !moves_on {
                let now = &mut self.bodies[j].now;
                *now = motion.course(k, now);
                self.glances[j].0 = Glance::of(now);
            }
            let holds = |held: &Held| island.contacts.contains(&(Kind::Wall, j, held.wall));
            let gone = self.bodies[j].held.extract_if(.., |held| !holds(held)).filter(Held::is_round);
            let gone: Vec<Held> = gone.collect();
            self.bodies[j].left.extend(gone);
        }
        let opened =
            |(a, b): &(usize, usize)| island.bodies.contains(a) && !island.contacts.contains(&(Kind::Pair, *a, *b));
        self.leans.retain(|lean| !opened(lean));
        self.plan(island, motion)
    }
}

impl Motion {
    /// How sphere `k` of the island moves on from where it is `now`.
    fn course(&self, k: usize, now: &Course) -> Course {
        let Some(series) = &self.series else { return Course::parabola(now.t, [now.x, self.v[k], self.a[k]]) };
        let terms = &series.places[k];
        Course { t: now.t, x: now.x, v: terms[1], a: terms[2] * Double::from(2.0), bend: Some(terms[3..].into()) }
    }
}

impl Island {
    /// Keeps the contacts that stay closed, and no other.
    fn keep(&mut self, closed: &[bool]) {
        let mut kept = closed.iter().copied().chain(std::iter::repeat(false));
        let pushes = std::mem::take(&mut self.pushes);
        let all = std::mem::take(&mut self.contacts).into_iter().zip(std::mem::take(&mut self.props));
        for ((contact, prop), (tie, push)) in all.zip(std::mem::take(&mut self.ties).into_iter().zip(pushes)) {
            if kept.next() == Some(true) {
                self.contacts.push(contact);
                self.props.push(prop);
                self.ties.push(tie);
                self.pushes.push(push);
            }
        }
    }

    /// What moves across the normal of something round parts from it by itself: v²/R, where R (m) is a radius, or the sum of two.
    fn curve(&mut self, v: &[Vector], radius: impl Fn(usize) -> Double) {
        for (prop, tie) in self.props.iter_mut().zip(&self.ties) {
            let reach = [Some(prop.body), prop.other].into_iter().flatten().map(|k| radius(self.bodies[k]));
            prop.bias = tie.parting(prop.normal, v) / reach.fold(Double::ZERO, |sum, radius| sum + radius);
        }
    }

    /// The first contact whose normal turns.
    fn turning(&self, [v, a]: [&[Vector]; 2], scales: [Double; 2]) -> Option<(Kind, usize, usize)> {
        let small = scales.map(|scale| scale * Double::from(ROUNDING));
        let turns = |(prop, tie): (&Prop, &Tie)| tie.turns(prop.normal, [v, a], small);
        let found = self.props.iter().zip(&self.ties).position(turns)?;
        Some(self.contacts[found])
    }

    /// The motion of spheres that move with `v` (m/s); none where it is not clear which contacts hold.
    fn bend(&self, v: Vec<Vector>, pulls: &[Vector], masses: &[Double]) -> Option<Series> {
        let places: Vec<Vector> = self.courses.iter().map(|course| course.x).collect();
        let ties: Vec<Tie> = self.pushing().map(|k| self.ties[k]).collect();
        bend::series(Bodies { places: &places, velocities: &v, pulls, masses }, &ties)
    }

    /// The contacts that push.
    pub(super) fn pushing(&self) -> impl Iterator<Item = usize> {
        (0..self.contacts.len()).filter(|&k| self.pushes[k])
    }
}
