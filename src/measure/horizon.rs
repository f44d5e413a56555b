//! The horizon of a scene: the time until a displacement of 1e-12 m has grown by 1e6. Beyond it positions mean nothing:
//! two correct programs that round differently have parted.

use std::ops::ControlFlow;

use super::displaced::{RUNS, displaced};
use super::interrupt::{GoOn, Interrupted};
use super::reference::{Horizon, Reference};
use super::sample::{Budget, EndReason, sample};
use crate::scene::Scene;

/// The horizon of a reference's scene: the worst of 8 runs by the reference's own method, each sphere displaced along
/// a seeded unit vector, away from the walls it touches. Resolution: the reference's instants.
///
/// # Errors
/// If `go_on` returns false.
pub(super) fn of(scene: &Scene, reference: &Reference, budget: Budget, go_on: GoOn) -> Result<Horizon, Interrupted> {
    let mut worst = Horizon::unknown();
    for seed in 1..=RUNS {
        let found = one(scene, reference, (seed, budget), worst.time, go_on)?;
        worst.growth = worst.growth.max(found.growth);
        worst.time = [worst.time, found.time].into_iter().flatten().min_by(f64::total_cmp);
    }
    Ok(worst)
}

/// One displaced run, watched no longer than to the horizon known so far (s).
fn one(
    scene: &Scene,
    reference: &Reference,
    (seed, budget): (u64, Budget),
    known: Option<f64>,
    go_on: GoOn,
) -> Result<Horizon, Interrupted> {
    let (mut simulation, mut parting) = displaced(scene, reference.settings, seed);
    let mut time = None;
    let sampled = sample(&mut simulation, reference.instants, budget, go_on, |k, state| {
        let Some(positions) = reference.positions(k) else { return ControlFlow::Break(()) };
        if parting.compare(&state.x, positions) {
            time = Some(state.t);
        }
        let enough = time.is_some() || known.is_some_and(|known| state.t >= known);
        if enough { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    if matches!(sampled.end_reason, Some(EndReason::Stalled(_) | EndReason::Spent)) && sampled.end < reference.end {
        time = Some(sampled.end); // beyond the end of a displaced run, positions cannot be trusted
    }
    Ok(Horizon { time, growth: parting.growth })
}
