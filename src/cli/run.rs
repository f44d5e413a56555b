//! `carom run`: a run without a screen. Rows go out as they come, so a long run takes no more memory than a short one.

use std::io::Write;

use indicatif::ProgressBar;

use super::accuracy;
use super::arguments::Run;
use super::certified::{self, Certified};
use super::failure::{Failure, note};
use super::jury::Jury;
use super::output::Output;
use super::progress::{self, STEPS};
use super::rows::refuse_too_many;
use super::signals::Signals;
use super::target::{Target, refuse_shared};
use crate::certify::Certificate;
use crate::export::{EventRow, Format, Row, StateRow, Table};
use crate::physics::{Progress, Simulation, Stall, State, Tallies};
use crate::scene;

pub(super) fn run(arguments: &Run, signals: &Signals) -> Result<(), Failure> {
    let outputs = [("--states", arguments.states.as_ref()), ("--events", arguments.events.as_ref())];
    refuse_shared(&outputs, &[])?;
    let opened = scene::open(&arguments.scene).map_err(|error| Failure::Failed(error.to_string()))?;
    let until = arguments.until.unwrap_or(opened.scene.duration);
    refuse_too_many(arguments, &opened.scene, until)?;
    opened.path.iter().try_for_each(|path| refuse_shared(&outputs, &[("the scene", path)]))?;
    if arguments.certify {
        accuracy::from_its_start(&opened.scene, "--certify")?;
    }
    let certified = arguments.certify.then(|| Certified::of(&arguments.solver)).transpose()?;
    let (settings, said) = accuracy::settings(&arguments.solver, &opened.scene, until, Some(signals))?;
    said.iter().for_each(|said| note(said));
    for warning in scene::warnings(&opened.scene, settings, until) {
        note(&format!("{}: {warning}", opened.key));
    }
    let settings = certified.as_ref().map_or(settings, |certified| certified.settings(settings));
    let simulation = Simulation::new(&opened.scene, settings);
    let mut recorder = Recorder {
        jury: Jury::new(&simulation, until, arguments.check),
        simulation,
        until,
        states: table::<StateRow>(arguments.states.as_ref())?,
        events: table::<EventRow>(arguments.events.as_ref())?,
        impacts: 0,
        summed: false,
        signals,
        progress: progress::bar(STEPS as u64, "{bar:40} {percent:>3} %  {elapsed} elapsed, {eta} to go"),
    };
    recorder.simulation.record_events(true);
    let stall = recorder.record(arguments.every)?;
    let certificate = certified.map(|certified| certified.certificate(&opened.scene, until, signals)).transpose()?;
    let on_stdout = !outputs.iter().any(|(_, target)| target.is_some_and(Target::is_stdout));
    recorder.close(stall, certificate, on_stdout)
}

fn table<R: Row>(target: Option<&Target>) -> Result<Option<Table<Output>>, Failure> {
    let Some(target) = target else { return Ok(None) };
    let format = match target {
        Target::Stdout => Format::Csv,
        Target::File(path) => Format::of(&path.to_string_lossy()),
    };
    Ok(Some(Table::new::<R>(format, Output::open(target)?)?))
}

/// A run being written down.
struct Recorder<'a> {
    simulation: Simulation,
    jury: Jury,
    until: f64,
    states: Option<Table<Output>>,
    events: Option<Table<Output>>,
    impacts: u64,
    /// Whether a row stands for many impacts.
    summed: bool,
    signals: &'a Signals,
    progress: ProgressBar,
}

