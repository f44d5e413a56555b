//! A run at the end of one frame.

use std::sync::Arc;

use glam::DVec3;

use super::stage::Stage;
use crate::audit::Alarm;
use crate::physics::{Approach, Class, Contact, Kind, Probe, RestReason, Simulation, Stall, State, Tallies, slack};

/// Most centres that the trial steps of a snapshot hold: half a megabyte.
const TRIALS: usize = 20_000;

/// Contacts of a frame, from the first on, of which a snapshot tells how they came about.
const APPROACHES: usize = 1000;

/// A run at the end of one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// What does not change during the run.
    pub stage: Arc<Stage>,
    /// Time, s.
    pub t: f64,
    /// Real length of the frame that ended here, s.
    pub step: f64,
    /// Centres, m.
    pub x: Vec<DVec3>,
    /// Velocities, m/s.
    pub v: Vec<DVec3>,
    /// Σ ½ m v² − m g·x − F·x, J.
    pub energy: f64,
    /// Σ ½ m v² − m g·x − F·x at t = 0, J.
    pub initial_energy: f64,
    /// Every contact of the frame that ended here.
    pub contacts: Vec<Contact>,
    /// Impacts at the end of the frame before, whose impulses have acted over this one, where a method answers them so.
    pub acting: Vec<Contact>,
    /// Why each of the contacts rests, by index; none if it does not, or where the method has no reason beyond the law.
    pub rest_reasons: Vec<Option<RestReason>>,
    /// How the bodies of each of the first contacts came together, by index, where the method follows single events.
    pub approaches: Vec<Option<Approach>>,
    /// What the frame's search for the collision time did, trial step by trial step; empty if there was none.
    pub probes: Vec<Probe>,
    /// Centres in each of these trial steps, m; empty if there are too many of them, or if the next frame is in progress.
    pub trials: Vec<Vec<DVec3>>,
    /// What the model leaves out because the scene does not require it, a phrase each.
    pub left_out: Vec<&'static str>,
    /// Counted work and outcomes since t = 0.
    pub tallies: Tallies,
    /// Name of the method.
    pub method: &'static str,
    /// Longest frame, s.
    pub dt: f64,
    /// Intersection tolerance, dimensionless.
    pub tolerance: f64,
    /// What `paper` accepts of overlap beyond the tolerance, dimensionless; none for methods that accept nothing beyond it.
    pub slack: Option<f64>,
    /// Why the run cannot go on, if it cannot: a full sentence.
    pub stall: Option<String>,
    /// What the watch over the run has found wrong since its start.
    pub alarm: Alarm,
}

impl Snapshot {
    /// The run as it stands at the end of the last complete frame; `stall` if it cannot go on.
    pub fn of(stage: &Arc<Stage>, sim: &Simulation, stall: Option<&Stall>) -> Snapshot {
        let State { t, x, v } = sim.state();
        let settings = sim.settings();
        Snapshot {
            stage: Arc::clone(stage),
            t,
            step: sim.step(),
            x,
            v,
            energy: sim.energy(),
            initial_energy: sim.initial_energy(),
            contacts: sim.contacts().to_vec(),
            acting: Vec::new(),
            rest_reasons: sim.contacts().iter().map(|contact| reason(sim, contact)).collect(),
            approaches: approaches(sim),
            probes: sim.probes().to_vec(),
            trials: trials(sim),
            left_out: sim.model().requirements().left_out(),
            tallies: sim.tallies(),
            method: settings.method.name(),
            dt: settings.dt,
            tolerance: settings.tolerance,
            slack: slack(settings.method),
            stall: stall.map(|stall| stall.reason.clone()),
            alarm: Alarm::default(),
        }
    }

    /// The snapshot with its spheres where the frame's search tried them in this trial step, if that is known.
    pub fn at_trial(&self, probe: usize) -> Option<Snapshot> {
        let (trial, Probe { step, .. }) = (self.trials.get(probe)?, self.probes.get(probe)?);
        Some(Snapshot { t: self.t - self.step + step, x: trial.clone(), ..self.clone() })
    }

    /// The hash of t, x and v ([`State::hash`]): equal hashes mean equal bits.
    pub fn hash(&self) -> u64 {
        State { t: self.t, x: self.x.clone(), v: self.v.clone() }.hash()
    }
}

fn reason(sim: &Simulation, contact: &Contact) -> Option<RestReason> {
    if contact.class == Class::Rest { sim.rest_reason(contact.key()) } else { None }
}

/// Whether a snapshot of the run reads the inside of its last frame, where its search tried the spheres.
pub(crate) fn shows_trials(sim: &Simulation) -> bool {
    let probes = sim.probes().len();
    probes > 0 && probes * sim.model().len() <= TRIALS
}

fn trials(sim: &Simulation) -> Vec<Vec<DVec3>> {
    let probes = sim.probes();
    if !shows_trials(sim) {
        return Vec::new();
    }
    probes.iter().map(|probe| Some(sim.trial(probe.step)?.x)).collect::<Option<_>>().unwrap_or_default()
}

/// How each of the first contacts came about, by index.
fn approaches(sim: &Simulation) -> Vec<Option<Approach>> {
    if sim.contacts().is_empty() {
        return Vec::new();
    }
    let order =
        |one: &Approach, (key, time): ((Kind, usize, usize), f64)| one.key.cmp(&key).then(one.time.total_cmp(&time));
    let mut sorted: Vec<&Approach> = sim.approaches().iter().collect();
    sorted.sort_by(|one, other| order(one, (other.key, other.time))); // stable: of the same the first stays first
    let led_to = |contact: &Contact| {
        let here = (contact.key(), contact.time);
        let first = sorted.partition_point(|one| order(one, here).is_lt());
        sorted.get(first).filter(|one| order(one, here).is_eq()).map(|one| **one)
    };
    sim.contacts().iter().take(APPROACHES).map(led_to).collect()
}
