//! Which way a view looks.

/// The two projections.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// The side view: x right, y up.
    Side,
    /// The view from above: x right, z down the screen.
    Top,
}
