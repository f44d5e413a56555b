//! What the two knobs, dt and tolerance, do in a method: data for whoever tries settings.

use super::Method;

/// What turning a knob changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// Nothing: the method has no such knob.
    Nothing,
    /// The cost alone.
    Cost,
    /// The error, and with it the cost.
    Error,
}

/// What the knobs of a method do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Knobs {
    /// The longest step.
    pub dt: Effect,
    /// The tolerance.
    pub tolerance: Effect,
}

/// What the knobs of a method do.
pub const fn knobs(method: Method) -> Knobs {
    match method {
        Method::Paper | Method::Moreau => Knobs { dt: Effect::Error, tolerance: Effect::Error },
        Method::Swept => Knobs { dt: Effect::Cost, tolerance: Effect::Error },
        Method::Exact => Knobs { dt: Effect::Nothing, tolerance: Effect::Nothing },
    }
}
