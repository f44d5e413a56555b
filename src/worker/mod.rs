//! The thread that owns a simulation: commands in, the latest snapshot out.
//!
//! The worker never waits for its reader: it puts each [`Report`] into one slot, over whatever lies there, and calls
//! `notify` only if the reader has taken the one before. While paused it sleeps until a command comes. No bit of a run
//! depends on any of it.

mod beside;
mod errands;
mod mailbox;
mod pace;
mod run;
mod slot;

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc,
        mpsc::{self, Sender},
    },
    thread,
};

pub use beside::{Beside, Ending};
pub use errands::Errands;
use run::Runner;
use slot::Slot;

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

/// What a worker can be told.
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
    /// Simulated seconds per second, > 0.
    Speed(f64),
    /// From here on, solve with these.
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

/// The latest news of a run.
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
    /// What the worker's panic said; nothing more will come.
    pub panic: Option<String>,
}

/// A worker thread, seen from its reader. Dropping it ends the thread.
pub struct Worker {
    commands: Sender<Command>,
    sent: u64,
    slot: Arc<Slot<Report>>,
}

impl Worker {
    /// Starts a thread on `job`, paused at t = 0, with a report of that ready to take.
    ///
    /// # Errors
    /// If the system has no thread to give.
    pub fn start(job: Job, speed: f64, notify: Notify) -> std::io::Result<Worker> {
        let (commands, inbox) = mpsc::channel();
        let mut runner = Runner::new(job, speed, inbox);
        let slot = Arc::new(Slot::new(runner.report(), notify));
        let theirs = Arc::clone(&slot);
        thread::Builder::new().name("simulation".into()).spawn(move || {
            // The runner is given up with the thread, so nobody can see what the panic left half done.
            if let Err(payload) = catch_unwind(AssertUnwindSafe(|| runner.run(&theirs))) {
                let last = theirs.take();
                theirs.put(Report { panic: Some(said(payload.as_ref())), ..Report::clone(&last) });
            }
        })?;
        Ok(Worker { commands, sent: 0, slot })
    }

    /// Sends a command; the answer is a later [`Report`]. After the worker's panic it goes nowhere.
    pub fn send(&mut self, command: Command) {
        self.sent += 1;
        let _ = self.commands.send(command); // its end is reported through the slot
    }

    /// Commands sent so far; a report with as many obeyed shows their effect.
    pub fn sent(&self) -> u64 {
        self.sent
    }

    /// The latest report; from here on `notify` is called again for the next one.
    pub fn take(&self) -> Arc<Report> {
        self.slot.take()
    }
}

/// The text of a panic.
fn said(payload: &(dyn std::any::Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no text").to_owned()
}
