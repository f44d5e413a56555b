//! A run that can be gone back in: the simulation, what is kept of its past, and where it had come to.
//!
//! Going back begins with the nearest keyframe before, and does again what was done from there, changes of settings
//! included, each at its frame: bit for bit what there was. The run as it had come is put aside meanwhile, and taken up
//! again when that frame is reached. Changes wait for the end of the frame under way, so that they can be done again.

mod nearby;
mod scout;
mod taken;

use super::{
    acting::Acting,
    job::Job,
    keyframes::{CLOSE, Keyframes, RECENT},
    replay_cost::Meter,
    tape::{Found, Script, Tape},
};
use crate::{
    physics::{Contact, Progress, Simulation, Stall, Until},
    scene::{Method, Settings},
    snapshot::Kept,
};
use scout::Scout;

/// Changes that are remembered: more than a hand makes in hours. When there are more, the history begins anew.
const MOST_CHANGES: usize = 1 << 16;

/// Counted work, ns, after which a call is over: commands are looked at again.
const CALL: u64 = 1_000_000;

/// A change of settings.
#[derive(Debug, Clone, Copy)]
struct Change {
    /// Number of frames completed before the change.
    frame: u64,
    /// Time of the change, s.
    time: f64,
    /// Whether the next frame had been tried, and could not be.
    stalled: bool,
    settings: Settings,
}

/// The run where it had come to, while an earlier frame is shown.
#[derive(Debug)]
struct Newest {
    simulation: Simulation,
    stall: Option<Stall>,
    whole: bool,
    acting: Acting,
}

/// A run and its past.
#[derive(Debug)]
pub(super) struct Course {
    job: Job,
    simulation: Simulation,
    stall: Option<Stall>,
    /// Whether no frame is in progress.
    whole: bool,
    /// Settings that wait for the end of the frame in progress.
    waiting: Option<Settings>,
    keyframes: Keyframes,
    changes: Vec<Change>,
    /// How many of the changes are in the simulation.
    changed: usize,
    /// Whether the run can be begun again, with all its changes.
    from_start: bool,
    /// Time at the beginning of the run, s.
    begun: f64,
    /// Impacts at the beginning of the run.
    first_impacts: u64,
    newest: Option<Box<Newest>>,
    /// The earlier frame that the run is on its way to from a keyframe, and what counts the work since that or the one kept
    /// last.
    toward: Option<(u64, Meter)>,
    scout: Option<Box<Scout>>,
    /// The frame that was shown when a scout came home last.
    scouted: Option<u64>,
    /// Whether every call ends with a frame.
    frame_by_frame: bool,
    /// The recording under way.
    tape: Option<Tape>,
    /// The recording that is followed.
    script: Option<Script>,
    /// What was found of the recording that is followed, and not told yet.
    found: Option<Found>,
    /// What has happened again and was not told yet.
    passed: Vec<Contact>,
    /// What acts over the frame shown, or in progress, from the one before.
    acting: Acting,
}

impl Course {
    /// The job's run at t = 0.
    pub(super) fn new(job: Job) -> Course {
        let simulation = begin(&job);
        let mut script = job.recording.clone().map(Script::new);
        let found = script.as_mut().and_then(|script| script.compare(&simulation));
        Course {
            begun: simulation.time(),
            first_impacts: simulation.tallies().impacts,
            keyframes: Keyframes::of(&simulation),
            job,
            simulation,
            stall: None,
            whole: true,
            waiting: None,
            changes: Vec::new(),
            changed: 0,
            from_start: true,
            newest: None,
            toward: None,
            scout: None,
            scouted: None,
            frame_by_frame: false,
            tape: None,
            script,
            found,
            passed: Vec::new(),
            acting: Acting::default(),
        }
    }

    /// The job.
    pub(super) fn job(&self) -> &Job {
        &self.job
    }

    /// The run as it is shown.
    pub(super) fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// What has happened for the first time since the last call.
    pub(super) fn take_events(&mut self) -> Vec<Contact> {
        self.simulation.take_events()
    }

