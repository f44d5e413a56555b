//! What does not change during a run.

use glam::DVec3;

use crate::geometry::Bounds;
use crate::printable;
use crate::scene::{ContactLaw, Scene};

/// What does not change during a run; built once per scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Name by which the scene was opened (built-in name or file stem), free of control characters.
    pub key: String,
    /// The scene's title.
    pub name: String,
    /// One line on what to look at.
    pub about: String,
    /// Duration the scene proposes, s.
    pub duration: f64,
    /// What the screen shows at first, m.
    pub view: Bounds,
    /// Outlines of the walls, m, with the colour the scene names.
    pub walls: Vec<([DVec3; 4], Option<[f64; 3]>)>,
    /// Radii, m, by sphere index.
    pub radii: Vec<f64>,
    /// Masses, kg, by sphere index.
    pub masses: Vec<f64>,
    /// Colours, by sphere index.
    pub colors: Vec<Option<[f64; 3]>>,
    /// Names, by sphere index.
    pub names: Vec<Option<String>>,
    /// Gravity, m/s².
    pub gravity: DVec3,
    /// Constant forces beside gravity, N, by sphere index.
    pub forces: Vec<DVec3>,
    /// The contact law.
    pub law: ContactLaw,
}

impl Stage {
    /// What stays constant of `scene`, opened by the name `key`.
    pub fn of(key: &str, scene: &Scene) -> Stage {
        Stage {
            key: printable::escaped(key),
            name: scene.name.clone(),
            about: scene.about.clone(),
            duration: scene.duration,
            view: scene.view,
            walls: scene.walls.iter().map(|wall| (wall.shape.corners(), wall.color)).collect(),
            radii: scene.spheres.iter().map(|sphere| sphere.radius).collect(),
            masses: scene.spheres.iter().map(|sphere| sphere.mass).collect(),
            colors: scene.spheres.iter().map(|sphere| sphere.color).collect(),
            names: scene.spheres.iter().map(|sphere| sphere.name.clone()).collect(),
            gravity: scene.gravity,
            forces: scene.spheres.iter().map(|sphere| sphere.force).collect(),
            law: scene.contact,
        }
    }
}
