//! Events of one instant, in their order. A layer that falls meets the floor all at once and crosses into its next cubes
//! all at once: to look for the first of so many again after each would be quadratic.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::prediction::EventOrder;
use crate::physics::events::detector::Detector;
use crate::physics::events::engine::EventDriven;

/// Seats with an event at one time, the first on top. What has changed since it was put in is noticed when it comes up.
#[derive(Debug, Clone)]
pub(crate) struct Ties {
    /// s; no number while there are none.
    time: f64,
    heap: BinaryHeap<Reverse<(EventOrder, u32)>>,
}

impl Ties {
    /// None.
    pub(crate) fn none() -> Ties {
        Ties { time: f64::NAN, heap: BinaryHeap::new() }
    }
}

impl<D: Detector> EventDriven<D> {
    /// The earliest event and the seat it is entered for; seat 0 if nothing ever happens.
    pub(crate) fn first(&mut self) -> (f64, usize) {
        match self.queue.earliest() {
            (f64::INFINITY, _) => (f64::INFINITY, 0),
            (time, Some(seat)) => (time, seat),
            (time, None) => (time, self.first_of_ties(time)),
        }
    }

    #[cold]
    fn first_of_ties(&mut self, time: f64) -> usize {
        if self.ties.time != time {
            self.collect_ties(time);
        }
        loop {
            if self.ties.heap.is_empty() {
                self.collect_ties(time);
            }
            // none only if the time is no number
            let Some(&Reverse((rank, seat))) = self.ties.heap.peek() else { return 0 };
            let seat = seat as usize;
            let due = self.queue.time_of(seat) == time;
            let now = self.rank(time, seat);
            if due && now == rank {
                return seat;
            }
            self.ties.heap.pop();
            if due {
                self.ties.heap.push(Reverse((now, seat as u32)));
            }
        }
    }

    fn collect_ties(&mut self, time: f64) {
        let mut ties = Vec::new();
        self.queue.each_at(time, |seat| ties.push(Reverse((self.rank(time, seat), seat as u32))));
        self.ties = Ties { time, heap: ties.into() };
    }

    /// An event has been entered for a seat at `time`, s.
    #[inline(always)]
    pub(crate) fn tie(&mut self, seat: usize, time: f64) {
        if time == self.ties.time {
            self.enter_tie(seat, time);
        }
    }

    #[cold]
    fn enter_tie(&mut self, seat: usize, time: f64) {
        let rank = self.rank(time, seat);
        self.ties.heap.push(Reverse((rank, seat as u32)));
    }

    /// Seats have changed: what is known by them is void.
    pub(crate) fn forget_ties(&mut self) {
        self.ties = Ties::none();
    }
}
