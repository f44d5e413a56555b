//! What impacts have led to so far: at this instant, and in rows of small bounces.

use super::chattering::Chatter;
use super::instant::Instant;
use super::last_impacts::LastImpacts;
use crate::physics::model::Model;

/// Memory that an entry of a map by contacts takes, bytes, with what is free beside it.
const BYTES_AN_ENTRY: usize = 128;

/// What impacts have led to: chains at this instant, and rows of small bounces.
#[derive(Debug, Clone)]
pub(crate) struct Impacts {
    /// What happened without the clock advancing.
    pub(crate) instant: Instant,
    /// Small bounces of some contacts.
    pub(crate) chatter: Chatter,
    /// The last impacts, which may repeat a round.
    pub(super) last: LastImpacts,
}

impl Impacts {
    /// A memory without impacts.
    pub(crate) fn new(model: &Model) -> Impacts {
        Impacts { instant: Instant::default(), chatter: Chatter::new(model), last: LastImpacts::default() }
    }

    /// Memory that it takes beside its own size, bytes, as near as the numbers of its entries tell.
    pub(crate) fn bytes(&self) -> usize {
        BYTES_AN_ENTRY * (self.instant.entries() + self.chatter.entries())
    }
}
