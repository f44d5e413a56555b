//! Equal hops of a sphere on a face: many at once.
//!
//! Where an impact takes nothing off the wall, a sphere that bounces on a face takes the same hop again and again. Along the
//! face it slides meanwhile as if it flew; or, if the wall rubs, each impact leaves the same share of what is left to slide,
//! and the way that is left is a geometric series. Hops of 1e-12 m, as a gap of rounding leaves them, come a million times a
//! second. So a sphere that has done the same few times in a row is
//! taken to hop on until it may meet anything else. Meanwhile its record holds a sphere around its whole hop, half a hop
//! above the face and larger by as much, that slides along. What meets that has the hops told, and the sphere put to where
//! it is in its hop by then, before anything else happens: contacts and states are those of hop by hop, with less rounding.

use std::collections::BTreeMap;

use glam::DVec3;

use super::record::{Plan, Trajectory};
use super::rounding::{HOP, SUM, TOUCHED_GAP};
use crate::physics::contact::Kind;
use crate::physics::state::State;

/// Equal hops in a row after which the next ones are taken at once; twice as many after each attempt that was cut short,
/// up to so many that attempts cost little beside what comes before them.
const FIRST: u32 = 4;
const LAST: u32 = 256;

/// Largest energy of sliding that hops may rub away before they are told, in units of what a fall by the radius gains: no
/// more than a tenth of what the energy of a frame may be off by.
const UNTOLD: f64 = 1e-12;

/// Fewest hops that are worth it: beginning and ending cost a few events.
pub(super) const FEWEST: u64 = 16;

/// A sphere that hops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hops {
    /// The face, by its index.
    pub(super) wall: usize,
    /// Unit normal of the face, towards the sphere.
    pub(super) normal: DVec3,
    /// The sphere right after the impact with which the first hop begins.
    pub(super) line: Trajectory,
    /// Acceleration of the sphere, m/s².
    pub(super) a: DVec3,
    /// Speed at which each hop leaves the face, m/s.
    pub(super) speed: f64,
    /// Acceleration towards the face, m/s².
    pub(super) press: f64,
    /// Share that an impact leaves of what slides along the face: 1 if the wall does not rub.
    pub(super) keeps: f64,
    /// Number of hops until the last one is over.
    pub(super) count: u64,
}

impl Hops {
    /// How long a hop takes, s.
    pub(super) fn period(&self) -> f64 {
        2.0 * self.speed / self.press
    }

    /// How high a hop is, m.
    pub(super) fn height(&self) -> f64 {
        0.5 * self.speed * self.speed / self.press
    }

    /// When the last hop is over, s.
    fn end(&self) -> f64 {
        self.line.t + self.count as f64 * self.period()
    }

    /// Part of a vector along the face.
    fn along(&self, u: DVec3) -> DVec3 {
        u - self.normal * self.normal.dot(u)
    }

    /// Number of hops that are over at time `t`, s.
    pub(super) fn done(&self, t: f64) -> u64 {
        (((t - self.line.t) / self.period()) as u64).min(self.count)
    }

    /// The sphere at time `t`, s.
    pub(super) fn at(&self, t: f64) -> Trajectory {
        let (since, done) = (t - self.line.t, self.done(t));
        let hop = (since - done as f64 * self.period()).clamp(0.0, self.period());
        let [way, slip] = self.slid(since, (done, hop));
        let up = (self.speed - 0.5 * self.press * hop) * hop;
        let x = self.line.x + way + self.normal * up;
        Trajectory { x, v: slip + self.normal * (self.speed - self.press * hop), t, r: self.line.r }
    }

    /// How far along the face the sphere has come (m), and how fast it slides (m/s), `since` the first hop began (s), so many
    /// hops and a part of one (s) later.
    fn slid(&self, since: f64, (done, hop): (u64, f64)) -> [DVec3; 2] {
        let [slip, pull] = [self.along(self.line.v), self.along(self.a)];
        if !self.rubs() {
            return [(slip + pull * (0.5 * since)) * since, slip + pull * since];
        }
        let left = power(self.keeps, done);
        [self.way() * (1.0 - left) + slip * (left * hop), slip * left]
    }

    /// Whether the wall rubs.
    fn rubs(&self) -> bool {
        self.keeps < 1.0
    }

    /// All the way that a wall that rubs leaves the sphere to slide, m: Σ v τᵏ T.
    fn way(&self) -> DVec3 {
        self.along(self.line.v) * (self.period() / (1.0 - self.keeps))
    }

    /// What moves the sphere around the hops along the face: its velocity (m/s), and its acceleration (m/s²).
    pub(super) fn slide(&self) -> [DVec3; 2] {
        if self.rubs() { [DVec3::ZERO; 2] } else { [self.along(self.line.v), self.along(self.a)] }
    }

    /// Where the foot of the sphere begins, and where a wall that rubs lets it come to, m.
    pub(super) fn feet(&self) -> [DVec3; 2] {
        [self.line.x, if self.rubs() { self.line.x + self.way() } else { self.line.x }]
    }

    /// Whether hop follows hop as these tell: the wall does not rub; or nothing pulls the sphere along it, all of the way that
    /// is left is less than its gap may be, and the energy that is left to rub away, untold, is rounding.
    pub(super) fn is_series(&self) -> bool {
        let (slip, r) = (self.along(self.line.v), self.line.r);
        let pulled = self.along(self.a).length() > SUM * self.a.length();
        let near = self.way().length() <= TOUCHED_GAP * r;
        !self.rubs() || (!pulled && near && 0.5 * slip.length_squared() <= UNTOLD * self.press * r)
    }

