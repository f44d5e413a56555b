//! The scene that is shown.

use std::{ffi::OsStr, path::PathBuf, sync::Arc};

use crate::{
    printable,
    recording::Recording,
    scene::{Opened, Scene, Settings},
    snapshot::Stage,
    worker::Job,
};

/// The scene under way, as it was opened.
#[derive(Debug)]
pub(super) struct Current {
    /// Built-in name or path, as it is shown.
    pub(super) name: String,
    /// The scene's file; none if it is built in.
    pub(super) path: Option<PathBuf>,
    pub(super) scene: Arc<Scene>,
    /// What the scene's snapshots show as constant.
    pub(super) stage: Arc<Stage>,
    /// The recording that is replayed; none for a scene.
    pub(super) recording: Option<Arc<Recording>>,
}

impl Current {
    pub(super) fn of(opened: Opened) -> Current {
        let Opened { key, path, scene } = opened;
        let stage = Arc::new(Stage::of(&key, &scene));
        Current { name: name_of(&key, path.as_ref()), path, scene: Arc::new(scene), stage, recording: None }
    }

    /// What [`crate::scene::open`] takes to open this scene again.
    pub(super) fn source(&self) -> &OsStr {
        self.path.as_ref().map_or(OsStr::new(&self.name), |path| path.as_os_str())
    }

    pub(super) fn job(&self, settings: Settings) -> Job {
        let recording = self.recording.clone();
        Job { stage: Arc::clone(&self.stage), scene: Arc::clone(&self.scene), settings, recording }
    }
}

/// How a scene is called on the screen: by its path, as far as it can be printed, or its built-in name.
fn name_of(key: &str, path: Option<&PathBuf>) -> String {
    path.map_or_else(|| key.to_owned(), |path| printable::name(path.as_os_str()))
}
