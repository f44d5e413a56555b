//! The event-driven method: no time step. Between events every sphere moves on a parabola; the next event is computed,
//! not searched for by stepping. The yardstick of the other methods.
//!
//! The loop: take the earliest event of all (ties: walls, pairs, ends of parabolas, crossings of cells; then a, then b),
//! advance the clock to it, let the impact law act on the two bodies, predict them anew. When no contact is left at an
//! instant, islands of resting contacts are settled (`rest`). Reading never rewrites a line (`flight`), and frames only
//! say where to pause: neither changes a bit of the trajectory.

use std::borrow::Cow;

use glam::DVec3;

use super::chattering::{Chatter, weight};
use super::detector::Detector;
use super::instant::{Instant, beginning};
use super::islands::resting::Rests;
use super::resumable::{self, Origin, Replay};
use super::schedule::candidates::Candidates;
use super::schedule::cells::Cells;
use super::schedule::prediction::EventKind;
use super::schedule::prefetch::Prefetch;
use super::schedule::queue::Queue;
use super::schedule::simd::Simd;
use super::schedule::ties::Ties;
use super::schedule::upkeep::Wear;
use super::trajectories::Trajectories;
use crate::physics::log::Log;
use crate::physics::method::{Engine, Progress, Until};
use crate::physics::model::{Model, Settings};
use crate::physics::state::{Stall, State};

/// Spheres beyond this many are kept in cells.
const FEW: usize = 64;

/// Frames of dt in which nothing happens that are shown one by one: it takes minutes to pass them. A dt that asks for
/// more, or one that the clock cannot tell from 0, leaves the frame open until something happens or the goal is reached.
const MOST_IDLE: f64 = (1_u64 << 30) as f64;

/// The event-driven method at work.
#[derive(Debug, Clone)]
pub(crate) struct EventDriven<D> {
    pub(super) settings: Settings,
    pub(super) detector: D,
    /// Time of the last event, s.
    pub(super) now: f64,
    pub(super) frame: Frame,
    /// Where a frame with nothing in it ends at the earliest, s, where frames of dt would be too many to count.
    pub(super) goal: f64,
    /// Where the frame under way ends if nothing happens before, s.
    pub(super) end: f64,
    pub(super) flight: Trajectories,
    /// By seat.
    pub(super) queue: Queue,
    /// The earliest event and the seat it is entered for, as long as nothing has changed since it was looked up.
    pub(super) next: Option<(f64, usize)>,
    pub(super) ties: Ties,
    pub(super) cells: Option<Box<Cells>>,
    /// When the parabola ends of whoever is predicted now, s: what it would meet later is looked at then.
    pub(super) until: f64,
    /// Lent to whoever looks around.
    pub(super) near: Option<Box<Candidates>>,
    pub(super) wear: Wear,
    pub(super) scout: Prefetch,
    pub(super) lanes: Simd,
    pub(super) rests: Rests,
    pub(super) instant: Instant,
    /// The time scale of the start, s: what the clock is taken for at its zero.
    pub(super) beginning: f64,
    pub(super) chatter: Chatter,
    /// What all spheres weigh, N.
    pub(super) weight: f64,
    /// Gaps computed since the log was last told.
    pub(super) evaluations: u64,
    pub(super) origin: Origin,
    /// How the run began that this one has yet to catch up with.
    pub(super) resumes: Option<State>,
    pub(super) replay: Option<Box<Replay<D>>>,
}

/// What one single-step shows: up to the next event, or dt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    /// End of the last complete frame, s.
    pub(super) time: f64,
    /// Its length, s.
    pub(super) step: f64,
    /// Whether the next one is under way.
    pub(super) open: bool,
}

/// What became of one turn of the loop.
pub(super) enum Turn {
    /// An event was handled.
    Event,
    /// The frame in progress is complete.
    Frame,
}

impl<D: Detector> Engine for EventDriven<D> {
    fn begin(model: &Model, settings: Settings, state: State, log: &mut Log) -> EventDriven<D> {
        let count = model.len();
        let origin = if state == model.initial { Origin::Model } else { Origin::State(Box::new(state.clone())) };
        let mut exact = EventDriven {
            settings,
            detector: D::new(settings),
            now: state.t,
            frame: Frame { time: state.t, step: 0.0, open: false },
            goal: f64::NEG_INFINITY,
            end: f64::MAX,
            flight: Trajectories::new(model, &state),
            queue: Queue::new(count),
            next: None,
            ties: Ties::none(),
            cells: None,
            until: f64::INFINITY,
            near: Some(Box::new(Candidates::empty())),
            wear: Wear::new(count, state.t),
            scout: Prefetch::default(),
            lanes: Simd::new(),
            rests: Rests::default(),
            instant: Instant::default(),
            beginning: beginning(model, &state),
            chatter: Chatter::default(),
            weight: weight(model),
            evaluations: 0,
            origin,
            resumes: None,
            replay: None,
        };
        if count > FEW {
            exact.lay_out(model);
        }
        exact.load(model, log);
        exact.flight.forget();
        exact
    }

