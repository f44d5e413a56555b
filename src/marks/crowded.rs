//! Figures of a crowd in words and as rows.

use std::fmt::Write;

use super::norm::{Beside, Normal};
use crate::export::{CrowdMark, FIGURES};
use crate::format;

/// Largest difference that is told, in deviations.
const FAR: f64 = 1000.0;

/// A line for each figure: of the trajectory, mean and deviation of many runs, and whether it may be one of them. Then what
/// is not known, and why.
pub(super) fn crowd(figures: &[Beside]) -> String {
    if figures.is_empty() {
        return String::new();
    }
    let mut text = format!("  {:30} {:>12} {:>12} ± deviation\n", "as a crowd", "here", "mean of runs");
    for beside in figures.iter().filter(|beside| beside.value.is_some()) {
        let (name, unit, _) = FIGURES[beside.figure];
        let unit = if unit.is_empty() { String::new() } else { format!(", {unit}") };
        let value = number(beside.value);
        let runs = beside.normal.as_ref().map_or(String::new(), |Normal { mean, deviation, .. }| {
            format!("{:>12} ± {:8} {}", number(Some(*mean)), format::digits(*deviation, 1), verdict(beside))
        });
        let line = format!("  {:30} {value:>12} {runs}", format!("{name}{unit}"));
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text + &settings(figures) + &unknown(figures)
}

fn verdict(beside: &Beside) -> String {
    match beside.apart() {
        None => String::new(),
        Some(apart) if beside.agrees() == Some(true) => format!("within: {apart:.1}"),
        Some(apart) if apart < FAR => format!("differs: {apart:.1}"),
        Some(_) => "differs: over 1000".into(),
    }
}

/// A sentence on which runs the figures are held against.
fn settings(figures: &[Beside]) -> String {
    let mut names: Vec<String> = Vec::new();
    for normal in figures.iter().filter_map(|beside| beside.normal.as_ref().filter(|_| beside.value.is_some())) {
        let name = format!("{} of {}", normal.runs, by(normal));
        if !names.contains(&name) {
            names.push(name);
        }
    }
    match names.is_empty() {
        true => "  the runs have none of these figures\n".into(),
        false => format!("  runs: {}; within is three deviations\n", names.join(", ")),
    }
}

/// A sentence on the figures that the trajectory does not tell.
fn unknown(figures: &[Beside]) -> String {
    let lacking = figures.iter().filter(|beside| beside.value.is_none());
    let names: Vec<&str> = lacking.map(|beside| FIGURES[beside.figure].0).collect();
    match names.is_empty() {
        true => String::new(),
        false => format!(
            "  not known of this file: {}\n  (forces are in no file of states; energy, load and settling want velocities, rows near\n  the times asked for, and the scene's whole duration)\n",
            names.join(", ")
        ),
    }
}

fn number(value: Option<f64>) -> String {
    value.map_or("-".into(), |value| format::significant(value, 5))
}

/// A setting in words.
fn by(normal: &Normal) -> String {
    let (method, dt, tolerance) = &normal.by;
    let dt = dt.map(|dt| format!(", dt {} s", format::power(dt))).unwrap_or_default();
    let tolerance = tolerance.map(|tolerance| format!(", tolerance {}", format::power(tolerance))).unwrap_or_default();
    format!("{method}{dt}{tolerance}")
}

/// Figures of a crowd as rows of JSON.
pub(super) fn crowd_marks(figures: &[Beside]) -> Vec<CrowdMark> {
    let of = |beside: &Beside| {
        let (figure, unit, _) = FIGURES[beside.figure];
        let normal = beside.normal.as_ref();
        CrowdMark {
            figure: figure.into(),
            unit: unit.into(),
            value: beside.value,
            mean: normal.map(|normal| normal.mean),
            deviation: normal.map(|normal| normal.deviation),
            seeds: normal.map(|normal| normal.runs),
            by: normal.map(by),
            apart: beside.apart().filter(|apart| apart.is_finite()),
            agrees: beside.agrees(),
        }
    };
    figures.iter().map(of).collect()
}
