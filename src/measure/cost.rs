//! What a setting costs: processor time of its thread per simulated second, the best of several runs.

use super::clock::{Passed, Watch, resolution};
use super::interrupt::{GoOn, Interrupted};
use super::sample::run_through;
use crate::physics::Simulation;
use crate::scene::{Scene, Settings};

/// Shortest timing, s: shorter runs are repeated, so that the clock's own cost is lost in them.
const SHORTEST: f64 = 2e-3;

/// How often a run is repeated at most within one timing.
const MOST_REPEATS: u64 = 1000;

/// Timings of a run: (up to this many seconds each, so many); of a longer one, one. Where they are cheap they are many,
/// because one in a handful meets no disturbance only on an idle machine.
const TIMINGS: [(f64, usize); 3] = [(0.01, 15), (0.2, 5), (2.0, 3)];

/// Shortest timing, in units of the clock's resolution, that says much.
const COARSE: f64 = 100.0;

/// Largest spread that is not wide: above it the best may still be too slow.
const WIDE: f64 = 0.25;

/// Wall time over processor time above which others had the machine.
const BUSY: f64 = 1.5;

/// Wall time that a thread may wait without the machine being called busy, s: a turn of the scheduler.
const WAIT: f64 = 2e-3;

/// What a run costs.
#[derive(Debug, Clone, PartialEq)]
pub struct Cost {
    /// Thread CPU time per simulated second, s: the best of several timings.
    pub cpu_per_s: f64,
    /// Median of the timings, s of thread CPU time per simulated second.
    pub median: f64,
    /// (worst − best) / best of the timings, dimensionless; none of one timing.
    pub spread: Option<f64>,
    /// Reasons to doubt these figures, a phrase each.
    pub doubts: Vec<&'static str>,
}

/// Times a setting on a scene, up to `until` (s) or where it stalls. Setting the scene up does not count, nor is
/// anything recorded or read.
///
/// # Errors
/// If `go_on` returns false.
pub fn cost(scene: &Scene, settings: Settings, until: f64, go_on: GoOn) -> Result<Cost, Interrupted> {
    let mut timings = Timings::begin(scene, settings, until, go_on)?;
    while timings.wants_more() {
        timings.add(scene, go_on)?;
    }
    Ok(timings.summary())
}

/// Timings of a setting under way: one after the other, or in turn with those of other settings, so that a slow minute hits
/// all.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Timings {
    settings: Settings,
    until: f64,
    /// How often a run is repeated within one timing, and how many timings there are to be.
    repeats: u64,
    count: usize,
    /// Seconds that one run simulates.
    simulated: f64,
    passed: Vec<Passed>,
}

impl Timings {
    /// Runs once, which tells how often to repeat; that counts as the first timing if once is often enough.
    ///
    /// # Errors
    /// If `go_on` returns false.
    pub(super) fn begin(scene: &Scene, settings: Settings, until: f64, go_on: GoOn) -> Result<Timings, Interrupted> {
        let (first, simulated) = time(&Simulation::new(scene, settings), until, 1, go_on)?;
        let repeats = ((SHORTEST / first.cpu.max(1e-9)) as u64).clamp(1, MOST_REPEATS);
        let count = TIMINGS.iter().find(|(limit, _)| first.cpu <= *limit).map_or(1, |(_, count)| *count);
        let passed = if repeats == 1 { vec![first] } else { Vec::new() };
        let mut timings = Timings { settings, until, repeats, count, simulated, passed };
        if repeats > 1 {
            timings.add(scene, go_on)?;
        }
        Ok(timings)
    }

    pub(super) fn wants_more(&self) -> bool {
        self.passed.len() < self.count
    }

    /// Times the runs once more.
    ///
    /// # Errors
    /// If `go_on` returns false.
    pub(super) fn add(&mut self, scene: &Scene, go_on: GoOn) -> Result<(), Interrupted> {
        let fresh = Simulation::new(scene, self.settings);
        self.passed.push(time(&fresh, self.until, self.repeats, go_on)?.0);
        Ok(())
    }

    pub(super) fn summary(&self) -> Cost {
        summary(&self.passed, self.repeats as f64 * self.simulated)
    }
}

/// The time of `repeats` runs in a row, and the seconds that one of them simulated.
fn time(fresh: &Simulation, until: f64, repeats: u64, go_on: GoOn) -> Result<(Passed, f64), Interrupted> {
    let (mut total, mut simulated) = (Passed::default(), 0.0);
    for _ in 0..repeats {
        let mut simulation = fresh.clone();
        let watch = Watch::start();
        run_through(&mut simulation, until, go_on)?;
        total += watch.read();
        simulated = simulation.time().min(until);
    }
    Ok((total, simulated))
}

/// The cost from timings in each of which `simulated` seconds were simulated.
fn summary(timings: &[Passed], simulated: f64) -> Cost {
    let cpu = || timings.iter().map(|passed| passed.cpu);
    let (best, worst) = (cpu().fold(f64::INFINITY, f64::min), cpu().fold(0.0, f64::max));
    let spread = (timings.len() > 1 && best > 0.0).then(|| (worst - best) / best);
    let busy = timings.iter().all(|passed| passed.wall > BUSY * passed.cpu + WAIT);
    let doubts = [
        (best < COARSE * resolution(), "timer too coarse"),
        (spread.is_none(), "timed once"),
        (spread.is_some_and(|spread| spread > WIDE), "timings spread widely"),
        (busy, "machine busy"),
    ];
    let doubts = doubts.into_iter().filter(|(holds, _)| *holds).map(|(_, phrase)| phrase).collect();
    let mut sorted: Vec<f64> = cpu().collect();
    sorted.sort_by(f64::total_cmp);
    let median = sorted.get(sorted.len() / 2).copied().unwrap_or(best);
    let per_s = |cpu: f64| cpu / simulated.max(f64::MIN_POSITIVE);
    Cost { cpu_per_s: per_s(best), median: per_s(median), spread, doubts }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passed(cpu: f64, wall: f64) -> Passed {
        Passed { cpu, wall }
    }

    #[test]
    fn the_best_timing_counts_and_the_spread_is_shown() {
        let cost = summary(&[passed(0.5, 0.5), passed(0.25, 0.25), passed(0.375, 0.375)], 2.0);
        assert_eq!((cost.cpu_per_s, cost.median, cost.spread), (0.125, 0.1875, Some(1.0)));
        assert_eq!(cost.doubts, ["timings spread widely"]);
    }

    #[test]
    fn a_busy_machine_and_a_coarse_timer_are_told() {
        assert_eq!(summary(&[passed(0.5, 1.0), passed(0.5, 1.0)], 1.0).doubts, ["machine busy"]);
        assert_eq!(summary(&[passed(0.5, 1.0), passed(0.5, 0.5)], 1.0).doubts, [""; 0], "one timing was undisturbed");
        assert_eq!(summary(&[passed(0.5, 0.5)], 1.0).doubts, ["timed once"]);
        let instant = summary(&[passed(0.0, 0.0), passed(0.0, 0.0)], 1.0);
        assert!(instant.doubts.contains(&"timer too coarse") && instant.cpu_per_s == 0.0, "{instant:?}");
    }
}
