//! How deep a method may let bodies overlap, as it says itself.

use crate::physics::{Method, Settings};

/// The degrees up to which a method lets bodies overlap, dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Promise {
    /// Degree of bodies in flight, and of those that rest on faces.
    pub(super) flight: f64,
    /// Degree of bodies that rest on each other, on edges or on corners: their motion is integrated.
    pub(super) curved: f64,
}

/// What rounding leaves of a contact, in multiples of machine epsilon times the coordinates: 16 ulp.
pub(super) const ULPS: f64 = 16.0 * f64::EPSILON;

/// What event-driven methods promise for flights and faces, and for curved rest.
pub(super) const FLIGHT: f64 = 1e-12;
const CURVED: f64 = 1e-9;

/// Degree that `paper` accepts beyond its tolerance.
const PAPER_SLACK: f64 = 1e-4;

/// The largest tolerance that counts, dimensionless.
const LARGEST: f64 = 0.5;

impl Promise {
    /// What these settings promise. `moreau` may miss a row by its tolerance, in radii, and its walls are straight for a
    /// frame: like curved rest, that leaves up to 1e-9.
    pub(super) fn of(settings: &Settings) -> Promise {
        let tolerance = settings.tolerance.min(LARGEST);
        match settings.method {
            Method::Exact => Promise { flight: FLIGHT, curved: CURVED },
            Method::Swept => Promise { flight: tolerance + FLIGHT, curved: tolerance + CURVED },
            Method::Paper => Promise { flight: tolerance + PAPER_SLACK, curved: tolerance + PAPER_SLACK },
            Method::Moreau => Promise { flight: tolerance + CURVED, curved: tolerance + CURVED },
        }
    }

    /// The degree from which on a run alarms: coarser than the one that `--check` holds a run to.
    pub(super) fn alarm(settings: &Settings) -> f64 {
        Promise::of(settings).curved
    }
}
