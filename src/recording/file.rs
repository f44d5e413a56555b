//! What a recording holds, and its file: lines of text, the scene's text, then eight bytes a frame.

use std::fmt;

use super::sums::Sums;
use crate::scene::{Method, Settings};

/// The first line of every recording.
const MAGIC: &str = "carom recording 1";

/// A run: its scene, its settings, and the sums of every frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// What the scene was opened as, printable.
    pub key: String,
    /// The scene's text.
    pub scene: String,
    /// What it was solved with.
    pub settings: Settings,
    /// The sums of the state at t = 0, then at the end of every frame.
    pub frames: Vec<Sums>,
}

/// Why bytes are no recording. Displays as a sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum BadRecording {
    /// It does not begin as one.
    Foreign,
    /// A line of its head is missing or says something else.
    Line(&'static str),
    /// It ends early: so many bytes are missing.
    Short(usize),
    /// So many bytes follow its end.
    Long(usize),
}

impl fmt::Display for BadRecording {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BadRecording::Foreign => write!(f, "this is no recording: its first line is not `{MAGIC}`"),
            BadRecording::Line(name) => write!(f, "its line `{name}` is missing or says nothing that is allowed"),
            BadRecording::Short(bytes) => write!(f, "it ends {bytes} bytes early"),
            BadRecording::Long(bytes) => write!(f, "{bytes} bytes follow its end"),
        }
    }
}

impl std::error::Error for BadRecording {}

impl Recording {
    /// The file's bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let Settings { method, dt, tolerance } = self.settings;
        let head = format!(
            "{MAGIC}\nkey {}\nmethod {}\ndt {dt:?}\ntolerance {tolerance:?}\nscene {}\nframes {}\n",
            self.key,
            method.name(),
            self.scene.len(),
            self.frames.len()
        );
        let mut bytes = head.into_bytes();
        bytes.extend(self.scene.as_bytes());
        bytes.extend(self.frames.iter().flat_map(|sums| sums.to_bytes()));
        bytes
    }

    /// The recording that these bytes are.
    ///
    /// # Errors
    /// If they are none, or not all of one.
    pub fn from_bytes(bytes: &[u8]) -> Result<Recording, BadRecording> {
        let mut head = Head { rest: bytes };
        if head.line() != Some(MAGIC) {
            return Err(BadRecording::Foreign);
        }
        let key = head.field("key")?.to_owned();
        let method = Method::from_name(head.field("method")?).ok_or(BadRecording::Line("method"))?;
        let dt = head.number("dt", |dt: &f64| dt.is_finite() && *dt > 0.0)?;
        let tolerance = head.number("tolerance", |tolerance: &f64| tolerance.is_finite() && *tolerance >= 0.0)?;
        let (scene, frames) = (head.number("scene", |_: &usize| true)?, head.number("frames", |_: &usize| true)?);
        let wanted = frames.checked_mul(Sums::BYTES).and_then(|bytes| bytes.checked_add(scene));
        let wanted = wanted.ok_or(BadRecording::Line("frames"))?;
        match head.rest.len() {
            there if there < wanted => return Err(BadRecording::Short(wanted - there)),
            there if there > wanted => return Err(BadRecording::Long(there - wanted)),
            _ => {}
        }
        let (text, sums) = head.rest.split_at(scene);
        let text = std::str::from_utf8(text).map_err(|_| BadRecording::Line("scene"))?;
        let (frames, _) = sums.as_chunks::<{ Sums::BYTES }>();
        Ok(Recording {
            key,
            scene: text.to_owned(),
            settings: Settings { method, dt, tolerance },
            frames: frames.iter().map(|bytes| Sums::from_bytes(*bytes)).collect(),
        })
    }
}

/// The lines at the beginning, as far as they are not read yet.
struct Head<'a> {
    rest: &'a [u8],
}

impl<'a> Head<'a> {
    fn line(&mut self) -> Option<&'a str> {
        let end = self.rest.iter().position(|&byte| byte == b'\n')?;
        let (line, rest) = self.rest.split_at(end);
        self.rest = &rest[1..];
        std::str::from_utf8(line).ok()
    }

    /// What stands behind the name in the next line.
    fn field(&mut self, name: &'static str) -> Result<&'a str, BadRecording> {
        let line = self.line().ok_or(BadRecording::Line(name))?;
        line.strip_prefix(name).and_then(|rest| rest.strip_prefix(' ')).ok_or(BadRecording::Line(name))
    }

    fn number<T: std::str::FromStr>(
        &mut self,
        name: &'static str,
        allowed: impl Fn(&T) -> bool,
    ) -> Result<T, BadRecording> {
        self.field(name)?.parse().ok().filter(allowed).ok_or(BadRecording::Line(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recording() -> Recording {
        let sums = |k: u8| Sums::from_bytes([k; 8]);
        Recording {
            key: "two\tballs".escape_debug().to_string(),
            scene: "Scene(\n)\n".into(),
            settings: Settings { method: Method::Swept, dt: 0.1 + 0.2, tolerance: 1e-300 },
            frames: (0..5).map(sums).collect(),
        }
    }

    #[test]
    fn what_is_written_is_read_back_to_the_bit() {
        assert_eq!(Recording::from_bytes(&recording().to_bytes()), Ok(recording()));
    }

    #[test]
    fn no_part_of_a_recording_is_one_and_nothing_else_is() {
        let bytes = recording().to_bytes();
        for end in 0..bytes.len() {
            assert!(Recording::from_bytes(&bytes[..end]).is_err(), "{end} bytes");
        }
        assert_eq!(Recording::from_bytes(&[&bytes[..], b"x"].concat()), Err(BadRecording::Long(1)));
        assert_eq!(Recording::from_bytes(b"Scene()\n"), Err(BadRecording::Foreign));
        let huge = String::from_utf8_lossy(&bytes).replace("frames 5", "frames 18446744073709551615");
        assert_eq!(Recording::from_bytes(huge.as_bytes()), Err(BadRecording::Line("frames")));
    }
}
