//! The event loop: a thin one, between the schedule, which knows what comes next, and the mechanics, which know what
//! becomes of it.
//!
//! Take the earliest event of all (ties: walls, pairs, ends of parabolas, crossings of cells; then a, then b), advance the
//! clock to it, let the mechanics act, predict anew the spheres that they say have changed. When no contact is left at an
//! instant, islands of resting contacts are solved. Frames only say where to pause, and reading never rewrites anything:
//! neither changes a bit of the run.

use super::changed::Changed;
use super::detector::Detector;
use super::mechanics::Mechanics;
use super::record::Plan;
use super::rest_reason::RestReason;
use super::schedule::entry::{EventKind, event_kind};
use super::schedule::parts::Schedule;
use super::trajectories::Trajectories;
use crate::physics::contact::{Key, Kind};
use crate::physics::log::Log;
use crate::physics::method::{Progress, Until};
use crate::physics::model::{Model, Settings};
use crate::physics::state::{Stall, State};

/// Spheres up to this many look at all others: cells would not pay for their crossings.
const FEW: usize = 16;

/// Looks at a pair that a search may take without cells.
const FEW_LOOKS: usize = 64;

/// Cost of a look at a wall, in looks at a pair: those are taken four at a time.
const WALL: usize = 8;

/// Frames of dt in which nothing happens that are shown one by one: it takes minutes to pass them. A dt that asks for
/// more, or one that the clock cannot tell from 0, leaves the frame open until something happens or the goal is reached.
pub(in crate::physics) const MOST_IDLE: f64 = (1_u64 << 30) as f64;

/// Approaches that a frame keeps, from its first on.
const MOST_APPROACHES: usize = 1000;

/// Events at the very start after which the rest is left to the first frame.
const MOST_AT_LOAD: usize = 1_000_000;

/// A run, event by event.
#[derive(Debug, Clone)]
pub(crate) struct EventDriven<D> {
    settings: Settings,
    frame: Frame,
    /// The next event of every sphere, and the earliest of all.
    pub(super) schedule: Schedule<D>,
    /// What events act on.
    pub(super) mechanics: Mechanics,
}

/// What one single-step shows: up to the next event, or dt.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Frame {
    /// End of the last complete frame, s.
    time: f64,
    /// Length of the last complete frame, s.
    step: f64,
    /// Whether the next frame is under way.
    open: bool,
    /// Whether the log tells what rests at the end of the last complete frame.
    listed: bool,
    /// Where a frame with nothing in it ends at the earliest, s, where frames of dt would be too many to count.
    goal: f64,
    /// Where the frame under way ends if nothing happens before, s.
    end: f64,
    /// Energy at the end of the last complete frame of bounces that are summed up, J.
    hidden_energy: f64,
    /// Impacts counted up to there of hops that no row has told yet.
    untold: u64,
}

impl Frame {
    /// The clock of frames between two of them, at `time`, s.
    fn at(time: f64) -> Frame {
        let (goal, end) = (f64::NEG_INFINITY, f64::MAX);
        Frame { time, step: 0.0, open: false, listed: true, goal, end, hidden_energy: 0.0, untold: 0 }
    }

    /// Sets the end of the frame: `dt` (s) after its beginning, and so far at least that the clock moves on.
    fn set_end(&mut self, dt: f64) {
        let end = self.time + dt;
        let end = if end > self.time { end } else { self.time.next_up() };
        self.end = end.max(self.goal).min(f64::MAX);
    }
}

/// What became of one turn of the loop.
enum Turn {
    /// An event was handled.
    Event,
    /// The frame in progress is complete.
    Frame,
}

