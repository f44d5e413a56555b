//! Signals as events, and stopping in a way that the shell can undo.

use std::{io, sync::Arc, thread, time::Duration};

use rustix::process::{Signal, getpgrp, getppid, getsid, kill_current_process_group};
use signal_hook::{
    consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGWINCH},
    iterator::Signals,
};

use super::{
    event::{Event, Post},
    session::Session,
};

/// Time to leave in good order after a signal to end; then the process ends as it is.
const GRACE: Duration = Duration::from_millis(500);

/// Starts the thread that turns signals into events.
///
/// # Errors
/// If the system refuses a handler or the thread.
pub(super) fn start(session: Arc<Session>, post: Post) -> io::Result<()> {
    let mut wanted = not_ignored(&[SIGTERM, SIGINT, SIGHUP, SIGQUIT]);
    wanted.extend([SIGTSTP, SIGCONT, SIGWINCH]);
    let mut signals = Signals::new(wanted)?;
    thread::Builder::new().name("signals".into()).spawn(move || {
        for signal in signals.forever() {
            match signal {
                SIGWINCH => post.send(Event::Resized),
                SIGTSTP => post.send(Event::Suspend),
                SIGCONT => post.send(Event::Continued),
                end => {
                    post.send(Event::End(end));
                    // The thread that draws may be stuck. If not, this one dies with the process.
                    thread::sleep(GRACE);
                    session.give_back();
                    std::process::exit(128 + end);
                }
            }
        }
    })?;
    Ok(())
}

/// The signals that our parent has not told us to ignore (nohup, background jobs): what is ignored stays so, with a screen
/// and without. Where /proc does not tell, all of them.
pub(crate) fn not_ignored(signals: &[i32]) -> Vec<i32> {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|digits| u64::from_str_radix(digits.trim(), 16).ok()).unwrap_or(0);
    signals.iter().copied().filter(|signal| mask >> (signal - 1) & 1 == 0).collect()
}

/// Whether a shell is there that could continue us after a stop: it leads our session and our group is a job of its.
/// Under `ssh -t host carom` our group is the session's own, and a stop would be for ever.
pub(super) fn a_shell_could_continue_us() -> bool {
    let (Ok(session), Some(parent)) = (getsid(None), getppid()) else { return false };
    getpgrp() != session && getsid(Some(parent)) == Ok(session)
}

/// Stops our process group; returns when it is continued.
///
/// # Errors
/// If the system refuses.
pub(super) fn stop() -> io::Result<()> {
    Ok(kill_current_process_group(Signal::STOP)?)
}
