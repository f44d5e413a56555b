//! `carom verify`: known results of physics and mathematics, measured here; rows go out as they are found.

use std::io::{self, IsTerminal, Write};
use std::num::NonZero;
use std::thread;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::arguments::Verify;
use super::failure::Failure;
use super::output::Output;
use super::signals::Signals;
use crate::measure::verify::{self, CHECKS, Depth, Lab, Outcome, Row, table};

pub(super) fn verify(arguments: &Verify, signals: &Signals) -> Result<(), Failure> {
    let depth = if arguments.quick { Depth::Quick } else { Depth::Whole };
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    let go_on = || signals.check().is_ok();
    let mut book = Book::open()?;
    let mut told = Ok(());
    verify::verify(Lab::new(depth, &go_on), threads, |outcome| {
        if told.is_ok() && go_on() {
            told = book.enter(outcome);
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
    rows: usize,
    failed: usize,
}

impl Book {
    fn open() -> Result<Book, Failure> {
        let mut out = Output::stdout();
        out.write_all(table::head().as_bytes())?;
        out.flush()?;
        let waiting = CHECKS.iter().map(|_| None).collect();
        Ok(Book { out, bar: progress_bar(), waiting, next: 0, rows: 0, failed: 0 })
    }

    fn enter(&mut self, outcome: Outcome) -> Result<(), Failure> {
        let index = outcome.0;
        self.waiting[index] = Some(outcome);
        self.bar.inc(1);
        let Book { out, bar, waiting, next, rows, failed } = self;
        bar.suspend(|| {
            while let Some((index, found)) = waiting.get_mut(*next).and_then(Option::take) {
                let text = match found {
                    Ok(found) => {
                        *rows += found.len();
                        *failed += found.iter().filter(|row: &&Row| !row.passes()).count();
                        table::rows(index + 1, &found)
                    }
                    Err(trouble) => {
                        *rows += 1;
                        *failed += 1;
                        table::failure(index + 1, &CHECKS[index], &trouble.to_string())
                    }
                };
                *next += 1;
                out.write_all(text.as_bytes())?;
            }
            out.flush()
        })?;
        Ok(())
    }

    fn close(mut self) -> Result<(), Failure> {
        self.out.write_all(table::notes(CHECKS).as_bytes())?;
        self.out.finish()?;
        match self.failed {
            0 => Ok(()),
            failed => Err(Failure::Failed(format!("{failed} of {} known results are not met; see FAIL", self.rows))),
        }
    }
}

/// On stderr, and only if somebody watches: indicatif draws nothing where it is no terminal.
fn progress_bar() -> ProgressBar {
    let dumb = std::env::var_os("TERM").is_none_or(|term| term == "dumb");
    if dumb || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:32} {pos} of {len} checks, {elapsed} elapsed");
    let bar = ProgressBar::with_draw_target(Some(CHECKS.len() as u64), ProgressDrawTarget::stderr());
    let bar = style.map(|style| bar.clone().with_style(style)).unwrap_or(bar);
    bar.tick();
    bar
}
