//! Bytes to inputs.
//!
//! The bytes fall into characters, control sequences, strings (whose payload holds no key) and pastes, as a terminal
//! itself would take them apart. What was begun may be torn: after the escape time-out a lone escape counts as the key,
//! and everything else as given up, but for a while longer what can only be the rest of it still belongs to it. Ctrl-C
//! is the key wherever it comes, but in the midst of a paste that ends.

use std::time::Duration;

use super::{
    mouse,
    paste::{CTRL_C, Paste},
    reply::{self, LONGEST, Reply},
    sequence,
};
use crate::app::{Code, Input, Key};

/// A paste that does not go on for this long is over.
const PASTE_PAUSE: Duration = Duration::from_secs(1);

/// A string that does not go on for this long is given up: byte by byte is slow, but not as slow as that.
const STRING_PAUSE: Duration = Duration::from_secs(2);

/// The rest of a torn sequence is recognised for this long after the escape time-out.
const REST: Duration = Duration::from_secs(1);

/// Longest parameters that are kept, bytes; no key has as many.
const PARAMETERS: usize = 64;

const ESCAPE: u8 = 0x1b;
const CANCEL: u8 = 0x18;
const SUBSTITUTE: u8 = 0x1a;
const BELL: u8 = 0x07;

/// Bytes to inputs.
pub(super) struct Decoder {
    escape_time: Duration,
    state: State,
    /// Whether the escape time-out has passed since the last byte.
    late: bool,
    /// What has come of the bytes so far; the reader takes it.
    pub(super) inputs: Vec<Input>,
    /// What the terminal has answered; the reader takes it.
    pub(super) replies: Vec<Reply>,
}

/// A string under way.
struct Payload {
    /// What follows its escape: `P` for DCS, `]` for OSC, which a bell ends too.
    kind: u8,
    /// Bytes of the string, up to one more than an answer has.
    bytes: Vec<u8>,
}

impl Payload {
    fn push(&mut self, byte: u8) {
        if self.bytes.len() <= LONGEST {
            self.bytes.push(byte);
        }
    }

    fn reply(&self) -> Option<Reply> {
        (self.bytes.len() <= LONGEST).then(|| reply::string(self.kind, &self.bytes)).flatten()
    }
}

/// What was begun.
enum State {
    Ground,
    /// A character in UTF-8, after an escape or not, of which bytes are missing.
    Character {
        bytes: Vec<u8>,
        alt: bool,
    },
    Escape,
    /// A late escape, or a late `ESC [`: the next byte may be of its sequence, or a key.
    Introducer(u8),
    /// `ESC O`.
    SingleShift,
    /// `ESC [` and these parameters.
    Control(Vec<u8>),
    /// The characters of an old mouse report that are still to come.
    Mouse(u8),
    /// APC, PM, SOS, DCS or OSC.
    String(Payload),
    /// An escape in a string, which may end it.
    StringEscape(Payload),
    Paste(Paste),
}

impl Decoder {
    /// A lone escape counts after `escape_time`.
    pub(super) fn new(escape_time: Duration) -> Decoder {
        Decoder { escape_time, state: State::Ground, late: false, inputs: Vec::new(), replies: Vec::new() }
    }

    /// How long silence means that more is to come; `None`: for ever, nothing is awaited.
    pub(super) fn patience(&self) -> Option<Duration> {
        match (&self.state, self.late) {
            (State::Ground, _) => None,
            (State::String(_), _) => Some(STRING_PAUSE),
            (State::Paste(paste), _) if !paste.is_interrupted() => Some(PASTE_PAUSE),
            (_, true) => Some(REST),
            (_, false) => Some(self.escape_time),
        }
    }

