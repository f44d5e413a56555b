//! `carom show NAME`: a built-in scene's file, to start one's own from.

use std::io::Write;

use super::arguments::Show;
use super::failure::Failure;
use super::output::Output;
use crate::scene::builtin;

pub(super) fn show(arguments: &Show) -> Result<(), Failure> {
    let found = builtin::ALL.iter().find(|scene| scene.name == arguments.name);
    let scene = found.ok_or_else(|| unknown(&arguments.name))?;
    let mut out = Output::stdout();
    out.write_all(scene.text.as_bytes())?;
    out.finish()
}

fn unknown(name: &str) -> Failure {
    let known: Vec<_> = builtin::ALL.iter().map(|scene| scene.name).collect();
    Failure::Failed(format!("there is no built-in scene \"{name}\"; there are {}", known.join(", ")))
}
