//! One scene by the event-driven method, every frame and event held against the independent judge.

use std::collections::BTreeSet;

use carom::audit::Judge;
use carom::measure::thread_cpu;
use carom::physics::wall::{Part, touch};
use carom::physics::{Class, Contact, Kind, Method, Progress, Scene, Settings, Simulation, Until};
use glam::dvec3;

use crate::halves::Halves;

/// Frames are half seconds, or shorter where something happens.
pub(crate) const EXACT: Settings = Settings { method: Method::Exact, dt: 0.5, tolerance: 1e-3 };

/// As [`EXACT`], within a tolerance of a thousandth of a radius.
pub(crate) const SWEPT: Settings = Settings { method: Method::Swept, ..EXACT };

/// A generator of scenes and what is asked of them.
#[derive(Clone, Copy)]
pub(crate) struct Generator {
    pub(crate) scene: fn(u64) -> Scene,
    /// How they are run.
    pub(crate) settings: Settings,
    /// Half seconds of each run.
    pub(crate) halves: u32,
    /// Turns of the method's loop after which a scene counts as hanging.
    pub(crate) budget: u64,
    /// Whether its spheres must stay in the box from (−5, 0, −5) to (5, 10, 5).
    pub(crate) boxed: bool,
}

/// Why a scene failed: a word that is the same for failures of a kind, and a sentence.
#[derive(Debug, Clone)]
pub(crate) struct Failure {
    pub(crate) kind: String,
    pub(crate) text: String,
}

/// How often each thing was met.
#[derive(Default, Debug, Clone)]
pub(crate) struct Met {
    pub(crate) impacts: u64,
    pub(crate) faces: u64,
    pub(crate) edges: u64,
    pub(crate) corners: u64,
    pub(crate) pairs: u64,
    pub(crate) rests: u64,
    pub(crate) creases: u64,
    pub(crate) pair_rests: u64,
    pub(crate) edge_rests: u64,
    pub(crate) releases: u64,
    pub(crate) collapses: u64,
    pub(crate) curved: u64,
    pub(crate) curved_time: f64,
    /// Slices of [`SLICE`] turns of the method's loop.
    pub(crate) slices: u64,
    /// Scenes whose run took more than 1 s, and more than 10 s, of the processor, the judge not counted.
    pub(crate) slow: u64,
    pub(crate) very_slow: u64,
    /// Processor time, s.
    pub(crate) cpu: f64,
    /// Scenes in other units that differed, as twins by rounding do.
    pub(crate) undecided: u64,
    /// Sum of the hashes of the last states, modulo 2⁶⁴: the same on every machine.
    pub(crate) hash: u64,
    resting: BTreeSet<(Kind, usize, usize)>,
}

/// Turns of the method's loop between two looks at the budget.
const SLICE: u64 = 1000;

/// Of so many frames one is timed, for all of them: to ask the clock of the processor costs as much as a short one.
const TIMED: u64 = 16;

/// Runs one scene of a generator for so many half seconds; also says what it met.
pub(crate) fn check(generator: &Generator, seed: u64, halves: u32, met: &mut Met) -> Result<(), Failure> {
    let scene = (generator.scene)(seed);
    let mut run = Simulation::new(&scene, generator.settings);
    run.record_events(true);
    let mut judge = Judge::of(&run);
    let verdict = go_on(generator, &mut run, &mut judge, halves, met);
    (met.slow, met.very_slow) = (u64::from(met.cpu > 1.0), u64::from(met.cpu > 10.0));
    met.collapses = run.tallies().collapses;
    met.curved = u64::from(run.tallies().inexact_time > 0.0);
    met.curved_time = run.tallies().inexact_time;
    met.hash = run.state().hash();
    met.resting.clear();
    if verdict.is_err() || met.slow > 0 {
        keep(&scene, seed);
    }
    verdict
        .map_err(|failure| Failure { text: format!("seed {seed} at t = {}: {}", run.time(), failure.text), ..failure })
}

