//! Where the run is headed: it sets out for a frame, a time, an event or what is waited for, and knows when it is there.

use super::{
    goal::{Back, Goal, Way},
    message::Said,
    pace::Pace,
    run::Runner,
    stop::{Search, Stop},
};

impl Runner {
    pub(super) fn head_for(&mut self, goal: Goal) {
        self.goal = goal;
        self.pace = Pace::new(self.pace.wanted(), self.now(), self.time());
    }

    /// The frame shown, or the one that the run is on its way to.
    pub(super) fn frame_ahead(&self) -> u64 {
        if let Goal::Frame(frame) = self.goal { frame } else { self.course.frame() }
    }

    pub(super) fn back(&mut self, frames: u64) {
        let (ahead, (oldest, t, _)) = (self.frame_ahead(), self.course.oldest());
        if ahead <= oldest {
            self.say(if oldest == 0 { Said::Start } else { Said::Oldest { t } });
            self.head_for(Goal::Nowhere);
        } else {
            self.go_to_frame(ahead.saturating_sub(frames).max(oldest));
        }
    }

    /// To the end of a frame, back or on.
    pub(super) fn go_to_frame(&mut self, frame: u64) {
        self.course.set_out(frame);
        self.head_for(Goal::Frame(frame));
        self.arrive();
    }

    /// To the first frame that ends at or after `t`, s; a time before all that is kept is reached from the start.
    pub(super) fn go_to_time(&mut self, t: f64) {
        let (oldest, from, _) = self.course.oldest();
        if t < from && oldest > 0 {
            self.begin_again(self.course.settings());
        }
        self.course.set_out_for(t);
        self.head_for(Goal::Time(t));
        self.arrive();
    }

    /// Goes on until something comes.
    pub(super) fn search(&mut self, stop: Stop) {
        let search = Search::new(stop, &self.course);
        match stop {
            Stop::Time(t) if t <= search.from.1 => {
                self.say(Said::Past { t });
                self.head_for(Goal::Nowhere);
            }
            _ => self.head_for(Goal::Until(Box::new(search))),
        }
    }

    /// To the frame of an event in the list.
    pub(super) fn go_to_event(&mut self, number: u64, time: f64) {
        let (oldest, t, _) = self.course.oldest();
        if time < t && oldest > 0 {
            return self.say(Said::Oldest { t });
        }
        self.course.set_out_for(time);
        self.head_for(Goal::Event(number, time));
        self.arrive();
    }

    /// A frame, or the time asked for, is complete: is that where the run was going?
    pub(super) fn arrive(&mut self) {
        let course = &mut self.course;
        let frame = course.frame();
        let there = match &mut self.goal {
            Goal::Nowhere | Goal::On => false,
            Goal::Frame(target) => frame > *target || course.is_at(*target),
            Goal::Return(target) if frame > *target || course.is_at(*target) => {
                self.cut();
                true
            }
            Goal::Return(_) => false,
            Goal::Time(t) => course.time() >= *t && course.is_at(frame),
            Goal::Event(number, t) => course.time() >= *t && course.events() >= *number && course.is_at(frame),
            Goal::Impact(back) => {
                let way = back.look(course);
                return self.follow(way);
            }
            Goal::Until(_) => return self.look_for_stop(),
        };
        if there {
            self.stop_here();
        }
    }

    /// What comes next on the way back to an impact.
    pub(super) fn follow(&mut self, way: Way) {
        match (way, &self.goal) {
            (Way::There, _) => self.stop_here(),
            (Way::InVain, Goal::Impact(Back { from, .. })) => {
                self.go_to_frame(*from);
                self.say(Said::NoEarlierImpact);
            }
            _ => {}
        }
    }

    fn stop_here(&mut self) {
        self.goal = Goal::Nowhere;
        self.moved = true;
    }

    /// Whether what was waited for has come, or the scene's duration is over without it: then back to where it began.
    fn look_for_stop(&mut self) {
        let Goal::Until(search) = &mut self.goal else { return };
        let run = self.course.simulation();
        let (t, stop, within) = (run.time(), search.stop, search.within);
        if let Some(met) = search.met(run, &self.events) {
            self.stop_here();
            return self.say(Said::Met { stop, met, t });
        }
        let ((frame, from), in_the_past) = (search.from, search.in_the_past);
        if t < from + within {
            return;
        }
        self.say(Said::Nothing { stop, from, within });
        self.course.set_out(frame);
        self.head_for(if in_the_past { Goal::Frame(frame) } else { Goal::Return(frame) });
        self.arrive();
    }
}
