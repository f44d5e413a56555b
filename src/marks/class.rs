//! Many files side by side; their order is that of the command line.

use super::exam::{Mark, NoMark};
use crate::measure::{Interrupted, side_by_side};

/// A file and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Marked {
    /// Name of the file, printable.
    pub name: String,
    /// Mark of the file, or why there is none: `line: what is wrong there`.
    pub mark: Result<Mark, String>,
}

/// Marks files 0 to `count` by at most `jobs` threads; none if one was interrupted.
pub fn mark_all(
    count: usize,
    jobs: usize,
    mark: impl Fn(usize) -> (String, Result<Mark, NoMark>) + Sync,
) -> Option<Vec<Marked>> {
    let marked = side_by_side(count, jobs, |index| match mark(index) {
        (_, Err(NoMark::Interrupted)) => Err(Interrupted),
        (name, Err(NoMark::Unreadable(error))) => Ok(Marked { name, mark: Err(error.to_string()) }),
        (name, Ok(mark)) => Ok(Marked { name, mark: Ok(mark) }),
    });
    marked.into_iter().collect()
}
