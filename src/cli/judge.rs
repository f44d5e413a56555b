//! `carom judge FILE…`: trajectories of any program, marked against `exact` or against each other.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::accuracy::from_its_start;
use super::arguments::Judge;
use super::failure::Failure;
use super::results::{Results, jobs, rows};
use super::signals::Signals;
use super::target::refuse_shared;
use crate::export::{Columns, Format, MarkRow, States, read_crowd};
use crate::marks::{self, Exam, Mark, Marked, NoMark, Norm, Source};
use crate::printable;
use crate::scene;

pub(super) fn judge(arguments: &Judge, signals: &Signals) -> Result<(), Failure> {
    let outputs = [("--json", arguments.json.as_ref()), ("--svg", arguments.svg.as_ref())];
    let named = arguments
        .files
        .iter()
        .chain(&arguments.against)
        .chain(&arguments.crowd)
        .filter(|word| *word != "-")
        .map(PathBuf::from);
    let paths: Vec<PathBuf> = named.collect();
    let inputs: Vec<(&str, &Path)> = paths.iter().map(|path| ("the trajectory", path.as_path())).collect();
    refuse_shared(&outputs, &inputs)?;
    refuse_steps(arguments)?;
    let opened = scene::open(&arguments.scene).map_err(|error| Failure::Usage(error.to_string()))?;
    opened.path.iter().try_for_each(|path| refuse_shared(&outputs, &[("the scene", path)]))?;
    from_its_start(&opened.scene, "judge")?;
    let norm = arguments.crowd.as_ref().map(|table| norm(table, &opened.key)).transpose()?;
    let results = Results::open([&None, &arguments.svg, &arguments.json])?;
    let go_on = || signals.check().is_ok();
    let until = arguments.until.unwrap_or(opened.scene.duration);
    let interrupted = || signals.check().err().unwrap_or(Failure::Told);
    let exam = Exam::new(&opened.scene, until, arguments.tolerance, &go_on).ok_or_else(interrupted)?.beside(norm);
    let marked = marks::mark_all(arguments.files.len(), jobs(arguments.jobs), |index| {
        let word = &arguments.files[index];
        (printable::name(word), mark(&exam, word, arguments, &go_on))
    });
    let marked = marked.ok_or_else(interrupted)?;
    write(results, arguments, (&exam, &opened.key), &marked)?;
    if marked.iter().any(|marked| marked.mark.is_err()) {
        return Err(Failure::BadInput);
    }
    let fails = marked.iter().any(|marked| marked.mark.as_ref().is_ok_and(|mark| mark.passes == Some(false)));
    if fails { Err(Failure::Told) } else { Ok(()) }
}

/// What the table of a crowd says of a scene.
fn norm(table: &OsStr, key: &str) -> Result<Norm, Failure> {
    let name = printable::name(table);
    let rows = rows(Path::new(table), "the table of a crowd", |text| read_crowd(text)).map_err(Failure::Usage)?;
    let lacks =
        || format!("{name}: no setting of {key} is there that others are held against; make it by measure --crowd");
    Norm::of(rows.iter().map(|(_, row)| row), key).ok_or_else(|| Failure::Usage(lacks()))
}

/// Refuses steps that are not one for each file, and standard input read twice.
fn refuse_steps(arguments: &Judge) -> Result<(), Failure> {
    let (steps, files) = (arguments.dt.len(), arguments.files.len());
    if steps > 0 && steps != files {
        return Err(Failure::Usage(format!("--dt has {steps} steps for {files} files; wanted is one for each")));
    }
    let piped = arguments.files.iter().chain(&arguments.against).filter(|word| *word == "-").count();
    if piped > 1 || (piped > 0 && arguments.against.is_some() && files > 1) {
        return Err(Failure::Usage("standard input can be read once only; give the others their names".into()));
    }
    Ok(())
}

fn mark(exam: &Exam, word: &OsStr, arguments: &Judge, go_on: &dyn Fn() -> bool) -> Result<Mark, NoMark> {
    let columns = arguments.columns.clone().unwrap_or_default();
    let source = source(word, &columns, exam.spheres())?;
    match &arguments.against {
        None => exam.mark(source, go_on),
        Some(other) => {
            let name = printable::name(other);
            let other = self::source(other, &columns, exam.spheres());
            let other = other.map_err(|error| NoMark::Unreadable(error.of(&name)))?;
            exam.mark_against(source, other, go_on)
        }
    }
}

fn source(word: &OsStr, columns: &Columns, spheres: usize) -> Result<Source, crate::export::ReadError> {
    let reader: Box<dyn Read + Send> = if word == "-" {
        Box::new(io::stdin())
    } else {
        let unreadable = |error: io::Error| crate::export::ReadError::from(printable::cause(&error));
        Box::new(File::open(word).map_err(unreadable)?)
    };
    States::new(reader, columns, spheres)
}

fn write(
    mut results: Results,
    arguments: &Judge,
    (exam, scene): (&Exam, &str),
    marked: &[Marked],
) -> Result<(), Failure> {
    let other = arguments.against.as_ref().map(|word| printable::name(word));
    let order = marks::order(exam, &arguments.dt, marked);
    let fit = order.map(|order| order.fit);
    let rows = marked.iter().map(|marked| MarkRow {
        order: fit.map(|fit| fit.order),
        order_margin: fit.and_then(|fit| fit.margin),
        ..marks::row(exam, other.is_none(), marked)
    });
    results.table::<MarkRow>(Format::JsonLines, rows)?;
    results.figure(|| marks::figure(exam, scene, other.as_deref(), marked))?;
    let mut text = marks::report(exam, scene, other.as_deref(), marked);
    if !arguments.dt.is_empty() {
        let none = || "Order of convergence: none can be fitted; wanted are two steps with errors above 0.".into();
        text = text + "\n" + &order.map_or_else(none, |order| order.to_string()) + "\n";
    }
    results.report(&text)
}
