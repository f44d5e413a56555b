//! The proof that a sphere touches nothing between two events of its own: every other sphere and every wall, one by one.

use super::clear::{Shape, Way, doubt, leaves_strip};
use super::course::Course;
use super::double::Double;
use super::ending::{Cause, Ending};
use super::shadow::Shadow;
use super::start::{Start, overlap};
use super::support;
use crate::physics::Kind;

/// Pairs of bodies that are looked at without asking whether to go on, at most: some seconds.
const MOST_AT_ONCE: u64 = 100_000_000;

/// Part of a reach within which it is worth asking whether spheres that touch part: planes show it of all others.
const NEARLY: f64 = 1e-6;

/// Part of a distance that the quick look gives away for rounding.
const ROUNDING: f64 = 1e-12;

fn later(one: Double, two: Double) -> Double {
    if one < two { two } else { one }
}

/// The way of `course` from its beginning to `t`, s.
fn way(course: &Course, t: Double, radius: f64, end: bool) -> Way {
    let (x, v, a) = (course.x.value(), course.v.value(), course.a.value());
    Way { x, v, a, length: (t - course.t).value(), overlap: overlap(course.t, radius), lifts: false, end }
}

/// Whether the quick look shows that a body that begins so far away (m) does not come within `radius` (m).
fn is_far(way: &Way, radius: f64) -> bool {
    let moves = (way.v.length() + 0.5 * way.a.length() * way.length) * way.length;
    way.x.length() * (1.0 - ROUNDING) > radius + moves * (1.0 + ROUNDING)
}

impl Shadow {
    /// What else sphere `i` touches at `t` (s) besides `met`; refuses if it may touch anything before, from its last event
    /// on.
    pub(super) fn clear_until(
        &mut self,
        i: usize,
        t: Double,
        met: Option<(Kind, usize)>,
    ) -> Result<Vec<(Kind, usize)>, Ending> {
        self.looks += (self.bodies.len() + self.plates.len()) as u64;
        if self.looks > self.most_looks {
            return Err(Ending { time: self.bodies[i].now.t.value(), bodies: None, cause: Cause::Spent });
        }
        let (mut first, mut also) = (None, Vec::new());
        let walls = (0..self.plates.len()).map(|w| (Kind::Wall, w));
        let pairs = (0..self.bodies.len()).filter(|&j| j != i).map(|j| (Kind::Pair, j));
        for with in walls.chain(pairs) {
            let doubt = |ends: bool| match with {
                (Kind::Wall, w) => self.wall_doubt(i, w, t, ends),
                (Kind::Pair, j) => self.pair_doubt([(i, &self.bodies[i].now), (j, &self.bodies[j].now)], t, ends),
            };
            let Some(found) = doubt(met == Some(with)) else { continue };
            if met != Some(with) && met.is_some() && self.touches(i, with, t) && doubt(true).is_none() {
                also.push(with);
            } else {
                first = Some(first.map_or(found.clone(), |first| earlier(first, found)));
            }
        }
        first.map_or(Ok(also), Err)
    }

    /// Refuses if sphere `i`, as it moves on, may touch another one that changed later than `i` did, before that change.
    pub(super) fn clear_before(&mut self, i: usize) -> Result<(), Ending> {
        let one = &self.bodies[i];
        for (j, other) in self.bodies.iter().enumerate() {
            if j == i || other.now.t <= one.now.t {
                continue;
            }
            let bodies = Some((Kind::Pair, i.min(j), i.max(j)));
            if other.before.t > one.now.t {
                return Err(Ending { time: one.now.t.value(), bodies, cause: Cause::OtherOrder });
            }
            let met = one.met.contains(&(Kind::Pair, j));
            if let Some(refusal) = self.pair_doubt([(i, &one.now), (j, &other.before)], other.now.t, met) {
                return Err(refusal);
            }
        }
        Ok(())
    }

    /// Whether there are more bodies than can be looked at pair by pair.
    pub(super) fn is_too_large(&self) -> bool {
        let (spheres, walls) = (self.bodies.len() as u64, self.plates.len() as u64);
        spheres * (spheres + walls) > MOST_AT_ONCE
    }

