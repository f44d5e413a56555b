//! `carom [SCENE]`: the TUI, or the run told in lines.

use std::io::{self, IsTerminal};

use super::accuracy;
use super::arguments::{Color, Play};
use super::failure::{Failure, note};
use super::output::Output;
use super::signals::Signals;
use crate::config::{self, Config};
use crate::scene::{self, Opened};
use crate::terminal::{self, Options, Outcome};
use crate::text_mode::{self, Ending};

pub(super) fn play(arguments: &Play) -> Result<(), Failure> {
    let text = arguments.text || std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    if !text && !io::stdout().is_terminal() {
        return Err(Failure::Usage(terminal::Error::NoTerminal.to_string())); // before a scene is read for nothing
    }
    let config = config::open(arguments.config.as_deref()).map_err(|error| Failure::Usage(error.to_string()))?;
    let name = arguments.scene.as_deref().unwrap_or(&config.scene);
    let opened = scene::open(name).map_err(|error| Failure::Failed(error.to_string()))?;
    if text { tell(arguments, &opened) } else { show(arguments, config, opened) }
}

fn tell(arguments: &Play, opened: &Opened) -> Result<(), Failure> {
    let signals = Signals::watch()?;
    let (settings, said) = accuracy::settings(&arguments.solver, &opened.scene, opened.scene.duration, Some(&signals))?;
    said.iter().for_each(|said| note(said));
    let endless = scene::endless(&opened.scene, settings, opened.scene.duration);
    endless.iter().for_each(|warning| note(&format!("{}: {warning}", opened.key)));
    let mut out = Output::stdout();
    match text_mode::tell(&opened.scene, settings, &mut out, || signals.check().is_ok())? {
        Ending::Done => out.finish(),
        Ending::Stalled(stall) => out.finish().and(Err(Failure::Failed(stall.reason))),
        Ending::Stopped => signals.check(),
    }
}

fn show(arguments: &Play, config: Config, opened: Opened) -> Result<(), Failure> {
    let (settings, message) = accuracy::settings(&arguments.solver, &opened.scene, opened.scene.duration, None)?;
    let options = Options {
        opened,
        settings,
        message,
        paused: arguments.paused,
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