    /// What has happened again since the last call, in frames that were done again.
    pub(super) fn take_passed(&mut self) -> Vec<Contact> {
        std::mem::take(&mut self.passed)
    }

    /// Why the run cannot go on, if it cannot.
    pub(super) fn stall(&self) -> Option<&Stall> {
        self.stall.as_ref()
    }

    /// Settings of the run, or those that it will have from the next frame on.
    pub(super) fn settings(&self) -> Settings {
        self.waiting.unwrap_or(self.simulation.settings())
    }

    /// Time at the end of the last frame, s.
    pub(super) fn time(&self) -> f64 {
        self.simulation.time()
    }

    /// Impacts so far.
    pub(super) fn impacts(&self) -> u64 {
        self.simulation.tallies().impacts
    }

    /// Events so far.
    pub(super) fn events(&self) -> u64 {
        let tallies = self.simulation.tallies();
        tallies.impacts + tallies.rests + tallies.releases
    }

    /// Frames completed.
    pub(super) fn frame(&self) -> u64 {
        self.simulation.tallies().frames
    }

    /// Whether later frames than the one shown are kept.
    pub(super) fn is_past(&self) -> bool {
        self.newest.is_some()
    }

    /// The newest frame and its time, s.
    pub(super) fn newest(&self) -> (u64, f64) {
        let run = self.newest.as_ref().map_or(&self.simulation, |newest| &newest.simulation);
        (run.tallies().frames, run.time())
    }

    /// The first frame that can be gone back to, its time, s, and the impacts until then.
    pub(super) fn oldest(&self) -> (u64, f64, u64) {
        let first = self.keyframes.first().map(|kept| (kept.frame, kept.time, kept.impacts));
        match first {
            _ if self.from_start => (0, self.begun, self.first_impacts),
            Some(first) => first,
            None => (self.newest().0, self.newest().1, u64::MAX),
        }
    }

    /// Which frames of the run can be gone to.
    pub(super) fn kept(&self) -> Kept {
        let (newest, until) = self.newest();
        let oldest = self.oldest();
        let (oldest, from) = self.keyframes.front().unwrap_or((oldest.0, oldest.1));
        Kept { oldest, from, newest, until, is_past: self.is_past() }
    }

    /// Sets other settings from here on, or from the end of the frame in progress; whether they wait for that. The run is
    /// at its newest frame. It follows no recording any more.
    pub(super) fn set(&mut self, settings: Settings) -> bool {
        self.script = None;
        if !self.whole && self.stall.is_none() {
            self.waiting = Some(settings);
            return true;
        }
        self.change(settings);
        false
    }

    /// Makes a change where the run is, and notes it.
    fn change(&mut self, settings: Settings) {
        if self.changes.len() >= MOST_CHANGES {
            self.begin_anew();
        }
        let (frame, time) = (self.frame(), self.time());
        let stalled = self.stall.is_some();
        self.changes.push(Change { frame, time, stalled, settings });
        self.apply(settings);
        if frame == 0 {
            self.first_impacts = self.simulation.tallies().impacts;
        }
    }

    /// Makes the change that comes next.
    fn apply(&mut self, settings: Settings) {
        let before = self.simulation.settings().method;
        // a frame that cannot be is given up, but by a run of events that goes on by the same method
        let open = before == settings.method && matches!(before, Method::Exact | Method::Swept);
        self.whole = self.whole || !open;
        self.simulation.set_settings(settings);
        (self.stall, self.waiting) = (None, None);
        self.changed += 1;
    }

    /// Has every call end with a frame, or not.
    pub(super) fn go_frame_by_frame(&mut self, on: bool) {
        self.frame_by_frame = on;
    }

    /// Goes on to the goal, for about `work` units, or to a frame before it where there is something to do. Frames are kept
    /// on the way.
    pub(super) fn advance(&mut self, until: Until, work: u64) -> Progress {
        if self.is_past() {
            let progress = self.replay(until, work);
            self.keep_on_the_way();
            return progress;
        }
        let mut done = 0;
        loop {
            let frame_by_frame = self.goes_frame_by_frame();
            let progress = self.advance_a_leg(until, work);
            if !self.whole {
                return progress;
            }
            done += self.keyframes.look(&self.simulation, (self.changed, &self.acting));
            let there = until == Until::Frame || matches!(until, Until::Time(t) if t <= self.time());
            if there || progress != Progress::Reached || done > CALL || frame_by_frame {
                return progress;
            }
        }
    }

