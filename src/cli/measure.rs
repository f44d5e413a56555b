//! `carom measure SCENE…`: what accuracy costs, as a table, a chart, CSV and a figure.

use std::io::Write;
use std::thread;

use super::accuracy::from_its_start;
use super::arguments::Measure;
use super::failure::{Failure, note};
use super::origin::{command, machine};
use super::output::Output;
use super::progress::{STEPS, progress_bar};
use super::signals::Signals;
use super::target::{Target, refuse_shared};
use crate::export::{Format, Table, TradeNote, TradeRow, read_trade};
use crate::measure::{self, Advance, Axes, Ladder, Measured, Placed, Rung, Shard, Sweep, Yardstick};
use crate::printable;
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
    let files = Files::open(arguments)?;
    if !arguments.merge.is_empty() {
        let rows = measure::merge(read_all(&arguments.merge)?).map_err(|error| Failure::Failed(error.to_string()))?;
        return files.write(&rows, arguments, &[]);
    }
    let measured = sweep(arguments, signals)?;
    let (interrupted, done) = (signals.check(), measured.rows.len());
    if interrupted.is_err() && done == 0 {
        note(&format!("interrupted: none of {} settings is done; nothing is written", measured.wanted));
        return interrupted;
    }
    files.write(&measured.rows, arguments, &measured.yardsticks)?;
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
    let opened = arguments.scenes.iter().map(scene::open).collect::<Result<Vec<_>, _>>();
    let opened = opened.map_err(|error| Failure::Failed(error.to_string()))?;
    opened.iter().try_for_each(|opened| from_its_start(&opened.scene, "measure"))?;
    let inputs: Vec<_> = opened.iter().filter_map(|opened| Some(("the scene", opened.path.as_deref()?))).collect();
    refuse_shared(&arguments.outputs(), &inputs)?;
    let ladder = ladder(arguments);
    opened.iter().filter_map(|opened| endless(opened, &ladder)).for_each(|warning| note(&warning));
    let scenes = opened.into_iter().map(|opened| (opened.key, opened.scene)).collect();
    let sweep = Sweep::new(scenes, ladder, arguments.shard.unwrap_or(Shard::WHOLE));
    let sweep = sweep.map_err(|error| Failure::Failed(error.to_string()))?;
    let sweep = sweep.with_timeout(arguments.timeout.unwrap_or(f64::INFINITY)).asking(arguments.error);
    let jobs = arguments.jobs.or_else(|| thread::available_parallelism().ok().map(usize::from)).unwrap_or(1);
    let bar = progress_bar(sweep.wanted(), "settings");
    let measured = sweep.run(jobs, &|| signals.check().is_ok(), &|Advance { done, share }| {
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

/// Where the results go, opened before any work is done for nothing.
struct Files {
    csv: Option<Output>,
    svg: Option<Output>,
    json: Option<Output>,
    /// Whether the report has standard output for itself.
    report_on_stdout: bool,
}

impl Files {
    fn open(arguments: &Measure) -> Result<Files, Failure> {
        let open = |target: &Option<Target>| target.as_ref().map(Output::open).transpose();
        let taken = arguments.outputs().iter().any(|(_, target)| target.is_some_and(Target::is_stdout));
        let (csv, svg, json) = (open(&arguments.csv)?, open(&arguments.svg)?, open(&arguments.json)?);
        Ok(Files { csv, svg, json, report_on_stdout: !taken })
    }

    fn write(self, rows: &[TradeRow], arguments: &Measure, yardsticks: &[Yardstick]) -> Result<(), Failure> {
        let (allowed, axes) = (&allowed(arguments)[..], Axes { x: arguments.x, y: arguments.y });
        let (machine, command) = (machine(), command());
        if let Some(json) = self.json {
            let mut table = Table::new::<TradeNote>(Format::JsonLines, json)?;
            rows.iter().try_for_each(|row| table.write(&TradeNote::of(row, &machine)))?;
            table.finish()?.finish()?;
        }
        if let Some(csv) = self.csv {
            let mut table = Table::new::<TradeRow>(Format::Csv, csv)?;
            rows.iter().try_for_each(|row| table.write(row))?;
            table.finish()?.finish()?;
        }
        if let Some(mut svg) = self.svg {
            svg.write_all(measure::figure(rows, allowed, axes, &format!("{command}; {machine}")).as_bytes())?;
            svg.finish()?;
        }
        let text = measure::report(rows, allowed, yardsticks, axes);
        Output::report(&text, self.report_on_stdout)
    }
}

/// The rows of all files, each with its place.
fn read_all(paths: &[std::path::PathBuf]) -> Result<Vec<Placed>, Failure> {
    let mut all = Vec::new();
    for path in paths {
        let name = printable::name(path.as_os_str());
        let text = scene::contents(path, "the CSV of a part").map_err(|message| format!(" {message}"));
        let rows = text.and_then(|text| read_trade(text.as_slice()).map_err(|error| error.to_string()));
        let rows = rows.map_err(|error| Failure::Failed(format!("{name}:{error}")))?;
        all.extend(rows.into_iter().map(|(line, row)| Placed { place: format!("{name}:{line}"), row }));
    }
    Ok(all)
}
