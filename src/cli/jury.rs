//! What watches a run of `carom run`: always the watch, and with `--check` the judge, to which every frame is shown.
//! Neither changes a bit of the run; the judge only costs time.

use crate::audit::{Judge, Watch};
use crate::physics::{Contact, Progress, Simulation, State, Until};

/// Most findings that are told one by one.
const TOLD: usize = 10;

/// The watch, and the judge if it was asked for.
pub(super) struct Jury {
    watch: Watch,
    judge: Option<Judge>,
    /// End of the run, s: what happens later is no part of it.
    until: f64,
    /// Whether a frame has just been completed that the judge has not seen.
    fresh: bool,
    /// Events of the frame in progress, for the judge.
    events: Vec<Contact>,
}

impl Jury {
    /// The jury of a simulation that has just begun.
    pub(super) fn new(simulation: &Simulation, until: f64, check: bool) -> Jury {
        let judge = check.then(|| Judge::of(simulation));
        Jury { watch: Watch::new(simulation), judge, until, fresh: false, events: Vec::new() }
    }

    /// Advances by a slice, towards `time` (s); with a judge by a frame at most.
    pub(super) fn advance(&mut self, simulation: &mut Simulation, time: f64) -> Progress {
        let (until, slice) = match self.judge {
            Some(_) => (Until::Frame, Simulation::SLICE),
            None => (Until::Time(time), Simulation::SLICE.min(self.watch.slice(simulation.model()))),
        };
        let progress = simulation.advance(until, slice);
        self.fresh = progress == Progress::Reached;
        if simulation.time() <= self.until {
            self.watch.look(simulation, progress == Progress::Yielded && self.judge.is_none());
        }
        progress
    }

    /// Shows the judge the frame that has just ended, if one has.
    pub(super) fn judge(&mut self, simulation: &Simulation, events: &[Contact]) {
        let Some(judge) = &mut self.judge else { return };
        self.events.extend_from_slice(events);
        if !std::mem::take(&mut self.fresh) {
            return;
        }
        if simulation.time() <= self.until {
            judge.frame(simulation, &self.events);
        }
        self.events.clear();
    }

    /// Judges the last state of the run.
    pub(super) fn close(&mut self, simulation: &Simulation, end: &State) {
        let end = (end, simulation.hidden_energy_at(end));
        self.watch.state(simulation.model(), end, 0);
        if let Some(judge) = &mut self.judge {
            judge.state(simulation.model(), end, simulation.contacts());
        }
    }

    /// What the closing line says of the findings: empty if nothing is wrong and no check was asked for.
    pub(super) fn words(&self) -> String {
        let alarm = self.watch.alarm();
        let alarm = if alarm.is_silent() { String::new() } else { format!(" alarm={}", alarm.words()) };
        let check = match self.judge.as_ref().map(|judge| judge.findings().count()) {
            None => String::new(),
            Some(0) => " check=ok".into(),
            Some(count) => format!(" check={count}"),
        };
        alarm + &check
    }

    /// A sentence for each thing that is wrong, the first few of them.
    pub(super) fn sentences(&self) -> Vec<String> {
        let alarms = self.watch.alarm().sentences().into_iter().map(|sentence| format!("ALARM {sentence}"));
        let rows = self.judge.as_ref().map(|judge| judge.findings().rows()).unwrap_or_default();
        let more = rows.len().saturating_sub(TOLD);
        let findings = rows.iter().take(TOLD).map(|finding| format!("check: {finding}"));
        let more = (more > 0).then(|| format!("check: and {more} findings more"));
        alarms.chain(findings).chain(more).collect()
    }

    /// Whether the judge was asked and has found something.
    pub(super) fn condemns(&self) -> bool {
        self.judge.as_ref().is_some_and(|judge| !judge.findings().is_empty())
    }
}
