//! `carom render SCENE`: one frame of the TUI's own screen. Nothing of it depends on the terminal that runs it.

use std::io::Write;
use std::sync::Arc;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::accuracy;
use super::arguments::{Color, Display, Format, Render};
use super::failure::{Failure, note};
use super::output::Output;
use super::signals::Signals;
use crate::audit::Watch;
use crate::physics::{Class, Progress, Simulation, Stall, State, Until};
use crate::scene::{self, Opened, Settings};
use crate::snapshot::{Kept, Snapshot, Stage, Ticks};
use crate::view::{self, CardView, Mode, Pace, Popup, Screen, ViewSettings};
use crate::{app, frame};

pub(super) fn render(arguments: &Render, signals: &Signals) -> Result<(), Failure> {
    let opened = scene::open(&arguments.scene).map_err(|error| Failure::Failed(error.to_string()))?;
    let (settings, said) = accuracy::settings(&arguments.solver, &opened.scene, opened.scene.duration, Some(signals))?;
    said.iter().for_each(|said| note(said));
    let endless = scene::endless(&opened.scene, settings, arguments.at);
    endless.iter().for_each(|warning| note(&format!("{}: {warning}", opened.key)));
    let shown = match arguments.collision {
        Some(number) => reach_collision(&opened, settings, number as u64, signals)?,
        None => reach(&opened, settings, arguments.at, signals)?,
    };
    let card = shown.card.map(|cursor| CardView { cursor, ..CardView::default() });
    let view_settings = ViewSettings { card, ..view_settings(&arguments.display) };
    let buffer = draw(&shown, &view_settings, arguments.size);
    let bytes = match arguments.format {
        Format::Text => frame::text(&buffer),
        Format::Ansi => frame::ansi(&buffer),
        Format::Svg => frame::svg(&buffer),
    };
    let mut out = Output::stdout();
    out.write_all(bytes.as_bytes())?;
    out.finish()?;
    shown.stall.map_or(Ok(()), |stall| Err(Failure::Failed(stall.reason)))
}

/// A run at the time that was asked for, or where it could not go on.
struct Shown {
    snapshot: Snapshot,
    ticks: Ticks,
    stall: Option<Stall>,
    /// The contact that is taken apart, by its place on the screen.
    card: Option<usize>,
}

/// The end of the frame in which the collision of this number happens.
fn reach_collision(opened: &Opened, settings: Settings, number: u64, signals: &Signals) -> Result<Shown, Failure> {
    let mut simulation = Simulation::new(&opened.scene, settings);
    simulation.record_events(true);
    simulation.explain(true);
    let (mut watch, mut ticks) = (Watch::new(&simulation), Ticks::new(opened.scene.duration));
    let (mut before, mut stall) = (0, None);
    let missing = |impacts: u64| format!("there are {impacts} collisions within {} s", opened.scene.duration);
    while simulation.tallies().impacts < number && stall.is_none() {
        if simulation.time() >= opened.scene.duration {
            return Err(Failure::Failed(missing(simulation.tallies().impacts)));
        }
        before = simulation.tallies().impacts;
        loop {
            signals.check()?;
            match simulation.advance(Until::Frame, Simulation::SLICE) {
                Progress::Yielded => {}
                Progress::Reached => break,
                Progress::Stalled(reason) => {
                    stall = Some(reason);
                    break;
                }
            }
        }
        watch.look(&simulation, true);
        count(&mut simulation, f64::INFINITY, &mut ticks);
    }
    let stage = Arc::new(Stage::of(&opened.key, &opened.scene));
    let snapshot = Snapshot { alarm: *watch.alarm(), ..Snapshot::of(&stage, &simulation, stall.as_ref()) };
    let struck = snapshot.contacts.iter().enumerate().filter(|(_, contact)| contact.class == Class::Collide);
    let card = struck.map(|(index, _)| index).nth((number - before).saturating_sub(1) as usize);
    Ok(Shown { snapshot, ticks, stall, card })
}

