//! Sends pictures on a thread of its own, so that a terminal that takes nothing stops no other thread.

use std::{
    sync::{
        Arc,
        mpsc::{self, SyncSender},
    },
    thread,
};

use super::{
    event::{Event, Post},
    session::Session,
};

/// The sending end: one picture on its way at a time.
pub(super) struct Writer {
    mailbox: SyncSender<(Vec<u8>, u64)>,
}

impl Writer {
    /// Starts the thread. After each picture it posts [`Event::Sent`]; when the terminal is gone, [`Event::Gone`].
    ///
    /// # Errors
    /// If the system has no thread to give.
    pub(super) fn start(session: Arc<Session>, post: Post) -> std::io::Result<Writer> {
        let (mailbox, pictures) = mpsc::sync_channel::<(Vec<u8>, u64)>(1);
        thread::Builder::new().name("terminal output".into()).spawn(move || {
            for (picture, takes) in pictures {
                post.send(if session.write(&picture, takes).is_ok() { Event::Sent } else { Event::Gone });
            }
        })?;
        Ok(Writer { mailbox })
    }

    /// Sends a picture drawn when the terminal had been taken `takes` times. Only after the one before was
    /// [`Event::Sent`]; otherwise it is dropped.
    pub(super) fn send(&self, picture: Vec<u8>, takes: u64) {
        let _ = self.mailbox.try_send((picture, takes)); // the thread ends only after it has posted that the terminal is gone
    }
}