    /// Calls [`Simulation::advance`] once.
    fn advance_a_leg(&mut self, until: Until, work: u64) -> Progress {
        self.make_due(false);
        self.leave_script();
        self.note_acting();
        let before = self.frame();
        let until = self.leg(until);
        let progress = self.simulation.advance(until, work);
        self.whole = progress == Progress::Reached;
        if let Progress::Stalled(stall) = &progress {
            self.stall = Some(stall.clone());
        }
        // also one at whose end the run cannot go on
        if self.frame() > before {
            self.note_frame();
        }
        match (self.waiting, &progress) {
            (Some(settings), Progress::Reached) => self.change(settings),
            (Some(settings), Progress::Stalled(_)) => {
                self.change(settings);
                return Progress::Yielded; // tried again
            }
            (None, Progress::Stalled(_)) if self.make_due(true) => return Progress::Yielded,
            _ => {}
        }
        progress
    }

    /// How far one call goes on the way to a goal: a frame, so that it can be kept, unless they are too many.
    fn leg(&mut self, until: Until) -> Until {
        match until {
            Until::Time(t) if !self.goes_frame_by_frame() && !self.simulation.counts_frames_to(t) => {
                self.found = self.from_start.then_some(Found::Anew).or(self.found.take());
                self.begin_anew(); // frames are as long as this goal makes them: they could not be found again
                until
            }
            _ => Until::Frame,
        }
    }

    /// Whether a call ends with every frame.
    fn goes_frame_by_frame(&self) -> bool {
        let follows = || self.script.as_ref().is_some_and(|script| script.goes_on(self.frame()));
        self.frame_by_frame || self.waiting.is_some() || self.tape.is_some() || follows()
    }

    /// Notes what acts over the next frame, if none is in progress.
    fn note_acting(&mut self) {
        if self.whole {
            self.acting.note(&self.simulation);
        }
    }

    /// Impacts of the frame before whose impulses have acted over the frame shown.
    pub(super) fn acting(&self) -> &[Contact] {
        self.acting.over(&self.simulation)
    }

    /// Does again what was done from here on, up to the goal or the next change.
    fn replay(&mut self, until: Until, work: u64) -> Progress {
        if let Some(change) = self.due() {
            // it was made when the next frame had turned out to be impossible
            if self.simulation.advance(Until::Frame, work) == Progress::Yielded {
                return Progress::Yielded;
            }
            self.whole = false;
            self.apply(change.settings);
        } else {
            let next = self.changes.get(self.changed).map_or(f64::INFINITY, |change| change.time);
            let seen = self.frame_by_frame || self.simulation.settings().method == Method::Paper;
            self.note_acting();
            let until = match until {
                Until::Time(t) if !seen && t.min(next) > self.simulation.time() => Until::Time(t.min(next)),
                _ => Until::Frame,
            };
            let progress = self.simulation.advance(until, work);
            self.whole = progress == Progress::Reached;
            if progress == Progress::Yielded {
                return progress;
            }
        }
        self.passed.extend(self.simulation.take_events());
        self.catch_up();
        Progress::Reached
    }

    /// Makes the changes that were made at this frame before the next was tried; takes up the newest frame if this is it.
    fn catch_up(&mut self) {
        if self.newest.as_ref().is_some_and(|newest| newest.simulation.tallies().frames <= self.frame()) {
            return self.take_up();
        }
        while let Some(change) = self.changes.get(self.changed).filter(|c| c.frame <= self.frame() && !c.stalled) {
            self.apply(change.settings);
        }
    }

    /// The change that must be made before the next frame, once that has been tried.
    fn due(&self) -> Option<Change> {
        self.changes.get(self.changed).copied().filter(|change| change.frame <= self.frame())
    }

