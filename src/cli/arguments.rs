//! Every command, option and range, as clap reads and explains them.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::builder::{OsStringValueParser, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use clap_complete::Shell;

use super::numbers;
use super::target::Target;
use crate::config;
use crate::export::Columns;
use crate::measure::{CostAxis, ErrorAxis, Shard};
use crate::printable;
use crate::scene::{Method, Settings};
use crate::view::{Colors, Marker};

/// The end of the help, with the place of the configuration on this machine.
fn after() -> String {
    let place = config::default_path()
        .map_or_else(|| "none without a home folder".into(), |path| printable::name(path.as_os_str()));
    format!("Configuration: {place}, or the file that --config or {} names.\n{AFTER}", config::VARIABLE)
}

/// The end of the help and of the manual page.
pub(super) const AFTER: &str = "\
Results go to standard output, everything else to standard error.
Exit status: 0 done, 1 failed, 2 wrong usage, 128 + n ended by signal n.
A signal to end that is ignored at the start, as SIGHUP is under nohup, stays ignored.";

/// Rigid spheres bouncing between parallelogram walls and each other: how much accuracy for how much time?
#[derive(Debug, Parser)]
#[command(name = "carom", version, about, after_help = after(), args_conflicts_with_subcommands = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Option<Command>,
    #[command(flatten)]
    pub(super) play: Play,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// List the built-in scenes
    List,
    /// Print a built-in scene's file, to start one's own from
    Show(Show),
    /// Tell what each method is, its order, and when not to use it
    Methods(Methods),
    /// Validate scenes, and say what each requires
    Check(Check),
    /// Run a scene without a screen
    Run(Run),
    /// Print one frame of the screen
    Render(Render),
    /// Record a run: a file that proves itself, or a film of the screen
    Record(Record),
    /// Run a recording again, and name the first frame and sphere that differ
    Replay(Replay),
    /// Measure how much accuracy costs how much time
    Measure(Measure),
    /// Mark trajectories of any program against exact, or against each other
    Judge(Judge),
    /// Measure known results of physics and mathematics on this machine
    Verify(Verify),
    /// Print the default configuration, a file to start one's own from
    Config,
    /// Print the completions for a shell
    Completions(Completions),
    /// Print the manual page
    Man,
}

/// The TUI.
#[derive(Debug, Args)]
pub(super) struct Play {
    /// Scene file or built-in name [default: that of the configuration, else a collision of billiard taken apart]
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) scene: Option<OsString>,
    #[command(flatten)]
    pub(super) solver: Solver,
    /// Start paused; with --text, every line of standard input is keys then
    #[arg(long)]
    pub(super) paused: bool,
    #[command(flatten)]
    pub(super) display: Display,
    /// Most bytes per second to the terminal, k for thousands, M for millions: for lines that are shared or dear
    #[arg(long, value_name = "B", value_parser = config::bandwidth)]
    pub(super) bandwidth: Option<u64>,
    /// Tell the run in lines, one per event, without a screen
    #[arg(long)]
    pub(super) text: bool,
    /// Configuration to read instead of the usual one; /dev/null for none
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) config: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct Show {
    /// Name of a built-in scene
    pub(super) name: String,
}

#[derive(Debug, Args)]
pub(super) struct Methods {
    /// Only this one, in full
    #[arg(value_parser = method())]
    pub(super) method: Option<Method>,
}

#[derive(Debug, Args)]
pub(super) struct Check {
    /// Scene files or built-in names
    #[arg(required = true, value_name = "SCENE", value_hint = ValueHint::FilePath)]
    pub(super) scenes: Vec<OsString>,
}

#[derive(Debug, Args)]
pub(super) struct Run {
    /// Scene file or built-in name
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) scene: OsString,
    /// End of the run, s [default: the scene's duration]
    #[arg(long, value_name = "T", value_parser = numbers::not_negative, allow_hyphen_values = true)]
    pub(super) until: Option<f64>,
    /// Time between two states, s [default: only the first and the last state]
    #[arg(long, value_name = "S", requires = "states", value_parser = numbers::positive, allow_hyphen_values = true)]
    pub(super) every: Option<f64>,
    /// Write the states however many rows that are; without it, more than 1e8 are refused
    #[arg(long, requires = "every")]
    pub(super) yes: bool,
    /// Write times, positions and velocities; JSON lines if it ends in .jsonl, else CSV; - is standard output
    #[arg(long, value_name = "FILE", value_parser = target(), value_hint = ValueHint::FilePath)]
    pub(super) states: Option<Target>,
    /// Write collisions, rests and releases; JSON lines if it ends in .jsonl, else CSV; - is standard output
    #[arg(long, value_name = "FILE", value_parser = target(), value_hint = ValueHint::FilePath)]
    pub(super) events: Option<Target>,
    /// Have an independent judge look at every frame and event; exit code 1 if it finds anything
    #[arg(long)]
    pub(super) check: bool,
    /// Run by exact (without --method), follow it in arithmetic of 32 digits, and state its own error and until when that
    /// is known
    #[arg(long, conflicts_with = "accuracy")]
    pub(super) certify: bool,
    #[command(flatten)]
    pub(super) solver: Solver,
}

