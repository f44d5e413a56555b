//! Low flights that a sphere repeats between impacts on faces: many at once.
//!
//! Equal [`hops`](super::hops) on one face, or the rounds of an [`orbit`](super::orbit) between several: those of 1e-12 m, as a
//! gap of rounding leaves them, come a million times a second. So a sphere that has done the same often enough in a row is
//! taken to go on like that until it may meet anything else. Meanwhile its record holds a sphere around all of its way,
//! larger by as much, that slides along. What meets that has the impacts told, and the sphere put to where it is by then,
//! before anything else happens: contacts and states are those of impact by impact, with less rounding.

use std::collections::BTreeMap;

use glam::DVec3;

use super::hops::Hops;
use super::orbit::{Leg, Orbit, OrbitRow};
use super::record::{Plan, Trajectory};
use crate::physics::contact::Kind;
use crate::physics::state::State;

/// Equal hops in a row after which the next ones are taken at once; twice as many after each attempt that was cut short,
/// up to so many that attempts cost little beside what comes before them.
const FIRST: u32 = 4;
const LAST: u32 = 256;

/// Fewest impacts that are worth it: beginning and ending cost a few events.
pub(super) const FEWEST: u64 = 16;

/// What a sphere repeats.
#[derive(Debug, Clone)]
pub(super) enum Repeated {
    /// Hops on a face.
    Hops(Hops),
    /// An orbit between faces.
    Orbit(Box<Orbit>),
}

impl Repeated {
    /// When it began, s.
    fn begin(&self) -> f64 {
        match self {
            Repeated::Hops(hops) => hops.line.t,
            Repeated::Orbit(orbit) => orbit.begin(),
        }
    }

    /// When it is over, s.
    fn end(&self) -> f64 {
        match self {
            Repeated::Hops(hops) => hops.end(),
            Repeated::Orbit(orbit) => orbit.end(),
        }
    }

    /// The walls that are struck, by their indices; where there are several, one may be named more than once.
    pub(super) fn walls(&self) -> impl Iterator<Item = usize> {
        let (hops, orbit) = match self {
            Repeated::Hops(hops) => (Some(hops.wall), None),
            Repeated::Orbit(orbit) => (None, Some(orbit.legs.iter().map(|leg| leg.wall))),
        };
        hops.into_iter().chain(orbit.into_iter().flatten())
    }

    /// Number of impacts up to time `t`, s.
    fn impacts(&self, t: f64) -> u64 {
        match self {
            Repeated::Hops(hops) => hops.done(t),
            Repeated::Orbit(orbit) => orbit.impacts(t),
        }
    }

    /// The sphere at time `t`, s.
    pub(super) fn at(&self, t: f64) -> Trajectory {
        match self {
            Repeated::Hops(hops) => hops.at(t),
            Repeated::Orbit(orbit) => orbit.at(t),
        }
    }

    /// The sphere around all of the way, sliding along the walls.
    pub(super) fn hull(&self) -> Trajectory {
        match self {
            Repeated::Hops(hops) => hops.hull(),
            Repeated::Orbit(orbit) => orbit.hull(),
        }
    }

    /// What moves that along: its velocity (m/s), and its acceleration (m/s²).
    pub(super) fn slide(&self) -> [DVec3; 2] {
        match self {
            Repeated::Hops(hops) => hops.slide(),
            Repeated::Orbit(orbit) => orbit.slide(),
        }
    }

    /// Acceleration of the sphere itself, m/s².
    pub(super) fn acceleration(&self) -> DVec3 {
        match self {
            Repeated::Hops(hops) => hops.a,
            Repeated::Orbit(orbit) => orbit.a,
        }
    }

    /// Whether all of the way stays where it is: walls that it has not met yet it will never meet.
    fn is_still(&self) -> bool {
        matches!(self, Repeated::Orbit(_)) && self.slide() == [DVec3::ZERO; 2]
    }

    /// Memory that it takes beside its own size, bytes.
    fn bytes(&self) -> usize {
        match self {
            Repeated::Hops(_) => 0,
            Repeated::Orbit(orbit) => size_of::<Orbit>() + size_of_val(&*orbit.legs),
        }
    }
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
    orbit_rows: BTreeMap<usize, OrbitRow>,
    now: BTreeMap<usize, Repeated>,
    /// What of this frame is over: the sphere, what it repeated, and until when, s.
    past: Vec<(usize, Repeated, f64)>,
}

impl Hopping {
    /// Whether a sphere hops on a wall, with which it has no other contact meanwhile.
    #[inline]
    pub(super) fn strikes(&self, i: usize, wall: usize) -> bool {
        !self.now.is_empty() && self.now.get(&i).is_some_and(|repeated| repeated.walls().any(|own| own == wall))
    }

