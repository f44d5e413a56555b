//! Thousands of random scenes by the event-driven method: nothing hangs, escapes, gains energy or goes deep.
//!
//! `CAROM_CAMPAIGN=20000 cargo test --release --test campaign -- --nocapture random` is the whole campaign; the ordinary suite
//! runs the first forty of the same scenes, and those that ever failed as far as that takes less than a second each.
//! Without `random` the campaign runs all that ever failed once more. `CAROM_CAMPAIGN_FROM` sets the first seed.

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

/// Seeds that failed once, and for how many half seconds they are run: beyond where they did.
const MENDED: [(u64, u32); 81] = [
    (65, 20),
    (124, 20),
    (132, 20),
    (137, 20),
    (141, 20),
    (147, 20),
    (152, 20),
    (164, 20),
    (168, 20),
    (175, 20),
    (177, 20),
    (179, 20),
    (201, 20),
    (226, 20),
    (251, 20),
    (267, 20),
    (281, 20),
    (295, 20),
    (306, 20),
    (322, 20),
    (325, 20),
    (360, 20),
    (371, 20),
    (396, 20),
    (421, 20),
    (424, 20),
    (447, 20),
    (461, 20),
    (473, 20),
    (590, 20),
    (656, 13),
    (679, 20),
    (782, 8),
    (896, 10),
    (996, 9),
    (2093, 14),
    (2098, 9),
    (2203, 19),
    (2464, 6),
    (2480, 5),
    (2658, 11),
    (2751, 6),
    (2798, 9),
    (3361, 11),
    (4246, 15),
    (4267, 12),
    (4348, 13),
    (4960, 7),
    (5266, 7),
    (5459, 4),
    (5921, 6),
    (7688, 18),
    (7726, 16),
    (8361, 8),
    (8635, 7),
    (8877, 12),
    (8925, 9),
    (9224, 10),
    (9314, 17),
    (9949, 4),
    (10167, 18),
    (10337, 13),
    (10941, 8),
    (11044, 11),
    (11163, 16),
    (11592, 12),
    (11817, 9),
    (12395, 9),
    (12923, 4),
    (13532, 9),
    (13632, 14),
    (13928, 9),
    (13947, 7),
    (14061, 5),
    (14129, 6),
    (14253, 12),
    (14636, 7),
    (14849, 17),
    (14909, 8),
    (14981, 10),
    (15190, 13),
];

/// More of them: they chatter without a rest speed, or roll over each other most of the time, and take seconds each. The
/// campaign runs them too.
const LABORIOUS: [(u64, u32); 73] = [
    (50, 20),
    (74, 20),
    (103, 20),
    (153, 20),
    (167, 20),
    (184, 20),
    (271, 20),
    (491, 20),
    (661, 7),
    (743, 6),
    (790, 7),
    (1025, 13),
    (1198, 12),
    (1218, 20),
    (1342, 6),
    (1383, 7),
    (1482, 7),
    (1490, 12),
    (1904, 11),
    (1986, 11),
    (2054, 19),
    (2234, 8),
    (2335, 13),
    (2481, 16),
    (2959, 8),
    (3184, 16),
    (3518, 17),
    (3624, 11),
    (4104, 10),
    (4207, 15),
    (5311, 9),
    (5430, 6),
    (5928, 13),
    (6402, 12),
    (6414, 20),
    (6919, 18),
    (6920, 11),
    (7533, 12),
    (7793, 7),
    (8016, 17),
    (8025, 7),
    (8129, 18),
    (8474, 8),
    (9273, 11),
    (9329, 15),
    (9368, 15),
    (9715, 9),
    (9752, 16),
    (9970, 7),
    (10108, 14),
    (10445, 10),
    (10595, 20),
    (10635, 15),
    (10676, 12),
    (10864, 11),
    (11024, 12),
    (11118, 13),
    (11666, 17),
    (11721, 13),
    (11756, 14),
    (12512, 14),
    (12666, 11),
    (12869, 9),
    (13207, 11),
    (13365, 13),
    (13397, 13),
    (13406, 14),
    (13587, 13),
    (13917, 6),
    (13986, 12),
    (14142, 14),
    (14757, 12),
    (17608, 20),
];

#[test]
fn seeds_that_ever_failed_stay_mended() {
    let laborious = if std::env::var_os("CAROM_CAMPAIGN").is_some() { &LABORIOUS[..] } else { &[] };
    let (_, failures) = sweep(&[&MENDED[..], laborious].concat());
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
