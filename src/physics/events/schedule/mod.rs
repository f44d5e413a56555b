//! The schedule: what happens next to every sphere, and which of it is the first.
//!
//! [`parts`] holds its state; the loop calls it about six ways: take the next event, predict a sphere, let one cross into
//! the next cell, ask for memory, review the cells, read the queue's time.
//!
//! | file | what |
//! |---|---|
//! | `prediction` | the plan of one sphere, and its entry in the queue |
//! | `search` | the search for its next contact, with walls and with the spheres near it |
//! | `entry` | what an entry stands for, and its place among those of one time |
//! | `queue`, `ties` | the earliest of all; several at one time |
//! | `cells`, `candidates` | which spheres and walls are near |
//! | `simd` | four pairs, eight times at once, where the processor can |
//! | `prefetch`, `locality` | memory: asked for ahead, and laid out by place |
//! | `wear`, `upkeep` | when the cells no longer fit, and what is done then |
//!
//! Results do not depend on `simd`, `prefetch` and `locality`, which is tested: they are there for speed alone.

pub(super) mod candidates;
pub(super) mod cells;
pub(super) mod entry;
mod locality;
pub(super) mod parts;
mod prediction;
mod prefetch;
mod queue;
mod search;
mod simd;
mod ties;
mod upkeep;
mod wear;
