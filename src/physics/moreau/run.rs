//! A run under way: what the method keeps between calls, and what the simulation asks of it.

use std::borrow::Cow;

use glam::DVec3;

use super::candidates::{Candidates, most_candidates};
use super::contact_row::Row;
use super::solver::Solver;
use crate::physics::contact::{Class, Contact, Key, Kind};
use crate::physics::frame_contact::FrameContact;
use crate::physics::impact_law;
use crate::physics::log::Log;
use crate::physics::method::{Engine, Progress, Until};
use crate::physics::model::{Model, Settings};
use crate::physics::overlap::Finder;
use crate::physics::state::{Stall, StallKind, State, runaway};

/// A contact that held in the last frame, and its impulse, N s.
pub(super) type Carried = (Key, f64);

/// A run by `moreau`.
#[derive(Debug, Clone)]
pub(crate) struct Moreau {
    pub(super) settings: Settings,
    /// Start of the last frame.
    pub(super) start: State,
    /// End of the last frame.
    pub(super) end: State,
    /// Free velocities u₀ of the frame in progress, m/s.
    pub(super) free: Vec<DVec3>,
    /// Velocities that the rows of the frame in progress give, m/s.
    pub(super) solution: Vec<DVec3>,
    /// What held in the last frame, sorted: all that the next one needs beside x and v.
    pub(super) carried: Vec<Carried>,
    pub(super) search: Candidates,
    /// Rows of the frame in progress, sorted by key.
    pub(super) rows: Vec<Row>,
    /// How deep the frame's rows leave each sphere in the walls that hold it, m.
    pub(super) sunk: Vec<f64>,
    pub(super) solver: Solver,
    pub(super) stage: FrameStage,
    /// Length of the last frame, s.
    pub(super) step: f64,
}

/// What the frame in progress does next; rounds count how often rows have been looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FrameStage {
    /// No frame is in progress.
    Between,
    /// Looks for bodies that may touch.
    Search {
        /// How often rows have been looked for.
        round: usize,
    },
    /// Makes rows of those that meet.
    Meet {
        /// How often rows have been looked for.
        round: usize,
        /// Index of the next candidate.
        from: usize,
        /// Number of rows before this round.
        known: usize,
    },
    /// Solves the rows.
    Solve {
        /// How often rows have been looked for.
        round: usize,
    },
}

impl Engine for Moreau {
    fn begin(model: &Model, settings: Settings, state: State, log: &mut Log) -> Moreau {
        let mut moreau = Moreau {
            settings,
            start: state.clone(),
            free: vec![DVec3::ZERO; model.len()],
            solution: vec![DVec3::ZERO; model.len()],
            end: state,
            carried: Vec::new(),
            search: Candidates::new(model),
            rows: Vec::new(),
            sunk: vec![0.0; model.len()],
            solver: Solver::new(model),
            stage: FrameStage::Between,
            step: 0.0,
        };
        moreau.load(model, log);
        moreau
    }

    fn advance(&mut self, model: &Model, log: &mut Log, until: Until, work: u64) -> Progress {
        if matches!(until, Until::Time(t) if self.end.t >= t && self.stage == FrameStage::Between) {
            return Progress::Reached;
        }
        let mut spent = 0;
        while spent < work {
            match self.go_on(model, log) {
                Ok(more) => spent += more.max(1),
                Err(stall) => return Progress::Stalled(stall),
            }
            let reached = match until {
                Until::Frame => true,
                Until::Time(t) => self.end.t >= t,
            };
            if self.stage == FrameStage::Between && reached {
                return Progress::Reached;
            }
        }
        Progress::Yielded
    }

    fn retune(&mut self, _: &Model, settings: Settings) {
        self.stage = FrameStage::Between;
        self.settings = settings;
    }

