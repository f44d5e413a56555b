//! A run read at fixed instants: what references, displaced runs and candidates have in common.

use std::ops::ControlFlow;

use super::clock::Watch;
use super::interrupt::{GoOn, Interrupted};
use super::slices::Slices;
use super::work::counted;
use crate::physics::contact::Key;
use crate::physics::{Class, Progress, Simulation, Stall, State, Tallies};

/// Length of a slice of work, s, about: that soon an interrupt is noticed.
const SLICE: f64 = 2e-3;

/// What a run may take before it is given up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// Units of work (events, degree evaluations), roughly.
    pub work: u64,
    /// Time on its thread, s.
    pub cpu: f64,
    /// Counted work, ns on some machine: what exceeds it is given up at the same instant everywhere.
    pub counted: u64,
    /// Rests and releases: what they cost grows with the heap that they belong to, and no price is right for them.
    pub changes: u64,
}

impl Budget {
    /// The budget of a run that may take as much as it takes.
    pub const UNLIMITED: Budget = Budget { work: u64::MAX, cpu: f64::INFINITY, counted: u64::MAX, changes: u64::MAX };
    /// The budget of a reference: minutes of flights. A crowd that settles takes more, and gets the stand-in.
    pub const REFERENCE: Budget = Budget { work: 50_000_000, cpu: 60.0, ..Budget::UNLIMITED };
    /// The budget of a reference that a user waits for: half a second of counted work.
    pub const BRIEF: Budget = Budget::counted(500_000_000);

    /// The budget of `counted` work, ns, and of nothing else.
    pub const fn counted(counted: u64) -> Budget {
        Budget { counted, ..Budget::UNLIMITED }
    }
}

/// Instants at which every run of a scene is read, from 0 to `until`, evenly: a fixed grid, not the frames of each run,
/// so that all settings are judged at the same times, and the reference is computed once for all of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instants {
    /// The last instant, s.
    pub until: f64,
    /// Number of instants after t = 0; at least 1.
    pub count: usize,
}

/// Instants of a small scene: every 0.01 s of 20 s.
const MOST: usize = 2000;

/// Fewest instants of a large scene.
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

/// An impact: its time, and its two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Time of the impact, s.
    pub time: f64,
    /// The two bodies of the impact.
    pub key: Key,
}

/// Why a run that was read ended before its last instant.
#[derive(Debug, Clone, PartialEq)]
pub enum EndReason {
    /// The method cannot go on.
    Stalled(Stall),
    /// The budget of the run is spent.
    Spent,
    /// The caller has seen enough.
    Enough,
}

/// A run that has been read.
#[derive(Debug, Clone, PartialEq)]
pub struct Sampled {
    /// Time up to which the run was read, s.
    pub end: f64,
    /// Why the run was not read to the last instant; none if it was.
    pub end_reason: Option<EndReason>,
    /// Impacts up to `end`, in order.
    pub impacts: Vec<Impact>,
    /// Counted work and outcomes up to the end of the frame that holds `end`.
    pub tallies: Tallies,
}

/// Runs a simulation from t = 0 past every instant; `visit` sees the state at each, the first at t = 0. At most about
/// `budget` is spent.
///
/// # Errors
/// If `go_on` returns false.
pub fn sample(
    simulation: &mut Simulation,
    instants: Instants,
    budget: Budget,
    go_on: GoOn,
    mut visit: impl FnMut(usize, &State) -> ControlFlow<()>,
) -> Result<Sampled, Interrupted> {
    simulation.record_events(true);
    let (mut impacts, mut end_reason, mut end) = (Vec::new(), None, 0.0);
    let mut pace = Pace::new(budget);
    for k in 0..=instants.count {
        end_reason = pace.reach(simulation, instants.at(k), go_on)?;
        if end_reason.is_none() && counted(simulation) > budget.counted {
            end_reason = Some(EndReason::Spent); // where slices end must not decide it
        }
        keep_impacts(simulation, &mut impacts);
        if end_reason.is_some() {
            break;
        }
        end = instants.at(k);
        if visit(k, &simulation.at(end)).is_break() {
            end_reason = Some(EndReason::Enough);
            break;
        }
    }
    if let Some(EndReason::Stalled(stall)) = &end_reason {
        end = stall.time.clamp(end, instants.until);
    }
    impacts.retain(|impact| impact.time <= end);
    Ok(Sampled { end, end_reason, impacts, tallies: simulation.tallies() })
}

/// Runs to `until` (s) and reads nothing: what a run costs by itself. False if it stalls before.
///
/// # Errors
/// If `go_on` returns false.
pub(super) fn run_through(simulation: &mut Simulation, until: f64, go_on: GoOn) -> Result<bool, Interrupted> {
    Pace::new(Budget::UNLIMITED).reach(simulation, until, go_on).map(|end_reason| end_reason.is_none())
}

/// Work in slices that are neither so long that an interrupt waits nor so short that asking takes the time.
pub(super) struct Pace {
    slices: Slices,
    spent: u64,
    budget: Budget,
    since: Watch,
}

impl Pace {
    pub(super) fn new(budget: Budget) -> Pace {
        Pace { slices: Slices::of(SLICE), spent: 0, budget, since: Watch::start() }
    }

    /// Advances until a frame holds `time` (s); says so if it cannot.
    pub(super) fn reach(
        &mut self,
        simulation: &mut Simulation,
        time: f64,
        go_on: GoOn,
    ) -> Result<Option<EndReason>, Interrupted> {
        let (mut interrupted, mut before) = (false, None);
        let end = simulation.run_to(time, |run| {
            let now = self.since.wall();
            if let Some(before) = before.replace(now) {
                self.spent += self.slices.work();
                self.slices.learn(now - before);
            }
            interrupted = !go_on();
            (!interrupted && !self.is_spent(run)).then_some(self.slices.work())
        });
        match end {
            _ if interrupted => Err(Interrupted),
            Progress::Reached => Ok(None),
            Progress::Stalled(stall) => Ok(Some(EndReason::Stalled(stall))),
            Progress::Yielded => Ok(Some(EndReason::Spent)),
        }
    }

    /// Whether the budget is spent.
    pub(super) fn is_spent(&self, run: &Simulation) -> bool {
        // Slices that are not used up count by their frames: of `exact`, one an event.
        let work = self.spent.max(run.tallies().frames);
        let Tallies { rests, releases, .. } = run.tallies();
        work > self.budget.work
            || rests + releases > self.budget.changes
            || counted(run) > self.budget.counted
            || self.budget.cpu.is_finite() && self.since.cpu() > self.budget.cpu
    }
}

fn keep_impacts(simulation: &mut Simulation, impacts: &mut Vec<Impact>) {
    let events = simulation.take_events();
    let collisions = events.iter().filter(|event| event.class == Class::Collide);
    impacts.extend(collisions.map(|event| Impact { time: event.time, key: event.key() }));
}