    /// The first time at which something may touch before `t` (s), all spheres moving on as they do.
    pub(super) fn first_doubt(&self, t: Double) -> Option<Ending> {
        let count = self.bodies.len();
        let walls = (0..count).flat_map(|i| (0..self.plates.len()).map(move |w| (i, w)));
        let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
        let course = |i: usize| (i, &self.bodies[i].now);
        let walls = walls.filter_map(|(i, w)| self.wall_doubt(i, w, t, false));
        walls.chain(pairs.filter_map(|(i, j)| self.pair_doubt([course(i), course(j)], t, false))).reduce(earlier)
    }

    fn pair_doubt(&self, [(i, one), (j, two)]: [(usize, &Course); 2], t: Double, met: bool) -> Option<Ending> {
        let since = later(one.t, two.t);
        if t <= since {
            return None;
        }
        let radius = (self.bodies[i].radius + self.bodies[j].radius).value();
        if is_apart([one, two], t.value(), radius) {
            return None;
        }
        let relative = one.relative(two, since);
        let way = way(&relative, t, radius, met);
        let in_touch = || (way.x.length() - radius).abs() <= NEARLY * radius;
        if is_far(&way, radius) || (in_touch() && self.parts([(i, one), (j, two)], &relative, way.overlap)) {
            return None;
        }
        let after = doubt(&way, &Shape::Point, radius)?;
        let bodies = Some((Kind::Pair, i.min(j), i.max(j)));
        Some(Ending { time: since.value() + after, bodies, cause: Cause::Touching })
    }

    /// Whether two spheres, `relative` to each other, touch no more than by `overlap` (m) and come no closer: without
    /// acceleration, and not approaching as it begins.
    fn parts(&self, [(i, one), (j, two)]: [(usize, &Course); 2], relative: &Course, overlap: f64) -> bool {
        let small = Double::from(support::ROUNDING);
        let at = |course: &Course| course.velocity(relative.t).length();
        let speed = small * (at(one) + at(two));
        let gap = (relative.x.length() - self.bodies[i].radius - self.bodies[j].radius).value();
        relative.a.length() <= small * (one.a.length() + two.a.length())
            && gap >= -overlap
            && (relative.v.length() <= speed || relative.x.unit().dot(relative.v) >= -speed)
    }

    fn wall_doubt(&self, i: usize, w: usize, t: Double, met: bool) -> Option<Ending> {
        let body = &self.bodies[i];
        if t <= body.now.t {
            return None;
        }
        let radius = body.radius.value();
        let course = Course { x: body.now.x - self.plates[w].center, ..body.now };
        let mut way = way(&course, t, radius, met);
        let start = Start::of(&body.now, &self.plates[w], body.radius);
        way.lifts = start == Start::Lifts;
        let bodies = Some((Kind::Wall, i, w));
        let at = |after: f64, cause| Ending { time: body.now.t.value() + after, bodies, cause };
        if start == Start::Glides || body.held.contains(&w) {
            let leaves = |k: usize| {
                let dual = self.plates[w].duals[k].value();
                leaves_strip([dual.dot(way.x), dual.dot(way.v), 0.5 * dual.dot(way.a)], way.length)
            };
            let after = [leaves(0), leaves(1)].into_iter().flatten().reduce(f64::min);
            return after.map(|after| at(after, Cause::RollsOver));
        }
        doubt(&way, &self.shapes[w].1, radius).map(|after| at(after, Cause::Touching))
    }
}

fn earlier(one: Ending, two: Ending) -> Ending {
    if two.time < one.time { two } else { one }
}

/// Whether two spheres stay farther apart than `radius` (m) up to `t` (s), by a look that takes no more than `f64`.
fn is_apart([one, two]: [&Course; 2], t: f64, radius: f64) -> bool {
    let moves = |course: &Course| {
        let h = t - course.t.value();
        (course.v.value().length() + 0.5 * course.a.value().length() * h) * h
    };
    let (x, y) = (one.x.value(), two.x.value());
    let size = x.abs().max_element() + y.abs().max_element();
    (x - y).length() > (radius + moves(one) + moves(two) + size * ROUNDING) * (1.0 + ROUNDING)
}
