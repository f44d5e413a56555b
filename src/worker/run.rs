//! What the worker's thread does: obey, advance by a slice, report.

use std::{
    sync::{
        Arc,
        mpsc::{Receiver, RecvTimeoutError, TryRecvError},
    },
    time::{Duration, Instant},
};

use super::{
    message::{Activity, Command, Job, Report},
    pace::Pace,
    slot::Slot,
};
use crate::{
    audit::Watch,
    measure::{self, Slices},
    physics::{Class, Progress, Simulation, Stall, Until},
    scene::Settings,
    snapshot::{Snapshot, Ticks},
};

/// Time between two reports of a running run, s: more often than a screen is drawn.
const TICK: f64 = 1.0 / 60.0;

/// Frames are completed for this long, s, before the commands are looked at again.
const SLICE: f64 = 4e-3;

/// Aim for the length of a call of `advance`, s: two of them and a snapshot stay below 10 ms.
const CALL: f64 = 3e-3;

/// Reports take at most a fifth of the time, however large the scene.
const REPORT_SHARE: f64 = 4.0;

/// Where the run ends its advance.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Goal {
    Nowhere,
    /// On, at the pace set.
    On,
    /// So many frames further.
    Frames(u64),
    /// To a frame after which there have been more impacts than `past`, or that ends after `last`, s.
    Impact {
        past: u64,
        last: f64,
    },
    /// To a frame that ends at or after this time, s.
    Time(f64),
}

/// A run and its commands.
pub(super) struct Runner {
    commands: Receiver<Command>,
    clock: Instant,
    job: Job,
    simulation: Simulation,
    watch: Watch,
    snapshot: Arc<Snapshot>,
    ticks: Ticks,
    goal: Goal,
    stall: Option<Stall>,
    pace: Pace,
    slices: Slices,
    obeyed: u64,
    /// Whether the simulation has moved since `snapshot`.
    moved: bool,
    /// Whether anything has changed since the last report.
    unreported: bool,
    /// CPU time spent on advancing since t = 0, s.
    cpu: f64,
    /// When the next report of a running run is due, s on `clock`.
    report_due: f64,
}

impl Runner {
    pub(super) fn new(job: Job, speed: f64, commands: Receiver<Command>) -> Runner {
        let simulation = begin(&job);
        Runner {
            commands,
            clock: Instant::now(),
            snapshot: Arc::new(Snapshot::of(&job.stage, &simulation, None)),
            ticks: Ticks::new(job.stage.duration),
            job,
            watch: Watch::new(&simulation),
            simulation,
            goal: Goal::Nowhere,
            stall: None,
            pace: Pace::new(speed, 0.0, 0.0),
            slices: Slices::of(CALL),
            obeyed: 0,
            moved: false,
            unreported: false,
            cpu: 0.0,
            report_due: 0.0,
        }
    }

