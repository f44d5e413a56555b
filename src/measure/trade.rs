//! One setting measured on one scene: its errors against the reference, its cost, and what to doubt.

use std::ops::ControlFlow;

use super::cost::Timings;
use super::deviation::{Deviation, common_impacts, impact_time_error};
use super::interrupt::{GoOn, Interrupted};
use super::ladder::Rung;
use super::reference::Reference;
use super::sample::{Budget, EndReason, Instants, Sampled, sample};
use crate::export::{Note, TradeRow};
use crate::format;
use crate::physics::Simulation;
use crate::scene::{Method, Scene, Settings};

/// A horizon below this part of the run is short: most of the run cannot be judged by positions.
const SHORT: f64 = 0.5;

/// The error that the reference may have itself, m, unless told otherwise: the horizon is where it has more.
pub const ASKED: f64 = 1e-6;

/// A reference whose energy changes by less than this part of itself conserves it: then energies can be compared beyond
/// the horizon.
const CONSERVED: f64 = 1e-9;

/// The doubt of a setting that is nearer to the reference than that is to the truth.
pub(super) const BELOW: &str = "below the yardstick's own error";

/// The doubt of a setting that is farther from the reference than the smallest radius.
pub(super) const PARTED: &str = "parted from the reference";

/// The errors of a run against a reference.
#[derive(Debug, Clone, PartialEq)]
pub struct Errors {
    /// Time that the run reached, s.
    pub end: f64,
    /// Largest deviation of positions up to the horizon.
    pub position: Deviation,
    /// Up to when positions were compared, s.
    pub compared: f64,
    /// Largest time error of the first 10 impacts, s.
    pub impact_time: Option<f64>,
    /// Impacts in the reference's order, from the first on.
    pub common: usize,
    /// |E − E_ref| over the reference's largest |E|, at the last instant that both reached up to the horizon; up to
    /// the end where the reference conserves energy. None if the reference has no energy at all.
    pub energy: Option<f64>,
    /// The run as read.
    pub run: Sampled,
}

impl Errors {
    /// Whether the run is the reference itself once more.
    fn is_exact(&self) -> bool {
        self.position.distance == 0.0
    }
}

/// Runs a setting beside a reference, up to the reference's last instant; given up once the deviation exceeds `limit`
/// (m). `exact` gets no more than a reference would.
///
/// # Errors
/// If `go_on` returns false.
pub fn errors(
    scene: &Scene,
    settings: Settings,
    reference: &Reference,
    limit: f64,
    go_on: GoOn,
) -> Result<Errors, Interrupted> {
    let budget = if settings.method == Method::Exact { Budget::REFERENCE } else { Budget::UNLIMITED };
    errors_within(&mut Simulation::new(scene, settings), reference, (limit, budget), go_on)
}

