//! A recording under way, and one that is followed.

use std::sync::Arc;

use crate::{
    physics::Simulation,
    recording::{Change, Recording, Sums, Suspect},
    scene::{Scene, Settings},
};

/// Frames of a recording under way, at most: 32 MB.
const MOST_FRAMES: usize = 4_000_000;

/// A recording under way.
#[derive(Debug)]
pub(super) struct Tape {
    scene: Scene,
    settings: Settings,
    /// Frame at which the recording begins.
    pub(super) begun: u64,
    /// Number of changes of the run before the beginning.
    pub(super) changes: usize,
    frames: Vec<Sums>,
}

impl Tape {
    /// A recording that begins at the end of a frame, from which `scene` goes on.
    pub(super) fn begin(run: &Simulation, scene: Scene, changes: usize) -> Tape {
        let frames = vec![Sums::of(&run.state())];
        Tape { scene, settings: run.settings(), begun: run.tallies().frames, changes, frames }
    }

    /// Takes note of a frame that has ended, before anything is changed there.
    pub(super) fn note(&mut self, run: &Simulation) {
        if !self.is_full() {
            self.frames.push(Sums::of(&run.state()));
        }
    }

    /// Whether no more frames are taken.
    pub(super) fn is_full(&self) -> bool {
        self.frames.len() > MOST_FRAMES
    }

    /// Number of frames so far.
    pub(super) fn frames(&self) -> u64 {
        self.frames.len() as u64 - 1
    }

    /// Forgets what came after a frame of the run; false if that was before the beginning.
    pub(super) fn cut(&mut self, frame: u64) -> bool {
        let Some(frames) = frame.checked_sub(self.begun) else { return false };
        self.frames.truncate(frames as usize + 1);
        true
    }

    /// The recording of a scene named `key`, with these changes of the run since it began.
    pub(super) fn end(self, key: &str, changes: impl Iterator<Item = Change>) -> Taped {
        let (begun, last) = (self.begun, self.frames());
        let changes = changes.map(|change| Change { frame: change.frame - begun, ..change });
        let changes = changes.filter(|change| change.frame <= last).collect();
        Taped { key: key.to_owned(), scene: self.scene, settings: self.settings, changes, frames: self.frames }
    }
}

/// A recording that has ended; its scene's text is yet to be written.
#[derive(Debug, Clone)]
pub struct Taped {
    /// Name by which the scene was opened.
    pub key: String,
    /// The scene from which the recorded run goes on.
    pub scene: Scene,
    /// Settings at the beginning.
    pub settings: Settings,
    /// Changes of settings on the way.
    pub changes: Vec<Change>,
    /// The sums of the state at the beginning, then at the end of every frame.
    pub frames: Vec<Sums>,
}

/// A recording that a run follows: its changes are made where they were, and its frames compared.
#[derive(Debug)]
pub(super) struct Script {
    recording: Arc<Recording>,
    /// Whether a frame was found to differ.
    differs: bool,
}

/// What a run has come upon on its way, most of it of the recording that it follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Found {
    /// The first frame that differs, and what differs in it.
    Differs(u64, Suspect),
    /// The frame with which the recording ends, and whether all of it was as recorded.
    End(u64, bool),
    /// The run goes on beyond this frame, with which the recording has ended.
    Beyond(u64),
    /// Frames were too many to be counted: none before is kept.
    Anew,
}

impl Script {
    pub(super) fn new(recording: Arc<Recording>) -> Script {
        Script { recording, differs: false }
    }

    /// The change that comes after `changes` others, if it is due where `frame` frames are complete.
    pub(super) fn due(&self, changes: usize, frame: u64, stalled: bool) -> Option<Settings> {
        let change = self.recording.changes.get(changes)?;
        (change.frame <= frame && change.stalled <= stalled).then_some(change.settings)
    }

    /// Whether frames are still to be compared after this one.
    pub(super) fn goes_on(&self, frame: u64) -> bool {
        frame + 1 < self.recording.frames.len() as u64
    }

    /// Compares a frame that has ended, before anything is changed there.
    pub(super) fn compare(&mut self, run: &Simulation) -> Option<Found> {
        let frame = run.tallies().frames;
        let recorded = self.recording.frames.get(usize::try_from(frame).ok()?)?;
        if !self.differs
            && let Some(suspect) = Sums::of(&run.state()).suspect(*recorded, run.model().len())
        {
            self.differs = true;
            return Some(Found::Differs(frame, suspect));
        }
        (!self.goes_on(frame)).then_some(Found::End(frame, !self.differs))
    }
}