impl<D: Detector> EventDriven<D> {
    /// A run from `state` on, whose contacts are handled already.
    pub(crate) fn begin(model: &Model, settings: Settings, state: &State, log: &mut Log) -> EventDriven<D> {
        let mut engine = EventDriven {
            settings,
            frame: Frame::at(state.t),
            schedule: Schedule::new(D::new(settings), model.len(), state.t),
            mechanics: Mechanics::new(model, state),
        };
        let EventDriven { schedule, mechanics: Mechanics { trajectories, rests, .. }, .. } = &mut engine;
        trajectories.healed = schedule.detector.healed();
        if model.len() > FEW && model.len() + WALL * model.faces.len() > FEW_LOOKS {
            schedule.lay_out(model, trajectories, rests);
        }
        engine.load(model, log);
        let Mechanics { trajectories, rests, .. } = &engine.mechanics;
        engine.frame.hidden_energy = rests.hidden_energy(model, trajectories, state.t);
        engine.mechanics.trajectories.forget_past();
        engine
    }

    /// Goes on for about `work` events, or to the goal.
    pub(crate) fn advance(&mut self, model: &Model, log: &mut Log, until: Until, work: u64) -> Progress {
        self.frame.goal = match until {
            Until::Time(t) if t.is_finite() && t - self.frame.time > MOST_IDLE * self.settings.dt => t,
            _ => f64::NEG_INFINITY,
        };
        self.frame.set_end(self.settings.dt);
        let progress = self.go_on(model, log, until, work);
        // a frame that is passed is read by nothing: every event ends one
        if !self.frame.open && !self.frame.listed {
            let Mechanics { trajectories, rests, .. } = &self.mechanics;
            rests.list(model, trajectories, log, self.frame.time);
            self.frame.listed = true;
        }
        progress
    }

    fn go_on(&mut self, model: &Model, log: &mut Log, until: Until, work: u64) -> Progress {
        for _ in 0..work {
            if !self.frame.open {
                if matches!(until, Until::Time(t) if t <= self.frame.time) {
                    return Progress::Reached;
                }
                self.open_frame(log);
            }
            match self.turn(model, log) {
                Ok(Turn::Event) => {}
                Ok(Turn::Frame) if until == Until::Frame => return Progress::Reached,
                Ok(Turn::Frame) => {}
                Err(stall) => return Progress::Stalled(stall),
            }
        }
        match until {
            Until::Time(t) if !self.frame.open && t <= self.frame.time => Progress::Reached,
            _ => Progress::Yielded,
        }
    }

    /// Goes on for about `work` events without keeping what they tell; whether everything up to `until` (s) has happened,
    /// or nothing more can.
    pub(super) fn repeat(&mut self, model: &Model, log: &mut Log, until: f64, work: u64) -> bool {
        for _ in 0..work {
            if self.schedule.queue.earliest().0 > until && !self.mechanics.rests.is_dirty() {
                return true;
            }
            if !self.frame.open {
                self.open_frame(log);
            }
            // a stall shows itself again in the next frame
            if self.turn(model, log).is_err() {
                return true;
            }
            log.events.clear();
        }
        false
    }

    /// Counts frames from `time` (s) on, with these settings, as if the run had ended a frame there.
    pub(super) fn begin_frames_at(&mut self, time: f64, settings: Settings) {
        self.settings = settings;
        self.frame = Frame::at(time);
        self.mechanics.forget_past();
        self.mechanics.rests.forget_curved_time(time);
        self.mechanics.rests.begin_frame(time);
        self.schedule.evaluations = 0;
    }

    /// Takes other settings from the next frame on; whether they change the run.
    pub(crate) fn retune(&mut self, model: &Model, settings: Settings) -> bool {
        self.settings = settings;
        let changes = self.schedule.detector.retune(settings);
        if changes {
            let Mechanics { trajectories, rests, .. } = &mut self.mechanics;
            trajectories.healed = self.schedule.detector.healed();
            self.schedule.predict_all(model, trajectories, rests);
        }
        changes
    }

    /// The settings in force.
    pub(super) fn settings(&self) -> Settings {
        self.settings
    }

    /// Time at the end of the last frame, s.
    pub(crate) fn time(&self) -> f64 {
        self.frame.time
    }

    /// Length of the last frame, s.
    pub(crate) fn step(&self) -> f64 {
        self.frame.step
    }

