//! A FILE of the command line, and that no output destroys another or an input.

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::place::Place;
use crate::printable;

/// A FILE of the command line; `-` is standard output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Target {
    /// `-`
    Stdout,
    /// Anything else.
    File(PathBuf),
}

impl From<OsString> for Target {
    fn from(word: OsString) -> Target {
        if word == "-" { Target::Stdout } else { Target::File(PathBuf::from(word)) }
    }
}

impl Target {
    /// The place that the target leads to; none if it leads nowhere.
    pub(super) fn place(&self) -> Option<Place> {
        match self {
            Target::Stdout => Place::of_open(io::stdout()),
            Target::File(path) => Place::of(path).ok(),
        }
    }

    /// Whether the target is standard output, by whatever name (`/dev/stdout`, the file into which the shell sends it).
    pub(super) fn is_stdout(&self) -> bool {
        let alike = |place| place != Place::Nowhere && Some(place) == Place::of_open(io::stdout());
        *self == Target::Stdout || self.place().is_some_and(alike)
    }

    /// The target as it was named, printable.
    pub(super) fn name(&self) -> String {
        match self {
            Target::Stdout => "-".into(),
            Target::File(path) => printable::name(path.as_os_str()),
        }
    }
}

/// Refuses outputs, each with its option, of which one would replace another, or one of the `inputs`, each with what it
/// is. What leads nowhere is no concern here: opening it says so.
///
/// # Errors
/// A sentence that names both.
pub(super) fn refuse_shared(outputs: &[(&str, Option<&Target>)], inputs: &[(&str, &Path)]) -> Result<(), Failure> {
    let given = outputs.iter().filter_map(|(option, target)| Some((*option, (*target)?)));
    let placed: Vec<_> = given.filter_map(|(option, target)| Some((option, target, target.place()?))).collect();
    for (index, (option, target, place)) in placed.iter().enumerate() {
        if *place == Place::Nowhere {
            continue;
        }
        if let Some((first, other, _)) = placed[..index].iter().find(|(_, _, other)| other == place) {
            return Err(Failure::Usage(format!(
                "{first} and {option} cannot both go to {}; give each its own",
                both(other, target)
            )));
        }
        if let Some((what, path)) = inputs.iter().find(|(_, path)| Place::of(path).is_ok_and(|input| input == *place)) {
            let (name, path) = (target.name(), printable::name(path.as_os_str()));
            return Err(Failure::Usage(format!("{option} {name} would replace {what} {path}; give it another name")));
        }
    }
    Ok(())
}

/// Two words for one place.
fn both(one: &Target, other: &Target) -> String {
    match (one.name(), other.name()) {
        _ if one.is_stdout() => "standard output".into(),
        (one, other) if one == other => format!("the same file, {one}"),
        (one, other) => format!("the same file, {one} and {other}"),
    }
}
