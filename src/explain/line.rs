//! A line of an explanation.

/// A line of an explanation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// What it is about, in a word.
    pub label: &'static str,
    /// What it says.
    pub text: String,
}

impl Line {
    /// A line that says `text` of `label`.
    pub(super) fn new(label: &'static str, text: impl Into<String>) -> Line {
        Line { label, text: text.into() }
    }
}
