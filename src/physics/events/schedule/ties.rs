//! Events of one instant, in their order. A layer that falls meets the floor all at once and crosses into its next cells
//! all at once: to look for the first of so many again after each would be quadratic.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::entry::EventOrder;
use super::queue::Queue;

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

    /// The seat of the first of the events at `time` (s), the queue's earliest, which several seats have; `order` is that of
    /// a seat's event.
    #[cold]
    pub(crate) fn first(&mut self, queue: &Queue, time: f64, order: impl Fn(usize) -> EventOrder) -> usize {
        if self.time != time {
            self.collect(queue, time, &order);
        }
        loop {
            if self.heap.is_empty() {
                self.collect(queue, time, &order);
            }
            let &Reverse((known, seat)) = self.heap.peek().expect("the earliest time is some seat's");
            let seat = seat as usize;
            let due = queue.time_of(seat) == time;
            let now = order(seat);
            if due && now == known {
                return seat;
            }
            self.heap.pop();
            if due {
                self.heap.push(Reverse((now, seat as u32)));
            }
        }
    }

    fn collect(&mut self, queue: &Queue, time: f64, order: &impl Fn(usize) -> EventOrder) {
        let mut ties = Vec::new();
        queue.each_at(time, |seat| ties.push(Reverse((order(seat), seat as u32))));
        *self = Ties { time, heap: ties.into() };
    }

    /// Whether an event at `time` (s) is one of those that are known here, so that it has to be entered.
    #[inline(always)]
    pub(crate) fn are_at(&self, time: f64) -> bool {
        time == self.time
    }

    /// Enters an event at the time of those that are known here.
    pub(crate) fn enter(&mut self, seat: usize, order: EventOrder) {
        self.heap.push(Reverse((order, seat as u32)));
    }
}
