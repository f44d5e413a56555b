//! The spheres near another one.

use super::simd::{BATCHES, PairBatch};

/// What the 27 cells around a sphere hold without overflow is fewer than this.
pub(crate) const MOST_CANDIDATES: usize = 128;

/// Room for that, one more cell and padding to four.
pub(crate) const ROOM: usize = MOST_CANDIDATES + 8;

/// Slots of the spheres that a sphere may meet, its own among them, and what was found out about each.
#[derive(Debug, Clone)]
pub(crate) struct Candidates {
    /// At least [`ROOM`] long.
    pub(crate) slots: Vec<u32>,
    /// How many of `slots` count.
    pub(crate) count: usize,
    /// Room to look at them four at a time.
    pub(crate) batches: Box<[PairBatch; BATCHES]>,
}

impl Candidates {
    /// None.
    pub(crate) fn empty() -> Candidates {
        Candidates { slots: vec![0; ROOM], count: 0, batches: Box::new([PairBatch::NEVER; BATCHES]) }
    }

    /// Memory that they take, bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<Candidates>() + size_of_val(&*self.slots) + size_of_val(&*self.batches)
    }

    /// Their slots.
    #[inline]
    pub(crate) fn slots(&self) -> &[u32] {
        &self.slots[..self.count]
    }

    /// Their slots, made up to a multiple of four by `slot`, and the room to look at them.
    #[inline]
    pub(crate) fn padded(&mut self, slot: usize) -> (&[u32], &mut [PairBatch; BATCHES]) {
        self.slots[self.count..self.count + 4].fill(slot as u32);
        (&self.slots[..self.count.next_multiple_of(4)], &mut self.batches)
    }

    /// Lists all of so many slots.
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