/// The errors of a simulation at t = 0 against its reference, within a budget of work.
///
/// # Errors
/// If `go_on` returns false.
pub(super) fn errors_within(
    simulation: &mut Simulation,
    reference: &Reference,
    (limit, budget): (f64, Budget),
    go_on: GoOn,
) -> Result<Errors, Interrupted> {
    let model = simulation.model().clone();
    let (meaningful, judged) = (reference.meaningful(), judged(reference));
    let (mut position, mut compared, mut energy) = (Deviation::default(), 0.0, 0.0);
    let run = sample(simulation, reference.instants, budget, go_on, |k, state| {
        if let Some(wanted) = reference.positions(k).filter(|_| state.t <= meaningful) {
            compared = state.t;
            let now = Deviation::between(&state.x, wanted);
            position = if now.distance > position.distance { now } else { position };
        }
        if state.t <= judged {
            energy = (state.energy(&model) - reference.energy(state.t)).abs();
        }
        if position.distance > limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    let scale = reference.energy_scale();
    Ok(Errors {
        end: run.end,
        position,
        compared,
        impact_time: impact_time_error(&run.impacts, &reference.impacts),
        common: common_impacts(&run.impacts, &reference.impacts),
        energy: (scale > 0.0).then(|| energy / scale),
        run,
    })
}

/// Up to when energies are compared, s.
fn judged(reference: &Reference) -> f64 {
    let change = (reference.energy(reference.end) - reference.energy(0.0)).abs();
    if change <= CONSERVED * reference.energy_scale() { reference.end } else { reference.meaningful() }
}

/// A scene to measure on, and what to call it.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Built-in name or file stem.
    pub key: String,
    /// The scene.
    pub scene: Scene,
    /// Reference of the scene, up to the scene's duration.
    pub reference: Reference,
}

impl Subject {
    /// The reference run to the scene's duration.
    ///
    /// # Errors
    /// If `go_on` returns false.
    pub fn new(key: &str, scene: Scene, go_on: GoOn) -> Result<Subject, Interrupted> {
        Subject::asking(key, scene, ASKED, go_on)
    }

    /// The reference run to the scene's duration, with the horizon where its certified error leaves what is `asked`, m.
    ///
    /// # Errors
    /// If `go_on` returns false.
    pub fn asking(key: &str, scene: Scene, asked: f64, go_on: GoOn) -> Result<Subject, Interrupted> {
        let reference = Reference::certified(&scene, (asked, scene.duration), go_on)?;
        Ok(Subject { key: key.into(), scene, reference })
    }

    /// Measures one setting: errors in one run, cost in others.
    ///
    /// # Errors
    /// If `go_on` returns false.
    pub fn measure(&self, rung: Rung, go_on: GoOn) -> Result<TradeRow, Interrupted> {
        let mut setting = self.begin(rung, f64::INFINITY, go_on)?;
        while setting.timings.wants_more() {
            setting.timings.add(&self.scene, go_on)?;
        }
        Ok(setting.row())
    }

    /// Measures the errors of one setting, within `timeout` (s) of processor time, and times it once.
    ///
    /// # Errors
    /// If `go_on` returns false.
    pub(super) fn begin(&self, rung: Rung, timeout: f64, go_on: GoOn) -> Result<Setting, Interrupted> {
        let Instants { until, .. } = self.reference.instants;
        let settings = rung.settings(until);
        let usual = if settings.method == Method::Exact { Budget::REFERENCE } else { Budget::UNLIMITED };
        let budget = Budget { cpu: usual.cpu.min(timeout), ..usual };
        let mut simulation = Simulation::new(&self.scene, settings);
        let errors = errors_within(&mut simulation, &self.reference, (f64::INFINITY, budget), go_on)?;
        let timings = Timings::begin(&self.scene, settings, errors.end, go_on)?;
        let tallies = errors.run.tallies;
        let row = TradeRow {
            scene: self.key.clone(),
            method: rung.method.name().into(),
            dt: rung.dt,
            tolerance: rung.tolerance,
            until: errors.end,
            horizon: self.reference.horizon.time,
            certified: self.reference.own.map(|own| own.until),
            floor: self.reference.own.map(|own| own.error),
            position_error: Some(errors.position.distance),
            impact_time_error: errors.impact_time,
            common_events: errors.common as u64,
            energy_error: errors.energy,
            deepest_degree: tallies.deepest_degree,
            impacts: errors.run.impacts.len() as u64,
            evaluations: tallies.evaluations,
            events: tallies.impacts + tallies.rests + tallies.releases,
            frames: tallies.frames,
            cpu_per_s: None,
            cpu_median: None,
            cpu_spread: None,
            note: self.note(&errors),
        };
        Ok(Setting { row, timings })
    }

    /// Reasons to doubt the figures of a run that repeat, a phrase each.
    fn note(&self, errors: &Errors) -> Note {
        let Reference { instants, horizon, doubt, .. } = &self.reference;
        let smallest = self.scene.spheres.iter().map(|sphere| sphere.radius).fold(f64::INFINITY, f64::min);
        let stalled = errors.run.end_reason.as_ref().map(|end_reason| match end_reason {
            EndReason::Stalled(stall) => format!("{} s ({})", format::seconds(stall.time), stall.kind),
            EndReason::Spent | EndReason::Enough => {
                format!("{} s (passes its budget or time-out)", format::seconds(errors.end))
            }
        });
        let mut doubts = Vec::new();
        if !doubt.is_empty() {
            doubts.push(doubt.clone());
        }
        if horizon.time.is_some_and(|time| time < SHORT * instants.until) {
            doubts.push("horizon short".into());
        }
        if self.reference.own.is_some_and(|own| errors.position.distance < own.error) && !errors.is_exact() {
            doubts.push(BELOW.into());
        }
        if errors.position.distance > smallest {
            doubts.push(PARTED.into());
        }
        if errors.impact_time.is_none() && !self.reference.impacts.is_empty() {
            doubts.push("lacks one of the first impacts".into());
        }
        Note { stalled, doubts }
    }
}

/// A setting whose errors are measured and whose timings are under way.
#[derive(Debug, Clone)]
pub(super) struct Setting {
    row: TradeRow,
    pub(super) timings: Timings,
}

impl Setting {
    /// The row with what is known by now.
    pub(super) fn row(&self) -> TradeRow {
        let cost = self.timings.summary();
        let finite = |cost: f64| Some(cost).filter(|cost| cost.is_finite()); // none of a run that stalls at its start
        let mut row = self.row.clone();
        (row.cpu_per_s, row.cpu_median, row.cpu_spread) = (finite(cost.cpu_per_s), finite(cost.median), cost.spread);
        row.note.doubts.extend(cost.doubts.iter().map(|doubt| (*doubt).to_string()));
        row
    }
}
