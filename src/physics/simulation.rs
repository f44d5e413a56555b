//! A scene under way: one method that is advanced in slices, and read between frames.

use std::borrow::Cow;
use std::sync::Arc;

use glam::DVec3;

use super::approach::Approach;
use super::contact::{Contact, Key, Probe};
use super::events::engine::MOST_IDLE;
use super::events::rest_reason::RestReason;
use super::log::Log;
use super::method::{Description, Engine, Progress, Until};
use super::model::{Method, Model, Scene, Settings};
use super::state::{Stall, State, Tallies};
use crate::physics::{exact, moreau, paper, swept};

/// What a method is.
pub fn describe(method: Method) -> &'static Description {
    match method {
        Method::Paper => &paper::DESCRIPTION,
        Method::Swept => &swept::DESCRIPTION,
        Method::Exact => &exact::DESCRIPTION,
        Method::Moreau => &moreau::DESCRIPTION,
    }
}

/// Where a method is not its source to the letter, and what of the letter to know of: a sentence each.
pub fn deviations(method: Method) -> &'static [&'static str] {
    match method {
        Method::Paper => paper::DEVIATIONS,
        Method::Swept | Method::Exact | Method::Moreau => &[],
    }
}

/// The overlap that a method accepts beyond the tolerance, dimensionless; none if it accepts nothing beyond it and answers
/// a contact when it happens, not in the frame after.
pub fn slack(method: Method) -> Option<f64> {
    match method {
        Method::Paper => Some(paper::SLACK),
        Method::Swept | Method::Exact | Method::Moreau => None,
    }
}

/// The methods, dispatched once per call.
#[derive(Debug, Clone)]
enum Engines {
    /// `paper`, the source paper's method.
    Paper(paper::Paper),
    /// `swept`: event by event, contact times by conservative advancement.
    Swept(swept::Swept),
    /// `exact`: event by event, contact times by roots.
    Exact(exact::Exact),
    /// `moreau`: velocity-level time-stepping.
    Moreau(moreau::Moreau),
}

/// Calls the same trait method of whichever engine runs.
macro_rules! each {
    ($engines:expr, $engine:ident => $call:expr) => {
        match $engines {
            Engines::Paper($engine) => $call,
            Engines::Swept($engine) => $call,
            Engines::Exact($engine) => $call,
            Engines::Moreau($engine) => $call,
        }
    };
}

impl Engines {
    fn begin(model: &Model, settings: Settings, state: State, log: &mut Log) -> Engines {
        match settings.method {
            Method::Paper => Engines::Paper(Engine::begin(model, settings, state, log)),
            Method::Swept => Engines::Swept(Engine::begin(model, settings, state, log)),
            Method::Exact => Engines::Exact(Engine::begin(model, settings, state, log)),
            Method::Moreau => Engines::Moreau(Engine::begin(model, settings, state, log)),
        }
    }
}

/// A scene under way: one method advancing one state.
#[derive(Debug, Clone)]
pub struct Simulation {
    /// Shared by all copies of the run.
    model: Arc<Model>,
    settings: Settings,
    engine: Engines,
    log: Log,
    initial_energy: f64,
    stall: Option<Stall>,
}

impl Simulation {
    /// Units of work that take some milliseconds in most scenes: so soon a caller of [`Simulation::advance`] can look at
    /// what else there is to do. No bit of a result depends on it.
    pub const SLICE: u64 = 20_000;

    /// A simulation of `scene` at t = 0, the contacts found there already handled; of a scene that goes on from another
    /// run, at the time of that: by its settings bit for bit, by others as if they were changed there.
    pub fn new(scene: &Scene, settings: Settings) -> Simulation {
        if let Some(resume) = &scene.resume {
            let mut run = Simulation::resumed(scene, scene.solver, resume.t, &resume.transient);
            if settings != scene.solver {
                run.set_settings(settings);
            }
            return run;
        }
        let model = Model::new(scene);
        let mut log = Log::default();
        let engine = Engines::begin(&model, settings, model.initial.clone(), &mut log);
        let (initial_energy, stall) = (model.initial.energy(&model), model.initial.runaway(&model));
        Simulation { model: Arc::new(model), settings, engine, log, initial_energy, stall }
    }

    /// A simulation that goes on bit for bit where another one of the same scene, method and settings was at time `t` (s):
    /// `scene` holds the positions and velocities of that moment, `transient` what [`Simulation::transient`] said then.
    /// Tallies count from here. `exact` and `swept` do the run up to here again when it is first told to advance, within
    /// the work it is given.
    pub fn resumed(scene: &Scene, settings: Settings, t: f64, transient: &[DVec3]) -> Simulation {
        let mut model = Model::new(scene);
        model.initial.t = t;
        let mut log = Log::default();
        let mut engine = Engines::begin(&model, settings, model.initial.clone(), &mut log);
        if is_of(transient, settings.method, &model) {
            each!(&mut engine, engine => engine.continue_with(transient));
        }
        let (initial_energy, stall) = (model.initial.energy(&model), model.initial.runaway(&model));
        let log = Log { contacts: log.contacts, resting: log.resting, ..Log::default() };
        Simulation { model: Arc::new(model), settings, engine, log, initial_energy, stall }
    }

