//! From a name or path to a scene.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::error::{Error, Source, quote};
use super::{Scene, builtin, key, parse};

/// Largest file that is read, bytes.
const LARGEST_FILE: u64 = 16 << 20;

/// A scene and where it came from.
#[derive(Debug, Clone, PartialEq)]
pub struct Opened {
    /// Built-in name or file stem, free of control characters.
    pub key: String,
    /// The file, if it is not built in.
    pub path: Option<PathBuf>,
    /// The scene.
    pub scene: Scene,
}

/// Opens a built-in scene or a file. A built-in name wins, unless the argument contains a path separator or ends in
/// `.ron`.
///
/// # Errors
/// If there is no such scene or file, it can't be read, or it breaks a rule.
pub fn open(name_or_path: &str) -> Result<Opened, Error> {
    let is_path = name_or_path.ends_with(".ron") || name_or_path.contains(std::path::is_separator);
    if let Some(builtin) = builtin::find(name_or_path).filter(|_| !is_path) {
        return Ok(Opened { key: builtin.name.to_owned(), path: None, scene: parse(builtin.text, builtin.name)? });
    }
    if !is_path && !Path::new(name_or_path).exists() {
        return Err(Error::whole(name_or_path, unknown(name_or_path)));
    }
    let text = text(name_or_path)?;
    let path = Some(PathBuf::from(name_or_path));
    Ok(Opened { key: key(name_or_path), path, scene: parse(&text, name_or_path)? })
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

/// The text of a scene file.
fn text(path: &str) -> Result<String, Error> {
    let unreadable = |error: std::io::Error| Error::whole(path, format!("the file can't be read: {error}"));
    let about = fs::metadata(path).map_err(unreadable)?;
    // Asked before it is opened: opening a pipe would wait for a writer.
    if !about.is_file() {
        let what = if about.is_dir() { "a folder" } else { "a device or pipe" };
        return Err(Error::whole(path, format!("it is {what}; allowed is a scene file")));
    }
    let mut bytes = Vec::new();
    fs::File::open(path).and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE {
        let size = about.len().max(bytes.len() as u64);
        return Err(Error::whole(path, format!("the file of {size} bytes is refused; allowed are up to 16 MiB")));
    }
    String::from_utf8(bytes).map_err(|error| not_text(path, &error))
}

/// The refusal of bytes that are not UTF-8, at the first of them.
fn not_text(path: &str, error: &std::string::FromUtf8Error) -> Error {
    let (valid, wrong) = error.as_bytes().split_at(error.utf8_error().valid_up_to());
    let text = str::from_utf8(valid).unwrap_or_default();
    let place = super::locate::position(text, text.len());
    let byte = wrong.first().copied().unwrap_or_default();
    let message = format!("the byte 0x{byte:02x} is refused; allowed is text in UTF-8");
    Source { text, origin: path }.refuse_at(Some(place), &[], message)
}
