//! How long a teacher waits for a class: a thousand trajectories of 20 s, by `paper` at steps that all differ, marked side by side
//! on all cores. `cargo bench --bench class`

// Results go to stdout: this is a program for people.
#![allow(clippy::print_stdout)]

use std::fmt::Write as _;
use std::io::{Cursor, Read};
use std::time::Instant;

use carom::export::{Columns, States};
use carom::marks::{Exam, mark_all};
use carom::physics::{Method, Settings, Simulation};
use carom::scene::{self, Scene};

/// Trajectories of a class.
const CLASS: usize = 1000;

/// Trajectories that differ; each is marked so often that there are [`CLASS`].
const DIFFERENT: usize = 20;

/// Time between two rows of a sphere, s.
const EVERY: f64 = 0.01;

fn main() {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    println!("scene      files  bytes each  certificate s  marks s  cores {cores}");
    for name in ["paper-1", "paper-3", "bouncing-49"] {
        let scene = scene::open(name).expect("built in").scene;
        let files: Vec<String> = (0..DIFFERENT).map(|k| rows(&scene, 1e-2 / (1.0 + 0.05 * k as f64))).collect();
        let start = Instant::now();
        let exam = Exam::new(&scene, scene.duration, Some(1e-3), &|| true).expect("it is not interrupted");
        let certificate = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let marked = mark_all(CLASS, cores, |index| {
            let reader: Box<dyn Read + Send> = Box::new(Cursor::new(files[index % DIFFERENT].clone()));
            let source = States::new(reader, &Columns::default(), exam.spheres()).expect("rows");
            (index.to_string(), exam.mark(source, &|| true))
        });
        let marks = start.elapsed().as_secs_f64();
        let marked = marked.map_or(0, |marked| marked.len());
        println!("{name:<11} {marked:>4} {:>11} {certificate:>14.2} {marks:>8.2}", files[0].len());
    }
}

/// A run by `paper` with this step, s, as rows.
fn rows(scene: &Scene, dt: f64) -> String {
    let mut run = Simulation::new(scene, Settings { method: Method::Paper, dt, tolerance: 1e-3 });
    let mut text = String::from("time,sphere,x,y,z,vx,vy,vz\n");
    for k in 0..=(scene.duration / EVERY).round() as u64 {
        let t = k as f64 * EVERY;
        run.run_to(t, |_| Some(Simulation::SLICE));
        if run.time() < t {
            break; // it cannot go on
        }
        let state = run.at(t);
        for (i, (x, v)) in state.x.iter().zip(&state.v).enumerate() {
            writeln!(text, "{t:?},{i},{:?},{:?},{:?},{:?},{:?},{:?}", x.x, x.y, x.z, v.x, v.y, v.z).expect("memory");
        }
    }
    text
}