#[derive(Debug, Args)]
pub(super) struct Record {
    /// Scene file or built-in name
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) scene: OsString,
    /// What to write: .carom has the scene, the settings and eight bytes per frame, .cast is an asciicast (v3) with a marker
    /// per collision
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) file: PathBuf,
    /// End of the run, s [default: the scene's duration]
    #[arg(long, value_name = "T", value_parser = numbers::not_negative, allow_hyphen_values = true)]
    pub(super) until: Option<f64>,
    /// Replace a file that is there
    #[arg(long)]
    pub(super) force: bool,
    /// Columns and rows of a film
    #[arg(long, value_name = "WxH", default_value = "80x24", value_parser = numbers::size)]
    pub(super) size: (u16, u16),
    /// Simulated seconds per second of a film
    #[arg(long, value_name = "X", default_value = "1", value_parser = numbers::positive, allow_hyphen_values = true)]
    pub(super) speed: f64,
    #[command(flatten)]
    pub(super) solver: Solver,
}

#[derive(Debug, Args)]
pub(super) struct Replay {
    /// A recording, .carom
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) file: PathBuf,
}

#[derive(Debug, Args)]
pub(super) struct Render {
    /// Scene file or built-in name
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) scene: OsString,
    /// Time of the frame, s
    #[arg(long, value_name = "T", default_value = "0", value_parser = numbers::not_negative, allow_hyphen_values = true)]
    pub(super) at: f64,
    /// The frame of the N-th collision, taken apart
    #[arg(long, value_name = "N", conflicts_with = "at", value_parser = numbers::count)]
    pub(super) collision: Option<usize>,
    /// Columns and rows
    #[arg(long, value_name = "WxH", default_value = "80x24", value_parser = numbers::size)]
    pub(super) size: (u16, u16),
    /// What to print it as
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(super) format: Format,
    #[command(flatten)]
    pub(super) solver: Solver,
    #[command(flatten)]
    pub(super) display: Display,
}

const LARGE_SWEEPS: &str = "\
Large sweeps run in parts, under any scheduler, and are merged:
  parallel carom measure paper-3 --jobs 1 --shard {}/8 --csv {}.csv ::: 1 2 3 4 5 6 7 8
  carom measure --merge 1.csv 2.csv 3.csv 4.csv 5.csv 6.csv 7.csv 8.csv --svg trade.svg
docs/measure.md tells what each figure means, and has a Slurm array script.";

#[derive(Debug, Args)]
#[command(after_help = LARGE_SWEEPS)]
pub(super) struct Measure {
    /// Scene files or built-in names
    #[arg(required_unless_present = "merge", value_name = "SCENE", value_hint = ValueHint::FilePath)]
    pub(super) scenes: Vec<OsString>,
    /// Methods that compete [default: all, and exact as the yardstick alone]
    #[arg(long, value_name = "M,…", value_delimiter = ',', value_parser = method())]
    pub(super) methods: Vec<Method>,
    /// Longest steps, s [default: 1e-1,1e-2,1e-3,1e-4]
    #[arg(long, value_name = "S,…", value_delimiter = ',', value_parser = numbers::positive, allow_hyphen_values = true)]
    pub(super) dt: Vec<f64>,
    /// Intersection tolerances, degrees [default: 1e-2,1e-4,1e-6,1e-8,1e-10,1e-12]
    #[arg(long, value_name = "D,…", value_delimiter = ',', value_parser = numbers::not_negative,
          allow_hyphen_values = true)]
    pub(super) tolerances: Vec<f64>,
    /// Settings measured side by side [default: the processors there are]
    #[arg(long, value_name = "N", value_parser = numbers::count)]
    pub(super) jobs: Option<usize>,
    /// Write every row as CSV; - is standard output
    #[arg(long, value_name = "FILE", value_parser = target(), value_hint = ValueHint::FilePath)]
    pub(super) csv: Option<Target>,
    /// Draw the trade, or the crowds, as a figure; - is standard output
    #[arg(long, value_name = "FILE", value_parser = target(), value_hint = ValueHint::FilePath)]
    pub(super) svg: Option<Target>,
    /// Write every row as JSON, an object a line, with the command that repeats it and the machine; - is standard output
    #[arg(long, value_name = "FILE", value_parser = target(), value_hint = ValueHint::FilePath)]
    pub(super) json: Option<Target>,
    /// The cost across: cpu, gaps, events, frames or dt
    #[arg(long, value_name = "COST", default_value = "cpu", value_parser = cost_axis())]
    pub(super) x: CostAxis,
    /// The error up: position, time (of the first impacts), energy or depth (of overlap)
    #[arg(long, value_name = "ERROR", default_value = "position", value_parser = error_axis())]
    pub(super) y: ErrorAxis,
    /// Processor time after which a setting is given up and listed as failed, s [default: never; of a crowd a minute of counted
    /// work a run]
    #[arg(long, value_name = "S", value_parser = numbers::positive, allow_hyphen_values = true)]
    pub(super) timeout: Option<f64>,
    /// The horizon is where the certified error of exact exceeds this, m
    #[arg(long, value_name = "E", default_value = "1e-6", value_parser = numbers::positive, allow_hyphen_values = true)]
    pub(super) error: f64,
    /// Judge a crowd beyond its horizon instead: means and standard errors over N runs that begin a hair aside
    #[arg(long, value_name = "N", value_parser = numbers::count, conflicts_with = "merge")]
    pub(super) crowd: Option<usize>,
    /// Measure only part I of N, I from 1; of a crowd the table has its runs
    #[arg(long, value_name = "I/N", value_parser = Shard::parse)]
    pub(super) shard: Option<Shard>,
    /// Join the CSV files of parts instead of measuring
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["scenes", "shard", "dt", "tolerances", "jobs", "timeout"],
          value_hint = ValueHint::FilePath)]
    pub(super) merge: Vec<PathBuf>,
}

