//! From text to a scene.

use super::error::{Error, Source};
use super::validated::Scene;
use super::{file::SceneFile, notation, rules};

/// What a scene's file is called in messages.
const WORDS: notation::Words = notation::Words { what: "scene", names: "`Sphere`, `Wall` or `paper`", levels: "five" };

/// The scene written in `text`. `origin`, a path or name, is what errors call it; a scene without a name takes its
/// file stem.
///
/// # Errors
/// The first rule that the scene breaks.
pub fn parse(text: &str, origin: &str) -> Result<Scene, Error> {
    // Some editors begin a file with a byte order mark; it is no part of the text.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = Source { text, origin };
    let file: SceneFile = notation::read(source, WORDS)?;
    rules::validated(file, source)
}
