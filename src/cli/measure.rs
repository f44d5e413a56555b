//! `carom measure SCENE…`: what accuracy costs, as a table, a chart, CSV and a figure.

use std::path::PathBuf;

use super::arguments::Measure;
use super::failure::{Failure, note};
use super::origin::{command, machine};
use super::progress::{self, STEPS};
use super::results::{Results, jobs, rows, scenes};
use super::signals::Signals;
use super::target::refuse_shared;
use crate::export::{Format, TradeNote, TradeRow, read_trade};
use crate::measure::{self, Advance, Axes, Ladder, Measured, Placed, Rung, Shard, Sweep, Yardstick};
use crate::scene::{self, Method, Opened};

pub(super) fn measure(arguments: &Measure, signals: &Signals) -> Result<(), Failure> {
    refuse_shared(&arguments.outputs(), &[])?;
    let merged: Vec<_> = arguments.merge.iter().map(|path| ("the part", path.as_path())).collect();
    refuse_shared(&arguments.outputs(), &merged)?;
    if let Some(seeds) = arguments.crowd {
        return super::crowd::crowd(arguments, seeds, ladder(arguments), signals);
    }
    if super::crowd::are_parts(&arguments.merge) {
        return super::crowd::merge(arguments);
    }
    let results = Results::open([&arguments.csv, &arguments.svg, &arguments.json])?;
    if !arguments.merge.is_empty() {
        let rows = measure::merge(read_all(&arguments.merge)?).map_err(|error| Failure::Failed(error.to_string()))?;
        return write(results, arguments, &rows, &[]);
    }
    let measured = sweep(arguments, signals)?;
    let (interrupted, done) = (signals.check(), measured.rows.len());
    if interrupted.is_err() && done == 0 {
        note(&format!("interrupted: none of {} settings is done; nothing is written", measured.wanted));
        return interrupted;
    }
    write(results, arguments, &measured.rows, &measured.yardsticks)?;
    if interrupted.is_err() {
        note(&format!("interrupted: {done} of {} settings are done and kept", measured.wanted));
    }
    interrupted
}

/// Which methods compete on the front: `exact`, the yardstick, only if it was asked for.
fn allowed(arguments: &Measure) -> Vec<Method> {
    match &arguments.methods {
        listed if !listed.is_empty() => listed.clone(),
        _ => Method::ALL.iter().copied().filter(|method| *method != Method::Exact).collect(),
    }
}

fn ladder(arguments: &Measure) -> Ladder {
    let listed = |list: &Vec<f64>| (!list.is_empty()).then(|| list.clone());
    let all = || Method::ALL.to_vec();
    Ladder {
        methods: if arguments.methods.is_empty() { all() } else { arguments.methods.clone() },
        dt: listed(&arguments.dt),
        tolerances: listed(&arguments.tolerances),
    }
}

fn sweep(arguments: &Measure, signals: &Signals) -> Result<Measured, Failure> {
    let opened = scenes(&arguments.scenes, &arguments.outputs())?;
    let ladder = ladder(arguments);
    opened.iter().filter_map(|opened| endless(opened, &ladder)).for_each(|warning| note(&warning));
    let scenes = opened.into_iter().map(|opened| (opened.key, opened.scene)).collect();
    let sweep = Sweep::new(scenes, ladder, arguments.shard.unwrap_or(Shard::WHOLE));
    let sweep = sweep.map_err(|error| Failure::Failed(error.to_string()))?;
    let sweep = sweep.with_timeout(arguments.timeout.unwrap_or(f64::INFINITY)).asking(arguments.error);
    let bar = progress::counting(sweep.wanted(), "settings");
    let measured = sweep.run(jobs(arguments.jobs), &|| signals.check().is_ok(), &|Advance { done, share }| {
        bar.set_message(done.to_string());
        bar.set_position((share * STEPS) as u64);
    });
    bar.finish_and_clear();
    Ok(measured)
}

/// What must be said of a scene and the shortest step on the ladder, if that takes too long to end.
fn endless(opened: &Opened, ladder: &Ladder) -> Option<String> {
    let until = opened.scene.duration;
    let by_step = |a: &Rung, b: &Rung| a.settings(until).dt.total_cmp(&b.settings(until).dt);
    let shortest = ladder.rungs().into_iter().min_by(by_step)?;
    let warning = scene::endless(&opened.scene, shortest.settings(until), until)?;
    Some(format!("{}: {warning}", opened.key))
}

fn write(
    mut results: Results,
    arguments: &Measure,
    rows: &[TradeRow],
    yardsticks: &[Yardstick],
) -> Result<(), Failure> {
    let (allowed, axes) = (&allowed(arguments)[..], Axes { x: arguments.x, y: arguments.y });
    let (machine, command) = (machine(), command());
    let options = options(arguments);
    let notes = rows.iter().zip(measure::alike(rows));
    let notes = notes.map(|(row, same)| TradeNote::of(row, same.map(|same| &rows[same]), &options, &machine));
    results.table::<TradeNote>(Format::JsonLines, notes)?;
    results.table::<TradeRow>(Format::Csv, rows)?;
    results.figure(|| measure::figure(rows, allowed, axes, &format!("{command}; {machine}")))?;
    results.report(&measure::report(rows, allowed, yardsticks, axes))
}

/// The options that change the figures of a setting, as the command that repeats it needs them.
fn options(arguments: &Measure) -> String {
    let timeout = arguments.timeout.map(|timeout| format!(" --timeout {timeout:?}")).unwrap_or_default();
    let error =
        if arguments.error == measure::ASKED { String::new() } else { format!(" --error {:e}", arguments.error) };
    timeout + &error
}

/// The rows of all files, each with its place.
fn read_all(paths: &[PathBuf]) -> Result<Vec<Placed>, Failure> {
    let mut all = Vec::new();
    for path in paths {
        let read = rows(path, "the CSV of a part", |text| read_trade(text)).map_err(Failure::Failed)?;
        all.extend(read.into_iter().map(|(place, row)| Placed { place, row }));
    }
    Ok(all)
}
