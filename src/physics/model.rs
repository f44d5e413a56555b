//! All that is constant, and only what the scene requires. The only file of the physics that names `scene`.
//!
//! No gravity term, no force list, no wall list, no pair loop and no neighbour cells are held unless the scene needs
//! them; [`Model::requirements`] says which.

use glam::DVec3;

use super::closed_room::edges_unreachable;
use super::neighbors::cell_count;
use super::requirements::{PairSearch, Requirements};
use super::state::State;
use super::wall::Face;
use crate::geometry::Parallelogram;

pub use crate::scene::{ContactLaw, Method, Scene, Settings};

/// Up to this many spheres every pair is looked at: sorting so few into cells costs more than it saves.
const ALL_PAIRS_LIMIT: usize = 64;

/// What accelerates the spheres in flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pull {
    /// Nothing: velocities change at contacts only.
    None,
    /// Gravity alone, the same for every sphere, m/s².
    Uniform(DVec3),
    /// At least one sphere carries a force of its own: [`Model::accelerations`] holds g + F / m.
    PerSphere,
}

/// What the scene requires.
#[derive(Debug, Clone)]
pub struct Model {
    /// What accelerates the spheres in flight.
    pub pull: Pull,
    /// g + F / m by sphere, m/s²; empty unless `pull` is [`Pull::PerSphere`].
    pub accelerations: Vec<DVec3>,
    /// Masses by sphere, kg.
    pub masses: Vec<f64>,
    /// 1 / m by sphere, 1/kg.
    pub inverse_masses: Vec<f64>,
    /// Radii by sphere, m.
    pub radii: Vec<f64>,
    /// Walls in the scene's order.
    pub faces: Vec<Face>,
    /// The contact law's parameters.
    pub law: ContactLaw,
    /// How pairs that may touch are found.
    pub pairs: PairSearch,
    /// Where the spheres are at load.
    pub initial: State,
    /// Whether the scene has gravity.
    gravity: bool,
    /// Spheres with a force of their own.
    forces: usize,
}

impl Model {
    /// The model of a validated scene.
    pub fn new(scene: &Scene) -> Model {
        let spheres = &scene.spheres;
        let forces = spheres.iter().filter(|s| s.force != DVec3::ZERO).count();
        let pull = match (forces, scene.gravity == DVec3::ZERO) {
            (0, true) => Pull::None,
            (0, false) => Pull::Uniform(scene.gravity),
            _ => Pull::PerSphere,
        };
        let own = spheres.iter().filter(|_| forces > 0).map(|s| scene.gravity + s.force / s.mass);
        let initial =
            State { t: 0.0, x: spheres.iter().map(|s| s.x).collect(), v: spheres.iter().map(|s| s.v).collect() };
        let radii: Vec<f64> = spheres.iter().map(|s| s.radius).collect();
        Model {
            pull,
            accelerations: own.collect(),
            masses: spheres.iter().map(|s| s.mass).collect(),
            inverse_masses: spheres.iter().map(|s| 1.0 / s.mass).collect(),
            faces: faces(scene, &initial.x, &radii),
            radii,
            law: law(scene),
            pairs: match spheres.len() {
                0 | 1 => PairSearch::None,
                2..=ALL_PAIRS_LIMIT => PairSearch::All,
                _ => PairSearch::Cells,
            },
            initial,
            gravity: scene.gravity != DVec3::ZERO,
            forces,
        }
    }

    /// What it holds and what it leaves out.
    pub fn requirements(&self) -> Requirements {
        let n = self.len();
        Requirements {
            spheres: n,
            gravity: self.gravity,
            forces: self.forces,
            walls: self.faces.len(),
            open_edges: 4 * self.faces.iter().filter(|f| !f.sealed).count(),
            pairs: n as u64 * (n as u64).saturating_sub(1) / 2,
            search: self.pairs,
            cells: if self.pairs == PairSearch::Cells { cell_count(n) } else { 0 },
        }
    }

    /// Number of spheres.
    pub fn len(&self) -> usize {
        self.radii.len()
    }

    /// Whether there is nothing to simulate.
    pub fn is_empty(&self) -> bool {
        self.radii.is_empty()
    }

    /// g + F / m of sphere `i`, m/s².
    #[inline]
    pub fn acceleration(&self, i: usize) -> DVec3 {
        match self.pull {
            Pull::None => DVec3::ZERO,
            Pull::Uniform(g) => g,
            Pull::PerSphere => self.accelerations[i],
        }
    }
}

/// The scene's law, unless a test breaks it on purpose.
fn law(scene: &Scene) -> ContactLaw {
    #[cfg(not(test))]
    return scene.contact;
    #[cfg(test)]
    super::law_fault::broken(scene.contact)
}

/// The walls of a scene with what their tests need.
fn faces(scene: &Scene, centers: &[DVec3], radii: &[f64]) -> Vec<Face> {
    let shapes: Vec<Parallelogram> = scene.walls.iter().map(|w| w.shape).collect();
    let sealed = edges_unreachable(&shapes, centers, radii);
    shapes.into_iter().zip(sealed).map(|(shape, sealed)| Face { sealed, ..Face::new(shape) }).collect()
}
