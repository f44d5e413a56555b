//! The method and setting of least counted work that meets a position error on a scene: equal on every machine, however
//! busy.

use super::interrupt::{GoOn, Interrupted};
use super::ladder::{Ladder, Rung};
use super::reference::Reference;
use super::report::setting;
use super::sample::{Budget, EndReason};
use super::trade::errors_within;
use super::work::{counted, least, priced};
use crate::certify::{Certificate, certify_within};
use crate::format;
use crate::physics::Simulation;
use crate::scene::{Method, Scene, Settings};

/// Counted work that trying settings may take, ns: some seconds.
const PATIENCE: u64 = 4_000_000_000;

/// Counted work of each setting in the first round, ns; in each next one so many times more.
const FIRST: u64 = 1_000_000;
const MORE: u64 = 4;

/// Pairs of bodies that the certificate of `exact` may look at here: about a second.
const LOOKS: u64 = 30_000_000;

/// The error that is left to `exact` itself, as a part of the error asked for; settings must meet the rest.
const FLOOR: f64 = 0.1;

/// Positions must mean something for at least this share of the run, or no setting can be told from another.
const TELLING: f64 = 0.01;

/// A setting that meets the error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tried {
    /// The setting.
    pub rung: Rung,
    /// The position error found, m.
    pub error: f64,
    /// Counted work of the whole run, ns on some machine.
    pub work: u64,
}

/// The setting of least counted work that meets an error, and what is known about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Settings to run with.
    pub settings: Settings,
    /// The cheapest setting that meets the error.
    pub chosen: Tried,
    /// The cheapest setting of another method, if one was found.
    pub next: Option<Tried>,
    /// Up to when positions were compared, s: the horizon, the end, or how far `exact` came.
    pub compared: f64,
    /// Up to when `exact` itself is certified to a tenth of the error asked for, s; at most `compared`.
    pub certified: f64,
    /// Largest error of `exact` itself up to `compared`, m.
    pub floor: f64,
    /// How far the chosen run was tried, s, if no setting came to its end within the work of a search.
    pub tried_until: Option<f64>,
    /// Number of settings, and of those that were not tried to an end.
    pub settings_tried: (usize, usize),
}

/// Why there is no [`Choice`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Miss {
    /// The caller's [`GoOn`] returned false.
    Interrupted,
    /// No setting meets the error: a sentence.
    Nothing(String),
}

impl From<Interrupted> for Miss {
    fn from(_: Interrupted) -> Miss {
        Miss::Interrupted
    }
}

/// Tries `methods` on a scene up to the time `until` (s), or as far as positions mean something, and chooses the setting of
/// least counted work whose largest position error is at most `wanted` (m), of which a tenth is left to `exact` itself.
/// Knobs that the chosen method does not use are those of `fallback`.
///
/// Rounds of ever more work: in each, every setting still in question runs from the start until it misses the error, ends,
/// or has done the work of the round. The first round in which one ends is the last, and has the cheapest. No clock
/// decides.
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
    let (reference, certificate) = yardstick(scene, wanted, until, go_on)?;
    refuse_untold(&reference, until)?;
    let mut search = Search {
        scene,
        reference: &reference,
        wanted: wanted * (1.0 - FLOOR),
        open: Ladder { methods: methods.to_vec(), ..Ladder::default() }.rungs(),
        met: Vec::new(),
        held: Vec::new(),
        spent: 0,
    };
    let all = search.open.len();
    search.run(go_on)?;
    let cut_short = if search.met.is_empty() { search.open.len() } else { 0 };
    search.met.sort_by_key(|tried| tried.work);
    let farthest = search.held.iter().copied().reduce(|one, other| if other.1 > one.1 { other } else { one });
    let ended = search.met.first().map(|tried| (*tried, None));
    let held = farthest.map(|(tried, until)| (tried, Some(until)));
    let nothing = || Miss::Nothing(nothing(wanted, methods, &reference, cut_short > 0));
    let (chosen, tried_until) = ended.or(held).or(reference_run(&reference, methods)).ok_or_else(nothing)?;
    let Rung { method, dt, tolerance } = chosen.rung;
    Ok(Choice {
        settings: Settings {
            method,
            dt: dt.unwrap_or(fallback.dt),
            tolerance: tolerance.unwrap_or(fallback.tolerance),
        },
        chosen,
        next: search.met.iter().find(|tried| tried.rung.method != method).copied(),
        compared: reference.meaningful(),
        certified: certificate.within(FLOOR * wanted).min(reference.meaningful()),
        tried_until,
        floor: certificate.error.min(FLOOR * wanted),
        settings_tried: (all, cut_short),
    })
}

/// `exact` itself, which has come as far as positions mean something, if it may be chosen: the last resort. And how far it
/// came, s.
fn reference_run(reference: &Reference, methods: &[Method]) -> Option<(Tried, Option<f64>)> {
    let rung = Rung { method: Method::Exact, dt: None, tolerance: None };
    let tried = Tried { rung, error: 0.0, work: priced(Method::Exact, &reference.tallies) };
    methods.contains(&Method::Exact).then_some((tried, Some(reference.end)))
}

