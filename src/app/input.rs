//! What the application starts with, what reaches it, and what it asks for in turn.

use std::path::PathBuf;

use super::{keymap::Keymap, keys::Key, mouse::Mouse};
use crate::{
    recording::Recording,
    scene::{Opened, Settings},
    view::{Colors, Inks, Marker},
};

/// What the application starts with.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The first scene.
    pub opened: Opened,
    /// The settings to begin with.
    pub settings: Settings,
    /// Whether to wait at t = 0 instead of running.
    pub paused: bool,
    /// Whether to go to the first collision, and wait there with its card open.
    pub taken_apart: bool,
    /// Dots or characters.
    pub marker: Marker,
    /// Depth of colour.
    pub colors: Colors,
    /// The user's own colours.
    pub inks: Inks,
    /// Which key does what.
    pub keymap: Keymap,
    /// The recording that is replayed, with its own settings; none for a scene.
    pub recording: Option<Recording>,
    /// Where files are written.
    pub folder: PathBuf,
}

/// What reaches the application from outside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Input {
    /// A key was pressed.
    Key(Key),
    /// The mouse was used.
    Mouse(Mouse),
    /// Text was pasted: taken where text is typed, and nowhere else.
    Paste(String),
    /// The worker has called `notify`.
    News,
}

/// What an input asks of the program that owns the screen.
#[derive(Debug, Clone, PartialEq, Eq)]
#[must_use]
pub enum Effect {
    /// Nothing.
    Nothing,
    /// Draw when it is time for the next picture.
    Draw,
    /// Draw at once: the user waits for an answer.
    DrawNow,
    /// Draw everything again, whatever is on the screen.
    Repaint,
    /// Give the terminal back to the shell for a while.
    Suspend,
    /// End.
    Quit,
    /// End: the simulation's thread has panicked, with this text.
    Fail(String),
}
