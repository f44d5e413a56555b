//! What the commands that measure read and write: scenes and rows in; tables, a figure and a report out.

use std::borrow::Borrow;
use std::io::Write;
use std::path::Path;
use std::thread;

use super::accuracy::from_its_start;
use super::failure::Failure;
use super::output::Output;
use super::target::{Target, refuse_shared};
use crate::export::{Format, ReadError, Row, Table};
use crate::printable;
use crate::scene::{self, Opened};

/// The files for results, opened before any work is done for nothing.
pub(super) struct Results {
    csv: Option<Output>,
    svg: Option<Output>,
    json: Option<Output>,
    /// Whether the report has standard output for itself.
    report_on_stdout: bool,
}

impl Results {
    /// Opens the targets that were asked for.
    ///
    /// # Errors
    /// If one of them cannot be opened.
    pub(super) fn open([csv, svg, json]: [&Option<Target>; 3]) -> Result<Results, Failure> {
        let taken = [csv, svg, json].into_iter().flatten().any(Target::is_stdout);
        let open = |target: &Option<Target>| target.as_ref().map(Output::open).transpose();
        Ok(Results { csv: open(csv)?, svg: open(svg)?, json: open(json)?, report_on_stdout: !taken })
    }

    /// Writes the table of this format, if it was asked for.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn table<R: Row>(
        &mut self,
        format: Format,
        rows: impl IntoIterator<Item = impl Borrow<R>>,
    ) -> Result<(), Failure> {
        let file = match format {
            Format::Csv => self.csv.take(),
            Format::JsonLines => self.json.take(),
        };
        let Some(file) = file else { return Ok(()) };
        let mut table = Table::new::<R>(format, file)?;
        rows.into_iter().try_for_each(|row| table.write(row.borrow()))?;
        table.finish()?.finish()
    }

    /// Writes the figure, if it was asked for.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn figure(&mut self, draw: impl FnOnce() -> String) -> Result<(), Failure> {
        let Some(mut file) = self.svg.take() else { return Ok(()) };
        file.write_all(draw().as_bytes())?;
        file.finish()
    }

    /// Writes the report on standard output, or on standard error where a result has the former for itself.
    ///
    /// # Errors
    /// If standard output cannot be written.
    pub(super) fn report(self, text: &str) -> Result<(), Failure> {
        Output::report(text, self.report_on_stdout)
    }
}

/// The scenes of these words, each from its start, of which no output replaces one.
///
/// # Errors
/// If a scene cannot be opened, goes on from another run, or is an output too.
pub(super) fn scenes(
    words: &[std::ffi::OsString],
    outputs: &[(&str, Option<&Target>)],
) -> Result<Vec<Opened>, Failure> {
    let opened = words.iter().map(scene::open).collect::<Result<Vec<_>, _>>();
    let opened = opened.map_err(|error| Failure::Failed(error.to_string()))?;
    opened.iter().try_for_each(|opened| from_its_start(&opened.scene, "measure"))?;
    let inputs: Vec<_> = opened.iter().filter_map(|opened| Some(("the scene", opened.path.as_deref()?))).collect();
    refuse_shared(outputs, &inputs)?;
    Ok(opened)
}

/// The rows of a file, which must be `wanted` (`the CSV of a part`), each with its place, `file:line`.
///
/// # Errors
/// A sentence that names the file, and the line if one is wrong.
pub(super) fn rows<R>(
    path: &Path,
    wanted: &str,
    read: impl FnOnce(&[u8]) -> Result<Vec<(u64, R)>, ReadError>,
) -> Result<Vec<(String, R)>, String> {
    let name = printable::name(path.as_os_str());
    let text = scene::contents(path, wanted).map_err(|message| format!("{name}: {message}"))?;
    let rows = read(&text).map_err(|error| format!("{name}:{error}"))?;
    Ok(rows.into_iter().map(|(line, row)| (format!("{name}:{line}"), row)).collect())
}

/// How many tasks are done side by side: as many as were asked for, or as many as there are processors.
pub(super) fn jobs(asked: Option<usize>) -> usize {
    asked.unwrap_or_else(|| thread::available_parallelism().map_or(1, usize::from))
}
