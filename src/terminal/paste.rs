//! Pasted text, in the brackets that tell it from typed keys.

/// Ctrl-C as a byte: the key wherever it comes, but in a paste that ends.
pub(super) const CTRL_C: u8 = 0x03;

/// As much of a paste is kept, bytes; nothing here takes more. After as much a Ctrl-C in a paste is the key.
pub(super) const KEPT: usize = 4096;

/// Ends a paste.
pub(super) const ENDS: &[u8] = b"\x1b[201~";

/// A paste under way.
#[derive(Default)]
pub(super) struct Paste {
    /// Its first [`KEPT`] bytes.
    text: Vec<u8>,
    /// Last bytes that may be the beginning of its end.
    tail: Vec<u8>,
    /// Bytes since the first Ctrl-C in it, if there is one.
    interrupted: Option<usize>,
}

impl Paste {
    /// Takes a byte; true if the paste ends with it.
    pub(super) fn ends_with(&mut self, byte: u8) -> bool {
        match &mut self.interrupted {
            Some(since) => *since += 1,
            None if byte == CTRL_C => self.interrupted = Some(0),
            None => {}
        }
        self.tail.push(byte);
        if self.tail == ENDS {
            return true;
        }
        while !ENDS.starts_with(&self.tail) {
            let first = self.tail.remove(0);
            if self.text.len() < KEPT {
                self.text.push(first);
            }
        }
        false
    }

    /// Whether a Ctrl-C has come in it: the key, if there is silence after it.
    pub(super) fn is_interrupted(&self) -> bool {
        self.interrupted.is_some()
    }

    /// Whether a Ctrl-C has come in it and the end has not, for so long that it hardly will; says so once.
    pub(super) fn is_interrupted_without_end(&mut self) -> bool {
        self.interrupted.take_if(|since| *since > KEPT).is_some()
    }

    /// What was pasted.
    pub(super) fn text(&self) -> String {
        String::from_utf8_lossy(&self.text).into_owned()
    }
}
