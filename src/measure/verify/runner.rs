//! Where a known result is measured: how thoroughly, how a run is advanced there, and what comes out.

use std::fmt;

use crate::measure::interrupt::{GoOn, Interrupted};
use crate::physics::{Progress, Simulation, State};
use crate::scene;

/// Slices after which a run counts as one that never ends: ten times what the longest one here needs.
const MOST_SLICES: u64 = 2_000;

/// How thorough the measurements are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Seconds: fewer digits, fewer spheres.
    Quick,
    /// Minutes.
    Whole,
}

/// One known result, measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// What was measured.
    pub what: String,
    /// Unit of `expected` and `found`; empty if they are pure numbers.
    pub unit: &'static str,
    /// What the source says.
    pub expected: f64,
    /// What was found; not a number if there was nothing to be found.
    pub found: f64,
    /// Largest error that passes; see the check's note for the reason.
    pub allowed: f64,
}

impl Row {
    /// A row of these values, all in `unit`.
    pub(super) fn new(what: impl Into<String>, unit: &'static str, [expected, found]: [f64; 2], allowed: f64) -> Row {
        Row { what: what.into(), unit, expected, found, allowed }
    }

    /// |found − expected|, relative to what is expected unless that is 0.
    pub fn error(&self) -> f64 {
        let off = (self.found - self.expected).abs();
        if self.expected == 0.0 { off } else { off / self.expected.abs() }
    }

    /// Whether the error is allowed.
    pub fn passes(&self) -> bool {
        self.error() <= self.allowed
    }
}

/// Why a measurement has no result.
#[derive(Debug, Clone, PartialEq)]
pub enum Trouble {
    /// The method gave up, or the scene was refused: a full sentence.
    Failed(String),
    /// The measurement was told not to go on.
    Interrupted,
}

impl From<Interrupted> for Trouble {
    fn from(_: Interrupted) -> Trouble {
        Trouble::Interrupted
    }
}

impl From<scene::Error> for Trouble {
    fn from(error: scene::Error) -> Trouble {
        Trouble::Failed(error.to_string())
    }
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Trouble::Failed(sentence) => f.write_str(sentence),
            Trouble::Interrupted => f.write_str("It was interrupted."),
        }
    }
}

/// How thoroughly to measure, and whether to go on.
#[derive(Clone, Copy)]
pub struct Runner<'a> {
    depth: Depth,
    go_on: GoOn<'a>,
}

impl fmt::Debug for Runner<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Runner").field("depth", &self.depth).finish_non_exhaustive()
    }
}

impl<'a> Runner<'a> {
    /// A place to measure at this depth, as long as `go_on` says so.
    pub fn new(depth: Depth, go_on: GoOn<'a>) -> Runner<'a> {
        Runner { depth, go_on }
    }

    /// What says whether to go on.
    pub(super) fn go_on(&self) -> GoOn<'a> {
        self.go_on
    }

    /// One of two values, by depth.
    pub(super) fn pick<T>(&self, quick: T, whole: T) -> T {
        match self.depth {
            Depth::Quick => quick,
            Depth::Whole => whole,
        }
    }

    /// Advances until a frame holds `until` (s); the state then.
    ///
    /// # Errors
    /// If the run stalls or never gets there, or it is not to go on.
    pub(super) fn go(&self, run: &mut Simulation, until: f64) -> Result<State, Trouble> {
        let (mut slices, mut interrupted) = (0, false);
        let end = run.run_to(until, |_| {
            interrupted = !(self.go_on)();
            slices += 1;
            (!interrupted && slices <= MOST_SLICES).then_some(Simulation::SLICE)
        });
        match end {
            Progress::Reached => Ok(run.at(until)),
            Progress::Stalled(stall) => Err(Trouble::Failed(stall.reason)),
            Progress::Yielded if interrupted => Err(Interrupted.into()),
            Progress::Yielded => {
                let (now, work) = (run.time(), Simulation::SLICE * MOST_SLICES);
                let sentence =
                    format!("After {work} units of work the run is still at {now} s on its way to {until} s.");
                Err(Trouble::Failed(sentence))
            }
        }
    }
}
