//! What a collision costs the event-driven method, from a thousand to a million spheres, and what its energy does.
//!
//! An elastic gas in a box as the scene file's `Gas` strews it, after some collisions per sphere to forget the start;
//! once more with gravity. Events are collisions, crossings of cells and plans that were stale.
//! Times are CPU time where the system tells it (Linux), else wall time; the best of several blocks counts, the spread
//! beside it says how much the machine was shared. Only numbers of one run compare.
//!
//! `cargo bench --bench gas`, and `cargo bench --bench gas -- million` for 10⁶ spheres too.

// Results go to stdout: this is a program for people.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use carom::physics::{Class, Method, Progress, Scene, Settings, Simulation, State, Until};

/// Frames of 0.01 s: that they end costs nothing worth mentioning.
const EXACT: Settings = Settings { method: Method::Exact, dt: 0.01, tolerance: 1e-3 };

/// Events a slice, as a program that draws in between would ask for.
const SLICE: u64 = 10_000;

fn main() {
    let million = std::env::args().any(|argument| argument == "million");
    println!("elastic gas in a box: best (and worst) block of collisions");
    println!(
        "  packing  spheres   collisions/s           ns each  events each  ns an event  collisions each  |dE/E|    \
         bytes per sphere"
    );
    for packing in [0.1, 0.3] {
        let mut first = None;
        for (count, warm, blocks) in [(1000, 40, 7), (10_000, 20, 5), (100_000, 8, 3), (1_000_000, 1, 2)] {
            if count < 1_000_000 || million {
                let each = measure(&gas(packing, count, 0.0), packing, warm, blocks);
                println!("{:>123}", format!("{:.2} times the first", each / *first.get_or_insert(each)));
            }
        }
    }
    println!("the same under gravity");
    for packing in [0.1, 0.3] {
        measure(&gas(packing, 10_000, -9.8), packing, 20, 5);
    }
    swept_beside_exact();
    println!("scenes that others have measured");
    energy_of_666();
    bouncing_49();
    for k in 0..5 {
        let (best, worst, _) = timed_run(&open(&format!("paper-{k}")), 20.0, 5);
        println!("  paper-{k}, 20 s: {best:.3} ms of CPU (worst {worst:.3})");
    }
}

/// A gas of spheres of radius 0.1 m that fill this share of a cube, pulled by so much along y, m/s².
fn gas(packing: f64, count: usize, pull: f64) -> Scene {
    let volume = count as f64 * std::f64::consts::PI / 750.0;
    let half = 0.5 * (volume / packing).cbrt();
    let text = format!(
        "Scene(name: \"gas\", gravity: (0, {pull}, 0), contact: (restitution: 1, tangential: 1, rest_speed: 0), \
         walls: [Room(min: (-{half}, -{half}, -{half}), max: ({half}, {half}, {half}))], \
         spheres: [Gas(min: (-{half}, -{half}, -{half}), max: ({half}, {half}, {half}), \
         count: {count}, seed: 7, speed: 1, mass: 1, radius: 0.1)])"
    );
    carom::scene::parse(&text, "gas").expect("a valid scene")
}

fn open(name: &str) -> Scene {
    carom::scene::open(name).expect("a built-in scene").scene
}

/// Prints a line on one gas; nanoseconds per collision of its best block.
fn measure(scene: &Scene, packing: f64, warm: u64, blocks: usize) -> f64 {
    let (mut run, count) = (Simulation::new(scene, EXACT), scene.spheres.len());
    collide(&mut run, warm * count as u64);
    let block = (4 * count as u64).clamp(200_000, 1_500_000);
    let mut costs = Vec::new();
    let (mut events, before) = (0, run.tallies().impacts);
    for _ in 0..blocks {
        let (start, impacts) = (cpu_seconds(), run.tallies().impacts);
        events += collide(&mut run, block);
        costs.push((cpu_seconds() - start) / (run.tallies().impacts - impacts) as f64);
    }
    costs.sort_by(f64::total_cmp);
    let (best, worst, impacts) = (costs[0], costs[blocks - 1], run.tallies().impacts);
    let each = events as f64 / (impacts - before) as f64;
    let drift = (energy(&run.state(), scene) / energy(&run.model().initial, scene) - 1.0).abs();
    println!(
        "  {packing:>7}  {count:>7}   {:>9.0} ({:>9.0})  {:>7.0}  {each:>11.2}  {:>11.0}  {:>15.0}  {drift:>6.0e}  {:>18}",
        1.0 / best,
        1.0 / worst,
        1e9 * best,
        1e9 * best / each,
        2.0 * impacts as f64 / count as f64,
        bytes(&run).map_or("unknown".into(), |bytes| format!("{:.0}", bytes / count as f64)),
    );
    1e9 * best
}

/// What a simulated second costs `swept`, and how many times what it costs `exact`.
fn swept_beside_exact() {
    println!("swept, packing 0.1, frames of 0.01 s");
    for (count, span, rounds) in [(1000, 10.0, 5), (10_000, 1.0, 5)] {
        let scene = gas(0.1, count, 0.0);
        let by_exact = per_second(&scene, EXACT, span, rounds);
        for tolerance in [1e-3, 1e-6, 1e-12] {
            let swept = per_second(&scene, Settings { method: Method::Swept, dt: 0.01, tolerance }, span, rounds);
            println!(
                "  {count:>7} spheres, tolerance {tolerance:e}: {:.1} ms of CPU per simulated second (worst {:.1}), {:.2} times exact's {:.1} ms",
                1e3 * swept.0,
                1e3 * swept.1,
                swept.0 / by_exact.0,
                1e3 * by_exact.0
            );
        }
    }
}

