//! How a command can end other than well: its exit code, and its one line on stderr.

use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue};

/// Exit code of a command that could not do its work.
const FAILED: u8 = 1;
/// Exit code of wrong usage; clap's own.
const USAGE: u8 = 2;
/// Added to a signal's number, as shells do.
const SIGNALLED: u8 = 128;
/// A reader that has gone is SIGPIPE to every other tool; ours ends with the code that they end with.
const SIGPIPE: u8 = 13;

/// How a command ended other than well.
#[derive(Debug)]
pub(super) enum Failure {
    /// What clap has to say: wrong usage, or the help and version that were asked for.
    Clap(clap::Error),
    /// The work could not be done: one full sentence.
    Failed(String),
    /// It was said already, line by line.
    Told,
    /// The options are each right, but not together: one full sentence.
    Usage(String),
    /// Whoever read our output has gone.
    ClosedPipe,
    /// A signal of this number.
    Signal(u8),
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Failure {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Failure::ClosedPipe,
            _ => Failure::Failed(error.to_string()),
        }
    }
}

impl Failure {
    /// Says it, and tells the exit code.
    pub(super) fn report(self) -> ExitCode {
        match self {
            Failure::Clap(error) => explain(error),
            Failure::Failed(sentence) => say(&sentence, FAILED),
            Failure::Told => ExitCode::from(FAILED),
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

/// One line on stderr. If nobody can read it, the exit code still tells.
pub(super) fn note(sentence: &str) {
    let _ = writeln!(io::stderr(), "carom: {}", printable(sentence));
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
    match error.print() {
        Ok(()) => ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(USAGE)),
        Err(broken) => Failure::from(broken).report(),
    }
}

/// What clap would quote from the command line, if a control character is in it. Its own styles are another variant.
fn escaped(value: &ContextValue) -> Option<ContextValue> {
    match value {
        ContextValue::String(text) if text.contains(is_unprintable) => Some(ContextValue::String(printable(text))),
        _ => None,
    }
}

/// The text with every control and direction-changing character spelled out, so that no terminal obeys it.
pub(super) fn printable(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut clean, c| {
        if is_unprintable(c) {
            let _ = write!(clean, "{}", c.escape_default());
        } else {
            clean.push(c);
        }
        clean
    })
}

fn is_unprintable(c: char) -> bool {
    c.is_control() || matches!(c, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_spelled_out() {
        assert_eq!(printable("a\u{1b}[2Jb\nc\u{9b}d\u{202e}é→"), "a\\u{1b}[2Jb\\nc\\u{9b}d\\u{202e}é→");
    }

    #[test]
    fn a_closed_pipe_is_not_an_error_message() {
        let failure = Failure::from(io::Error::from(io::ErrorKind::BrokenPipe));
        assert!(matches!(failure, Failure::ClosedPipe), "{failure:?}");
    }
}
