//! Known results of physics and mathematics, measured on this machine.
//!
//! No expected value is an earlier result of ours, except for the golden hashes. Statistical rows have fixed seeds:
//! what passes on one machine passes on all. Time is never part of a result. Begin with `bounces`.
//!
//! | file | owns |
//! |---|---|
//! | `check` | a family of results, and what became of it |
//! | `runner` | how thoroughly, how a run is advanced, what a row is |
//! | `bodies` | scenes built in code |
//! | `statistics` | means, standard errors, slopes |
//! | `table` | the results as text |
//! | the rest | one family of results each |

mod bodies;
mod bounces;
mod chains;
mod check;
mod cooling;
mod gas;
mod golden;
mod joints;
mod mixture;
mod photon;
mod pressure;
mod rest;
mod reversal;
mod runner;
mod statistics;
mod steps;
pub mod table;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

pub use check::{Check, Outcome};
pub use golden::{GOLDEN, Golden};
pub use runner::{Depth, Row, Runner, Trouble};

/// Every family, in the order in which they are told.
pub const CHECKS: &[Check] = &[
    bounces::CHECK,
    bounces::RUBBED,
    chains::DIGITS,
    chains::SQUEEZE,
    chains::CRADLE,
    pressure::CHECK,
    cooling::CHECK,
    mixture::CHECK,
    steps::DT,
    steps::TOLERANCE,
    steps::TUNNELLING,
    reversal::CHECK,
    photon::CHECK,
    rest::CHECK,
    joints::RIDGE,
    joints::TILES,
    joints::FUNNEL,
    golden::CHECK,
];

/// Measures every check on so many threads, and tells each outcome as soon as it is there, in any order.
pub fn verify(runner: Runner, threads: usize, mut tell: impl FnMut(Outcome)) {
    let (next, (outcomes, inbox)) = (AtomicUsize::new(0), mpsc::channel());
    thread::scope(|scope| {
        for _ in 0..threads.clamp(1, CHECKS.len()) {
            let (next, outcomes) = (&next, outcomes.clone());
            scope.spawn(move || {
                while let Some((index, check)) = claim(next) {
                    // The receiver has gone: there is nothing left to do.
                    if outcomes.send((index, check.rows(&runner))).is_err() {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::law_fault::with_restitution_times;

    /// Titles of the checks that fail under a law of that restitution, but for `left_out`.
    fn failing(pairs: f64, walls: f64, left_out: &[&str]) -> Vec<&'static str> {
        let runner = Runner::new(Depth::Quick, &|| true);
        let fails = |check: &&Check| check.rows(&runner).map_or(true, |rows| !rows.iter().all(Row::passes));
        let checks = CHECKS.iter().filter(|check| !left_out.contains(&check.title));
        with_restitution_times(pairs, walls, || checks.filter(fails).map(|check| check.title).collect())
    }

    /// What takes most of the time; `verify --quick` itself is a test of its own.
    const GASES: [&str; 3] = ["hard spheres", "Haff's law", "equipartition"];

    #[test]
    fn under_the_right_law_every_check_has_rows_that_pass_and_names_that_fit() {
        let runner = Runner::new(Depth::Quick, &|| true);
        for check in CHECKS.iter().filter(|check| !GASES.contains(&check.title)) {
            let rows = check.rows(&runner).expect("a result");
            let fine = |row: &Row| row.passes() && row.what.chars().count() <= 28;
            assert!(!rows.is_empty() && rows.iter().all(fine), "{rows:?}");
        }
    }

    #[test]
    fn whatever_pairs_decide_fails_if_they_lose_a_hundredth_more() {
        // In neither scene of the time reversal do spheres meet before it turns.
        let expected = [
            "Galperin's billiard",
            "squeeze",
            "Newton's cradle",
            "hard spheres",
            "Haff's law",
            "photon",
            "golden hashes",
        ];
        assert_eq!(failing(0.99, 1.0, &["equipartition"]), expected);
    }

    #[test]
    fn whatever_walls_decide_fails_if_they_take_a_hundredth_more() {
        let expected = [
            "bouncing ball",
            "rubbing ball",
            "Galperin's billiard",
            "squeeze",
            "order in the tolerance",
            "time reversal",
            "golden hashes",
        ];
        assert_eq!(failing(1.0, 0.99, &GASES), expected);
    }

    #[test]
    fn who_is_told_not_to_go_on_has_no_result() {
        let runner = Runner::new(Depth::Quick, &|| false);
        let mut told = Vec::new();
        verify(runner, 2, |(index, outcome)| told.push((index, outcome == Err(Trouble::Interrupted))));
        told.sort_unstable();
        assert_eq!(told, (0..CHECKS.len()).map(|index| (index, true)).collect::<Vec<_>>());
    }
}
