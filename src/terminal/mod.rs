//! Drives the application on a real terminal. The only place that names crossterm.
//!
//! Threads: this one obeys inputs and draws; `input` reads the terminal; `signals` waits for signals; `writer` sends
//! pictures; the application's worker simulates. All of them post events to this one and wait for nobody.

mod backlog;
mod decoder;
mod detect;
mod drive;
mod input;
mod pacer;
mod paste;
mod sequence;
mod session;
mod signals;
mod writer;

use std::{fmt, io, sync::mpsc::Sender};

pub use drive::run;
pub(crate) use signals::not_ignored;

use crate::{
    app::Input,
    printable,
    scene::{Opened, Settings},
    view::{Colors, Marker},
};

/// What to run, and how to show it.
#[derive(Debug, Clone)]
pub struct Options {
    /// The scene to begin with.
    pub opened: Opened,
    /// What to solve it with.
    pub settings: Settings,
    /// What to say at first, if anything.
    pub message: Option<String>,
    /// Wait at t = 0 instead of running.
    pub paused: bool,
    /// Dots or characters; `None`: as the locale says.
    pub marker: Option<Marker>,
    /// Depth of colour; `None`: as the environment says.
    pub color: Option<Colors>,
}

/// How the application ended, with the terminal as it was before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The user quit.
    Quit,
    /// By this signal; the terminal's own end counts as SIGHUP. The exit code is 128 + it.
    Signal(i32),
}

/// Why it could not run, or not on; the terminal is as it was before.
#[derive(Debug)]
pub enum Error {
    /// Standard output is no terminal: wrong usage.
    NoTerminal,
    /// The terminal or the system failed us.
    Io(io::Error),
    /// A thread panicked and said this.
    Panic(String),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Error::NoTerminal => {
                write!(f, "standard output is not a terminal; use carom run, carom render or --text instead")
            }
            Error::Io(error) => write!(f, "the terminal cannot be used: {}", printable::cause(error)),
            Error::Panic(said) => write!(f, "carom has made a mistake and cannot go on: {said}"),
        }
    }
}

impl std::error::Error for Error {}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Error {
        Error::Io(error)
    }
}

/// What the threads tell the one that draws.
#[derive(Debug)]
enum Event {
    /// A key was pressed or text pasted.
    Typed(Input),
    /// Ctrl-C was pressed; see [`backlog::Backlog::interrupted`].
    Interrupted,
    /// The application's worker has news.
    News,
    Resized,
    /// The terminal has taken the last picture.
    Sent,
    Suspend,
    Continued,
    /// A signal to end.
    End(i32),
    /// The terminal is gone.
    Gone,
    /// A thread panicked, and this is what is known about it.
    Panicked(String),
}

/// The way to the thread that draws.
#[derive(Debug, Clone)]
struct Post(Sender<Event>);

impl Post {
    fn send(&self, event: Event) {
        let _ = self.0.send(event); // nobody reads any more: the program is ending
    }
}
