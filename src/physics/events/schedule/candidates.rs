//! Who is near a sphere.

use super::simd::{BATCHES, PairBatch};

/// What the 27 places around a sphere hold without spilling is fewer than this.
pub(crate) const MOST_NEAR: usize = 128;

/// Room for it, one more place and padding to four.
pub(crate) const ROOM: usize = MOST_NEAR + 8;

/// Seats of the spheres that a sphere may meet, its own among them, and what was found out about each.
#[derive(Debug, Clone)]
pub(crate) struct Candidates {
    pub(crate) seats: Vec<u32>,
    pub(crate) count: usize,
    /// Room to look at them four by four.
    pub(crate) fours: Box<[PairBatch; BATCHES]>,
}

impl Candidates {
    /// Nobody.
    pub(crate) fn empty() -> Candidates {
        Candidates { seats: vec![0; ROOM], count: 0, fours: Box::new([PairBatch::NEVER; BATCHES]) }
    }

    /// Who is near.
    #[inline]
    pub(crate) fn seats(&self) -> &[u32] {
        &self.seats[..self.count]
    }

    /// The same made up to fours by `seat`, and the room to look at them.
    #[inline]
    pub(crate) fn padded(&mut self, seat: usize) -> (&[u32], &mut [PairBatch; BATCHES]) {
        self.seats[self.count..self.count + 4].fill(seat as u32);
        (&self.seats[..self.count.next_multiple_of(4)], &mut self.fours)
    }

    /// All of so many seats.
    pub(crate) fn all(&mut self, seats: usize) {
        self.seats.resize(self.seats.len().max(seats + 5), 0);
        (0_u32..).zip(&mut self.seats[..seats]).for_each(|(seat, place)| *place = seat);
        self.count = seats;
    }

    pub(crate) fn push(&mut self, seat: u32) {
        self.seats[self.count] = seat;
        self.count += 1;
        if self.count + 5 > self.seats.len() {
            self.seats.resize(2 * self.seats.len(), 0);
        }
    }
}
