//! Thousands of random scenes by the event-driven method: nothing hangs, escapes, gains energy or goes deep.
//!
//! `CAROM_CAMPAIGN=20000 cargo test --release --test campaign -- --nocapture random` is the whole campaign; the ordinary suite
//! runs the first forty of the same scenes. `CAROM_CAMPAIGN_FROM` sets the first seed.

#[path = "support/random.rs"]
mod random;
#[path = "campaign/scenes.rs"]
mod scenes;
mod support;

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};

use scenes::random_scene;

use carom::physics::contact_time::{Part, touch};
use carom::physics::{Class, Kind, Method, Model, Progress, Settings, Simulation, State, Until};
use glam::dvec3;

const EXACT: Settings = Settings { method: Method::Exact, dt: 0.5, tolerance: 1e-3 };

/// Thousands of turns of the method's loop after which a scene of 10 s counts as hanging.
const BUDGET: u64 = 20_000;

/// Thousands of turns from which on a scene is told to have been laborious.
const LABOUR: u64 = 200;

/// How often each thing was met.
#[derive(Default, Debug)]
struct Met {
    impacts: u64,
    faces: u64,
    edges: u64,
    corners: u64,
    pairs: u64,
    rests: u64,
    creases: u64,
    pair_rests: u64,
    edge_rests: u64,
    releases: u64,
    collapses: u64,
    curved: u64,
    curved_time: f64,
    /// Thousands of turns of the method's loop.
    work: u64,
    deepest: f64,
    gain: f64,
    /// Sum of the hashes of the last states, modulo 2⁶⁴: the same on every machine.
    hash: u64,
}

/// Largest −gap / r of the state, walls and pairs.
fn depth(model: &Model, state: &State) -> f64 {
    let mut deepest = f64::NEG_INFINITY;
    for i in 0..model.len() {
        for face in &model.faces {
            deepest = deepest.max(-touch(face, state.x[i], model.radii[i]).gap / model.radii[i]);
        }
        for j in 0..i {
            let reach = model.radii[i] + model.radii[j];
            deepest = deepest.max(1.0 - (state.x[i] - state.x[j]).length() / reach);
        }
    }
    deepest
}

/// Σ of what the energy is made of, each term positive: what rounding is relative to.
fn size(model: &Model, state: &State) -> f64 {
    let of = |i: usize| {
        let (v, x) = (state.v[i], state.x[i]);
        model.masses[i] * (0.5 * v.length_squared() + model.acceleration(i).length() * (x.length() + 1.0))
    };
    (0..model.len()).map(of).sum()
}

/// Runs one scene for so many half seconds and holds it against every oracle; also says how much work it took.
fn check(seed: u64, halves: u32, met: &mut Met) -> Result<(), String> {
    let scene = random_scene(seed);
    let mut run = Simulation::new(&scene, EXACT);
    run.record_events(true);
    let fail = |run: &Simulation, what: String| Err(format!("seed {seed} at t = {}: {what}", run.time()));
    let mut size_most = size(run.model(), &run.state());
    let mut least = run.initial_energy();
    for half in 1..=halves {
        let until = 0.5 * f64::from(half);
        loop {
            met.work += 1;
            if met.work > BUDGET {
                return fail(&run, format!("hangs: {:?}", run.tallies()));
            }
            match run.advance(Until::Time(until), 1000) {
                Progress::Reached => break,
                Progress::Yielded => {}
                Progress::Stalled(stall) => return fail(&run, format!("stalls: {}", stall.reason)),
            }
        }
        let state = run.at(until);
        let (model, deep) = (run.model(), depth(run.model(), &state));
        met.deepest = met.deepest.max(deep);
        if deep > 1e-12 {
            return fail(&run, format!("degree {deep:e}"));
        }
        if let Some(i) = (0..model.len()).find(|&i| {
            let far = (state.x[i] - dvec3(0.0, 5.0, 0.0)).abs().max_element();
            far.is_nan() || far > 5.0
        }) {
            return fail(&run, format!("sphere {i} has escaped to {}", state.x[i]));
        }
        let energy = state.energy(model);
        size_most = size_most.max(size(model, &state));
        let gain = (energy - least) / size_most.max(f64::MIN_POSITIVE);
        met.gain = met.gain.max(gain);
        // an impact changes the energy by some ulp; 1e-12 is a thousand of them
        if gain > 1e-12 {
            return fail(&run, format!("energy rose by {gain:e} from {least} to {energy}"));
        }
        least = least.min(energy);
    }
    met.hash = run.state().hash();
    met.count(&mut run);
    Ok(())
}

