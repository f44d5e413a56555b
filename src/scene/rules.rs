//! Every rule that concerns more than one value, and the scene that meets them all. (A value's own range is a type in
//! `number`.)

use glam::DVec3;

use super::bodies::Bodies;
use super::effort::Effort;
use super::error::{Error, Source};
use super::file::{BoxFile, ContactFile, SceneFile, SolverFile, SphereFile, WallFile};
use super::gas::{Obstacles, strewn};
use super::generate::{lattice, room, thermal};
use super::key::key;
use super::locate::Step::{self, Field, Index};
use super::number::{Amount, LARGEST, Positive, Rgb, SMALLEST};
use super::overlaps::refuse_overlaps;
use super::size::{refuse_too_large, refuse_too_many};
use super::validated::{ContactLaw, Draft, Method, Resume, Scene, Settings, Sphere, Wall};
use super::values::refuse_values;
use crate::format::{number, rounded};
use crate::geometry::{Bounds, Parallelogram};
use crate::random::SplitMix64;

/// Sine of the angle below which two edges count as parallel: their plane would be rounding alone.
const PARALLEL: f64 = 1e-9;
/// Walls whose box is larger than the spheres' by more than this factor are not shown whole.
const BEYOND: f64 = 20.0;
/// Duration of a run, s, if the scene names none.
pub(super) const DURATION: f64 = 20.0;

/// The scene of a file, if it meets every rule.
pub(super) fn validated(file: SceneFile, source: Source) -> Result<Scene, Error> {
    let effort = Effort::whole();
    refuse_too_large(&file, source)?;
    let walls = walls(&file.walls, source)?;
    let spheres = spheres(&file.spheres, (&walls.list, &effort), source)?;
    if file.resume.is_none() {
        refuse_overlaps(&walls, &spheres, &effort, source)?; // those of a run may overlap
    }
    let view = match file.view {
        Some(view) => bounds(corners(view), &[Field("view")], source)?,
        None => default_view(&walls.list, &spheres.list),
    };
    Ok(Scene::sealed(Draft {
        name: file.name.map_or_else(|| key(source.origin.as_ref()), |name| name.0),
        about: file.about.0,
        gravity: file.gravity.0,
        contact: contact_law(&file.contact),
        solver: settings(&file.solver),
        duration: file.duration.map_or(DURATION, |duration| duration.0),
        view,
        resume: file.resume.map(|resume| Resume {
            t: resume.t.0,
            transient: resume.transient.into_iter().map(|vector| vector.0).collect(),
        }),
        walls: walls.list,
        spheres: spheres.list,
    }))
}

/// The scene of a draft, if it meets every rule.
pub(super) fn checked(mut draft: Draft, source: Source) -> Result<Scene, Error> {
    refuse_too_many(&draft, source)?;
    refuse_values(&draft, source)?;
    draft.view = bounds(draft.view, &[Field("view")], source)?;
    for (index, wall) in draft.walls.iter().enumerate() {
        refuse_degenerate(&wall.shape, &[Field("walls"), Index(index)], source)?;
    }
    let walls = Bodies::one_by_one(std::mem::take(&mut draft.walls));
    let spheres = Bodies::one_by_one(std::mem::take(&mut draft.spheres));
    if draft.resume.is_none() {
        refuse_overlaps(&walls, &spheres, &Effort::whole(), source)?;
    }
    Ok(Scene::sealed(Draft { walls: walls.list, spheres: spheres.list, ..draft }))
}

/// The contact law, with the paper's values where the file gives none.
pub(super) fn contact_law(file: &ContactFile) -> ContactLaw {
    let restitution = file.restitution.map_or(0.8, |e| e.0);
    ContactLaw {
        restitution,
        wall_restitution: file.wall_restitution.map_or(restitution, |e| e.0),
        tangential: file.tangential.map_or(0.99, |factor| factor.0),
        rest_speed: file.rest_speed.map_or(0.1, |speed| speed.0),
    }
}

