//! A run without a screen, frame by frame.

use super::failure::{Failure, note};
use super::signals::Signals;
use crate::physics::{Progress, Simulation, Until};
use crate::recording::Recording;
use crate::scene;

/// One frame further; false if the run cannot go on.
pub(super) fn next_frame(run: &mut Simulation, signals: &Signals) -> Result<bool, Failure> {
    loop {
        signals.check()?;
        match run.advance(Until::Frame, Simulation::SLICE) {
            Progress::Yielded => {}
            Progress::Reached => return Ok(true),
            Progress::Stalled(stall) => {
                note(&stall.reason);
                return Ok(false);
            }
        }
    }
}

/// A run of a recording's scene by its settings.
///
/// # Errors
/// If its scene breaks a rule.
pub(super) fn run_of(recording: &Recording) -> Result<Simulation, Failure> {
    let scene = scene::parse(&recording.scene, &recording.key).map_err(|error| Failure::Failed(error.to_string()))?;
    Ok(Simulation::new(&scene, recording.settings))
}
