//! The terminal while it is ours: raw mode, alternate screen, hidden cursor; and given back on every way out.
//!
//! Every way on which some code of ours still runs: quitting, errors, panics in any thread, signals that can be caught.
//! This care ends where the process is ended without being asked: by SIGKILL, by the system when memory is out, and by Rust
//! itself when an allocation is refused, a stack overflows or a panic meets another (it aborts; to run code there takes
//! `unsafe`). What is known to need more memory than there is is refused before (`scene::size`). After such an end,
//! `reset` puts a terminal right.

use std::{
    fs::{File, OpenOptions},
    io,
    os::{
        fd::BorrowedFd,
        unix::{ffi::OsStrExt, fs::OpenOptionsExt},
    },
    panic::{self, PanicHookInfo},
    path::Path,
    sync::{
        Arc, Mutex, MutexGuard, TryLockError,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

use crossterm::terminal;
use rustix::{
    event::{PollFd, PollFlags, Timespec, poll},
    io::Errno,
    termios::{QueueSelector, tcflush},
};
use signal_hook::consts::SIGCONT;

use super::event::{Event, Post};

/// A terminal that takes nothing for this long while we leave is left as it is: the shell must not wait for it.
const FAREWELL: Duration = Duration::from_millis(150);

/// Alternate screen, pasted text in brackets, no cursor.
const HELLO: &[u8] = b"\x1b[?1049h\x1b[?2004h\x1b[?25l";

/// Undoes what was asked of the terminal, last to first; before that it ends a synchronized update, should we leave in one.
const GOODBYE: &[u8] = b"\x1b[?2026l\x1b[?1006l\x1b[?1002l\x1b[m\x1b[?25h\x1b[?2004l\x1b[?1049l";

/// The screen, shared by every part that may have to give it back: drawing, signals, a panic anywhere.
pub(super) struct Session {
    screen: Mutex<Screen>,
    /// Whether the terminal is ours. Once it is not, nothing is written any more.
    ours: AtomicBool,
    /// Whether the terminal is in raw mode, so that nothing is echoed.
    raw: AtomicBool,
    /// How often the terminal was taken: what was drawn before the last time is for a screen that is no more.
    takes: AtomicU64,
    /// Set where the signal arrives that continues a stopped process: until the terminal is taken again, it is in an
    /// unknown state.
    continued: Arc<AtomicBool>,
}

/// The way to the terminal.
struct Screen {
    file: File,
    /// Whether writing to it returns instead of waiting.
    patient: bool,
}

/// The hook that was there before ours.
type Hook = Arc<dyn Fn(&PanicHookInfo) + Send + Sync>;

/// Gives the terminal back when dropped.
pub(super) struct Guard {
    session: Arc<Session>,
    previous: Hook,
}

impl Session {
    /// Takes the terminal of `stdout` over; from now on a panic in any thread gives it back before it speaks, and is
    /// posted.
    ///
    /// # Errors
    /// If the terminal can't be put into raw mode.
    pub(super) fn start(stdout: BorrowedFd, post: Post) -> io::Result<Guard> {
        let session = Arc::new(Session {
            screen: Mutex::new(Screen::open(stdout)?),
            ours: AtomicBool::new(false),
            raw: AtomicBool::new(false),
            takes: AtomicU64::new(0),
            continued: Arc::new(AtomicBool::new(false)),
        });
        signal_hook::flag::register(SIGCONT, Arc::clone(&session.continued))?;
        let previous: Hook = Arc::from(panic::take_hook());
        let (ours, theirs) = (Arc::clone(&session), Arc::clone(&previous));
        panic::set_hook(Box::new(move |info| {
            ours.give_back();
            theirs(info);
            post.send(Event::Panicked(info.to_string()));
        }));
        let guard = Guard { session, previous };
        guard.session.take()?;
        Ok(guard)
    }

    /// Takes the terminal: raw mode, alternate screen, no cursor; pasted text is marked as such.
    ///
    /// # Errors
    /// If there is no raw mode to be had.
    pub(super) fn take(&self) -> io::Result<()> {
        // The mode remembered by crossterm may be older than what a shell has set since.
        terminal::disable_raw_mode()?;
        terminal::enable_raw_mode()?;
        self.raw.store(true, Ordering::Release);
        let screen = self.lock();
        self.continued.store(false, Ordering::Release);
        self.takes.fetch_add(1, Ordering::AcqRel);
        self.ours.store(true, Ordering::Release);
        Ok(screen.send(HELLO, || self.is_ours()).map(drop)?)
    }

    /// How often the terminal was taken: a picture belongs to the last time.
    pub(super) fn takes(&self) -> u64 {
        self.takes.load(Ordering::Acquire)
    }

    fn is_ours(&self) -> bool {
        self.ours.load(Ordering::Acquire) && !self.continued.load(Ordering::Acquire)
    }

    fn lock(&self) -> MutexGuard<'_, Screen> {
        self.screen.lock().unwrap_or_else(|poison| poison.into_inner())
    }

    /// Undoes [`Session::take`]; does nothing if that is done already. Never waits long, whatever the terminal does.
    pub(super) fn give_back(&self) {
        self.leave_screen(b"");
        if self.raw.swap(false, Ordering::AcqRel) {
            let _ = terminal::disable_raw_mode(); // fails only on a terminal that is gone
        }
    }

    /// Shows what was on the screen before; what the terminal sends is still not echoed. The first half of
    /// [`Session::give_back`]. Whether `first` was sent, too, before the rest.
    pub(super) fn leave_screen(&self, first: &[u8]) -> bool {
        if !self.ours.swap(false, Ordering::AcqRel) {
            return false;
        }
        let deadline = Instant::now() + FAREWELL;
        let Some(screen) = self.lock_until(deadline) else { return false };
        let sent = screen.send(&[first, GOODBYE].concat(), || Instant::now() < deadline) == Ok(true);
        if !sent {
            // It is full of pictures that are not read any more; they are worth less than a usable shell.
            let _ = tcflush(&screen.file, QueueSelector::OFlush);
            let _ = screen.send(GOODBYE, || false);
        }
        sent
    }

    /// Writes all of a picture drawn when the terminal had been taken `takes` times, waiting for the terminal as long as
    /// it is ours; false if it is not (any more), or was taken again: the next picture is a whole one.
    ///
    /// # Errors
    /// If the terminal is gone.
    pub(super) fn write(&self, picture: &[u8], takes: u64) -> io::Result<bool> {
        let screen = self.lock();
        // A picture still in the writer's mailbox while we were stopped would land on the shell's screen, or be taken for
        // a difference to a screen that shows something else now.
        if !self.is_ours() || takes != self.takes() {
            return Ok(false);
        }
        Ok(screen.send(picture, || self.is_ours())?)
    }

    /// Columns and rows as the terminal reports them; 0 where it knows none.
    pub(super) fn size(&self, stdout: BorrowedFd) -> (u16, u16) {
        rustix::termios::tcgetwinsize(stdout).map_or((0, 0), |size| (size.ws_col, size.ws_row))
    }

    /// The way to the terminal, unless another thread holds it too long (the panicking thread itself, perhaps).
    fn lock_until(&self, deadline: Instant) -> Option<MutexGuard<'_, Screen>> {
        loop {
            match self.screen.try_lock() {
                Ok(screen) => return Some(screen),
                Err(TryLockError::Poisoned(poison)) => return Some(poison.into_inner()),
                Err(TryLockError::WouldBlock) if Instant::now() > deadline => return None,
                Err(TryLockError::WouldBlock) => thread::sleep(Duration::from_millis(1)),
            }
        }
    }
}

