//! Reads the terminal on a thread of its own: bytes in, keys out.
//!
//! A sequence that does not go on within the escape time-out is given up with its parser, so nothing a terminal sends,
//! however unknown or torn, can hold up the keys after it.

use std::{fs::File, io, os::fd::AsFd, thread, time::Duration};

use rustix::{
    event::{PollFd, PollFlags, Timespec, poll},
    io::Errno,
    termios::isatty,
};
use termina::{
    Event as Parsed, Parser,
    event::{KeyCode, KeyEventKind, Modifiers},
};

use super::{Event, Post};
use crate::app::{Code, Input, Key};

/// A paste that does not go on for this long is over.
const PASTE_PAUSE: Duration = Duration::from_secs(1);

/// As much of a paste is kept; nothing here takes more.
const PASTE: usize = 4096;

const PASTE_BEGINS: &[u8] = b"\x1b[200~";
const PASTE_ENDS: &[u8] = b"\x1b[201~";

/// Starts the thread; it posts inputs, and [`Event::Gone`] when the terminal is.
///
/// # Errors
/// If neither standard input nor the controlling terminal can be read, or there is no thread to be had.
pub(super) fn start(escape_time: Duration, post: Post) -> io::Result<()> {
    let stdin = io::stdin();
    let tty = if isatty(&stdin) { File::from(stdin.as_fd().try_clone_to_owned()?) } else { File::open("/dev/tty")? };
    let decoder = Decoder::new(escape_time);
    thread::Builder::new().name("terminal input".into()).spawn(move || {
        read(&tty, decoder, &post);
        post.send(Event::Gone);
    })?;
    Ok(())
}

/// Until the terminal is gone.
fn read(tty: &File, mut decoder: Decoder, post: &Post) {
    let mut bytes = [0; 4096];
    loop {
        let waiting = decoder.patience().map(|time| Timespec::try_from(time).expect("it is a second at most"));
        let mut ready = [PollFd::new(tty, PollFlags::IN)];
        match poll(&mut ready, waiting.as_ref()) {
            Ok(0) => decoder.silence(),
            Ok(_) if ready[0].revents().contains(PollFlags::IN) => match rustix::io::read(tty, &mut bytes) {
                Ok(0) => return,
                Ok(n) => decoder.feed(&bytes[..n]),
                Err(Errno::INTR | Errno::AGAIN) => {}
                Err(_) => return,
            },
            Err(Errno::INTR) => {}
            _ => return, // hung up
        }
        for input in decoder.inputs.drain(..) {
            post.send(Event::Input(input));
        }
    }
}

/// Bytes to inputs.
struct Decoder {
    escape_time: Duration,
    parser: Parser,
    /// The bytes since the last complete key, to recognise the start of a paste; no longer than that.
    recent: Vec<u8>,
    /// Whether the parser waits for the rest of a sequence.
    waiting: bool,
    /// The paste under way: its first [`PASTE`] bytes, and then the last few.
    paste: Option<Paste>,
    inputs: Vec<Input>,
}

#[derive(Default)]
struct Paste {
    text: Vec<u8>,
    /// As many last bytes as end a paste.
    tail: Vec<u8>,
}

impl Decoder {
    fn new(escape_time: Duration) -> Decoder {
        Decoder {
            escape_time,
            parser: Parser::default(),
            recent: Vec::new(),
            waiting: false,
            paste: None,
            inputs: Vec::new(),
        }
    }

    /// How long silence means that more is to come; `None`: for ever, nothing is awaited.
    fn patience(&self) -> Option<Duration> {
        match (&self.paste, self.waiting) {
            (Some(_), _) => Some(PASTE_PAUSE),
            (None, true) => Some(self.escape_time),
            (None, false) => None,
        }
    }

    fn feed(&mut self, bytes: &[u8]) {
        for byte in bytes {
            match self.paste.as_mut().map(|paste| paste.ends_with(*byte)) {
                Some(true) => self.end_paste(),
                Some(false) => {}
                None => self.parse(*byte),
            }
        }
    }

    fn parse(&mut self, byte: u8) {
        self.recent.push(byte);
        if self.recent == PASTE_BEGINS {
            self.paste = Some(Paste::default());
            return self.start_over();
        }
        self.parser.parse(&[byte], true);
        self.waiting = true;
        while let Some(event) = self.parser.pop() {
            self.inputs.extend(input(&event));
            self.recent.clear();
            self.waiting = false;
        }
        // An escape always starts anew; what is no beginning of a paste is of no interest.
        if byte == b'\x1b' {
            self.recent = vec![byte];
        } else if !PASTE_BEGINS.starts_with(&self.recent) {
            self.recent.clear();
        }
    }

    /// Nothing came for as long as [`Decoder::patience`].
    fn silence(&mut self) {
        if self.paste.is_some() {
            return self.end_paste();
        }
        self.parser.parse(&[], false); // a lone escape is the key
        while let Some(event) = self.parser.pop() {
            self.inputs.extend(input(&event));
        }
        self.start_over();
    }

    fn end_paste(&mut self) {
        if let Some(paste) = self.paste.take() {
            self.inputs.push(Input::Paste(String::from_utf8_lossy(&paste.text).into_owned()));
        }
        self.start_over();
    }

    fn start_over(&mut self) {
        self.parser = Parser::default();
        self.recent.clear();
        self.waiting = false;
    }
}

