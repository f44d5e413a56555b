//! What the scene lacks costs nothing: `paper` against loops written by hand for one scene each.
//!
//! Both sides keep the frame's start, test for overlap at the frame's end and count the degrees they compute. They run
//! interleaved, and the least of many times counts, so that the ratio means something on a busy machine. The scenes
//! have no contacts: what a contact costs is the same physics on both sides. At the end, `paper`'s speed on a box gas.
//!
//! `cargo bench --bench line`

// Results go to stdout: this is a program for people.
#![allow(clippy::print_stdout)]

#[path = "../tests/support/mod.rs"]
mod support;

use std::hint::black_box;
use std::time::Instant;

use carom::physics::overlap::Finder;
use carom::physics::{Model, Scene, Simulation, Until};
use glam::DVec3;
use support::{ELASTIC, G, gas, lattice, paper, room, scene, sphere};

/// Length of a frame, s.
const DT: f64 = 1e-3;

/// Pairs of timings; the least of each side counts.
const ROUNDS: usize = 500;

/// Blocks of the speed measurement.
const BLOCKS: usize = 500;

fn main() {
    println!("scene                              paper, ns   by hand, ns   ratio   (per sphere and frame)");
    let far = room(DVec3::splat(-1e6), DVec3::splat(1e6));
    let slow = |spacing: f64, v: DVec3| lattice(10, spacing, v, 0.1);
    let no_gravity = scene(DVec3::ZERO, ELASTIC, far.clone(), slow(0.5, DVec3::X));
    compare("no gravity: 1000 in a box", &no_gravity, 10, straight);
    let no_walls = scene(G, ELASTIC, Vec::new(), slow(5.0, DVec3::X));
    compare("no walls: 1000 far apart, falling", &no_walls, 10, falling);
    let one = vec![sphere(DVec3::ZERO, DVec3::X, 0.5)];
    compare("no pairs: one sphere in a room", &scene(G, ELASTIC, far, one.clone()), 100_000, one_in_a_room);
    compare("nothing to hit: one in free flight", &scene(G, ELASTIC, Vec::new(), one), 100_000, one_in_flight);
    println!();
    for n in [1_000, 10_000] {
        speed(n);
    }
}