    /// Goes on for about `work` units (degree evaluations or events), or to the goal, whichever is first.
    pub fn advance(&mut self, until: Until, work: u64) -> Progress {
        if let Some(stall) = &self.stall {
            return Progress::Stalled(stall.clone());
        }
        let Simulation { model, engine, log, .. } = self;
        let progress = each!(engine, engine => engine.advance(model, log, until, work));
        if let Progress::Stalled(stall) = &progress {
            self.stall = Some(stall.clone());
        }
        progress
    }

    /// Goes on until a frame ends at or after `time` (s), call by call of [`Simulation::advance`]. Before each call `next`
    /// sees the run and says how many units of work come next; by `None` it stops the run, and the answer is
    /// [`Progress::Yielded`].
    pub fn run_to(&mut self, time: f64, mut next: impl FnMut(&mut Simulation) -> Option<u64>) -> Progress {
        loop {
            let Some(work) = next(self) else { return Progress::Yielded };
            match self.advance(Until::Time(time), work) {
                Progress::Yielded => {}
                end => return end,
            }
        }
    }

    /// Time at the end of the last frame, s.
    pub fn time(&self) -> f64 {
        each!(&self.engine, engine => engine.time())
    }

    /// Real length of the last frame, s; 0 before the first.
    pub fn step(&self) -> f64 {
        each!(&self.engine, engine => engine.step())
    }

    /// A copy of the state at the end of the last frame.
    pub fn state(&self) -> State {
        self.now().into_owned()
    }

    /// A copy of the state at `t` (s) within the last frame, reached from the frame's start by a shortened step; a `t`
    /// outside the frame counts as its nearer end. Reading never changes the run.
    pub fn at(&self, t: f64) -> State {
        each!(&self.engine, engine => engine.at(&self.model, t))
    }

    /// With t, x and v all that a run continues from.
    ///
    /// - `paper`: impulses decided at the end of the last frame that act in the next, N s by sphere; then what its watchdog
    ///   has counted, on which depends when it gives up frames that shrink without end: since when, s, how many were cut
    ///   short, and how long they should have taken at least, s.
    /// - `exact` and `swept`: how the run began, (t, 0, 0), then x (m) and v (m/s) by sphere, since the rounding of its
    ///   later states follows from nothing less; empty if `swept` has changed its tolerance, and then the continuation is
    ///   equal to rounding only.
    /// - `moreau`: a row for each contact that held in the last frame: sphere, other sphere (or −1 − wall), impulse in N s.
    pub fn transient(&self) -> Vec<DVec3> {
        each!(&self.engine, engine => engine.transient(&self.model))
    }

    /// Every contact of the last frame, in the order in which they were handled.
    pub fn contacts(&self) -> &[Contact] {
        &self.log.contacts
    }

    /// The trial steps of the last frame's search for the collision time.
    pub fn probes(&self) -> &[Probe] {
        &self.log.probes
    }

    /// The state in which the last frame's search tried a step of this length (s): a probe's degree is that of these
    /// positions. None while another frame is in progress.
    pub fn trial(&self, step: f64) -> Option<State> {
        each!(&self.engine, engine => engine.trial(&self.model, step))
    }

    /// Keep (or stop keeping) how the bodies of a frame's contacts came together, for [`Simulation::approaches`]. Off at
    /// first: it costs a polynomial per contact, and never a bit of the result.
    pub fn explain(&mut self, on: bool) {
        self.log.explaining = on;
    }

    /// How the bodies of the last frame's contacts came together, of methods that follow single events, if it was asked
    /// for.
    pub fn approaches(&self) -> &[Approach] {
        &self.log.approaches
    }

    /// Keep (or stop keeping) every collide, rest and release for [`Simulation::take_events`]. Off at first: it costs
    /// memory, and never a bit of the result. Asked for before the first frame, it includes what happened at load.
    pub fn record_events(&mut self, on: bool) {
        if !self.log.recording && self.log.tallies.frames > 0 {
            self.log.events.clear();
        }
        self.log.recording = on;
    }

    /// The events kept since the last call, in order of time.
    pub fn take_events(&mut self) -> Vec<Contact> {
        std::mem::take(&mut self.log.events)
    }

    /// Why a contact rests now; none if it does not, and of methods that do not follow single events.
    pub fn rest_reason(&self, key: Key) -> Option<RestReason> {
        match &self.engine {
            Engines::Swept(engine) => engine.rest_reason(key),
            Engines::Exact(engine) => engine.rest_reason(key),
            Engines::Paper(_) | Engines::Moreau(_) => None,
        }
    }

    /// Counted work and outcomes since t = 0.
    pub fn tallies(&self) -> Tallies {
        self.log.tallies
    }

    /// Σ ½ m v² − m g·x − F·x at the end of the last frame, J.
    pub fn energy(&self) -> f64 {
        self.now().energy(&self.model)
    }