impl Measure {
    /// What it writes, by the option that asks for it.
    pub(super) fn outputs(&self) -> [(&'static str, Option<&Target>); 3] {
        [("--csv", self.csv.as_ref()), ("--svg", self.svg.as_ref()), ("--json", self.json.as_ref())]
    }
}

const JUDGE: &str = "\
A FILE has the columns time,sphere,x,y,z,vx,vy,vz (s, m, m/s), separated by commas, semicolons or tabs, in the order of
time; velocities may be missing, and `sphere` where there is one; or time,x0,y0,z0,x1,… with all spheres in a row. docs/measure.md tells what each figure means.
Exit status: 0 everything passes, 1 something fails, 2 a file cannot be read.";

/// Mark trajectories of any program.
#[derive(Debug, Args)]
#[command(after_help = JUDGE)]
pub(super) struct Judge {
    /// Trajectories as CSV, one file a program or setting; - is standard input
    #[arg(required = true, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) files: Vec<OsString>,
    /// Scene file or built-in name that they are of
    #[arg(long, value_name = "SCENE", value_hint = ValueHint::FilePath)]
    pub(super) scene: OsString,
    /// Largest position error that passes, m [default: nothing fails]
    #[arg(long, value_name = "E", value_parser = numbers::positive, allow_hyphen_values = true)]
    pub(super) tolerance: Option<f64>,
    /// Compare up to this time, s [default: the scene's duration]
    #[arg(long, value_name = "T", value_parser = numbers::positive, allow_hyphen_values = true)]
    pub(super) until: Option<f64>,
    /// What the files call our columns [default: as we do]; # stands for a sphere's number, as in p#=x
    #[arg(long, value_name = "THEIRS=OURS,…", value_parser = Columns::parse)]
    pub(super) columns: Option<Columns>,
    /// Hold them against this trajectory instead of exact
    #[arg(long, value_name = "FILE2", value_hint = ValueHint::FilePath)]
    pub(super) against: Option<OsString>,
    /// Compare figures of a crowd with this table, which `carom measure SCENE --crowd N --csv TABLE` has made
    #[arg(long, value_name = "TABLE", value_hint = ValueHint::FilePath)]
    pub(super) crowd: Option<OsString>,
    /// The steps with which one program made the files, s, in their order: fits the order of convergence
    #[arg(long, value_name = "S,…", value_delimiter = ',', value_parser = numbers::positive, allow_hyphen_values = true)]
    pub(super) dt: Vec<f64>,
    /// Files marked side by side [default: the processors there are]
    #[arg(long, value_name = "N", value_parser = numbers::count)]
    pub(super) jobs: Option<usize>,
    /// Write every figure as JSON, an object a line and file; - is standard output
    #[arg(long, value_name = "FILE", value_parser = target(), value_hint = ValueHint::FilePath)]
    pub(super) json: Option<Target>,
    /// Draw the errors over time of up to eight files; - is standard output
    #[arg(long, value_name = "FILE", value_parser = target(), value_hint = ValueHint::FilePath)]
    pub(super) svg: Option<Target>,
}

#[derive(Debug, Args)]
pub(super) struct Verify {
    /// Some seconds instead of some minutes: fewer digits, fewer spheres
    #[arg(long)]
    pub(super) quick: bool,
}

#[derive(Debug, Args)]
pub(super) struct Completions {
    /// The shell
    #[arg(value_enum)]
    pub(super) shell: Shell,
}

/// What to solve with, where it shall not be what the scene asks for.
#[derive(Debug, Args)]
pub(super) struct Solver {
    /// Method [default: the scene's]
    #[arg(long, value_name = "M", value_parser = method())]
    method: Option<Method>,
    /// Longest step, s [default: the scene's]
    #[arg(long, value_name = "S", value_parser = numbers::positive, allow_hyphen_values = true)]
    dt: Option<f64>,
    /// Intersection tolerance, a degree [default: the scene's]
    #[arg(long, value_name = "D", value_parser = numbers::not_negative, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Choose the method and setting of least counted work that meets this position error, m, by trying
    #[arg(long, value_name = "E", value_parser = numbers::positive, allow_hyphen_values = true,
          conflicts_with_all = ["dt", "tolerance"])]
    accuracy: Option<f64>,
}

