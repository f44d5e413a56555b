//! What goes to a worker's thread and what comes back.

use std::sync::{Arc, mpsc::Sender};

use super::{
    around::Places,
    job::Job,
    stop::{Met, Stop},
    tape::Taped,
};
use crate::{
    recording::Suspect,
    scene::{Scene, Settings},
    snapshot::{Ahead, EventLog, Kept, Snapshot, Ticks},
};

/// Called, from the worker's thread, when there is a report that the reader has not taken.
pub type Notify = Arc<dyn Fn() + Send + Sync>;

/// A command to a worker.
#[derive(Debug, Clone)]
pub enum Command {
    /// Take another scene, paused at t = 0.
    Load(Job),
    /// Run at the speed set, or pause. A run that was gone back in goes on from where it is, and its later frames are
    /// dropped.
    Run(bool),
    /// Complete this many more frames, then pause; in a run that was gone back in, up to the newest. Frames asked for while
    /// some are under way add up; while something is searched for, they come after that.
    Forward(u64),
    /// Go back this many frames, or as many as there are. Frames asked for while some are under way add up; while something
    /// is searched for, they come after that.
    Back(u64),
    /// Go on, as fast as possible, until this comes to pass; then pause. If it does not within the scene's duration, the
    /// run is back where it was. Asked for while the run is on its way somewhere, the search begins there.
    Until(Stop),
    /// Go back to the frame with the impact before; asked for while the run is on its way somewhere, from there.
    PreviousImpact,
    /// Go back to the first frame that is kept.
    Oldest,
    /// Go on to the newest frame.
    Newest,
    /// Go to the first frame that ends at or after this time, s, back or, as fast as possible, on; then pause.
    Goto(f64),
    /// Go to the frame in which the event of this number, from 1, at this time, s, has happened; then pause.
    GotoEvent {
        /// Number of the event since t = 0, from 1.
        number: u64,
        /// Time of the event, s.
        time: f64,
    },
    /// Keep where all spheres were in the last frames, or not; and look ahead, with nothing else to do, for the next
    /// contact of a sphere.
    Around {
        /// Whether to keep where the spheres were.
        path: bool,
        /// The sphere whose next contact is looked for; none for no look ahead.
        sphere: Option<usize>,
    },
    /// Hand over the run at the end of its last frame, once none is in progress.
    TakeAway(Sender<TakenAway>),
    /// Record from the end of the frame shown, or in progress, on.
    Record,
    /// End the recording under way, and hand it over; nothing, if there is none.
    EndRecording(Sender<Option<Taped>>),
    /// Go back to t = 0 with the settings in force; a run that runs goes on running.
    Restart,
    /// Run at this many simulated seconds per second, > 0.
    Speed(f64),
    /// Solve with these settings from the next frame on; later frames than the one shown are dropped.
    Settings(Settings),
    /// Panic, so that a test can see what a user would; not in the release program.
    #[cfg(debug_assertions)]
    #[doc(hidden)]
    Panic,
}

/// A run that is taken away.
#[derive(Debug, Clone)]
pub struct TakenAway {
    /// The scene from which the run goes on; none if a number of it is not finite.
    pub scene: Option<Scene>,
    /// Whether the run goes on bit for bit, or to rounding only.
    pub to_the_bit: bool,
    /// The snapshot to draw.
    pub snapshot: Arc<Snapshot>,
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
    /// What has happened so far; of a run that was gone back in, up to its newest frame.
    pub log: Arc<EventLog>,
    /// What the worker is doing.
    pub activity: Activity,
    /// Simulated seconds per second asked for.
    pub wanted: f64,
    /// Simulated seconds per second reached, once measured.
    pub reached: Option<f64>,
    /// Commands obeyed so far.
    pub obeyed: u64,
    /// Settings of the run, or those that it will have from the next frame on.
    pub settings: Settings,
    /// Frames of the recording under way.
    pub recorded: Option<u64>,
    /// Which frames can be gone to.
    pub kept: Kept,
    /// Where all spheres were in the last frames, the one shown included, the newest last, m, if that was asked for.
    pub trail: Vec<Places>,
    /// What comes next of a sphere, if it was asked for and is known yet.
    pub ahead: Option<Arc<Ahead>>,
    /// What there was to say last, and its number, from 1.
    pub said: Option<(u64, Said)>,
    /// CPU time spent on the run since t = 0, s; 0 where the system does not tell.
    pub cpu: f64,
    /// The text of the worker's panic, after which no report follows; none if it has not panicked.
    pub panic: Option<String>,
}

/// What a worker has to say beside what it shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Said {
    /// The run has stopped because this came, at this time, s.
    Met {
        /// What was waited for.
        stop: Stop,
        /// What came.
        met: Met,
        /// Time of the frame in which it came, s.
        t: f64,
    },
    /// What was waited for has not come; the run is back where it was.
    Nothing {
        /// What was waited for.
        stop: Stop,
        /// Time from which on it was waited for, s.
        from: f64,
        /// How long it was waited for, s.
        within: f64,
    },
    /// A time to be waited for, s, is past.
    Past {
        /// The time, s.
        t: f64,
    },
    /// The run goes on from an earlier frame, and the later ones are dropped.
    Dropped {
        /// Number of frames dropped.
        frames: u64,
        /// Time from which on the frames are dropped, s.
        t: f64,
    },
    /// No frame is before this one: it is the start.
    Start,
    /// No frame before this one is kept.
    Oldest {
        /// Time of this frame, s.
        t: f64,
    },
    /// No later frame is there: this one is the newest.
    Newest,
    /// There is no earlier impact.
    NoEarlierImpact,
    /// A recording begins here.
    Recording {
        /// Time at which the recording begins, s.
        t: f64,
    },
    /// No recording begins here: the run could not go on from here bit for bit.
    NotRecordable,
    /// No recording begins in the past of a run.
    RecordingInThePast,
    /// The recording under way is given up: the run has gone back to before its beginning.
    RecordingLost,
    /// The recording under way takes no more frames.
    RecordingFull {
        /// Number of frames that the recording has.
        frames: u64,
    },
    /// The run is not as the recording that it follows.
    Differs {
        /// The first frame that differs.
        frame: u64,
        /// Time of that frame, s.
        t: f64,
        /// What differs in the frame.
        suspect: Suspect,
    },
    /// The recording that the run follows is over.
    RecordingEnds {
        /// Last frame of the recording.
        frame: u64,
        /// Whether all of it was as recorded.
        same: bool,
    },
    /// The run goes on beyond the end of the recording that it has followed.
    BeyondRecording {
        /// The recording's last frame.
        frame: u64,
    },
    /// On the way to a far time frames were too many to be counted: none before this one is kept.
    Anew {
        /// Time of this frame, s.
        t: f64,
    },
}
