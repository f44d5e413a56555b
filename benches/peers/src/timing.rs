//! What a run costs: processor time of one thread, so that what the machine gives to others counts little.

use carom::measure::thread_cpu;

use crate::cases::Case;
use crate::engine::Entrant;

/// A run shorter than this is repeated: s.
const LEAST: f64 = 0.05;

/// Processor seconds per simulated second.
#[derive(Debug, Clone, Copy)]
pub struct Cost {
    /// The best round: the one least disturbed.
    pub best: f64,
    /// The worst round.
    pub worst: f64,
}

/// The cost of each entrant. Rounds are interleaved, so that a busy moment meets all alike.
pub fn interleaved(case: &Case, rounds: usize) -> Vec<Cost> {
    let mut costs = vec![Cost { best: f64::INFINITY, worst: 0.0 }; case.entrants.len()];
    for _ in 0..rounds {
        for (entrant, cost) in case.entrants.iter().zip(&mut costs) {
            let seconds = timed(case, entrant) / case.until;
            cost.best = cost.best.min(seconds);
            cost.worst = cost.worst.max(seconds);
        }
    }
    costs
}

/// Processor time of a whole run, s: from the scene to its last frame, without looking at what is in between.
fn timed(case: &Case, entrant: &Entrant) -> f64 {
    let (start, mut runs) = (thread_cpu(), 0);
    loop {
        let mut run = entrant.begin(&case.scene);
        case.times(entrant).for_each(|t| run.advance(t));
        std::hint::black_box(run.state(case.until));
        runs += 1;
        let passed = thread_cpu() - start;
        if passed > LEAST {
            return passed / f64::from(runs);
        }
    }
}
