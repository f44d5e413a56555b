//! `carom replay FILE`: runs a recording again, and names the first frame and the sphere that differ.

use std::io::Write;
use std::path::Path;

use super::arguments::Replay;
use super::failure::Failure;
use super::frames::{next_recorded, run_of};
use super::output::Output;
use super::signals::Signals;
use crate::printable;
use crate::recording::{LARGEST, Recording, Sums, Suspect};
use crate::scene;

/// The recording in a file.
///
/// # Errors
/// If it cannot be read, or is none.
pub(super) fn read(file: &Path) -> Result<Recording, Failure> {
    let failed = |said: String| Failure::Failed(format!("{}: {said}", printable::name(file.as_os_str())));
    let bytes = scene::contents_within(file, "a recording", LARGEST).map_err(failed)?;
    Recording::from_bytes(&bytes).map_err(|error| failed(error.to_string()))
}

pub(super) fn replay(arguments: &Replay, signals: &Signals) -> Result<(), Failure> {
    let name = printable::name(arguments.file.as_os_str());
    let failed = |said: String| Failure::Failed(format!("{name}: {said}"));
    let recording = read(&arguments.file)?;
    let mut run = run_of(&recording)?;
    let spheres = run.model().len();
    let (mut goes_on, mut compared) = (true, 0);
    let mut changes = &recording.changes[..];
    for recorded in &recording.frames {
        if !goes_on {
            return Err(failed(format!("after frame {} the run cannot go on, and the recording does", compared - 1)));
        }
        if let Some(suspect) = Sums::of(&run.state()).suspect(*recorded, spheres) {
            let what = match suspect {
                Suspect::Sphere(index) => format!("sphere {index} is not as recorded"),
                Suspect::Time => "its time is not as recorded".into(),
                Suspect::Several => "more than one sphere is not as recorded, or the file is damaged there".into(),
            };
            return Err(failed(format!("frame {compared}, at t = {:?} s, differs: {what}", run.time())));
        }
        compared += 1;
        goes_on = compared == recording.frames.len() || next_recorded(&mut run, &mut changes, signals)?;
    }
    let mut out = Output::stdout();
    writeln!(out, "frames={} t={:?} hash={:016x} same", compared.saturating_sub(1), run.time(), run.state().hash())?;
    out.finish()
}
