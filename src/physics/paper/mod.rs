//! The source paper's method, as printed.

mod frame;
mod response;

use std::borrow::Cow;

use super::log::{Key, Log};
use super::{Class, Description, Engine, Method, Model, Probe, Progress, Settings, Stall, State, Until};
use frame::Reach;
use response::Kicks;

/// Accepted beyond the tolerance, dimensionless, as the paper prints it.
const SLACK: f64 = 1e-4;

/// Larger tolerances count as this one: degree 1 is the centre on the plane, and a side must stay decided.
const LARGEST_TOLERANCE: f64 = 0.5;

/// What `paper` is.
pub(super) const DESCRIPTION: Description = Description {
    method: Method::Paper,
    summary: "The source paper's method as printed: Euler frames, an overlap test at their end, recursive bisection \
              of the first collision, responses as forces over the next frame.",
    order: "First order in dt: position error g·t·dt/2 per free flight, energy lost g²·dt/2 W per kg.",
    source: "\"Rigid Body Simulation\", Assignment 5, Yang Hongdi.",
    knobs: "dt: the error; tolerance: how deep an overlap is accepted (1e-4 more than it says), irrelevant below 10 dt.",
    avoid: "Fast spheres (they tunnel once v·dt exceeds 2r), spheres at rest in wedges or stacks (it stalls), long runs \
            that must keep their energy.",
};

/// A body pair that overlaps in a trial state, and how deep.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Overlap {
    key: Key,
    degree: f64,
}

/// How far the search for the collision time has come; steps count from the frame's start, s.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Search {
    /// The whole step is being tried.
    Whole,
    /// The collision lies between `apart` and `deep`.
    Between { apart: f64, deep: f64 },
    /// No time lies between the two any more: the later one is taken as it is.
    Last,
}

/// The method at work.
#[derive(Debug, Clone)]
pub(super) struct Paper {
    settings: Settings,
    /// Start of the frame in progress; between frames: of the last frame.
    start: State,
    /// Where the trial step ends; between frames: the end of the last frame.
    end: State,
    /// What acts on single spheres during the frame that leads from `start` to `end`.
    kicks: Kicks,
    /// What will act during the next frame.
    next: Kicks,
    /// Overlaps of the trial state, sorted.
    found: Vec<Overlap>,
    /// Contacts that began the frame deeper than the tolerance (it was lowered), with the depth allowed to each.
    allowed: Vec<Overlap>,
    /// Contacts that rest.
    resting: Vec<Key>,
    /// The step being tried, s, if a frame is in progress.
    trial: Option<f64>,
    search: Search,
    /// Trial steps of the frame in progress.
    probes: Vec<Probe>,
    step: f64,
    watch: Watch,
}

/// The watchdog's memory.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Watch {
    /// When the present count began, s.
    since: f64,
    /// Frames cut short by a search since then.
    cut: u64,
    /// Time they should have brought at least, s.
    owed: f64,
}

impl Watch {
    fn at(time: f64) -> Watch {
        Watch { since: time, cut: 0, owed: 0.0 }
    }
}

impl Engine for Paper {
    fn begin(model: &Model, settings: Settings, state: State, log: &mut Log) -> Paper {
        let mut paper = Paper {
            settings,
            end: state.clone(),
            watch: Watch::at(state.t),
            start: state,
            kicks: Kicks::none(model.len()),
            next: Kicks::none(model.len()),
            found: Vec::new(),
            allowed: Vec::new(),
            resting: Vec::new(),
            trial: None,
            search: Search::Whole,
            probes: Vec::new(),
            step: 0.0,
        };
        let evaluations = paper.find(model, if paper.end.t == 0.0 { Reach::Touching } else { Reach::Overlapping });
        log.tallies.evaluations += evaluations;
        paper.respond(model, log);
        paper
    }

