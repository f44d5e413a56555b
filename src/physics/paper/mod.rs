//! The source paper's method, as printed (source: paper 2.1–2.4).
//!
//! A frame is `Forward(dt)`: P += (ΣF_constant + support) h + J, v = P / m, x += v h, with J the impulses of the
//! contacts met at the end of the frame before. J acts in full however short the frame is, and is cleared with it;
//! support acts for the frame's real length. Then the overlap test; if something overlaps by more than the tolerance
//! and the printed slack of 1e-4, the collision time is searched by bisection, and the frame ends there: it has lasted
//! only t_c, and time is counted truly. All responses of a frame are computed from the same velocities, walls before
//! pairs, and act during the next.
//!
//! Where the printed method cannot run, the smallest fix:
//! - A resting v_n is kept as printed: the sphere goes on sinking, reaches the tolerance, and the search returns steps
//!   that shrink for ever. Here a resting v_n becomes 0.
//! - As printed, a support force cancels the normal component of whatever acts, so that a ceiling would hold a sphere.
//!   Here it cancels only what presses, and a contact that nothing presses does not rest unless it still approaches.
//! - The printed degree of a wall uses the distance to its plane, which jumps at edges and has no root there. Here it
//!   uses the closest point, and knows on which side of the wall the frame began.
//! - The search stops when no time lies between its ends, and then accepts the later one.
//! - Tolerances above 0.5 count as 0.5.
//!
//! What the print leaves open, or has in it, and what it does:
//! - Each trial of the bisection is one step from the frame's start. The print's recursion goes on from the middle of the
//!   bracket; two half steps of Euler's are not one whole step, so a program that recurses in place differs by
//!   g h²/4 per search (up to 0.14 m after 20 s in scenes 1 and 3).
//! - What presses is gravity and constant forces, as the print says of the support force; impulses that wait to act in the
//!   same frame do not press. A program that counts them differs (by 0.63 m after 20 s in scene 1).
//! - Several contacts of a sphere in one frame are all answered from its velocity before any of them, as printed. Their
//!   sum can create energy: two light spheres struck at once by a third each take what one alone would take.
//!
//! [`DEVIATIONS`] says all this in `carom methods`.
//!
//! A contact that is already deeper than the tolerance when a frame begins (the tolerance was lowered) may stay as
//! deep as it is until it separates. All that follows is a function of t, x, v, the pending impulses and the settings,
//! so that a run can be continued from those, bit for bit.
//!
//! | file | owns |
//! |---|---|
//! | `run`, `engine` | what the method keeps between calls; the method as the simulation drives it |
//! | `frame` | one frame: opened, ended by dt or by the search for the collision time, closed |
//! | `trial_step` | a trial state: `Forward(h)` from the frame's start, and the overlaps there |
//! | `response`, `kicks` | the responses to the overlaps; what acts on single spheres in the next frame |
//! | `free_frames` | frames in which nothing touches |
//! | `stalls`, `watchdog` | what ends a run that cannot go on; whether frames go on bringing time |
//!
//! Begin with `run`, then `frame`.

mod engine;
mod frame;
mod free_frames;
mod kicks;
mod response;
mod run;
mod stalls;
mod trial_step;
mod watchdog;

use super::method::Description;
use super::model::Method;

pub(super) use run::{Paper, SLACK};

/// What `paper` is.
pub(super) const DESCRIPTION: Description = Description {
    method: Method::Paper,
    summary: "the source paper as printed: Euler frames, an overlap test at their end, bisection of the first \
              collision, responses as forces over the next frame",
    order: "first in dt: position error g·t·dt/2 per free flight, energy lost g²·dt/2 watts per kilogram in flight",
    source: "\"Rigid Body Simulation\", Assignment 5, Yang Hongdi",
    knobs: "dt sets the error; tolerance is the overlap accepted (1e-4 more than it says), irrelevant below 10 dt",
    avoid: "for fast spheres (they tunnel once v·dt exceeds 2r), for rest in wedges and stacks (it stalls), where a \
            sphere is struck by several at once (energy can rise), and where energy must last",
};

/// Where it is not the paper to the letter, and what of the letter to know of.
pub(super) const DEVIATIONS: &[&str] = &[
    "a resting contact's normal speed becomes 0 (printed: it is kept, the sphere sinks, and the search never ends)",
    "the degree of a wall is measured to its closest point (printed: to its plane, which jumps at edges)",
    "a wall is left on the side on which the frame began, so that a search never ends behind it",
    "time counts what a frame has really lasted: it ends at the collision, after t_c instead of dt",
    "each trial of the bisection is one step from the frame's start; two half steps would not be one whole step, so that \
     a program which goes on from the middle is up to 0.14 m off after 20 s of scenes 1 and 3",
    "the search ends when no time lies between its ends, and takes the later one; tolerances above 0.5 count as 0.5",
    "support cancels only what presses (printed: whatever acts, so that a ceiling would hold a sphere)",
    "what presses is gravity and constant forces alone, not the impulses that wait to act in the same frame; counting them \
     too is 0.63 m off after 20 s of scene 1",
    "as printed, all contacts of a frame are answered from the same velocities: several at once can create energy \
     (the break of billiard gains 42 % by dt 0.01)",
    "an overlap deeper than a tolerance that was lowered may stay until the contact separates",
];