/// The least time of `paper` and of a loop by hand over so many frames.
fn compare(name: &str, scene: &Scene, frames: usize, by_hand: fn(&mut Hand, usize)) {
    let mut run = Simulation::new(scene, paper(DT, 1e-3));
    let mut hand = Hand::new(scene);
    let (mut ours, mut theirs) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..ROUNDS {
        let goal = run.time() + (frames as f64 - 0.5) * DT;
        ours = ours.min(seconds(|| {
            black_box(run.advance(Until::Time(goal), u64::MAX));
        }));
        theirs = theirs.min(seconds(|| by_hand(black_box(&mut hand), frames)));
    }
    assert_eq!(run.state().x, hand.end.0, "{name}: both sides compute the same");
    assert_eq!(run.tallies().impacts + hand.touched, 0, "{name}: nothing touches");
    assert_eq!(run.tallies().evaluations, hand.evaluations, "{name}: both sides count the same");
    let per = 1e9 / (frames * scene.spheres.len()) as f64;
    println!("{name:<35}{:>9.2}{:>14.2}{:>8.3}", ours * per, theirs * per, ours / theirs);
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// Sphere-steps per second of `paper` on an elastic gas of `n` in a box, trial steps included: the best and the middle
/// of many short blocks, since longer ones measure the machine's other users too.
fn speed(n: usize) {
    let mut run = Simulation::new(&gas(n, 7, 1.0), paper(DT, 1e-3));
    let (mut steps, mut time, mut rates) = (0, 0.0, Vec::new());
    while rates.len() < BLOCKS {
        let before = run.tallies();
        time += seconds(|| {
            black_box(run.advance(Until::Frame, u64::MAX));
        });
        let after = run.tallies();
        steps += (after.frames + after.probes - before.frames - before.probes) * n as u64;
        if steps >= 20_000 {
            rates.push(steps as f64 / time);
            (steps, time) = (0, 0.0);
        }
    }
    rates.sort_by(f64::total_cmp);
    let (best, middle, t) = (rates[BLOCKS - 1], rates[BLOCKS / 2], run.tallies());
    println!(
        "gas of {n:>6}: {best:.2e} sphere-steps/s at best, {middle:.2e} in the middle ({} frames, {} trial steps, {} impacts)",
        t.frames, t.probes, t.impacts,
    );
}

/// What the loops by hand work on: start and end of the frame, and what each needs.
struct Hand {
    start: (Vec<DVec3>, Vec<DVec3>),
    end: (Vec<DVec3>, Vec<DVec3>),
    radius: f64,
    walls: Vec<(DVec3, DVec3)>,
    /// The scene without its walls, which are tested by hand: for the neighbour search.
    model: Model,
    finder: Finder,
    t: f64,
    touched: u64,
    evaluations: u64,
    /// Numbers of the scene, which no compiler knows: gravity, m/s², and the length of a frame, s.
    g: DVec3,
    dt: f64,
}

impl Hand {
    fn new(scene: &Scene) -> Hand {
        let evaluations = Simulation::new(scene, paper(DT, 1e-3)).tallies().evaluations;
        let model = Model::new(&scene.changed(|draft| draft.walls.clear()).expect("fewer walls break no rule"));
        let state = (model.initial.x.clone(), model.initial.v.clone());
        Hand {
            start: state.clone(),
            end: state,
            radius: scene.spheres[0].radius,
            walls: scene.walls.iter().map(|w| (w.shape.center, w.shape.normal())).collect(),
            finder: Finder::new(&model),
            model,
            t: 0.0,
            touched: 0,
            evaluations,
            g: black_box(scene.gravity),
            dt: black_box(DT),
        }
    }

    fn meet_walls(&mut self) {
        for (x, radius) in self.end.0.iter().zip(&self.model.radii) {
            for (center, normal) in &self.walls {
                if (*x - *center).dot(*normal).abs() <= *radius {
                    self.touched += 1;
                }
            }
        }
        self.evaluations += (self.end.0.len() * self.walls.len()) as u64;
    }

    fn meet_each_other(&mut self) {
        let Hand { start, end, model, finder, .. } = self;
        finder.begin();
        finder.walls(model, &start.0, &end.0, 0..end.0.len());
        while !finder.pairs(model, &end.0).0 {}
        self.touched += finder.found.len() as u64;
        self.evaluations += finder.evaluations;
    }
}

/// No gravity: velocities never change.
fn straight(hand: &mut Hand, frames: usize) {
    let dt = hand.dt;
    for _ in 0..frames {
        std::mem::swap(&mut hand.start.0, &mut hand.end.0);
        for ((x1, x0), v) in hand.end.0.iter_mut().zip(&hand.start.0).zip(&hand.start.1) {
            *x1 = *x0 + *v * dt;
        }
        hand.t += dt;
        hand.meet_walls();
        hand.meet_each_other();
    }
}

/// Gravity and no walls.
fn falling(hand: &mut Hand, frames: usize) {
    let (g, dt) = (hand.g, hand.dt);
    for _ in 0..frames {
        std::mem::swap(&mut hand.start, &mut hand.end);
        let (start, end) = (&hand.start, &mut hand.end);
        for i in 0..end.0.len() {
            end.1[i] = start.1[i] + g * dt;
            end.0[i] = start.0[i] + end.1[i] * dt;
        }
        hand.t += dt;
        hand.meet_each_other();
    }
}

/// One sphere and six walls, in local variables.
fn one_in_a_room(hand: &mut Hand, frames: usize) {
    let (g, dt) = (hand.g, hand.dt);
    let (mut x, mut v, mut t) = (hand.end.0[0], hand.end.1[0], hand.t);
    let mut start = (x, v);
    for _ in 0..frames {
        start = (x, v);
        v += g * dt;
        x += v * dt;
        t += dt;
        for (center, normal) in &hand.walls {
            hand.touched += u64::from((x - *center).dot(*normal).abs() <= hand.radius);
        }
    }
    hand.evaluations += (frames * hand.walls.len()) as u64;
    (hand.start.0[0], hand.start.1[0]) = start;
    (hand.end.0[0], hand.end.1[0], hand.t) = (x, v, t);
}

/// One sphere and nothing to hit, in local variables.
fn one_in_flight(hand: &mut Hand, frames: usize) {
    let (g, dt) = (hand.g, hand.dt);
    let (mut x, mut v, mut t) = (hand.end.0[0], hand.end.1[0], hand.t);
    let mut start = (x, v);
    for _ in 0..frames {
        start = (x, v);
        v += g * dt;
        x += v * dt;
        t += dt;
    }
    (hand.start.0[0], hand.start.1[0]) = start;
    (hand.end.0[0], hand.end.1[0], hand.t) = (x, v, t);
}