    fn advance(&mut self, model: &Model, log: &mut Log, until: Until, work: u64) -> Progress {
        if self.resumes.is_some() && !self.catch_up(model, work) {
            return Progress::Yielded;
        }
        self.goal = match until {
            Until::Time(t) if t.is_finite() && t - self.frame.time > MOST_IDLE * self.settings.dt => t,
            _ => f64::NEG_INFINITY,
        };
        self.end = self.frame_end();
        for _ in 0..work {
            if !self.frame.open {
                if matches!(until, Until::Time(t) if t <= self.frame.time) {
                    return Progress::Reached;
                }
                self.open_frame(log);
            }
            match self.turn(model, log) {
                Ok(Turn::Event) => {}
                Ok(Turn::Frame) if until == Until::Frame => return Progress::Reached,
                Ok(Turn::Frame) => {}
                Err(stall) => return Progress::Stalled(stall),
            }
        }
        match until {
            Until::Time(t) if !self.frame.open && t <= self.frame.time => Progress::Reached,
            _ => Progress::Yielded,
        }
    }

    fn retune(&mut self, model: &Model, settings: Settings) {
        let same = settings.tolerance == self.settings.tolerance;
        self.settings = settings;
        if !D::SOLVES && !same {
            self.detector = D::new(settings);
            self.origin = Origin::Lost;
            (0..model.len()).for_each(|i| self.predict(model, i));
        }
    }

    fn state(&self, model: &Model) -> Cow<'_, State> {
        Cow::Owned(self.at(model, self.frame.time))
    }

    fn time(&self) -> f64 {
        self.frame.time
    }

    fn step(&self) -> f64 {
        self.frame.step
    }

    fn at(&self, model: &Model, t: f64) -> State {
        if self.resumes.is_some() {
            return model.initial.clone();
        }
        let t = t.clamp(self.frame.time - self.frame.step, self.frame.time);
        let mut state = self.flight.then(t);
        self.rests.arcs_into(model, &mut state);
        state
    }

    fn transient(&self, model: &Model) -> Vec<DVec3> {
        match (&self.resumes, &self.origin) {
            (Some(state), _) => resumable::written(state),
            (None, Origin::Model) => resumable::written(&model.initial),
            (None, Origin::State(state)) => resumable::written(state),
            (None, Origin::Lost) => Vec::new(),
        }
    }

    fn continue_with(&mut self, transient: &[DVec3]) {
        self.resumes =
            resumable::read(transient, self.flight.records.len()).filter(|origin| origin.t <= self.frame.time);
    }

    fn hand_over(&self, model: &Model) -> State {
        self.at(model, self.frame.time)
    }
}

impl<D: Detector> EventDriven<D> {
    pub(super) fn open_frame(&mut self, log: &mut Log) {
        self.frame.open = true;
        self.end = self.frame_end();
        self.flight.forget();
        self.rests.forget();
        log.contacts.clear();
        log.probes.clear();
    }

    /// A frame is dt long, and so long at least that the clock moves on.
    pub(super) fn frame_end(&self) -> f64 {
        let start = self.frame.time;
        (start + self.settings.dt).max(start.next_up()).max(self.goal).min(f64::MAX)
    }

    pub(super) fn close_frame(&mut self, model: &Model, log: &mut Log, end: f64) -> Turn {
        self.detector.report(self.frame.time, end, log);
        self.list_rests(model, log, end);
        self.frame = Frame { time: end, step: end - self.frame.time, open: false };
        log.tallies.frames += 1;
        let looked_at = std::mem::take(&mut self.evaluations);
        if D::SOLVES {
            log.tallies.evaluations += looked_at;
        }
        log.tallies.inexact_time = self.rests.curved_time(end);
        Turn::Frame
    }

    /// One event, or the end of the frame.
    pub(super) fn turn(&mut self, model: &Model, log: &mut Log) -> Result<Turn, Stall> {
        let (time, seat) = match self.next.take() {
            Some(next) => next,
            None => self.first(),
        };
        let next = self.sort(time, seat);
        if self.rests.is_dirty() && (time > self.now || next != EventKind::Contact) {
            self.settle(model, log)?;
            return Ok(Turn::Event);
        }
        if !log.contacts.is_empty() && time > self.now && self.now > self.frame.time {
            self.next = Some((time, seat));
            return Ok(self.close_frame(model, log, self.now));
        }
        if time > self.end {
            self.next = Some((time, seat));
            return Ok(self.close_frame(model, log, self.end));
        }
        self.advance_clock(time, model.len())?;
        self.scout();
        match next {
            EventKind::Contact => self.contact(model, log, seat)?,
            EventKind::End => self.end_parabola(model, self.flight.sphere(seat)),
            EventKind::Crossing => self.cross(model, seat),
        }
        if self.wear.is_worn() {
            self.review(model);
        }
        Ok(Turn::Event)
    }
}