impl Solver {
    /// The position error that is asked for, m, and the methods that may meet it.
    pub(super) fn accuracy(&self) -> Option<(f64, Vec<Method>)> {
        let methods = self.method.map_or(Method::ALL.to_vec(), |method| vec![method]);
        self.accuracy.map(|error| (error, methods))
    }

    /// The method that is named.
    pub(super) fn method(&self) -> Option<Method> {
        self.method
    }

    /// The scene's settings, but for what the command line says.
    pub(super) fn over(&self, scene: Settings) -> Settings {
        Settings {
            method: self.method.unwrap_or(scene.method),
            dt: self.dt.unwrap_or(scene.dt),
            tolerance: self.tolerance.unwrap_or(scene.tolerance),
        }
    }
}

/// How frames look.
#[derive(Debug, Args)]
pub(super) struct Display {
    /// What dots are drawn with [default: what the terminal can show]
    #[arg(long, value_enum, value_name = "MARKER")]
    pub(super) marker: Option<Dots>,
    /// Depth of colour [default: auto]
    #[arg(long, value_enum, value_name = "COLORS")]
    pub(super) color: Option<Color>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Dots {
    /// 2×4 dots a cell
    Braille,
    /// 2×2 quadrants a cell
    Block,
    /// Plain ASCII
    Ascii,
}

impl From<Dots> for Marker {
    fn from(dots: Dots) -> Marker {
        match dots {
            Dots::Braille => Marker::Braille,
            Dots::Block => Marker::Block,
            Dots::Ascii => Marker::Ascii,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Color {
    /// What the terminal can show
    Auto,
    /// None
    Never,
    /// The terminal's own 16
    #[value(name = "16")]
    Ansi16,
    /// The 256-colour cube
    #[value(name = "256")]
    Ansi256,
    /// 24 bits
    Rgb,
}

impl Color {
    /// None: what the terminal can show.
    pub(super) fn depth(self) -> Option<Colors> {
        match self {
            Color::Auto => None,
            Color::Never => Some(Colors::Never),
            Color::Ansi16 => Some(Colors::Ansi16),
            Color::Ansi256 => Some(Colors::Ansi256),
            Color::Rgb => Some(Colors::Rgb),
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// Characters alone
    Text,
    /// Characters and colours, for a terminal
    Ansi,
    /// A picture
    Svg,
}

fn method() -> impl TypedValueParser<Value = Method> {
    let names = PossibleValuesParser::new(Method::ALL.iter().map(|method| method.name()));
    names.try_map(|name| Method::from_name(&name).ok_or("no such method"))
}

fn cost_axis() -> impl TypedValueParser<Value = CostAxis> {
    let names = PossibleValuesParser::new(CostAxis::ALL.iter().map(|(name, _)| *name));
    names.try_map(|name| CostAxis::ALL.iter().find(|axis| axis.0 == name).map(|axis| axis.1).ok_or("no such cost"))
}

fn error_axis() -> impl TypedValueParser<Value = ErrorAxis> {
    let names = PossibleValuesParser::new(ErrorAxis::ALL.iter().map(|(name, _)| *name));
    names.try_map(|name| ErrorAxis::ALL.iter().find(|axis| axis.0 == name).map(|axis| axis.1).ok_or("no such error"))
}

fn target() -> impl TypedValueParser<Value = Target> {
    OsStringValueParser::new().try_map(|word| match word.is_empty() {
        true => Err("must name a file, or be - for standard output"),
        false => Ok(Target::from(word)),
    })
}
