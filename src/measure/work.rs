//! What a run has cost in counted work: unlike time, it is equal on every machine, however busy.

use crate::physics::{Simulation, Tallies};
use crate::scene::Method;

/// What a frame, a gap, an impact and a turn of `moreau`'s solver cost by a method, in nanoseconds on some machine (an
/// Intel Xeon of 2026, by least error over `carom measure` of twelve shipped scenes). Only ratios matter; they hold to a
/// factor of three.
struct Prices {
    frame: u64,
    gap: u64,
    impact: u64,
    turn: u64,
}

fn prices(method: Method) -> Prices {
    match method {
        Method::Paper => Prices { frame: 60, gap: 5, impact: 100, turn: 0 },
        Method::Swept => Prices { frame: 50, gap: 60, impact: 1500, turn: 0 },
        Method::Exact => Prices { frame: 0, gap: 50, impact: 1000, turn: 0 },
        Method::Moreau => Prices { frame: 150, gap: 5, impact: 100, turn: 50 },
    }
}

/// What a simulation has cost since t = 0, ns of counted work.
pub(super) fn counted(run: &Simulation) -> u64 {
    priced(run.settings().method, &run.tallies())
}

/// The price of what a method has counted, ns.
pub(super) fn priced(method: Method, tallies: &Tallies) -> u64 {
    let Prices { frame, gap, impact, turn } = prices(method);
    let Tallies { frames, evaluations, impacts, relaxations, .. } = *tallies;
    frames * frame + evaluations * gap + impacts * impact + relaxations * turn
}

/// What so many frames of a method cost at least, ns.
pub(super) fn least(method: Method, frames: f64) -> f64 {
    frames * prices(method).frame as f64
}
