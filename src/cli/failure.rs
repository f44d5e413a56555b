//! How a command can end other than well: its exit code, and its one line on stderr.

use std::io::{self, Write};
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue};

use crate::printable;

/// Exit code of a command that could not do its work.
const FAILED: u8 = 1;
/// Exit code of wrong usage; clap's own.
const USAGE: u8 = 2;
/// What is added to a signal's number, as shells do.
const SIGNALLED: u8 = 128;
/// Number of SIGPIPE: a reader that has gone ends every other tool by it, and ours with that code.
const SIGPIPE: u8 = 13;

/// How a command ended other than well.
#[derive(Debug)]
pub(super) enum Failure {
    /// Wrong usage, in the words of clap; or the help and version that were asked for.
    Clap(clap::Error),
    /// The work could not be done: one full sentence.
    Failed(String),
    /// The work could not be done, and the reasons are printed already.
    Told,
    /// An input is not what it should be, and what is wrong with it is printed already.
    BadInput,
    /// The options are each right, but not together: one full sentence.
    Usage(String),
    /// The reader of our output has gone.
    ClosedPipe,
    /// A signal of this number.
    Signal(u8),
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Failure {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
            _ => Failure::Failed(printable::cause(&error)),
        }
    }
}

impl Failure {
    /// Prints the line that belongs to the failure on stderr, if one does; the exit code.
    pub(super) fn report(self) -> ExitCode {
        match self {
            Failure::Clap(error) => explain(error),
            Failure::Failed(sentence) => say(&sentence, FAILED),
            Failure::Told => ExitCode::from(FAILED),
            Failure::BadInput => ExitCode::from(USAGE),
            Failure::Usage(sentence) => say(&sentence, USAGE),
            Failure::ClosedPipe => ExitCode::from(SIGNALLED + SIGPIPE),
            Failure::Signal(number) => ExitCode::from(SIGNALLED.saturating_add(number)),
        }
    }
}

fn say(sentence: &str, code: u8) -> ExitCode {
    note(sentence);
    ExitCode::from(code)
}

/// Prints one line on stderr. If it cannot be read, the exit code still tells.
pub(super) fn note(sentence: &str) {
    let _ = writeln!(io::stderr(), "carom: {}", printable::escaped(sentence));
}

/// Without clap's own help and version, which go to stdout, this is wrong usage.
fn explain(mut error: clap::Error) -> ExitCode {
    let harmless: Vec<_> = error.context().filter_map(|(kind, value)| Some((kind, escaped(value)?))).collect();
    if !harmless.is_empty() {
        error.remove(ContextKind::Suggested); // clap's tip repeats the argument, among its own escape codes
    }
    for (kind, value) in harmless {
        error.insert(kind, value);
    }
    let code = ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(USAGE));
    let plain = error.render().to_string();
    let printed = match plain.lines().all(|line| line.chars().all(printable::is_printable)) {
        true => error.print(),
        false => plain.lines().try_for_each(|line| writeln!(io::stderr(), "{}", printable::escaped(line))),
    };
    match printed {
        // Wrong usage stays wrong usage, whether or not the message can be read.
        Err(broken) if !error.use_stderr() => Failure::from(cannot_write("standard output", &broken)).report(),
        _ => code,
    }
}

/// Keeps the kind, by which a closed pipe is told from a failure.
pub(super) fn cannot_write(name: &str, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("cannot write {name}: {}", printable::cause(error)))
}

/// What clap would quote from the command line, if it is not printable as it is. Its own styles are another variant.
fn escaped(value: &ContextValue) -> Option<ContextValue> {
    match value {
        ContextValue::String(text) if !text.chars().all(printable::is_printable) => {
            Some(ContextValue::String(printable::escaped(text)))
        }
        ContextValue::Strings(list) if !list.iter().all(|text| text.chars().all(printable::is_printable)) => {
            Some(ContextValue::Strings(list.iter().map(|text| printable::escaped(text)).collect()))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_closed_pipe_is_not_an_error_message() {
        let failure = Failure::from(io::Error::from(io::ErrorKind::BrokenPipe));
        assert!(matches!(failure, Failure::ClosedPipe), "{failure:?}");
    }
}
