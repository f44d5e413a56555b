//! A crowd judged beyond the horizon, where places mean nothing any longer: means over many runs that begin a hair's
//! breadth aside, which any right method must share.

use super::displaced::aside;
use super::interrupt::{GoOn, Interrupted};
use super::ladder::Rung;
use super::observables::{Figures, INSTANTS, Observables, Told, WINDOW};
use super::sample::{Budget, EndReason, Pace};
use crate::export::FIGURES;
use crate::physics::{Class, Effect, Kind, Progress, Simulation, Until, knobs};
use crate::scene::Scene;

/// How far each sphere is displaced, as a part of the smallest radius: no figure sees it, and every collision enlarges it.
const ASIDE: f64 = 1e-9;

/// Part of themselves by which means may differ and count as equal: what rounding leaves of a sum.
const SAME: f64 = 1e-9;

/// Standard errors by which means may differ.
pub(super) const ERRORS: f64 = 3.0;

/// A mean over runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// Mean of the runs that have the figure.
    pub mean: f64,
    /// Standard error of the mean; 0 of one run.
    pub error: f64,
    /// Number of runs that have the figure.
    pub runs: usize,
}

/// One run of a setting.
#[derive(Debug, Clone, PartialEq)]
pub struct Ran {
    /// Time that the run reached, s.
    pub reached: f64,
    /// Why the run stopped before its end; none if it did not.
    pub stopped: Option<Stopped>,
    /// Figures of the run up to there.
    pub figures: Figures,
}

/// Why a run of a crowd did not come to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stopped {
    /// The method could not go on.
    Stalled,
    /// The budget of the run was spent.
    Spent,
}

/// One setting's means.
#[derive(Debug, Clone, PartialEq)]
pub struct Crowd {
    /// The setting.
    pub rung: Rung,
    /// Runs that came to the end, of those begun.
    pub finished: (usize, usize),
    /// Runs that stalled; the others that did not come to the end had spent what they may take.
    pub stalled: usize,
    /// How far the run came that came least far, and the one that came farthest, s.
    pub reached: (f64, f64),
    /// Means in the order of [`FIGURES`]; none where no run has the figure.
    pub means: Vec<Option<Mean>>,
}

impl Mean {
    fn of(values: &[f64]) -> Option<Mean> {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        let error = if values.len() > 1 { (squares / (n - 1.0) / n).sqrt() } else { 0.0 };
        (!values.is_empty()).then_some(Mean { mean, error, runs: values.len() })
    }

    /// By how many standard errors of their difference two means differ; 0 if by no more than rounding.
    pub fn apart(&self, other: &Mean) -> f64 {
        let apart = (self.mean - other.mean).abs();
        let errors = (self.error * self.error + other.error * other.error).sqrt();
        if apart <= SAME * (self.mean.abs() + other.mean.abs()) { 0.0 } else { apart / errors }
    }

    /// Whether two means differ by no more than three standard errors, or rounding.
    pub fn agrees(&self, other: &Mean) -> bool {
        self.apart(other) <= ERRORS
    }
}

impl Crowd {
    /// The means of a setting's runs. A run that did not come to its end gives the figures up to where it came.
    pub fn of(rung: Rung, runs: &[Ran]) -> Crowd {
        let mean = |k: usize| Mean::of(&runs.iter().filter_map(|run| run.figures[k]).collect::<Vec<_>>());
        let done = runs.iter().filter(|run| run.stopped.is_none()).count();
        let stalled = runs.iter().filter(|run| run.stopped == Some(Stopped::Stalled)).count();
        let reached = runs.iter().map(|run| run.reached);
        let reached = (reached.clone().fold(f64::INFINITY, f64::min), reached.fold(0.0, f64::max));
        let means = (0..FIGURES.len()).map(mean).collect();
        Crowd { rung, finished: (done, runs.len()), stalled, reached, means }
    }
}

