//! Rows of `measure --crowd`: a figure of a setting, and a run of a part; both read back.

use std::io;

use serde::{Deserialize, Serialize};

use super::table::Row;
use super::trade::{ReadError, read_all};

/// What is measured of a crowd: its name, its unit, and its column in a table of runs. The last [`RESIDUALS`] of them are 0
/// but for rounding and for what a method leaves unsolved.
pub const FIGURES: [(&str, &str, &str); 16] = [
    ("energy at a twentieth", "J", "energy_5"),
    ("energy at a tenth", "J", "energy_10"),
    ("energy at a quarter", "J", "energy_25"),
    ("energy at half", "J", "energy_50"),
    ("energy at the end", "J", "energy_100"),
    ("load on walls / weight", "", "load"),
    ("contact forces / weight", "", "forces"),
    ("contacts of a sphere", "", "contacts"),
    ("packing", "", "packing"),
    ("height of the lowest tenth", "m", "height_10"),
    ("median height", "m", "height_50"),
    ("height of the highest tenth", "m", "height_90"),
    ("settled after", "s", "settled"),
    ("overlap at rest", "m", "overlap"),
    ("pull at rest", "N", "pull"),
    ("gap × force at rest", "J", "gap_force"),
];

/// How many figures are residuals of Signorini's conditions.
pub const RESIDUALS: usize = 3;

/// A mean over runs of one setting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CrowdRow {
    /// The scene's key.
    pub scene: String,
    /// The method's name.
    pub method: String,
    /// Longest step, s.
    pub dt: Option<f64>,
    /// Intersection tolerance, a degree.
    pub tolerance: Option<f64>,
    /// Runs that were begun.
    pub runs: u64,
    /// Time that all runs reached, s.
    pub reached: f64,
    /// Name of the figure.
    pub figure: String,
    /// Unit of the figure; empty if it has none.
    pub unit: String,
    /// Mean over the runs that have the figure; empty if none has.
    pub mean: Option<f64>,
    /// Standard error of the mean.
    pub standard_error: Option<f64>,
    /// Number of runs that have the figure.
    pub seeds: u64,
    /// Whether other settings are held against this one.
    pub standard: bool,
    /// Whether the mean is within three standard errors of that of the setting that others are held against.
    pub agrees: Option<bool>,
    /// Whether the mean is within three standard errors of that of this setting with half the step, if that was measured
    /// too.
    pub agrees_with_half: Option<bool>,
}

impl Row for CrowdRow {
    const COLUMNS: &'static [&'static str] = &[
        "scene",
        "method",
        "dt",
        "tolerance",
        "runs",
        "reached",
        "figure",
        "unit",
        "mean",
        "standard_error",
        "seeds",
        "standard",
        "agrees",
        "agrees_with_half",
    ];
}

/// One run of a part: written by `measure --crowd N --shard I/M`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CrowdRun {
    /// The scene's key.
    pub scene: String,
    /// The scene's duration, s.
    pub until: f64,
    /// The method's name.
    pub method: String,
    /// Longest step, s.
    pub dt: Option<f64>,
    /// Intersection tolerance, a degree.
    pub tolerance: Option<f64>,
    /// Number of the run, from 1.
    pub seed: u64,
    /// Number of runs in all parts.
    pub seeds: u64,
    /// Time that the run reached, s.
    pub reached: f64,
    /// Why the run stopped before its end, `stalled` or `spent`; empty if it came to its end.
    pub stopped: String,
    /// Figures of the run in the order of [`FIGURES`]; empty where it has no such figure.
    pub figures: [Option<f64>; FIGURES.len()],
}

impl Row for CrowdRun {
    const COLUMNS: &'static [&'static str] = &[
        "scene",
        "until",
        "method",
        "dt",
        "tolerance",
        "seed",
        "seeds",
        "reached",
        "stopped",
        FIGURES[0].2,
        FIGURES[1].2,
        FIGURES[2].2,
        FIGURES[3].2,
        FIGURES[4].2,
        FIGURES[5].2,
        FIGURES[6].2,
        FIGURES[7].2,
        FIGURES[8].2,
        FIGURES[9].2,
        FIGURES[10].2,
        FIGURES[11].2,
        FIGURES[12].2,
        FIGURES[13].2,
        FIGURES[14].2,
        FIGURES[15].2,
    ];
}

