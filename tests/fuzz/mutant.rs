//! Files that are almost right: pieces of good and bad ones, changed as typists, editors and broken disks change them.

use std::{fs, path::Path};

use crate::random::Random;

/// What stands in files, and what should not.
const WORDS: &[&str] = &[
    "0",
    "-0",
    "1",
    "-1",
    "0.5",
    "1e300",
    "-1e300",
    "1e-300",
    "5e-324",
    "inf",
    "-inf",
    "NaN",
    "nan",
    "1e999",
    "0x10",
    "1_000",
    "18446744073709551615",
    "18446744073709551616",
    "+1",
    ".5",
    "5.",
    "1e",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    ";",
    "\"",
    "\\",
    "\\u{202e}",
    "\u{202e}",
    "\u{0}",
    "\u{1b}[2J",
    "\u{feff}",
    "é",
    "\u{10ffff}",
    "//",
    "/*",
    "*/",
    "\n",
    "\r",
    "\t",
    " ",
    "()",
    "Some(1)",
    "None",
    "true",
    "#![enable(unwrap_newtypes)]",
    "r#\"\"#",
    "'x'",
    "b\"x\"",
    "(0, 0, 0)",
    "(1e308, 0, 0)",
    "Scene(",
    "walls: [",
    "spheres: [",
    "Room(",
    "Wall(",
    "Sphere(",
    "Lattice(",
    "Gas(",
    "gravity: ",
    "contact: (",
    "solver: (",
    "method: ",
    "paper",
    "swept",
    "exact",
    "moreau",
    "dt: ",
    "tolerance: ",
    "duration: ",
    "view: ",
    "min: ",
    "max: ",
    "x: ",
    "v: ",
    "mass: ",
    "radius: ",
    "force: ",
    "color: ",
    "name: ",
    "s1: ",
    "s2: ",
    "center: ",
    "counts: (2, 2, 2)",
    "count: 9",
    "spacing: ",
    "jitter: ",
    "seed: ",
    "speed: ",
    "restitution: ",
    "tangential: ",
    "rest_speed: ",
    "wall_restitution: ",
    "\"\"",
    ",,",
    ",,,,,,,,,,,,,,,,",
    "paper-0",
    "note",
];

/// The files in these folders of the project's that end so and are no longer than this, in the order of their names.
pub(crate) fn files(folders: &[&str], ending: &str, longest: usize) -> Vec<Vec<u8>> {
    let home = Path::new(env!("CARGO_MANIFEST_DIR"));
    let entries = folders.iter().flat_map(|folder| fs::read_dir(home.join(folder)).expect("a folder of the project's"));
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("it can be listed").path()).collect();
    paths.sort();
    let right = paths.iter().filter(|path| path.extension().is_some_and(|extension| extension == ending));
    let texts = right.map(|path| fs::read(path).expect("it can be read"));
    let found: Vec<Vec<u8>> = texts.filter(|text| text.len() <= longest).collect();
    assert!(!found.is_empty(), "{folders:?}");
    found
}

/// One of the files with a few changes, or with pieces of `others`.
pub(crate) fn mutant(files: &[Vec<u8>], others: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut text = pick(files, random).clone();
    for _ in 0..1 + below(4, random) {
        change(&mut text, others, random);
    }
    text
}

fn change(text: &mut Vec<u8>, files: &[Vec<u8>], random: &mut Random) {
    let from = below(text.len() + 1, random);
    let to = (from + below(1 + (1 << below(8, random)), random)).min(text.len());
    let word = pick(WORDS, random).bytes();
    match below(9, random) {
        0 => drop(text.drain(from..to)),
        1 => drop(text.splice(from..from, word)),
        2 | 3 => {
            let range = token(text, from);
            drop(text.splice(range, word));
        }
        4 => {
            let piece = text[from..to].to_vec();
            let there = below(text.len() + 1, random);
            drop(text.splice(there..there, piece));
        }
        5 => {
            let other = pick(files, random);
            let start = below(other.len() + 1, random);
            let end = (start + to - from).min(other.len());
            drop(text.splice(from..to, other[start..end].iter().copied()));
        }
        6 => text.truncate(from),
        7 if from < text.len() => text[from] ^= 1 << below(8, random),
        8 if from < text.len() => text[from] = below(256, random) as u8,
        _ => {}
    }
}

/// The number or name around a place.
fn token(text: &[u8], at: usize) -> std::ops::Range<usize> {
    let part = |byte: &u8| byte.is_ascii_alphanumeric() || b"._-+".contains(byte);
    let start = at - text[..at].iter().rev().take_while(|byte| part(byte)).count();
    start..at + text[at..].iter().take_while(|byte| part(byte)).count()
}

fn below(end: usize, random: &mut Random) -> usize {
    (random.unit() * end as f64) as usize
}

fn pick<'a, T>(of: &'a [T], random: &mut Random) -> &'a T {
    &of[below(of.len(), random)]
}
