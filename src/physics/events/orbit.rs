//! Periodic orbits of a sphere between walls.
//!
//! Between two elastic walls a sphere may take the same flights again and again: across a gap that it all but fits into, or
//! in a valley, straight off the one wall and straight onto the other. In a gap of 1e-12 m that is millions of impacts a
//! second. When the same few impacts have led it back to where and how it was often enough, it is taken to go on like that.
//!
//! - Walls that rub (τ < 1) take energy wherever the sphere slides: an orbit among them strikes each wall straight, or slides
//!   along all of them by so little that what they take meanwhile, untold, is rounding. What is off dies out, and the orbit
//!   stays.
//! - Walls that do not rub hold an orbit only if all of them are parallel: across the gap the flights repeat, along it the
//!   sphere flies. In a wedge that does not rub the motion is not periodic, and it is followed impact by impact.

use glam::DVec3;

use super::record::Trajectory;
use super::rounding::{HOP, SHARED_GAP, SUM, TOUCHED_GAP, UNTOLD};

/// Rounds that must have led back to the first before the next are taken at once: what grows by 7 % a round has grown by
/// two orders of magnitude, as far as rounding may have led.
const ROUNDS: u32 = 64;

/// Most rounds, or hops, at once: a run that has nothing else to do still comes by now and then.
pub(super) const MOST: u64 = 1 << 20;

/// Most impacts of a round.
const MOST_IMPACTS: usize = 8;

/// Share by which an impact may differ from the first one of its round to be taken for the first one of the next.
const ALIKE: f64 = 0.125;

/// The flight of a sphere after an impact on a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Leg {
    /// The face, by its index.
    pub(super) wall: usize,
    /// Unit normal of the face, towards the sphere.
    pub(super) normal: DVec3,
    /// The sphere right after the impact.
    pub(super) line: Trajectory,
}

impl Leg {
    /// Velocity at `t` (s) of a sphere that accelerates with `a` (m/s²) on this flight, m/s.
    fn velocity(&self, a: DVec3, t: f64) -> DVec3 {
        self.line.v + a * (t - self.line.t)
    }
}

/// A sphere that repeats a round of flights.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Orbit {
    /// The flights of the first round, at their times in it.
    pub(super) legs: Vec<Leg>,
    /// Acceleration of the sphere, m/s².
    pub(super) a: DVec3,
    /// How long a round takes, s.
    period: f64,
    /// Unit vectors across which the flights repeat, in right angles to each other: what the normals span.
    across: Vec<DVec3>,
    /// How far a round leads along all walls, if they rub, m.
    drift: DVec3,
    /// Share that an impact leaves of what slides along a face: 1 if the walls do not rub.
    keeps: f64,
    /// Number of rounds until the last one is over.
    pub(super) count: u64,
}

impl Orbit {
    /// The orbit of which these flights were the last round, the sphere having gone round [`ROUNDS`] times since `first`;
    /// none if it has not come back. The sphere accelerates with `a` (m/s²), and an impact leaves it the share `keeps` of what
    /// slides.
    fn new(mut legs: Vec<Leg>, [first, now]: [Leg; 2], a: DVec3, keeps: f64, clock_ulp: f64) -> Option<Orbit> {
        let period = (now.line.t - first.line.t) / f64::from(ROUNDS);
        let round = Orbit { across: spanned(&legs), legs: Vec::new(), a, period, drift: DVec3::ZERO, keeps, count: 0 };
        let (line, size) = (now.line, now.line.x.abs().max_element().max(now.line.r));
        let (led, turned) = (line.x - first.line.x, line.v - first.line.v);
        let (led_across, turned_across) = (round.part_across(led), round.part_across(turned));
        let (speed, place) = (round.part_across(line.v).length(), SHARED_GAP * size);
        let back = led_across.length() <= place && turned_across.length() <= SUM * speed + a.length() * place / speed;
        let slides_alike = (turned - turned_across).length() <= SUM * line.v.length() + a.length() * clock_ulp;
        let stays = if keeps < 1.0 { slides_alike } else { round.across.len() == 1 };
        let begin = legs[0].line;
        let lasts_alike = (line.t - begin.t - period).abs() <= f64::from(ROUNDS) * clock_ulp + place / speed;
        if !(back && stays && lasts_alike && period > 0.0) {
            return None;
        }
        // the last round, as the next one
        for leg in &mut legs {
            leg.line.t += line.t - begin.t;
            leg.line.x += line.x - begin.x;
        }
        legs[0] = now;
        let orbit = Orbit { legs, ..round };
        let drift = orbit.way_along();
        let shows = drift.length() * MOST as f64 > HOP * size;
        Some(Orbit { drift: if shows { drift } else { DVec3::ZERO }, ..orbit })
    }

