//! Signals outside the TUI: INT, TERM and HUP end a command with 128 + n, after it has put away what it had begun.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::thread;
use std::time::Duration;

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals as Arrivals;

use super::failure::Failure;
use crate::terminal::not_ignored;

/// How long a command may take to notice a signal and remove its unfinished files, before the process ends without
/// it (blocked on a pipe that is not read, say). Longer keeps the user waiting; a slice of work takes some 10 ms.
const GRACE: Duration = Duration::from_millis(500);

/// The signal that has arrived, if any.
#[derive(Debug, Clone, Default)]
pub(super) struct Signals {
    arrived: Arc<AtomicU8>,
}

impl Signals {
    /// Watches from here on for every signal that the parent has not told us to ignore (nohup, background jobs).
    pub(super) fn watch() -> Result<Signals, Failure> {
        let mut arrivals = Arrivals::new(not_ignored(&[SIGINT, SIGTERM, SIGHUP]))?;
        let signals = Signals::default();
        let arrived = Arc::clone(&signals.arrived);
        thread::Builder::new().name("signals".into()).spawn(move || {
            let first = arrivals.forever().find_map(|signal| u8::try_from(signal).ok());
            if let Some(number) = first {
                arrived.store(number, Ordering::Relaxed);
                thread::sleep(GRACE);
                std::process::exit(128 + i32::from(number));
            }
        })?;
        Ok(signals)
    }

    /// An error as soon as a signal has arrived: called between slices of work.
    pub(super) fn check(&self) -> Result<(), Failure> {
        match self.arrived.load(Ordering::Relaxed) {
            0 => Ok(()),
            number => Err(Failure::Signal(number)),
        }
    }
}
