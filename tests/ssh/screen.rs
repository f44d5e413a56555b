//! A terminal with a program on it: a real pseudo-terminal, an emulator that shows and answers, and waiting for a text.

use std::io::{Read, Write};
use std::num::NonZero;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};
use vt100::{Callbacks, Parser};

/// Columns and rows.
pub(crate) const SIZE: (u16, u16) = (80, 24);

/// How a picture begins and ends.
const BEGINS: &[u8] = b"\x1b[?2026h";
const ENDS: &[u8] = b"\x1b[?2026l";

/// Longest silence of a program that has something to show; reached only by a test that fails.
const PATIENCE: Duration = Duration::from_secs(30);

/// A terminal and the program that runs on it.
pub(crate) struct Screen {
    parser: Parser<Answers>,
    /// What came last: a mark may be torn.
    tail: Vec<u8>,
    /// Bytes, begun pictures and complete pictures that came.
    pub(crate) bytes: usize,
    pub(crate) begun: usize,
    pub(crate) complete: usize,
    output: Receiver<Vec<u8>>,
    keyboard: Box<dyn Write + Send>,
    child: Box<dyn Child + Send + Sync>,
    _master: Box<dyn MasterPty + Send>,
}

/// What a terminal answers by itself: that it is well, and what it is.
#[derive(Default)]
struct Answers {
    due: Vec<u8>,
}

impl Callbacks for Answers {
    fn unhandled_csi(&mut self, _: &mut vt100::Screen, i1: Option<u8>, _: Option<u8>, params: &[&[u16]], c: char) {
        match (i1, params, c) {
            (None, [[5]], 'n') => self.due.extend(b"\x1b[0n"),
            (None, _, 'c') => self.due.extend(b"\x1b[?62;22c"),
            _ => {}
        }
    }
}

impl Screen {
    /// Starts a program on a new terminal of so many columns and rows.
    pub(crate) fn start(program: &str, arguments: &[String], (cols, rows): (u16, u16)) -> Screen {
        let size = PtySize { rows, cols, ..PtySize::default() };
        let pair = native_pty_system().openpty(size).expect("a pseudo-terminal");
        let mut command = CommandBuilder::new(program);
        command.args(arguments);
        command.env("TERM", "xterm-256color");
        command.env_remove("TMUX");
        let child = pair.slave.spawn_command(command).unwrap_or_else(|error| panic!("{program}: {error}"));
        drop(pair.slave);
        let reader = pair.master.try_clone_reader().expect("its output");
        let cells = |count| NonZero::new(count).expect("a terminal has cells");
        Screen {
            parser: Parser::new_with_callbacks(cells(rows), cells(cols), 0, Answers::default()),
            tail: Vec::new(),
            bytes: 0,
            begun: 0,
            complete: 0,
            output: read(reader),
            keyboard: pair.master.take_writer().expect("its input"),
            child,
            _master: pair.master,
        }
    }

    /// Waits until what is shown is as wanted, and returns it.
    #[track_caller]
    pub(crate) fn wait_for(&mut self, what: &str, wanted: impl Fn(&str) -> bool) -> String {
        loop {
            let shown = self.text();
            if wanted(&shown) {
                return shown;
            }
            assert_eq!(self.read(PATIENCE), Ok(()), "no {what} came; shown was\n{shown}");
        }
    }

    /// What is shown.
    pub(crate) fn text(&self) -> String {
        self.parser.screen().contents()
    }

    /// Shows what comes next.
    ///
    /// # Errors
    /// If nothing comes within that time, or no more at all.
    pub(crate) fn read(&mut self, within: Duration) -> Result<(), RecvTimeoutError> {
        let bytes = self.output.recv_timeout(within)?;
        self.show(&bytes);
        Ok(())
    }

    fn show(&mut self, bytes: &[u8]) {
        self.parser.process(bytes);
        self.bytes += bytes.len();
        self.tail.extend(bytes);
        let count = |mark: &[u8]| self.tail.windows(mark.len()).filter(|window| *window == mark).count();
        self.begun += count(BEGINS);
        self.complete += count(ENDS);
        self.tail.drain(..self.tail.len().saturating_sub(BEGINS.len() - 1));
        let answers = std::mem::take(&mut self.parser.callbacks_mut().due);
        let _ = self.keyboard.write_all(&answers); // it may have ended meanwhile
    }

    /// Looks away: nothing is read for that long.
    pub(crate) fn look_away(&self, time: Duration) {
        let (_open, never) = mpsc::channel::<()>();
        assert_eq!(never.recv_timeout(time), Err(RecvTimeoutError::Timeout));
    }

    /// Types.
    pub(crate) fn press(&mut self, keys: &str) {
        self.keyboard.write_all(keys.as_bytes()).expect("a program that reads");
        self.keyboard.flush().expect("a program that reads");
    }

    /// Waits for the program's end, showing what it still writes; its exit code.
    #[track_caller]
    pub(crate) fn end(mut self) -> u32 {
        loop {
            match self.read(PATIENCE) {
                Ok(()) => {}
                Err(RecvTimeoutError::Disconnected) => break,
                Err(RecvTimeoutError::Timeout) => panic!("no end; shown is\n{}", self.text()),
            }
        }
        self.child.wait().expect("its end").exit_code()
    }

    /// Cuts the program off, as a dying network or a closed lid would.
    pub(crate) fn kill(mut self) {
        self.child.kill().expect("a living program");
        self.child.wait().expect("its end");
    }
}

/// The bytes of a terminal, as they come, until it closes.
fn read(mut reader: Box<dyn Read + Send>) -> Receiver<Vec<u8>> {
    let (send, output) = mpsc::sync_channel(0); // nothing is read ahead of the test
    thread::spawn(move || {
        let mut bytes = [0; 4096];
        while let Ok(length @ 1..) = reader.read(&mut bytes) {
            if send.send(bytes[..length].to_vec()).is_err() {
                break;
            }
        }
    });
    output
}
