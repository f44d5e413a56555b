//! What the worker's thread does: obey, advance by a slice, report.

use std::{
    collections::VecDeque,
    sync::{
        Arc,
        mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError},
    },
    time::{Duration, Instant},
};

use super::{
    around::Around,
    course::Course,
    goal::Goal,
    job::Job,
    message::{Activity, Command, Report, Said, TakenAway},
    pace::Pace,
    slot::Slot,
};
use crate::{
    audit::Watch,
    measure::{self, Slices},
    physics::{Class, Contact, Progress, Until},
    scene::Settings,
    snapshot::{Alarm, EventLog, Snapshot, Ticks},
};

/// Time between two reports of a running run, s: more often than a screen is drawn.
const TICK: f64 = 1.0 / 60.0;

/// Frames are completed for this long, s, before the commands are looked at again.
const SLICE: f64 = 4e-3;

/// Aim for the length of a call of `advance`, s: two of them and a snapshot stay below 10 ms.
const CALL: f64 = 3e-3;

/// Reports take at most a fifth of the time, however large the scene.
const REPORT_SHARE: f64 = 4.0;

/// Commands that wait for others at most: more than a hand types ahead.
const MOST_WAITING: usize = 1000;

/// A run and its commands.
pub(super) struct Runner {
    pub(super) commands: Receiver<Command>,
    pub(super) clock: Instant,
    pub(super) course: Course,
    pub(super) watch: Watch,
    /// What was wrong before the watch began, in a run that was gone back in.
    pub(super) alarm: Alarm,
    pub(super) snapshot: Arc<Snapshot>,
    pub(super) ticks: Ticks,
    pub(super) log: EventLog,
    pub(super) goal: Goal,
    /// Commands that begin when the goal is reached, in turn.
    pub(super) queue: VecDeque<Command>,
    around: Around,
    /// Where the run is sent at the end of the frame in progress.
    takers: Vec<Sender<TakenAway>>,
    /// Whether a recording begins at the end of the frame in progress.
    pub(super) wants_tape: bool,
    /// What happened in the frame under way, or the one that has just ended.
    pub(super) events: Vec<Contact>,
    /// Whether the next event is of another frame.
    pub(super) frame_is_over: bool,
    pub(super) pace: Pace,
    pub(super) slices: Slices,
    pub(super) obeyed: u64,
    /// What there was to say last, and how many things before.
    pub(super) said: Option<(u64, Said)>,
    /// Whether the simulation has moved since `snapshot` was taken.
    pub(super) moved: bool,
    /// Whether anything has changed since the last report.
    pub(super) unreported: bool,
    /// Whether there may be something to do while the run waits.
    pub(super) scouting: bool,
    /// CPU time spent on advancing since t = 0, s.
    pub(super) cpu: f64,
    /// When the next report of a running run is due, s on `clock`.
    pub(super) report_due: f64,
}

impl Runner {
    pub(super) fn new(job: Job, speed: f64, commands: Receiver<Command>) -> Runner {
        let course = Course::new(job);
        let stage = Arc::clone(&course.job().stage);
        let mut runner = Runner {
            commands,
            clock: Instant::now(),
            snapshot: Arc::new(Snapshot::of(&stage, course.simulation(), None)),
            ticks: Ticks::new(stage.duration),
            log: EventLog::default(),
            watch: Watch::new(course.simulation()),
            alarm: Alarm::default(),
            course,
            goal: Goal::Nowhere,
            queue: VecDeque::new(),
            around: Around::default(),
            takers: Vec::new(),
            wants_tape: false,
            events: Vec::new(),
            frame_is_over: true,
            pace: Pace::new(speed, 0.0, 0.0),
            slices: Slices::of(CALL),
            obeyed: 0,
            said: None,
            moved: false,
            unreported: false,
            scouting: false,
            cpu: 0.0,
            report_due: 0.0,
        };
        runner.note_events();
        runner.tell_found();
        runner
    }

