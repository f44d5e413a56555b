//! The range of each single value, for scenes that no file has shaped: the types of `number`, asked value by value.

use glam::DVec3;

use super::error::{Error, Source};
use super::locate::Step::{self, Field, Index};
use super::number::{Fraction, Interval, NotNegative, Number, Positive, Text};
use super::validated::{Color, Draft, Sphere, Wall};

/// Refuses the first value that its type does not allow.
pub(super) fn refuse_values(draft: &Draft, source: Source) -> Result<(), Error> {
    let Draft { contact, solver, view, .. } = draft;
    text(&draft.name, &[Field("name")], source)?;
    text(&draft.about, &[Field("about")], source)?;
    vector(draft.gravity, &[Field("gravity")], source)?;
    number::<Fraction>(contact.restitution, &[Field("contact"), Field("restitution")], source)?;
    number::<Fraction>(contact.wall_restitution, &[Field("contact"), Field("wall_restitution")], source)?;
    number::<Fraction>(contact.tangential, &[Field("contact"), Field("tangential")], source)?;
    number::<NotNegative>(contact.rest_speed, &[Field("contact"), Field("rest_speed")], source)?;
    number::<Interval>(solver.dt, &[Field("solver"), Field("dt")], source)?;
    number::<NotNegative>(solver.tolerance, &[Field("solver"), Field("tolerance")], source)?;
    number::<NotNegative>(draft.duration, &[Field("duration")], source)?;
    vector(view.min, &[Field("view"), Field("min")], source)?;
    vector(view.max, &[Field("view"), Field("max")], source)?;
    if let Some(resume) = &draft.resume {
        number::<NotNegative>(resume.t, &[Field("resume"), Field("t")], source)?;
        let at = |index| [Field("resume"), Field("transient"), Index(index)];
        resume.transient.iter().enumerate().try_for_each(|(index, value)| vector(*value, &at(index), source))?;
    }
    draft.walls.iter().enumerate().try_for_each(|(index, wall)| refuse_wall(index, wall, source))?;
    refuse_places::<Number>(&draft.spheres, source)?;
    draft.spheres.iter().enumerate().try_for_each(|(index, sphere)| refuse_sphere(index, sphere, source))
}

/// Refuses the first centre (m) or velocity (m/s) with a component that `T` does not allow.
pub(super) fn refuse_places<T: TryFrom<f64, Error = String>>(spheres: &[Sphere], source: Source) -> Result<(), Error> {
    spheres.iter().enumerate().try_for_each(|(index, sphere)| {
        let entry = [Field("spheres"), Index(index)];
        components::<T>(sphere.x.to_array(), &[entry[0], entry[1], Field("x")], source)?;
        components::<T>(sphere.v.to_array(), &[entry[0], entry[1], Field("v")], source)
    })
}

fn refuse_wall(index: usize, wall: &Wall, source: Source) -> Result<(), Error> {
    let at = |field| [Field("walls"), Index(index), Field(field)];
    vector(wall.shape.center, &at("center"), source)?;
    vector(wall.shape.s1, &at("s1"), source)?;
    vector(wall.shape.s2, &at("s2"), source)?;
    color(wall.color, &at("color"), source)
}

fn refuse_sphere(index: usize, sphere: &Sphere, source: Source) -> Result<(), Error> {
    let at = |field| [Field("spheres"), Index(index), Field(field)];
    number::<Positive>(sphere.mass, &at("mass"), source)?;
    number::<Positive>(sphere.radius, &at("radius"), source)?;
    vector(sphere.force, &at("force"), source)?;
    color(sphere.color, &at("color"), source)?;
    sphere.name.as_ref().map_or(Ok(()), |name| text(name, &at("name"), source))
}

fn number<T: TryFrom<f64, Error = String>>(value: f64, path: &[Step], source: Source) -> Result<(), Error> {
    T::try_from(value).map(drop).map_err(|message| source.refuse(path, message))
}

fn vector(value: DVec3, path: &[Step], source: Source) -> Result<(), Error> {
    components::<Number>(value.to_array(), path, source)
}

fn color(value: Option<Color>, path: &[Step], source: Source) -> Result<(), Error> {
    value.map_or(Ok(()), |value| components::<Fraction>(value, path, source))
}

fn components<T: TryFrom<f64, Error = String>>(value: [f64; 3], path: &[Step], source: Source) -> Result<(), Error> {
    value.into_iter().enumerate().try_for_each(|(axis, value)| {
        let refused = |message| source.refuse(&[path, &[Index(axis)]].concat(), message);
        T::try_from(value).map(drop).map_err(refused)
    })
}

fn text(value: &str, path: &[Step], source: Source) -> Result<(), Error> {
    Text::try_from(value.to_owned()).map(drop).map_err(|message| source.refuse(path, message))
}