    fn advance(&mut self, model: &Model, log: &mut Log, until: Until, work: u64) -> Progress {
        if let Until::Time(t) = until
            && self.time() >= t
        {
            return Progress::Reached;
        }
        let mut spent = 0;
        while spent < work {
            let (accepted, cost) = self.probe(model, log);
            spent += cost;
            if !accepted {
                continue;
            }
            self.close(model, log);
            if let Some(stall) = self.quarantine().or_else(|| self.watch(log, model)) {
                return Progress::Stalled(stall);
            }
            match until {
                Until::Time(t) if self.end.t < t => {}
                _ => return Progress::Reached,
            }
        }
        Progress::Yielded
    }

    fn retune(&mut self, settings: Settings) {
        self.settings = settings;
        if self.trial.take().is_some() {
            std::mem::swap(&mut self.start, &mut self.end);
            std::mem::swap(&mut self.kicks, &mut self.next);
            self.start.clone_from(&self.end);
            self.step = 0.0;
        }
        self.watch = Watch::at(self.end.t);
    }

    fn state(&self, _: &Model) -> Cow<'_, State> {
        Cow::Borrowed(self.current())
    }

    fn time(&self) -> f64 {
        self.current().t
    }

    fn step(&self) -> f64 {
        self.step
    }

    fn at(&self, model: &Model, t: f64) -> State {
        if self.trial.is_some() || t >= self.end.t {
            return self.current().clone();
        }
        let mut state = self.start.clone();
        if t > self.start.t {
            frame::forward(model, &self.kicks, &self.start, t - self.start.t, &mut state);
            state.t = t;
        }
        state
    }

    fn hand_over(self, model: &Model) -> State {
        let owed = if self.trial.is_some() { &self.kicks } else { &self.next };
        let mut state = self.current().clone();
        for kick in owed.list() {
            state.v[kick.sphere] += kick.impulse * model.inverse_masses[kick.sphere];
        }
        state
    }
}

impl Paper {
    /// The state at the end of the last frame.
    fn current(&self) -> &State {
        if self.trial.is_some() { &self.start } else { &self.end }
    }

    /// The largest degree a frame may end with, for contacts without an allowance of their own.
    fn accepted(&self) -> f64 {
        self.settings.tolerance.min(LARGEST_TOLERANCE) + SLACK
    }

    /// The one place where a state that is no longer finite is caught.
    fn quarantine(&self) -> Option<Stall> {
        let State { t, x, v } = &self.end;
        let lost = (0..x.len()).find(|&i| !(x[i].is_finite() && v[i].is_finite()))?;
        let reason = format!(
            "At t = {t} s sphere {lost} has left the range of numbers: x = {}, v = {}; its speed or the step of {} s is \
             too large.",
            x[lost], v[lost], self.step,
        );
        Some(Stall { time: *t, kind: "not-finite", reason })
    }

    /// Ends the run if frames cut short have brought too little time: the watchdog.
    fn watch(&mut self, log: &Log, model: &Model) -> Option<Stall> {
        if self.step < self.settings.dt {
            let struck = log.contacts.iter().any(|c| c.class == Class::Collide);
            self.watch.cut += 1;
            self.watch.owed += self.settings.dt * if struck { STRUCK_PACE } else { QUIET_PACE };
        }
        if self.watch.cut < PATIENCE + model.len() as u64 {
            return None;
        }
        let stalled = self.end.t - self.watch.since < self.watch.owed;
        self.watch = Watch::at(self.end.t);
        stalled.then(|| self.stall(log))
    }

    fn stall(&self, log: &Log) -> Stall {
        let bodies: Vec<String> = log.contacts.iter().map(response::names).collect();
        Stall {
            time: self.end.t,
            kind: "resting-contact",
            reason: format!(
                "At t = {} s the frames have become so short that time stands still: {} ask for more support than \
                 contact by contact can give, as in a wedge or a stack; change the method from here.",
                self.end.t,
                bodies.join(", "),
            ),
        }
    }
}

/// Frames cut short, beside one per sphere, after which the watchdog compares.
const PATIENCE: u64 = 1000;

/// Least mean progress, in units of dt, of frames cut short with an impact: a gas of a million spheres makes 1e-4.
const STRUCK_PACE: f64 = 1e-6;

/// Least mean progress, in units of dt, of frames cut short without any impact: a landing needs a few tens of frames.
const QUIET_PACE: f64 = 1e-2;
