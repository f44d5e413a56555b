//! Events of one instant, in their order. A layer that falls meets the floor all at once and crosses into its next cells
//! all at once: to look for the first of so many again after each would be quadratic.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::entry::EventOrder;
use super::queue::Queue;

/// Slots with an event at one time, the first on top. What has changed since it was put in is noticed when it comes up.
#[derive(Debug, Clone)]
pub(crate) struct Ties {
    /// Time of the events, s; NaN while there are none.
    time: f64,
    heap: BinaryHeap<Reverse<(EventOrder, u32)>>,
}

impl Ties {
    /// No events.
    pub(crate) fn none() -> Ties {
        Ties { time: f64::NAN, heap: BinaryHeap::new() }
    }

    /// The slot of the first of the events at `time` (s), the queue's earliest, which several slots have; `order` is that
    /// of a slot's event.
    #[cold]
    pub(crate) fn first(&mut self, queue: &Queue, time: f64, order: impl Fn(usize) -> EventOrder) -> usize {
        if self.time != time {
            self.collect(queue, time, &order);
        }
        loop {
            if self.heap.is_empty() {
                self.collect(queue, time, &order);
            }
            let &Reverse((known, slot)) = self.heap.peek().expect("the earliest time is some slot's");
            let slot = slot as usize;
            let due = queue.time_of(slot) == time;
            let now = order(slot);
            if due && now == known {
                return slot;
            }
            self.heap.pop();
            if due {
                self.heap.push(Reverse((now, slot as u32)));
            }
        }
    }

    fn collect(&mut self, queue: &Queue, time: f64, order: &impl Fn(usize) -> EventOrder) {
        let mut ties = Vec::new();
        queue.each_at(time, |slot| ties.push(Reverse((order(slot), slot as u32))));
        *self = Ties { time, heap: ties.into() };
    }

    /// Whether an event at `time` (s) is one of those that are known here, so that it has to be entered.
    #[inline(always)]
    pub(crate) fn are_at(&self, time: f64) -> bool {
        time == self.time
    }

    /// Enters an event at the time of those that are known here.
    pub(crate) fn enter(&mut self, slot: usize, order: EventOrder) {
        self.heap.push(Reverse((order, slot as u32)));
    }
}
