//! A line of an explanation.

/// A line of an explanation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// What the line is about, in a word.
    pub label: &'static str,
    /// What the line says.
    pub text: String,
}

impl Line {
    /// A line that says `text` of `label`.
    pub(super) fn new(label: &'static str, text: impl Into<String>) -> Line {
        Line { label, text: text.into() }
    }
}
