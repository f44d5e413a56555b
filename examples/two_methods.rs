//! How far the method of the source paper is from `exact`, as its frames get shorter: `cargo run --example two_methods`.
#![expect(clippy::print_stdout, reason = "an example tells what it found")]

use carom::measure::Deviation;
use carom::physics::Simulation;
use carom::scene::{self, Method, Scene, Settings};

/// The state at `t` (s) by these settings.
fn state(scene: &Scene, settings: Settings, t: f64) -> carom::physics::State {
    let mut run = Simulation::new(scene, settings);
    run.run_to(t, |_| Some(Simulation::SLICE));
    run.at(t)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = scene::open("paper-1")?.scene;
    let t = 0.5;
    let exact = state(&scene, Settings { method: Method::Exact, dt: 0.1, tolerance: 1e-6 }, t);
    for dt in [1e-2, 1e-3, 1e-4] {
        let paper = state(&scene, Settings { method: Method::Paper, dt, tolerance: 1e-6 }, t);
        let off = Deviation::between(&paper.x, &exact.x);
        println!("dt {dt:.0e} s: {:.1e} m off after {t} s", off.distance);
    }
    Ok(())
}
