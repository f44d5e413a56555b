//! Processes that a test waits for, bounded in time and memory whatever they do and whatever signals they ignore.

// Each test file is a crate of its own and uses what it needs.
#![allow(dead_code)]

use std::io::Read;
use std::process::{Child, Command, Output, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use rustix::process::{Pid, Signal, kill_process};

/// No process of a test takes so long, on any machine: then it is killed, and the test fails.
const LIMIT: Duration = Duration::from_secs(300);

/// No process of a test writes so many bytes to a stream that is read whole.
pub(crate) const MOST: u64 = 64 << 20;

/// A process that is killed if its watch is not over in time.
pub(crate) struct Watch {
    _over: Sender<()>,
}

impl Watch {
    /// Watches from now on until dropped, which must be after the process has ended at the latest.
    pub(crate) fn over(pid: Pid) -> Watch {
        Watch::within(pid, LIMIT)
    }

    /// The same, by another limit.
    pub(crate) fn within(pid: Pid, limit: Duration) -> Watch {
        let (over, end) = mpsc::channel::<()>();
        thread::spawn(move || {
            if end.recv_timeout(limit) == Err(RecvTimeoutError::Timeout) {
                let _ = kill_process(pid, Signal::KILL); // it may have ended just now
            }
        });
        Watch { _over: over }
    }
}

/// Waits for its end and what its pipes still hold.
pub(crate) fn finish(mut child: Child) -> Output {
    let out = child.stdout.take();
    finish_reading(child, out)
}

/// The same, `out` being what is left of its standard output.
pub(crate) fn finish_reading(mut child: Child, out: Option<impl Read + Send + 'static>) -> Output {
    let pid = Pid::from_child(&child);
    let watch = Watch::over(pid);
    let (out, err) = (out.map(|out| drain(out, pid)), child.stderr.take().map(|err| drain(err, pid)));
    let bytes = |thread: Option<JoinHandle<Vec<u8>>>| thread.map_or(Vec::new(), |it| it.join().expect("it only reads"));
    let (stdout, stderr) = (bytes(out), bytes(err));
    let status = child.wait().expect("it is our child");
    drop(watch);
    for stream in [&stdout, &stderr] {
        assert!(stream.len() as u64 <= MOST, "it wrote more than {MOST} bytes and was killed");
    }
    Output { status, stdout, stderr }
}

/// Reads on a thread of its own; a process that writes without end is killed.
fn drain(stream: impl Read + Send + 'static, pid: Pid) -> JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        let _ = stream.take(MOST + 1).read_to_end(&mut bytes); // what was read before an error counts
        if bytes.len() as u64 > MOST {
            let _ = kill_process(pid, Signal::KILL); // it may have ended just now
        }
        bytes
    })
}

/// Starts it and waits for its end; streams that are not set are read.
pub(crate) fn output(command: &mut Command) -> Output {
    finish(command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("a program that starts"))
}

#[test]
fn a_process_that_never_ends_is_killed() {
    let mut child = Command::new("sleep").arg("1000").spawn().expect("sleep");
    let watch = Watch::within(Pid::from_child(&child), Duration::from_millis(20));
    assert!(!child.wait().expect("its end").success());
    drop(watch);
}
