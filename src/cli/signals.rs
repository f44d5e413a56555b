//! Signals outside the TUI: INT, TERM and HUP end a command with 128 + n, after it has put away what it had begun.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::thread;
use std::time::Duration;

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals as Arrivals;

use super::failure::Failure;

/// How long a command may take to notice a signal and remove its unfinished files, before the process ends without
/// it (blocked on a pipe that nobody empties, say). Longer keeps the user waiting; a slice of work takes some 10 ms.
const GRACE: Duration = Duration::from_millis(500);

/// The signal that has arrived, if any.
#[derive(Debug, Clone, Default)]
pub(super) struct Signals {
    arrived: Arc<AtomicU8>,
}

impl Signals {
    /// Watches from here on for every signal that the parent has not told us to ignore (nohup, background jobs).
    pub(super) fn watch() -> Result<Signals, Failure> {
        let ignored = ignored();
        let wanted = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
        let mut arrivals = Arrivals::new(wanted.collect::<Vec<_>>())?;
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

/// Bit n − 1 is set if signal n is ignored. Where /proc does not tell, none is.
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|digits| u64::from_str_radix(digits.trim(), 16).ok()).unwrap_or(0)
}
