//! The built program in a real pseudo-terminal, with an emulator looking on.
//!
//! Reading happens on a thread, one read per request, so that a test can wait for output with a bound, and so that
//! nothing else holds the terminal open when a test closes it.

use std::{
    io::{Read, Write},
    num::NonZero,
    sync::mpsc::{self, Receiver, RecvTimeoutError, Sender},
    thread,
    time::Duration,
};

use portable_pty::{CommandBuilder, MasterPty, PtySize, SlavePty, native_pty_system};
use rustix::process::{Pid, Signal, kill_process};

use crate::watch;

/// Longest wait for anything that must happen: generous, because it only ends a test that has failed.
pub(crate) const PATIENCE: Duration = Duration::from_secs(30);

/// How the program asks the terminal what it is.
const REQUEST: &[u8] = b"\x1b[c";

/// How a picture begins.
const BEGINS: &[u8] = b"\x1b[?2026h";

/// What a test starts.
pub(crate) struct Start<'a> {
    pub(crate) program: &'a str,
    pub(crate) arguments: &'a [&'a str],
    pub(crate) environment: &'a [(&'a str, &'a str)],
    pub(crate) size: (u16, u16),
    /// Whether the terminal answers when it is asked what it is, as nearly all do.
    pub(crate) answers: bool,
}

/// The program under test on a UTF-8 terminal of 80×24.
pub(crate) fn carom<'a>(arguments: &'a [&'a str]) -> Start<'a> {
    Start { program: env!("CARGO_BIN_EXE_carom"), arguments, environment: &[], size: (80, 24), answers: true }
}

/// A program in a terminal.
pub(crate) struct Pty {
    master: Box<dyn MasterPty + Send>,
    /// Kept open: the kernel forgets the modes of a terminal that is not open.
    slave: Box<dyn SlavePty + Send>,
    writer: Box<dyn Write + Send>,
    requests: Sender<()>,
    pieces: Receiver<Vec<u8>>,
    asked: bool,
    exit: Receiver<u32>,
    pid: Pid,
    emulator: vt100::Parser,
    /// Whether requests are answered, and how far the output has been searched for them.
    pub(crate) answers: bool,
    searched: usize,
    /// Kills it if a test goes on for ever, reading what it goes on writing.
    watch: watch::Watch,
    /// Everything the program has written.
    pub(crate) output: Vec<u8>,
    /// Where it runs.
    folder: tempfile::TempDir,
}

impl Start<'_> {
    pub(crate) fn run(&self) -> Pty {
        let (cols, rows) = self.size;
        let size = PtySize { rows, cols, ..PtySize::default() };
        let pair = native_pty_system().openpty(size).expect("a pseudo-terminal");
        let mut command = CommandBuilder::new(self.program);
        command.args(self.arguments);
        let folder = tempfile::tempdir().expect("a temporary folder");
        command.cwd(folder.path()); // keys write files where the program runs
        for variable in
            ["LC_ALL", "LC_CTYPE", "NO_COLOR", "COLORTERM", "SSH_CONNECTION", "RUST_BACKTRACE", "LINES", "COLUMNS"]
        {
            command.env_remove(variable);
        }
        command.env("LANG", "C.UTF-8");
        command.env("CAROM_CONFIG", "/dev/null"); // not that of the user
        command.env("TERM", "xterm-256color");
        for (name, value) in self.environment {
            command.env(name, value);
        }
        let mut child = pair.slave.spawn_command(command).expect("the program starts");
        let pid = child.process_id().and_then(|pid| Pid::from_raw(pid as i32)).expect("it has a process id");
        let (ended, exit) = mpsc::channel();
        thread::spawn(move || ended.send(child.wait().expect("it is our child").exit_code()));
        let reader = pair.master.try_clone_reader().expect("a terminal can be read");
        let (requests, pieces) = read_on_request(reader);
        Pty {
            writer: pair.master.take_writer().expect("a terminal can be written"),
            master: pair.master,
            slave: pair.slave,
            requests,
            pieces,
            asked: false,
            exit,
            pid,
            emulator: vt100::Parser::new(at_least_one(rows), at_least_one(cols), 0),
            watch: watch::Watch::over(pid),
            answers: self.answers,
            searched: 0,
            output: Vec::new(),
            folder,
        }
    }
}

