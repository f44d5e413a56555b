//! The spheres near another one.

use super::simd::{BATCHES, PairBatch};

/// More candidates than the 27 cells around a sphere hold without overflow.
pub(crate) const MOST_CANDIDATES: usize = 128;

/// Room for [`MOST_CANDIDATES`], one more cell and padding to four.
pub(crate) const ROOM: usize = MOST_CANDIDATES + 8;

/// Slots of the spheres that a sphere may meet, its own among them, and what was found out about each.
#[derive(Debug, Clone)]
pub(crate) struct Candidates {
    /// Slots of the candidates; at least [`ROOM`] long.
    pub(crate) slots: Vec<u32>,
    /// Number of `slots` that count.
    pub(crate) count: usize,
    /// Room to look at the candidates four at a time.
    pub(crate) batches: Box<[PairBatch; BATCHES]>,
}

impl Candidates {
    /// No candidates.
    pub(crate) fn empty() -> Candidates {
        Candidates { slots: vec![0; ROOM], count: 0, batches: Box::new([PairBatch::NEVER; BATCHES]) }
    }

    /// Memory that the candidates take, bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<Candidates>() + size_of_val(&*self.slots) + size_of_val(&*self.batches)
    }

    /// The slots of the candidates.
    #[inline]
    pub(crate) fn slots(&self) -> &[u32] {
        &self.slots[..self.count]
    }

    /// The slots of the candidates, made up to a multiple of four by `slot`, and the room to look at them.
    #[inline]
    pub(crate) fn padded(&mut self, slot: usize) -> (&[u32], &mut [PairBatch; BATCHES]) {
        self.slots[self.count..self.count + 4].fill(slot as u32);
        (&self.slots[..self.count.next_multiple_of(4)], &mut self.batches)
    }

    /// Lists all of `slots` slots.
    pub(crate) fn all(&mut self, slots: usize) {
        self.slots.resize(self.slots.len().max(slots + 5), 0);
        (0_u32..).zip(&mut self.slots[..slots]).for_each(|(slot, entry)| *entry = slot);
        self.count = slots;
    }

    /// Lists one slot more.
    pub(crate) fn push(&mut self, slot: u32) {
        self.slots[self.count] = slot;
        self.count += 1;
        if self.count + 5 > self.slots.len() {
            self.slots.resize(2 * self.slots.len(), 0);
        }
    }
}
