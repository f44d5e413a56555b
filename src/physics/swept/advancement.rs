//! Conservative advancement: from what is seen now, step as far as nothing can have been missed; look; step on.
//!
//! Bodies are convex, so that each lies on its side of the plane through the contact point, and the gap along that normal
//! is a parabola that the gap itself never undercuts. While the gap is wide, steps end where the parabola comes near 0,
//! and the search says "look again then": most such contacts never happen, because something else comes first. Close up,
//! steps end where the parabola reaches half the tolerance below 0. The first look that sees an overlap that closes, no
//! deeper than the tolerance, is the contact; if rounding has made it deeper, the last step is halved until it is not, or
//! until no time lies between its ends, and then the later end is taken as it is. No tolerance is too small: 0 ends there.
//!
//! An overlap that opens is no contact until it closes again: the search goes on to where it could at the earliest.

use std::cell::{Cell, RefCell};

use super::separation::{Gap, PairSeparation, Separation, WallSeparation};
use crate::physics::contact::Probe;
use crate::physics::events::detector::{Detector, Due, Span};
use crate::physics::events::rounding::{CLOSING, HEALED, HEALED_WITHIN_TOLERANCE, HOP};
use crate::physics::log::Log;
use crate::physics::method::LARGEST_TOLERANCE;
use crate::physics::model::Settings;
use crate::physics::path::Path;
use crate::physics::wall::Face;
use crate::roots::quadratic_fall;

/// Gaps up to this many radii are looked at to the end, wider ones when they have become so.
const NEAR: f64 = 1e-3;

/// Looks at two bodies after which the search is interrupted, to go on from there.
const PATIENCE: usize = 200;

/// The detector of `swept`, and what it has looked at since it last told.
#[derive(Debug, Clone)]
pub(crate) struct ConservativeAdvancement {
    /// Deepest intersection degree accepted, dimensionless.
    tolerance: f64,
    /// Looks at two bodies not yet told.
    evaluations: Cell<u64>,
    /// Close looks not yet told: when, s, and the degree seen.
    probes: RefCell<Vec<(f64, f64)>>,
}

impl Detector for ConservativeAdvancement {
    const PAIRS_FIRST: bool = false;
    const STRAIGHT_PAIRS: bool = false;
    const ONE_LOOK: bool = false;

    fn new(settings: Settings) -> ConservativeAdvancement {
        let tolerance = settings.tolerance.min(LARGEST_TOLERANCE);
        ConservativeAdvancement { tolerance, evaluations: Cell::new(0), probes: RefCell::default() }
    }

    fn retune(&mut self, settings: Settings) -> bool {
        let new = ConservativeAdvancement::new(settings);
        let changes = new.tolerance != self.tolerance;
        if changes {
            *self = new;
        }
        changes
    }

    fn healed(&self) -> f64 {
        if self.tolerance <= HEALED { HEALED } else { HEALED_WITHIN_TOLERANCE }
    }

    fn wall(&self, path: &Path, r: f64, face: &Face, span: Span) -> Option<Due> {
        self.search(&WallSeparation { path, r, face }, span)
    }

    fn pair(&self, a: &Path, b: &Path, reach: f64, span: Span) -> Option<Due> {
        let pair = PairSeparation::new(a, b, reach);
        if pair.parts_for_good() {
            self.count();
            return None;
        }
        self.search(&pair, span)
    }

    fn pair_horizon(mine: f64, theirs: f64) -> f64 {
        mine.min(theirs)
    }

    fn report(&mut self, start: f64, end: f64, _: u64, log: &mut Log) {
        log.tallies.evaluations += self.evaluations.take();
        let before = log.probes.len();
        self.probes.get_mut().retain(|&(time, degree)| {
            // what was seen of later frames is told in theirs
            if time <= end {
                log.probes.push(Probe { step: time - start, degree });
            }
            time > end
        });
        log.tallies.probes += (log.probes.len() - before) as u64;
    }
}

