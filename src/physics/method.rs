//! What every method is to the rest of the physics: an engine that is advanced, and a description of itself.

use std::borrow::Cow;

use glam::DVec3;

use super::log::Log;
use super::model::{Method, Model, Settings};
use super::state::{Stall, State};

/// The largest tolerance of `paper` and `swept`, dimensionless; larger ones count as this one: degree 1 is the centre on
/// the plane, and a side must stay decided.
pub(super) const LARGEST_TOLERANCE: f64 = 0.5;

/// How far one call of [`Simulation::advance`](crate::physics::Simulation::advance) should go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Until {
    /// Until the frame in progress is complete: what one single-step shows.
    Frame,
    /// Until a frame ends at or after this time, s; read the state at the time itself with
    /// [`Simulation::at`](crate::physics::Simulation::at).
    Time(f64),
}

/// How a call of [`Simulation::advance`](crate::physics::Simulation::advance) ended.
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
    /// What the method is, in one line.
    pub summary: &'static str,
    /// Order of the method's error, and in which knob.
    pub order: &'static str,
    /// The publication that the method comes from.
    pub source: &'static str,
    /// What the knobs of the method do, in words.
    pub knobs: &'static str,
    /// When to choose another method.
    pub avoid: &'static str,
}

/// One method at work. The model and the log are lent for the length of a call, the state between frames is its own.
pub(super) trait Engine {
    /// Takes over at `state`, which is the model's initial one (t = 0) or what another method left.
    fn begin(model: &Model, settings: Settings, state: State, log: &mut Log) -> Self;
    /// Goes on for about `work` units, or to the goal.
    fn advance(&mut self, model: &Model, log: &mut Log, until: Until, work: u64) -> Progress;
    /// Takes other settings (of the same method) from the next frame on; a frame in progress is given up, which leaves
    /// no trace, since its result would have followed from the last frame's end alone.
    fn retune(&mut self, model: &Model, settings: Settings);
    /// The state at the end of the last frame.
    fn state(&self, model: &Model) -> Cow<'_, State>;
    /// Time at the end of the last frame, s.
    fn time(&self) -> f64;
    /// Real length of the last frame, s; 0 before the first.
    fn step(&self) -> f64;
    /// A copy of the state at `t` (s) within the last frame.
    fn at(&self, model: &Model, t: f64) -> State;
    /// The state in which the last frame's search tried a step of this length (s); none while another frame is in progress.
    fn trial(&self, model: &Model, step: f64) -> Option<State> {
        Some(self.at(model, self.time() - self.step() + step))
    }
    /// What the method's state follows from beside t, x and v: `paper`: impulses decided at the end of the last frame
    /// that act in the next, N s by sphere; `exact` and `swept`: how the run began, (t, 0, 0), then x and v by sphere;
    /// `moreau`: what held.
    fn transient(&self, model: &Model) -> Vec<DVec3>;
    /// Right after [`Engine::begin`]: continues the run whose transient this was.
    fn continue_with(&mut self, transient: &[DVec3]);
    /// The state for another method to begin with: pending impulses are already in its velocities.
    fn hand_over(&self, model: &Model) -> State;
    /// Between frames: a copy without scratch memory and without the inside of the last frame; it goes on bit for bit,
    /// once [`Engine::wake`] has given it its memory back.
    fn keep(&self) -> Self;
    /// Gives a kept copy the memory that it needs to go on.
    fn wake(&mut self, model: &Model);
    /// Memory that a kept copy takes beside its own size, bytes, as near as its parts tell.
    fn bytes(&self) -> usize;
}

/// What turning a knob changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// Nothing: the method has no such knob.
    Nothing,
    /// The cost alone.
    Cost,
    /// The error, and with it the cost.
    Error,
}

/// What the knobs of a method do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Knobs {
    /// The longest step.
    pub dt: Effect,
    /// The tolerance.
    pub tolerance: Effect,
}

/// What the knobs of a method do.
pub const fn knobs(method: Method) -> Knobs {
    match method {
        Method::Paper | Method::Moreau => Knobs { dt: Effect::Error, tolerance: Effect::Error },
        Method::Swept => Knobs { dt: Effect::Cost, tolerance: Effect::Error },
        Method::Exact => Knobs { dt: Effect::Nothing, tolerance: Effect::Nothing },
    }
}
