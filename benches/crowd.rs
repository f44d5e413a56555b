//! What a settling crowd costs `moreau`, and how little it overlaps: `inelastic-666` for 10 s.
//!
//! Penetrations are measured here, over all pairs and the ground, from the states at the ends of all frames. CPU time as
//! the system tells it (Linux), else wall time, of a run of its own; the best of several counts. Rows solved and gaps
//! computed are counted: they mean the same on any machine.
//!
//! And what fifty and three hundred inelastic spheres cost `exact` that fall into a box: there it is the wrong method, and this
//! says by how much.
//!
//! `cargo bench --bench crowd`, and `cargo bench --bench crowd -- DT TOLERANCE` for other settings.

// Results go to stdout: this is a program for people.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use carom::physics::{Class, Kind, Method, Scene, Settings, Simulation, Until};

fn main() {
    let arguments: Vec<f64> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let scene = open("inelastic-666");
    println!("inelastic-666, 10 s: penetration over pairs and ground at the ends of frames, gaps of resting contacts");
    println!(
        "    dt  tolerance  CPU, s (worst)  mean Σ pen², m²  deepest, m  widest gap, m  rows solved  gaps computed  unconverged"
    );
    let given = scene.solver;
    match arguments[..] {
        [dt, tolerance] => measure(&scene, Settings { method: Method::Moreau, dt, tolerance }),
        _ => {
            measure(&scene, given);
            for (dt, tolerance) in [(1e-2, 1e-3), (1e-2, 1e-6), (1e-2, 1e-10), (1e-3, 1e-3), (1e-3, 1e-8)] {
                measure(&scene, Settings { method: Method::Moreau, dt, tolerance });
            }
        }
    }
    println!("elastic scenes: largest error of the energy at the ends of frames, relative");
    for (name, until) in [("elastic-666", 10.0), ("bouncing-49", 20.0)] {
        for dt in [1e-2, 1e-3] {
            energy(name, until, dt);
        }
    }
    println!("spheres that fall into a box, by exact: CPU, s, and impacts of each half second");
    for restitution in [0.0, 0.3, 0.6] {
        settling("fifty", (5, 2, 0.7), restitution, &[0.5, 1.0]);
    }
    settling("three hundred", (10, 3, 1.6), 0.3, &[0.5]);
}

/// Prints what a block of `wide` × `high` × `wide` spheres, the outermost `half` (m) off the middle, cost `exact` that come to
/// rest on each other, from each of some times (s) to the next.
fn settling(name: &str, (wide, high, half): (u32, u32, f64), restitution: f64, times: &[f64]) {
    let room = half + 0.2;
    let text = format!(
        "Scene(name: \"{name}\", gravity: (0, -9.8, 0), contact: (restitution: {restitution:?}, tangential: 1, rest_speed: 0),
         walls: [Room(min: (-{room:?}, 0, -{room:?}), max: ({room:?}, 3, {room:?}))],
         spheres: [Lattice(origin: (-{half:?}, 0.3, -{half:?}), counts: ({wide}, {high}, {wide}), spacing: 0.35, jitter: 0.02, seed: 1, mass: 1, radius: 0.15)])"
    );
    let scene = carom::scene::parse(&text, name).expect("a scene within the rules");
    let mut run = Simulation::new(&scene, Settings { method: Method::Exact, ..scene.solver });
    print!("  {name}, e = {restitution}:");
    for &t in times {
        let (start, before) = (cpu_seconds(), run.tallies().impacts);
        run.advance(Until::Time(t), u64::MAX);
        print!("  {:.2} s, {} impacts", cpu_seconds() - start, run.tallies().impacts - before);
    }
    println!();
}

fn open(name: &str) -> Scene {
    carom::scene::open(name).expect("a built-in scene").scene
}

/// Prints a line on one setting.
fn measure(scene: &Scene, settings: Settings) {
    let mut times: Vec<f64> = (0..5).map(|_| timed(scene, settings)).collect();
    times.sort_by(f64::total_cmp);
    let mut run = Simulation::new(scene, settings);
    let (mut squares, mut deepest) = (0.0, 0.0_f64);
    while run.time() < 10.0 {
        run.advance(Until::Frame, u64::MAX);
        let (sum, most) = penetration(scene, &run);
        (squares, deepest) = (squares + sum, deepest.max(most));
    }
    let tallies = run.tallies();
    println!(
        "{:>6.0e}  {:>9.0e}  {:.3} ({:.3})   {:>15.1e}  {deepest:>10.1e}  {:>13.1e}  {:>11}  {:>13}  {} of {}",
        settings.dt,
        settings.tolerance,
        times[0],
        times[4],
        squares / tallies.frames as f64,
        widest_gap(&run),
        tallies.relaxations,
        tallies.evaluations,
        tallies.unconverged,
        tallies.frames,
    );
}

/// CPU time of 10 s, s.
fn timed(scene: &Scene, settings: Settings) -> f64 {
    let start = cpu_seconds();
    let mut run = Simulation::new(scene, settings);
    run.advance(Until::Time(10.0), u64::MAX);
    std::hint::black_box(run.time());
    cpu_seconds() - start
}

/// Σ penetration² over pairs and walls, m², and the deepest penetration, m.
fn penetration(scene: &Scene, run: &Simulation) -> (f64, f64) {
    let state = run.state();
    let (mut sum, mut deepest) = (0.0, 0.0_f64);
    let mut add = |gap: f64| {
        let depth = (-gap).max(0.0);
        sum += depth * depth;
        deepest = deepest.max(depth);
    };
    for (i, body) in scene.spheres.iter().enumerate() {
        scene.walls.iter().for_each(|wall| add(wall.shape.distance(state.x[i]) - body.radius));
        for (j, other) in scene.spheres.iter().enumerate().skip(i + 1) {
            add(state.x[i].distance(state.x[j]) - (body.radius + other.radius));
        }
    }
    (sum, deepest)
}

/// Widest gap between what rests on each other at the end, m.
fn widest_gap(run: &Simulation) -> f64 {
    let radii = &run.model().radii;
    let size = |a: usize, b: usize, kind| radii[a] + if kind == Kind::Pair { radii[b] } else { 0.0 };
    let rests = run.contacts().iter().filter(|contact| contact.class == Class::Rest);
    rests.map(|c| -c.degree * size(c.a, c.b, c.kind)).fold(f64::NEG_INFINITY, f64::max)
}

/// Prints how well an elastic scene keeps its energy.
fn energy(name: &str, until: f64, dt: f64) {
    let scene = open(name);
    let mut run = Simulation::new(&scene, Settings { method: Method::Moreau, dt, tolerance: 1e-6 });
    let (mut least, mut most) = (0.0_f64, 0.0_f64);
    while run.time() < until {
        run.advance(Until::Frame, u64::MAX);
        let error = run.energy() / run.initial_energy() - 1.0;
        (least, most) = (least.min(error), most.max(error));
    }
    let end = run.energy() / run.initial_energy() - 1.0;
    let tallies = run.tallies();
    println!(
        "  {name}, dt {dt:.0e}: {least:+.1e} … {most:+.1e}, at the end {end:+.1e}, {} impacts, {} of {} frames unconverged",
        tallies.impacts, tallies.unconverged, tallies.frames,
    );
}

/// CPU time of this thread, s, or wall time where the system does not tell.
fn cpu_seconds() -> f64 {
    thread_local!(static START: Instant = Instant::now());
    let cpu = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = cpu.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| START.with(|start| start.elapsed().as_secs_f64()), |ns| 1e-9 * ns)
}
