//! What a worker works on.

use std::sync::Arc;

use crate::{
    recording::Recording,
    scene::{Scene, Settings},
    snapshot::Stage,
};

/// A scene to simulate.
#[derive(Debug, Clone)]
pub struct Job {
    /// What the scene's snapshots show as constant.
    pub stage: Arc<Stage>,
    /// The scene.
    pub scene: Arc<Scene>,
    /// Settings to begin with.
    pub settings: Settings,
    /// The recording that the run follows, if there is one.
    pub recording: Option<Arc<Recording>>,
}
