//! A scene as a text that holds it to the bit: every number in the shortest digits that read back as the same.

use std::fmt::{Result, Write};

use glam::DVec3;

use super::validated::{Color, Scene, Sphere, Wall};

/// The scene in RON, a body a line. [`parse`](super::parse) makes the same scene of it, if its numbers are in the range of
/// a file's: those of a run may be beyond.
pub fn written(scene: &Scene) -> String {
    let mut text = String::new();
    write(scene, &mut text).expect("writing to memory does not fail");
    text
}

fn write(scene: &Scene, out: &mut String) -> Result {
    let (law, solver) = (&scene.contact, &scene.solver);
    writeln!(out, "Scene(\n    name: {},", quoted(&scene.name))?;
    if !scene.about.is_empty() {
        writeln!(out, "    about: {},", quoted(&scene.about))?;
    }
    writeln!(out, "    gravity: {},", vector(scene.gravity))?;
    writeln!(
        out,
        "    contact: (restitution: {:?}, wall_restitution: {:?}, tangential: {:?}, rest_speed: {:?}),",
        law.restitution, law.wall_restitution, law.tangential, law.rest_speed
    )?;
    let (method, dt, tolerance) = (solver.method.name(), solver.dt, solver.tolerance);
    writeln!(out, "    solver: (method: {method}, dt: {dt:?}, tolerance: {tolerance:?}),")?;
    writeln!(out, "    duration: {:?},", scene.duration)?;
    writeln!(out, "    view: (min: {}, max: {}),", vector(scene.view.min), vector(scene.view.max))?;
    if let Some(resume) = &scene.resume {
        writeln!(out, "    resume: (t: {:?}, transient: [", resume.t)?;
        resume.transient.iter().try_for_each(|row| writeln!(out, "        {},", vector(*row)))?;
        writeln!(out, "    ]),")?;
    }
    writeln!(out, "    walls: [")?;
    scene.walls.iter().try_for_each(|wall| write_wall(wall, out))?;
    writeln!(out, "    ],\n    spheres: [")?;
    scene.spheres.iter().try_for_each(|sphere| write_sphere(sphere, out))?;
    writeln!(out, "    ],\n)")
}

fn write_wall(wall: &Wall, out: &mut String) -> Result {
    let shape = &wall.shape;
    write!(out, "        Wall(center: {}, s1: {}, s2: {}", vector(shape.center), vector(shape.s1), vector(shape.s2))?;
    write_color(wall.color, out)?;
    writeln!(out, "),")
}

fn write_sphere(sphere: &Sphere, out: &mut String) -> Result {
    let Sphere { x, v, mass, radius, force, color, name } = sphere;
    write!(out, "        Sphere(x: {}, v: {}, mass: {mass:?}, radius: {radius:?}", vector(*x), vector(*v))?;
    if *force != DVec3::ZERO {
        write!(out, ", force: {}", vector(*force))?;
    }
    write_color(*color, out)?;
    if let Some(name) = name {
        write!(out, ", name: {}", quoted(name))?;
    }
    writeln!(out, "),")
}

fn write_color(color: Option<Color>, out: &mut String) -> Result {
    match color {
        Some([r, g, b]) => write!(out, ", color: ({r:?}, {g:?}, {b:?})"),
        None => Ok(()),
    }
}

fn vector(v: DVec3) -> String {
    format!("({:?}, {:?}, {:?})", v.x, v.y, v.z)
}

/// A text in quotes; a scene's texts hold no characters that control anything.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

#[cfg(test)]
mod tests {
    use super::super::{builtin, parse, validated::Resume};
    use super::*;

    #[test]
    fn every_scene_reads_back_to_the_bit() {
        for builtin in builtin::ALL {
            let scene = parse(builtin.text, builtin.name).expect("built in");
            let resume = Resume { t: 1.0 / 3.0, transient: vec![DVec3::new(-0.0, 1e-310, 0.1 + 0.2)] };
            let v: Vec<DVec3> = scene.spheres.iter().map(|sphere| sphere.v / 3.0).collect();
            let x: Vec<DVec3> = scene.spheres.iter().map(|sphere| sphere.x).collect();
            let moved = scene.going_on(scene.solver, resume, &x, &v).expect("numbers");
            for scene in [scene, moved] {
                let again = parse(&written(&scene), "again").expect("it is a scene");
                assert_eq!(again, scene, "{}", builtin.name);
                let bits = |scene: &Scene| -> Vec<u64> {
                    let vectors = scene.spheres.iter().flat_map(|sphere| [sphere.x, sphere.v]);
                    let rest = scene.resume.iter().flat_map(|resume| resume.transient.iter().copied());
                    vectors.chain(rest).flat_map(|v| v.to_array()).map(f64::to_bits).collect()
                };
                assert_eq!(bits(&again), bits(&scene), "{}: −0 is not 0", builtin.name);
            }
        }
    }

    #[test]
    fn names_with_quotes_and_backslashes_read_back() {
        let text = r#"Scene(name: "a \"b\" \\ c", spheres: [Sphere(x: (0, 0, 0), mass: 1, radius: 1, name: "\\")])"#;
        let scene = parse(text, "quoted").expect("a scene");
        assert_eq!(parse(&written(&scene), "again").expect("a scene"), scene);
    }
}
