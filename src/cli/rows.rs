//! How many rows of states a run is asked for, and whether that can be meant.

use super::arguments::Run;
use super::failure::{Failure, note};
use crate::format;
use crate::scene::Scene;

/// Most rows of states that are written without a question, some ten gigabytes of CSV.
const MANY: f64 = 1e8;

/// Refuses more rows, up to `until` (s), than any disk is meant to take, unless they are wanted; then says how many come.
///
/// # Errors
/// A sentence with the number, if `--yes` is not given.
pub(super) fn refuse_too_many(arguments: &Run, scene: &Scene, until: f64) -> Result<(), Failure> {
    let Some(every) = arguments.every else { return Ok(()) };
    let rows = ((until / every).ceil() + 1.0) * scene.spheres.len().max(1) as f64;
    if rows <= MANY {
        return Ok(());
    }
    let (rows, step) = (format::amount(rows), format::number(every));
    if !arguments.yes {
        return Err(Failure::Usage(format!(
            "--every {step} asks for {rows} rows of states; add --yes if that is meant"
        )));
    }
    note(&format!("--every {step} writes {rows} rows of states"));
    Ok(())
}
