//! What the judge is shown.

use crate::physics::{Contact, State};

/// What a frame has left behind.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// The state at the end of the frame.
    pub state: &'a State,
    /// The frame's contacts, in the order in which they were handled.
    pub contacts: &'a [Contact],
    /// The events told since the frame before.
    pub events: &'a [Contact],
    /// Energy that the state does not show, J: [`Simulation::hidden_energy`](crate::physics::Simulation::hidden_energy).
    pub hidden: f64,
}
