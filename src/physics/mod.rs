//! The door to the physics: a [`Simulation`] of a scene by a [`Method`], advanced in slices and read between frames.
//!
//! Nothing in here knows of snapshots, threads, clocks, files or the screen. Same scene, method and settings give the
//! same bits on every machine: only + − × ÷ √ on `f64`, in an order fixed by the indices.

pub mod contact;
pub mod model;
pub mod motion;
pub mod neighbors;
pub mod overlap;
mod paper;
pub mod state;
pub mod support;

pub use contact::{Class, Contact, Kind, Probe};
pub use model::{Method, Model, Scene, Settings};
pub use state::{Stall, State, Tallies};

/// How far one call of [`Simulation::advance`] should go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Until {
    /// Until the frame in progress is complete: what one single-step shows.
    Frame,
    /// Until a frame ends at or after this time, s; read the state at the time itself with [`Simulation::at`].
    Time(f64),
}

/// How a call of [`Simulation::advance`] ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Progress {
    /// The goal is reached.
    Reached,
    /// The work budget is spent; call again to go on. No bit depends on where the slices fall.
    Yielded,
    /// The run cannot go on; calling again says so again.
    Stalled(Stall),
}

/// What a method is: shown by `carom methods`, and a test refuses a method without it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Description {
    /// The method.
    pub method: Method,
    /// One line: what it is.
    pub summary: &'static str,
    /// Order of its error, and in which knob.
    pub order: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// What its knobs do.
    pub knobs: &'static str,
    /// When to choose another.
    pub avoid: &'static str,
}

/// A scene under way: one method advancing one state.
#[derive(Debug, Clone)]
pub struct Simulation {
    model: Model,
    settings: Settings,
    state: State,
}

impl Simulation {
    /// A simulation of `scene` at t = 0.
    pub fn new(scene: &Scene, settings: Settings) -> Simulation {
        let _ = scene;
        Simulation { model: Model {}, settings, state: State::default() }
    }

    /// Goes on for about `work` units (degree evaluations or events), or to the goal, whichever is first.
    pub fn advance(&mut self, until: Until, work: u64) -> Progress {
        let _ = (until, work);
        Progress::Reached
    }

    /// Time at the end of the last frame, s.
    pub fn time(&self) -> f64 {
        self.state.t
    }

    /// Real length of the last frame, s; 0 before the first.
    pub fn step(&self) -> f64 {
        0.0
    }

    /// A copy of the state at the end of the last frame.
    pub fn state(&self) -> State {
        self.state.clone()
    }

    /// A copy of the state at `t` (s) within the last frame, reached from the frame's start by a shortened step.
    /// Reading never changes the run.
    pub fn at(&self, t: f64) -> State {
        let _ = t;
        self.state.clone()
    }

    /// Every contact of the last frame, in the order in which they were handled.
    pub fn contacts(&self) -> &[Contact] {
        &[]
    }

    /// The trial steps of the last frame's search for the collision time.
    pub fn probes(&self) -> &[Probe] {
        &[]
    }

    /// Keep (or stop keeping) every collide, rest and release for [`Simulation::take_events`]. Off at first: it costs
    /// memory, and never a bit of the result.
    pub fn record_events(&mut self, on: bool) {
        let _ = on;
    }

    /// The events kept since the last call, in order of time.
    pub fn take_events(&mut self) -> Vec<Contact> {
        Vec::new()
    }

    /// Counted since t = 0.
    pub fn tallies(&self) -> Tallies {
        Tallies::default()
    }

    /// Σ ½ m v² − m g·x − F·x at the end of the last frame, J.
    pub fn energy(&self) -> f64 {
        0.0
    }

    /// The same at t = 0, J.
    pub fn initial_energy(&self) -> f64 {
        0.0
    }

    /// What is being solved with.
    pub fn settings(&self) -> Settings {
        self.settings
    }

    /// From here on, solve with other settings.
    pub fn set_settings(&mut self, settings: Settings) {
        self.settings = settings;
    }

    /// All that is constant.
    pub fn model(&self) -> &Model {
        &self.model
    }
}
