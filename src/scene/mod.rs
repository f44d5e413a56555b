//! The validated scene: whatever holds a [`Scene`] may rely on every rule of `rules`.
//!
//! A name or path becomes text (`open`, `builtin`), the text its RON shape (`file`, whose numbers are types of `number`),
//! the shape bodies (`generate`, `gas`), and the bodies a scene (`rules`, with
//! `size` for what is too much, `overlaps` and `near`, within an `effort`). Whatever is
//! refused is an [`Error`] that names its place (`locate`).

use glam::DVec3;

use std::ffi::OsStr;

use crate::geometry::{Bounds, Parallelogram};
use crate::printable;

pub mod builtin;
mod effort;
mod error;
mod file;
mod gas;
mod generate;
mod locate;
mod near;
mod number;
mod open;
mod overlaps;
mod rules;
mod size;
mod warnings;

pub use error::Error;
pub use locate::Position;
pub use open::{Opened, contents, open};
pub use warnings::{endless, warnings};

/// The scene written in `text`. `origin`, a path or name, is what errors call it; a scene without a name takes its
/// file stem.
///
/// # Errors
/// The first rule that the scene breaks.
pub fn parse(text: &str, origin: &str) -> Result<Scene, Error> {
    // Some editors begin a file with a byte order mark; it is no part of the text.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = error::Source { text, origin };
    rules::validated(file::read(source)?, source)
}

/// Longest key, characters.
const KEY: usize = 100;

/// The file stem of a path, or the name itself, printable and of bounded length.
fn key(origin: &OsStr) -> String {
    let stem = std::path::Path::new(origin).file_stem().unwrap_or(origin);
    printable::name(stem).chars().take(KEY).collect()
}

/// An sRGB colour, each channel in [0, 1].
pub type Color = [f64; 3];

/// A validated scene. Wall and sphere indices everywhere in Carom are indices into these two lists.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Short title; no control characters.
    pub name: String,
    /// One line on what to look at; no control characters; may be empty.
    pub about: String,
    /// Uniform acceleration, m/s².
    pub gravity: DVec3,
    /// The contact law's parameters.
    pub contact: ContactLaw,
    /// What the scene asks to be solved with, unless the command line says otherwise.
    pub solver: Settings,
    /// How long a run lasts unless told otherwise, s.
    pub duration: f64,
    /// What the screen shows at first, m.
    pub view: Bounds,
    /// Walls in file order, a `Room` expanded in place.
    pub walls: Vec<Wall>,
    /// Spheres in file order, generators expanded in place.
    pub spheres: Vec<Sphere>,
}

/// The contact law (design: impact law; source: paper 2.4).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaw {
    /// Coefficient of restitution between spheres, in [0, 1].
    pub restitution: f64,
    /// Coefficient of restitution against walls, in [0, 1]; equal to `restitution` unless given.
    pub wall_restitution: f64,
    /// Factor on the tangential velocity at a wall impact, in [0, 1].
    pub tangential: f64,
    /// Approach speed up to which a contact rests, m/s, ≥ 0.
    pub rest_speed: f64,
}

/// The methods a scene or command line may name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Method {
    /// The source paper's: Euler frames, bisection, impulses over the next step.
    Paper,
    /// Ballistic flight, contacts found by looking ahead, to a tolerance; nothing tunnels.
    Swept,
    /// Event-driven: parabolas between contacts whose times are computed; no time step.
    Exact,
    /// Moreau–Jean: all contacts of a frame as one complementarity problem.
    Moreau,
}

impl Method {
    /// Every method, in the order in which `m` cycles through them.
    pub const ALL: &'static [Method] = &[Method::Paper, Method::Swept, Method::Exact, Method::Moreau];

    /// The word used in scene files, options and columns.
    pub const fn name(self) -> &'static str {
        match self {
            Method::Paper => "paper",
            Method::Swept => "swept",
            Method::Exact => "exact",
            Method::Moreau => "moreau",
        }
    }

    /// The method of that name.
    pub fn from_name(name: &str) -> Option<Method> {
        Method::ALL.iter().copied().find(|m| m.name() == name)
    }
}

/// What to solve with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The method.
    pub method: Method,
    /// Longest frame, s, > 0.
    pub dt: f64,
    /// Intersection tolerance, dimensionless (degree), ≥ 0.
    pub tolerance: f64,
}

/// A static wall of infinite mass, struck from both sides.
#[derive(Debug, Clone, PartialEq)]
pub struct Wall {
    /// Its place, m; edges are finite, non-zero and not parallel.
    pub shape: Parallelogram,
    /// Its colour, if the scene names one.
    pub color: Option<Color>,
}

/// A rigid sphere.
#[derive(Debug, Clone, PartialEq)]
pub struct Sphere {
    /// Centre at t = 0, m.
    pub x: DVec3,
    /// Velocity at t = 0, m/s.
    pub v: DVec3,
    /// Mass, kg, > 0.
    pub mass: f64,
    /// Radius, m, > 0.
    pub radius: f64,
    /// Constant force beside gravity, N.
    pub force: DVec3,
    /// Its colour, if the scene names one.
    pub color: Option<Color>,
    /// Its name, if the scene gives one; no control characters.
    pub name: Option<String>,
}