    /// Obeys, advances and reports until no sender of commands is left.
    pub(super) fn run(&mut self, slot: &Slot<Report>) {
        while self.listen() {
            self.take_turns();
            if !self.goal.is_nowhere() {
                self.slice();
                self.take_turns();
                self.scouting = true;
            } else if self.scouting {
                self.scout();
            }
            let now = self.now();
            if self.unreported && (self.goal.is_nowhere() || now >= self.report_due) {
                slot.put(self.report());
                let cost = self.now() - now;
                self.report_due = now + TICK.max(cost * REPORT_SHARE);
            }
        }
    }

    /// Does what is worth doing while the run waits: keyframes near by, and a look ahead.
    fn scout(&mut self) {
        let (work, clock) = (self.slices.work(), || self.clock.elapsed().as_secs_f64());
        let before = self.around.ahead(&self.course).is_some();
        let looks = self.around.look(&self.course, work, clock);
        self.unreported |= self.around.ahead(&self.course).is_some() != before;
        self.scouting = looks || self.course.scout(work, clock);
    }

    /// Keeps and looks for what is asked for around the frame shown.
    fn look_around(&mut self, path: bool, sphere: Option<usize>) {
        self.around.ask(path, sphere);
        self.around.pass(self.course.simulation());
        self.course.go_frame_by_frame(path);
        self.scouting = true;
    }

    /// Obeys what has arrived; sleeps first if there is nothing else to do. False if no sender is left.
    fn listen(&mut self) -> bool {
        let first = match self.rest() {
            Some(0.0) => self.commands.try_recv().map_err(|error| error == TryRecvError::Empty),
            Some(seconds) => {
                let wait = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
                self.commands.recv_timeout(wait).map_err(|error| error == RecvTimeoutError::Timeout)
            }
            None => self.commands.recv().map_err(|_| false),
        };
        match first {
            Ok(command) => self.obey(command),
            Err(connected) => return connected,
        }
        while let Ok(command) = self.commands.try_recv() {
            self.obey(command);
        }
        true
    }

    /// How long there is nothing to do, s: `None` until a command comes.
    fn rest(&self) -> Option<f64> {
        match self.goal {
            Goal::Nowhere => self.scouting.then_some(0.0),
            Goal::On => {
                let now = self.now();
                let due = self.pace.wait(now, self.time());
                // Running ahead of the wall: one tick at least, so that reports set the rhythm.
                let due = if due > 0.0 { due.max(TICK) } else { 0.0 };
                Some(if self.unreported { due.min((self.report_due - now).max(0.0)) } else { due })
            }
            _ => Some(0.0),
        }
    }

    fn obey(&mut self, command: Command) {
        self.obeyed += 1;
        self.unreported = true;
        if self.waits_its_turn(&command) {
            if self.queue.len() < MOST_WAITING {
                self.queue.push_back(command);
            }
            return;
        }
        match command {
            Command::Load(job) => {
                self.goal = Goal::Nowhere;
                self.restart(job);
            }
            Command::Restart => self.begin_again(self.course.settings()),
            Command::Run(true) => self.run_on(),
            Command::Run(false) => {
                self.moved |= self.course.is_past();
                self.head_for(Goal::Nowhere);
            }
            Command::Forward(frames) => self.on(frames),
            Command::Back(frames) => self.back(frames),
            Command::Until(stop) => self.search(stop),
            Command::PreviousImpact => self.back_to_impact(),
            Command::Oldest => self.back(u64::MAX),
            Command::Newest if self.course.is_past() => self.go_to_frame(self.course.newest().0),
            Command::Newest => self.say(Said::Newest),
            Command::Goto(t) => self.go_to_time(t),
            Command::GotoEvent { number, time } => self.go_to_event(number, time),
            Command::Around { path, sphere } => self.look_around(path, sphere),
            Command::TakeAway(taker) => self.hand_over(taker),
            Command::Record => self.record(),
            Command::EndRecording(taker) => {
                self.wants_tape = false;
                let _ = taker.send(self.course.end_tape()); // perhaps no longer waited for
            }
            Command::Speed(wanted) => self.pace = Pace::new(wanted, self.now(), self.time()),
            Command::Settings(settings) => self.solve_with(settings),
            #[cfg(debug_assertions)]
            Command::Panic => panic!("asked to panic"),
        }
    }

