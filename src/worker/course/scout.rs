//! A run that is done again while nothing else is to do, to be kept shortly before the frame that is shown.

use crate::{
    physics::{Progress, Simulation, Until},
    worker::{acting::Acting, keyframes::Kept, replay_cost::Meter},
};

/// How long a scout goes on before commands are looked at again, s.
const SCOUTING: f64 = 2e-3;

/// A run that is done again while nothing else is to do, to be kept near the frame that is shown.
#[derive(Debug)]
pub(super) struct Scout {
    run: Simulation,
    changes: usize,
    /// The frame to be kept.
    target: u64,
    /// The frame that is shown.
    pub(super) shown: u64,
    /// Counts the work of the scout.
    meter: Meter,
    /// Whether no frame is in progress.
    whole: bool,
    /// What acts over the present frame from the one before.
    acting: Acting,
}

impl Scout {
    /// A scout from a keyframe toward the frame `target`, while the frame `shown` is shown.
    pub(super) fn toward(target: u64, shown: u64, from: &Kept) -> Scout {
        let run = from.run();
        let (meter, changes, acting) = (Meter::of(&run), from.changes, from.acting.clone());
        Scout { run, changes, target, shown, meter, whole: true, acting }
    }

    /// Goes on for a while, in calls of so much work; whether it is at its end. `clock` tells the time, s.
    pub(super) fn goes_home(&mut self, work: u64, clock: impl Fn() -> f64) -> bool {
        let start = clock();
        let mut progress = Progress::Reached;
        while progress == Progress::Reached && !self.is_there() && clock() - start < SCOUTING {
            if self.whole {
                self.acting.note(&self.run);
            }
            progress = self.run.advance(Until::Frame, work);
            self.whole = progress == Progress::Reached;
        }
        self.run.take_events();
        self.is_there() || matches!(progress, Progress::Stalled(_))
    }

    fn is_there(&self) -> bool {
        self.run.tallies().frames >= self.target
    }

    /// The run at the frame to be kept, the recorded changes it includes and what acts over that frame, and the work up to
    /// there, ns; none if it has not come so far.
    pub(super) fn found(mut self) -> Option<(Simulation, (usize, Acting), u64)> {
        let work = self.meter.read(&self.run);
        self.is_there().then_some((self.run, (self.changes, self.acting), work))
    }
}
