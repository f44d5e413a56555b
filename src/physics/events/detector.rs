//! What tells an event-driven loop when bodies next touch: by roots (`exact`) or by looking (`swept`).

use crate::physics::log::Log;
use crate::physics::model::Settings;
use crate::physics::path::Path;
use crate::physics::wall::Face;

/// When a contact is due.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Due {
    /// Seconds from now.
    pub(crate) after: f64,
    /// Whether they touch then; else they certainly do not before, and it is time to look again.
    pub(crate) sure: bool,
}

/// Which stretch of time is of interest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span {
    /// The present, s: paths begin now.
    pub(crate) now: f64,
    /// Only times below this many seconds from now matter.
    pub(crate) before: f64,
}

/// When do bodies next touch while approaching (the event rule of [`contact_time`](super::contact_time))?
pub(crate) trait Detector: std::fmt::Debug + Clone {
    /// Whether [`straight_pair`](super::contact_time::straight_pair) answers for spheres of equal acceleration.
    const SOLVES: bool;

    /// A detector with these knobs.
    fn new(settings: Settings) -> Self;
    /// A sphere of radius `r` (m) on `path`, and a wall.
    fn wall(&self, path: &Path, r: f64, face: &Face, span: Span) -> Option<Due>;
    /// Two spheres on `a` and `b` whose radii sum to `reach` (m).
    fn pair(&self, a: &Path, b: &Path, reach: f64, span: Span) -> Option<Due>;
    /// Tells the log of a frame from `start` to `end` (s) what was looked at.
    fn report(&mut self, start: f64, end: f64, log: &mut Log);
}
