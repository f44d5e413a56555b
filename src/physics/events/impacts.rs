//! What impacts have led to so far: at this instant, and in rows of small bounces.

use super::chattering::Chatter;
use super::instant::Instant;
use crate::physics::model::Model;

/// The memory of impacts.
#[derive(Debug, Clone)]
pub(crate) struct Impacts {
    /// What happened without the clock advancing.
    pub(crate) instant: Instant,
    /// Small bounces of some contacts.
    pub(crate) chatter: Chatter,
}

impl Impacts {
    /// None yet.
    pub(crate) fn new(model: &Model) -> Impacts {
        Impacts { instant: Instant::default(), chatter: Chatter::new(model) }
    }
}