    /// How far a round leads along all walls, if they rub, m; by the velocities: places do not tell what is less than their
    /// rounding.
    fn way_along(&self) -> DVec3 {
        let ends = self.legs[1..].iter().map(|leg| leg.line.t).chain([self.begin() + self.period]);
        let way = |(leg, end): (&Leg, f64)| (leg.line.v + leg.velocity(self.a, end)) * (0.5 * (end - leg.line.t));
        if self.keeps < 1.0 { self.part_along(self.legs.iter().zip(ends).map(way).sum()) } else { DVec3::ZERO }
    }

    /// When the first round begins, s.
    pub(super) fn begin(&self) -> f64 {
        self.legs[0].line.t
    }

    /// How long a round takes, s.
    pub(super) fn period(&self) -> f64 {
        self.period
    }

    /// When the last round is over, s.
    pub(super) fn end(&self) -> f64 {
        self.begin() + self.count as f64 * self.period
    }

    /// Part of a vector that the flights repeat.
    fn part_across(&self, u: DVec3) -> DVec3 {
        self.across.iter().map(|&e| e * e.dot(u)).sum()
    }

    /// Part of a vector along all of the walls.
    fn part_along(&self, u: DVec3) -> DVec3 {
        u - self.part_across(u)
    }

    /// Number of rounds that are over at time `t` (s), and how long the next one has lasted, s.
    fn phase(&self, t: f64) -> (u64, f64) {
        if t >= self.end() {
            return (self.count, 0.0);
        }
        let since = t - self.begin();
        let done = ((since / self.period) as u64).min(self.count);
        (done, (since - done as f64 * self.period).clamp(0.0, self.period))
    }

    /// Number of impacts on the face of one flight up to time `t`, s: the first of all is what the orbit begins with.
    pub(super) fn impacts_of(&self, leg: usize, t: f64) -> u64 {
        let (done, phase) = self.phase(t);
        let over = leg > 0 && self.legs[leg].line.t - self.begin() <= phase;
        done + u64::from(over)
    }

    /// Number of impacts up to time `t`, s.
    pub(super) fn impacts(&self, t: f64) -> u64 {
        (0..self.legs.len()).map(|leg| self.impacts_of(leg, t)).sum()
    }

    /// The sphere at time `t`, s.
    pub(super) fn at(&self, t: f64) -> Trajectory {
        let (done, phase) = self.phase(t);
        let is_over = |leg: &&Leg| leg.line.t - self.begin() <= phase;
        let leg = self.legs.iter().rev().find(is_over).unwrap_or(&self.legs[0]);
        let path = leg.line.path(self.a, self.begin() + phase);
        if self.keeps < 1.0 {
            return Trajectory { x: path.x + self.drift * done as f64, v: path.v, t, r: leg.line.r };
        }
        let free = self.legs[0].line.path(self.a, t);
        let x = self.part_across(path.x) + self.part_along(free.x);
        Trajectory { x, v: self.part_across(path.v) + self.part_along(free.v), t, r: leg.line.r }
    }

    /// The velocity of the sphere when it strikes the face of one flight, m/s.
    fn arrival(&self, leg: usize) -> DVec3 {
        if leg == 0 {
            let last = self.legs.last().expect("a round has flights");
            return last.velocity(self.a, self.begin() + self.period);
        }
        self.legs[leg - 1].velocity(self.a, self.legs[leg].line.t)
    }

    /// Speed at which the sphere strikes the face of one flight, m/s.
    pub(super) fn approach_speed(&self, leg: usize) -> f64 {
        -self.legs[leg].normal.dot(self.arrival(leg))
    }

    /// What moves the sphere around the orbit along the walls: its velocity (m/s), and its acceleration (m/s²).
    pub(super) fn slide(&self) -> [DVec3; 2] {
        if self.keeps < 1.0 {
            return [self.drift / self.period, DVec3::ZERO];
        }
        [self.part_along(self.legs[0].line.v), self.part_along(self.a)]
    }

    /// Where a flight begins, m, but for the way along walls that do not rub.
    fn place(&self, leg: &Leg) -> DVec3 {
        if self.keeps < 1.0 { leg.line.x } else { self.part_across(leg.line.x) + self.part_along(self.legs[0].line.x) }
    }

