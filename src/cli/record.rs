//! `carom record SCENE FILE`: a run as a recording that proves itself (`.carom`), or as a film of the screen (`.cast`).

use std::io::Write;
use std::path::Path;

use super::accuracy;
use super::arguments::Record;
use super::cast;
use super::failure::{Failure, note};
use super::frames::next_frame;
use super::output::Output;
use super::signals::Signals;
use super::target::{Target, refuse_shared};
use crate::physics::Simulation;
use crate::recording::{Recording, Sums};
use crate::scene;

/// Frames of a recording, 80 MB: more are refused.
const MOST_FRAMES: usize = 10_000_000;

/// What a file's name says that it is to be.
enum Kind {
    /// Sums of every frame.
    Recording,
    /// Pictures of the screen.
    Film,
}

pub(super) fn record(arguments: &Record, signals: &Signals) -> Result<(), Failure> {
    let kind = kind(&arguments.file)?;
    let (opened, text) = scene::open_with_text(&arguments.scene).map_err(|error| Failure::Failed(error.to_string()))?;
    let target = Target::File(arguments.file.clone());
    let input: Vec<(&str, &Path)> = opened.path.iter().map(|path| ("the scene", path.as_path())).collect();
    refuse_shared(&[("FILE", Some(&target))], &input)?;
    if arguments.file.exists() && !arguments.force {
        return Err(Failure::Failed(format!("{} is there already; --force replaces it", target.name())));
    }
    let until = arguments.until.unwrap_or(opened.scene.duration);
    let (settings, said) = accuracy::settings(&arguments.solver, &opened.scene, until, Some(signals))?;
    said.iter().for_each(|said| note(said));
    let mut out = Output::open(&target)?;
    match kind {
        Kind::Recording => {
            let frames = frames(&mut Simulation::new(&opened.scene, settings), until, signals)?;
            note(&format!("{}: {} frames", target.name(), frames.len() - 1));
            let recording = Recording { key: opened.key, scene: text, settings, changes: Vec::new(), frames };
            out.write_all(&recording.to_bytes())?;
        }
        Kind::Film => {
            let film = cast::Film { opened: &opened, settings, until, size: arguments.size, speed: arguments.speed };
            cast::write(&film, &mut out, signals)?;
        }
    }
    out.finish()
}

fn kind(file: &Path) -> Result<Kind, Failure> {
    match file.extension().and_then(|extension| extension.to_str()) {
        Some("carom") => Ok(Kind::Recording),
        Some("cast") => Ok(Kind::Film),
        _ => Err(Failure::Usage(
            "FILE must end in .carom (a recording that `carom replay` verifies) or .cast (a film for asciinema)".into(),
        )),
    }
}

/// The sums of the state at t = 0, and at the end of every frame up to the first that ends at `until` (s) or later.
fn frames(run: &mut Simulation, until: f64, signals: &Signals) -> Result<Vec<Sums>, Failure> {
    let mut frames = vec![Sums::of(&run.state())];
    while run.time() < until && next_frame(run, signals)? {
        frames.push(Sums::of(&run.state()));
        if frames.len() > MOST_FRAMES {
            return Err(Failure::Failed(format!(
                "there are more than {MOST_FRAMES} frames by t = {} s; a larger --dt or an earlier --until makes fewer",
                run.time()
            )));
        }
    }
    Ok(frames)
}
