//! Where the run is headed: it sets out for a frame, a time, an event or what is waited for, and knows when it is there.

use super::{
    goal::{Back, Goal, Way},
    message::{Command, Said},
    pace::Pace,
    run::Runner,
    stop::{Search, Stop},
};

impl Runner {
    /// Whether a command waits until the run is where it is headed: searches and steps in a burst are made one after the
    /// other, each from where the one before has led. Whatever else is asked for comes at once, and they are given up.
    pub(super) fn waits_its_turn(&mut self, command: &Command) -> bool {
        let searching = matches!(self.goal, Goal::Until(_) | Goal::Impact(_) | Goal::Event(..) | Goal::Return(_));
        let waits = match command {
            Command::Speed(_)
            | Command::Around { .. }
            | Command::TakeAway(_)
            | Command::Record
            | Command::EndRecording(_) => return false,
            Command::Until(_) | Command::PreviousImpact => !matches!(self.goal, Goal::Nowhere | Goal::On),
            // frames under way add up
            Command::Forward(_) | Command::Back(_) => searching || !self.queue.is_empty(),
            _ => false,
        };
        if !waits {
            self.queue.clear();
        }
        waits
    }

    /// Begins with the command that comes next, where the run has reached its goal.
    pub(super) fn take_turns(&mut self) {
        while self.goal.is_nowhere()
            && let Some(command) = self.queue.pop_front()
        {
            match command {
                Command::Until(stop) => self.search(stop),
                Command::Forward(frames) => self.on(frames),
                Command::Back(frames) => self.back(frames),
                _ => self.back_to_impact(),
            }
        }
    }

    /// Goes on by `frames`; in a run that was gone back in, up to the newest.
    pub(super) fn on(&mut self, frames: u64) {
        let newest = if self.course.is_past() { self.course.newest().0 } else { u64::MAX };
        self.go_to_frame(self.frame_ahead().saturating_add(frames).min(newest));
    }

    /// Goes back to the frame with the impact before.
    pub(super) fn back_to_impact(&mut self) {
        match Back::begin(&mut self.course) {
            Some(mut back) => {
                let way = back.look(&mut self.course);
                self.head_for(Goal::Impact(back));
                self.follow(way);
            }
            None => self.say(Said::NoEarlierImpact),
        }
    }

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

    /// Goes to the end of a frame, back or on.
    pub(super) fn go_to_frame(&mut self, frame: u64) {
        self.course.set_out(frame);
        self.head_for(Goal::Frame(frame));
        self.arrive();
    }

    /// Goes to the first frame that ends at or after `t`, s; a time before all that is kept is reached from the start.
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

    /// Goes to the frame of an event in the list.
    pub(super) fn go_to_event(&mut self, number: u64, time: f64) {
        let (oldest, t, _) = self.course.oldest();
        if time < t && oldest > 0 {
            return self.say(Said::Oldest { t });
        }
        self.course.set_out_for(time);
        self.head_for(Goal::Event(number, time));
        self.arrive();
    }

    /// Looks whether the run has reached its goal, once a frame, or the time asked for, is complete.
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

    /// Does what comes next on the way back to an impact.
    pub(super) fn follow(&mut self, way: Way) {
        match (way, &self.goal) {
            (Way::There, _) => self.stop_here(),
            (Way::InVain, Goal::Impact(Back { from, .. })) => {
                self.go_to_frame(*from);
                self.queue.clear();
                self.say(Said::NoEarlierImpact);
            }
            _ => {}
        }
    }

    pub(super) fn stop_here(&mut self) {
        self.goal = Goal::Nowhere;
        (self.moved, self.scouting) = (true, true);
    }

    /// Looks whether what was waited for has come, or the scene's duration is over without it: then the run goes back to
    /// where it began.
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
        self.queue.clear();
        self.course.set_out(frame);
        self.head_for(if in_the_past { Goal::Frame(frame) } else { Goal::Return(frame) });
        self.arrive();
    }
}
