//! A run read at fixed instants: what references, displaced runs and candidates have in common.

use std::ops::ControlFlow;

use super::{GoOn, Interrupted};
use crate::physics::contact::Key;
use crate::physics::{Class, Progress, Simulation, Stall, State, Tallies, Until};

/// Units of work between two looks at whether to go on: some milliseconds. No bit of a run depends on it.
const SLICE: u64 = 20_000;

/// Instants at which every run of a scene is read, from 0 to `until`, evenly: a fixed grid, not the frames of each run,
/// so that all settings are judged at the same times, and the reference is computed once for all of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instants {
    /// The last, s.
    pub until: f64,
    /// How many there are after t = 0; at least 1.
    pub count: usize,
}

/// Of a small scene so many: every 0.01 s of 20 s.
const MOST: usize = 2000;

/// Of a large scene not fewer than so many.
const FEWEST: usize = 100;

/// Positions a reference may hold: 48 MB. Beyond it the instants get fewer.
const POSITIONS: usize = 2_000_000;

impl Instants {
    /// The instants for a scene of that many spheres, up to `until` (s).
    pub fn new(until: f64, spheres: usize) -> Instants {
        Instants { until, count: (POSITIONS / spheres.max(1)).clamp(FEWEST, MOST) }
    }

    /// Instant `k` of 0 to `count`, s. Multiplied, not summed, so that no rounding grows.
    pub fn at(&self, k: usize) -> f64 {
        if k >= self.count { self.until } else { k as f64 * self.until / self.count as f64 }
    }
}

/// An impact: when, s, and between which two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// When, s.
    pub time: f64,
    /// Between whom.
    pub key: Key,
}

/// Why a walk ended before its last instant.
#[derive(Debug, Clone, PartialEq)]
pub enum Cut {
    /// The method cannot go on.
    Stalled(Stall),
    /// Its budget of work is spent.
    Spent,
    /// Whoever looked on has seen enough.
    Enough,
}

/// A run that has been read.
#[derive(Debug, Clone, PartialEq)]
pub struct Walk {
    /// How far it was read, s.
    pub end: f64,
    /// Why not to the last instant.
    pub cut: Option<Cut>,
    /// Its impacts up to `end`, in order.
    pub impacts: Vec<Impact>,
    /// What it counted, up to the end of the frame that holds `end`.
    pub tallies: Tallies,
}

/// Runs a simulation from t = 0 past every instant; `visit` sees the state at each, the first at t = 0. At most about
/// `budget` units of work (events, degree evaluations) are spent.
///
/// # Errors
/// If `go_on` says no.
pub fn walk(
    simulation: &mut Simulation,
    instants: Instants,
    budget: u64,
    go_on: GoOn,
    mut visit: impl FnMut(usize, &State) -> ControlFlow<()>,
) -> Result<Walk, Interrupted> {
    simulation.record_events(true);
    let (mut impacts, mut cut, mut end, mut left) = (Vec::new(), None, 0.0, budget);
    for k in 0..=instants.count {
        cut = reach(simulation, instants.at(k), &mut left, go_on)?;
        keep_impacts(simulation, &mut impacts);
        if cut.is_some() {
            break;
        }
        end = instants.at(k);
        if visit(k, &simulation.at(end)).is_break() {
            cut = Some(Cut::Enough);
            break;
        }
    }
    if let Some(Cut::Stalled(stall)) = &cut {
        end = stall.time.clamp(end, instants.until);
    }
    impacts.retain(|impact| impact.time <= end);
    Ok(Walk { end, cut, impacts, tallies: simulation.tallies() })
}

/// Advances until a frame holds `time`; says so if it cannot.
fn reach(simulation: &mut Simulation, time: f64, left: &mut u64, go_on: GoOn) -> Result<Option<Cut>, Interrupted> {
    loop {
        match simulation.advance(Until::Time(time), SLICE) {
            Progress::Reached => return Ok(None),
            Progress::Stalled(stall) => return Ok(Some(Cut::Stalled(stall))),
            Progress::Yielded if *left < SLICE => return Ok(Some(Cut::Spent)),
            Progress::Yielded => *left -= SLICE,
        }
        if !go_on() {
            return Err(Interrupted);
        }
    }
}

/// Runs to `until` (s) and reads nothing: what a run costs by itself. False if it stalls before.
///
/// # Errors
/// If `go_on` says no.
pub(super) fn run_through(simulation: &mut Simulation, until: f64, go_on: GoOn) -> Result<bool, Interrupted> {
    let mut plenty = u64::MAX;
    reach(simulation, until, &mut plenty, go_on).map(|cut| cut.is_none())
}

fn keep_impacts(simulation: &mut Simulation, impacts: &mut Vec<Impact>) {
    let events = simulation.take_events();
    let collisions = events.iter().filter(|event| event.class == Class::Collide);
    impacts.extend(collisions.map(|event| Impact { time: event.time, key: event.key() }));
}