    /// Takes the next bytes.
    pub(super) fn feed(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.take(*byte);
            self.late &= matches!(self.state, State::Control(_)); // its beginning decides what may follow
        }
    }

    /// Decides what was begun, once nothing has come for as long as [`Decoder::patience`].
    pub(super) fn silence(&mut self) {
        let state = std::mem::replace(&mut self.state, State::Ground);
        let late = std::mem::replace(&mut self.late, true);
        match state {
            State::Escape if !late => {
                self.press(Key::plain(Code::Escape));
                self.state = State::Escape;
            }
            // A bracket alone may be the key, but only what does not come shows it.
            State::Introducer(b'[') if !late => self.state = State::Introducer(b'['),
            State::Introducer(byte) => self.press(Key::char(byte.into())),
            state @ (State::SingleShift | State::Control(_) | State::Mouse(_) | State::StringEscape(_)) if !late => {
                self.state = state;
            }
            State::Paste(paste) if paste.is_interrupted() => self.press(Key::ctrl('c')),
            State::Paste(paste) => self.pasted(&paste),
            _ => {}
        }
        self.late &= !matches!(self.state, State::Ground);
    }

    fn press(&mut self, key: Key) {
        self.inputs.push(Input::Key(key));
    }

    fn pasted(&mut self, paste: &Paste) {
        self.inputs.push(Input::Paste(paste.text()));
    }

    fn take(&mut self, byte: u8) {
        let state = std::mem::replace(&mut self.state, State::Ground);
        if let State::Paste(paste) = state {
            return self.paste(paste, byte);
        }
        if byte == CTRL_C {
            return self.interrupt(&state);
        }
        match state {
            State::Ground | State::Paste(_) => self.begin(byte, false),
            State::Character { bytes, alt } => self.character(bytes, alt, byte),
            State::Escape => self.escape(byte),
            State::Introducer(first) => self.introduce(first, byte),
            State::SingleShift => self.single_shift(byte),
            State::Control(parameters) => self.control(parameters, byte),
            State::Mouse(_) if byte == ESCAPE => self.state = State::Escape,
            State::Mouse(_) if self.late => self.begin(byte, false),
            // A coordinate beyond 95 takes two bytes where the mouse speaks UTF-8.
            State::Mouse(left) if (0x80..0xc0).contains(&byte) => self.state = State::Mouse(left),
            State::Mouse(left) if left > 1 => self.state = State::Mouse(left - 1),
            State::Mouse(_) => {}
            State::String(payload) => self.string(payload, byte),
            State::StringEscape(payload) if byte == b'\\' => self.replies.extend(payload.reply()),
            State::StringEscape(_) => self.escape(byte),
        }
    }

    /// Takes a Ctrl-C, which ends whatever was begun; an escape just before it was pressed.
    fn interrupt(&mut self, begun: &State) {
        match begun {
            State::Escape if !self.late => self.press(Key::plain(Code::Escape)),
            State::Introducer(byte) => self.press(Key::char((*byte).into())),
            _ => {}
        }
        self.press(Key::ctrl('c'));
    }

    /// Takes a byte with nothing begun before it, but perhaps an escape.
    fn begin(&mut self, byte: u8, alt: bool) {
        let control = |c: u8| Key { alt, ..Key::ctrl(c.into()) };
        let plain = |code| Key { alt, ..Key::plain(code) };
        let key = match byte {
            ESCAPE => {
                self.state = State::Escape;
                return;
            }
            // What these control characters have always been.
            b'\r' | b'\n' => plain(Code::Enter),
            b'\t' => plain(Code::Tab),
            0x08 | 0x7f => plain(Code::Backspace),
            0x00 => control(b' '),
            0x01..=0x1a => control(byte - 1 + b'a'),
            0x1c..=0x1f => control(byte - 0x1c + b'4'),
            b' '..=b'~' => Key { alt, ..Key::char(byte.into()) },
            _ => return self.character(Vec::new(), alt, byte),
        };
        self.press(key);
    }

    fn character(&mut self, mut bytes: Vec<u8>, alt: bool, byte: u8) {
        if !bytes.is_empty() && !(0x80..0xc0).contains(&byte) {
            return self.begin(byte, false); // the rest never came
        }
        bytes.push(byte);
        match str::from_utf8(&bytes) {
            Ok(text) => text.chars().for_each(|c| self.press(Key { alt, ..Key::char(c) })),
            Err(error) if error.error_len().is_none() => self.state = State::Character { bytes, alt },
            Err(_) => {}
        }
    }

    /// Takes a byte after an escape, or after one that has counted as the key already.
    fn escape(&mut self, byte: u8) {
        match byte {
            ESCAPE => {
                if !self.late {
                    self.press(Key::plain(Code::Escape));
                }
                self.state = State::Escape;
            }
            b'[' | b'O' | b']' | b'P' | b'X' | b'^' | b'_' if self.late => self.state = State::Introducer(byte),
            b'[' | b'O' | b']' | b'P' | b'X' | b'^' | b'_' => self.state = introduced(byte),
            _ => self.begin(byte, !self.late),
        }
    }

    /// Takes a byte after a late escape and `first`: one sequence in two pieces, or keys one after the other.
    fn introduce(&mut self, first: u8, byte: u8) {
        let one = match first {
            b'[' => begins_a_key(byte) || !self.late && matches!(byte, b'<'..=b'?'),
            b'O' => sequence::single_shift(byte).is_some(),
            b']' | b'<'..=b'?' => byte.is_ascii_digit(),
            b'P' => byte.is_ascii_digit() || b"$+>!|".contains(&byte),
            _ => byte >= b' ',
        };
        if one {
            self.state = introduced(first);
            self.late = false;
            return self.take(byte);
        }
        self.press(Key::char(first.into()));
        self.begin(byte, false);
    }

    fn single_shift(&mut self, byte: u8) {
        match sequence::single_shift(byte) {
            Some(key) => self.press(key),
            None if byte < b' ' || self.late => self.begin(byte, false),
            None => {} // an unknown one
        }
    }

    fn control(&mut self, mut parameters: Vec<u8>, byte: u8) {
        let first = parameters.is_empty();
        match byte {
            b'<'..=b'?' if self.late && first => self.state = State::Introducer(byte),
            _ if self.late && !may_follow_late(&parameters, byte) => self.begin(byte, false),
            CANCEL | SUBSTITUTE => {}
            b' '..=b'?' => {
                if parameters.len() <= PARAMETERS {
                    parameters.push(byte);
                }
                self.state = State::Control(parameters);
            }
            b'[' if first => self.state = State::Control(vec![byte]),
            b'M' if first => self.state = State::Mouse(3),
            b'~' if parameters == b"200" => self.state = State::Paste(Paste::default()),
            b'@'..=b'~' if parameters.len() > PARAMETERS => {}
            b'@'..=b'~' => {
                self.inputs.extend(sequence::key(&parameters, byte).map(Input::Key));
                self.inputs.extend(mouse::mouse(&parameters, byte).map(Input::Mouse));
                self.replies.extend(reply::reply(&parameters, byte));
            }
            _ => self.begin(byte, false),
        }
    }

    fn string(&mut self, mut payload: Payload, byte: u8) {
        self.state = match byte {
            ESCAPE => State::StringEscape(payload),
            CANCEL | SUBSTITUTE => State::Ground,
            BELL if payload.kind == b']' => {
                self.replies.extend(payload.reply());
                State::Ground
            }
            _ => {
                payload.push(byte);
                State::String(payload)
            }
        };
    }

    fn paste(&mut self, mut paste: Paste, byte: u8) {
        if paste.ends_with(byte) {
            return self.pasted(&paste);
        }
        if paste.is_interrupted_without_end() {
            self.press(Key::ctrl('c'));
        }
        self.state = State::Paste(paste);
    }
}

/// What `ESC byte` begins, or `ESC [ byte` where the byte is a private parameter.
fn introduced(byte: u8) -> State {
    match byte {
        b'[' => State::Control(Vec::new()),
        b'<'..=b'?' => State::Control(vec![byte]),
        b'O' => State::SingleShift,
        _ => State::String(Payload { kind: byte, bytes: Vec::new() }),
    }
}

/// Whether `ESC [ byte` begins or is a key.
fn begins_a_key(byte: u8) -> bool {
    byte.is_ascii_digit() || sequence::key(b"", byte).is_some()
}

/// Whether a byte that comes late can only belong to the control sequence with these parameters, of known keys and
/// replies; any other byte is a key, and the sequence is given up.
fn may_follow_late(parameters: &[u8], byte: u8) -> bool {
    match parameters.first() {
        None => begins_a_key(byte),
        Some(b'[') => matches!(byte, b'A'..=b'E'),
        Some(b'<') if matches!(byte, b'M' | b'm') => true,
        Some(_) => byte.is_ascii_digit() || b";$ABCDFHPQRSZ~cntuy".contains(&byte),
    }
}

#[cfg(test)]
mod tests;
