//! Many files side by side, a thread for as many as there are processors; their order is that of the command line.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use super::exam::{Mark, NoMark};

/// A file and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Marked {
    /// Its name, printable.
    pub name: String,
    /// Its mark, or why there is none: `line: what is wrong there`.
    pub mark: Result<Mark, String>,
}

/// Marks files 0 to `count` by at most so many threads; none if one was interrupted.
pub fn side_by_side(
    count: usize,
    jobs: usize,
    mark: impl Fn(usize) -> (String, Result<Mark, NoMark>) + Sync,
) -> Option<Vec<Marked>> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, Marked)>> = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..jobs.clamp(1, count.max(1)) {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count {
                        return;
                    }
                    let (name, mark) = mark(index);
                    let mark = match mark {
                        Ok(mark) => Ok(mark),
                        Err(NoMark::Unreadable(error)) => Err(error.to_string()),
                        Err(NoMark::Interrupted) => return,
                    };
                    done.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push((index, Marked { name, mark }));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    done.sort_by_key(|(index, _)| *index);
    (done.len() == count).then(|| done.into_iter().map(|(_, marked)| marked).collect())
}
