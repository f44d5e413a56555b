//! What a certificate costs beside the run that it is of: shipped scenes, and a gas of a thousand spheres for ten collisions of each.
//! The goal is fifty times `exact` at most. `cargo bench --bench certify`

// Results go to stdout: this is a program for people.
#![allow(clippy::print_stdout)]

use carom::certify::certify;
use carom::measure::thread_cpu;
use carom::physics::{Class, Kind, Method, Settings, Simulation};
use carom::scene::{self, Scene};

/// A gas that fills a tenth of its box: 5.24 m³ for a thousand spheres of radius 0.05 m.
const GAS: &str = "Scene(name: \"gas\", contact: (restitution: 1, tangential: 1, rest_speed: 0), duration: 0.6, \
    walls: [Room(min: (0, 0, 0), max: (1.737, 1.737, 1.737))], \
    spheres: [Gas(min: (0, 0, 0), max: (1.737, 1.737, 1.737), count: 1000, seed: 3, speed: 1, mass: 1, radius: 0.05)])";

/// Each is timed so often; the least counts.
const TIMES: usize = 3;

fn main() {
    println!("scene          until s  collisions  of a sphere   exact ms  certificate ms  ratio  error m");
    for name in ["paper-0", "paper-1", "paper-2", "paper-3", "paper-4", "billiard", "bouncing-49", "elastic-666"] {
        row(name, &scene::open(name).expect("built in").scene);
    }
    let gas = scene::parse(GAS, "gas").expect("a gas");
    row("gas of 1000", &gas);
}

fn row(name: &str, scene: &Scene) {
    let mut certificate = None;
    let whole = least(|| certificate = certify(scene, scene.duration, &|| true));
    let certificate = certificate.expect("it is not interrupted");
    let settings = Settings { method: Method::Exact, dt: scene.duration, tolerance: 0.0 };
    let mut collisions = 0;
    let exact = least(|| {
        let mut run = Simulation::new(scene, settings);
        run.record_events(true);
        run.run_to(certificate.until, |_| Some(Simulation::SLICE));
        let pairs = run.take_events().into_iter().filter(|row| row.class == Class::Collide && row.kind == Kind::Pair);
        collisions = pairs.filter(|row| row.time <= certificate.until).count();
    });
    let each = 2.0 * collisions as f64 / scene.spheres.len() as f64;
    println!(
        "{name:<13} {:>8.3} {collisions:>11} {each:>12.1} {:>10.2} {:>15.1} {:>6.1} {:>8.1e}",
        certificate.until,
        exact * 1e3,
        whole * 1e3,
        whole / exact,
        certificate.error
    );
}

/// The least processor time of some runs, s.
fn least(mut run: impl FnMut()) -> f64 {
    let time = |_| {
        let start = thread_cpu();
        run();
        thread_cpu() - start
    };
    (0..TIMES).map(time).fold(f64::INFINITY, f64::min)
}
