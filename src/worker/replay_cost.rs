//! What it costs to do frames again, counted: unlike time, it is equal on every machine, however busy.

use crate::{
    physics::{Simulation, Tallies},
    scene::Method,
};

/// What one of each costs by a method, in nanoseconds on some machine (an Intel Xeon of 2026, over all shipped scenes and
/// a gas of 10⁴ spheres, frame by frame). Only ratios matter; they hold to a factor of three.
struct Prices {
    /// Cost of a frame, what is looked at between two of them included.
    frame: u64,
    /// Cost of a gap computed.
    gap: u64,
    /// Cost of an impact, the begin of a rest, or its end.
    event: u64,
    /// Cost of a row solved by `moreau`.
    turn: u64,
    /// Cost of a contact that a frame lists.
    row: u64,
    /// Cost of an event for each contact that the frame lists: what rests is settled anew.
    settling: u64,
}

fn prices(method: Method) -> Prices {
    match method {
        Method::Paper => Prices { frame: 200, gap: 7, event: 100, turn: 0, row: 100, settling: 0 },
        Method::Swept => Prices { frame: 200, gap: 80, event: 2000, turn: 0, row: 100, settling: 150 },
        Method::Exact => Prices { frame: 200, gap: 50, event: 700, turn: 0, row: 100, settling: 150 },
        Method::Moreau => Prices { frame: 200, gap: 9, event: 100, turn: 15, row: 300, settling: 0 },
    }
}

/// Counts what a run costs from one reading to the next.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Meter {
    read: Tallies,
}

impl Meter {
    /// A meter that counts from where the run is.
    pub(super) fn of(run: &Simulation) -> Meter {
        Meter { read: run.tallies() }
    }

    /// What the run has cost since it was read last, ns of counted work.
    pub(super) fn read(&mut self, run: &Simulation) -> u64 {
        let before = std::mem::replace(&mut self.read, run.tallies());
        let now = self.read;
        // a run that begins anew by another method counts from 0
        let since = |of: fn(&Tallies) -> u64| of(&now).saturating_sub(of(&before));
        let events = since(|tallies| tallies.impacts + tallies.rests + tallies.releases);
        let (frames, rows) = (since(|tallies| tallies.frames), run.contacts().len() as u64);
        let Prices { frame, gap, event, turn, row, settling } = prices(run.settings().method);
        frames * (frame + rows * row)
            + since(|tallies| tallies.evaluations) * gap
            + since(|tallies| tallies.relaxations) * turn
            + events * (event + rows * settling)
    }
}
