//! A run without a screen, frame by frame.

use super::failure::{Failure, note};
use super::signals::Signals;
use crate::physics::{Progress, Simulation, Until};
use crate::recording::{Change, Recording};
use crate::scene;

/// Advances a run by one frame; false if it cannot go on.
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

/// Advances a recorded run by one frame, its changes made where they were; `left` are those still to be made. False if the
/// run cannot go on.
pub(super) fn next_recorded(run: &mut Simulation, left: &mut &[Change], signals: &Signals) -> Result<bool, Failure> {
    let frame = run.tallies().frames;
    let mut make = |run: &mut Simulation, stalled: bool| match left.split_first() {
        Some((change, rest)) if change.frame <= frame && change.stalled <= stalled => {
            run.set_settings(change.settings);
            *left = rest;
            true
        }
        _ => false,
    };
    while make(run, false) {}
    loop {
        // also one at whose end it cannot go on
        if next_frame(run, signals)? || run.tallies().frames > frame {
            return Ok(true);
        }
        if !make(run, true) {
            return Ok(false);
        }
        while make(run, false) {}
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
