//! Recording a run, and what it tells of the recording that it follows.

use super::{goal::Goal, message::Said, run::Runner, tape::Found};

impl Runner {
    /// Begins a recording, now or at the end of the frame in progress.
    pub(super) fn record(&mut self) {
        if self.course.is_past() {
            return self.say(Said::RecordingInThePast);
        }
        self.wants_tape = self.course.taped().is_none();
        if self.course.is_whole() {
            self.begin_tape();
        } else if self.goal.is_nowhere() && self.course.stall().is_none() {
            self.head_for(Goal::Frame(self.course.frame() + 1));
        }
    }

    /// Begins the recording that was asked for, between two frames.
    pub(super) fn begin_tape(&mut self) {
        if !std::mem::take(&mut self.wants_tape) || self.course.is_past() {
            return;
        }
        let t = self.time();
        let said = if self.course.begin_tape() { Said::Recording { t } } else { Said::NotRecordable };
        self.say(said);
    }

    /// Says what was found of the recording that is followed, and stops there; says when the one under way is full.
    pub(super) fn tell_found(&mut self) {
        if let Some((frames, true)) = self.course.taped()
            && !matches!(self.said, Some((_, Said::RecordingFull { .. })))
        {
            self.say(Said::RecordingFull { frames });
        }
        let t = self.time();
        match self.course.take_found() {
            Some(Found::Differs(frame, suspect)) => self.say(Said::Differs { frame, t, suspect }),
            Some(Found::End(frame, same)) => self.say(Said::RecordingEnds { frame, same }),
            Some(Found::Beyond(frame)) => return self.say(Said::BeyondRecording { frame }),
            Some(Found::Anew) => return self.say(Said::Anew { t }),
            None => return,
        }
        self.stop_here();
        self.queue.clear();
    }
}