    /// The walls that a sphere hops on; none if it hops on none, or if all of its way stays where it is, so that no other
    /// wall comes closer.
    pub(super) fn moving_on(&self, i: usize) -> Option<impl Iterator<Item = usize>> {
        self.now.get(&i).filter(|repeated| !repeated.is_still()).map(Repeated::walls)
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
        let contact = |repeated: &Repeated| {
            let wall = repeated.walls().next().expect("something is struck");
            Plan { contact: repeated.end(), kind: Kind::Wall, other: wall as u32, is_contact: true, ..Plan::IDLE }
        };
        self.now.get(&i).map_or(Plan::IDLE, contact)
    }

    /// Puts the spheres that hop at the time of a state of this frame to where they are in their hops.
    pub(super) fn write_into(&self, state: &mut State) {
        let current = self.now.iter().map(|(&i, repeated)| (i, repeated));
        let over = self.past.iter().filter(|(.., until)| *until > state.t).map(|(i, repeated, _)| (*i, repeated));
        for (i, repeated) in current.chain(over).filter(|(_, repeated)| repeated.begin() <= state.t) {
            let line = repeated.at(state.t);
            (state.x[i], state.v[i]) = (line.x, line.v);
        }
    }

    /// Memory that they take beside their own size, bytes, as near as their numbers tell.
    pub(super) fn bytes(&self) -> usize {
        let repeated = self.now.values().chain(self.past.iter().map(|(_, repeated, _)| repeated));
        self.rows.len() * size_of::<(usize, Row)>()
            + self.orbit_rows.len() * size_of::<(usize, OrbitRow)>()
            + self.orbit_rows.values().map(OrbitRow::bytes).sum::<usize>()
            + self.now.len() * size_of::<(usize, Repeated)>()
            + size_of_val(&*self.past)
            + repeated.map(Repeated::bytes).sum::<usize>()
    }

    /// Number of impacts up to time `t` (s) of the hops under way.
    #[inline(always)]
    pub(super) fn impacts(&self, t: f64) -> u64 {
        if self.now.is_empty() {
            return 0;
        }
        self.now.values().map(|repeated| repeated.impacts(t)).sum()
    }

    /// Whether no sphere hops.
    pub(super) fn is_empty(&self) -> bool {
        self.now.is_empty()
    }

    /// Has a sphere hop on.
    pub(super) fn put(&mut self, i: usize, repeated: Repeated) {
        self.now.insert(i, repeated);
    }

    /// A copy of which states from `time` (s) on can be read, and none before.
    pub(super) fn since(&self, time: f64) -> Hopping {
        let past = self.past.iter().filter(|(.., until)| *until > time).cloned().collect();
        Hopping { rows: self.rows.clone(), orbit_rows: self.orbit_rows.clone(), now: self.now.clone(), past }
    }

    /// Forgets what is over.
    #[inline(always)]
    pub(super) fn forget_past(&mut self) {
        self.past.clear();
    }

    /// Counts an impact on a wall at `now` (s) of a sphere that has moved as it did since `since` (s); whether it has come
    /// back from the same wall often enough.
    #[inline(never)]
    pub(super) fn is_row(&mut self, (i, wall): (usize, usize), since: f64, now: f64) -> bool {
        let row = self.rows.entry(i).or_insert(Row { wall, last: since, count: 0, enough: FIRST });
        let again = row.wall == wall && row.last == since;
        (row.wall, row.last, row.count) = (wall, now, if again { row.count.saturating_add(1) } else { 0 });
        row.count >= row.enough
    }

    /// Counts a low impact of a sphere that has moved as it did since `since` (s), accelerating with `a` (m/s²), on walls that
    /// leave the share `keeps` of what slides; the orbit that it is on, once that is plain. One ulp of the clock is
    /// `clock_ulp`, s.
    pub(super) fn orbit(
        &mut self,
        i: usize,
        (leg, since): (Leg, f64),
        motion: (DVec3, f64),
        clock_ulp: f64,
    ) -> Option<Orbit> {
        self.orbit_rows.entry(i).or_insert_with(|| OrbitRow::new(leg)).note(leg, since, motion, clock_ulp)
    }

    /// Ends at `now` (s) what a sphere repeats; what it was.
    pub(super) fn take(&mut self, i: usize, now: f64) -> Option<Repeated> {
        let repeated = self.now.remove(&i)?;
        if let (Repeated::Hops(hops), Some(row)) = (&repeated, self.rows.get_mut(&i)) {
            let short = hops.done(now) < FEWEST;
            row.last = now;
            row.enough = if short { LAST.min(2 * row.enough) } else { FIRST };
            row.count = if short { 0 } else { FIRST };
        }
        if let Repeated::Orbit(orbit) = &repeated
            && now >= orbit.end()
            && let Some(row) = OrbitRow::after(orbit)
        {
            self.orbit_rows.insert(i, row);
        }
        self.past.push((i, repeated.clone(), now));
        Some(repeated)
    }
}
