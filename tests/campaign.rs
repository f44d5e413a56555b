//! Thousands of random scenes by the event-driven methods, each frame and event held against the independent judge: nothing
//! hangs, stalls, overlaps, passes a wall, pulls or gains energy.
//!
//! `CAROM_CAMPAIGN=20000 cargo test --release --test campaign -- --nocapture joints` is the whole campaign of one generator:
//! `rooms`, `joints`, `seams`, `funnels`, `tubes`, `stacks`, `crowds`, `heaps`, `units`. The ordinary suite runs the first few scenes of each, and
//! those rooms that ever failed as far as that takes less than a second each; with `seeds` the campaign runs all that ever
//! failed once more. `CAROM_CAMPAIGN_METHOD=swept` runs them by that method instead of by `exact`. `CAROM_CAMPAIGN_FROM` sets the first seed, `CAROM_CAMPAIGN_BUDGET` the turns after which a scene hangs;
//! `CAROM_CAMPAIGN_SCENES` names a folder into which each scene that fails, or takes more than a second, is written.

#[path = "campaign/crowds.rs"]
mod crowds;
#[path = "campaign/halves.rs"]
mod halves;
#[path = "campaign/heaps.rs"]
mod heaps;
#[path = "campaign/joints.rs"]
mod joints;
#[path = "campaign/judged.rs"]
mod judged;
#[path = "campaign/mended.rs"]
mod mended;
#[path = "campaign/narrow.rs"]
mod narrow;
#[path = "campaign/place.rs"]
mod place;
#[path = "support/random.rs"]
mod random;
#[path = "campaign/rooms.rs"]
mod rooms;
#[path = "campaign/seams.rs"]
mod seams;
mod support;
#[path = "campaign/units.rs"]
mod units;

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use judged::{EXACT, Failure, Generator, Met, SWEPT};
use mended::{
    LABORIOUS, MENDED, MENDED_CROWDS, MENDED_FUNNELS, MENDED_HEAPS, MENDED_JOINTS, MENDED_SEAMS, MENDED_STACKS,
    MENDED_TUBES, MENDED_UNITS, SWEPT_FUNNELS, SWEPT_JOINTS, SWEPT_STACKS,
};

/// Ten seconds, and twenty million turns, some twenty seconds of work.
const ROOMS: Generator =
    Generator { scene: rooms::room_scene, settings: EXACT, halves: 20, budget: 20_000_000, boxed: true };

/// The others are small scenes: ten seconds take ten million turns at most.
const fn small(scene: fn(u64) -> carom::physics::Scene) -> Generator {
    Generator { scene, settings: EXACT, halves: 20, budget: 10_000_000, boxed: false }
}

const JOINTS: Generator = small(joints::joint_scene);

/// Beside a seam, hops of 1e-12 m on an edge that takes nothing, half a million a second for ever, are followed one by one:
/// seed 16707 asks for 18 million turns.
const SEAMS: Generator = Generator { budget: 60_000_000, ..small(seams::seam_scene) };
const FUNNELS: Generator = small(narrow::funnel_scene);
const TUBES: Generator = small(narrow::tube_scene);

/// Five elastic spheres, nothing damped and gaps of 1e-9 r between them, meet a million times a second by the law: one
/// scene in ten thousand asks for 23 million turns, and seed 2055 for 49 million, to its end.
const STACKS: Generator = Generator { budget: 60_000_000, ..small(narrow::stack_scene) };

/// Every frame is judged with hundreds of spheres: two seconds.
const CROWDS: Generator = Generator { halves: 4, budget: 2_000_000, ..small(crowds::crowd_scene) };

/// What settles costs its contacts: one second.
const HEAPS: Generator = Generator { halves: 2, budget: 2_000_000, ..small(heaps::heap_scene) };

/// Slices of a thousand turns from which on a scene is told to have been laborious; or a second of the processor.
const LABOUR: u64 = 200;

type Check<'a> = &'a (dyn Fn(u64, u32, &mut Met) -> Result<(), Failure> + Sync);