    pub(super) fn say(&mut self, said: Said) {
        let count = self.said.as_ref().map_or(0, |(count, _)| *count);
        self.said = Some((count + 1, said));
    }

    pub(super) fn time(&self) -> f64 {
        self.course.time()
    }

    /// Sets the run going from the frame shown, on and on.
    fn run_on(&mut self) {
        self.branch();
        self.head_for(Goal::On);
    }

    /// Has the run go on from the frame shown, and says that the later ones are dropped.
    fn branch(&mut self) {
        let recorded = self.course.taped().is_some();
        let frames = self.cut();
        if recorded && self.course.taped().is_none() {
            self.say(Said::RecordingLost);
        } else if frames > 0 {
            let t = self.time();
            self.say(Said::Dropped { frames, t });
        }
    }

    /// Hands the run over where it is, or at the end of the frame in progress.
    fn hand_over(&mut self, taker: Sender<TakenAway>) {
        self.takers.push(taker);
        if self.course.is_whole() || self.course.stall().is_some() {
            self.give_takers();
        } else if self.goal.is_nowhere() {
            self.head_for(Goal::Frame(self.course.frame() + 1));
        }
    }

    fn give_takers(&mut self) {
        if self.takers.is_empty() {
            return;
        }
        let (scene, to_the_bit) = self.course.going_on().unzip();
        let snapshot = Arc::new(Snapshot::of(&self.course.job().stage, self.course.simulation(), self.course.stall()));
        let taken = TakenAway { scene, to_the_bit: to_the_bit == Some(true), snapshot };
        for taker in self.takers.drain(..) {
            let _ = taker.send(taken.clone()); // perhaps no longer waited for
        }
    }

    /// Drops the frames after the one shown, with what they have told; the number of frames dropped.
    pub(super) fn cut(&mut self) -> u64 {
        if !self.course.is_past() {
            return 0;
        }
        let frames = self.course.branch();
        let run = self.course.simulation();
        self.ticks.cut(run.time(), run.tallies().impacts);
        self.log.cut(self.course.events());
        self.around.cut(Some(self.course.frame()));
        self.alarm = until(both(&self.alarm, self.watch.alarm()), run.time());
        self.watch = Watch::new(run);
        self.events.clear();
        self.moved = true;
        frames
    }

    fn solve_with(&mut self, settings: Settings) {
        self.branch();
        let waits = self.course.set(settings);
        self.note_events();
        self.moved = true;
        if waits && self.goal.is_nowhere() {
            self.head_for(Goal::Frame(self.course.frame() + 1));
        }
    }

    pub(super) fn begin_again(&mut self, settings: Settings) {
        let on = matches!(self.goal, Goal::On);
        let job = self.course.job();
        let settings = job.recording.as_ref().map_or(settings, |recording| recording.settings);
        self.restart(Job { settings, ..job.clone() });
        self.head_for(if on { Goal::On } else { Goal::Nowhere });
    }

    fn restart(&mut self, job: Job) {
        self.ticks = Ticks::new(job.stage.duration);
        self.log = EventLog::default();
        self.course = Course::new(job);
        self.wants_tape = false;
        self.watch = Watch::new(self.course.simulation());
        self.alarm = Alarm::default();
        self.events.clear();
        self.around.cut(None);
        self.around.pass(self.course.simulation());
        self.course.go_frame_by_frame(self.around.follows());
        self.note_events();
        self.cpu = 0.0;
        self.moved = true;
        self.tell_found();
    }

    /// Takes note of what has happened for the first time since the last call, and tells it.
    pub(super) fn note_events(&mut self) -> Vec<Contact> {
        let events = self.course.take_events();
        let course = &self.course;
        if course.is_past() {
            return events;
        }
        let impacts = events.iter().filter(|event| event.class == Class::Collide);
        let before = course.events() - events.len() as u64;
        if before < self.log.total() {
            // another method begins where a run does: what the one before made of that is forgotten
            self.log.cut(before);
            self.ticks.cut(course.time(), course.impacts() - impacts.clone().map(Contact::impact_count).sum::<u64>());
        }
        impacts.for_each(|event| self.ticks.add(event.time));
        events.iter().for_each(|event| self.log.add(event));
        events
    }

