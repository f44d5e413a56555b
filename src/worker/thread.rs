//! A worker's thread, seen from its reader.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc,
        mpsc::{self, Sender},
    },
    thread,
};

use super::{
    job::Job,
    message::{Command, Notify, Report},
    run::Runner,
    slot::Slot,
};

/// A worker thread, seen from its reader. Dropping it ends the thread.
pub struct Worker {
    commands: Sender<Command>,
    sent: u64,
    slot: Arc<Slot<Report>>,
}

impl Worker {
    /// Starts a thread on `job`, paused at t = 0, with a report of that ready to take.
    ///
    /// # Errors
    /// If the system has no thread to give.
    pub fn start(job: Job, speed: f64, notify: Notify) -> std::io::Result<Worker> {
        let (commands, inbox) = mpsc::channel();
        let mut runner = Runner::new(job, speed, inbox);
        let slot = Arc::new(Slot::new(runner.report(), notify));
        let theirs = Arc::clone(&slot);
        thread::Builder::new().name("simulation".into()).spawn(move || {
            // The runner is given up with the thread, so what the panic left half done is not seen.
            if let Err(payload) = catch_unwind(AssertUnwindSafe(|| runner.run(&theirs))) {
                let last = theirs.take();
                theirs.put(Report { panic: Some(said(payload.as_ref())), ..Report::clone(&last) });
            }
        })?;
        Ok(Worker { commands, sent: 0, slot })
    }

    /// Sends a command; the answer is a later [`Report`]. After the worker's panic it goes nowhere.
    pub fn send(&mut self, command: Command) {
        self.sent += 1;
        let _ = self.commands.send(command); // its end is reported through the slot
    }

    /// Commands sent so far; a report with as many obeyed shows their effect.
    pub fn sent(&self) -> u64 {
        self.sent
    }

    /// The latest report; from here on `notify` is called again for the next one.
    pub fn take(&self) -> Arc<Report> {
        self.slot.take()
    }
}

/// The text of a panic.
fn said(payload: &(dyn std::any::Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no text").to_owned()
}
