pub(super) mod arc;
pub(super) mod bodies;
mod equation;
mod hermite;
