//! A run that can go on bit for bit where another was: the state at a frame's end is not enough for that.
//!
//! Between events a sphere's place is computed from its trajectory, which began earlier, and is rounded; what will happen
//! was predicted from there, too, and islands of curved rest are in the midst of an arc. All of it follows from how the run
//! began, so that is what is kept: the run up to here is done again, in slices, when it is first asked to go on. That
//! takes as long as it took then.

use std::borrow::Cow;
use std::sync::Arc;

use glam::DVec3;

use super::detector::Detector;
use super::engine::EventDriven;
use super::rest_reason::RestReason;
use crate::physics::contact::Key;
use crate::physics::log::Log;
use crate::physics::method::{Engine, Progress, Until};
use crate::physics::model::{Model, Settings};
use crate::physics::state::State;

/// An engine that first catches up with the run it continues.
#[derive(Debug, Clone)]
pub(crate) struct Resumable<D> {
    engine: EventDriven<D>,
    origin: Origin,
    /// The state in which the run began that this one has yet to catch up with; none once it has.
    resumes: Option<State>,
    /// The repetition under way.
    repetition: Option<Box<Repetition<D>>>,
}

/// A run that is being done again.
#[derive(Debug, Clone)]
struct Repetition<D> {
    engine: EventDriven<D>,
    log: Log,
}

/// How a run began: what all of it follows from, with the model and the settings.
#[derive(Debug, Clone)]
enum Origin {
    /// At the model's initial state.
    Model,
    /// At another method's state, or a resumed one.
    State(Arc<State>),
    /// Settings that change the trajectory have changed since: a continuation would have to know when.
    Lost,
}

/// A state as plain vectors: (t, 0, 0), then x and v by sphere.
fn written(state: &State) -> Vec<DVec3> {
    std::iter::once(DVec3::X * state.t).chain(state.x.iter().copied()).chain(state.v.iter().copied()).collect()
}

/// The state of `count` spheres that [`written`] wrote; none if these vectors are something else.
fn read(vectors: &[DVec3], count: usize) -> Option<State> {
    let (first, rest) = vectors.split_first()?;
    let fits = rest.len() == 2 * count && vectors.iter().all(|vector| vector.is_finite());
    fits.then(|| State { t: first.x, x: rest[..count].to_vec(), v: rest[count..].to_vec() })
}

impl<D: Detector> Repetition<D> {
    /// The run from `origin` on.
    fn new(model: &Model, settings: Settings, origin: &State) -> Repetition<D> {
        let mut log = Log::default();
        // frames end at impacts only: they change no bit
        let engine = EventDriven::begin(model, Settings { dt: f64::INFINITY, ..settings }, origin, &mut log);
        Repetition { engine, log }
    }
}

impl<D: Detector> Resumable<D> {
    /// Catches up with the run that this one continues, for about `work` events; whether it has.
    fn catch_up(&mut self, model: &Model, work: u64) -> bool {
        let Some(origin) = self.resumes.take() else { return true };
        let (settings, end) = (self.engine.settings(), self.engine.time());
        let started = self.repetition.take();
        let mut repetition = started.unwrap_or_else(|| Box::new(Repetition::new(model, settings, &origin)));
        let Repetition { engine, log } = &mut *repetition;
        if !engine.repeat(model, log, end, work) {
            (self.resumes, self.repetition) = (Some(origin), Some(repetition));
            return false;
        }
        engine.begin_frames_at(end, settings);
        self.engine = repetition.engine;
        self.origin = if origin == model.initial { Origin::Model } else { Origin::State(Arc::new(origin)) };
        true
    }

    /// Why a contact rests; none if it does not.
    pub(crate) fn rest_reason(&self, key: Key) -> Option<RestReason> {
        self.engine.rest_reason(key)
    }

    /// Energy of bounces that are summed up, which the state does not show, J.
    pub(crate) fn hidden_energy(&self) -> f64 {
        self.engine.hidden_energy()
    }

    /// Energy of bounces that are summed up, which the state at `t` (s) within the last frame does not show, J.
    pub(crate) fn hidden_energy_at(&self, model: &Model, t: f64) -> f64 {
        self.engine.hidden_energy_at(model, t)
    }
}

impl<D: Detector> Engine for Resumable<D> {
    fn begin(model: &Model, settings: Settings, state: State, log: &mut Log) -> Resumable<D> {
        let engine = EventDriven::begin(model, settings, &state, log);
        let origin = if state == model.initial { Origin::Model } else { Origin::State(Arc::new(state)) };
        Resumable { engine, origin, resumes: None, repetition: None }
    }

    fn advance(&mut self, model: &Model, log: &mut Log, until: Until, work: u64) -> Progress {
        if self.resumes.is_some() && !self.catch_up(model, work) {
            return Progress::Yielded;
        }
        self.engine.advance(model, log, until, work)
    }

    fn retune(&mut self, model: &Model, settings: Settings) {
        if self.engine.retune(model, settings) {
            self.origin = Origin::Lost;
        }
    }

    fn state(&self, model: &Model) -> Cow<'_, State> {
        Cow::Owned(self.at(model, self.time()))
    }

    fn time(&self) -> f64 {
        self.engine.time()
    }

    fn step(&self) -> f64 {
        self.engine.step()
    }

    fn at(&self, model: &Model, t: f64) -> State {
        if self.resumes.is_some() { model.initial.clone() } else { self.engine.at(model, t) }
    }

    fn transient(&self, model: &Model) -> Vec<DVec3> {
        match (&self.resumes, &self.origin) {
            (Some(state), _) => written(state),
            (None, Origin::Model) => written(&model.initial),
            (None, Origin::State(state)) => written(state),
            (None, Origin::Lost) => Vec::new(),
        }
    }

    fn continue_with(&mut self, transient: &[DVec3]) {
        let count = self.engine.mechanics.trajectories.records.len();
        self.resumes = read(transient, count).filter(|origin| origin.t <= self.time());
    }

    fn hand_over(&self, model: &Model) -> State {
        self.at(model, self.time())
    }

    fn keep(&self) -> Resumable<D> {
        let repetition = self.repetition.clone();
        Resumable { engine: self.engine.keep(), origin: self.origin.clone(), resumes: self.resumes.clone(), repetition }
    }

    fn wake(&mut self, _: &Model) {}

    fn bytes(&self) -> usize {
        let repetition = self.repetition.as_ref().map_or(0, |repetition| repetition.engine.bytes());
        self.engine.bytes() + repetition + self.resumes.as_ref().map_or(0, State::bytes)
    }
}
