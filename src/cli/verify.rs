//! `carom verify`: known results of physics and mathematics, measured here; rows go out as they are found.

use std::io::Write;
use std::num::NonZero;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use indicatif::ProgressBar;

use super::arguments::Verify;
use super::failure::Failure;
use super::output::Output;
use super::progress;
use super::signals::Signals;
use crate::measure::verify::{self, CHECKS, Depth, Outcome, Row, Runner, Trouble, table};

pub(super) fn verify(arguments: &Verify, signals: &Signals) -> Result<(), Failure> {
    let depth = if arguments.quick { Depth::Quick } else { Depth::Whole };
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    let read = AtomicBool::new(true);
    let go_on = || signals.check().is_ok() && read.load(Ordering::Relaxed);
    let mut book = Book::open()?;
    let mut told = Ok(());
    verify::verify(Runner::new(depth, &go_on), threads, |outcome| {
        if go_on() {
            told = book.enter(outcome);
            read.store(told.is_ok(), Ordering::Relaxed);
        }
    });
    book.bar.finish_and_clear();
    signals.check()?;
    told?;
    book.close()
}

/// The table under way: what is found early waits for what stands above it.
struct Book {
    out: Output,
    bar: ProgressBar,
    waiting: Vec<Option<Outcome>>,
    next: usize,
    tally: Tally,
}

impl Book {
    fn open() -> Result<Book, Failure> {
        let mut out = Output::stdout();
        out.write_all(table::head().as_bytes())?;
        out.flush()?;
        let waiting = CHECKS.iter().map(|_| None).collect();
        let bar = progress::bar(CHECKS.len() as u64, "{bar:32} {pos} of {len} checks, {elapsed} elapsed");
        if !bar.is_hidden() {
            bar.tick();
        }
        Ok(Book { out, bar, waiting, next: 0, tally: Tally::default() })
    }

    fn enter(&mut self, outcome: Outcome) -> Result<(), Failure> {
        let index = outcome.0;
        self.waiting[index] = Some(outcome);
        self.bar.inc(1);
        let Book { out, bar, waiting, next, tally } = self;
        bar.suspend(|| {
            while let Some((index, found)) = waiting.get_mut(*next).and_then(Option::take) {
                tally.count(&found);
                out.write_all(text(index, &found).as_bytes())?;
                *next += 1;
            }
            out.flush()
        })?;
        Ok(())
    }

    fn close(mut self) -> Result<(), Failure> {
        self.out.write_all(table::notes(CHECKS).as_bytes())?;
        self.out.finish()?;
        self.tally.verdict()
    }
}

fn text(index: usize, found: &Result<Vec<Row>, Trouble>) -> String {
    match found {
        Ok(rows) => table::rows(index + 1, rows),
        Err(trouble) => table::failure(index + 1, &CHECKS[index], &trouble.to_string()),
    }
}

/// Numbers of rows and of those that fail. A check without a result is a row that fails.
#[derive(Debug, Default)]
struct Tally {
    rows: usize,
    failed: usize,
}

impl Tally {
    fn count(&mut self, found: &Result<Vec<Row>, Trouble>) {
        let (rows, failed) = found.as_ref().map_or((1, 1), |rows| {
            let failed = rows.iter().filter(|row| !row.passes());
            (rows.len(), failed.count())
        });
        self.rows += rows;
        self.failed += failed;
    }

    fn verdict(&self) -> Result<(), Failure> {
        match self {
            Tally { failed: 0, .. } => Ok(()),
            Tally { failed: 1, rows } => {
                Err(Failure::Failed(format!("1 of {rows} known results is not met: see FAIL")))
            }
            Tally { failed, rows } => {
                Err(Failure::Failed(format!("{failed} of {rows} known results are not met: see FAIL")))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_that_fails_or_is_missing_fails_the_command() {
        let row = |found| Row { what: "one".into(), unit: "", expected: 1.0, found, allowed: 0.5 };
        let verdict = |found| {
            let mut tally = Tally::default();
            tally.count(&found);
            tally.verdict().map_err(|failure| format!("{failure:?}"))
        };
        assert_eq!(verdict(Ok(vec![row(1.0), row(1.5)])), Ok(()));
        let failed = verdict(Ok(vec![row(1.0), row(1.6)]));
        assert!(failed.is_err_and(|told| told.contains("1 of 2 known results is not met")));
        let nothing = verdict(Ok(vec![row(f64::NAN), row(2.0)]));
        assert!(nothing.is_err_and(|told| told.contains("2 of 2 known results are not met")));
        assert!(verdict(Err(Trouble::Failed("It stalled.".into()))).is_err());
    }
}
