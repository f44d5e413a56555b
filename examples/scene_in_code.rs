//! A scene built in code, and why each contact rests in the end: `cargo run --example scene_in_code`.
#![expect(clippy::print_stdout, reason = "an example tells what it found")]

use carom::geometry::Parallelogram;
use carom::physics::{Class, Simulation};
use carom::scene::{Draft, Method, Settings, Sphere, Wall};
use glam::DVec3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let slope = |up: f64| Wall {
        shape: Parallelogram {
            center: DVec3::new(2.0 * up, 1.0, 0.0),
            s1: DVec3::new(4.0 * up, 2.0, 0.0),
            s2: DVec3::Z * 4.0,
        },
        color: None,
    };
    let ball = Sphere {
        x: DVec3::Y * 3.0,
        v: DVec3::ZERO,
        mass: 1.0,
        radius: 0.5,
        force: DVec3::ZERO,
        color: None,
        name: Some("ball".into()),
    };
    let draft = Draft::new(vec![slope(1.0), slope(-1.0)], vec![ball]);
    let scene = Draft { gravity: DVec3::NEG_Y * 9.8, duration: 60.0, ..draft }.validated()?;
    let mut run = Simulation::new(&scene, Settings { method: Method::Exact, dt: 0.1, tolerance: 1e-6 });
    run.run_to(scene.duration, |_| Some(Simulation::SLICE));
    println!("t = {} s: the ball is at {}, energy {:.3} J", run.time(), run.state().x[0], run.energy());
    for contact in run.contacts().iter().filter(|contact| contact.class == Class::Rest) {
        println!(
            "{:?} carries {:.6} N s in a frame: {:?}",
            contact.key(),
            contact.impulse,
            run.rest_reason(contact.key())
        );
    }
    Ok(())
}