fn reach(opened: &Opened, settings: Settings, at: f64, signals: &Signals) -> Result<Shown, Failure> {
    let mut simulation = Simulation::new(&opened.scene, settings);
    simulation.record_events(true);
    simulation.explain(true);
    let (mut ticks, mut impacts) = (Ticks::new(opened.scene.duration), 0);
    let mut watch = Watch::new(&simulation);
    let slice = Simulation::SLICE.min(watch.slice(simulation.model()));
    let mut look = |run: &mut Simulation| {
        if run.time() <= at {
            watch.look(run, true);
        }
        impacts += count(run, at, &mut ticks);
        signals.check()
    };
    let (mut end, mut looked) = (Progress::Reached, Ok(()));
    if simulation.time() < at {
        end = simulation.run_to(at, |run| {
            looked = look(run);
            looked.is_ok().then_some(slice)
        });
    }
    looked.and_then(|()| look(&mut simulation))?;
    let stall = if let Progress::Stalled(stall) = end { Some(stall) } else { None };
    let stage = Arc::new(Stage::of(&opened.key, &opened.scene));
    let whole = Snapshot::of(&stage, &simulation, stall.as_ref());
    let shown = cut(whole, &simulation, at, impacts);
    let state = State { t: shown.t, x: shown.x.clone(), v: shown.v.clone() };
    watch.state(simulation.model(), (&state, simulation.hidden_energy_at(&state)), shown.tallies.impacts);
    Ok(Shown { snapshot: Snapshot { alarm: *watch.alarm(), ..shown }, ticks, stall, card: None })
}

/// Impacts since the last call, as far as the frame shows them.
fn count(simulation: &mut Simulation, at: f64, ticks: &mut Ticks) -> u64 {
    let events = simulation.take_events();
    let impacts = events.iter().filter(|event| event.class == Class::Collide && event.time <= at);
    impacts.map(|event| ticks.add(event.time)).count() as u64
}

/// The run within its last frame: a copy, reached by a shortened step. What the frame found at its end is yet to come.
fn cut(whole: Snapshot, simulation: &Simulation, at: f64, impacts: u64) -> Snapshot {
    if whole.t <= at {
        return whole;
    }
    let state = simulation.at(at);
    let energy = state.energy(simulation.model());
    let mut cut = Snapshot { t: state.t, energy, x: state.x, v: state.v, ..whole };
    cut.step -= whole.t - at;
    cut.contacts.retain(|contact| contact.time <= at);
    cut.probes.clear();
    cut.tallies.impacts = impacts;
    cut
}

fn view_settings(display: &Display) -> ViewSettings {
    let ordinary = ViewSettings::default();
    ViewSettings {
        colors: display.color.and_then(Color::depth).unwrap_or(ordinary.colors),
        marker: display.marker.map_or(ordinary.marker, Into::into),
        ..ordinary
    }
}

fn draw(shown: &Shown, view_settings: &ViewSettings, (columns, rows): (u16, u16)) -> Buffer {
    let mut buffer = Buffer::empty(Rect::new(0, 0, columns, rows));
    screen_of(&shown.snapshot, &shown.ticks, 1.0, view_settings, |screen| view::draw(screen, buffer.area, &mut buffer));
    buffer
}

/// The screen of a paused run, at `speed` simulated seconds per second, lent to `show`.
pub(super) fn screen_of(
    snapshot: &Snapshot,
    ticks: &Ticks,
    speed: f64,
    view_settings: &ViewSettings,
    show: impl FnOnce(&Screen),
) {
    let mode = if snapshot.stall.is_some() { Mode::Stalled } else { Mode::Pause };
    let hints = app::hints();
    let hints: Vec<(&str, &str)> = hints.iter().map(|(keys, word)| (keys.as_str(), *word)).collect();
    show(&Screen {
        snapshot,
        pace: Pace { mode, wanted: speed, reached: None },
        ticks,
        kept: Kept::default(),
        recorded: None,
        trail: &[],
        ahead: None,
        log: None,
        comparison: None,
        view_settings,
        popup: Popup::None,
        message: None,
        hints: &hints,
    });
}
