//! The yardstick of a scene: an `exact` run, and the horizon up to which its positions mean something.

use super::horizon;
use super::interrupt::{GoOn, Interrupted};
use super::reference::{OwnError, Reference, settings};
use super::sample::{Budget, EndReason};
use crate::certify::{Certificate, certify_within};
use crate::format;
use crate::scene::{Method, Scene, Settings};

/// Pairs of bodies that a reference's certificate may look at: some ten seconds.
const LOOKS: u64 = 300_000_000;

/// The method that stands in where `exact` can't go on, and its finest setting: (name, dt in s, tolerance).
const STAND_IN: (&str, f64, f64) = ("moreau", 1e-4, 1e-12);

impl Reference {
    /// Runs a scene to `until` (s) by `exact` and finds its horizon; by `moreau` at its finest where `exact` stalls or
    /// takes more than `budget` events, if that method gets farther.
    ///
    /// # Errors
    /// If `go_on` returns false.
    pub fn of(scene: &Scene, until: f64, budget: Budget, go_on: GoOn) -> Result<Reference, Interrupted> {
        let (mut reference, end_reason) = Reference::by(scene, settings(until), until, budget, go_on)?;
        if let Some(end_reason) = end_reason {
            reference.doubt = format!("exact {} at {} s", describe(&end_reason), format::seconds(reference.end));
            let (name, dt, tolerance) = STAND_IN;
            if let Some(method) = Method::from_name(name) {
                let finest = Settings { method, dt, tolerance };
                let (stand_in, _) = Reference::by(scene, finest, until, Budget::UNLIMITED, go_on)?;
                if stand_in.end > reference.end {
                    let doubt = format!("reference is {name} dt {dt:e} because {}", reference.doubt);
                    reference = stand_in;
                    reference.doubt = doubt;
                }
            }
        }
        reference.horizon = horizon::of(scene, &reference, budget, go_on)?;
        Ok(reference)
    }

    /// A certified reference up to `until` (s): its horizon is where the certified error leaves what is `asked` (m), or
    /// where displaced runs have parted, if that is later.
    ///
    /// # Errors
    /// If `go_on` returns false.
    pub fn certified(scene: &Scene, (asked, until): (f64, f64), go_on: GoOn) -> Result<Reference, Interrupted> {
        let reference = Reference::of(scene, until, Budget::REFERENCE, go_on)?;
        if reference.settings.method != Method::Exact {
            return Ok(reference);
        }
        let certificate = certify_within(scene, until, LOOKS, &|| go_on()).ok_or(Interrupted)?;
        Ok(reference.with(&certificate, asked))
    }

    /// The reference with its horizon put off to where a certificate's error leaves what is `asked` (m), if that is later.
    pub(super) fn with(mut self, certificate: &Certificate, asked: f64) -> Reference {
        let until = certificate.within(asked).min(self.end);
        let meaningful = self.meaningful().max(until);
        self.horizon.time = (meaningful < self.end).then_some(meaningful);
        self.own = Some(OwnError { until, error: certificate.error.min(asked) });
        self
    }

    /// Runs a scene by `exact` alone, to `until` (s) or as far as `budget` takes it, and finds its horizon.
    ///
    /// # Errors
    /// If `go_on` returns false.
    pub fn brief(scene: &Scene, until: f64, budget: Budget, go_on: GoOn) -> Result<Reference, Interrupted> {
        let (mut reference, _) = Reference::by(scene, settings(until), until, budget, go_on)?;
        reference.horizon = horizon::of(scene, &reference, budget, go_on)?;
        Ok(reference)
    }
}

fn describe(end_reason: &EndReason) -> String {
    match end_reason {
        EndReason::Stalled(stall) => format!("stalls ({})", stall.kind),
        EndReason::Spent => "passes its budget".into(),
        EndReason::Enough => "was stopped".into(),
    }
}
