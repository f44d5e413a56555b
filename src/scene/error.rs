//! Why a file is refused: one full sentence that is safe to print, whatever the file holds.

use std::fmt;

use super::locate::{Position, Step, locate};
use crate::printable::shortened;

/// Longest text quoted from a file, characters.
pub(super) const QUOTE: usize = 60;
/// Longest file name shown, characters.
const ORIGIN: usize = 200;
/// Longest message shown, characters: a list of all built-in names fits.
const MESSAGE: usize = 1500;

/// A refused scene or configuration. Displays as `FILE:LINE:COLUMN: field.path: what is wrong and what is allowed`, in one
/// line of bounded length, without control or direction-changing characters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error {
    origin: String,
    position: Option<Position>,
    field: String,
    message: String,
}

impl Error {
    /// A refusal of a whole file, or of a name that leads to none.
    pub(crate) fn whole(origin: &str, message: impl fmt::Display) -> Error {
        Error {
            origin: shortened(origin, ORIGIN),
            position: None,
            field: String::new(),
            message: shortened(&message.to_string(), MESSAGE),
        }
    }

    /// Where in the file the refused value stands; none if the refusal is of no place in it.
    pub fn position(&self) -> Option<Position> {
        self.position
    }

    /// The refused field, as `spheres[3].mass`; empty if there is none.
    pub fn field(&self) -> &str {
        &self.field
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.origin)?;
        if let Some(Position { line, column }) = self.position {
            write!(f, ":{line}:{column}")?;
        }
        if !self.field.is_empty() {
            write!(f, ": {}", self.field)?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for Error {}

/// A text and where it came from: what a refusal needs to name its place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source<'a> {
    /// The whole file.
    pub(crate) text: &'a str,
    /// Path or built-in name of the text.
    pub(crate) origin: &'a str,
}

impl Source<'_> {
    /// A refusal of the value at `path`.
    pub(crate) fn refuse(&self, path: &[Step], message: impl fmt::Display) -> Error {
        self.refuse_at(locate(self.text, path), path, message)
    }

    /// A refusal of what stands at a known position, within the value at `path`.
    pub(super) fn refuse_at(&self, position: Option<Position>, path: &[Step], message: impl fmt::Display) -> Error {
        Error { position, field: shortened(&spelled(path), ORIGIN), ..Error::whole(self.origin, message) }
    }
}

/// A path as users read it: `spheres[3].x[1]`.
fn spelled(path: &[Step]) -> String {
    let mut text = String::new();
    for step in path {
        match step {
            Step::Field(name) if text.is_empty() => text.push_str(name),
            Step::Field(name) => text.push_str(&format!(".{name}")),
            Step::Index(index) => text.push_str(&format!("[{index}]")),
        }
    }
    text
}

/// A piece of the file in a message, in backticks.
pub(crate) fn quote(text: &str) -> String {
    format!("`{}`", shortened(text, QUOTE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_values_are_cut() {
        assert_eq!(quote(&"x".repeat(1_000_000)).chars().count(), QUOTE + 3);
    }
}
