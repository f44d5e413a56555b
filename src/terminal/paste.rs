//! Pasted text, in the brackets that tell it from typed keys.

/// The byte of Ctrl-C, which is the key wherever it comes, but in a paste that ends.
pub(super) const CTRL_C: u8 = 0x03;

/// Bytes of a paste that are kept; nothing here takes more. After as many a Ctrl-C in a paste is the key.
pub(super) const KEPT: usize = 4096;

/// The bytes that end a paste.
pub(super) const ENDS: &[u8] = b"\x1b[201~";

/// A paste under way.
#[derive(Default)]
pub(super) struct Paste {
    /// First [`KEPT`] bytes of the paste.
    text: Vec<u8>,
    /// Last bytes, which may be the beginning of [`ENDS`].
    tail: Vec<u8>,
    /// Bytes since the first Ctrl-C in the paste, if there is one.
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

    /// Whether a Ctrl-C has come in the paste: the key, if there is silence after it.
    pub(super) fn is_interrupted(&self) -> bool {
        self.interrupted.is_some()
    }

    /// Whether a Ctrl-C has come in the paste and the end has not, for so long that it hardly will; true once.
    pub(super) fn is_interrupted_without_end(&mut self) -> bool {
        self.interrupted.take_if(|since| *since > KEPT).is_some()
    }

    /// What was pasted.
    pub(super) fn text(&self) -> String {
        String::from_utf8_lossy(&self.text).into_owned()
    }
}
