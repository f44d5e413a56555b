//! Standard input line by line, on a thread of its own, so that nothing else waits for it.

use std::io::{self, BufRead, IsTerminal, Read};
use std::sync::mpsc::Sender;
use std::thread;

use crate::printable;

/// Longest line, bytes; what is longer comes in pieces.
const LONGEST: u64 = 4096;

/// Whether a user sits at standard input: a terminal whose foreground is ours, so that reading it stops nothing.
pub(super) fn are_typed() -> bool {
    let stdin = io::stdin();
    let ours = rustix::termios::tcgetpgrp(&stdin).is_ok_and(|group| group == rustix::process::getpgrp());
    stdin.is_terminal() && ours
}

/// Sends every line as `event` makes it of its text, without what cannot be printed; `None` at the end.
///
/// # Errors
/// If the system has no thread to give.
pub(super) fn start<T: Send + 'static>(sender: Sender<T>, event: fn(Option<String>) -> T) -> io::Result<()> {
    thread::Builder::new().name("lines".into()).spawn(move || {
        let mut stdin = io::stdin().lock();
        loop {
            let mut line = Vec::new();
            let read = stdin.by_ref().take(LONGEST).read_until(b'\n', &mut line);
            let text: String = String::from_utf8_lossy(&line).chars().filter(|c| printable::is_printable(*c)).collect();
            let end = !matches!(read, Ok(1..));
            if sender.send(event((!end).then_some(text))).is_err() || end {
                return;
            }
        }
    })?;
    Ok(())
}
