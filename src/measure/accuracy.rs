//! The cheapest method and setting that meets a position error on a scene, found by trying a short ladder.

use super::clock::{Deadline, Watch};
use super::cost::cost;
use super::interrupt::{GoOn, Interrupted};
use super::ladder::{Ladder, Rung};
use super::reference::Reference;
use super::report::setting;
use super::sample::{Budget, EndReason};
use super::trade::errors;
use crate::format;
use crate::scene::{Method, Scene, Settings};

/// Seconds on the wall that trying settings may take.
const PATIENCE: f64 = 4.0;

/// Positions must mean something for at least this share of the run, or no setting can be told from another.
const TELLING: f64 = 0.01;

/// A setting that meets the error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tried {
    /// Which.
    pub rung: Rung,
    /// The position error found, m.
    pub error: f64,
    /// Thread CPU time per simulated second, s.
    pub cpu_per_s: f64,
}

/// The cheapest setting that meets an error, and what is known about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// What to run with.
    pub settings: Settings,
    /// The cheapest.
    pub chosen: Tried,
    /// The cheapest of another method, if one was found.
    pub next: Option<Tried>,
    /// Up to when positions were compared, s: the horizon, the end, or what the search had time for.
    pub compared: f64,
    /// Whether the search ended before its ladder.
    pub cut_short: bool,
}

/// Why there is no [`Choice`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Miss {
    /// The caller's [`GoOn`] returned false.
    Interrupted,
    /// No setting meets it: a sentence.
    Nothing(String),
}

impl From<Interrupted> for Miss {
    fn from(_: Interrupted) -> Miss {
        Miss::Interrupted
    }
}

/// Tries `methods` on a scene, each coarse to fine, up to the time `until` (s) or the horizon, and chooses the cheapest
/// setting whose largest position error is at most `wanted` (m). Takes some seconds. Knobs that the chosen method does
/// not use are those of `fallback`.
///
/// # Errors
/// If nothing that was tried meets it, or `go_on` returns false.
pub fn choose(
    scene: &Scene,
    (wanted, until): (f64, f64),
    methods: &[Method],
    fallback: Settings,
    go_on: GoOn,
) -> Result<Choice, Miss> {
    let reference = Reference::brief(scene, until, Budget::BRIEF, go_on)?;
    if reference.meaningful() <= 0.0 {
        let reason = if until > 0.0 { "exact does not get beyond t = 0" } else { "the run lasts 0 s" };
        return Err(Miss::Nothing(format!("no accuracy can be measured here: {reason}")));
    }
    if reference.meaningful() < TELLING * until {
        let (meaningful, until) = (format::digits(reference.meaningful(), 1), format::time(until));
        return Err(Miss::Nothing(format!(
            "no accuracy can be measured here: positions mean something only up to {meaningful} s of {until} s"
        )));
    }
    let deadline = Deadline::after(PATIENCE);
    let patient = || go_on() && !deadline.is_past();
    let rungs = Ladder { methods: methods.to_vec(), ..Ladder::default() }.rungs();
    let (mut met, mut cut_short) = (Vec::new(), false);
    for rung in rungs {
        match attempt(scene, &reference, rung, wanted, &patient) {
            Ok(tried) => met.extend(tried),
            Err(Interrupted) if go_on() => cut_short = true,
            Err(Interrupted) => return Err(Miss::Interrupted),
        }
    }
    met.sort_by(|a: &Tried, b: &Tried| a.cpu_per_s.total_cmp(&b.cpu_per_s));
    let chosen = *met.first().ok_or_else(|| Miss::Nothing(nothing(wanted, methods, &reference, cut_short)))?;
    let Rung { method, dt, tolerance } = chosen.rung;
    Ok(Choice {
        settings: Settings {
            method,
            dt: dt.unwrap_or(fallback.dt),
            tolerance: tolerance.unwrap_or(fallback.tolerance),
        },
        chosen,
        next: met.iter().find(|tried| tried.rung.method != method).copied(),
        compared: reference.meaningful(),
        cut_short,
    })
}

/// One setting, given up as soon as it misses the error.
fn attempt(
    scene: &Scene,
    reference: &Reference,
    rung: Rung,
    wanted: f64,
    patient: GoOn,
) -> Result<Option<Tried>, Interrupted> {
    let until = reference.end;
    let settings = rung.settings(until);
    let watch = Watch::start();
    let errors = errors(scene, settings, reference, wanted, patient)?;
    let misses = errors.position.distance > wanted || matches!(errors.run.end_reason, Some(EndReason::Stalled(_)));
    if misses {
        return Ok(None);
    }
    // Where there is no time for a timing of its own, the run that was read tells the cost within a few percent.
    let roughly = watch.read().cpu / until.max(f64::MIN_POSITIVE);
    let cpu_per_s = cost(scene, settings, until, patient).map_or(roughly, |cost| cost.cpu_per_s);
    Ok(Some(Tried { rung, error: errors.position.distance, cpu_per_s }))
}

fn nothing(wanted: f64, methods: &[Method], reference: &Reference, cut_short: bool) -> String {
    let names: Vec<&str> = methods.iter().map(|method| method.name()).collect();
    let time = if cut_short { " in the time there was" } else { "" };
    format!(
        "no setting of {} was found{time} that meets a position error of {wanted:e} m up to {} s; carom measure shows \
         what there is",
        names.join(", "),
        format::time(reference.meaningful()),
    )
}

impl Choice {
    /// What was chosen, what it costs, what error was found and up to when: one line.
    pub fn sentence(&self) -> String {
        let in_words = |tried: &Tried| setting(tried.rung.method.name(), tried.rung.dt, tried.rung.tolerance);
        let Tried { error, cpu_per_s, .. } = self.chosen;
        let next = self.next.map_or(String::new(), |next| {
            format!(
                "; next is {}, {} per s, error {} m",
                in_words(&next),
                format::duration(next.cpu_per_s),
                format::digits(next.error, 1)
            )
        });
        let hasty = if self.cut_short { "; not all settings were tried" } else { "" };
        format!(
            "chose {}: {} per simulated s, position error {} m up to {} s{next}{hasty}",
            in_words(&self.chosen),
            format::duration(cpu_per_s),
            format::digits(error, 1),
            format::time(self.compared),
        )
    }
}
