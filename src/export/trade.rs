//! Rows of the trade of accuracy for time: written by `measure --csv`, and read back to be merged.

use std::{fmt, io};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::note::Note;
use super::table::Row;
use crate::printable;

/// One setting on one scene. An empty cell: the method has no such knob, or there is no such figure.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TradeRow {
    /// The scene's key.
    pub scene: String,
    /// The method's name.
    pub method: String,
    /// Longest step, s.
    pub dt: Option<f64>,
    /// Intersection tolerance, a degree.
    pub tolerance: Option<f64>,
    /// How far the run got, s: the scene's duration, or where it stalled.
    pub until: f64,
    /// Up to when positions mean something, s; empty if they do up to the end.
    pub horizon: Option<f64>,
    /// Up to when the reference is certified to the error asked for, s; empty if it is not `exact`.
    pub certified: Option<f64>,
    /// Largest error of the reference itself up to `horizon`, m: no position error below it means anything.
    pub floor: Option<f64>,
    /// Largest |x − x_ref| of any sphere at any instant up to the horizon, m.
    pub position_error: Option<f64>,
    /// Largest time error of the reference's first 10 impacts, s; empty if the run lacks one of them.
    pub impact_time_error: Option<f64>,
    /// How many impacts come in the reference's order, from the first on.
    pub common_events: u64,
    /// |E − E_ref| over the reference's largest |E|, dimensionless.
    pub energy_error: Option<f64>,
    /// Deepest intersection degree at the end of any frame, dimensionless.
    pub deepest_degree: f64,
    /// Impacts up to `until`.
    pub impacts: u64,
    /// Degree evaluations of the whole run.
    pub evaluations: u64,
    /// Impacts, rests and releases of the whole run.
    pub events: u64,
    /// Frames of the whole run.
    pub frames: u64,
    /// Thread CPU time per simulated second, s; the best of several measurements.
    pub cpu_per_s: Option<f64>,
    /// Median of the measured CPU times per simulated second, s.
    pub cpu_median: Option<f64>,
    /// (worst − best) / best of the measured CPU times, dimensionless.
    pub cpu_spread: Option<f64>,
    /// Reasons to doubt these figures; empty if there are none.
    pub note: Note,
}

impl Row for TradeRow {
    const COLUMNS: &'static [&'static str] = &[
        "scene",
        "method",
        "dt",
        "tolerance",
        "until",
        "horizon",
        "certified",
        "floor",
        "position_error",
        "impact_time_error",
        "common_events",
        "energy_error",
        "deepest_degree",
        "impacts",
        "evaluations",
        "events",
        "frames",
        "cpu_per_s",
        "cpu_median",
        "cpu_spread",
        "note",
    ];
}

/// A row with what repeats it: written by `measure --json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TradeNote {
    /// The row.
    #[serde(flatten)]
    pub row: TradeRow,
    /// The command of the first row that is the very same run, because a knob changes nothing; none if this row is the first.
    pub same_as: Option<String>,
    /// The command that measures this setting again.
    pub command: String,
    /// Processor, cores, system and version of Carom.
    pub machine: String,
}

impl TradeNote {
    /// A row measured on a machine by a command with `options`, which is the same run as an earlier one.
    pub fn of(row: &TradeRow, same_as: Option<&TradeRow>, options: &str, machine: &str) -> TradeNote {
        let command = |row: &TradeRow| {
            let knob =
                |name: &str, value: Option<f64>| value.map(|value| format!(" --{name} {value:e}")).unwrap_or_default();
            let knobs = knob("dt", row.dt) + &knob("tolerances", row.tolerance);
            format!("carom measure {} --methods {}{knobs}{options}", row.scene, row.method)
        };
        let same_as = same_as.map(command);
        TradeNote { row: row.clone(), same_as, command: command(row), machine: machine.into() }
    }
}

impl Row for TradeNote {
    /// No columns: the row is written as JSON only.
    const COLUMNS: &'static [&'static str] = &[];
}

/// Reads a file of trade rows, each with its line number.
///
/// # Errors
/// A reader that fails, other columns, a cell that is no number.
pub fn read_trade(reader: impl io::Read) -> Result<Vec<(u64, TradeRow)>, ReadError> {
    read_all(reader, "a measure", improper)
}