    /// Rounding of the sphere's place, m.
    fn rounding(&self) -> f64 {
        HOP * self.line.x.abs().max_element().max(self.line.r)
    }

    /// The sphere around all of the hop, and all of what a wall that rubs leaves it to slide, sliding along a face that does
    /// not.
    pub(super) fn hull(&self) -> Trajectory {
        let Trajectory { t, r, .. } = self.line;
        let ([from, to], [slip, _]) = (self.feet(), self.slide());
        let (up, aside) = (0.5 * self.height(), 0.5 * from.distance(to));
        Trajectory { x: (from + to) * 0.5 + self.normal * up, v: slip, t, r: r + up + aside + self.rounding() }
    }
}

/// The power xⁿ, by squares.
fn power(x: f64, mut n: u64) -> f64 {
    let (mut square, mut product) = (x, 1.0);
    while n > 0 {
        product *= if n % 2 == 1 { square } else { 1.0 };
        square *= square;
        n /= 2;
    }
    product
}

/// How often a sphere has bounced on a wall in a row, nothing else happening to it.
#[derive(Debug, Clone, Copy)]
struct Row {
    wall: usize,
    /// When it did last, s.
    last: f64,
    count: u32,
    /// Count from which on its hops are taken at once.
    enough: u32,
}

/// The spheres that hop.
#[derive(Debug, Clone, Default)]
pub(crate) struct Hopping {
    rows: BTreeMap<usize, Row>,
    now: BTreeMap<usize, Hops>,
    /// Hops of this frame that are over: the sphere, its hops, and when they were over, s.
    past: Vec<(usize, Hops, f64)>,
}

impl Hopping {
    /// The wall that a sphere hops on, with which it has no other contact meanwhile.
    #[inline]
    pub(super) fn wall(&self, i: usize) -> Option<usize> {
        if self.now.is_empty() { None } else { self.now.get(&i).map(|hops| hops.wall) }
    }

    /// Whether a sphere hops.
    #[inline]
    pub(super) fn holds(&self, i: usize) -> bool {
        !self.now.is_empty() && self.now.contains_key(&i)
    }

    /// What a sphere has planned if it meets nothing else: the end of its hops.
    #[inline]
    pub(super) fn plan(&self, i: usize) -> Plan {
        if self.now.is_empty() {
            return Plan::IDLE;
        }
        let contact = |hops: &Hops| Plan {
            contact: hops.end(),
            kind: Kind::Wall,
            other: hops.wall as u32,
            is_contact: true,
            ..Plan::IDLE
        };
        self.now.get(&i).map_or(Plan::IDLE, contact)
    }

    /// Puts the spheres that hop at the time of a state of this frame to where they are in their hops.
    pub(super) fn write_into(&self, state: &mut State) {
        let current = self.now.iter().map(|(&i, hops)| (i, *hops));
        let over = self.past.iter().filter(|&&(.., until)| until > state.t).map(|&(i, hops, _)| (i, hops));
        for (i, hops) in current.chain(over).filter(|(_, hops)| hops.line.t <= state.t) {
            let line = hops.at(state.t);
            (state.x[i], state.v[i]) = (line.x, line.v);
        }
    }

    /// Memory that they take beside their own size, bytes, as near as their numbers tell.
    pub(super) fn bytes(&self) -> usize {
        self.rows.len() * size_of::<(usize, Row)>()
            + self.now.len() * size_of::<(usize, Hops)>()
            + size_of_val(&*self.past)
    }

    /// Number of impacts up to time `t` (s) of the hops under way.
    pub(super) fn impacts(&self, t: f64) -> u64 {
        self.now.values().map(|hops| hops.done(t)).sum()
    }

    /// Whether no sphere hops.
    pub(super) fn is_empty(&self) -> bool {
        self.now.is_empty()
    }

    /// Has a sphere hop on.
    pub(super) fn put(&mut self, i: usize, hops: Hops) {
        self.now.insert(i, hops);
    }

    /// A copy of which states from `time` (s) on can be read, and none before.
    pub(super) fn since(&self, time: f64) -> Hopping {
        let past = self.past.iter().filter(|&&(.., until)| until > time).copied().collect();
        Hopping { rows: self.rows.clone(), now: self.now.clone(), past }
    }

    /// Forgets what is over.
    pub(super) fn forget_past(&mut self) {
        self.past.clear();
    }

    /// Counts an impact on a wall at `now` (s) of a sphere that has moved as it did since `since` (s); whether it has come
    /// back from the same wall often enough.
    pub(super) fn is_row(&mut self, (i, wall): (usize, usize), since: f64, now: f64) -> bool {
        let row = self.rows.entry(i).or_insert(Row { wall, last: since, count: 0, enough: FIRST });
        let again = row.wall == wall && row.last == since;
        (row.wall, row.last, row.count) = (wall, now, if again { row.count.saturating_add(1) } else { 0 });
        row.count >= row.enough
    }

    /// Ends the hops of a sphere at `now`, s; what they were.
    pub(super) fn take(&mut self, i: usize, now: f64) -> Option<Hops> {
        let hops = self.now.remove(&i)?;
        self.past.push((i, hops, now));
        let short = hops.done(now) < FEWEST;
        if let Some(row) = self.rows.get_mut(&i) {
            row.last = now;
            row.enough = if short { LAST.min(2 * row.enough) } else { FIRST };
            row.count = if short { 0 } else { FIRST };
        }
        Some(hops)
    }
}