/// What to solve with, with the paper's values where the file gives none.
pub(super) fn settings(file: &SolverFile) -> Settings {
    Settings {
        method: file.method.unwrap_or(Method::Paper),
        dt: file.dt.map_or(0.01, |dt| dt.0),
        tolerance: file.tolerance.map_or(0.001, |tolerance| tolerance.0),
    }
}

fn corners(file: BoxFile) -> Bounds {
    Bounds { min: file.min.0, max: file.max.0 }
}

/// The box between two corners (m), if it has a volume.
fn bounds(corners: Bounds, path: &[Step], source: Source) -> Result<Bounds, Error> {
    let Bounds { min, max } = corners;
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        if min[axis] >= max[axis] {
            let (min, max) = (number(min[axis]), number(max[axis]));
            let message = format!("along {name}, min {min} and max {max} are refused; allowed is a min below its max");
            return Err(source.refuse(path, message));
        }
    }
    Ok(corners)
}

/// The walls that the entries of a file make.
fn walls(entries: &[WallFile], source: Source) -> Result<Bodies<Wall>, Error> {
    let mut walls = Bodies::new();
    for (entry, wall) in entries.iter().enumerate() {
        let path = [Field("walls"), Index(entry)];
        match *wall {
            WallFile::Wall { center, s1, s2, color } => {
                let shape = Parallelogram { center: center.0, s1: s1.0, s2: s2.0 };
                refuse_degenerate(&shape, &path, source)?;
                walls.extend(entry, [Wall { shape, color: color.map(|color| color.0) }]);
            }
            WallFile::Room { min, max, color } => {
                let bounds = bounds(corners(BoxFile { min, max }), &path, source)?;
                walls.extend(entry, room(bounds, color.map(|color| color.0)));
            }
        }
    }
    let degenerate = walls.list.iter().position(|wall| fault(&wall.shape).is_some());
    match degenerate.map(|wall| walls.entry(wall)) {
        Some(entry) => Err(source.refuse(&[Field("walls"), Index(entry)], "the room is too thin to have six walls")),
        None => Ok(walls),
    }
}

/// What is wrong with a parallelogram, a phrase; none if nothing is.
fn fault(shape: &Parallelogram) -> Option<String> {
    let (long1, long2) = (shape.s1.length(), shape.s2.length());
    for (name, long) in [("s1", long1), ("s2", long2)] {
        if long < SMALLEST {
            return Some(format!(
                "the edge {name} of length {} m is refused; allowed is 1e-30 m or more",
                number(long)
            ));
        }
    }
    let sine = (shape.s1 / long1).cross(shape.s2 / long2).length();
    (sine <= PARALLEL).then(|| "s1 and s2 are parallel; allowed are edges that span a plane".to_owned())
}

fn refuse_degenerate(shape: &Parallelogram, path: &[Step], source: Source) -> Result<(), Error> {
    fault(shape).map_or(Ok(()), |message| Err(source.refuse(path, message)))
}

/// The spheres that the entries of a file make.
fn spheres(
    entries: &[SphereFile],
    (walls, effort): (&[Wall], &Effort),
    source: Source,
) -> Result<Bodies<Sphere>, Error> {
    let shapes: Vec<Parallelogram> = walls.iter().map(|wall| wall.shape).collect();
    let mut spheres = Bodies::new();
    for (entry, file) in entries.iter().enumerate() {
        let path = [Field("spheres"), Index(entry)];
        let obstacles = Obstacles { walls: &shapes, spheres: &spheres.list, effort };
        let made = of_entry(file, &obstacles, &path, source)?;
        refuse_far(&made, &path, source)?;
        spheres.extend(entry, made);
    }
    Ok(spheres)
}