/// One run of a setting, displaced by a seed, as far as it comes within `budget`.
///
/// # Errors
/// If `go_on` returns false.
pub fn crowd_run(scene: &Scene, rung: Rung, (seed, budget): (u64, Budget), go_on: GoOn) -> Result<Ran, Interrupted> {
    let smallest = scene.spheres.iter().map(|sphere| sphere.radius).fold(f64::INFINITY, f64::min);
    let scene = aside(scene, seed, ASIDE * smallest);
    let until = scene.duration;
    let mut settings = rung.settings(until);
    if knobs(rung.method).dt != Effect::Error {
        // frames only say where to pause: they must be short enough for the window
        settings.dt = settings.dt.min(until / INSTANTS as f64);
    }
    let mut run = Simulation::new(&scene, settings);
    let mut seen = Observables::new(&scene, until);
    let mut pace = Pace::new(budget);
    let (mut carried, mut since) = (0.0, 0.0);
    for k in 0..=INSTANTS {
        let time = k as f64 * until / INSTANTS as f64;
        let mut end = if time <= until * (1.0 - WINDOW) {
            let end = pace.reach(&mut run, time, go_on)?;
            since = run.time(); // the end of a frame, which may be later than was asked for
            end
        } else {
            carry(&mut run, time, (&mut pace, go_on), &mut carried)?
        };
        if end.is_none() && pace.is_spent(&run) {
            end = Some(EndReason::Spent); // where slices end must not decide it
        }
        if let Some(end) = end {
            let stopped = Some(if end == EndReason::Spent { Stopped::Spent } else { Stopped::Stalled });
            let reached = k.saturating_sub(1) as f64 * until / INSTANTS as f64;
            return Ok(Ran { reached, stopped, figures: seen.figures() });
        }
        let state = run.at(time);
        seen.enter(time, &state.x, &state.v);
    }
    let weight = seen.weight().length();
    let forces = (weight > 0.0).then(|| carried / (run.time() - since) / weight);
    let told = Told { forces, ..residuals(&run) };
    Ok(Ran { reached: until, stopped: None, figures: seen.figures_with(told) })
}

/// Runs to `time` (s) frame by frame, and adds what the walls gave against gravity to `carried`, N s. Why it ended before,
/// if it did.
fn carry(
    run: &mut Simulation,
    time: f64,
    (pace, go_on): (&mut Pace, GoOn),
    carried: &mut f64,
) -> Result<Option<EndReason>, Interrupted> {
    let model = run.model();
    let weight: glam::DVec3 = (0..model.len()).map(|i| model.acceleration(i) * model.masses[i]).sum();
    let up = -weight.normalize_or_zero();
    while run.time() < time {
        if !go_on() {
            return Err(Interrupted);
        }
        if pace.is_spent(run) {
            return Ok(Some(EndReason::Spent));
        }
        match run.advance(Until::Frame, Simulation::SLICE) {
            Progress::Yielded => {}
            Progress::Stalled(stall) => return Ok(Some(EndReason::Stalled(stall))),
            Progress::Reached => {
                let walls = run.contacts().iter().filter(|row| row.kind == Kind::Wall && row.class != Class::Leave);
                *carried += walls.map(|row| row.impulse * row.normal.dot(up)).sum::<f64>();
            }
        }
    }
    Ok(None)
}

/// What the resting contacts of the last frame leave of Signorini's conditions: gap ≥ 0, force ≥ 0, gap × force = 0. (The
/// gap is asked for all bodies, whether they rest or not.)
fn residuals(run: &Simulation) -> Told {
    let radii = &run.model().radii;
    let mut found = Told::default();
    for row in run.contacts().iter().filter(|row| row.class == Class::Rest && run.step() > 0.0) {
        let reach = radii[row.a] + if row.kind == Kind::Pair { radii[row.b] } else { 0.0 };
        let force = row.impulse / run.step();
        found.pull = Some(found.pull.unwrap_or(0.0).max(-force));
        found.product = Some(found.product.unwrap_or(0.0).max((row.degree * reach * force).abs()));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_have_their_standard_error_and_agree_within_three_of_it() {
        let mean = Mean::of(&[1.0, 2.0, 3.0, 4.0]).expect("values");
        // Variance 5/3, over four runs.
        assert_eq!((mean.mean, mean.runs), (2.5, 4));
        assert!((mean.error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
        let at = |value: f64| Mean { mean: value, error: 0.0, runs: 1 };
        assert!(mean.agrees(&at(2.5 + 2.9 * mean.error)) && !mean.agrees(&at(2.5 + 3.1 * mean.error)));
        assert!(at(1.0).agrees(&at(1.0 + 1e-12)) && !at(1.0).agrees(&at(1.0 + 1e-6)));
        assert_eq!(Mean::of(&[]), None);
    }
}
