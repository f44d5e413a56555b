//! The built binary, run without a terminal, and its results read back.

use std::fs;
use std::process::{Child, Command, Output, Stdio};

use tempfile::TempDir;

use crate::watch;

/// What a run of the binary left.
#[derive(Debug)]
pub(crate) struct Ran {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Ran {
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        Ran { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
    }
}

impl Ran {
    #[track_caller]
    pub(crate) fn succeeds(self) -> Ran {
        self.ends_with(0)
    }

    /// Fails with that code and says why.
    #[track_caller]
    pub(crate) fn fails_with(self, code: i32) -> Ran {
        assert!(!self.err.is_empty(), "a failure without a word: {self:?}");
        self.ends_with(code)
    }

    #[track_caller]
    fn ends_with(self, code: i32) -> Ran {
        assert_eq!(self.code, Some(code), "{self:?}");
        self
    }
}

/// The binary in a plain environment.
pub(crate) fn command(arguments: &[&str]) -> Command {
    plain(Command::new(env!("CARGO_BIN_EXE_carom")), arguments)
}

/// The binary with the signals that end a program as the system sets them, whatever the tests inherited: under nohup
/// SIGHUP is ignored, and what is ignored stays so. `env` is GNU's.
pub(crate) fn with_default_signals(arguments: &[&str]) -> Command {
    let mut command = Command::new("env");
    command.args(["--default-signal=HUP,INT,QUIT,TERM", env!("CARGO_BIN_EXE_carom")]);
    plain(command, arguments)
}

fn plain(mut command: Command, arguments: &[&str]) -> Command {
    command.args(arguments).env("TERM", "xterm-256color").env("CAROM_CONFIG", "/dev/null").stdin(Stdio::null());
    for name in ["NO_COLOR", "COLORTERM", "CLICOLOR_FORCE", "COLUMNS", "LINES"] {
        command.env_remove(name);
    }
    command
}

/// Runs it to its end.
pub(crate) fn carom(arguments: &[&str]) -> Ran {
    Ran::from(watch::output(&mut command(arguments)))
}

/// Starts it with pipes to read from.
pub(crate) fn spawn(arguments: &[&str]) -> Child {
    piped(with_default_signals(arguments))
}

/// Starts a command with pipes to read from.
pub(crate) fn piped(mut command: Command) -> Child {
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the built binary")
}

/// The closing line of `run`.
#[derive(Debug, Default)]
pub(crate) struct Closing {
    pub(crate) t: f64,
    pub(crate) impacts: u64,
    pub(crate) energy: f64,
    pub(crate) hash: u64,
    pub(crate) stall: Option<String>,
    pub(crate) certified_until: Option<f64>,
    pub(crate) error: Option<f64>,
}

/// Reads the last line, which must be a closing line and nothing else.
#[track_caller]
pub(crate) fn closing(text: &str) -> Closing {
    let line = text.lines().last().expect("a closing line");
    let mut closing = Closing::default();
    let words: Vec<(&str, &str)> = line.split(' ').map(|word| word.split_once('=').expect("key=value")).collect();
    assert!(["t", "impacts", "energy", "hash"].iter().eq(words[..4].iter().map(|(key, _)| key)), "{line}");
    for (key, value) in words {
        match key {
            "t" => closing.t = number(Some(value)),
            "impacts" => closing.impacts = value.parse().expect("a count"),
            "energy" => closing.energy = number(Some(value)),
            "hash" => {
                assert_eq!(value.len(), 16, "{line}");
                closing.hash = u64::from_str_radix(value, 16).expect("hexadecimal digits");
            }
            "certified_until" => closing.certified_until = Some(number(Some(value))),
            "error" => closing.error = Some(number(Some(value))),
            "stall" => closing.stall = Some(value.into()),
            _ => panic!("{key} is not part of a closing line: {line}"),
        }
    }
    closing
}

/// A number of a result.
#[track_caller]
pub(crate) fn number(text: Option<&str>) -> f64 {
    text.and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{text:?} is no number"))
}

/// A row of numbers.
pub(crate) fn numbers(row: &str) -> Vec<f64> {
    row.split(',').map(|cell| number(Some(cell))).collect()
}

/// One column of rows.
pub(crate) fn column(rows: &[Vec<f64>], index: usize) -> Vec<f64> {
    rows.iter().map(|row| row[index]).collect()
}

/// The bits of a flat object's numbers, which must come in the order of the columns. Read by Rust itself: serde_json's
/// ordinary way of reading is not exact.
pub(crate) fn json_bits(line: &str, columns: &[&str]) -> Vec<u64> {
    let fields = line.strip_prefix('{').and_then(|line| line.strip_suffix('}')).expect("an object");
    let (keys, values): (Vec<&str>, Vec<&str>) =
        fields.split(',').map(|field| field.split_once(':').expect("a field")).unzip();
    assert_eq!(keys, columns.iter().map(|column| format!("\"{column}\"")).collect::<Vec<_>>());
    values.into_iter().map(|value| number(Some(value)).to_bits()).collect()
}

/// 64-bit FNV-1a over t, then the positions, then the velocities of state rows of one time.
pub(crate) fn fnv(rows: &[Vec<f64>]) -> u64 {
    let x = rows.iter().flat_map(|row| &row[2..5]);
    let v = rows.iter().flat_map(|row| &row[5..8]);
    let values = std::iter::once(&rows[0][0]).chain(x).chain(v);
    values
        .flat_map(|value| value.to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// Energy of a sphere of 1 kg under the paper's gravity, J: ½ v² + 9.8 y.
pub(crate) fn energy(row: &[f64]) -> f64 {
    0.5 * (row[5] * row[5] + row[6] * row[6] + row[7] * row[7]) + 9.8 * row[3]
}

/// A folder that goes with its owner.
pub(crate) fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// A path in it.
pub(crate) fn in_folder(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().expect("a plain path").to_string()
}

/// What is in it.
pub(crate) fn names_in(folder: &TempDir) -> Vec<String> {
    let entries = fs::read_dir(folder.path()).expect("the folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into()).collect();
    names.sort();
    names
}