impl Met {
    /// Counts what a run met.
    fn count(&mut self, run: &mut Simulation) {
        let mut resting: BTreeSet<(Kind, usize, usize)> = BTreeSet::new();
        for event in &run.take_events() {
            let part = (event.kind == Kind::Wall).then(|| {
                let x = event.point + event.normal * run.model().radii[event.a];
                touch(&run.model().faces[event.b], x, run.model().radii[event.a]).part
            });
            match event.class {
                Class::Collide => {
                    self.impacts += 1;
                    match part {
                        Some(Part::Face) => self.faces += 1,
                        Some(Part::Edge(_)) => self.edges += 1,
                        Some(Part::Corner(_)) => self.corners += 1,
                        None => self.pairs += 1,
                    }
                }
                Class::Rest => {
                    self.rests += 1;
                    resting.insert(event.key());
                    let walls = resting.iter().filter(|key| key.0 == Kind::Wall && key.1 == event.a).count();
                    match part {
                        None => self.pair_rests += 1,
                        Some(Part::Face) if walls >= 2 => self.creases += 1,
                        Some(Part::Face) => {}
                        Some(_) => self.edge_rests += 1,
                    }
                }
                Class::Release => {
                    self.releases += 1;
                    resting.remove(&event.key());
                }
                Class::Leave => {}
            }
        }
        self.collapses += run.tallies().collapses;
        self.curved += u64::from(run.tallies().inexact_time > 0.0);
        self.curved_time += run.tallies().inexact_time;
    }

    /// Adds what another run met.
    fn add(&mut self, other: &Met) {
        let Met { impacts, faces, edges, corners, pairs, rests, creases, pair_rests, edge_rests, .. } = *other;
        self.impacts += impacts;
        self.faces += faces;
        self.edges += edges;
        self.corners += corners;
        self.pairs += pairs;
        self.rests += rests;
        self.creases += creases;
        self.pair_rests += pair_rests;
        self.edge_rests += edge_rests;
        self.releases += other.releases;
        self.collapses += other.collapses;
        self.curved += other.curved;
        self.curved_time += other.curved_time;
        self.work += other.work;
        self.deepest = self.deepest.max(other.deepest);
        self.gain = self.gain.max(other.gain);
        self.hash = self.hash.wrapping_add(other.hash);
    }
}

/// Runs these seeds, each for so many half seconds, on all cores, telling failures as they come; what all met, and the
/// failures, in the order of seeds.
fn sweep(seeds: &[(u64, u32)]) -> (Met, Vec<String>) {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        while let Some(&(seed, halves)) = seeds.get(next.fetch_add(1, Ordering::Relaxed)) {
            let mut met = Met::default();
            let failure = check(seed, halves, &mut met).err();
            if let Some(failure) = &failure {
                tell(failure);
            } else if met.work > LABOUR {
                tell(&format!("seed {seed}: {} thousand turns, {} impacts", met.work, met.impacts));
            }
            done.push((seed, met, failure));
        }
        done
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut done = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("no scene panics")).collect::<Vec<_>>()
    });
    done.sort_unstable_by_key(|&(seed, ..)| seed);
    let mut total = Met::default();
    done.iter().for_each(|(_, met, _)| total.add(met));
    if let Some((seed, met, _)) = done.iter().max_by_key(|(_, met, _)| met.work) {
        tell(&format!("most work: {} thousand turns for seed {seed}", met.work));
    }
    (total, done.into_iter().filter_map(|(.., failure)| failure).collect())
}

#[expect(clippy::print_stdout, reason = "a campaign tells what it met")]
fn tell(what: &str) {
    println!("{what}");
}

fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(otherwise)
}

/// Seeds that failed once.
const MENDED: [u64; 26] = [
    124, 137, 141, 147, 152, 168, 175, 177, 179, 201, 226, 251, 267, 281, 295, 306, 322, 360, 371, 396, 421, 424, 447,
    461, 473, 590,
];

/// More of them, and for how many half seconds: some chatter without a rest speed, a million events a second and more,
/// some roll over each other most of the time; the campaign waits for that.
const LABORIOUS: [(u64, u32); 14] = [
    (50, 2),
    (65, 8),
    (74, 5),
    (103, 2),
    (132, 4),
    (153, 6),
    (164, 8),
    (167, 4),
    (184, 9),
    (271, 8),
    (325, 4),
    (491, 9),
    (661, 4),
    (679, 14),
];

#[test]
fn seeds_that_ever_failed_stay_mended() {
    let (_, failures) = sweep(&[&MENDED.map(|seed| (seed, 20))[..], &LABORIOUS[..]].concat());
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn random_scenes_neither_hang_nor_escape_nor_gain_energy_nor_go_deep() {
    let (from, count) = (number("CAROM_CAMPAIGN_FROM", 0), number("CAROM_CAMPAIGN", 40));
    let (met, failures) = sweep(&(from..from + count).map(|seed| (seed, 20)).collect::<Vec<_>>());
    tell(&format!("{count} scenes: {met:#?}"));
    let shown = failures[..failures.len().min(20)].join("\n");
    assert!(failures.is_empty(), "{} of {count} scenes failed:\n{shown}", failures.len());
    if count >= 20_000 {
        let rare = [met.faces, met.edges, met.corners, met.pairs, met.rests, met.creases, met.releases, met.collapses];
        assert!(rare.iter().all(|&n| n >= 500), "each thing at least 500 times");
    }
}
