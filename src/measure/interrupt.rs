//! How long computations are interrupted.

/// Asked every few milliseconds whether to go on; from several threads at once.
pub type GoOn<'a> = &'a (dyn Fn() -> bool + Sync);

/// A [`GoOn`] returned false: there is no result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Interrupted;