impl ConservativeAdvancement {
    /// When two bodies next touch while approaching, or when to look again.
    fn search(&self, bodies: &impl Separation, span: Span) -> Option<Due> {
        let near = NEAR * bodies.reach();
        let (mut s, mut seen) = (0.0, bodies.at(0.0));
        for _ in 0..PATIENCE {
            self.count();
            if seen.gap <= 0.0 && closes(bodies, s, seen) {
                return Some(Due { after: s, is_contact: true });
            }
            let wide = seen.gap > 2.0 * near;
            let step = if wide { wide_step(seen, near) } else { self.close_step(bodies, seen) }?;
            let next = s + step.max(least_step(bodies, span.now, s));
            if next >= span.before || next.is_nan() {
                return None;
            }
            let last = std::mem::replace(&mut s, next);
            seen = bodies.at(s);
            if wide && seen.gap <= near && span.now + s > span.now {
                self.count();
                return Some(Due { after: s, is_contact: false });
            }
            if !wide {
                if seen.gap <= 2.0 * near {
                    self.note(bodies, span.now + s, seen);
                }
                if seen.gap < -self.tolerance * bodies.reach() && last < s && closes(bodies, s, seen) {
                    return Some(Due { after: self.halve(bodies, span.now, [last, s]), is_contact: true });
                }
            }
        }
        Some(Due { after: s, is_contact: false })
    }

    /// How far to go from a narrow gap, or from an overlap that opens, s; none if the bodies do not come together again.
    fn close_step(&self, bodies: &impl Separation, seen: Gap) -> Option<f64> {
        let Gap { gap, v_n, a_n } = seen;
        if gap > 0.0 {
            return quadratic_fall([gap + 0.5 * self.tolerance * bodies.reach(), v_n, 0.5 * a_n]);
        }
        // unless something presses it, it will never be deeper than it is, but for rounding
        let (pull, rounding) = (bodies.max_acceleration(), HOP * bodies.size());
        if a_n >= 0.0 || v_n * v_n <= 2.0 * pull * rounding {
            return quadratic_fall([rounding, v_n, 0.5 * a_n]);
        }
        Some(v_n / pull)
    }

    /// The time of the contact, s from now, within a step from `outside` (s) to `inside` (s), where the overlap is deeper
    /// than the tolerance.
    fn halve(&self, bodies: &impl Separation, now: f64, [mut outside, mut inside]: [f64; 2]) -> f64 {
        loop {
            let middle = 0.5 * (outside + inside);
            if now + middle == now + outside || now + middle == now + inside {
                return inside;
            }
            let seen = bodies.at(middle);
            self.count();
            self.note(bodies, now + middle, seen);
            if seen.gap > 0.0 || !closes(bodies, middle, seen) {
                outside = middle;
            } else if seen.gap >= -self.tolerance * bodies.reach() {
                return middle;
            } else {
                inside = middle;
            }
        }
    }

    fn count(&self) {
        self.evaluations.set(self.evaluations.get() + 1);
    }

    fn note(&self, bodies: &impl Separation, time: f64, seen: Gap) {
        self.probes.borrow_mut().push((time, -seen.gap / bodies.reach()));
    }
}

/// How far to go from a wide gap, s: to where the gap may be half of `near` (m).
fn wide_step(seen: Gap, near: f64) -> Option<f64> {
    quadratic_fall([seen.gap - 0.5 * near, seen.v_n, 0.5 * seen.a_n])
}

/// Whether the gap is about to shrink `s` seconds from now. Where only rounding says so, what presses decides: of three
/// spheres in a row that have stopped approaching each other, rounding would otherwise have the outer two push the middle
/// one to and fro.
fn closes(bodies: &impl Separation, s: f64, seen: Gap) -> bool {
    seen.v_n < 0.0 && seen.v_n < -CLOSING * bodies.speed(s) || seen.v_n <= 0.0 && bodies.acceleration(s) < 0.0
}

/// The shortest step worth a look `s` seconds from now, s: one that the clock can tell from none, and in which what moves
/// goes as far as coordinates can tell.
fn least_step(bodies: &impl Separation, now: f64, s: f64) -> f64 {
    let (time, way) = ((now + s).abs(), f64::EPSILON * bodies.size());
    (time.next_up() - time).max(way / (bodies.speed(s) + (bodies.max_acceleration() * way).sqrt()))
}
