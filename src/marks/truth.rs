//! What `exact` says, up to where it is certified: states at any time, in order, and impacts.

use super::observer::Seen;
use crate::physics::{Class, Progress, Simulation, State};
use crate::scene::{Method, Scene, Settings};

/// Impacts of a run that are kept; beyond, none are compared.
const MOST_IMPACTS: usize = 100_000;

/// A run by `exact` read in the order of time.
#[derive(Debug)]
pub(super) struct Truth {
    run: Simulation,
    /// Time up to which the run may be asked, s.
    pub(super) until: f64,
    pub(super) impacts: Vec<Seen>,
}

impl Truth {
    pub(super) fn new(scene: &Scene, until: f64) -> Truth {
        let settings = Settings { method: Method::Exact, dt: scene.duration.max(f64::MIN_POSITIVE), tolerance: 0.0 };
        let mut run = Simulation::new(scene, settings);
        run.record_events(true);
        Truth { run, until, impacts: Vec::new() }
    }

    /// The state at `t` (s), not before the last one asked for; none beyond where it may be asked, or if `go_on` says no.
    pub(super) fn at(&mut self, t: f64, go_on: &dyn Fn() -> bool) -> Option<State> {
        if t > self.until {
            return None;
        }
        let progress = self.run.run_to(t, |_| go_on().then_some(Simulation::SLICE));
        let collisions = self.run.take_events().into_iter().filter(|row| row.class == Class::Collide);
        let room = MOST_IMPACTS.saturating_sub(self.impacts.len());
        self.impacts.extend(
            collisions.map(|row| Seen { key: row.key(), time: row.time, approach: row.approach_speed }).take(room),
        );
        match progress {
            Progress::Reached => Some(self.run.at(t)),
            Progress::Yielded => None,
            Progress::Stalled(stall) => {
                self.until = self.until.min(stall.time);
                None
            }
        }
    }
}
