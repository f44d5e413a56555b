//! The command line: arguments turned into plain values, and the command that is run with them. Begin with `arguments`,
//! then the file of a command.
//!
//! | file | owns |
//! |---|---|
//! | `arguments` | every command, option and range, as clap reads and explains them |
//! | `numbers` | the ranges of the numbers, and their messages |
//! | `failure` | how a command can end, its exit code and its one line |
//! | `signals` | INT, TERM and HUP as exit codes |
//! | `output` | standard output and files that are replaced as a whole |
//! | `jury` | what watches and judges a run of `carom run` |
//! | `progress` | how far work is that may take minutes |
//! | `results` | what the commands that measure read and write |
//! | `place` | which file a word leads to |
//! | `target` | a FILE of the command line, and that no output destroys another or an input |
//! | `rows` | how many rows a run is asked for |
//! | `accuracy` | a setting chosen by the error wanted |
//! | `frames` | a run without a screen, frame by frame |
//! | `cast` | a film of the screen, for `carom record` |
//! | `talk`, `lines` | the application without a screen: lines are keys |
//! | the rest | one command each |

mod accuracy;
mod arguments;
mod cast;
mod certified;
mod check;
mod completions;
mod crowd;
mod defaults;
mod failure;
mod frames;
mod judge;
mod jury;
mod lines;
mod list;
mod man;
mod measure;
mod methods;
mod numbers;
mod origin;
mod output;
mod place;
mod play;
mod progress;
mod record;
mod render;
mod replay;
mod results;
mod rows;
mod run;
mod show;
mod signals;
mod talk;
mod target;
mod verify;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use arguments::{Arguments, Command};
use failure::Failure;
use signals::Signals;

/// Runs the program; the exit code is 0 done, 1 failed, 2 wrong usage, 128 + n for signal n.
pub fn main() -> ExitCode {
    let done = parse(std::env::args_os()).and_then(|arguments| dispatch(&arguments));
    done.map_or_else(|failure| failure.report(), |()| ExitCode::SUCCESS)
}

/// The whole command line as clap sees it: what completions, the manual page and the test of the README read.
pub fn command() -> clap::Command {
    Arguments::command()
}

fn parse(words: impl IntoIterator<Item = OsString>) -> Result<Arguments, Failure> {
    Arguments::try_parse_from(words).map_err(Failure::Clap)
}

fn dispatch(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        None => play::play(&arguments.play),
        Some(command) => without_screen(command, &Signals::watch()?),
    }
}

fn without_screen(command: &Command, signals: &Signals) -> Result<(), Failure> {
    match command {
        Command::List => list::list(),
        Command::Show(arguments) => show::show(arguments),
        Command::Methods(arguments) => methods::methods(arguments),
        Command::Check(arguments) => check::check(arguments),
        Command::Run(arguments) => run::run(arguments, signals),
        Command::Render(arguments) => render::render(arguments, signals),
        Command::Record(arguments) => record::record(arguments, signals),
        Command::Replay(arguments) => replay::replay(arguments, signals),
        Command::Judge(arguments) => judge::judge(arguments, signals),
        Command::Measure(arguments) => measure::measure(arguments, signals),
        Command::Verify(arguments) => verify::verify(arguments, signals),
        Command::Config => defaults::defaults(),
        Command::Completions(arguments) => completions::completions(arguments),
        Command::Man => man::man(),
    }
}