impl Screen {
    /// Opens the terminal of `stdout` anew, so that writing without waiting concerns no other program that has it open.
    fn open(stdout: BorrowedFd) -> io::Result<Screen> {
        let name = rustix::termios::ttyname(stdout, Vec::new());
        let anew = name.ok().and_then(|name| {
            let path = Path::new(std::ffi::OsStr::from_bytes(name.to_bytes()));
            let flags = rustix::fs::OFlags::NONBLOCK | rustix::fs::OFlags::NOCTTY;
            OpenOptions::new().write(true).custom_flags(flags.bits() as i32).open(path).ok()
        });
        match anew {
            Some(file) => Ok(Screen { file, patient: false }),
            None => Ok(Screen { file: File::from(stdout.try_clone_to_owned()?), patient: true }),
        }
    }

    /// Writes `bytes`, and while the terminal is full tries again as long as `wanted`; whether all was written.
    fn send(&self, bytes: &[u8], wanted: impl Fn() -> bool) -> Result<bool, Errno> {
        // A file that waits is given no more than a terminal surely takes at once.
        let piece = if self.patient { 256 } else { usize::MAX };
        let mut rest = bytes;
        while !rest.is_empty() {
            match rustix::io::write(&self.file, &rest[..rest.len().min(piece)]) {
                Ok(n) => rest = &rest[n..],
                Err(Errno::INTR) => {}
                Err(Errno::AGAIN) => self.wait(),
                Err(gone) => return Err(gone),
            }
            if !rest.is_empty() && !wanted() {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Waits until the terminal takes more, but not long: it may cease to be ours meanwhile.
    fn wait(&self) {
        let some_time = Timespec { tv_sec: 0, tv_nsec: 20_000_000 };
        let _ = poll(&mut [PollFd::new(&self.file, PollFlags::OUT)], Some(&some_time)); // a signal ends it early
    }
}

impl Guard {
    /// The session.
    pub(super) fn session(&self) -> &Arc<Session> {
        &self.session
    }
}

impl Drop for Guard {
    fn drop(&mut self) {
        self.session.give_back();
        if !thread::panicking() {
            let previous = Arc::clone(&self.previous);
            panic::set_hook(Box::new(move |info| previous(info)));
        }
    }
}
