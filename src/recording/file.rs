//! What a recording holds, and its file: lines of text, the scene's text, then eight bytes a frame.

use std::fmt;

use super::change::Change;
use super::sums::Sums;
use crate::scene::{Method, Settings};

/// The first line of every recording.
const MAGIC: &str = "carom recording 2";

/// The first line of recordings that knew no changes of settings.
const WITHOUT_CHANGES: &str = "carom recording 1";

/// Largest file that is read, MiB.
pub const LARGEST: u64 = 128;

/// A run: its scene, its settings and their changes, and the sums of every frame, as it ended, before any change there.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// Name by which the scene was opened, printable.
    pub key: String,
    /// The scene's text.
    pub scene: String,
    /// Settings at the start of the run.
    pub settings: Settings,
    /// Changes of settings on the way, in their order in time.
    pub changes: Vec<Change>,
    /// The sums of the state at the start, then at the end of every frame.
    pub frames: Vec<Sums>,
}

/// Why bytes are no recording. Displays as a sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum BadRecording {
    /// The bytes do not begin as a recording.
    Foreign,
    /// A line of the head is missing or says something else.
    Line(&'static str),
    /// The recording ends early, by this many bytes.
    Short(usize),
    /// Bytes follow the end of the recording, this many.
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
        let changes: String = self.changes.iter().map(|change| change.line() + "\n").collect();
        let head = format!(
            "{MAGIC}\nkey {}\nmethod {}\ndt {dt:?}\ntolerance {tolerance:?}\nchanges {}\n{changes}scene {}\nframes {}\n",
            self.key,
            method.name(),
            self.changes.len(),
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
        let changeable = match head.line() {
            Some(MAGIC) => true,
            Some(WITHOUT_CHANGES) => false,
            _ => return Err(BadRecording::Foreign),
        };
        let key = head.field("key")?.to_owned();
        let method = Method::from_name(head.field("method")?).ok_or(BadRecording::Line("method"))?;
        let dt = head.number("dt", |dt: &f64| dt.is_finite() && *dt > 0.0)?;
        let tolerance = head.number("tolerance", |tolerance: &f64| tolerance.is_finite() && *tolerance >= 0.0)?;
        let changes = if changeable { head.changes()? } else { Vec::new() };
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
            changes,
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

    /// The changes, each in a line of its own, no earlier than the one before.
    fn changes(&mut self) -> Result<Vec<Change>, BadRecording> {
        let count = self.number("changes", |_: &usize| true)?;
        let mut changes: Vec<Change> = Vec::new();
        for _ in 0..count {
            let change = Change::read(self.field("change")?).ok_or(BadRecording::Line("change"))?;
            if changes.last().is_some_and(|last| last.frame > change.frame) {
                return Err(BadRecording::Line("change"));
            }
            changes.push(change);
        }
        Ok(changes)
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
        let exact = Settings { method: Method::Exact, dt: 0.1 / 3.0, tolerance: 0.0 };
        let sums = |k: u8| Sums::from_bytes([k; 8]);
        Recording {
            key: "two\tballs".escape_debug().to_string(),
            scene: "Scene(\n)\n".into(),
            settings: Settings { method: Method::Swept, dt: 0.1 + 0.2, tolerance: 1e-300 },
            changes: vec![
                Change { frame: 2, stalled: false, settings: exact },
                Change { frame: 2, stalled: true, settings: Settings { dt: 1e-3, ..exact } },
            ],
            frames: (0..5).map(sums).collect(),
        }
    }

    #[test]
    fn what_is_written_is_read_back_to_the_bit() {
        assert_eq!(Recording::from_bytes(&recording().to_bytes()), Ok(recording()));
    }

    #[test]
    fn one_that_knew_no_changes_is_still_read() {
        let old = Recording { changes: Vec::new(), ..recording() };
        let bytes = String::from_utf8_lossy(&old.to_bytes()).into_owned();
        let bytes = bytes.replace("carom recording 2", "carom recording 1").replace("changes 0\n", "");
        assert_eq!(Recording::from_bytes(bytes.as_bytes()), Ok(old));
    }

    #[test]
    fn changes_that_say_nothing_allowed_are_refused() {
        let text = String::from_utf8_lossy(&recording().to_bytes()).into_owned();
        for (from, to) in [
            ("change 2 made", "change 2 found"),
            ("change 2 stalled", "change 1 stalled"), // earlier than the one before
            ("change 2 made exact", "change 2 made euler"),
            ("exact 0.001", "exact -0.001"),
            ("changes 2", "changes 3"),
            ("changes 2", "changes 1"),
        ] {
            assert!(text.contains(from), "{from}");
            assert!(Recording::from_bytes(text.replacen(from, to, 1).as_bytes()).is_err(), "{to}");
        }
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
