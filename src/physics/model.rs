//! All that is constant, and only what the scene requires. The only file of the physics that names `scene`.

pub use crate::scene::{Method, Scene, Settings};

/// What the scene requires.
#[derive(Debug, Clone)]
pub struct Model {}
