//! A large sweep in parts: which settings belong to part I of N, and the parts joined again.

use std::collections::BTreeMap;
use std::fmt;

use crate::export::TradeRow;
use crate::printable;
use crate::scene::Method;

/// Longest text quoted from a file, characters.
const QUOTE: usize = 60;

/// Part `index` (from 1) of `count`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    index: usize,
    count: usize,
}

impl Shard {
    /// The whole sweep.
    pub const WHOLE: Shard = Shard { index: 1, count: 1 };

    /// Part I of N, written `I/N`.
    ///
    /// # Errors
    /// If it is not that, or I is not from 1 to N.
    pub fn parse(text: &str) -> Result<Shard, NoShard> {
        let whole = |part: &str| part.parse::<usize>().ok();
        let parsed = text.split_once('/').and_then(|(index, count)| Some((whole(index)?, whole(count)?)));
        parsed
            .filter(|(index, count)| (1..=*count).contains(index))
            .map(|(index, count)| Shard { index, count })
            .ok_or(NoShard)
    }

    /// Whether the part has the setting of that index in the whole sweep. Settings are dealt out one by one, so that each
    /// part gets its share of the small steps, which take longest.
    pub(super) fn has(&self, index: usize) -> bool {
        index % self.count == self.index - 1
    }
}

/// A text that is no part of a sweep. Displays what is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoShard;

impl fmt::Display for NoShard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("must be I/N with I from 1 to N, such as 2/8")
    }
}

impl std::error::Error for NoShard {}

/// A row and where it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// `file:line`.
    pub place: String,
    /// The row.
    pub row: TradeRow,
}

/// Joins the rows of parts, in whatever order they come, to those of the whole sweep.
///
/// # Errors
/// An unknown method, a setting that comes twice, or parts that were measured on different scenes of one name.
pub fn merge(parts: Vec<Placed>) -> Result<Vec<TradeRow>, MergeError> {
    let mut sorted = BTreeMap::new();
    let mut horizons: BTreeMap<String, (Option<u64>, String)> = BTreeMap::new();
    for Placed { place, row } in parts {
        let Some(key) = key(&row) else { return Err(MergeError::Method { place, method: row.method }) };
        let bits = row.horizon.map(f64::to_bits);
        let (known, first) = horizons.entry(row.scene.clone()).or_insert_with(|| (bits, place.clone())).clone();
        if known != bits {
            return Err(MergeError::Horizon { place, scene: row.scene, first });
        }
        if let Some((before, _)) = sorted.insert(key, (place.clone(), row)) {
            return Err(MergeError::Twice { place, first: before });
        }
    }
    Ok(sorted.into_values().map(|(_, row)| row).collect())
}

/// Where a row belongs: scenes by name, methods in the program's order, then coarse to fine. All numbers are ≥ 0, whose
/// bits are in the order of their values.
fn key(row: &TradeRow) -> Option<(String, usize, u64, u64)> {
    let method = Method::ALL.iter().position(|method| method.name() == row.method)?;
    let coarse_first = |value: Option<f64>| u64::MAX - value.map_or(0, f64::to_bits);
    Some((row.scene.clone(), method, coarse_first(row.dt), coarse_first(row.tolerance)))
}

/// Why parts do not join. Displays as a sentence that begins with the place, `file:line`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MergeError {
    /// No method has this name.
    Method {
        /// `file:line`.
        place: String,
        /// What stands there.
        method: String,
    },
    /// The horizon of a scene differs between two parts.
    Horizon {
        /// `file:line`.
        place: String,
        /// The scene's name.
        scene: String,
        /// `file:line` of the horizon read first.
        first: String,
    },
    /// A setting comes twice.
    Twice {
        /// `file:line`.
        place: String,
        /// `file:line` where it came first.
        first: String,
    },
}

impl fmt::Display for MergeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MergeError::Method { place, method } => {
                let known: Vec<&str> = Method::ALL.iter().map(|method| method.name()).collect();
                let method = printable::shortened(method, QUOTE);
                write!(f, "{place}: method is \"{method}\"; known are {}", known.join(", "))
            }
            MergeError::Horizon { place, scene, first } => {
                let scene = printable::shortened(scene, QUOTE);
                write!(
                    f,
                    "{place}: the horizon of {scene} differs from that in {first}; they are parts of different sweeps"
                )
            }
            MergeError::Twice { place, first } => write!(f, "{place}: this setting is in {first} already"),
        }
    }
}

impl std::error::Error for MergeError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_disjoint_and_make_the_whole() {
        let parts: Vec<Shard> = (1..=3).map(|index| Shard { index, count: 3 }).collect();
        for index in 0..100 {
            assert_eq!(parts.iter().filter(|part| part.has(index)).count(), 1);
            assert!(Shard::WHOLE.has(index));
        }
    }

    #[test]
    fn a_part_is_written_i_of_n() {
        assert_eq!(Shard::parse("2/8"), Ok(Shard { index: 2, count: 8 }));
        for refused in ["0/8", "9/8", "1", "1/0", "/", "a/b", "-1/2", "1/2/3", ""] {
            assert!(Shard::parse(refused).is_err(), "{refused:?}");
        }
    }
}
