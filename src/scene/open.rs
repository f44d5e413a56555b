//! From a name or path to a scene.

use std::ffi::OsStr;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::builtin;
use super::error::{Error, Source, quote};
use super::key::key;
use super::locate::position;
use super::parse::parse;
use super::validated::Scene;
use crate::printable;

/// Largest file that is read, MiB.
const LARGEST_FILE: u64 = 16;

/// A scene and where it came from.
#[derive(Debug, Clone, PartialEq)]
pub struct Opened {
    /// Built-in name or file stem, printable.
    pub key: String,
    /// The path of the scene's file; none if the scene is built in.
    pub path: Option<PathBuf>,
    /// The scene.
    pub scene: Scene,
}

/// Opens a built-in scene or a file. A built-in name wins, unless the argument contains a path separator or ends in
/// `.ron`. A file's name may be any that the system takes, UTF-8 or not.
///
/// # Errors
/// If there is no such scene or file, it cannot be read, or it breaks a rule.
pub fn open(name_or_path: impl AsRef<OsStr>) -> Result<Opened, Error> {
    open_with_text(name_or_path).map(|(opened, _)| opened)
}

/// A scene as [`open`] opens it, and its text.
///
/// # Errors
/// Those of [`open`].
pub fn open_with_text(name_or_path: impl AsRef<OsStr>) -> Result<(Opened, String), Error> {
    let word = name_or_path.as_ref();
    let shown = printable::name(word);
    let is_path = word.as_encoded_bytes().ends_with(b".ron") || has_separator(word);
    if let Some(builtin) = word.to_str().and_then(builtin::find).filter(|_| !is_path) {
        let opened = Opened { key: builtin.name.to_owned(), path: None, scene: parse(builtin.text, builtin.name)? };
        return Ok((opened, builtin.text.to_owned()));
    }
    if !is_path && !Path::new(word).exists() {
        return Err(Error::whole(&shown, unknown(&word.to_string_lossy())));
    }
    let text = contents(Path::new(word), "a scene file").map_err(|message| Error::whole(&shown, message))?;
    let text = String::from_utf8(text).map_err(|error| not_text(&shown, &error))?;
    let opened = Opened { key: key(word), path: Some(PathBuf::from(word)), scene: parse(&text, &shown)? };
    Ok((opened, text))
}

fn has_separator(word: &OsStr) -> bool {
    word.as_encoded_bytes().iter().any(|&byte| std::path::is_separator(char::from(byte)))
}

fn unknown(name: &str) -> String {
    let close = builtin::close_names(name);
    let (lead, names) = match close.is_empty() {
        true => ("there are", builtin::ALL.iter().map(|builtin| builtin.name).collect()),
        false => ("like it are", close),
    };
    let names: Vec<String> = names.into_iter().map(quote).collect();
    format!("there is no built-in scene and no file of that name; {lead} {}", names.join(", "))
}

/// The bytes of an input file, which must be `wanted` (`a scene file`): a plain file of 16 MiB at most.
///
/// # Errors
/// What the file is instead, how large, or why it cannot be read.
pub(crate) fn contents(path: &Path, wanted: &str) -> Result<Vec<u8>, String> {
    contents_within(path, wanted, LARGEST_FILE)
}

/// The bytes of an input file, which must be `wanted` (`a scene file`): a plain file of `most` MiB at most.
///
/// # Errors
/// What the file is instead, how large, or why it cannot be read.
pub(crate) fn contents_within(path: &Path, wanted: &str, most: u64) -> Result<Vec<u8>, String> {
    let unreadable = |error: std::io::Error| format!("the file cannot be read: {}", printable::cause(&error));
    let about = fs::metadata(path).map_err(unreadable)?;
    // Asked before it is opened: opening a pipe would wait for a writer, and a device may have no end.
    if !about.is_file() {
        let what = if about.is_dir() { "a folder" } else { "a device or pipe" };
        return Err(format!("it is {what}; allowed is {wanted}"));
    }
    let mut bytes = Vec::new();
    fs::File::open(path).and_then(|file| file.take((most << 20) + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
    if bytes.len() as u64 > most << 20 {
        let size = about.len().max(bytes.len() as u64);
        return Err(format!("the file of {size} bytes is refused; allowed are up to {most} MiB"));
    }
    Ok(bytes)
}

/// The refusal of bytes that are not UTF-8, at the first of them.
pub(crate) fn not_text(origin: &str, error: &std::string::FromUtf8Error) -> Error {
    let (valid, wrong) = error.as_bytes().split_at(error.utf8_error().valid_up_to());
    let text = str::from_utf8(valid).unwrap_or_default();
    let place = position(text, text.len());
    let byte = wrong.first().copied().unwrap_or_default();
    let message = format!("the byte 0x{byte:02x} is refused; allowed is text in UTF-8");
    Source { text, origin }.refuse_at(Some(place), &[], message)
}