/// The emulator has no smaller screens.
fn at_least_one(cells: u16) -> NonZero<u16> {
    NonZero::new(cells).unwrap_or(NonZero::<u16>::MIN)
}

fn read_on_request(mut reader: Box<dyn Read + Send>) -> (Sender<()>, Receiver<Vec<u8>>) {
    let (requests, inbox) = mpsc::channel();
    let (outbox, answers) = mpsc::channel();
    thread::spawn(move || {
        let mut bytes = vec![0; 65536];
        for () in inbox {
            let read = reader.read(&mut bytes).unwrap_or(0);
            if outbox.send(bytes[..read].to_vec()).is_err() {
                return;
            }
        }
    });
    (requests, answers)
}

impl Pty {
    /// The next output, if there is any within that time.
    pub(crate) fn read(&mut self, within: Duration) -> Option<Vec<u8>> {
        if !self.asked {
            self.requests.send(()).expect("the reader lives");
        }
        let answer = self.pieces.recv_timeout(within);
        self.asked = answer == Err(RecvTimeoutError::Timeout);
        let bytes = answer.ok()?;
        self.output.extend(&bytes);
        assert!(self.output.len() as u64 <= watch::MOST, "it writes without end; the screen:\n{}", self.text());
        self.emulator.process(&bytes);
        let asked = self.requests_since(self.searched.saturating_sub(REQUEST.len() - 1));
        self.searched = self.output.len();
        if self.answers {
            self.answer(asked);
        }
        Some(bytes)
    }

    /// Lets go of the output so far, but for what a request may have begun with.
    pub(crate) fn forget_output(&mut self) {
        self.output.drain(..self.output.len().saturating_sub(REQUEST.len() - 1));
        self.searched = self.output.len();
    }

    /// How often the program has asked what the terminal is, after its first `from` bytes.
    pub(crate) fn requests_since(&self, from: usize) -> usize {
        self.output[from..].windows(REQUEST.len()).filter(|window| *window == REQUEST).count()
    }

    /// Answers so many requests.
    pub(crate) fn answer(&mut self, count: usize) {
        let _ = self.writer.write_all("\x1b[?62;22c".repeat(count).as_bytes()); // it may have ended meanwhile
    }

    /// Pictures in the output after its first `from` bytes.
    pub(crate) fn pictures_since(&self, from: usize) -> usize {
        self.output[from..].windows(BEGINS.len()).filter(|window| *window == BEGINS).count()
    }

    /// Reads on until the screen is as wanted.
    pub(crate) fn until(&mut self, what: &str, wanted: impl Fn(&vt100::Screen) -> bool) {
        while !wanted(self.emulator.screen()) {
            let read = self.read(PATIENCE);
            assert!(read.is_some_and(|bytes| !bytes.is_empty()), "never saw {what}; the screen:\n{}", self.text());
        }
    }

    /// Reads on until the screen shows that text.
    pub(crate) fn until_text(&mut self, text: &str) {
        self.until(&format!("{text:?}"), |screen| screen.contents().contains(text));
    }

    /// Reads on until the program has written `bytes` after its first `from` bytes.
    pub(crate) fn until_bytes(&mut self, from: usize, bytes: &[u8]) {
        while !self.output[from..].windows(bytes.len()).any(|window| window == bytes) {
            let read = self.read(PATIENCE);
            assert!(read.is_some_and(|bytes| !bytes.is_empty()), "never saw {bytes:?}");
        }
    }

    pub(crate) fn text(&self) -> String {
        self.emulator.screen().contents()
    }

    pub(crate) fn screen(&self) -> &vt100::Screen {
        self.emulator.screen()
    }

    pub(crate) fn send(&mut self, keys: &str) {
        self.send_bytes(keys.as_bytes());
    }

    pub(crate) fn send_bytes(&mut self, bytes: &[u8]) {
        self.writer.write_all(bytes).and_then(|()| self.writer.flush()).expect("the terminal takes keys");
    }

