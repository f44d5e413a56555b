//! A thread for what takes long and may be overtaken: of what was asked for meanwhile only the newest is done.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::mpsc::{self, Receiver},
    thread,
};

use super::{
    mailbox::{Sender, mailbox},
    message::Notify,
};

/// The thread, seen from the one that asks. Dropping it ends the thread after the errand under way.
pub struct Errands {
    wanted: Sender<Box<dyn FnOnce() + Send>>,
    notify: Notify,
}

impl Errands {
    /// Starts the thread, which calls `notify` after each errand.
    ///
    /// # Errors
    /// If the system has no thread to give.
    pub fn start(notify: Notify) -> std::io::Result<Errands> {
        let (wanted, inbox) = mailbox::<Box<dyn FnOnce() + Send>>();
        thread::Builder::new().name("errands".into()).spawn(move || {
            while let Ok(errand) = inbox.wait() {
                errand();
            }
        })?;
        Ok(Errands { wanted, notify })
    }

    /// Has `errand` done once the one under way is, in place of any other that waits. Its result arrives before
    /// `notify` is called; if it panics or is replaced, the sending end is dropped instead.
    pub fn ask<T: Send + 'static>(&self, errand: impl FnOnce() -> T + Send + 'static) -> Receiver<T> {
        let (done, result) = mpsc::sync_channel(1);
        let notify = self.notify.clone();
        self.wanted.put(Box::new(move || {
            // The errand owns all it has touched, so nothing half done is left.
            if let Ok(found) = catch_unwind(AssertUnwindSafe(errand)) {
                let _ = done.send(found); // not waited for any more
            }
            drop(done);
            notify();
        }));
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    };

    #[test]
    fn of_many_errands_the_one_under_way_and_the_newest_are_done() {
        let (told, news) = mpsc::channel();
        let errands = Errands::start(Arc::new(move || told.send(()).expect("the test listens"))).expect("a thread");
        let done = Arc::new(AtomicUsize::new(0));
        let (begun, begins) = mpsc::channel();
        let (let_go, wait) = mpsc::channel::<()>();
        let first = errands.ask(move || {
            begun.send(()).expect("the test listens");
            wait.recv().expect("the test lets it go on");
            "first"
        });
        begins.recv().expect("it begins");
        let others: Vec<Receiver<usize>> = (0..1000)
            .map(|i| {
                let done = Arc::clone(&done);
                errands.ask(move || {
                    done.fetch_add(1, Ordering::Relaxed);
                    i
                })
            })
            .collect();
        assert_eq!(first.try_recv(), Err(mpsc::TryRecvError::Empty));
        let_go.send(()).expect("the errand waits");
        assert_eq!(first.recv(), Ok("first"));
        assert_eq!(others[999].recv(), Ok(999));
        assert!(others[..999].iter().all(|other| other.recv().is_err()));
        assert_eq!(done.load(Ordering::Relaxed), 1);
        news.recv().and_then(|()| news.recv()).expect("news of both");
    }

    #[test]
    fn after_a_panic_the_next_errand_is_done() {
        let errands = Errands::start(Arc::new(|| {})).expect("a thread");
        let failed: Receiver<()> = errands.ask(|| panic!("asked to panic"));
        assert!(failed.recv().is_err());
        assert_eq!(errands.ask(|| 7).recv(), Ok(7));
    }
}