    /// Obeys, advances and reports until no sender of commands is left.
    pub(super) fn run(&mut self, slot: &Slot<Report>) {
        while self.listen() {
            if self.goal != Goal::Nowhere {
                self.slice();
            }
            let now = self.now();
            if self.unreported && (self.goal == Goal::Nowhere || now >= self.report_due) {
                slot.put(self.report());
                let cost = self.now() - now;
                self.report_due = now + TICK.max(cost * REPORT_SHARE);
            }
        }
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
            Goal::Nowhere => None,
            Goal::On => {
                let now = self.now();
                let due = self.pace.wait(now, self.simulation.time());
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
        match command {
            Command::Load(job) => {
                self.job = job;
                self.goal = Goal::Nowhere;
                self.restart(self.job.settings);
            }
            Command::Restart => self.restart(self.simulation.settings()),
            Command::Run(on) => self.head_for(if on { Goal::On } else { Goal::Nowhere }),
            Command::Step => match self.goal {
                Goal::Frames(n) => self.goal = Goal::Frames(n + 1),
                _ => self.head_for(Goal::Frames(1)),
            },
            Command::NextImpact => {
                // All may rest: what does not come within another duration of the scene is not waited for.
                let last = self.simulation.time() + self.job.stage.duration;
                self.head_for(Goal::Impact { past: self.simulation.tallies().impacts, last });
            }
            Command::Goto(t) => {
                if t < self.simulation.time() {
                    self.restart(self.simulation.settings());
                }
                self.head_for(if t > self.simulation.time() { Goal::Time(t) } else { Goal::Nowhere });
            }
            Command::Speed(wanted) => self.pace = Pace::new(wanted, self.now(), self.simulation.time()),
            Command::Settings(settings) => {
                self.simulation.set_settings(settings);
                self.stall = None;
                self.moved = true;
            }
            #[cfg(debug_assertions)]
            Command::Panic => panic!("asked to panic"),
        }
    }

    fn head_for(&mut self, goal: Goal) {
        self.goal = goal;
        self.pace = Pace::new(self.pace.wanted(), self.now(), self.simulation.time());
    }

    fn restart(&mut self, settings: Settings) {
        self.job.settings = settings;
        self.simulation = begin(&self.job);
        self.watch = Watch::new(&self.simulation);
        self.ticks = Ticks::new(self.job.stage.duration);
        self.stall = None;
        self.cpu = 0.0;
        self.moved = true;
        self.head_for(if self.goal == Goal::On { Goal::On } else { Goal::Nowhere });
    }

    /// Advances for about [`SLICE`], or to the goal, or up to what is due.
    fn slice(&mut self) {
        let (start, worked) = (self.now(), measure::thread_cpu());
        let until = match self.goal {
            Goal::On => Until::Time(self.pace.target(start, self.simulation.time())),
            Goal::Time(t) => Until::Time(t),
            _ => Until::Frame,
        };
        while self.goal != Goal::Nowhere && self.now() - start < SLICE {
            if matches!(until, Until::Time(t) if self.simulation.time() >= t) {
                break;
            }
            self.advance(until);
        }
        self.cpu += measure::thread_cpu() - worked;
        self.pace.measure(self.now(), self.simulation.time());
    }

    /// One call into the simulation, and what follows from it.
    fn advance(&mut self, until: Until) {
        let before = self.now();
        let progress = self.simulation.advance(until, self.slices.work());
        self.watch.look(&self.simulation, false);
        self.moved = true;
        self.unreported = true;
        for event in self.simulation.take_events() {
            if event.class == Class::Collide {
                self.ticks.add(event.time);
            }
        }
        match progress {
            Progress::Reached => self.arrive(),
            Progress::Yielded => self.slices.learn(self.now() - before),
            Progress::Stalled(stall) => {
                self.stall = Some(stall);
                self.goal = Goal::Nowhere;
            }
        }
    }

    /// A frame, or the time asked for, is complete: is that where the run was going?
    fn arrive(&mut self) {
        self.goal = match self.goal {
            Goal::Frames(n) if n > 1 => Goal::Frames(n - 1),
            Goal::Impact { past, last }
                if self.simulation.tallies().impacts <= past && self.simulation.time() < last =>
            {
                Goal::Impact { past, last }
            }
            Goal::On => Goal::On,
            Goal::Nowhere | Goal::Frames(_) | Goal::Impact { .. } | Goal::Time(_) => Goal::Nowhere,
        };
    }

    /// A report of the run at the end of its last frame.
    pub(super) fn report(&mut self) -> Report {
        if self.moved {
            self.watch.look(&self.simulation, true);
            let snapshot = Snapshot::of(&self.job.stage, &self.simulation, self.stall.as_ref());
            self.snapshot = Arc::new(Snapshot { alarm: *self.watch.alarm(), ..snapshot });
        }
        self.moved = false;
        self.unreported = false;
        Report {
            snapshot: Arc::clone(&self.snapshot),
            ticks: Arc::new(self.ticks.clone()),
            activity: match (self.goal, &self.stall) {
                (Goal::Nowhere, Some(_)) => Activity::Stalled,
                (Goal::Nowhere, None) => Activity::Paused,
                _ => Activity::Running,
            },
            wanted: self.pace.wanted(),
            reached: self.pace.reached(),
            obeyed: self.obeyed,
            cpu: self.cpu,
            panic: None,
        }
    }

    fn now(&self) -> f64 {
        self.clock.elapsed().as_secs_f64()
    }
}

/// The job's simulation at t = 0, keeping the events that the collision ticks count.
fn begin(job: &Job) -> Simulation {
    let mut simulation = Simulation::new(&job.scene, job.settings);
    simulation.record_events(true);
    simulation.explain(true);
    simulation
}