    /// The state at `t` (s) within the last frame.
    pub(crate) fn at(&self, model: &Model, t: f64) -> State {
        self.mechanics.state_at(model, t.clamp(self.frame.time - self.frame.step, self.frame.time))
    }

    /// A copy that goes on bit for bit and knows nothing of the inside of the last frame.
    pub(super) fn keep(&self) -> EventDriven<D> {
        let EventDriven { settings, frame, schedule, mechanics } = self;
        EventDriven {
            settings: *settings,
            frame: *frame,
            schedule: schedule.clone(),
            mechanics: mechanics.since(frame.time),
        }
    }

    /// Memory that it takes beside its own size, bytes.
    pub(super) fn bytes(&self) -> usize {
        self.schedule.bytes() + self.mechanics.bytes()
    }

    /// Energy (J) at the end of the last frame of bounces that are summed up, which the state does not show.
    pub(crate) fn hidden_energy(&self) -> f64 {
        self.frame.hidden_energy
    }

    /// Energy (J) of bounces that are summed up, which the state at `t` (s) within the last frame does not show.
    pub(crate) fn hidden_energy_at(&self, model: &Model, t: f64) -> f64 {
        let Mechanics { trajectories, rests, .. } = &self.mechanics;
        rests.hidden_energy(model, trajectories, t)
    }

    /// Why a contact rests; none if it does not.
    pub(crate) fn rest_reason(&self, key: Key) -> Option<RestReason> {
        self.mechanics.rests.reason(key)
    }

    /// Handles what touches at the start, in the order of events, and predicts everything.
    fn load(&mut self, model: &Model, log: &mut Log) {
        self.mechanics.meet_at_load(model, log, self.schedule.cells.as_deref());
        let Mechanics { trajectories, rests, .. } = &mut self.mechanics;
        self.schedule.predict_all(model, trajectories, rests);
        for _ in 0..MOST_AT_LOAD {
            let next = self.schedule.queue.earliest().0;
            let idle = next > self.mechanics.trajectories.now && !self.mechanics.rests.is_dirty();
            if idle || self.turn(model, log).is_err() {
                break;
            }
        }
        log.contacts.clear();
    }

    fn open_frame(&mut self, log: &mut Log) {
        self.frame.open = true;
        self.frame.set_end(self.settings.dt);
        self.mechanics.rests.begin_frame(self.frame.time);
        self.mechanics.forget_past();
        log.contacts.clear();
        log.probes.clear();
        log.approaches.clear();
    }

    #[inline(always)]
    fn close_frame(&mut self, model: &Model, log: &mut Log, end: f64) -> Turn {
        let looked_at = std::mem::take(&mut self.schedule.evaluations);
        self.schedule.detector.report(self.frame.time, end, looked_at, log);
        let Mechanics { trajectories, rests, .. } = &self.mechanics;
        // known only here: in the next frame the same contacts may have gone on
        let hidden_energy = rests.hidden_energy(model, trajectories, end);
        let (step, untold) = (end - self.frame.time, trajectories.hopping.impacts(end));
        log.tallies.impacts = (log.tallies.impacts + untold).saturating_sub(self.frame.untold);
        self.frame = Frame { time: end, step, open: false, listed: false, hidden_energy, untold, ..self.frame };
        log.tallies.frames += 1;
        log.tallies.inexact_time = self.mechanics.rests.curved_time(end);
        Turn::Frame
    }

