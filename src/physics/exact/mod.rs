//! The event-driven method: no time step. Between events every sphere moves on a parabola; the next event is computed,
//! not searched for by stepping. The yardstick of the other methods.
//!
//! All of it is the engine of `events` but for `root_detector`: contact times as roots of polynomials.

pub(super) mod root_detector;

use super::events::resumable::Resumable;
use super::method::Description;
use super::model::Method;
use root_detector::RootDetector;

/// A run by `exact`.
pub(super) type Exact = Resumable<RootDetector>;

/// What `exact` is.
pub(super) const DESCRIPTION: Description = Description {
    method: Method::Exact,
    summary: "event-driven: parabolas between contacts whose times are roots of polynomials; no time step",
    order: "exact up to rounding; curved rest (on edges, corners and other spheres) is integrated to 1e-12, and bounces \
            across less than 1e-7 r that others keep from dying out rest after a hundred",
    source: "Lubachevsky 1991; event rule of Bannerman et al. 2014; complementarity of resting islands",
    knobs: "none: dt only sets the frames that are shown, the tolerance is not used",
    avoid: "crowds that settle with restitution below 1: their events come ever faster (of fifty spheres that fall into a \
            box half a second takes 0.3 s of the processor at most, the next half second up to 5 s; of three hundred half \
            a second takes 9 s); spheres that bounce without loss on each other in a narrow place, millions of times a second, \
            impact by impact",
};
