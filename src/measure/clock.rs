//! The clocks: processor time of a thread, and wall time. Nothing else in `measure` knows of time.

use std::time::Instant;

use rustix::time::{ClockId, clock_getres, clock_gettime};

/// What has passed between two moments on one thread, s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Passed {
    /// Time that this thread has worked, s.
    pub(super) cpu: f64,
    /// Wall time, s; more than `cpu` by what the machine gave to others.
    pub(super) wall: f64,
}

impl std::ops::AddAssign for Passed {
    fn add_assign(&mut self, more: Passed) {
        self.cpu += more.cpu;
        self.wall += more.wall;
    }
}

/// A watch started on this thread, to be read on it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Watch {
    cpu: f64,
    wall: Instant,
}

impl Watch {
    pub(super) fn start() -> Watch {
        Watch { cpu: thread_cpu(), wall: Instant::now() }
    }

    pub(super) fn read(&self) -> Passed {
        Passed { cpu: self.cpu(), wall: self.wall() }
    }

    /// Time that this thread has worked since the watch was started, s. A call to the system: half a microsecond.
    pub(super) fn cpu(&self) -> f64 {
        thread_cpu() - self.cpu
    }

    /// Wall time since the watch was started, s. Cheap.
    pub(super) fn wall(&self) -> f64 {
        self.wall.elapsed().as_secs_f64()
    }
}

/// Processor time of the calling thread, s.
pub fn thread_cpu() -> f64 {
    seconds(clock_gettime(ClockId::ThreadCPUTime))
}

/// The finest difference that the processor clock can show, s.
pub(super) fn resolution() -> f64 {
    seconds(clock_getres(ClockId::ThreadCPUTime))
}

fn seconds(time: rustix::time::Timespec) -> f64 {
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}
