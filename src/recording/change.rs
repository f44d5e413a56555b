//! A change of settings within a recording.

use crate::scene::{Method, Settings};

/// A change of settings while a run is recorded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Number of frames completed before the change.
    pub frame: u64,
    /// Whether the next frame had been tried, and could not be.
    pub stalled: bool,
    /// Settings of the run from the change on.
    pub settings: Settings,
}

impl Change {
    /// The change as a line of a file, without its end: `change 120 made exact 0.01 0.001`.
    pub(super) fn line(&self) -> String {
        let Change { frame, stalled, settings: Settings { method, dt, tolerance } } = *self;
        let when = if stalled { STALLED } else { MADE };
        format!("change {frame} {when} {} {dt:?} {tolerance:?}", method.name())
    }

    /// The change that stands behind the line's first word; none if none does.
    pub(super) fn read(text: &str) -> Option<Change> {
        let words: Vec<&str> = text.split(' ').collect();
        let [frame, when, method, dt, tolerance] = words[..] else { return None };
        let stalled = match when {
            MADE => false,
            STALLED => true,
            _ => return None,
        };
        let settings = settings(method, dt, tolerance)?;
        Some(Change { frame: frame.parse().ok()?, stalled, settings })
    }
}

/// Word of a change made between two frames.
const MADE: &str = "made";
/// Word of a change made where a run could not go on.
const STALLED: &str = "stalled";

/// Settings as a file says them, if they are in their ranges.
fn settings(method: &str, dt: &str, tolerance: &str) -> Option<Settings> {
    let dt = dt.parse().ok().filter(|dt: &f64| dt.is_finite() && *dt > 0.0)?;
    let tolerance = tolerance.parse().ok().filter(|tolerance: &f64| tolerance.is_finite() && *tolerance >= 0.0)?;
    Some(Settings { method: Method::from_name(method)?, dt, tolerance })
}
