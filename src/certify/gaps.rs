//! The proof that a sphere touches nothing between two events of its own: every other sphere and every wall, one by one.

use super::body::Held;
use super::clear::{Shape, Way, doubt};
use super::course::Course;
use super::ending::{Cause, Ending};
use super::glance::{Glance, ROUNDING};
use super::obstacle::Part;
use super::polynomial::above;
use super::shadow::Shadow;
use super::start::{AT_LOAD, Start, overlap};
use super::support;
use super::vector::Vector;
use crate::double::Double;
use crate::physics::Kind;

/// Pairs of bodies that are looked at without asking whether to go on, at most: some seconds.
const MOST_AT_ONCE: u64 = 100_000_000;

/// Part of a reach within which it is worth asking whether spheres that touch part: planes show it of all others.
const NEARLY: f64 = 1e-6;

fn later(one: Double, two: Double) -> Double {
    if one < two { two } else { one }
}

/// How far (radii) a piece of a curved path may be from its parabola.
const DEPARTURE: f64 = 1e-6;

/// Most pieces of a curved path.
const MOST_PIECES: u32 = 1 << 20;

/// The time in which bodies are looked at.
struct Span {
    from: Double,
    /// s
    length: f64,
    /// What their distance is held against, m.
    radius: f64,
    start: Start,
    /// Whether they touch as it ends.
    end: bool,
}

/// Whether the quick look shows that a body that begins so far away (m) does not come within `radius` (m).
fn is_far(way: &Way, radius: f64) -> bool {
    let moves = (way.v.length() + 0.5 * way.a.length() * way.length + way.sway) * way.length;
    way.x.length() * (1.0 - ROUNDING) > radius + moves * (1.0 + ROUNDING)
}

impl Span {
    /// The whole of it, of a motion that begins so and is a parabola.
    fn way(&self, [x, v, a]: [Vector; 3]) -> Way {
        let (x, v, a) = (x.value(), v.value(), a.value());
        Way { x, v, a, length: self.length, overlap: 0.0, lifts: false, end: false, sway: 0.0 }
    }

    /// The time (s) after the beginning up to which it is shown that a motion, by its place, velocity and acceleration at a time, which
    /// change by no more than `jerk` (m/s³), stays clear of `shape`; none if it is for the whole span.
    fn doubt(&self, motion: impl Fn(Double) -> [Vector; 3], jerk: f64, shape: &Shape) -> Option<f64> {
        let mut count = 1_u32;
        let width = |count: u32| self.length / f64::from(count);
        while jerk * width(count) * width(count) * width(count) > 6.0 * DEPARTURE * self.radius {
            count *= 2;
            if count > MOST_PIECES {
                return Some(0.0);
            }
        }
        let length = width(count);
        (0..count).find_map(|k| {
            let (from, end) = (length * f64::from(k), self.end && k + 1 == count);
            let back = if end && jerk > 0.0 { length } else { 0.0 };
            let [x, v, a] = motion(self.from + Double::from(from + back)).map(Vector::value);
            let (x, v) = (x - (v - a * (0.5 * back)) * back, v - a * back);
            let overlap = if k == 0 { overlap(self.from, self.radius) } else { 0.0 };
            let lifts = k == 0 && self.start == Start::Lifts;
            let way = Way { x, v, a, length, overlap, lifts, end, sway: jerk * length * length / 6.0 };
            if matches!(shape, Shape::Point) && is_far(&way, self.radius) {
                return None;
            }
            doubt(&way, shape, self.radius).map(|after| from + after)
        })
    }

    /// The rest of the span, from `after` (s) on.
    fn later(self, after: f64) -> Span {
        let from = self.from + Double::from(after);
        Span { from, length: self.length - after, start: Start::Open, ..self }
    }
}

