//! The paper's idea made sound: what is simple about it is kept (frames, trial steps, a tolerance that the user chooses),
//! what breaks it is not.
//!
//! Flight is ballistic, x += v h + a h²/2 from each sphere's own last event, so that dt leaves the error: it sets the
//! frames that are shown and nothing else. A contact is searched over the whole flight instead of at the end of a step, so
//! that nothing tunnels at any speed: the search steps only as far as no overlap deeper than half the tolerance can be, and
//! halves a step that rounding has made too long (`advancement`). Responses come one after the other, and what rests is
//! held up island by island, as in every method that knows the order of its events.
//!
//! All of it is the engine of `events` but for `advancement`, the search for a contact, and `separation`, what a look at
//! two bodies sees.

mod advancement;
mod separation;

use super::events::resumable::Resumable;
use super::method::Description;
use super::model::Method;
use advancement::ConservativeAdvancement;

/// A run by `swept`.
pub(super) type Swept = Resumable<ConservativeAdvancement>;

/// What `swept` is.
pub(super) const DESCRIPTION: Description = Description {
    method: Method::Swept,
    summary: "ballistic frames; the first contact searched over the whole flight by safe steps and bisection, accepted \
              at an overlap within the tolerance; impulses one after the other, resting islands",
    order: "first in the tolerance: an impact is late by up to tolerance·r/(2·approach speed); none in dt",
    source: "Mirtich 1996, ch. 2 (conservative advancement, collisions in a heap); Lin 1993; the source paper's \
             bisection; complementarity of resting islands",
    knobs: "tolerance sets the error, down to rounding at 0; dt only sets the frames, which cost a little each",
    avoid: "crowds that settle with restitution below 1: their contacts come ever faster; and where exact is as cheap",
};