    /// Looks on as a screen of that size, whatever the terminal reports.
    pub(crate) fn emulate(&mut self, cols: u16, rows: u16) {
        self.emulator.screen_mut().set_size(at_least_one(rows), at_least_one(cols));
    }

    /// Gives the test so long from now on, instead of what is long enough for every other one.
    pub(crate) fn allow(&mut self, time: Duration) {
        self.watch = watch::Watch::within(self.pid, time);
    }

    /// Its process id.
    /// Where the program runs, and writes.
    #[allow(dead_code)] // of the binaries that share this file only one asks
    pub(crate) fn folder(&self) -> &std::path::Path {
        self.folder.path()
    }

    pub(crate) fn pid(&self) -> i32 {
        self.pid.as_raw_nonzero().get()
    }

    /// Memory that the program has in use, bytes; 0 where the system has no `/proc`.
    pub(crate) fn memory(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.pid.as_raw_nonzero())).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap_or("0 kB");
        line.split_whitespace().next().and_then(|kibibytes| kibibytes.parse::<u64>().ok()).unwrap_or(0) * 1024
    }

    pub(crate) fn resize(&mut self, cols: u16, rows: u16) {
        self.emulate(cols, rows);
        self.master.resize(PtySize { rows, cols, ..PtySize::default() }).expect("the terminal can be resized");
    }

    pub(crate) fn signal(&self, signal: Signal) {
        kill_process(self.pid, signal).expect("the program runs");
    }

    /// The terminal's modes.
    pub(crate) fn modes(&self) -> String {
        format!("{:?}", self.master.get_termios().expect("it has modes"))
    }

    /// The exit code, and the screen as the program left it.
    pub(crate) fn exit(&mut self) -> u32 {
        let turn = Duration::from_millis(5);
        let turns = PATIENCE.as_millis() / turn.as_millis();
        let code = (0..turns).find_map(|_| {
            drop(self.read(turn)); // a program that can't write might not end
            self.exit.try_recv().ok()
        });
        let code = code.unwrap_or_else(|| panic!("it never ends; the screen:\n{}", self.text()));
        while self.read(Duration::from_millis(50)).is_some_and(|bytes| !bytes.is_empty()) {}
        code
    }

    /// Looks away: nothing is read for that long, or until the program ends; its exit code if it did.
    pub(crate) fn look_away(&mut self, time: Duration) -> Option<u32> {
        self.exit.recv_timeout(time).ok()
    }

    /// Closes the terminal under the program, as a dropped connection does; its exit code. Only while it draws.
    pub(crate) fn hang_up(mut self) -> u32 {
        while self.asked {
            drop(self.read(PATIENCE));
        }
        let Pty { master, slave, writer, requests, pieces, exit, watch: _watch, .. } = self;
        drop((master, slave, writer, requests, pieces));
        exit.recv_timeout(PATIENCE).expect("the program ends with its terminal")
    }

    /// Private modes that were switched on and not off again.
    pub(crate) fn modes_left_on(&self) -> Vec<u32> {
        let text = String::from_utf8_lossy(&self.output);
        let mut on: Vec<u32> = Vec::new();
        for sequence in text.split("\x1b[?").skip(1) {
            let end = sequence.find(|c: char| !c.is_ascii_digit() && c != ';').unwrap_or(sequence.len());
            let modes = sequence[..end].split(';').filter_map(|mode| mode.parse().ok());
            match &sequence[end..].chars().next() {
                Some('h') => on.extend(modes),
                Some('l') => modes.for_each(|mode: u32| on.retain(|other| *other != mode)),
                _ => {}
            }
        }
        on.retain(|mode| *mode != 25); // a visible cursor is how it was
        on
    }

    /// Whether the terminal is as a program must leave it, except for its modes of the line (see [`Pty::modes`]).
    pub(crate) fn assert_given_back(&self) {
        assert_eq!(self.modes_left_on(), [0; 0], "modes left on");
        assert!(!self.screen().hide_cursor(), "the cursor is hidden");
        assert!(!self.screen().alternate_screen(), "the alternate screen is on");
    }
}