/// Best and worst CPU time per simulated second of some stretches of a run, s.
fn per_second(scene: &Scene, settings: Settings, span: f64, rounds: usize) -> (f64, f64) {
    let mut run = Simulation::new(scene, settings);
    run.advance(Until::Time(span), u64::MAX);
    let mut costs = Vec::new();
    for _ in 0..rounds {
        let (start, from) = (cpu_seconds(), run.time());
        run.advance(Until::Time(from + span), u64::MAX);
        costs.push((cpu_seconds() - start) / (run.time() - from));
    }
    costs.sort_by(f64::total_cmp);
    (costs[0], costs[rounds - 1])
}

/// Goes on for so many impacts (pairs and walls); how many events that took: impacts, crossings, stale plans.
fn collide(run: &mut Simulation, impacts: u64) -> u64 {
    let (goal, frames, mut turns) = (run.tallies().impacts + impacts, run.tallies().frames, 0);
    while run.tallies().impacts < goal {
        assert_eq!(run.advance(Until::Time(f64::INFINITY), SLICE), Progress::Yielded);
        turns += SLICE;
    }
    turns - (run.tallies().frames - frames)
}

/// Σ ½ v² − g·x with a compensated sum: the ordinary one would show its own rounding at a million spheres.
fn energy(state: &State, scene: &Scene) -> f64 {
    let (mut sum, mut lost) = (0.0, 0.0);
    for (x, v) in state.x.iter().zip(&state.v) {
        let term: f64 = 0.5 * v.length_squared() - scene.gravity.dot(*x) - lost;
        let next: f64 = sum + term;
        (lost, sum) = ((next - sum) - term, next);
    }
    sum
}

/// What a run holds, model included, as the growth of this process by copies of it; where the system tells it.
fn bytes(run: &Simulation) -> Option<f64> {
    let (mut copies, mut most) = (Vec::new(), 0.0_f64);
    // the first copies may go where something else was before
    while copies.len() < 5 {
        let before = resident_bytes()?;
        copies.push(run.clone());
        most = most.max(resident_bytes()? - before);
    }
    std::hint::black_box(&copies);
    (run.model().len() >= 10_000).then_some(most)
}

fn resident_bytes() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().trim_end_matches(" kB").parse::<f64>().ok().map(|kib| 1024.0 * kib)
}

/// CPU time of this thread, s, or wall time where the system does not tell.
fn cpu_seconds() -> f64 {
    thread_local!(static START: Instant = Instant::now());
    let cpu = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = cpu.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| START.with(|start| start.elapsed().as_secs_f64()), |ns| 1e-9 * ns)
}

/// Best and worst CPU time, ms, of some runs of a scene for so long, s; and its impacts.
fn timed_run(scene: &Scene, until: f64, rounds: usize) -> (f64, f64, usize) {
    let (mut times, mut impacts) = (Vec::new(), 0);
    for _ in 0..rounds {
        let (start, mut count) = (cpu_seconds(), 0.0);
        let mut run = Simulation::new(scene, EXACT);
        // many times if short: the system counts CPU time in ticks of some milliseconds
        while cpu_seconds() - start < 0.1 {
            run = Simulation::new(scene, EXACT);
            run.record_events(true);
            run.advance(Until::Time(until), u64::MAX);
            count += 1.0;
        }
        times.push(1e3 * (cpu_seconds() - start) / count);
        let counts = |e: &carom::physics::Contact| e.class == Class::Collide && e.time <= until;
        impacts = run.take_events().iter().filter(|e| counts(e)).count();
    }
    times.sort_by(f64::total_cmp);
    (times[0], times[rounds - 1], impacts)
}

/// Mean squared energy error, J², at this many equidistant times.
fn squared_error(scene: &Scene, until: f64, samples: u32) -> f64 {
    let mut run = Simulation::new(scene, EXACT);
    let error = |k: u32| {
        let t = until * f64::from(k) / f64::from(samples);
        run.advance(Until::Time(t), u64::MAX);
        let error = run.at(t).energy(run.model()) - run.initial_energy();
        error * error
    };
    (1..=samples).map(error).sum::<f64>() / f64::from(samples)
}

fn energy_of_666() {
    let scene = open("elastic-666");
    let (best, worst, impacts) = timed_run(&scene, 10.0, 5);
    let error = squared_error(&scene, 10.0, 1000);
    println!(
        "  elastic-666, 10 s: {best:.2} ms of CPU (worst {worst:.2}), {impacts} impacts, mean squared energy error {error:.1e} J²"
    );
}

fn bouncing_49() {
    let scene = open("bouncing-49");
    let (best, worst, impacts) = timed_run(&scene, 20.0, 5);
    let error = squared_error(&scene, 20.0, 1000);
    println!(
        "  bouncing-49, 20 s: {best:.3} ms of CPU (worst {worst:.3}), {impacts} impacts, mean squared energy error {error:.1e} J²"
    );
}
