//! Events that the other threads send to the one that draws.

use std::sync::mpsc::Sender;

use crate::app::Input;

/// An event for the thread that draws.
#[derive(Debug)]
pub(super) enum Event {
    /// A key was pressed or text pasted.
    Typed(Input),
    /// Ctrl-C was pressed and waits for nothing; see [`Backlog::interrupted`](super::backlog::Backlog::interrupted).
    Interrupted,
    /// The terminal has answered; see [`Backlog::replies`](super::backlog::Backlog::replies).
    Replied,
    /// The application's worker has news.
    News,
    Resized,
    /// The system has taken the last picture.
    Sent,
    Suspend,
    Continued,
    /// A signal to end.
    End(i32),
    /// The terminal is gone.
    Gone,
    /// A thread panicked, with this text.
    Panicked(String),
}

/// The way to the thread that draws.
#[derive(Debug, Clone)]
pub(super) struct Post(pub(super) Sender<Event>);

impl Post {
    pub(super) fn send(&self, event: Event) {
        let _ = self.0.send(event); // nothing reads any more: the program is ending
    }
}
