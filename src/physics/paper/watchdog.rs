//! The watchdog's memory: whether frames go on bringing time.

use glam::DVec3;

use crate::physics::contact::Class;
use crate::physics::log::Log;

/// Least mean progress, in units of dt, of frames cut short with an impact: a gas of a million spheres makes 1e-4.
const STRUCK_PACE: f64 = 1e-6;

/// Least mean progress, in units of dt, of frames cut short without any impact: a landing needs a few tens of frames.
const QUIET_PACE: f64 = 1e-2;

/// The watchdog's memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Watchdog {
    /// When the present count began, s.
    pub(super) since: f64,
    /// Frames cut short by a search since then.
    pub(super) cut: u64,
    /// Time that the frames cut short should have brought at least, s.
    pub(super) owed: f64,
    /// Whether some frame brought no time at all.
    pub(super) stuck: bool,
}

impl Watchdog {
    /// A memory that begins to count at `time`, s.
    pub(super) fn at(time: f64) -> Watchdog {
        Watchdog { since: time, cut: 0, owed: 0.0, stuck: false }
    }

    /// The count as a row of a run's transient.
    pub(super) fn row(&self) -> DVec3 {
        DVec3::new(self.since, self.cut as f64, self.owed)
    }

    /// The count that a row tells of.
    pub(super) fn of_row(row: DVec3) -> Watchdog {
        // a file may say any number, and counting must be able to go on from it
        Watchdog { since: row.x, cut: (row.y as u64).min(1 << 52), owed: row.z, stuck: false }
    }

    /// Counts a frame of `elapsed` (s), of at most `dt` (s), that was or was not `cut` short by a search.
    pub(super) fn note(&mut self, elapsed: f64, cut: bool, dt: f64, log: &Log) {
        self.stuck |= elapsed <= 0.0;
        if cut {
            let struck = log.contacts.iter().any(|c| c.class == Class::Collide);
            self.cut += 1;
            self.owed += dt * if struck { STRUCK_PACE } else { QUIET_PACE };
        }
    }
}
