//! Where a run ends its advance, on or back.

use super::{course::Course, stop::Search};
use crate::physics::Until;

/// Where a run goes. Frames on the way to an earlier place are not shown; where the run goes on, they are.
#[derive(Debug)]
pub(super) enum Goal {
    Nowhere,
    /// On, at the pace set.
    On,
    /// To the end of this frame.
    Frame(u64),
    /// Back to the end of this frame, as if the run had not gone on from there.
    Return(u64),
    /// To a frame that ends at or after this time, s.
    Time(f64),
    /// To the frame in which the event of this number has happened, which ends at or after this time, s.
    Event(u64, f64),
    /// Until something comes.
    Until(Box<Search>),
    /// Back to the last frame with an impact before this one.
    Impact(Back),
}

/// The way back to an impact: the impacts from a keyframe on are counted, up to the frame before the one shown. If there is
/// none among them, it is where the count came to what it was at the keyframe.
#[derive(Debug, Clone, Copy)]
pub(super) struct Back {
    /// The frame that was shown.
    pub(super) from: u64,
    /// Impacts counted so far.
    count: u64,
    /// The last frame with an impact, as far as one was found.
    found: Option<u64>,
    /// Whether the run goes to the frame with this count.
    last: bool,
}

/// What comes after a frame on the way to a goal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    /// More frames.
    On,
    /// Nothing: the run has reached its goal.
    There,
    /// Nothing: there is no impact before, and the run is back where it was.
    InVain,
}

impl Goal {
    pub(super) fn is_nowhere(&self) -> bool {
        matches!(self, Goal::Nowhere)
    }

    /// How far one call may go in a run that is at `time`, s.
    pub(super) fn until(&self, time: f64) -> Until {
        match self {
            Goal::Time(t) => Until::Time(*t),
            Goal::Event(_, t) if *t > time => Until::Time(*t),
            _ => Until::Frame,
        }
    }
}

impl Back {
    /// Sets out from the frame that is shown; none if no frame is before it.
    pub(super) fn begin(course: &mut Course) -> Option<Back> {
        let from = course.frame();
        if from <= course.oldest().0 {
            return None;
        }
        course.set_out(from - 1);
        Some(Back { from, count: course.impacts(), found: None, last: false })
    }

    /// Looks at the frame that the run is at.
    pub(super) fn look(&mut self, course: &mut Course) -> Way {
        let impacts = course.impacts();
        if self.last {
            return if impacts >= self.count { Way::There } else { Way::On };
        }
        if impacts > self.count {
            (self.count, self.found) = (impacts, Some(course.frame()));
        }
        if !course.is_at(self.from - 1) {
            return Way::On;
        }
        match self.found {
            Some(frame) if frame == course.frame() => Way::There,
            None if !course.set_out_for_impact(self.count) => Way::InVain,
            found => {
                if let Some(frame) = found {
                    course.set_out(frame);
                }
                self.last = true;
                self.look(course)
            }
        }
    }
}
