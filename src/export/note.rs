//! Reasons to doubt the figures of a row of the trade.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Reasons to doubt a row's figures. A cell holds its phrases, joined by `; `.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub struct Note {
    /// When and why the run stopped before its end, as `10.3 s (resting-contact)`; none if it did not.
    pub stalled: Option<String>,
    /// Everything else, a phrase each.
    pub doubts: Vec<String>,
}

/// What stands between the phrases of a cell.
const BETWEEN: &str = "; ";

/// How the phrase of a run that stopped before its end begins.
const STALLED: &str = "stalled at ";

impl Note {
    /// Whether there is nothing to say.
    pub fn is_empty(&self) -> bool {
        self.stalled.is_none() && self.doubts.is_empty()
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(stalled) = &self.stalled {
            write!(f, "{STALLED}{stalled}")?;
        }
        let between = if self.stalled.is_some() && !self.doubts.is_empty() { BETWEEN } else { "" };
        write!(f, "{between}{}", self.doubts.join(BETWEEN))
    }
}

impl From<&str> for Note {
    fn from(cell: &str) -> Note {
        let mut phrases = cell.split(BETWEEN).filter(|phrase| !phrase.is_empty()).peekable();
        let stalled =
            phrases.next_if(|first| first.starts_with(STALLED)).map(|first| first[STALLED.len()..].to_owned());
        Note { stalled, doubts: phrases.map(str::to_owned).collect() }
    }
}

impl From<String> for Note {
    fn from(cell: String) -> Note {
        Note::from(cell.as_str())
    }
}

impl From<Note> for String {
    fn from(note: Note) -> String {
        note.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_note_is_written_as_it_is_read() {
        for cell in ["", "stalled at 1 s (zeno)", "horizon short; timed once", "stalled at 1 s; machine busy"] {
            let note = Note::from(cell);
            assert_eq!((note.to_string().as_str(), note.stalled.is_some()), (cell, cell.starts_with("stalled")));
        }
        assert_eq!(Note::from("horizon short; timed once").doubts, ["horizon short", "timed once"]);
    }
}
