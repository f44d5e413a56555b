//! What tells the event engine when bodies next touch: by roots (`exact`) or by looking (`swept`).

use crate::physics::log::Log;
use crate::physics::model::Settings;
use crate::physics::path::Path;
use crate::physics::wall::Face;

/// When two bodies touch next, or are to be looked at again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Due {
    /// Time until then, s.
    pub(crate) after: f64,
    /// Whether the bodies touch then; else they certainly do not before, and it is time to look again.
    pub(crate) is_contact: bool,
}

/// Which stretch of time is of interest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span {
    /// The present, s: paths begin now.
    pub(crate) now: f64,
    /// Only times below this matter, s from now.
    pub(crate) before: f64,
}

/// When do bodies next touch while approaching (the event rule of [`contact_time`](crate::physics::contact_time))?
pub(crate) trait Detector: std::fmt::Debug + Clone {
    /// Whether pairs cost less than walls, so that they are looked at first, and walls only until the first of them.
    const PAIRS_FIRST: bool;

    /// Whether spheres of equal acceleration touch at the root that
    /// [`straight_pair`](crate::physics::contact_time::straight_pair) finds: then pairs are looked at four at a time.
    const STRAIGHT_PAIRS: bool;

    /// Whether one look at a pair, by either of its spheres, is enough: it does not end where the other meets something else.
    const ONE_LOOK: bool;

    /// A detector with these knobs.
    fn new(settings: Settings) -> Self;
    /// Takes other knobs; whether its answers change by that.
    fn retune(&mut self, settings: Settings) -> bool;
    /// Deepest overlap at rest that is taken for rounding and put right little by little, in radii: deeper ones are the scene's,
    /// or lie within the tolerance, and to lift bodies out of them would give energy that nothing has paid for.
    fn healed(&self) -> f64;
    /// When a sphere of radius `r` (m) on `path` next touches a wall while approaching it.
    fn wall(&self, path: &Path, r: f64, face: &Face, span: Span) -> Option<Due>;
    /// When two spheres on `a` and `b` whose radii sum to `reach` (m) next touch while approaching.
    fn pair(&self, a: &Path, b: &Path, reach: f64, span: Span) -> Option<Due>;
    /// Until when (s) a pair is worth a look, of which one sphere has its next contact at `mine`, the other at `theirs`.
    /// What the other meets before makes it look around anew, and find this one then.
    fn pair_horizon(mine: f64, theirs: f64) -> f64;
    /// Tells the log of a frame from `start` to `end` (s) what was looked at: `pairs` of bodies, each perhaps several
    /// times.
    fn report(&mut self, start: f64, end: f64, pairs: u64, log: &mut Log);
}
