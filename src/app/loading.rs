//! A scene on its way, while another is on the screen.

use std::{ffi::OsStr, sync::mpsc::Receiver};

use super::{current::Current, knobs};
use crate::scene::{self, Opened, Settings};

/// A scene on its way.
pub(super) struct Loading {
    /// The name that the scene is opened by.
    pub(super) name: String,
    /// Whether the scene's file is read again, so that settings changed by hand stay.
    pub(super) again: bool,
    pub(super) result: Receiver<Result<Loaded, String>>,
}

/// A scene, ready to be shown.
pub(super) struct Loaded {
    pub(super) current: Current,
    pub(super) settings: Settings,
    pub(super) message: Option<String>,
}

/// What decides about the settings of a scene that is read again: those in force, and those of the scene before.
pub(super) type Before = Option<(Settings, Settings)>;

pub(super) fn load(source: &OsStr, before: Before) -> Result<Loaded, String> {
    let opened: Opened = scene::open(source).map_err(|error| one_line(&error.to_string()))?;
    let own = opened.scene.solver;
    let settings = before.map_or(own, |(now, old)| knobs::reloaded(now, old, own));
    let warnings = scene::warnings(&opened.scene, settings, opened.scene.duration);
    let message = (!warnings.is_empty()).then(|| format!("Note: {}.", warnings.join("; ")));
    Ok(Loaded { current: Current::of(opened), settings, message })
}

/// An error's lines joined, for the message line.
fn one_line(text: &str) -> String {
    text.lines().map(str::trim).collect::<Vec<_>>().join(" ")
}
