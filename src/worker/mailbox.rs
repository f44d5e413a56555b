//! A channel that holds one value: the sender never waits and replaces a value that has not been read, so that a reader
//! that gets little of the processor costs the memory of one value and no more.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// The two ends of a new, empty mailbox.
pub(super) fn mailbox<T>() -> (Sender<T>, Reader<T>) {
    let shared = Arc::new(Shared { content: Mutex::new(Content { value: None, open: true }), changed: Condvar::new() });
    (Sender(Arc::clone(&shared)), Reader(shared))
}

/// The sending end. Dropping it closes the mailbox.
pub(super) struct Sender<T>(Arc<Shared<T>>);

/// The reading end.
pub(super) struct Reader<T>(Arc<Shared<T>>);

/// The error of a mailbox whose sender is gone; a value that it may have left is dropped.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Closed;

struct Shared<T> {
    content: Mutex<Content<T>>,
    changed: Condvar,
}

struct Content<T> {
    value: Option<T>,
    open: bool,
}

impl<T> Sender<T> {
    /// Puts a value in place of the one that waits, if one does.
    pub(super) fn put(&self, value: T) {
        let replaced = self.0.lock().value.replace(value);
        self.0.changed.notify_one();
        drop(replaced); // without the lock: a large value takes its time
    }
}

impl<T> Drop for Sender<T> {
    fn drop(&mut self) {
        self.0.lock().open = false;
        self.0.changed.notify_one();
    }
}

impl<T> Reader<T> {
    /// The value, if one waits.
    ///
    /// # Errors
    /// If the sender is gone.
    pub(super) fn look(&self) -> Result<Option<T>, Closed> {
        let mut content = self.0.lock();
        if content.open { Ok(content.value.take()) } else { Err(Closed) }
    }

    /// Waits for a value.
    ///
    /// # Errors
    /// If the sender is gone.
    pub(super) fn wait(&self) -> Result<T, Closed> {
        let content = self.0.lock();
        let empty = |content: &mut Content<T>| content.open && content.value.is_none();
        let mut content = self.0.changed.wait_while(content, empty).unwrap_or_else(PoisonError::into_inner);
        content.value.take().filter(|_| content.open).ok_or(Closed)
    }
}

impl<T> Shared<T> {
    fn lock(&self) -> MutexGuard<'_, Content<T>> {
        self.content.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reader_that_never_reads_costs_one_value() {
        let (sender, reader) = mailbox();
        let value = Arc::new(());
        for _ in 0..100_000 {
            sender.put(Arc::clone(&value));
        }
        assert_eq!(Arc::strong_count(&value), 2, "ours and the one in the mailbox");
        assert!(reader.look().is_ok_and(|value| value.is_some()));
        assert_eq!(Arc::strong_count(&value), 1);
    }

    #[test]
    fn the_newest_letter_is_read_once_and_none_after_the_sender_has_gone() {
        let (sender, reader) = mailbox();
        assert_eq!(reader.look(), Ok(None));
        sender.put(1);
        sender.put(2);
        assert_eq!(reader.look(), Ok(Some(2)));
        assert_eq!(reader.look(), Ok(None));
        sender.put(3);
        drop(sender);
        assert_eq!(reader.look(), Err(Closed));
        assert_eq!(reader.wait(), Err(Closed));
    }

    #[test]
    fn a_waiting_reader_wakes_for_a_letter_and_for_the_end() {
        let (sender, reader) = mailbox();
        let (told, read) = std::sync::mpsc::channel();
        let thread = std::thread::spawn(move || {
            while let Ok(value) = reader.wait() {
                told.send(value).expect("the test reads");
            }
        });
        sender.put('a');
        assert_eq!(read.recv(), Ok('a'));
        sender.put('b');
        assert_eq!(read.recv(), Ok('b'));
        drop(sender);
        thread.join().expect("it ends");
    }
}