    /// Energy (J) at the end of the last frame that the state does not show: an event-driven method lets a sphere that bounces
    /// lower than 1e-12 r off a wall that rubs, or by `swept` lower than it overlaps the wall, go on with the mean velocity
    /// of all its bounces until they are over. Energy and this together never rise.
    pub fn hidden_energy(&self) -> f64 {
        match &self.engine {
            Engines::Swept(engine) => engine.hidden_energy(),
            Engines::Exact(engine) => engine.hidden_energy(),
            Engines::Paper(_) | Engines::Moreau(_) => 0.0,
        }
    }

    /// Energy (J) that a state of [`Simulation::at`] does not show: within a frame of `moreau`, what its spheres still gain
    /// by falling until the frame ends, with the velocities that they have there; by `exact` and `swept` that of bounces
    /// that are summed up, as in [`Simulation::hidden_energy`]; by `paper` 0.
    pub fn hidden_energy_at(&self, state: &State) -> f64 {
        match &self.engine {
            Engines::Moreau(engine) => engine.hidden_energy_at(&self.model, state),
            Engines::Swept(engine) => engine.hidden_energy_at(&self.model, state.t),
            Engines::Exact(engine) => engine.hidden_energy_at(&self.model, state.t),
            Engines::Paper(_) => 0.0,
        }
    }

    /// Σ ½ m v² − m g·x − F·x at t = 0, J.
    pub fn initial_energy(&self) -> f64 {
        self.initial_energy
    }

    /// The settings in force.
    pub fn settings(&self) -> Settings {
        self.settings
    }

    /// Solves with other settings from the next frame on. A run that stalled tries again.
    pub fn set_settings(&mut self, settings: Settings) {
        let Simulation { model, engine, log, .. } = self;
        if settings.method == self.settings.method {
            each!(engine, engine => engine.retune(model, settings));
        } else {
            if log.tallies.frames == 0 {
                *log = Log { recording: log.recording, explaining: log.explaining, ..Log::default() };
            }
            let state = each!(&*engine, engine => engine.hand_over(model));
            *engine = Engines::begin(model, settings, state, log);
        }
        self.settings = settings;
        self.stall = self.now().runaway(&self.model);
    }

    /// A small copy of the run between two frames, from which it can be continued bit for bit. Call it after
    /// [`Simulation::advance`] has answered [`Progress::Reached`]; a frame in progress is not in the copy.
    pub fn keyframe(&self) -> Keyframe {
        let Simulation { model, log, settings, initial_energy, .. } = self;
        let engine = match &self.engine {
            Engines::Paper(engine) => Engines::Paper(engine.keep()),
            Engines::Swept(engine) => Engines::Swept(engine.keep()),
            Engines::Exact(engine) => Engines::Exact(engine.keep()),
            Engines::Moreau(engine) => Engines::Moreau(engine.keep()),
        };
        let log = Log { events: Vec::new(), ..log.clone() };
        let bytes = size_of::<Simulation>() + each!(&engine, engine => engine.bytes()) + log.bytes();
        let (model, stall) = (Arc::clone(model), self.now().runaway(model));
        let kept = Simulation { model, settings: *settings, engine, log, initial_energy: *initial_energy, stall };
        Keyframe { kept, bytes }
    }

    /// Whether frames are shown one by one on the way to `time`, s. They are not where dt is so short that they would
    /// be too many to count: then where frames end depends on the goal, though no bit of the motion does.
    pub fn counts_frames_to(&self, time: f64) -> bool {
        match self.settings.method {
            Method::Exact | Method::Swept => time - self.time() <= MOST_IDLE * self.settings.dt,
            Method::Paper | Method::Moreau => true,
        }
    }

    /// All that is constant.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The state at the end of the last frame, without a copy where the method holds one.
    fn now(&self) -> Cow<'_, State> {
        each!(&self.engine, engine => engine.state(&self.model))
    }
}

/// Whether this can be what a run of the model by this method said: what a file says may be anything.
fn is_of(transient: &[DVec3], method: Method, model: &Model) -> bool {
    let spheres = model.len() as f64;
    let index = |value: f64, count: f64| value.fract() == 0.0 && (0.0..count).contains(&value);
    match method {
        Method::Paper => transient.len() == model.len() || transient.len() == model.len() + 1,
        Method::Exact | Method::Swept => true, // they look themselves
        Method::Moreau => transient.iter().all(|row| {
            let wall = index(-1.0 - row.y, model.faces.len() as f64);
            index(row.x, spheres) && (wall || index(row.y, spheres)) && row.z.is_finite()
        }),
    }
}

/// A moment of a run between two frames, from which it goes on bit for bit: smaller than the run itself.
#[derive(Debug, Clone)]
pub struct Keyframe {
    kept: Simulation,
    bytes: usize,
}

impl Keyframe {
    /// The run as it was, ready to go on; it knows nothing of the inside of its last frame, only its end.
    pub fn run(&self) -> Simulation {
        let mut run = self.kept.clone();
        each!(&mut run.engine, engine => engine.wake(&run.model));
        run
    }

    /// Memory that it takes, bytes, as near as its parts tell.
    pub fn bytes(&self) -> usize {
        self.bytes
    }
}
