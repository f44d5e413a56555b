//! The short name of a scene that gives itself none.

use std::ffi::OsStr;
use std::path::Path;

use crate::printable;

/// Most characters of a key.
const KEY: usize = 100;

/// The file stem of a path, or the name itself, printable and of bounded length.
pub(super) fn key(origin: &OsStr) -> String {
    let stem = Path::new(origin).file_stem().unwrap_or(origin);
    printable::name(stem).chars().take(KEY).collect()
}
