//! Which way a view looks.

/// The two projections.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// x right, y up.
    Side,
    /// x right, z down the screen.
    Top,
}
