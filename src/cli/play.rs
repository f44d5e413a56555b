//! `carom [SCENE]`: the TUI, or the run told in lines.

use std::cell::RefCell;
use std::ffi::OsStr;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use super::accuracy;
use super::arguments::{Color, Play};
use super::failure::{Failure, note};
use super::lines;
use super::output::Output;
use super::replay;
use super::signals::Signals;
use super::talk::{self, Begin, Ears, Event};
use crate::app::Setup;
use crate::config::{self, Config};
use crate::recording::Recording;
use crate::scene::{self, Opened, Scene, Settings};
use crate::terminal::{self, Options, Outcome};
use crate::text_mode::{self, Ending};
use crate::view::{Colors, Marker};

pub(super) fn play(arguments: &Play) -> Result<(), Failure> {
    let text = is_text(arguments);
    if !text && !io::stdout().is_terminal() {
        return Err(Failure::Usage(terminal::Error::NoTerminal.to_string())); // before a scene is read for nothing
    }
    let config = config::open(arguments.config.as_deref()).map_err(|error| Failure::Usage(error.to_string()))?;
    let name = arguments.scene.as_deref().unwrap_or(&config.scene);
    let (opened, recording) = open(name)?;
    if let Some(recording) = recording {
        return replay(arguments, config, opened, recording);
    }
    if text { tell(arguments, config, opened) } else { show(arguments, config, opened) }
}

/// A scene, or a recording and the scene that it is of.
fn open(name: &OsStr) -> Result<(Opened, Option<Recording>), Failure> {
    if !name.as_encoded_bytes().ends_with(b".carom") {
        return Ok((scene::open(name).map_err(|error| Failure::Failed(error.to_string()))?, None));
    }
    let recording = replay::read(Path::new(name))?;
    let scene = scene::parse(&recording.scene, &recording.key).map_err(|error| Failure::Failed(error.to_string()))?;
    Ok((Opened { key: recording.key.clone(), path: None, scene }, Some(recording)))
}

/// Shows a recording: its run, with its own settings and their changes, compared frame by frame.
fn replay(arguments: &Play, config: Config, opened: Opened, recording: Recording) -> Result<(), Failure> {
    let (settings, solver) = (recording.settings, &arguments.solver);
    if solver.over(settings) != settings || solver.accuracy().is_some() {
        return Err(Failure::Usage(
            "a recording is solved with its own settings; leave --method, --dt, --tolerance and \
                                   --accuracy out, or change them once it is open"
                .into(),
        ));
    }
    if !is_text(arguments) {
        return run_screen(arguments, config, (opened, settings, Some(recording)), None);
    }
    let signals = Signals::watch()?;
    let begin = if arguments.paused { Begin::Here(None) } else { Begin::Tell(latest_end(&opened.scene, &recording)) };
    let setup = Setup { recording: Some(recording), ..setup(config, opened, settings) };
    talk::talk(setup, begin, &Ears::open()?, &signals)
}

/// By when a recording has ended, s: no frame is longer than dt, and one more is none of it.
fn latest_end(scene: &Scene, recording: &Recording) -> f64 {
    let begins = scene.resume.as_ref().map_or(0.0, |resume| resume.t);
    let longest = recording.changes.iter().map(|change| change.settings.dt).fold(recording.settings.dt, f64::max);
    begins + (recording.frames.len() as f64 + 1.0) * longest
}

/// Whether neither the command line nor the configuration says what to look at.
fn is_first_look(arguments: &Play, configured: &OsStr) -> bool {
    arguments.scene.is_none() && !arguments.paused && configured == config::FIRST
}

fn is_text(arguments: &Play) -> bool {
    arguments.text || std::env::var_os("TERM").is_some_and(|term| term == "dumb")
}

fn tell(arguments: &Play, config: Config, opened: Opened) -> Result<(), Failure> {
    let signals = Signals::watch()?;
    let (settings, said) = accuracy::settings(&arguments.solver, &opened.scene, opened.scene.duration, Some(&signals))?;
    said.iter().for_each(|said| note(said));
    let ears = if arguments.paused || lines::are_typed() { Some(Ears::open()?) } else { None };
    if let Some(ears) = ears.as_ref().filter(|_| arguments.paused) {
        return talk::talk(setup(config, opened, settings), Begin::Here(None), ears, &signals);
    }
    let endless = scene::endless(&opened.scene, settings, opened.scene.duration);
    endless.iter().for_each(|warning| note(&format!("{}: {warning}", opened.key)));
    let mut out = Output::stdout();
    // A line that is typed stops the run there; then lines are keys, this one too.
    let typed = RefCell::new(None);
    let keep_on = || {
        if let Some(Ok(Event::Line(Some(line)))) = ears.as_ref().map(|ears| ears.events.try_recv()) {
            *typed.borrow_mut() = Some(line);
            return false;
        }
        signals.check().is_ok()
    };
    match text_mode::tell(&opened.scene, settings, &mut out, keep_on)? {
        Ending::Done => out.finish(),
        Ending::Stalled(stall) => out.finish().and(Err(Failure::Failed(stall.reason))),
        Ending::Stopped(time) => match ears.zip(typed.take()) {
            Some((ears, line)) => {
                out.finish()?;
                let first = Some(line).filter(|line| !line.is_empty());
                talk::talk(setup(config, opened, settings), Begin::At(time, first), &ears, &signals)
            }
            None => signals.check(),
        },
    }
}

/// The application that a conversation is led with.
fn setup(config: Config, opened: Opened, settings: Settings) -> Setup {
    let (marker, colors, inks) = (Marker::Ascii, Colors::Never, config.inks);
    Setup {
        opened,
        settings,
        paused: true,
        taken_apart: false,
        marker,
        colors,
        inks,
        keymap: config.keymap,
        recording: None,
        folder: PathBuf::from("."),
    }
}

fn show(arguments: &Play, config: Config, opened: Opened) -> Result<(), Failure> {
    let (settings, message) = accuracy::settings(&arguments.solver, &opened.scene, opened.scene.duration, None)?;
    run_screen(arguments, config, (opened, settings, None), message)
}

fn run_screen(
    arguments: &Play,
    config: Config,
    (opened, settings, recording): (Opened, Settings, Option<Recording>),
    message: Option<String>,
) -> Result<(), Failure> {
    let options = Options {
        opened,
        settings,
        recording,
        message,
        paused: arguments.paused,
        taken_apart: is_first_look(arguments, &config.scene),
        marker: arguments.display.marker.map(Into::into).or(config.marker),
        color: arguments.display.color.map_or(config.color, Color::depth),
        bandwidth: arguments.bandwidth.or(config.bandwidth),
        frame_rate: config.frame_rate,
        inks: config.inks,
        keymap: config.keymap,
    };
    match terminal::run(options) {
        Ok(Outcome::Quit) => Ok(()),
        Ok(Outcome::Signal(number)) => Err(Failure::Signal(u8::try_from(number).unwrap_or(u8::MAX))),
        Err(error @ terminal::Error::NoTerminal) => Err(Failure::Usage(error.to_string())),
        Err(error) => Err(Failure::Failed(error.to_string())),
    }
}
