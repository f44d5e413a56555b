//! `carom measure --crowd N`: figures of crowds beyond the horizon, at once or in parts.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::arguments::Measure;
use super::failure::{Failure, note};
use super::origin::{command, machine};
use super::progress::{self, STEPS};
use super::results::{Results, jobs, rows, scenes};
use super::signals::Signals;
use crate::export::{CrowdRow, Format, Row, is_crowd_part, read_crowd_runs};
use crate::measure::{self, Budget, CrowdPlan, Ladder, PlacedRun, Rung, SceneCrowds, Shard};
use crate::physics::{Effect, knobs};
use crate::scene;

/// Settings of a crowd unless told otherwise: a step and half of it, a tolerance.
const CROWD: ([f64; 2], f64) = ([1e-2, 5e-3], 1e-6);

/// What a run may take: ns of counted work, and rests and releases, of which a heap of hundreds makes a thousand a second. About
/// a minute, and the same end on every machine.
const MOST: (u64, u64) = (60_000_000_000, 60_000);

/// Measures the crowd of each scene, or a part of that.
pub(super) fn crowd(arguments: &Measure, seeds: usize, ladder: Ladder, signals: &Signals) -> Result<(), Failure> {
    let opened = scenes(&arguments.scenes, &arguments.outputs())?;
    let results = Results::open([&arguments.csv, &arguments.svg, &arguments.json])?;
    let plan = CrowdPlan {
        rungs: rungs(ladder),
        seeds: seeds as u64,
        budget: Budget { cpu: arguments.timeout.unwrap_or(f64::INFINITY), changes: MOST.1, ..Budget::counted(MOST.0) },
        shard: arguments.shard.unwrap_or(Shard::WHOLE),
        jobs: jobs(arguments.jobs),
    };
    let (wanted, done) = (opened.len() * plan.runs(), AtomicUsize::new(0));
    let bar = progress::counting(wanted, "runs");
    let advance = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        bar.set_message(done.to_string());
        bar.set_position((done as f64 / wanted as f64 * STEPS) as u64);
    };
    let mut runs = Vec::new();
    for opened in &opened {
        let subject = (opened.key.as_str(), &opened.scene);
        runs.extend(measure::crowd_runs(subject, &plan, &|| signals.check().is_ok(), &advance));
    }
    bar.finish_and_clear();
    let (interrupted, done) = (signals.check(), runs.len());
    if interrupted.is_err() && done == 0 {
        note(&format!("interrupted: none of {wanted} runs is done; nothing is written"));
        return interrupted;
    }
    let placed = runs.iter().map(|run| PlacedRun { place: String::new(), run: run.clone() });
    let scenes = measure::gather(placed).map_err(|error| Failure::Failed(error.to_string()))?;
    match arguments.shard {
        None => write(results, &figures(&scenes), &scenes)?,
        Some(_) => write(results, &runs, &scenes)?,
    }
    if interrupted.is_err() {
        note(&format!("interrupted: {done} of {wanted} runs are done and kept"));
    }
    interrupted
}

/// The settings of a crowd: a step and half of it, unless steps are listed; of a method in which a step changes nothing but the cost
/// the longer one.
fn rungs(ladder: Ladder) -> Vec<Rung> {
    let listed = ladder.dt.is_some();
    let (dt, tolerances) = (ladder.dt.unwrap_or(CROWD.0.to_vec()), ladder.tolerances.unwrap_or(vec![CROWD.1]));
    let all = Ladder { methods: ladder.methods, dt: Some(dt), tolerances: Some(tolerances) }.rungs();
    let differs = |rung: &Rung| listed || knobs(rung.method).dt != Effect::Cost || rung.dt == Some(CROWD.0[0]);
    all.into_iter().filter(differs).collect()
}

/// Whether the files to be merged are parts of a crowd: the first of them says.
pub(super) fn are_parts(paths: &[PathBuf]) -> bool {
    paths
        .first()
        .and_then(|path| scene::contents(path, "the CSV of a part").ok())
        .is_some_and(|text| is_crowd_part(&text))
}

/// Joins parts of crowds.
pub(super) fn merge(arguments: &Measure) -> Result<(), Failure> {
    let results = Results::open([&arguments.csv, &arguments.svg, &arguments.json])?;
    let mut runs = Vec::new();
    for path in &arguments.merge {
        let read = rows(path, "the CSV of a part", |text| read_crowd_runs(text)).map_err(Failure::Failed)?;
        runs.extend(read.into_iter().map(|(place, run)| PlacedRun { place, run }));
    }
    let scenes = measure::gather(runs).map_err(|error| Failure::Failed(error.to_string()))?;
    write(results, &figures(&scenes), &scenes)
}

fn figures(scenes: &[SceneCrowds]) -> Vec<CrowdRow> {
    scenes.iter().flat_map(measure::crowd_rows).collect()
}

fn write<R: Row>(mut results: Results, rows: &[R], scenes: &[SceneCrowds]) -> Result<(), Failure> {
    results.table::<R>(Format::Csv, rows)?;
    results.table::<R>(Format::JsonLines, rows)?;
    results.figure(|| measure::crowd_figure(scenes, &format!("{}; {}", command(), machine())))?;
    let text: Vec<String> = scenes.iter().map(measure::crowd_report).collect();
    results.report(&text.join("\n"))
}
