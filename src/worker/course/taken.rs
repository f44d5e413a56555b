//! What a run is taken away as: a scene that goes on from it, and a recording; and a recording that it follows.

use super::{Change, Course};
use crate::{
    recording,
    scene::{Method, Resume, Scene},
    worker::tape::{Found, Tape, Taped},
};

impl Course {
    /// Whether no frame is in progress.
    pub(in crate::worker) fn is_whole(&self) -> bool {
        self.whole
    }

    /// The scene from which a run goes on that was where this one is, and whether it does so bit for bit. None if a number
    /// is not finite.
    pub(in crate::worker) fn going_on(&self) -> Option<(Scene, bool)> {
        let (run, settings) = (&self.simulation, self.simulation.settings());
        let (state, transient) = (run.state(), run.transient());
        // a run of events says how it began, or nothing, if that is not enough
        let to_the_bit = !transient.is_empty() || matches!(settings.method, Method::Paper | Method::Moreau);
        let resume = Resume { t: state.t, transient };
        let scene = self.job.scene.going_on(settings, resume, &state.x, &state.v).ok()?;
        Some((scene, to_the_bit))
    }

    /// Makes the recording's changes that are due here, where the next frame was tried in vain or not; whether there were
    /// any.
    pub(super) fn make_due(&mut self, stalled: bool) -> bool {
        let before = self.changes.len();
        let due = |course: &Course, stalled| {
            let script = course.script.as_ref().filter(|_| course.whole || stalled)?;
            script.due(course.changes.len(), course.frame(), stalled)
        };
        let mut stalled = stalled;
        while let Some(settings) = due(self, stalled) {
            self.change(settings);
            stalled = false;
        }
        self.changes.len() > before
    }

    /// Leaves the recording that was followed: beyond its end nothing is compared.
    pub(super) fn leave_script(&mut self) {
        let frame = self.frame();
        if self.script.take_if(|script| !script.goes_on(frame)).is_some() {
            self.found = Some(Found::Beyond(frame));
        }
    }

    /// Takes note of a frame that has ended, before anything is changed there.
    pub(super) fn note_frame(&mut self) {
        if let Some(tape) = &mut self.tape {
            tape.note(&self.simulation);
        }
        if let Some(script) = &mut self.script {
            self.found = script.compare(&self.simulation).or(self.found.take());
        }
    }

    /// What was found of the recording that is followed since the last call.
    pub(in crate::worker) fn take_found(&mut self) -> Option<Found> {
        self.found.take()
    }

    /// Begins a recording where the run is, at its newest frame and between two; false if it could not go on bit for
    /// bit from here.
    pub(in crate::worker) fn begin_tape(&mut self) -> bool {
        let scene = self.going_on().filter(|(_, to_the_bit)| *to_the_bit);
        self.tape = scene.map(|(scene, _)| Tape::begin(&self.simulation, scene, self.changes.len()));
        self.tape.is_some()
    }

    /// Frames of the recording under way, and whether it takes no more.
    pub(in crate::worker) fn taped(&self) -> Option<(u64, bool)> {
        self.tape.as_ref().map(|tape| (tape.frames(), tape.is_full()))
    }

    /// Ends the recording under way.
    pub(in crate::worker) fn end_tape(&mut self) -> Option<Taped> {
        let tape = self.tape.take()?;
        let changes = self.changes[tape.changes..].iter().map(|change| {
            let Change { frame, stalled, settings, .. } = *change;
            recording::Change { frame, stalled, settings }
        });
        Some(tape.end(&self.job.stage.key, changes))
    }
}
