pub(super) mod candidates;
pub(super) mod cells;
mod locality;
pub(super) mod prediction;
pub(super) mod prefetch;
pub(super) mod queue;
pub(super) mod simd;
pub(super) mod ties;
pub(super) mod upkeep;
