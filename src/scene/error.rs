//! Why a scene is refused: one full sentence that is safe to print, whatever the file holds.

use std::fmt;

use super::locate::{Position, Step, locate};

/// Longest text quoted from a file, characters.
pub(super) const QUOTE: usize = 60;
/// Longest file name shown, characters.
const ORIGIN: usize = 200;
/// Longest message shown, characters: a list of all built-in names fits.
const MESSAGE: usize = 1500;

/// A refused scene. Displays as `FILE:LINE:COLUMN: field.path: what is wrong and what is allowed`, in one line of
/// bounded length, without control or direction-changing characters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error {
    origin: String,
    position: Option<Position>,
    field: String,
    message: String,
}

impl Error {
    /// A refusal of a whole file, or of a name that leads to none.
    pub(super) fn whole(origin: &str, message: impl fmt::Display) -> Error {
        Error {
            origin: clean(origin, ORIGIN),
            position: None,
            field: String::new(),
            message: clean(&message.to_string(), MESSAGE),
        }
    }

    /// Where in the file, if it is about a place there.
    pub fn position(&self) -> Option<Position> {
        self.position
    }

    /// The field, as `spheres[3].mass`; empty if it is about none.
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

/// A scene's text and where it came from: what a refusal needs to name its place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source<'a> {
    /// The whole file.
    pub(super) text: &'a str,
    /// Its path or built-in name.
    pub(super) origin: &'a str,
}

impl Source<'_> {
    /// A refusal of the value at `path`.
    pub(super) fn refuse(&self, path: &[Step], message: impl fmt::Display) -> Error {
        self.refuse_at(locate(self.text, path), path, message)
    }

    /// A refusal of what stands at a known position, within the value at `path`.
    pub(super) fn refuse_at(&self, position: Option<Position>, path: &[Step], message: impl fmt::Display) -> Error {
        Error { position, field: clean(&spelled(path), ORIGIN), ..Error::whole(self.origin, message) }
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

/// Text from outside as it may be printed: control, direction and invisible format characters replaced, cut after
/// `limit` characters.
pub(super) fn clean(text: &str, limit: usize) -> String {
    let shown = |c: char| if c.is_control() || is_format(c) { char::REPLACEMENT_CHARACTER } else { c };
    let mut cleaned: String = text.chars().take(limit).map(shown).collect();
    if text.chars().nth(limit).is_some() {
        cleaned.push('…');
    }
    cleaned
}

/// A piece of the file in a message, in backticks.
pub(super) fn quote(text: &str) -> String {
    format!("`{}`", clean(text, QUOTE))
}

/// A number in a message: the shortest digits that read back, with an exponent where a row of zeros would stand.
pub(super) fn show(value: f64) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-5..1e16).contains(&value.abs());
    if plain { format!("{value}") } else { format!("{value:e}") }
}

/// A measured number in a message, to four digits.
pub(super) fn show_rounded(value: f64) -> String {
    show(format!("{value:.3e}").parse().unwrap_or(value))
}

/// Characters that move or hide their neighbours (Unicode 16: soft hyphen, bidirectional controls, joiners, tags …).
pub(super) fn is_format(c: char) -> bool {
    matches!(
        c,
        '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}'
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_escape_sequence_and_no_direction_change_survives() {
        let hostile = "a\u{1b}[2Jb\nc\u{202e}d\u{9b}e";
        assert_eq!(clean(hostile, 99), "a\u{fffd}[2Jb\u{fffd}c\u{fffd}d\u{fffd}e");
    }

    #[test]
    fn long_values_are_cut() {
        assert_eq!(quote(&"x".repeat(1_000_000)).chars().count(), QUOTE + 3);
    }

    #[test]
    fn numbers_read_as_people_write_them() {
        let shown = [0.0, -1.0, 0.1, 1e300, 1e-9, f64::INFINITY, f64::NAN].map(show);
        assert_eq!(shown, ["0", "-1", "0.1", "1e300", "1e-9", "inf", "NaN"]);
        assert_eq!(show_rounded(0.123_456), "0.1235");
    }
}
