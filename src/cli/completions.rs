//! `carom completions SHELL`: what the shell needs to complete our commands and options.

use std::io::Write;

use clap::CommandFactory;

use super::arguments::{Arguments, Completions};
use super::failure::Failure;
use super::output::Output;

pub(super) fn completions(arguments: &Completions) -> Result<(), Failure> {
    let mut script = Vec::new(); // clap_complete panics on a writer that fails
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "carom", &mut script);
    let mut out = Output::stdout();
    out.write_all(&script)?;
    out.finish()
}
