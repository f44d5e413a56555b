//! Known results of physics and mathematics, measured on this machine.
//!
//! No expected value is an earlier result of ours, except for the golden hashes. Statistical rows have fixed seeds:
//! what passes on one machine passes on all. Time is never part of a result.
//!
//! | file | owns |
//! |---|---|
//! | `lab` | how thoroughly, how a run is advanced, what a row is |
//! | `bodies` | scenes built in code |
//! | `statistics` | means, standard errors, slopes |
//! | `table` | the results as text |
//! | the rest | one family of results each |

mod bodies;
mod bounces;
mod chains;
mod cooling;
mod gas;
mod golden;
mod lab;
mod mixture;
mod pressure;
mod rest;
mod reversal;
mod statistics;
mod steps;
pub mod table;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

pub use golden::{GOLDEN, Golden};
pub use lab::{Depth, Lab, Row, Trouble};

/// A family of known results that are measured together.
#[derive(Debug, Clone, Copy)]
pub struct Check {
    /// What it is about, in two or three words.
    pub title: &'static str,
    /// What is expected, and who says so.
    pub source: &'static str,
    /// Why an error of that size is allowed.
    pub allowed: &'static str,
    measure: fn(&Lab) -> Result<Vec<Row>, Trouble>,
}

/// Every family, in the order in which they are told.
pub const CHECKS: &[Check] = &[
    bounces::CHECK,
    chains::DIGITS,
    chains::CRADLE,
    pressure::CHECK,
    cooling::CHECK,
    mixture::CHECK,
    steps::DT,
    steps::TOLERANCE,
    steps::TUNNELLING,
    reversal::CHECK,
    rest::CHECK,
    golden::CHECK,
];

impl Check {
    /// Measures its rows; never empty.
    ///
    /// # Errors
    /// If a run stalls, or the lab is not to go on.
    pub fn rows(&self, lab: &Lab) -> Result<Vec<Row>, Trouble> {
        (self.measure)(lab)
    }
}

/// What became of a check: its place in [`CHECKS`], and its rows or why there are none.
pub type Outcome = (usize, Result<Vec<Row>, Trouble>);

/// Measures every check on so many threads, and tells each outcome as soon as it is there, in any order.
pub fn verify(lab: Lab, threads: usize, mut tell: impl FnMut(Outcome)) {
    let (next, (outcomes, inbox)) = (AtomicUsize::new(0), mpsc::channel());
    thread::scope(|scope| {
        for _ in 0..threads.clamp(1, CHECKS.len()) {
            let (next, outcomes) = (&next, outcomes.clone());
            scope.spawn(move || {
                while let Some((index, check)) = claim(next) {
                    // Nobody listens any more: the reader has gone, and so may we.
                    if outcomes.send((index, check.rows(&lab))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(outcomes);
        inbox.into_iter().for_each(&mut tell);
    });
}

fn claim(next: &AtomicUsize) -> Option<(usize, &'static Check)> {
    let index = next.fetch_add(1, Ordering::Relaxed);
    CHECKS.get(index).map(|check| (index, check))
}
