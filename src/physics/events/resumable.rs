//! Going on bit for bit where another run was: the state at a frame's end is not enough for that.
//!
//! Between events a sphere's place is computed from its line, which began earlier, and is rounded; what will happen was
//! predicted from there, too, and islands of curved rest are in the midst of an arc. All of it follows from how the run
//! began, so that is what is kept: the run up to here is done again, in slices, when it is first asked to go on. That
//! takes as long as it took then.

use glam::DVec3;

use super::detector::Detector;
use super::engine::{EventDriven, Frame};
use crate::physics::log::Log;
use crate::physics::method::Engine;
use crate::physics::model::{Model, Settings};
use crate::physics::state::State;

/// A run that is being done again.
#[derive(Debug, Clone)]
pub(super) struct Replay<D> {
    exact: EventDriven<D>,
    log: Log,
}

/// How a run began: what all of it follows from, with the model and the settings.
#[derive(Debug, Clone)]
pub(super) enum Origin {
    /// As the model says.
    Model,
    /// From another method's state, or a resumed one.
    State(Box<State>),
    /// Settings that change the trajectory have changed since: a continuation would have to know when.
    Lost,
}

/// A state as plain vectors: (t, 0, 0), then x and v by sphere.
pub(super) fn written(state: &State) -> Vec<DVec3> {
    std::iter::once(DVec3::X * state.t).chain(state.x.iter().copied()).chain(state.v.iter().copied()).collect()
}

/// The state of `count` spheres that [`written`] wrote; none if these vectors are something else.
pub(super) fn read(vectors: &[DVec3], count: usize) -> Option<State> {
    let (first, rest) = vectors.split_first()?;
    let fits = rest.len() == 2 * count && vectors.iter().all(|vector| vector.is_finite());
    fits.then(|| State { t: first.x, x: rest[..count].to_vec(), v: rest[count..].to_vec() })
}

impl<D: Detector> Replay<D> {
    /// The run from `origin` on.
    fn new(model: &Model, settings: Settings, origin: State) -> Replay<D> {
        let mut log = Log::default();
        // frames end at impacts only: they change no bit
        let exact = EventDriven::begin(model, Settings { dt: f64::INFINITY, ..settings }, origin, &mut log);
        Replay { exact, log }
    }

    /// Goes on for about `work` events; whether everything up to `until` (s) has happened, or nothing more can.
    fn advance(&mut self, model: &Model, until: f64, work: u64) -> bool {
        let Replay { exact, log } = self;
        for _ in 0..work {
            if exact.queue.earliest().0 > until && !exact.rests.is_dirty() {
                return true;
            }
            if !exact.frame.open {
                exact.open_frame(log);
            }
            // a stall shows itself again in the next frame
            if exact.turn(model, log).is_err() {
                return true;
            }
            log.events.clear();
        }
        false
    }
}

impl<D: Detector> EventDriven<D> {
    /// Catches up with the run that this one continues, for about `work` events; whether it has.
    pub(super) fn catch_up(&mut self, model: &Model, work: u64) -> bool {
        let Some(origin) = self.resumes.take() else { return true };
        let (settings, end) = (self.settings, self.frame.time);
        let mut replay = self.replay.take().unwrap_or_else(|| Box::new(Replay::new(model, settings, origin.clone())));
        if !replay.advance(model, end, work) {
            (self.resumes, self.replay) = (Some(origin), Some(replay));
            return false;
        }
        let mut exact = replay.exact;
        exact.settings = settings;
        exact.frame = Frame { time: end, step: 0.0, open: false };
        exact.flight.forget();
        exact.rests.forget_curved_time(end);
        exact.rests.begin_frame(end);
        exact.evaluations = 0;
        *self = exact;
        true
    }
}
