//! What was asked for.

use std::path::PathBuf;

use crate::cases;

/// Rounds unless told: the best of so many counts.
const ROUNDS: usize = 3;

/// The command line.
pub struct Arguments {
    /// Scenes asked for; none means all.
    scenes: Vec<String>,
    /// How often each run is timed.
    pub rounds: usize,
    /// Where the raw rows go.
    pub raw: Option<PathBuf>,
}

impl Arguments {
    /// Reads the words after the program's name. Errors are full sentences.
    pub fn read(mut words: impl Iterator<Item = String>) -> Result<Arguments, String> {
        let mut arguments = Arguments { scenes: Vec::new(), rounds: ROUNDS, raw: None };
        while let Some(word) = words.next() {
            match word.as_str() {
                "--raw" => arguments.raw = Some(words.next().ok_or("--raw needs a file name after it.")?.into()),
                "--rounds" => arguments.rounds = rounds(words.next())?,
                _ => arguments.scenes.push(known(word)?),
            }
        }
        Ok(arguments)
    }

    /// Whether this scene was asked for.
    pub fn wants(&self, scene: &str) -> bool {
        self.scenes.is_empty() || self.scenes.iter().any(|wanted| wanted == scene)
    }
}

fn rounds(word: Option<String>) -> Result<usize, String> {
    let word = word.unwrap_or_default();
    let count = word.parse().ok().filter(|count| *count > 0);
    count.ok_or_else(|| format!("--rounds needs a whole number from 1 on after it, not {word:?}."))
}

fn known(scene: String) -> Result<String, String> {
    if cases::NAMES.contains(&scene.as_str()) {
        return Ok(scene);
    }
    Err(format!("{scene:?} is not a scene of this benchmark; it has {}.", cases::NAMES.join(", ")))
}
