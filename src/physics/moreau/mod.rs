//! Velocity-level time-stepping after Moreau and Jean, for crowds that settle.
//!
//! A frame of length h, never shorter: u₀ = v + h a, then one complementarity problem over everything that may touch
//! within the frame, u = u₀ + M⁻¹ Jᵀ Λ, 0 ≤ Λ ⊥ J u + c ≥ 0, then v⁺ = u, x⁺ = x + h u. There is no event and no
//! search for one: however many contacts open and close in a frame, they are one problem.
//!
//! c of a contact is gap / h, so that bodies may come as near as they are apart and no nearer: nothing overlaps but by
//! what the solver leaves undone. Bodies that approach faster than `rest_speed` rebound instead from where they are,
//! c = e v_n (Newton's law in Moreau's form, v_n at the start of the frame); against a wall they lose their share of
//! the tangential velocity first. A contact that held in the last frame does not collide. No rebound adds kinetic
//! energy to the spheres that it concerns.
//!
//! Rows are found from the free velocities and looked for again with the solution: what a struck sphere reaches in the
//! same frame becomes a row too, until nothing new is met. So nothing passes through anything at any speed. Of walls, a
//! sphere strikes one at a time: the first on its way, then what it meets on the path that this leaves it. So tiles that
//! lie level are one floor, and walls that share a point take tangential speed once. What a solver that has not converged
//! would send through a wall stays where it is for that frame, which counts as unconverged. A frame in which more pairs
//! of bodies may meet than memory is meant for is not begun: a stall that names dt.
//!
//! Sources: Moreau, Unilateral contact and dry friction in finite freedom dynamics (1988); Jean, The non-smooth contact
//! dynamics method (1999); Acary, Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 10.1 and 12.4.
//!
//! | file | owns |
//! |---|---|
//! | `run` | what the method keeps between calls |
//! | `frame` | one frame, stage by stage: search, meet, solve, look again, close |
//! | `candidates` | which bodies may touch within the frame |
//! | `contact_row` | where and when two bodies meet, and the row of the problem that this makes |
//! | `solver` | the complementarity problem of the frame |
//!
//! Begin with `run`, then `frame`.

mod candidates;
mod contact_row;
mod frame;
mod run;
mod solver;

use super::method::Description;
use super::model::Method;

pub(super) use run::Moreau;

/// What `moreau` is.
pub(super) const DESCRIPTION: Description = Description {
    method: Method::Moreau,
    summary: "velocity-level time-stepping (Moreau–Jean): each frame solves all its contacts as one complementarity \
              problem, looking ahead by the gap",
    order: "first in dt: position error g·t·dt/2 per free flight, and an impact comes up to dt early",
    source: "Moreau 1988; Jean 1999; Acary, Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, ch. 10, 12",
    knobs: "dt sets the error; tolerance is the solver's: a contact may close by tolerance·(rest_speed + |a|·dt + its \
            closing speed) too fast, and overlap by tolerance·r at most (above 0.1 it counts as 0.1)",
    avoid: "for times and orders of impacts and for chains of them (all impacts of a frame are one: no Newton's \
            cradle), and where energy must last: at e = 1 and dt 0.001 that of bouncing-49 sways by 1e-3 and that of \
            elastic-666 by 5e-3 (dt 0.01: 1e-2 and 3e-2)",
};
