//! Many tasks side by side, a thread for as many as are wanted; their order is that of their numbers.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::interrupt::Interrupted;

/// The results of tasks 0 to `count` that could be done, by at most `jobs` threads, each taking the next task.
pub(crate) fn side_by_side<T: Send>(
    count: usize,
    jobs: usize,
    task: impl Fn(usize) -> Result<T, Interrupted> + Sync,
) -> Vec<Option<T>> {
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<Option<T>>> = Mutex::new((0..count).map(|_| None).collect());
    thread::scope(|scope| {
        for _ in 0..jobs.clamp(1, count.max(1)) {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count {
                        return;
                    }
                    let Ok(result) = task(index) else { return };
                    results.lock().unwrap_or_else(PoisonError::into_inner)[index] = Some(result);
                }
            });
        }
    });
    results.into_inner().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_task_is_done_once_whatever_the_number_of_threads() {
        for jobs in [0, 1, 3, 100] {
            let done = side_by_side(20, jobs, |index| Ok(index * index));
            assert!(done.into_iter().enumerate().all(|(index, result)| result == Some(index * index)));
        }
        assert_eq!(side_by_side(0, 4, Ok).len(), 0);
    }

    #[test]
    fn an_interrupted_task_leaves_the_others_results() {
        let done = side_by_side(5, 1, |index| if index < 3 { Ok(index) } else { Err(Interrupted) });
        assert_eq!(done, [Some(0), Some(1), Some(2), None, None]);
    }
}