/// Writes a scene that is worth looking at where the environment asks for it, to be opened by the program.
pub(crate) fn keep(scene: &Scene, seed: u64) {
    if let Some(folder) = std::env::var_os("CAROM_CAMPAIGN_SCENES") {
        let file = std::path::Path::new(&folder).join(format!("seed-{seed}.ron"));
        std::fs::write(&file, carom::scene::written(scene)).expect("the folder for scenes takes them");
    }
}

pub(crate) fn fail(kind: &str, text: String) -> Result<(), Failure> {
    Err(Failure { kind: kind.into(), text })
}

fn go_on(
    generator: &Generator,
    run: &mut Simulation,
    judge: &mut Judge,
    halves: u32,
    met: &mut Met,
) -> Result<(), Failure> {
    // a frame that is judged has cost at least this many turns, if it was no slice of its own
    let mut frames: u64 = 0;
    let mut looks = Halves::of(run);
    while run.time() < 0.5 * f64::from(halves) {
        let before = frames.is_multiple_of(TIMED).then(thread_cpu);
        let progress = run.advance(Until::Frame, SLICE);
        met.cpu += before.map_or(0.0, |before| TIMED as f64 * (thread_cpu() - before));
        frames += 1;
        match progress {
            Progress::Yielded => met.slices += 1,
            Progress::Stalled(stall) => return fail(&format!("stall {}", stall.kind), stall.reason),
            Progress::Reached => {
                let events = run.take_events();
                judge.frame(run, &events);
                met.count(run, &events);
                if let Some(finding) = judge.findings().rows().first() {
                    return fail(&format!("{:?}", finding.fault), finding.to_string());
                }
                if generator.boxed {
                    looks.look(run)?;
                }
            }
        }
        if met.slices * SLICE + frames > generator.budget {
            return fail("hangs", format!("{:?}", run.tallies()));
        }
        if generator.boxed {
            let state = run.state();
            let outside = |x: &glam::DVec3| {
                let far = (*x - dvec3(0.0, 5.0, 0.0)).abs().max_element();
                far.is_nan() || far > 5.0
            };
            if let Some(i) = state.x.iter().position(outside) {
                return fail("escapes", format!("sphere {i} is at {}", state.x[i]));
            }
        }
    }
    Ok(())
}

impl Met {
    /// Counts what a frame met.
    fn count(&mut self, run: &Simulation, events: &[Contact]) {
        for event in events {
            let part = (event.kind == Kind::Wall).then(|| {
                let x = event.point + event.normal * run.model().radii[event.a];
                touch(&run.model().faces[event.b], x, run.model().radii[event.a]).part
            });
            match event.class {
                Class::Collide => {
                    self.impacts += 1;
                    match part {
                        Some(Part::Face) => self.faces += 1,
                        Some(Part::Edge(_)) => self.edges += 1,
                        Some(Part::Corner(_)) => self.corners += 1,
                        None => self.pairs += 1,
                    }
                }
                Class::Rest => self.count_rest(event, part),
                Class::Release => {
                    self.releases += 1;
                    self.resting.remove(&event.key());
                }
                Class::Leave => {}
            }
        }
    }

    fn count_rest(&mut self, event: &Contact, part: Option<Part>) {
        self.rests += 1;
        self.resting.insert(event.key());
        let walls = self.resting.iter().filter(|key| key.0 == Kind::Wall && key.1 == event.a).count();
        match part {
            None => self.pair_rests += 1,
            Some(Part::Face) if walls >= 2 => self.creases += 1,
            Some(Part::Face) => {}
            Some(_) => self.edge_rests += 1,
        }
    }

    /// Adds what another run met.
    pub(crate) fn add(&mut self, other: &Met) {
        self.impacts += other.impacts;
        self.faces += other.faces;
        self.edges += other.edges;
        self.corners += other.corners;
        self.pairs += other.pairs;
        self.rests += other.rests;
        self.creases += other.creases;
        self.pair_rests += other.pair_rests;
        self.edge_rests += other.edge_rests;
        self.releases += other.releases;
        self.collapses += other.collapses;
        self.curved += other.curved;
        self.curved_time += other.curved_time;
        self.slices += other.slices;
        self.slow += other.slow;
        self.very_slow += other.very_slow;
        self.cpu += other.cpu;
        self.undecided += other.undecided;
        self.hash = self.hash.wrapping_add(other.hash);
    }
}