/// Runs these seeds, each for so many half seconds, on all cores, telling failures as they come; what all met, and the
/// failures, in the order of seeds.
fn sweep(seeds: &[(u64, u32)], check: Check) -> (Met, Vec<Failure>) {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        while let Some(&(seed, halves)) = seeds.get(next.fetch_add(1, Ordering::Relaxed)) {
            let mut met = Met::default();
            let failure = check(seed, halves, &mut met).err();
            if let Some(failure) = &failure {
                tell(&failure.text);
            } else if met.undecided > 0 {
                tell(&format!("seed {seed}: as rounding has it"));
            } else if met.slices > LABOUR || met.cpu > 1.0 {
                tell(&format!("seed {seed}: {} thousand turns, {} impacts, {:.1} s", met.slices, met.impacts, met.cpu));
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
    if let Some((seed, met, _)) = done.iter().max_by_key(|(_, met, _)| met.slices) {
        tell(&format!("most work: {} thousand turns for seed {seed}", met.slices));
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

/// How many failures there are of each kind.
fn kinds(failures: &[Failure]) -> String {
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    failures.iter().for_each(|failure| *kinds.entry(&failure.kind).or_default() += 1);
    kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect::<Vec<_>>().join(", ")
}

/// Runs the seeds that the environment asks for, or `few`; none of them fails.
fn campaign(few: u64, halves: u32, check: Check) -> (Met, u64) {
    let (from, count) = (number("CAROM_CAMPAIGN_FROM", 0), number("CAROM_CAMPAIGN", few));
    let (met, failures) = sweep(&(from..from + count).map(|seed| (seed, halves)).collect::<Vec<_>>(), check);
    tell(&format!("{count} scenes: {met:#?}"));
    tell(&format!("{} took more than 1 s of the processor, {} more than 10 s", met.slow, met.very_slow));
    tell(&format!("failed: {} of {count}: {}", failures.len(), kinds(&failures)));
    let shown: Vec<&str> = failures.iter().take(20).map(|failure| failure.text.as_str()).collect();
    assert!(failures.is_empty(), "{} of {count} failed: {}\n{}", failures.len(), kinds(&failures), shown.join("\n"));
    (met, count)
}

fn judged_by(few: u64, generator: &Generator) -> (Met, u64) {
    let swept = std::env::var("CAROM_CAMPAIGN_METHOD").is_ok_and(|method| method == "swept");
    let settings = if swept { SWEPT } else { generator.settings };
    let generator = Generator { settings, budget: number("CAROM_CAMPAIGN_BUDGET", generator.budget), ..*generator };
    campaign(few, generator.halves, &|seed, halves, met| judged::check(&generator, seed, halves, met))
}

#[test]
fn seeds_that_ever_failed_stay_mended() {
    let laborious = if std::env::var_os("CAROM_CAMPAIGN").is_some() { &LABORIOUS[..] } else { &[] };
    let seeds = [&MENDED[..], laborious].concat();
    let (_, failures) = sweep(&seeds, &|seed, halves, met| judged::check(&ROOMS, seed, halves, met));
    let shown: Vec<&str> = failures.iter().map(|failure| failure.text.as_str()).collect();
    assert!(failures.is_empty(), "{}\n{}", kinds(&failures), shown.join("\n"));
}

#[test]
fn small_scenes_that_ever_failed_or_went_on_for_ever_stay_mended() {
    let mended = [
        (&MENDED_FUNNELS[..], &FUNNELS),
        (&MENDED_TUBES, &TUBES),
        (&MENDED_STACKS, &STACKS),
        (&MENDED_JOINTS, &JOINTS),
        (&MENDED_SEAMS, &SEAMS),
        (&MENDED_CROWDS, &CROWDS),
        (&MENDED_HEAPS, &HEAPS),
    ];
    for (seeds, generator) in mended {
        let (_, failures) = sweep(seeds, &|seed, halves, met| judged::check(generator, seed, halves, met));
        let shown: Vec<&str> = failures.iter().map(|failure| failure.text.as_str()).collect();
        assert!(failures.is_empty(), "{}\n{}", kinds(&failures), shown.join("\n"));
    }
}

#[test]
fn random_rooms_pass_the_judge() {
    let (met, count) = judged_by(40, &ROOMS);
    if count >= 20_000 {
        let rare = [met.faces, met.edges, met.corners, met.pairs, met.rests, met.creases, met.releases, met.collapses];
        assert!(rare.iter().all(|&n| n >= 500), "each thing at least 500 times");
    }
}

#[test]
fn joints_of_walls_pass_the_judge() {
    judged_by(40, &JOINTS);
}

#[test]
fn seams_pass_the_judge() {
    judged_by(40, &SEAMS);
}

#[test]
fn funnels_pass_the_judge() {
    judged_by(40, &FUNNELS);
}

#[test]
fn tubes_pass_the_judge() {
    judged_by(40, &TUBES);
}

#[test]
fn stacks_pass_the_judge() {
    judged_by(30, &STACKS);
}

#[test]
fn crowds_pass_the_judge() {
    judged_by(6, &CROWDS);
}

#[test]
fn heaps_pass_the_judge() {
    judged_by(6, &HEAPS);
}

#[test]
fn swept_passes_the_judge_where_exact_does() {
    let few: [(_, _, &[u64]); 7] = [
        (ROOMS, 20, &[]),
        (JOINTS, 40, &SWEPT_JOINTS),
        (SEAMS, 40, &[]),
        (FUNNELS, 20, &SWEPT_FUNNELS),
        (TUBES, 40, &[]),
        (STACKS, 20, &SWEPT_STACKS),
        (CROWDS, 3, &[]),
    ];
    for (generator, count, mended) in few {
        let generator = Generator { settings: SWEPT, ..generator };
        let seeds: Vec<_> = (0..count).chain(mended.iter().copied()).map(|seed| (seed, generator.halves)).collect();
        let (_, failures) = sweep(&seeds, &|seed, halves, met| judged::check(&generator, seed, halves, met));
        let shown: Vec<&str> = failures.iter().map(|failure| failure.text.as_str()).collect();
        assert!(failures.is_empty(), "{}\n{}", kinds(&failures), shown.join("\n"));
    }
}

#[test]
fn other_units_give_the_same_run() {
    let check: Check = &|seed, halves, met| units::check(seed, 0.5 * f64::from(halves), met);
    campaign(30, 20, check);
    let (_, failures) = sweep(&MENDED_UNITS, check);
    let shown: Vec<&str> = failures.iter().map(|failure| failure.text.as_str()).collect();
    assert!(failures.is_empty(), "{}", shown.join("\n"));
}