    /// Handles one event, or ends the frame.
    fn turn(&mut self, model: &Model, log: &mut Log) -> Result<Turn, Stall> {
        let EventDriven { schedule, mechanics, .. } = self;
        let Mechanics { trajectories, rests, impacts } = mechanics;
        let (time, slot) = schedule.take_next(trajectories, rests);
        let (kind, now) = (event_kind(trajectories, rests, time, slot), trajectories.now);
        // in a long chain what rests would wait for ever while others strike it
        let has_waited = impacts.instant.is_long();
        if rests.is_dirty() && (time > now || kind != EventKind::Contact || has_waited) {
            let changed = mechanics.settle(model, log)?;
            self.predict(model, &changed);
            return Ok(Turn::Event);
        }
        let shows = !log.contacts.is_empty() && time > now && now > self.frame.time;
        if shows || time > self.frame.end {
            schedule.put_back((time, slot));
            return Ok(self.close_frame(model, log, if shows { now } else { self.frame.end }));
        }
        impacts.instant.advance_clock(trajectories, time)?;
        schedule.prefetch(trajectories);
        match kind {
            EventKind::Contact => self.contact(model, log, slot)?,
            EventKind::IslandEnd => {
                let changed = mechanics.end_parabola(model, log, mechanics.trajectories.sphere(slot));
                self.predict(model, &changed);
            }
            EventKind::Crossing => schedule.cross(model, trajectories, rests, slot),
        }
        let EventDriven { schedule, mechanics: Mechanics { trajectories, rests, .. }, .. } = self;
        if schedule.is_worn() {
            schedule.review(model, trajectories, rests);
        }
        Ok(Turn::Event)
    }

    /// Handles the contact that the sphere at a slot planned, which is due.
    #[inline(always)]
    fn contact(&mut self, model: &Model, log: &mut Log, slot: usize) -> Result<(), Stall> {
        let EventDriven { schedule, mechanics, .. } = self;
        let Mechanics { trajectories, rests, .. } = mechanics;
        let plan = trajectories.records[slot].plan;
        let stale =
            plan.kind == Kind::Pair && trajectories.records[plan.other as usize].motion_version != plan.motion_version;
        let rested = !rests.is_empty() && rests.holds(trajectories.key(slot, &plan));
        if plan.is_contact && !stale && !rested {
            if log.explaining {
                keep_approach(trajectories, model, log, trajectories.key(slot, &plan));
            }
            if mechanics.collide_plain_pair(model, log, slot, &plan)? {
                let Mechanics { trajectories, rests, .. } = mechanics;
                schedule.predict(model, trajectories, rests, plan.other as usize);
            } else if !mechanics.collide_plain_wall(model, log, slot, &plan)? && self.meet(model, log, slot, &plan)? {
                return Ok(());
            }
        }
        // whatever became of the contact, this plan is used up
        let EventDriven { schedule, mechanics: Mechanics { trajectories, rests, .. }, .. } = self;
        schedule.predict_due(model, trajectories, rests, slot);
        Ok(())
    }

    /// Lets the contact happen that the sphere at a slot planned; whether that has changed the sphere, so that it is
    /// predicted with the others.
    fn meet(&mut self, model: &Model, log: &mut Log, slot: usize, plan: &Plan) -> Result<bool, Stall> {
        let key = self.mechanics.trajectories.key(slot, plan);
        let changed = self.mechanics.meet(model, log, key)?;
        self.predict(model, &changed);
        Ok(changed.spheres().contains(&self.mechanics.trajectories.sphere(slot)))
    }

    /// Predicts the spheres that an event has changed.
    fn predict(&mut self, model: &Model, changed: &Changed) {
        let Mechanics { trajectories, rests, .. } = &mut self.mechanics;
        let spheres = changed.spheres();
        for (place, &i) in spheres.iter().enumerate() {
            self.schedule.predict_after(model, trajectories, rests, (trajectories.slot(i), &spheres[..place]));
        }
    }
}

/// Keeps how the bodies of a contact came together. Out of the way of runs that do not ask: the loop is short.
#[cold]
#[inline(never)]
fn keep_approach(trajectories: &Trajectories, model: &Model, log: &mut Log, key: Key) {
    // what meets a sphere that hops meets its hull first
    let hops = Changed::of(key).spheres().iter().any(|&i| trajectories.hopping.holds(i));
    if !hops && log.approaches.len() < MOST_APPROACHES {
        log.approaches.push(trajectories.approach(model, key));
    }
}
