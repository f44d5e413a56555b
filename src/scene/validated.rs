//! What a scene holds, and the promise that a [`Scene`] keeps: it meets every rule of this room.

use std::ops::Deref;

use glam::DVec3;

use crate::geometry::{Bounds, Parallelogram};

/// An sRGB colour, each channel in [0, 1].
pub type Color = [f64; 3];

/// What a scene holds, free to be filled in and changed; [`Draft::validated`] makes a [`Scene`] of it. Wall and sphere
/// indices everywhere in Carom are indices into these two lists.
///
/// ```
/// use carom::scene::{Draft, Sphere};
/// use glam::DVec3;
///
/// let x = DVec3::Y * 5.0;
/// let ball = Sphere { x, v: DVec3::ZERO, mass: 1.0, radius: 0.5, force: DVec3::ZERO, color: None, name: None };
/// let draft = Draft { gravity: DVec3::NEG_Y * 9.8, ..Draft::new(Vec::new(), vec![ball]) };
/// let scene = draft.validated()?;
/// assert_eq!(scene.spheres.len(), 1);
/// # Ok::<(), carom::scene::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Draft {
    /// Short title; no control characters.
    pub name: String,
    /// One line on what to look at; no control characters; may be empty.
    pub about: String,
    /// Uniform acceleration, m/s².
    pub gravity: DVec3,
    /// The contact law's parameters.
    pub contact: ContactLaw,
    /// The settings that the scene asks for, unless the command line names others.
    pub solver: Settings,
    /// Duration of a run, s, unless the command line names another.
    pub duration: f64,
    /// What the screen shows at first, m.
    pub view: Bounds,
    /// What a run goes on from, if the spheres are where another run has left them.
    pub resume: Option<Resume>,
    /// Walls in file order, a `Room` expanded in place.
    pub walls: Vec<Wall>,
    /// Spheres in file order, generators expanded in place.
    pub spheres: Vec<Sphere>,
}

/// A validated scene: a [`Draft`] that met every rule, and can be read but not changed any more.
///
/// A scene comes from a text ([`parse`](crate::scene::parse), [`open`](crate::scene::open)), from [`Draft::validated`], or
/// from another scene ([`Scene::changed`], [`Scene::moved`]); there is no other way to make one:
///
/// ```compile_fail
/// # let scene = carom::scene::open("paper-0").expect("a built-in scene").scene;
/// let mut scene = scene;
/// scene.spheres[0].mass = -1.0; // cannot be assigned to
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Scene(pub(super) Draft);

impl Scene {
    /// Seals a draft of which the caller knows that it meets the rules.
    pub(super) fn sealed(draft: Draft) -> Scene {
        Scene(draft)
    }
}

impl Deref for Scene {
    type Target = Draft;

    fn deref(&self) -> &Draft {
        &self.0
    }
}

/// What a run needs to go on bit for bit where another run by the scene's settings was, beside positions and velocities.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Resume {
    /// Time at which the other run was, s, ≥ 0.
    pub t: f64,
    /// What [`Simulation::transient`](crate::physics::Simulation::transient) said at that time.
    pub transient: Vec<DVec3>,
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
    /// The source paper's method: Euler frames, bisection, impulses over the next step.
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

/// The method and its knobs.
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
    /// Centre and edges, m; edges are finite, non-zero and not parallel.
    pub shape: Parallelogram,
    /// Colour of the wall, if the scene names one.
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
    /// Colour of the sphere, if the scene names one.
    pub color: Option<Color>,
    /// Name of the sphere, if the scene gives one; no control characters.
    pub name: Option<String>,
}