/// The spheres that one entry of a file makes.
fn of_entry(file: &SphereFile, obstacles: &Obstacles, path: &[Step], source: Source) -> Result<Vec<Sphere>, Error> {
    match file {
        SphereFile::Sphere { x, v, mass, radius, force, color, name } => {
            let name = name.as_ref().map(|name| name.0.clone());
            Ok(vec![Sphere { x: x.0, v: v.0, force: force.0, name, ..still(*mass, *radius, *color) }])
        }
        SphereFile::Lattice { origin, counts, spacing, jitter, seed, mass, radius, v, speed, color } => {
            let mut draw = SplitMix64::new(*seed);
            let counts = [counts.0.0, counts.1.0, counts.2.0];
            let centers = lattice(origin.0, counts, spacing.0, jitter.map_or(0.0, |jitter| jitter.0), &mut draw);
            let like = Sphere { v: v.0, ..still(*mass, *radius, *color) };
            Ok(set_in_motion(centers, *speed, &like, &mut draw))
        }
        SphereFile::Gas { min, max, count, seed, speed, mass, radius, color } => {
            let bounds = bounds(corners(BoxFile { min: *min, max: *max }), path, source)?;
            let mut draw = SplitMix64::new(*seed);
            let centers = strewn(bounds, count.0, radius.0, obstacles, &mut draw);
            let centers = centers.map_err(|message| source.refuse(path, message))?;
            Ok(set_in_motion(centers, *speed, &still(*mass, *radius, *color), &mut draw))
        }
    }
}

/// A sphere at rest at the origin, without a force or a name of its own.
fn still(mass: Positive, radius: Positive, color: Option<Rgb>) -> Sphere {
    Sphere {
        x: DVec3::ZERO,
        v: DVec3::ZERO,
        mass: mass.0,
        radius: radius.0,
        force: DVec3::ZERO,
        color: color.map(|color| color.0),
        name: None,
    }
}

/// Generators may add up to what no single value may be.
fn refuse_far(spheres: &[Sphere], path: &[Step], source: Source) -> Result<(), Error> {
    let largest = spheres.iter().map(|s| s.x.abs().max(s.v.abs()).max_element()).fold(0.0, f64::max);
    if largest <= LARGEST {
        return Ok(());
    }
    let message = format!("a coordinate or speed of {} is refused; allowed is up to 1e30", rounded(largest));
    Err(source.refuse(path, message))
}

/// Spheres like one another at these centres, with thermal velocities on top of their common one if a speed is given.
fn set_in_motion(centers: Vec<DVec3>, speed: Option<Amount>, like: &Sphere, draw: &mut SplitMix64) -> Vec<Sphere> {
    let velocities = match speed {
        Some(Amount(speed)) => thermal(centers.len(), speed, draw),
        None => vec![DVec3::ZERO; centers.len()],
    };
    let moved = |(x, v): (DVec3, DVec3)| Sphere { x, v: like.v + v, ..like.clone() };
    centers.into_iter().zip(velocities).map(moved).collect()
}

/// What the screen shows if the scene does not say: the walls' box and the spheres with it, or twice the spheres' box
/// if the walls reach far beyond.
pub(super) fn default_view(walls: &[Wall], spheres: &[Sphere]) -> Bounds {
    let walls = Bounds::of(walls.iter().map(|wall| wall.shape.bounds()));
    let spheres = Bounds::of(spheres.iter().map(|sphere| Bounds::around(sphere.x, sphere.radius)));
    let twice = |bounds: Bounds| {
        let half = bounds.size();
        Bounds { min: bounds.center() - half, max: bounds.center() + half }
    };
    let view = match (walls, spheres) {
        (Some(walls), Some(spheres)) => {
            let beyond = (spheres.min - walls.min).max(walls.max - spheres.max).max_element();
            let far = beyond > BEYOND * spheres.size().max_element();
            if far { twice(spheres) } else { walls.union(spheres) }
        }
        (Some(walls), None) => walls,
        (None, Some(spheres)) => twice(spheres),
        (None, None) => Bounds { min: DVec3::splat(-1.0), max: DVec3::ONE },
    };
    with_volume(view)
}

/// The box, thickened where it is flat.
fn with_volume(view: Bounds) -> Bounds {
    let size = view.size();
    let half = size.max_element() * 0.05;
    let flat = |axis: usize| if size[axis] > 0.0 { 0.0 } else { half };
    let margin = DVec3::new(flat(0), flat(1), flat(2));
    Bounds { min: view.min - margin, max: view.max + margin }
}
