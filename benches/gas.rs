//! Collisions per second and energy drift of the event-driven method: an elastic gas in a box, one core.
//!
//! `cargo bench --bench gas` runs N = 10³, 10⁴, 10⁵ at packing 0.1 and 0.3; `cargo bench --bench gas -- 1000000` other N;
//! `-- gravity` adds uniform gravity. Wall time of this process alone: compare ratios of one run on a busy machine.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use carom::geometry::{Bounds, Parallelogram};
use carom::physics::{Method, Scene, Settings, Simulation, Until};
use carom::scene::{ContactLaw, Sphere, Wall};
use glam::{DVec3, dvec3};

/// SplitMix64, u in [0, 1).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Sum of twelve uniforms less six: nearly normal, of variance 1.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.unit()).sum::<f64>() - 6.0
    }
}

fn walls(side: f64) -> Vec<Wall> {
    let (c, s) = (DVec3::splat(0.5 * side), side);
    [DVec3::X, DVec3::Y, DVec3::Z]
        .into_iter()
        .flat_map(|n| {
            let (s1, s2) = (DVec3::new(n.y, n.z, n.x) * s, DVec3::new(n.z, n.x, n.y) * s);
            [-0.5, 0.5].map(|k| Wall { shape: Parallelogram { center: c + n * (k * s), s1, s2 }, color: None })
        })
        .collect()
}

/// `count` spheres of radius 0.5 m and mass 1 kg on a cubic lattice that fills a box to `packing`.
fn gas(count: usize, packing: f64, gravity: DVec3) -> Scene {
    let volume = count as f64 * std::f64::consts::PI / 6.0 / packing;
    let side = volume.cbrt();
    let per_side = (count as f64).cbrt().ceil() as usize;
    let step = side / per_side as f64;
    let random = &mut Random(7);
    let place = |i: usize| {
        let at = |k: usize| (k as f64 + 0.5) * step;
        dvec3(at(i % per_side), at(i / per_side % per_side), at(i / per_side / per_side))
    };
    let spheres = (0..count)
        .map(|i| {
            let v = dvec3(random.normal(), random.normal(), random.normal());
            Sphere { x: place(i), v, mass: 1.0, radius: 0.5, force: DVec3::ZERO, color: None, name: None }
        })
        .collect();
    let contact = ContactLaw { restitution: 1.0, wall_restitution: 1.0, tangential: 1.0, rest_speed: 0.0 };
    let solver = Settings { method: Method::Exact, dt: 1e9, tolerance: 1e-3 };
    let view = Bounds { min: DVec3::ZERO, max: DVec3::splat(side) };
    let (name, about) = (String::from("gas"), String::new());
    Scene { name, about, gravity, contact, solver, duration: 1.0, view, walls: walls(side), spheres }
}

fn measure(count: usize, packing: f64, gravity: DVec3) {
    let scene = gas(count, packing, gravity);
    let mut run = Simulation::new(&scene, scene.solver);
    let collisions = |run: &Simulation| run.tallies().impacts;
    // 20 collisions a sphere melt the lattice
    let go = |run: &mut Simulation, impacts: u64| {
        let goal = collisions(run) + impacts;
        while collisions(run) < goal {
            run.advance(Until::Frame, u64::MAX);
        }
    };
    go(&mut run, 10 * count as u64);
    let (before, began) = (collisions(&run), Instant::now());
    go(&mut run, (20 * count as u64).clamp(500_000, 3_000_000));
    let (done, seconds) = (collisions(&run) - before, began.elapsed().as_secs_f64());
    let drift = run.energy() / run.initial_energy() - 1.0;
    let rate = done as f64 / seconds / 1e6;
    println!(
        "N {count:>7}  packing {packing}  {rate:.3} million collisions/s  {done} collisions  energy drift {drift:+.1e}"
    );
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let gravity = if arguments.iter().any(|a| a == "gravity") { dvec3(0.0, -1e-2, 0.0) } else { DVec3::ZERO };
    let mut sizes: Vec<usize> = arguments.iter().filter_map(|a| a.parse().ok()).collect();
    if sizes.is_empty() {
        sizes = vec![1000, 10_000, 100_000];
    }
    for packing in [0.1, 0.3] {
        for &count in &sizes {
            measure(count, packing, gravity);
        }
    }
}
