//! What to run on a terminal, and how that can end.

use std::{fmt, io};

use crate::{
    app::Keymap,
    printable,
    recording::Recording,
    scene::{Opened, Settings},
    view::{Colors, Inks, Marker},
};

/// What to run, and how to show it.
#[derive(Debug, Clone)]
pub struct Options {
    /// The scene to begin with.
    pub opened: Opened,
    /// The settings to begin with.
    pub settings: Settings,
    /// The recording that is replayed; none for a scene.
    pub recording: Option<Recording>,
    /// The message to show at first, if any.
    pub message: Option<String>,
    /// Whether to wait at t = 0 instead of running.
    pub paused: bool,
    /// Whether to go to the first collision, and wait there with its card open.
    pub taken_apart: bool,
    /// Dots or characters; `None`: as the locale says.
    pub marker: Option<Marker>,
    /// Depth of colour; `None`: as the environment says.
    pub color: Option<Colors>,
    /// Most bytes per second to the terminal; `None`: as many as it takes.
    pub bandwidth: Option<u64>,
    /// Most pictures per second of a running run, above 0.
    pub frame_rate: u32,
    /// The user's own colours.
    pub inks: Inks,
    /// Which key does what.
    pub keymap: Keymap,
}

/// How the application ended, with the terminal as it was before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The user quit.
    Quit,
    /// A signal ended the program; the terminal's own end counts as SIGHUP. The exit code is 128 plus its number.
    Signal(i32),
}

/// Why the application could not run, or not on; the terminal is as it was before.
#[derive(Debug)]
pub enum Error {
    /// Standard output is no terminal: wrong usage.
    NoTerminal,
    /// The terminal or the system failed us.
    Io(io::Error),
    /// A thread panicked, with this text.
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
