//! The cheapest part of the judge, for every run: the deepest overlap of the states it is shown, and energy. A run shows it
//! a state after every slice of counted work, so long that the look does not matter; never the clock decides, so that the
//! same run alarms at the same time everywhere.

use std::fmt;

use crate::physics::{Method, Model, Settings, Simulation, State, Tallies};

use super::energy::Energy;
use super::finding::{Bodies, Fault, Finding};
use super::overlap::Overlaps;
use super::promise::Promise;

/// How many times its own cost lies between two looks: one and a half hundredths at most.
const SHARE: u64 = 64;

/// What a look costs whatever the scene, ns on some machine; only the ratio to the other costs matters.
const ONCE: u64 = 300;
/// What a look costs more for each sphere, ns.
const SPHERE: u64 = 120;
/// What a look costs more for each sphere and wall, ns.
const WALL: u64 = 4;

/// What a turn of an event-driven loop costs on that machine, ns.
const TURN: u64 = 150;
/// What computing a degree costs, ns.
const DEGREE: u64 = 1;

/// What is wrong with a run: the worst of each kind since the start.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Alarm {
    /// The deepest overlap beyond what the method promises, if there is one.
    pub overlap: Option<Finding>,
    /// The largest rise of energy beyond rounding, if there is one.
    pub energy: Option<Finding>,
    /// Why the method may have raised the energy, as the end of a sentence, if that is known.
    pub cause: Option<&'static str>,
}

impl Alarm {
    /// Whether nothing is wrong.
    pub fn is_silent(&self) -> bool {
        *self == Alarm::default()
    }

    /// A word for each kind, joined by commas: `overlap,energy`.
    pub fn words(&self) -> String {
        let words = [self.overlap.map(|_| "overlap"), self.energy.map(|_| "energy")];
        words.into_iter().flatten().collect::<Vec<_>>().join(",")
    }

    /// A sentence for each kind.
    pub fn sentences(&self) -> Vec<String> {
        let because = self.cause.map(|cause| format!(": {cause}")).unwrap_or_default();
        let energy = self.energy.map(|finding| format!("{finding}{because}"));
        self.overlap.map(|finding| finding.to_string()).into_iter().chain(energy).collect()
    }
}

impl fmt::Display for Alarm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.sentences().join("; "))
    }
}

/// The watch over one run.
#[derive(Debug, Clone)]
pub struct Watch {
    settings: Settings,
    overlaps: Overlaps,
    energy: Energy,
    impacts: u64,
    /// Time of the state looked at last, s.
    seen: f64,
    /// Counted work up to the state looked at last, ns.
    work: u64,
    alarm: Alarm,
}

impl Watch {
    /// A watch over a simulation; what overlaps now is allowed until it has parted.
    pub fn new(simulation: &Simulation) -> Watch {
        let (model, state) = (simulation.model(), simulation.state());
        let mut watch = Watch {
            settings: simulation.settings(),
            overlaps: Overlaps::new(model),
            energy: Energy::new(model, &state),
            impacts: simulation.tallies().impacts,
            seen: state.t,
            work: counted(&simulation.tallies(), model),
            alarm: Alarm::default(),
        };
        watch.overlaps.begin(model, &state.x);
        watch
    }

    /// Units of work (of [`Simulation::advance`]) after which a look is cheap.
    pub fn slice(&self, model: &Model) -> u64 {
        let unit = match self.settings.method {
            Method::Exact | Method::Swept => TURN,
            Method::Paper | Method::Moreau => DEGREE,
        };
        (SHARE * cost(model) / unit).max(1)
    }

    /// Looks at a simulation if it has worked enough since the last time; `anyway`: if only its time has changed.
    pub fn look(&mut self, simulation: &Simulation, anyway: bool) {
        let model = simulation.model();
        let work = counted(&simulation.tallies(), model);
        let due = anyway || work.saturating_sub(self.work) >= SHARE * cost(model);
        if !due || simulation.time() == self.seen && simulation.settings() == self.settings {
            return;
        }
        let state = simulation.state();
        (self.work, self.seen) = (work, state.t);
        if simulation.settings() != self.settings {
            // other promises: what the last ones have left is not the new ones' fault
            self.settings = simulation.settings();
            self.overlaps.begin(model, &state.x);
            self.energy = Energy::new(model, &state);
        }
        self.energy.bear(model, &state, simulation.contacts(), simulation.step());
        let impacts = simulation.tallies().impacts;
        let struck = impacts.saturating_sub(std::mem::replace(&mut self.impacts, impacts));
        self.see(model, (&state, simulation.hidden_energy()), struck);
    }

    /// Looks at a state and what is hidden of its energy (J), before which `impacts` have happened since the last one.
    pub fn state(&mut self, model: &Model, (state, hidden): (&State, f64), impacts: u64) {
        self.see(model, (state, hidden), impacts);
    }

    fn see(&mut self, model: &Model, (state, hidden): (&State, f64), impacts: u64) {
        let deepest = Promise::alarm(&self.settings);
        if let Some((degree, key)) = self.overlaps.worst(model, &state.x) {
            note(&mut self.alarm.overlap, Fault::Overlap, state.t, key.into(), [degree, deepest]);
        }
        let rise = self.energy.rise(model, (state, hidden), impacts);
        let silent = self.alarm.energy.is_none();
        note(&mut self.alarm.energy, Fault::Energy, state.t, Bodies::All, rise);
        if silent && self.alarm.energy.is_some() {
            self.alarm.cause = cause(self.settings.method);
        }
    }

    /// What was wrong so far.
    pub fn alarm(&self) -> &Alarm {
        &self.alarm
    }
}

/// What is known to raise the energy of a method's run.
fn cause(method: Method) -> Option<&'static str> {
    match method {
        Method::Paper => Some(
            "paper answers all contacts of a frame from the same velocities, so that a sphere struck by several at once is pushed too hard",
        ),
        Method::Exact | Method::Swept | Method::Moreau => None,
    }
}

/// Keeps the worst finding, with the time of the first.
fn note(kept: &mut Option<Finding>, fault: Fault, time: f64, bodies: Bodies, [value, bound]: [f64; 2]) {
    if value <= bound {
        return;
    }
    let first = kept.map_or(Finding { fault, time, bodies, value, bound, times: 0 }, |kept| kept);
    let worst = if value > first.value { Finding { bodies, value, bound, ..first } } else { first };
    *kept = Some(Finding { times: first.times + 1, ..worst });
}

/// What a look costs, ns.
fn cost(model: &Model) -> u64 {
    ONCE + model.len() as u64 * (SPHERE + WALL * model.faces.len() as u64)
}

/// Work counted since t = 0, in ns.
fn counted(tallies: &Tallies, model: &Model) -> u64 {
    let Tallies { frames, evaluations, relaxations, impacts, .. } = *tallies;
    evaluations * DEGREE + relaxations + impacts * TURN + frames * model.len() as u64
}
