//! How what takes long is told to stop.

/// Asked every few milliseconds whether to go on; from several threads at once.
pub type GoOn<'a> = &'a (dyn Fn() -> bool + Sync);

/// A [`GoOn`] said no: there is no result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Interrupted;
