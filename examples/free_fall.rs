//! A free fall by every method against the closed form x₀ + v₀ t + g t²/2: `cargo run --example free_fall`.
#![expect(clippy::print_stdout, reason = "an example tells what it found")]

use carom::physics::Simulation;
use carom::scene::{Draft, Method, Settings, Sphere};
use glam::DVec3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (x, v, gravity) = (DVec3::Y * 10.0, DVec3::X, DVec3::NEG_Y * 9.8);
    let sphere = Sphere { x, v, mass: 1.0, radius: 0.5, force: DVec3::ZERO, color: None, name: None };
    let scene = Draft { gravity, duration: 1.0, ..Draft::new(Vec::new(), vec![sphere]) }.validated()?;
    for method in [Method::Paper, Method::Moreau, Method::Swept, Method::Exact] {
        let mut run = Simulation::new(&scene, Settings { method, dt: 1e-3, tolerance: 1e-6 });
        run.run_to(scene.duration, |_| Some(Simulation::SLICE));
        let t = run.time();
        let error = run.state().x[0].distance(x + v * t + gravity * (0.5 * t * t));
        println!("{method:?}: {error:.1e} m off after {t} s");
    }
    Ok(())
}
