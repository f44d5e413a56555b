//! Curved rest: islands whose spheres slide over edges, corners or each other, and have no parabola.
//!
//! `bodies` is an island as the solvers see it; `equation` its differential equation and one step along it; `arc` a stretch
//! of the motion during which the same contacts hold, and the chords that stand for it; `ends` the bodies at
//! either end of it; `hermite` the polynomial between them.

pub(super) mod arc;
pub(super) mod bodies;
mod ends;
pub(super) mod equation;
mod hermite;
