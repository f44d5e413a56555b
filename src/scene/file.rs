//! The RON shape of a scene as written. Every range that concerns one value alone is checked here, by its type.

use serde::Deserialize;

use super::number::{Amount, Count, Fraction, Interval, NotNegative, Positive, Rgb, Text, Vector, method};
use super::validated::Method;

/// A scene file.
#[derive(Debug, Deserialize)]
#[serde(rename = "Scene", deny_unknown_fields)]
pub(super) struct SceneFile {
    pub(super) name: Option<Text>,
    #[serde(default)]
    pub(super) about: Text,
    #[serde(default)]
    pub(super) gravity: Vector,
    #[serde(default)]
    pub(super) contact: ContactFile,
    #[serde(default)]
    pub(super) solver: SolverFile,
    pub(super) duration: Option<NotNegative>,
    pub(super) view: Option<BoxFile>,
    pub(super) resume: Option<ResumeFile>,
    #[serde(default)]
    pub(super) walls: Vec<WallFile>,
    #[serde(default)]
    pub(super) spheres: Vec<SphereFile>,
}

/// The contact law; what is left out has the paper's value.
#[derive(Debug, Default, Deserialize)]
#[serde(rename = "Contact", deny_unknown_fields)]
pub(super) struct ContactFile {
    pub(super) restitution: Option<Fraction>,
    pub(super) wall_restitution: Option<Fraction>,
    pub(super) tangential: Option<Fraction>,
    pub(super) rest_speed: Option<NotNegative>,
}

/// What to solve with; what is left out has the paper's value.
#[derive(Debug, Default, Deserialize)]
#[serde(rename = "Solver", deny_unknown_fields)]
pub(super) struct SolverFile {
    #[serde(default, deserialize_with = "method")]
    pub(super) method: Option<Method>,
    pub(super) dt: Option<Interval>,
    pub(super) tolerance: Option<NotNegative>,
}

/// Where a run goes on.
#[derive(Debug, Deserialize)]
#[serde(rename = "Resume", deny_unknown_fields)]
pub(super) struct ResumeFile {
    pub(super) t: NotNegative,
    #[serde(default)]
    pub(super) transient: Vec<Vector>,
}

/// A box, m.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename = "View", deny_unknown_fields)]
pub(super) struct BoxFile {
    pub(super) min: Vector,
    pub(super) max: Vector,
}

/// An entry of `walls`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) enum WallFile {
    Wall { center: Vector, s1: Vector, s2: Vector, color: Option<Rgb> },
    Room { min: Vector, max: Vector, color: Option<Rgb> },
}

/// An entry of `spheres`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) enum SphereFile {
    Sphere {
        x: Vector,
        #[serde(default)]
        v: Vector,
        mass: Positive,
        radius: Positive,
        #[serde(default)]
        force: Vector,
        color: Option<Rgb>,
        name: Option<Text>,
    },
    Lattice {
        origin: Vector,
        counts: (Count, Count, Count),
        spacing: Positive,
        jitter: Option<Amount>,
        #[serde(default)]
        seed: u64,
        mass: Positive,
        radius: Positive,
        #[serde(default)]
        v: Vector,
        speed: Option<Amount>,
        color: Option<Rgb>,
    },
    Gas {
        min: Vector,
        max: Vector,
        count: Count,
        #[serde(default)]
        seed: u64,
        speed: Option<Amount>,
        mass: Positive,
        radius: Positive,
        color: Option<Rgb>,
    },
}