    fn state(&self, _: &Model) -> Cow<'_, State> {
        Cow::Borrowed(&self.end)
    }

    fn time(&self) -> f64 {
        self.end.t
    }

    fn step(&self) -> f64 {
        self.step
    }

    /// The state at `t` (s) within the last frame: velocities are those of its end, and positions lie on the straight line
    /// between its ends.
    fn at(&self, _: &Model, t: f64) -> State {
        if t >= self.end.t {
            return self.end.clone();
        }
        let mut state = self.start.clone();
        let elapsed = t - self.start.t;
        if elapsed > 0.0 {
            state.t = t;
            state.v.clone_from(&self.end.v);
            state.x.iter_mut().zip(&self.end.v).for_each(|(x, v)| *x += *v * elapsed);
        }
        state
    }

    /// A row for each contact that held, not for each sphere: (sphere, other sphere, Λ), or (sphere, −1 − wall, Λ), Λ in N
    /// s.
    fn transient(&self, _: &Model) -> Vec<DVec3> {
        let other = |kind: Kind, b: usize| if kind == Kind::Wall { -1.0 - b as f64 } else { b as f64 };
        self.carried.iter().map(|&((kind, a, b), impulse)| DVec3::new(a as f64, other(kind, b), impulse)).collect()
    }

    fn continue_with(&mut self, transient: &[DVec3]) {
        let carried = |row: &DVec3| {
            let (kind, b) = if row.y < 0.0 { (Kind::Wall, -1.0 - row.y) } else { (Kind::Pair, row.y) };
            ((kind, row.x as usize, b as usize), row.z)
        };
        self.carried = transient.iter().filter(|row| row.z > 0.0).map(carried).collect();
        self.carried.sort_unstable_by_key(|held| held.0);
    }

    fn hand_over(&self, _: &Model) -> State {
        self.end.clone()
    }

    /// A copy that keeps the frame's end and what held there; the start is a frame's inside, all else scratch.
    fn keep(&self) -> Moreau {
        Moreau {
            settings: self.settings,
            start: State::default(),
            end: self.end.clone(),
            free: Vec::new(),
            solution: Vec::new(),
            carried: self.carried.clone(),
            search: self.search.kept(),
            rows: Vec::new(),
            sunk: Vec::new(),
            solver: self.solver.kept(),
            stage: FrameStage::Between,
            step: self.step,
        }
    }

    fn wake(&mut self, model: &Model) {
        self.start = self.end.clone();
        self.free = vec![DVec3::ZERO; model.len()];
        self.solution = vec![DVec3::ZERO; model.len()];
        self.search.wake(model);
        self.sunk = vec![0.0; model.len()];
    }

    fn bytes(&self) -> usize {
        self.end.bytes() + size_of_val(&*self.carried)
    }
}

impl Moreau {
    /// What a state of [`Engine::at`] lacks of the energy of the frame's end, J: its velocities are those of the end, while
    /// its spheres have not yet fallen so far.
    pub(crate) fn hidden_energy_at(&self, model: &Model, state: &State) -> f64 {
        if state.t <= self.start.t || state.t >= self.end.t {
            return 0.0;
        }
        let left = self.end.t - state.t;
        let work = |(i, v): (usize, &DVec3)| model.masses[i] * model.acceleration(i).dot(*v) * left;
        -state.v.iter().enumerate().map(work).sum::<f64>()
    }

    /// Lets rest what touches at the start without approaching, if something presses it; what approaches is left to the
    /// first frame.
    pub(super) fn load(&mut self, model: &Model, log: &mut Log) {
        let mut finder = Finder::new(model);
        log.tallies.evaluations += finder.all(model, &self.end.x, true);
        log.contacts.clear();
        for overlap in &finder.found {
            let contact = self.contact_now(model, overlap.key);
            if contact.class == Class::Rest {
                log.contacts.push(contact);
            }
        }
        log.follow_rests(|key| self.release(model, key));
    }

    /// A contact as it stands at the end of the last frame, with the class that the law gives it, without a response yet.
    pub(super) fn contact_now(&self, model: &Model, key: Key) -> Contact {
        let FrameContact { contact, v_n, accelerations: [a, b] } =
            FrameContact::new(model, &self.end.x, &self.end, key);
        let pressed = (a - b).dot(contact.normal) < 0.0;
        Contact { class: impact_law::classify(v_n, pressed, &model.law), ..contact }
    }

    pub(super) fn release(&self, model: &Model, key: Key) -> Contact {
        Contact { class: Class::Release, ..self.contact_now(model, key) }
    }

    /// Why the frame in progress, in which the spheres move at `u` (m/s by sphere), must be given up, if it must: one of
    /// them leaves the range of numbers.
    pub(super) fn runaway(&self, u: &[DVec3]) -> Option<Stall> {
        let Settings { dt, .. } = self.settings;
        let cause =
            format!("a frame of {dt} s from then on sends it there; begin with smaller speeds or take a smaller dt");
        let ends = self.end.x.iter().zip(u).enumerate();
        ends.map(|(i, (&x, &u))| (i, [x + u * dt, u])).find_map(|(i, end)| runaway(i, self.end.t, end, &cause))
    }

    /// Why a frame in which too many bodies may meet is not begun.
    pub(super) fn crowded(&self, model: &Model) -> Stall {
        let (time, dt) = (self.end.t, self.settings.dt);
        let (radii, ways) = (0..model.len()).fold((0.0, 0.0), |(radii, ways), i| {
            (radii + model.radii[i], ways + (self.search.reach(i) - model.radii[i]))
        });
        let most = most_candidates(model.len());
        let reason = format!(
            "At t = {time} s a step of {dt} s leads the spheres past each other: more than {most} pairs of bodies may meet \
             in it, which would take too much memory; take a smaller dt, about {:.0e} s, in which a sphere moves as far as \
             its radius.",
            dt * radii / ways
        );
        Stall { time, kind: StallKind::StepTooLarge, reason }
    }
}