/// Why a file of rows is refused. Displays as `line: what is wrong there`, or as ` what is wrong` if it is no line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadError(pub(super) String);

impl ReadError {
    /// The refusal with the name of the file before it.
    pub fn of(self, name: &str) -> ReadError {
        ReadError(format!(" {name}:{}", self.0))
    }
}

impl From<String> for ReadError {
    /// What is wrong with a file as a whole.
    fn from(sentence: String) -> ReadError {
        ReadError(format!(" {sentence}"))
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for ReadError {}

/// Reads a table of rows that `what` has, each with its line number; `improper` says what no row holds.
pub(super) fn read_all<R: Row + DeserializeOwned>(
    reader: impl io::Read,
    what: &str,
    improper: impl Fn(&R) -> Option<String>,
) -> Result<Vec<(u64, R)>, ReadError> {
    read_rows(reader, what, improper).map_err(ReadError)
}

fn read_rows<R: Row + DeserializeOwned>(
    reader: impl io::Read,
    what: &str,
    improper: impl Fn(&R) -> Option<String>,
) -> Result<Vec<(u64, R)>, String> {
    let mut csv = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(reader);
    let mut records = csv.records();
    let header =
        records.next().ok_or(format!("1: the file is empty; the CSV of {what} begins with its column names"))?;
    let header = header.map_err(|error| explain(&error))?;
    if !header.iter().eq(R::COLUMNS.iter().copied()) {
        return Err(format!("1: these are not the columns of {what}; wanted are {}", R::COLUMNS.join(",")));
    }
    records.map(|record| read_row(&record.map_err(|error| explain(&error))?, &improper)).collect()
}

fn read_row<R: Row + DeserializeOwned>(
    record: &csv::StringRecord,
    improper: &impl Fn(&R) -> Option<String>,
) -> Result<(u64, R), String> {
    let line = record.position().map_or(0, csv::Position::line);
    let (found, wanted) = (record.len(), R::COLUMNS.len());
    if found != wanted {
        return Err(format!("{line}: {found} cells, where {wanted} are wanted"));
    }
    let row: R = record.deserialize(None).map_err(|error| format!("{line}: {}", cell::<R>(&error, record)))?;
    if let Some((column, what)) = R::COLUMNS.iter().zip(record).find_map(|(column, text)| Some((column, unseen(text)?)))
    {
        return Err(format!("{line}: {column} holds {what}; wanted is text of characters that can be seen"));
    }
    match improper(&row) {
        Some(what) => Err(format!("{line}: {what}")),
        None => Ok((line, row)),
    }
}

/// The first character of a text that is not printable, in words; none if all are.
fn unseen(text: &str) -> Option<String> {
    text.chars().find(|c| !printable::is_printable(*c)).map(printable::described)
}

/// What is wrong with a row that reads but that no measure writes: numbers that are none or negative.
fn improper(row: &TradeRow) -> Option<String> {
    let numbers = [
        ("tolerance", row.tolerance),
        ("until", Some(row.until)),
        ("horizon", row.horizon),
        ("certified", row.certified),
        ("floor", row.floor),
        ("position_error", row.position_error),
        ("impact_time_error", row.impact_time_error),
        ("energy_error", row.energy_error),
        ("cpu_per_s", row.cpu_per_s),
        ("cpu_median", row.cpu_median),
        ("cpu_spread", row.cpu_spread),
    ];
    if let Some(dt) = row.dt.filter(|dt| !dt.is_finite() || *dt <= 0.0) {
        return Some(format!("dt is {dt:?}; wanted is a finite number above 0"));
    }
    let fine = |value: f64| value.is_finite() && value >= 0.0;
    if let Some((column, value)) = numbers.iter().find(|(_, value)| value.is_some_and(|value| !fine(value))) {
        return Some(format!("{column} is {:?}; wanted is a finite number from 0", value.unwrap_or(f64::NAN)));
    }
    let deepest = row.deepest_degree;
    (!deepest.is_finite()).then(|| format!("deepest_degree is {deepest:?}; wanted is a finite number"))
}

/// Longest cell quoted in a message, characters.
pub(super) const CELL: usize = 60;

/// Which cell of a row is wrong, and what stands in it.
fn cell<R: Row>(error: &csv::Error, record: &csv::StringRecord) -> String {
    let csv::ErrorKind::Deserialize { err, .. } = error.kind() else { return error.to_string() };
    let Some(index) = err.field().and_then(|index| usize::try_from(index).ok()) else { return err.to_string() };
    let column = R::COLUMNS.get(index).copied().unwrap_or("a cell");
    let found = printable::shortened(record.get(index).unwrap_or(""), CELL);
    format!("{column} is \"{found}\"; wanted is a number")
}

pub(super) fn explain(error: &csv::Error) -> String {
    match (error.position(), error.kind()) {
        (_, csv::ErrorKind::Io(error)) => format!(" {}", printable::cause(error)),
        (Some(place), csv::ErrorKind::Utf8 { .. }) => format!("{}: this is no text in UTF-8", place.line()),
        _ => format!(" {error}"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::table::{Format, Table};
    use super::*;

    fn row() -> TradeRow {
        TradeRow {
            scene: "a, \"b\"".into(),
            method: "paper".into(),
            dt: Some(0.1),
            tolerance: None,
            until: 20.0,
            horizon: None,
            certified: Some(20.0),
            floor: Some(1e-15),
            position_error: Some(5e-324),
            impact_time_error: None,
            common_events: 3,
            energy_error: Some(0.30000000000000004),
            deepest_degree: -0.0,
            impacts: 22,
            evaluations: u64::MAX,
            events: 30,
            frames: 200,
            cpu_per_s: Some(1e300),
            cpu_median: None,
            cpu_spread: None,
            note: "stalled at 1 s".into(),
        }
    }

    fn written(rows: &[TradeRow]) -> String {
        let mut table = Table::new::<TradeRow>(Format::Csv, Vec::new()).expect("memory takes every byte");
        rows.iter().for_each(|row| table.write(row).expect("memory takes every byte"));
        String::from_utf8(table.finish().expect("memory takes every byte")).expect("text")
    }

    #[test]
    fn what_is_written_reads_back_to_the_same_row() {
        let text = written(&[row(), TradeRow { dt: None, note: Note::default(), ..row() }]);
        let back = read_trade(text.as_bytes()).expect("our own file");
        assert_eq!(back[0], (2, row()));
        assert_eq!((back[1].0, back[1].1.dt), (3, None));
    }

    #[test]
    fn a_broken_file_is_refused_with_its_line() {
        let good = written(&[row()]);
        for (text, words) in [
            (String::new(), &["1: ", "empty"][..]),
            ("time,sphere\n1,2\n".into(), &["1: ", "columns"]),
            (good.replace("20.0", "soon"), &["2: ", "until", "\"soon\""]),
            (good.clone() + "a,paper,1\n", &["3: ", "3 cells", "21"]),
            (good.replace(",22,", ",-22,"), &["2: ", "impacts", "-22"]),
            (good.replace("1e300", "NaN"), &["2: ", "cpu_per_s is NaN"]),
            (good.replace("paper,0.1", "paper,inf"), &["2: ", "dt is inf", "finite"]),
            (good.replace("paper,0.1", "paper,-0.1"), &["2: ", "dt is -0.1"]),
            (good.replace("paper,0.1", "paper,0"), &["2: ", "dt is 0", "above 0"]),
            (good.replace("paper,0.1", "paper,1e999"), &["2: ", "dt is inf"]),
            (good.replace(",-0.0,", ",inf,"), &["2: ", "deepest_degree is inf"]),
            (good.replace("20.0", "-1"), &["2: ", "until is -1"]),
            (good.replace("stalled", "\u{1b}[2J"), &["2: ", "note", "a control character"]),
            (good.replace("stalled", "\u{202e}"), &["2: ", "note", "a direction mark"]),
        ] {
            let error = read_trade(text.as_bytes()).expect_err(&text).to_string();
            assert!(words.iter().all(|word| error.contains(word)), "{error}");
        }
    }
}