/// `exact` up to where positions mean something: where it is certified to a part of the error asked for, or where displaced
/// runs have not parted, whichever is later; and the certificate.
fn yardstick(scene: &Scene, wanted: f64, until: f64, go_on: GoOn) -> Result<(Reference, Certificate), Interrupted> {
    let certificate = certify_within(scene, until, LOOKS, &|| go_on()).ok_or(Interrupted)?;
    let reference = Reference::brief(scene, until, Budget::BRIEF, go_on)?.with(&certificate, FLOOR * wanted);
    Ok((reference, certificate))
}

fn refuse_untold(reference: &Reference, until: f64) -> Result<(), Miss> {
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
    Ok(())
}

/// Settings on trial.
struct Search<'a> {
    scene: &'a Scene,
    reference: &'a Reference,
    /// Largest error, m.
    wanted: f64,
    /// Settings that have neither missed the error nor ended.
    open: Vec<Rung>,
    /// Settings that have met the error.
    met: Vec<Tried>,
    /// Settings that have met the error as far as positions mean something, but not ended, in this round; and how far they
    /// came, s.
    held: Vec<(Tried, f64)>,
    /// Counted work of all settings so far, ns.
    spent: u64,
}

/// What became of a setting in a round.
enum Outcome {
    Met(Tried),
    Missed,
    Unfinished,
    /// The setting has met the error as far as that can be said, up to this time, s.
    Held(Tried, f64),
}

impl Search<'_> {
    fn run(&mut self, go_on: GoOn) -> Result<(), Interrupted> {
        let mut work = FIRST;
        while self.met.is_empty() && !self.open.is_empty() && self.spent < PATIENCE {
            let before = std::mem::take(&mut self.held);
            for rung in std::mem::take(&mut self.open) {
                match self.attempt(rung, work, go_on)? {
                    Outcome::Met(tried) => self.met.push(tried),
                    Outcome::Missed => {}
                    Outcome::Unfinished => self.open.push(rung),
                    Outcome::Held(tried, until) => {
                        self.open.push(rung);
                        self.held.push((tried, until));
                    }
                }
            }
            if self.held.is_empty() {
                self.held = before; // this round was cut short
            }
            work *= MORE;
        }
        Ok(())
    }

    /// Runs one setting to the end, since one that stalls is of no use, for at most `work` of counted work, ns.
    fn attempt(&mut self, rung: Rung, work: u64, go_on: GoOn) -> Result<Outcome, Interrupted> {
        let until = self.reference.instants.until;
        let frames = rung.dt.map_or(0.0, |dt| until / dt);
        if self.spent >= PATIENCE || least(rung.method, frames) > work as f64 {
            return Ok(Outcome::Unfinished);
        }
        let mut simulation = Simulation::new(self.scene, rung.settings(until));
        let limits = (self.wanted, Budget::counted(work));
        let errors = errors_within(&mut simulation, self.reference, limits, go_on)?;
        let done = counted(&simulation).min(work);
        self.spent += done;
        let error = errors.position.distance;
        Ok(match errors.run.end_reason {
            _ if error > self.wanted => Outcome::Missed,
            Some(EndReason::Stalled(_)) => Outcome::Missed,
            Some(EndReason::Spent) if errors.run.end >= self.reference.meaningful() => {
                Outcome::Held(Tried { rung, error, work: done }, errors.run.end)
            }
            Some(EndReason::Spent) => Outcome::Unfinished,
            Some(EndReason::Enough) | None => Outcome::Met(Tried { rung, error, work: done }),
        })
    }
}

fn nothing(wanted: f64, methods: &[Method], reference: &Reference, cut_short: bool) -> String {
    let names: Vec<&str> = methods.iter().map(|method| method.name()).collect();
    let work = if cut_short { " within the work that a search may take" } else { "" };
    format!(
        "no setting of {} was found{work} that meets a position error of {wanted:e} m up to {} s; carom measure shows \
         what there is",
        names.join(", "),
        format::time(reference.meaningful()),
    )
}

impl Choice {
    /// What was chosen and why, what error was found and up to when: one line.
    pub fn sentence(&self) -> String {
        let in_words = |tried: &Tried| setting(tried.rung.method.name(), tried.rung.dt, tried.rung.tolerance);
        let Tried { error, work, .. } = self.chosen;
        let reason = match self.tried_until {
            None => format!("least counted work of {} settings, about", self.settings_tried.0),
            Some(until) => format!("farthest of {} settings, to {} s in", self.settings_tried.0, format::time(until)),
        };
        let next = self.next.map_or(String::new(), |next| {
            let times = format::significant(next.work as f64 / work.max(1) as f64, 1);
            format!("; next is {}, {times} times that", in_words(&next))
        });
        let certified = match self.certified < self.compared {
            true => format!(" (certified up to {} s)", format::time(self.certified)),
            false => String::new(),
        };
        format!(
            "chose {}: {reason} {}; position error {} m up to {} s, exact itself off by {} m at \
             most{certified}{next}",
            in_words(&self.chosen),
            format::duration(work as f64 * 1e-9),
            format::digits(error, 1),
            format::time(self.compared),
            format::digits(self.floor, 1),
        )
    }
}
