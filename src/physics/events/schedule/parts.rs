//! What the schedule consists of, and the next event of all.

use super::candidates::Candidates;
use super::cells::Cells;
use super::entry::event_order;
use super::prefetch::Prefetch;
use super::queue::Queue;
use super::simd::Simd;
use super::ties::Ties;
use super::wear::Wear;
use crate::physics::events::islands::resting::Rests;
use crate::physics::events::trajectories::Trajectories;

/// When the next event of every sphere is, and what finds it. The plans it makes are kept in the spheres' records, with the
/// cells they are in: nothing else writes those.
#[derive(Debug, Clone)]
pub(crate) struct Schedule<D> {
    /// What tells when bodies next touch.
    pub(crate) detector: D,
    /// Gaps computed since the log was last told.
    pub(crate) evaluations: u64,
    /// Times of the next events, by slot.
    pub(crate) queue: Queue,
    /// The earliest event and the slot it is entered for, as long as nothing has changed since it was looked up.
    pub(super) next: Option<(f64, usize)>,
    pub(super) ties: Ties,
    /// Where neighbours are looked up; none for few spheres: each looks at all others.
    pub(crate) cells: Option<Box<Cells>>,
    /// Scratch buffer for candidate lists.
    pub(super) candidates: Box<Candidates>,
    pub(super) wear: Wear,
    prefetch: Prefetch,
    pub(super) simd: Simd,
}

impl<D> Schedule<D> {
    /// A schedule of `spheres` spheres at time `t` (s) without events and without cells.
    pub(crate) fn new(detector: D, spheres: usize, t: f64) -> Schedule<D> {
        Schedule {
            detector,
            evaluations: 0,
            queue: Queue::new(spheres),
            next: None,
            ties: Ties::none(),
            cells: None,
            candidates: Box::new(Candidates::empty()),
            wear: Wear::new(spheres, t),
            prefetch: Prefetch::default(),
            simd: Simd::new(),
        }
    }

    /// Memory that it takes beside its own size, bytes, as near as its parts tell.
    pub(crate) fn bytes(&self) -> usize {
        let cells = self.cells.as_ref().map_or(0, |cells| cells.bytes());
        self.queue.bytes() + self.candidates.bytes() + cells
    }

    /// The earliest event (s) and the slot it is entered for; slot 0 if nothing ever happens.
    #[inline]
    pub(crate) fn take_next(&mut self, trajectories: &Trajectories, rests: &Rests) -> (f64, usize) {
        if let Some(next) = self.next.take() {
            return next;
        }
        match self.queue.earliest() {
            (f64::INFINITY, _) => (f64::INFINITY, 0),
            (time, Some(slot)) => (time, slot),
            (time, None) => {
                let order = |slot: usize| event_order(trajectories, rests, time, slot);
                (time, self.ties.first(&self.queue, time, order))
            }
        }
    }

    /// Puts back the event that was taken: it is still the next one.
    pub(crate) fn put_back(&mut self, next: (f64, usize)) {
        self.next = Some(next);
    }

    /// Forgets what was looked up: slots, or entries of many of them, have changed.
    pub(super) fn forget(&mut self) {
        self.next = None;
        self.ties = Ties::none();
    }

    /// Asks for the memory that the next events will read; called at every event.
    #[inline]
    pub(crate) fn prefetch(&mut self, trajectories: &Trajectories) {
        if Prefetch::pays(trajectories.records.len())
            && let Some(cells) = &self.cells
        {
            self.prefetch.look_ahead(trajectories, &self.queue, cells, self.simd);
        }
    }

    /// Whether it is time to ask whether the cells still fit.
    #[inline(always)]
    pub(crate) fn is_worn(&self) -> bool {
        self.wear.is_worn()
    }
}