    /// The sphere around all of the orbit, sliding along the walls.
    pub(super) fn hull(&self) -> Trajectory {
        let Trajectory { t, r, .. } = self.legs[0].line;
        let center = self.legs.iter().map(|leg| self.place(leg)).sum::<DVec3>() / self.legs.len() as f64;
        let aside = self.legs.iter().map(|leg| center.distance(self.place(leg))).fold(0.0, f64::max);
        // no flight bends by more than one that lasts the whole round
        let bent = 0.125 * self.a.length() * self.period * self.period;
        let rounding = HOP * center.abs().max_element().max(r);
        Trajectory { x: center, v: self.slide()[0], t, r: r + aside + bent + self.drift.length() + rounding }
    }

    /// Number of rounds that may be taken at once: so many that what the walls rub away, untold, is rounding; none if the
    /// sphere does not touch all of them all the while.
    pub(super) fn rounds(&self, most: u64) -> u64 {
        let (line, rubs) = (self.legs[0].line, 0.5 * (1.0 - self.keeps * self.keeps));
        let slip = |leg: usize| {
            let (v, n) = (self.arrival(leg), self.legs[leg].normal);
            (v - n * n.dot(v)).length_squared()
        };
        let lost: f64 = (0..self.legs.len()).map(|leg| rubs * slip(leg)).sum();
        let untold = UNTOLD * (self.a.length() * line.r + 0.5 * line.v.length_squared());
        let low = self.hull().r - line.r <= TOUCHED_GAP * line.r;
        match (low, lost * most as f64 > untold) {
            (false, _) => 0,
            (true, true) => (untold / lost) as u64,
            (true, false) => most,
        }
    }
}

/// Unit vectors in right angles to each other that span the normals of these flights; walls that are parallel but for
/// rounding span one.
fn spanned(legs: &[Leg]) -> Vec<DVec3> {
    let mut across: Vec<DVec3> = Vec::new();
    for leg in legs {
        let rest = across.iter().fold(leg.normal, |rest, &e| rest - e * e.dot(rest));
        if rest.length() > SUM {
            across.push(rest / rest.length());
        }
    }
    across
}

/// The impacts of a sphere on faces in a row, nothing else happening to it, as far as they may be rounds of an orbit.
#[derive(Debug, Clone)]
pub(super) struct OrbitRow {
    /// The impact with which the first round began.
    first: Leg,
    /// The impacts of the round under way.
    legs: Vec<Leg>,
    /// Number of rounds that are over.
    rounds: u32,
}

impl OrbitRow {
    /// A row that begins with this impact.
    pub(super) fn new(first: Leg) -> OrbitRow {
        OrbitRow { first, legs: vec![first], rounds: 0 }
    }

    /// The row of an orbit whose last round is over, as if all of its impacts had been counted: across a gap between parallel
    /// walls one more round shows that it goes on; any other must show that it is still stable.
    pub(super) fn after(orbit: &Orbit) -> Option<OrbitRow> {
        let before = f64::from(ROUNDS - 1);
        let (last, line) = (orbit.legs[0], orbit.at(orbit.end()));
        let first = Trajectory { t: line.t - orbit.period * before, ..line };
        let row = OrbitRow { first: Leg { line: first, ..last }, legs: vec![Leg { line, ..last }], rounds: ROUNDS - 1 };
        (orbit.across.len() == 1).then_some(row)
    }

    /// Memory that it takes beside its own size, bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.legs)
    }

    /// Counts an impact of a sphere that has moved as it did since `since` (s), accelerating with `a` (m/s²); the orbit that
    /// it is on, once that is plain. An impact leaves the share `keeps` of what slides; one ulp of the clock is
    /// `clock_ulp`, s.
    pub(super) fn note(&mut self, leg: Leg, since: f64, (a, keeps): (DVec3, f64), clock_ulp: f64) -> Option<Orbit> {
        let follows = self.legs.last().is_some_and(|last| last.line.t == since);
        if !follows || self.legs.len() > MOST_IMPACTS {
            *self = OrbitRow::new(leg);
            return None;
        }
        let speed = |of: &Leg| of.normal.dot(of.line.v);
        let alike = leg.wall == self.first.wall && (speed(&leg) - speed(&self.first)).abs() <= ALIKE * speed(&leg);
        if !alike {
            self.legs.push(leg);
            return None;
        }
        let round = std::mem::replace(&mut self.legs, vec![leg]);
        self.rounds += 1;
        if self.rounds < ROUNDS {
            return None;
        }
        let first = std::mem::replace(self, OrbitRow::new(leg)).first;
        Orbit::new(round, [first, leg], a, keeps, clock_ulp)
    }
}
