//! What goes to a worker's thread and what comes back.

use std::sync::Arc;

use crate::{
    scene::{Scene, Settings},
    snapshot::{Snapshot, Stage, Ticks},
};

/// Called, from the worker's thread, when there is a report that the reader has not taken.
pub type Notify = Arc<dyn Fn() + Send + Sync>;

/// A scene to simulate.
#[derive(Debug, Clone)]
pub struct Job {
    /// What its snapshots show as constant.
    pub stage: Arc<Stage>,
    /// The scene.
    pub scene: Arc<Scene>,
    /// What to solve it with.
    pub settings: Settings,
}

/// A command to a worker.
#[derive(Debug, Clone)]
pub enum Command {
    /// Take another scene, paused at t = 0.
    Load(Job),
    /// Run at the speed set, or pause.
    Run(bool),
    /// Complete one more frame, then pause. Frames asked for while one is under way add up.
    Step,
    /// Go on, as fast as possible, to the end of the next frame with an impact; then pause.
    NextImpact,
    /// Go on, as fast as possible, to the first frame that ends at or after this time, s; then pause. A time that is
    /// already past is reached from the start.
    Goto(f64),
    /// Back to t = 0 with the settings in force; running goes on running.
    Restart,
    /// Run at so many simulated seconds per second, > 0.
    Speed(f64),
    /// Solve with these settings from the next frame on.
    Settings(Settings),
    /// Panic, so that a test can see what a user would; not in the release program.
    #[cfg(debug_assertions)]
    #[doc(hidden)]
    Panic,
}

/// What a worker is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Activity {
    /// Advancing.
    Running,
    /// Waiting for a command.
    Paused,
    /// Waiting for a command, because the run cannot go on.
    Stalled,
}

/// A run as its worker last reported it.
#[derive(Debug, Clone)]
pub struct Report {
    /// The run at the end of its last frame.
    pub snapshot: Arc<Snapshot>,
    /// Collisions so far.
    pub ticks: Arc<Ticks>,
    /// What the worker is doing.
    pub activity: Activity,
    /// Simulated seconds per second asked for.
    pub wanted: f64,
    /// Simulated seconds per second reached, once measured.
    pub reached: Option<f64>,
    /// Commands obeyed so far.
    pub obeyed: u64,
    /// CPU time spent on the run since t = 0, s; 0 where the system does not tell.
    pub cpu: f64,
    /// The text of the worker's panic, after which no report follows; none if it has not panicked.
    pub panic: Option<String>,
}
