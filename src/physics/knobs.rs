//! Which of the two knobs, dt and tolerance, a method listens to.

use super::Method;

/// Which settings change what a method computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Knobs {
    /// Whether the longest step matters, be it for the error or for the cost.
    pub dt: bool,
    /// Whether the tolerance matters.
    pub tolerance: bool,
}

/// The knobs of a method: a setting that it does not listen to need not be tried twice.
pub fn knobs(method: Method) -> Knobs {
    match method {
        Method::Exact => Knobs { dt: false, tolerance: false },
        _ => Knobs { dt: true, tolerance: true },
    }
}
