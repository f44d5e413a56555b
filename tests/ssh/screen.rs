//! A terminal with a program on it: a real pseudo-terminal, an emulator that shows and answers, and waiting for a text.

use std::io::{Read, Write};
use std::num::NonZero;
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::Duration;

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};
use vt100::{Callbacks, Parser};

/// Rows and columns.
const SIZE: (NonZero<u16>, NonZero<u16>) = (NonZero::new(24).expect("not 0"), NonZero::new(80).expect("not 0"));

/// Longest silence of a program that has something to show; reached only by a test that fails.
const PATIENCE: Duration = Duration::from_secs(30);

/// A terminal and the program that runs on it.
pub(crate) struct Screen {
    parser: Parser<Answers>,
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
    /// Starts a program on a new terminal.
    pub(crate) fn start(program: &str, arguments: &[String]) -> Screen {
        let (rows, cols) = SIZE;
        let size = PtySize { rows: rows.get(), cols: cols.get(), pixel_width: 0, pixel_height: 0 };
        let pair = native_pty_system().openpty(size).expect("a pseudo-terminal");
        let mut command = CommandBuilder::new(program);
        command.args(arguments);
        command.env("TERM", "xterm-256color");
        command.env_remove("TMUX");
        let child = pair.slave.spawn_command(command).unwrap_or_else(|error| panic!("{program}: {error}"));
        drop(pair.slave);
        let reader = pair.master.try_clone_reader().expect("its output");
        Screen {
            parser: Parser::new_with_callbacks(rows, cols, 0, Answers::default()),
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
            let shown = self.parser.screen().contents();
            if wanted(&shown) {
                return shown;
            }
            let Ok(bytes) = self.output.recv_timeout(PATIENCE) else { panic!("no {what} came; shown was\n{shown}") };
            self.show(&bytes);
        }
    }

    fn show(&mut self, bytes: &[u8]) {
        self.parser.process(bytes);
        let answers = std::mem::take(&mut self.parser.callbacks_mut().due);
        let _ = self.keyboard.write_all(&answers); // it may have ended meanwhile
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
            match self.output.recv_timeout(PATIENCE) {
                Ok(bytes) => self.show(&bytes),
                Err(mpsc::RecvTimeoutError::Disconnected) => break,
                Err(mpsc::RecvTimeoutError::Timeout) => panic!("no end; shown is\n{}", self.parser.screen().contents()),
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
    let (send, output) = mpsc::sync_channel(256); // a program that writes without end waits for the test
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