/// How |Σ yₖ tᵏ|² changes, as coefficients of t⁰, t¹, …
fn rise(y: &[Vector]) -> Vec<Double> {
    let mut terms: Vec<Double> = (0..2 * y.len() - 1)
        .map(|k| {
            let pairs = (k.saturating_sub(y.len() - 1)..=k.min(y.len() - 1)).map(|j| y[j].dot(y[k - j]));
            pairs.fold(Double::ZERO, |sum, product| sum + product)
        })
        .collect();
    terms[0] = Double::ZERO;
    terms
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
        let (glance, time, radius) = (Glance::of(&self.bodies[i].now), t.value(), self.bodies[i].radius.value());
        let near = |j: &usize| {
            let (other, its) = &self.glances[*j];
            *j != i && !other.is_apart(&glance, time, radius + its)
        };
        let pairs = (0..self.bodies.len()).filter(near).map(|j| (Kind::Pair, j));
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
        let reach = self.bodies[i].radius + self.bodies[j].radius;
        let radius = reach.value();
        if Glance::of(one).is_apart(&Glance::of(two), t.value(), radius) {
            return None;
        }
        let relative = one.relative(two, since);
        let (lean, bent) = ((i.min(j), i.max(j)), one.bend.is_some() || two.bend.is_some());
        if bent && self.leans.contains(&lean) {
            return None;
        }
        let span = Span { from: since, length: (t - since).value(), radius, start: Start::Open, end: met };
        if !bent && is_far(&span.way(relative.state(since)), radius) {
            return None;
        }
        let in_touch = (relative.x.value().length() - radius).abs() <= NEARLY * radius;
        let overlap = overlap(since, radius);
        if in_touch && !bent && self.parts([(i, one), (j, two)], &relative, overlap) {
            return None;
        }
        let motion = |t: Double| {
            if !bent {
                return relative.state(t);
            }
            let [[x, v, a], [y, w, b]] = [one, two].map(|course| course.state(t));
            [x - y, v - w, a - b]
        };
        let jerk = [one, two].map(|course| course.jerk((t - course.t).value())).iter().sum();
        let found = span.doubt(motion, jerk, &Shape::Point)?;
        let bodies = Some((Kind::Pair, lean.0, lean.1));
        let at = |after: f64| Ending { time: since.value() + after, bodies, cause: Cause::Touching };
        let gap = || (relative.x.length() - reach).value().abs();
        if found > 0.0 || !in_touch || gap() > AT_LOAD * radius || one.t != two.t {
            return Some(at(found));
        }
        // in touch and at rest along the normal, they may part by the curvature of their paths
        let y = difference(&one.terms(), &two.terms());
        let Some(shown) = above(&rise(&y), radius * radius, span.length) else { return Some(at(found)) };
        let later = span.later(shown);
        later.doubt(motion, jerk, &Shape::Point).map(|after| at(shown + after))
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
        let (radius, plate) = (body.radius.value(), &self.plates[w]);
        let bodies = Some((Kind::Wall, i, w));
        let at = |after: f64, cause| Ending { time: body.now.t.value() + after, bodies, cause };
        if body.holder(w).is_some() {
            let over = self.dues.get(&i).filter(|due| due.t < t && !self.at_one_time(due.t, t));
            return over.map(|due| at((due.t - body.now.t).value(), Cause::RollsOver));
        }
        let start = Start::of(&body.now, plate, body.radius);
        if start == Start::Glides {
            return None;
        }
        let mut span = Span { from: body.now.t, length: (t - body.now.t).value(), radius, start, end: met };
        let mut shown = 0.0;
        if let Some(left) = body.left.iter().find(|left| left.wall == w) {
            let Some(until) = self.leaves(i, left, span.length) else { return Some(at(0.0, Cause::Touching)) };
            (shown, span) = (until, span.later(until));
        }
        let motion = |t: Double| {
            let [x, v, a] = body.now.state(t);
            [x - plate.center, v, a]
        };
        let jerk = body.now.jerk((t - body.now.t).value());
        span.doubt(motion, jerk, &self.shapes[w].1).map(|after| at(shown + after, Cause::Touching))
    }

    /// How long (s) sphere `i` is shown to part from an edge or a corner that has just let go of it, at most `length`; none if it is
    /// not. Beyond the line through an edge, the wall is no nearer than that line.
    fn leaves(&self, i: usize, left: &Held, length: f64) -> Option<f64> {
        let (body, plate) = (&self.bodies[i], &self.plates[left.wall]);
        let terms = body.now.terms();
        let across = |k: usize| match left.part {
            _ if k == 0 => left.part.arm(terms[0]),
            Part::Line(_, along) => terms[k].across(along),
            _ => terms[k],
        };
        let y: Vec<Vector> = (0..terms.len()).map(across).collect();
        let radius = body.radius;
        let mut shown = above(&rise(&y), (radius * radius).value(), length)?;
        let outer = if matches!(left.part, Part::Line(..)) { 1 } else { 2 };
        for border in plate.borders(left.region).into_iter().take(outer) {
            let mut room: Vec<Double> = terms.iter().map(|&term| border.normal.dot(term)).collect();
            room[0] = border.normal.dot(terms[0] - plate.center) + border.offset;
            shown = above(&room, 1.0, shown)?;
        }
        Some(shown)
    }
}

/// The difference of two series, term by term.
fn difference(one: &[Vector], two: &[Vector]) -> Vec<Vector> {
    let of = |terms: &[Vector], k: usize| terms.get(k).copied().unwrap_or_default();
    (0..one.len().max(two.len())).map(|k| of(one, k) - of(two, k)).collect()
}

fn earlier(one: Ending, two: Ending) -> Ending {
    if two.time < one.time { two } else { one }
}