impl Paste {
    /// Takes a byte; true if the paste ends with it.
    fn ends_with(&mut self, byte: u8) -> bool {
        self.tail.push(byte);
        if self.tail == PASTE_ENDS {
            return true;
        }
        while !PASTE_ENDS.starts_with(&self.tail) {
            let first = self.tail.remove(0);
            if self.text.len() < PASTE {
                self.text.push(first);
            }
        }
        false
    }
}

/// What the application is told of it: keys pressed. Replies to questions nobody asked, mouse and focus are dropped.
fn input(event: &Parsed) -> Option<Input> {
    let Parsed::Key(key) = event else { return None };
    if key.kind == KeyEventKind::Release {
        return None;
    }
    let has = |modifier| key.modifiers.contains(modifier);
    let (ctrl, mut shift, alt) = (has(Modifiers::CONTROL), has(Modifiers::SHIFT), has(Modifiers::ALT));
    let code = match key.code {
        // What these control characters have always been.
        KeyCode::Char('j') if ctrl && !alt => return Some(Input::Key(Key::plain(Code::Enter))),
        KeyCode::Char('h') if ctrl && !alt => return Some(Input::Key(Key::plain(Code::Backspace))),
        KeyCode::Char(c) => {
            shift = false; // it is in the character
            Code::Char(c)
        }
        KeyCode::BackTab => {
            shift = true;
            Code::Tab
        }
        KeyCode::Function(n) => Code::F(n),
        KeyCode::Enter => Code::Enter,
        KeyCode::Escape => Code::Escape,
        KeyCode::Tab => Code::Tab,
        KeyCode::Backspace => Code::Backspace,
        KeyCode::Delete => Code::Delete,
        KeyCode::Left => Code::Left,
        KeyCode::Right => Code::Right,
        KeyCode::Up => Code::Up,
        KeyCode::Down => Code::Down,
        KeyCode::Home => Code::Home,
        KeyCode::End => Code::End,
        KeyCode::PageUp => Code::PageUp,
        KeyCode::PageDown => Code::PageDown,
        _ => return None,
    };
    Some(Input::Key(Key { code, ctrl, shift, alt }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What comes of `bytes`, and of silence after them.
    fn decode(bytes: &[u8]) -> Vec<Input> {
        let mut decoder = Decoder::new(Duration::from_millis(25));
        decoder.feed(bytes);
        if decoder.patience().is_some() {
            decoder.silence();
        }
        assert_eq!(decoder.patience(), None, "nothing is left to wait for");
        decoder.inputs
    }

    fn keys(keys: &[Key]) -> Vec<Input> {
        keys.iter().copied().map(Input::Key).collect()
    }

    #[test]
    fn keys_arrive_as_the_key_table_names_them() {
        let expected = [
            Key::char('R'),
            Key::char(' '),
            Key::ctrl('c'),
            Key::shift(Code::Tab),
            Key::shift(Code::Left),
            Key::plain(Code::F(1)),
            Key::plain(Code::Home),
            Key::plain(Code::Enter),
            Key::char('é'),
        ];
        assert_eq!(decode("R \x03\x1b[Z\x1b[1;2D\x1bOP\x1b[H\ré".as_bytes()), keys(&expected));
    }

    #[test]
    fn a_lone_escape_is_the_key_and_a_torn_sequence_is_given_up() {
        assert_eq!(decode(b"\x1b"), keys(&[Key::plain(Code::Escape)]));
        let mut decoder = Decoder::new(Duration::from_millis(25));
        decoder.feed(b"\x1b[");
        decoder.silence();
        decoder.feed(b"q");
        assert_eq!(decoder.inputs, keys(&[Key::char('q')]));
    }

    #[test]
    fn a_sequence_in_two_packets_is_one_key() {
        let mut decoder = Decoder::new(Duration::from_millis(25));
        decoder.feed(b"\x1b[");
        decoder.feed(b"C");
        assert_eq!(decoder.inputs, keys(&[Key::plain(Code::Right)]));
    }

    #[test]
    fn replies_and_nonsense_do_not_hold_up_the_keys_after_them() {
        for noise in ["\x1b[?2026;2$y", "\x1b[0n", "\x1b[?62;22c", "\x1b[99z", "\x1b]11;rgb:00/00/00\x07", "\x1b[?9"] {
            let mut decoder = Decoder::new(Duration::from_millis(25));
            decoder.feed(noise.as_bytes());
            decoder.silence();
            decoder.inputs.clear();
            decoder.feed(b"?");
            assert_eq!(decoder.inputs, keys(&[Key::char('?')]), "{noise:?}");
        }
    }

    #[test]
    fn a_paste_is_one_input_whatever_is_in_it() {
        assert_eq!(decode(b"\x1b[200~q\x1b[20x\x1b[201~r"), {
            let mut expected = vec![Input::Paste("q\u{1b}[20x".into())];
            expected.extend(keys(&[Key::char('r')]));
            expected
        });
        let huge = [PASTE_BEGINS, &[b'x'; 3 * PASTE], PASTE_ENDS].concat();
        assert_eq!(decode(&huge), [Input::Paste("x".repeat(PASTE))]);
    }

    proptest::proptest! {
        #[test]
        fn no_bytes_make_it_panic_or_wait_for_ever(bytes: Vec<u8>) {
            decode(&bytes);
        }

        #[test]
        fn no_sequence_makes_it_panic(tail in "[\\[\\]OP][0-9;:<>?A-Za-z~$ ]{0,12}") {
            decode(format!("\x1b{tail}").as_bytes());
        }
    }
}