    /// Whether the run is at the end of `frame`, all changes that were made there included.
    pub(super) fn is_at(&self, frame: u64) -> bool {
        self.frame() == frame && (!self.is_past() || self.due().is_none())
    }

    /// Goes back to the newest frame.
    pub(super) fn take_up(&mut self) {
        if let Some(newest) = self.newest.take() {
            let Newest { simulation, stall, whole, acting } = *newest;
            (self.simulation, self.stall, self.whole) = (simulation, stall, whole);
            self.acting = acting;
            self.changed = self.changes.len();
        }
    }

    /// Sets out for the end of `frame`, no earlier than the oldest and no later than the newest: the run is then there
    /// or before, and [`Course::advance`] leads there.
    pub(super) fn set_out(&mut self, frame: u64) {
        let frame = frame.max(self.oldest().0);
        if frame >= self.newest().0 {
            return self.take_up();
        }
        self.toward = None;
        let here = (self.is_past() && self.whole && self.frame() <= frame).then_some(self.frame());
        let keyframe = self.keyframes.before(frame);
        if here.is_some_and(|here| keyframe.is_none_or(|kept| kept.frame <= here)) {
            return;
        }
        let (run, changes, acting) = match keyframe {
            Some(kept) => (kept.run(), kept.changes, kept.acting.clone()),
            None => (begin(&self.job), 0, Acting::default()),
        };
        self.put_aside(run, changes, acting);
        self.toward = Some((frame, Meter::of(&self.simulation)));
    }

    /// Sets out for the first frame that ends at or after `time`, s.
    pub(super) fn set_out_for(&mut self, time: f64) {
        if time > self.newest().1 {
            return self.take_up();
        }
        let before = self.keyframes.last_where(|kept| kept.time < time).map_or(self.oldest().0, |kept| kept.frame);
        let on_the_way = self.is_past() && self.whole && self.time() < time && self.frame() >= before;
        if !on_the_way {
            self.set_out(before);
        }
    }

    /// Sets out for the first frame with `impacts` impacts; false if it was before all that is kept.
    pub(super) fn set_out_for_impact(&mut self, impacts: u64) -> bool {
        let (oldest, _, least) = self.oldest();
        if impacts <= least {
            return false;
        }
        let before = self.keyframes.last_where(|kept| kept.impacts < impacts).map(|kept| kept.frame);
        self.set_out(before.unwrap_or(oldest));
        true
    }

    /// Shows an earlier run, of which `changes` changes have been made.
    fn put_aside(&mut self, run: Simulation, changes: usize, acting: Acting) {
        let before = std::mem::replace(&mut self.simulation, run);
        let (stall, whole) = (self.stall.take(), std::mem::replace(&mut self.whole, true));
        let acting = std::mem::replace(&mut self.acting, acting);
        if self.newest.is_none() {
            self.newest = Some(Box::new(Newest { simulation: before, stall, whole, acting }));
        }
        (self.waiting, self.changed) = (None, changes);
        self.catch_up();
    }

    /// Lets the run go on from here: later frames are dropped; the number of them.
    pub(super) fn branch(&mut self) -> u64 {
        let Some(newest) = self.newest.take() else { return 0 };
        self.keyframes.cut(&self.simulation);
        self.scouted = None;
        self.changes.truncate(self.changed);
        let frame = self.frame();
        self.tape = self.tape.take_if(|tape| tape.cut(frame));
        newest.simulation.tallies().frames - self.frame()
    }

    /// Forgets all that was before.
    fn begin_anew(&mut self) {
        self.keyframes = Keyframes::none(&self.simulation);
        self.changes.clear();
        self.changed = 0;
        (self.tape, self.script) = (None, None);
        self.from_start = false;
    }
}

/// The job's simulation at t = 0, keeping the events that the collision ticks count, and what explains a frame.
fn begin(job: &Job) -> Simulation {
    let mut simulation = Simulation::new(&job.scene, job.settings);
    simulation.record_events(true);
    simulation.explain(true);
    simulation
}

#[cfg(test)]
mod tests;
