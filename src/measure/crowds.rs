//! Crowds of many seeds and settings side by side, and what is said of them.

use std::fmt::Write;

use super::crowd::{Crowd, FIGURES, Mean, crowd_run};
use super::interrupt::GoOn;
use super::ladder::Rung;
use super::report::setting;
use super::side_by_side::side_by_side;
use crate::export::CrowdRow;
use crate::format;
use crate::scene::{Method, Scene};

/// Which figure is a residual, 0 but for rounding: it is told, and not held against another.
const RESIDUAL: usize = FIGURES.len() - 1;

/// Runs each setting from so many seeds, at most so many side by side; a setting's runs end after `timeout` seconds of processor
/// time each. None if `go_on` returned false.
pub fn crowds(
    scene: &Scene,
    rungs: &[Rung],
    (seeds, timeout): (u64, f64),
    jobs: usize,
    go_on: GoOn,
) -> Option<Vec<Crowd>> {
    let count = seeds as usize;
    let runs = side_by_side(rungs.len() * count, jobs, |task| {
        crowd_run(scene, rungs[task / count], (task as u64 % seeds + 1, timeout), go_on)
    });
    let runs: Vec<_> = runs.into_iter().collect::<Option<Vec<_>>>()?;
    Some(rungs.iter().zip(runs.chunks(count)).map(|(rung, runs)| Crowd::of(*rung, runs)).collect())
}

/// Which setting the others are held against: `exact`, if all its runs came to the end; else the last of which all did.
fn standard(crowds: &[Crowd]) -> Option<&Crowd> {
    let whole = || crowds.iter().filter(|crowd| crowd.finished.0 == crowd.finished.1);
    whole().find(|crowd| crowd.rung.method == Method::Exact).or_else(|| whole().next_back())
}

/// A row for each setting and figure.
pub fn crowd_rows(key: &str, crowds: &[Crowd]) -> Vec<CrowdRow> {
    let standard = standard(crowds);
    let rows = crowds.iter().flat_map(|crowd| {
        FIGURES.iter().enumerate().map(move |(k, (figure, unit))| {
            let mean = crowd.means[k];
            let wanted = standard.and_then(|standard| standard.means[k]);
            CrowdRow {
                scene: key.into(),
                method: crowd.rung.method.name().into(),
                dt: crowd.rung.dt,
                tolerance: crowd.rung.tolerance,
                figure: (*figure).into(),
                unit: (*unit).into(),
                mean: mean.map(|mean| mean.mean),
                standard_error: mean.map(|mean| mean.error),
                seeds: mean.map_or(0, |mean| mean.runs as u64),
                agrees: mean.zip(wanted).filter(|_| k != RESIDUAL).map(|(mean, wanted)| mean.agrees(&wanted)),
            }
        })
    });
    rows.collect()
}

/// The report on a scene's crowds, a block for each figure.
pub fn crowd_report(key: &str, until: f64, crowds: &[Crowd]) -> String {
    let standard = standard(crowds);
    let against = standard.map_or("nothing: no setting finished all its runs".into(), |crowd| name(&crowd.rung));
    let seeds = crowds.first().map_or(0, |crowd| crowd.finished.1);
    let mut text = format!(
        "{key}: {} s, {}; means and standard errors, held against {against}\n",
        format::time(until),
        format::counted(seeds as u64, "seed")
    );
    for (k, (figure, unit)) in FIGURES.iter().enumerate() {
        let unit = if unit.is_empty() { String::new() } else { format!(", {unit}") };
        let _ = writeln!(text, "\n{figure}{unit}");
        for crowd in crowds {
            let verdict = match (crowd.means[k], standard.and_then(|standard| standard.means[k])) {
                (Some(mean), Some(wanted)) if k != RESIDUAL && !mean.agrees(&wanted) => {
                    "  differs by more than 3 standard errors"
                }
                _ => "",
            };
            let line = format!("  {:30} {}{verdict}", name(&crowd.rung), words(crowd.means[k]));
            let _ = writeln!(text, "{}", line.trim_end());
        }
    }
    for crowd in crowds.iter().filter(|crowd| crowd.finished.0 < crowd.finished.1) {
        let (done, all) = crowd.finished;
        let _ = writeln!(text, "\n{}: {} of {all} runs stalled or took too long", name(&crowd.rung), all - done);
    }
    text
}

fn words(mean: Option<Mean>) -> String {
    mean.map_or("-".into(), |Mean { mean, error, .. }| {
        format!("{:>12} ± {:8}", format::significant(mean, 5), format::digits(error, 1))
    })
}

fn name(rung: &Rung) -> String {
    setting(rung.method.name(), rung.dt, rung.tolerance)
}