/// Whether a file begins as a part of a crowd does.
pub fn is_crowd_part(text: &[u8]) -> bool {
    let first = text.split(|byte| *byte == b'\n').next().unwrap_or_default();
    first.trim_ascii_end() == CrowdRun::COLUMNS.join(",").as_bytes()
}

/// Reads a part, each run with its line number.
///
/// # Errors
/// A reader that fails, other columns, a cell that is no number, a number that no run gives.
pub fn read_crowd_runs(reader: impl io::Read) -> Result<Vec<(u64, CrowdRun)>, ReadError> {
    read_all(reader, "a part of a crowd", |run: &CrowdRun| {
        let fine = |value: f64| value.is_finite() && value >= 0.0;
        let figures = run.figures.iter().flatten().all(|value| value.is_finite());
        let knobs = [run.dt, run.tolerance].into_iter().flatten().all(fine);
        let whole = fine(run.until) && fine(run.reached) && knobs && figures;
        let seeds = (1..=run.seeds).contains(&run.seed);
        (!whole)
            .then(|| "wanted are finite numbers, times and knobs from 0".to_owned())
            .or_else(|| (!seeds).then(|| format!("seed is {}; wanted is one from 1 to seeds, {}", run.seed, run.seeds)))
    })
}

/// Reads the table of a crowd, each row with its line number.
///
/// # Errors
/// A reader that fails, other columns, a cell that is no number, a number that no crowd gives.
pub fn read_crowd(reader: impl io::Read) -> Result<Vec<(u64, CrowdRow)>, ReadError> {
    read_all(reader, "the table of a crowd", |row: &CrowdRow| {
        let finite = |value: Option<f64>| value.is_none_or(f64::is_finite);
        let fine = finite(row.mean) && row.standard_error.is_none_or(|error| error.is_finite() && error >= 0.0);
        (!fine).then(|| "mean and standard_error: wanted are finite numbers, the latter from 0".to_owned())
    })
}

#[cfg(test)]
mod tests {
    use super::super::table::{Format, Table};
    use super::*;

    fn run() -> CrowdRun {
        let mut figures = [Some(0.1); FIGURES.len()];
        figures[3] = None;
        figures[4] = Some(0.30000000000000004);
        CrowdRun {
            scene: "heap".into(),
            until: 10.0,
            method: "moreau".into(),
            dt: Some(1e-2),
            tolerance: None,
            seed: 2,
            seeds: 30,
            reached: 9.95,
            stopped: "spent".into(),
            figures,
        }
    }

    fn written() -> String {
        let mut table = Table::new::<CrowdRun>(Format::Csv, Vec::new()).expect("memory takes every byte");
        table.write(&run()).expect("memory takes every byte");
        String::from_utf8(table.finish().expect("memory takes every byte")).expect("text")
    }

    #[test]
    fn a_run_reads_back_to_the_bit() {
        assert!(is_crowd_part(written().as_bytes()));
        assert_eq!(read_crowd_runs(written().as_bytes()).expect("our own file"), [(2, run())]);
        assert_eq!(CrowdRun::COLUMNS.len(), 9 + FIGURES.len());
    }

    #[test]
    fn a_broken_part_is_refused_with_its_line() {
        for (from, to, words) in [
            ("9.95", "soon", &["2: ", "reached is \"soon\""][..]),
            ("9.95", "inf", &["2: ", "finite"]),
            (",2,30,", ",31,30,", &["2: ", "seed is 31", "30"]),
            ("scene,", "scenes,", &["1: ", "columns", "a part of a crowd"]),
            ("0.30000000000000004", "1,2", &["2: ", "26 cells", "25"]),
        ] {
            let error = read_crowd_runs(written().replacen(from, to, 1).as_bytes()).expect_err(to).to_string();
            assert!(words.iter().all(|word| error.contains(word)), "{error}");
        }
    }
}