impl Recorder<'_> {
    /// Runs to the end, or to where the run cannot go on.
    fn record(&mut self, every: Option<f64>) -> Result<Option<Stall>, Failure> {
        let begun = self.simulation.time(); // not 0 in a scene that goes on from another run
        for time in sample_times(self.until, every).skip_while(|time| *time < begun) {
            self.signals.check()?;
            if let Some(stall) = self.reach(time)? {
                self.write_states(&self.simulation.state())?;
                return Ok(Some(stall));
            }
            if self.states.is_some() {
                self.write_states(&self.simulation.at(time))?;
            }
        }
        Ok(None)
    }

    /// Advances until a frame holds `time`, slice by slice.
    fn reach(&mut self, time: f64) -> Result<Option<Stall>, Failure> {
        while self.simulation.time() < time {
            let progress = self.jury.advance(&mut self.simulation, time);
            self.write_events()?;
            self.signals.check()?;
            self.progress.set_position((self.simulation.time() / self.until * STEPS) as u64);
            if let Progress::Stalled(stall) = progress {
                return Ok(Some(stall));
            }
        }
        Ok(None)
    }

    /// Writes the events up to the end of the run: the last frame may reach beyond it, and what happens there belongs to no
    /// row.
    fn write_events(&mut self) -> Result<(), Failure> {
        let events = self.simulation.take_events();
        self.jury.judge(&self.simulation, &events);
        for event in events.iter().filter(|event| event.time <= self.until) {
            self.impacts = self.impacts.saturating_add(event.impact_count());
            self.summed |= event.impact_count() > 1;
            if let Some(table) = &mut self.events {
                table.write(&EventRow::from(event))?;
            }
        }
        Ok(())
    }

    fn write_states(&mut self, state: &State) -> Result<(), Failure> {
        let Some(table) = &mut self.states else { return Ok(()) };
        StateRow::all(state).try_for_each(|row| table.write(&row)).map_err(Failure::from)
    }

    /// Puts the files in their places and says how the run ended.
    fn close(mut self, stall: Option<Stall>, certificate: Option<Certificate>, on_stdout: bool) -> Result<(), Failure> {
        self.progress.finish_and_clear();
        let end = if stall.is_some() { self.simulation.state() } else { self.simulation.at(self.until) };
        self.jury.close(&self.simulation, &end);
        let mut line = closing_line(&end, self.impacts, end.energy(self.simulation.model()), stall.as_ref());
        line.push_str(&self.jury.words());
        line.push_str(&certificate.as_ref().map(certified::words).unwrap_or_default());
        let tells_events = self.events.is_some();
        for table in [self.states, self.events].into_iter().flatten() {
            table.finish()?.finish()?;
        }
        if on_stdout {
            let mut out = Output::stdout();
            writeln!(out, "{line}")?;
            out.finish()?;
        } else {
            let _ = writeln!(std::io::stderr(), "{line}"); // if it cannot be read, the exit code still tells
        }
        if self.summed && tells_events {
            note(SUMMED);
        }
        unsolved(&self.simulation.tallies()).iter().for_each(|sentence| note(sentence));
        self.jury.sentences().iter().for_each(|sentence| note(sentence));
        certificate.iter().flat_map(certified::notes).for_each(|words| note(&words));
        if let Some(stall) = &stall {
            note(&stall.reason);
        }
        if stall.is_some() || self.jury.condemns() { Err(Failure::Told) } else { Ok(()) }
    }
}

/// What must be said of events of which some are sums.
const SUMMED: &str = "some rows of events stand for many impacts that repeat themselves: their approach speeds and \
                      impulses are sums";

/// What must be said of frames whose contacts the solver left unsolved, if there are any.
fn unsolved(tallies: &Tallies) -> Option<String> {
    (tallies.unconverged > 0).then(|| {
        format!(
            "in {} of {} frames the solver of the contacts did not converge: bodies may overlap there, and the result is \
             not to be trusted; take a smaller dt or another method",
            tallies.unconverged, tallies.frames
        )
    })
}

/// The times of states, s: 0, every k · `every` below `until`, and `until`. Multiplied, not summed, so that no rounding
/// grows.
fn sample_times(until: f64, every: Option<f64>) -> impl Iterator<Item = f64> {
    let every = every.unwrap_or(until);
    (0_u64..).map(move |k| k as f64 * every).take_while(move |time| *time < until).chain(std::iter::once(until))
}

fn closing_line(end: &State, impacts: u64, energy: f64, stall: Option<&Stall>) -> String {
    let stalled = stall.map(|stall| format!(" stall={}", stall.kind)).unwrap_or_default();
    format!("t={:?} impacts={impacts} energy={energy:?} hash={:016x}{stalled}", end.t, end.hash())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(until: f64, every: Option<f64>) -> Vec<f64> {
        sample_times(until, every).collect()
    }

    #[test]
    fn states_are_multiples_and_the_end_comes_once() {
        assert_eq!(times(1.0, Some(0.25)), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(times(1.0, Some(0.4)), [0.0, 0.4, 0.8, 1.0]);
        assert_eq!(times(1.0, Some(5.0)), [0.0, 1.0]);
        assert_eq!(times(1.0, None), [0.0, 1.0]);
        assert_eq!(times(0.0, Some(0.1)), [0.0]);
        assert_eq!(times(0.0, None), [0.0]);
        let tenths = times(1.0, Some(0.1));
        assert_eq!((tenths[3], tenths.len()), (3.0 * 0.1, 11), "0.1 summed three times is another number");
    }
}
