//! Which frames of a run can be gone to.

/// Which frames of a run are kept: what a timeline shows beside the collisions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Kept {
    /// The first frame from which on every frame is a short way off; those before it take a run from the start.
    pub oldest: u64,
    /// Time of the frame `oldest`, s.
    pub from: f64,
    /// The newest frame.
    pub newest: u64,
    /// Time of the newest frame, s.
    pub until: f64,
    /// Whether an earlier frame than the newest is shown.
    pub is_past: bool,
}
