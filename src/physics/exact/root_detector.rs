//! Contact times as roots of polynomials.

use crate::physics::contact_time::{sphere_sphere, sphere_wall};
use crate::physics::events::detector::{Detector, Due, Span};
use crate::physics::events::rounding::HEALED;
use crate::physics::log::Log;
use crate::physics::model::Settings;
use crate::physics::path::Path;
use crate::physics::wall::Face;

/// The detector of `exact`: every answer is a contact, exact up to rounding, and costs the same wherever it lies.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RootDetector;

impl Detector for RootDetector {
    const PAIRS_FIRST: bool = true;
    const STRAIGHT_PAIRS: bool = true;
    const ONE_LOOK: bool = true;

    fn new(_: Settings) -> RootDetector {
        RootDetector
    }

    fn retune(&mut self, _: Settings) -> bool {
        false
    }

    fn healed(&self) -> f64 {
        HEALED
    }

    #[inline]
    fn wall(&self, path: &Path, r: f64, face: &Face, span: Span) -> Option<Due> {
        sphere_wall(path, r, face, span.before).map(|after| Due { after, is_contact: true })
    }

    #[inline]
    fn pair(&self, a: &Path, b: &Path, reach: f64, span: Span) -> Option<Due> {
        sphere_sphere(&a.relative_to(b), reach, span.before).map(|after| Due { after, is_contact: true })
    }

    #[inline]
    fn pair_horizon(mine: f64, _: f64) -> f64 {
        mine
    }

    fn report(&mut self, _: f64, _: f64, pairs: u64, log: &mut Log) {
        log.tallies.evaluations += pairs;
    }
}