    /// Advances for about [`SLICE`], or to the goal, or up to what is due.
    fn slice(&mut self) {
        let (start, worked) = (self.now(), measure::thread_cpu());
        let until = match self.goal {
            Goal::On => Until::Time(self.pace.target(start, self.course.time())),
            _ => self.goal.until(self.course.time()),
        };
        while !self.goal.is_nowhere() && self.now() - start < SLICE {
            if matches!((&self.goal, until), (Goal::On, Until::Time(t)) if self.time() >= t) {
                break;
            }
            self.advance(until);
        }
        if !self.course.is_past() {
            self.cpu += measure::thread_cpu() - worked;
        }
        let (now, time) = (self.now(), self.time());
        self.pace.measure(now, time);
    }

    /// Calls into the run once, and does what follows from it.
    fn advance(&mut self, until: Until) {
        let before = self.now();
        let progress = self.course.advance(until, self.slices.work());
        let took = self.now() - before;
        if !self.course.is_past() {
            self.watch.look(self.course.simulation(), false);
            self.moved = true;
        }
        self.unreported = true;
        if std::mem::take(&mut self.frame_is_over) {
            self.events.clear();
        }
        self.events.extend(self.course.take_passed());
        let events = self.note_events();
        self.events.extend(events);
        match progress {
            Progress::Reached => {
                self.give_takers();
                self.begin_tape();
                self.frame_is_over = true;
                self.around.pass(self.course.simulation());
                self.arrive();
                self.tell_found();
            }
            Progress::Yielded => self.slices.learn(took),
            Progress::Stalled(_) => {
                self.give_takers();
                self.goal = Goal::Nowhere;
                self.queue.clear();
            }
        }
    }

    /// A report of the run at the end of its last frame.
    pub(super) fn report(&mut self) -> Report {
        let is_past = self.course.is_past();
        if self.moved {
            let run = self.course.simulation();
            if !is_past {
                self.watch.look(run, true);
            }
            let snapshot = Snapshot::of(&self.course.job().stage, run, self.course.stall());
            let alarm = until(both(&self.alarm, self.watch.alarm()), snapshot.t);
            let acting = self.course.acting().to_vec();
            self.snapshot = Arc::new(Snapshot { alarm, acting, ..snapshot });
        }
        self.moved = false;
        self.unreported = false;
        Report {
            snapshot: Arc::clone(&self.snapshot),
            ticks: Arc::new(self.ticks.clone()),
            log: Arc::new(self.log.clone()),
            activity: match (&self.goal, self.course.stall()) {
                (Goal::Nowhere, Some(_)) => Activity::Stalled,
                (Goal::Nowhere, None) => Activity::Paused,
                _ => Activity::Running,
            },
            wanted: self.pace.wanted(),
            reached: self.pace.reached(),
            obeyed: self.obeyed,
            settings: self.course.settings(),
            recorded: self.course.taped().map(|(frames, _)| frames),
            kept: self.course.kept(),
            trail: self.around.trail(self.course.frame()),
            ahead: self.around.ahead(&self.course),
            said: self.said,
            cpu: self.cpu,
            panic: None,
        }
    }

    pub(super) fn now(&self) -> f64 {
        self.clock.elapsed().as_secs_f64()
    }
}

/// What either alarm tells; of one kind the earlier.
fn both(before: &Alarm, after: &Alarm) -> Alarm {
    Alarm {
        overlap: before.overlap.or(after.overlap),
        energy: before.energy.or(after.energy),
        cause: before.cause.or(after.cause),
    }
}

/// The part of an alarm that was there already at `t`, s.
fn until(alarm: Alarm, t: f64) -> Alarm {
    let energy = alarm.energy.filter(|it| it.time <= t);
    Alarm { overlap: alarm.overlap.filter(|it| it.time <= t), energy, cause: alarm.cause.filter(|_| energy.is_some()) }
}
