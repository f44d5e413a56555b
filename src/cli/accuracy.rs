//! `--accuracy E`: settings chosen by trying them, and the line that names them.

use std::io::{self, IsTerminal, Write};

use super::arguments::Solver;
use super::failure::Failure;
use super::signals::Signals;
use crate::measure::{Miss, choose};
use crate::scene::{Scene, Settings};

/// What the command line asks to solve a scene with, up to `until` (s), and what there is to say about it. Without
/// `signals` they do what they always do: there is nothing to put away yet.
///
/// # Errors
/// If an accuracy is asked for that nothing meets, or a signal arrives.
pub(super) fn settings(
    solver: &Solver,
    scene: &Scene,
    until: f64,
    signals: Option<&Signals>,
) -> Result<(Settings, Option<String>), Failure> {
    let plain = solver.over(scene.solver);
    let Some((error, methods)) = solver.accuracy() else { return Ok((plain, None)) };
    from_its_start(scene, "--accuracy")?;
    let waiting = Waiting::begin(error);
    let undisturbed = || signals.map_or(Ok(()), Signals::check);
    let found = choose(scene, (error, until), &methods, plain, &|| undisturbed().is_ok());
    drop(waiting);
    match found {
        Ok(choice) => Ok((choice.settings, Some(choice.sentence()))),
        Err(Miss::Nothing(sentence)) => Err(Failure::Failed(sentence)),
        Err(Miss::Interrupted) => Err(undisturbed().err().unwrap_or(Failure::Told)),
    }
}

/// Refuses a scene that goes on from another run where errors are measured: they are counted from a start.
///
/// # Errors
/// A sentence that names `what` is asked for.
pub(super) fn from_its_start(scene: &Scene, what: &str) -> Result<(), Failure> {
    match &scene.resume {
        Some(resume) => Err(Failure::Usage(format!(
            "{what} counts errors from a scene's start, and this one goes on from t = {:?} s; give it the scene that was begun with, \
             or one without `resume`",
            resume.t
        ))),
        None => Ok(()),
    }
}

/// A line on the terminal as long as the search takes.
struct Waiting {
    shown: bool,
}

impl Waiting {
    fn begin(error: f64) -> Waiting {
        let shown = io::stderr().is_terminal() && std::env::var_os("TERM").is_some_and(|term| term != "dumb");
        if shown {
            let _ = write!(io::stderr(), "carom: trying what meets {error:e} m, a few seconds …"); // only a courtesy
        }
        Waiting { shown }
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        if self.shown {
            let _ = write!(io::stderr(), "\r\x1b[K"); // back to the line's start, and erase it
        }
    }
}
