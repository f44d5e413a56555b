//! The method as the simulation drives it.

use std::borrow::Cow;

use glam::DVec3;

use super::kicks::Kicks;
use super::run::{Paper, TimeSearch, TrialStage};
use super::trial_step::forward;
use super::watchdog::Watchdog;
use crate::physics::log::Log;
use crate::physics::method::{Engine, Progress, Until};
use crate::physics::model::{Model, Settings};
use crate::physics::overlap::Finder;
use crate::physics::state::State;

impl Engine for Paper {
    fn begin(model: &Model, settings: Settings, state: State, log: &mut Log) -> Paper {
        let mut paper = Paper {
            settings,
            end: state.clone(),
            watch: Watchdog::at(state.t),
            start: state,
            kicks: Kicks::none(model.len()),
            next: Kicks::none(model.len()),
            finder: Finder::new(model),
            allowed: Vec::new(),
            trial: None,
            stage: TrialStage::Complete,
            residue: 0.0,
            search: TimeSearch::Whole,
            probes: Vec::new(),
            step: 0.0,
        };
        log.tallies.evaluations += paper.finder.all(model, &paper.end.x, paper.end.t == 0.0);
        paper.respond(model, log);
        paper
    }

    fn advance(&mut self, model: &Model, log: &mut Log, until: Until, work: u64) -> Progress {
        let goal = match until {
            Until::Frame => f64::NEG_INFINITY,
            Until::Time(t) if self.time() >= t => return Progress::Reached,
            Until::Time(t) => t,
        };
        let mut spent = 0;
        while spent < work {
            if self.trial.is_none() && self.is_calm(log) {
                spent += self.complete_free_frames(model, log, goal, work - spent);
            } else {
                spent += self.go_on(model, log);
            }
            if let Some(stall) = self.guard(model, log) {
                return Progress::Stalled(stall);
            }
            if self.trial.is_none() && (self.end.t >= goal || until == Until::Frame) {
                return Progress::Reached;
            }
        }
        Progress::Yielded
    }

    fn retune(&mut self, model: &Model, settings: Settings) {
        self.give_up(model);
        self.settings = settings;
        self.watch = Watchdog::at(self.end.t);
    }

    fn state(&self, _: &Model) -> Cow<'_, State> {
        Cow::Borrowed(if self.trial.is_some() { &self.start } else { &self.end })
    }

    fn time(&self) -> f64 {
        if self.trial.is_some() { self.start.t } else { self.end.t }
    }

    fn step(&self) -> f64 {
        self.step
    }

    fn at(&self, model: &Model, t: f64) -> State {
        // The start of the last frame is gone as soon as the next is in progress.
        if self.trial.is_some() || t >= self.end.t {
            return self.state(model).into_owned();
        }
        let mut state = self.start.clone();
        if t > state.t {
            forward(model, &self.kicks, &self.start, &mut state, t - self.start.t);
            state.t = t;
        }
        state
    }

    fn trial(&self, model: &Model, step: f64) -> Option<State> {
        // a run that was kept between two frames knows the start of none
        if self.trial.is_some() || self.start.t == self.end.t {
            return None;
        }
        let mut state = self.start.clone();
        forward(model, &self.kicks, &self.start, &mut state, step);
        state.t += step;
        Some(state)
    }

    fn transient(&self, model: &Model) -> Vec<DVec3> {
        let mut impulses = vec![DVec3::ZERO; model.len()];
        for kick in self.pending().list() {
            impulses[kick.sphere] = kick.impulse;
        }
        impulses.push(self.watch.row());
        impulses
    }

    fn continue_with(&mut self, transient: &[DVec3]) {
        // a state that was written down without its last row goes on as well, and is given up later, if it stalls
        let (impulses, count) = transient.split_at(transient.len().min(self.end.x.len()));
        self.next.replace_impulses(impulses);
        self.watch = count.first().map_or(self.watch, |row| Watchdog::of_row(*row));
    }

    fn hand_over(&self, model: &Model) -> State {
        let mut state = self.state(model).into_owned();
        for kick in self.pending().list() {
            state.v[kick.sphere] += kick.impulse * model.inverse_masses[kick.sphere];
        }
        state
    }

    /// A copy that keeps the frame's end, what acts next, and the overlaps there; the start is a frame's inside, all else
    /// scratch.
    fn keep(&self) -> Paper {
        Paper {
            settings: self.settings,
            start: State::default(),
            end: self.end.clone(),
            kicks: Kicks::none(0),
            next: self.next.kept(),
            finder: self.finder.kept(),
            allowed: Vec::new(),
            trial: None,
            stage: TrialStage::Complete,
            residue: self.residue,
            search: self.search,
            probes: Vec::new(),
            step: self.step,
            watch: self.watch,
        }
    }

    fn wake(&mut self, model: &Model) {
        self.start = self.end.clone();
        self.kicks = Kicks::none(model.len());
        self.next.wake(model.len());
        self.finder.wake(model);
    }

    fn bytes(&self) -> usize {
        self.end.bytes() + size_of_val(self.next.list()) + size_of_val(&*self.finder.found)
    }
}
