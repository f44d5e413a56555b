//! `carom check SCENE…`: whether scenes are valid, and what each requires.

use std::io::Write;

use super::arguments::Check;
use super::failure::{Failure, note};
use super::output::Output;
use crate::physics::Model;
use crate::scene::{self, Opened};

pub(super) fn check(arguments: &Check) -> Result<(), Failure> {
    let mut out = Output::stdout();
    let mut refused = 0;
    for name in &arguments.scenes {
        match scene::open(name) {
            Ok(opened) => tell(&opened, &mut out)?,
            Err(error) => {
                refused += 1;
                note(&error.to_string());
            }
        }
    }
    out.finish()?;
    if refused == 0 { Ok(()) } else { Err(Failure::Told) }
}

/// What the model of a valid scene holds and what it leaves out; what may be meant otherwise, to stderr.
fn tell(opened: &Opened, out: &mut impl Write) -> Result<(), Failure> {
    let required = Model::new(&opened.scene).requirements();
    writeln!(out, "{}: ok", opened.key)?;
    writeln!(out, "  holds      {}", required.held().join(", "))?;
    if !required.left_out().is_empty() {
        writeln!(out, "  leaves out {}", required.left_out().join(", "))?;
    }
    for warning in scene::warnings(&opened.scene, opened.scene.solver, opened.scene.duration) {
        note(&format!("{}: {warning}", opened.key));
    }
    Ok(())
}
