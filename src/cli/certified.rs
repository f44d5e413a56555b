//! `--certify`: a run by `exact` that states its own error.

use super::arguments::Solver;
use super::failure::Failure;
use super::signals::Signals;
use crate::certify::{Certificate, certify};
use crate::format;
use crate::scene::{Method, Scene, Settings};

/// The mark of a run that shall be certified, and can be.
pub(super) struct Certified;

impl Certified {
    /// The mark, if the command line asks for a run that can be certified.
    ///
    /// # Errors
    /// If it names a method other than `exact`.
    pub(super) fn of(solver: &Solver) -> Result<Certified, Failure> {
        match solver.method() {
            None | Some(Method::Exact) => Ok(Certified),
            Some(other) => Err(Failure::Usage(format!(
                "--certify states the error of exact, not of {}; leave out --method, or measure the error with `carom measure`",
                other.name()
            ))),
        }
    }

    /// The settings with the method `exact`.
    pub(super) fn settings(&self, settings: Settings) -> Settings {
        Settings { method: Method::Exact, ..settings }
    }

    /// The certificate of a scene up to `until`, s.
    ///
    /// # Errors
    /// If a signal arrives.
    pub(super) fn certificate(&self, scene: &Scene, until: f64, signals: &Signals) -> Result<Certificate, Failure> {
        match certify(scene, until, &|| signals.check().is_ok()) {
            Some(certificate) => Ok(certificate),
            None => Err(signals.check().err().unwrap_or(Failure::Told)),
        }
    }
}

/// What the closing line says of a certificate.
pub(super) fn words(certificate: &Certificate) -> String {
    format!(" certified_until={:?} error={:?}", certificate.until, certificate.error)
}

/// What must be said of a certificate besides: where it ends, and what it has taken from `exact`.
pub(super) fn notes(certificate: &Certificate) -> Vec<String> {
    let ties = (certificate.ties > 0).then(|| {
        format!(
            "{} at the same time as another of the same sphere: the law leaves their order open, and it is that of exact",
            format::counted(certificate.ties, "impact")
        )
    });
    certificate.ending.iter().map(ToString::to_string).chain(ties).collect()
}
