//! From a file to a configuration.

use std::{
    fs,
    io::ErrorKind,
    path::{Path, PathBuf},
};

use super::{
    file::ConfigFile,
    keys,
    place::{Place, place},
    settings::Config,
};
use crate::{
    printable,
    scene::{Error, Source, Words, builtin, contents_within, not_text, read},
};

/// Largest file, MiB: a thousand times what one needs.
const LARGEST: u64 = 1;

/// No file at all, by its usual name.
const NOTHING: &str = "/dev/null";

/// What a configuration is called in messages.
const WORDS: Words = Words { what: "configuration", names: "`Config`", levels: "three" };

/// The configuration in the file named by the option, else by the variable [`VARIABLE`](super::VARIABLE), else in the
/// usual place. No file in the usual place, and `/dev/null` anywhere, means the defaults.
///
/// # Errors
/// If the file cannot be read, or breaks a rule.
pub fn open(option: Option<&Path>) -> Result<Config, Error> {
    let Some(Place { path, named }) = place(option) else { return Ok(Config::default()) };
    let missing = || {
        let kind = fs::metadata(&path).err().map(|error| error.kind());
        matches!(kind, Some(ErrorKind::NotFound | ErrorKind::NotADirectory))
    };
    if path.as_os_str() == NOTHING || !named && missing() {
        return Ok(Config::default());
    }
    let origin = printable::name(path.as_os_str());
    let bytes = contents_within(&path, "a configuration", LARGEST).map_err(|said| Error::whole(&origin, said))?;
    let text = String::from_utf8(bytes).map_err(|error| not_text(&origin, &error))?;
    let mut config = parse(&text, &origin)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    config.scene = beside(folder, &config).into_os_string();
    Ok(config)
}

/// The scene to begin with: a built-in one by its name, a file seen from the folder of the configuration.
fn beside(folder: &Path, config: &Config) -> PathBuf {
    match config.scene.to_str().and_then(builtin::find) {
        Some(_) => PathBuf::from(&config.scene),
        None => folder.join(&config.scene),
    }
}

/// The configuration written in `text`; `origin` is what errors call it.
///
/// # Errors
/// The first rule that it breaks, with line, column and field.
pub fn parse(text: &str, origin: &str) -> Result<Config, Error> {
    // Some editors begin a file with a byte order mark; it is no part of the text.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = Source { text, origin };
    let file: ConfigFile = read(source, WORDS)?;
    let keymap = keys::keymap(&file.keys, source)?;
    let ordinary = Config::default();
    Ok(Config {
        scene: file.scene.map_or(ordinary.scene, |scene| scene.0.into()),
        marker: file.marker.map_or(ordinary.marker, |marker| marker.0),
        color: file.color.map_or(ordinary.color, |color| color.0),
        frame_rate: file.frame_rate.map_or(ordinary.frame_rate, |rate| rate.0),
        bandwidth: file.bandwidth.map_or(ordinary.bandwidth, |bandwidth| bandwidth.0),
        inks: file.colors.inks(),
        keymap,
    })
}
