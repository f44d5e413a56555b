//! The one slot between a thread and its reader.

use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicBool, Ordering},
};

use super::message::Notify;

/// Holds the latest piece of news; the writer never waits for the reader.
pub(super) struct Slot<T> {
    latest: Mutex<Arc<T>>,
    fresh: AtomicBool,
    notify: Notify,
}

impl<T> Slot<T> {
    /// A slot with a first piece, of which the reader is not told.
    pub(super) fn new(first: T, notify: Notify) -> Slot<T> {
        Slot { latest: Mutex::new(Arc::new(first)), fresh: AtomicBool::new(false), notify }
    }

    /// Puts a piece over whatever lies there, and tells the reader if it has taken the one before.
    pub(super) fn put(&self, piece: T) {
        *self.latest.lock().unwrap_or_else(PoisonError::into_inner) = Arc::new(piece);
        if !self.fresh.swap(true, Ordering::AcqRel) {
            (self.notify)();
        }
    }

    /// The latest piece; the next one is told of again.
    pub(super) fn take(&self) -> Arc<T> {
        self.fresh.store(false, Ordering::Release);
        Arc::clone(&self.latest.lock().unwrap_or_else(PoisonError::into_inner))
    }
}
