//! A family of known results, and what became of it.

use super::runner::{Row, Runner, Trouble};

/// A family of known results that are measured together.
#[derive(Debug, Clone, Copy)]
pub struct Check {
    /// What the results are about, in two or three words.
    pub title: &'static str,
    /// What is expected, and its source.
    pub source: &'static str,
    /// Why an error of that size is allowed.
    pub allowed: &'static str,
    pub(super) measure: fn(&Runner) -> Result<Vec<Row>, Trouble>,
}

impl Check {
    /// Measures its rows; never empty.
    ///
    /// # Errors
    /// If a run stalls, or the runner is not to go on.
    pub fn rows(&self, runner: &Runner) -> Result<Vec<Row>, Trouble> {
        (self.measure)(runner)
    }
}

/// What became of a check: its place in [`CHECKS`](super::CHECKS), and its rows or why there are none.
pub type Outcome = (usize, Result<Vec<Row>, Trouble>);
