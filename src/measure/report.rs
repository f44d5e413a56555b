//! What a sweep found, in words, a table and a chart, for a terminal of 80 columns.

use std::fmt::Write;

use super::alike::folded;
use super::axes::Axes;
use super::chart::chart;
use super::front::{cheapest, front};
use super::orders::orders;
use super::sweep::Yardstick;
use crate::export::TradeRow;
use crate::format;
use crate::scene::Method;

/// Growth of a displacement from which positions are so much worse than rounding that a reader should know.
const GROWN: f64 = 100.0;

/// The report on all rows, a section by scene. `allowed` methods compete on the front.
pub fn report(rows: &[TradeRow], allowed: &[Method], yardsticks: &[Yardstick], axes: Axes) -> String {
    let sections = rows.chunk_by(|a, b| a.scene == b.scene).map(|of_scene| {
        let yardstick = yardsticks.iter().find(|yardstick| yardstick.scene == of_scene[0].scene);
        section(of_scene, (allowed, axes), yardstick)
    });
    sections.collect::<Vec<_>>().join("\n")
}

fn section(rows: &[TradeRow], (allowed, axes): (&[Method], Axes), yardstick: Option<&Yardstick>) -> String {
    let (rows, same): (Vec<TradeRow>, Vec<Option<String>>) = folded(rows).into_iter().unzip();
    let rows = &rows[..];
    let best = front(rows, allowed, axes);
    let mut text = heading(rows, yardstick) + "\n\n" + &table(rows, &same, &best) + "\n";
    let chart = chart(rows, allowed, axes);
    if !chart.is_empty() {
        text += &chart;
        text.push('\n');
    }
    text += &sentences(rows, &best, axes);
    text += &price(rows, &best, yardstick);
    text += &found_orders(rows, axes);
    text += &failures(rows);
    text
}

fn heading(rows: &[TradeRow], yardstick: Option<&Yardstick>) -> String {
    let until = rows.iter().map(|row| row.until).fold(0.0, f64::max);
    let growth = yardstick.map(|yardstick| yardstick.growth).filter(|growth| *growth > GROWN);
    let growth = growth.map(|growth| format!(" (growth {growth:.0e})")).unwrap_or_default();
    let horizon = match rows[0].horizon {
        Some(time) => format!("horizon {} s: beyond it positions mean nothing", format::time(time)),
        None => format!("horizon none{growth}: positions mean something to the end"),
    };
    let own = rows[0].certified.zip(rows[0].floor).map(|(time, floor)| {
        format!("\nexact itself is off by {} m at most, up to {} s", format::digits(floor, 1), format::time(time))
    });
    format!("{}: {} s; {horizon}{}", rows[0].scene, format::time(until), own.unwrap_or_default())
}

/// Errors in m and s, energy and depth as parts; gaps computed, CPU time per simulated second and its spread.
const COLUMNS: &str = "  method dt   tol   error m delay s  common  energy depth  gaps   cpu/s   ±";

/// A line for each row, `*` on the front; letters refer to the notes below.
fn table(rows: &[TradeRow], same: &[Option<String>], best: &[usize]) -> String {
    let mut notes: Vec<String> = Vec::new();
    let mut text = String::from(COLUMNS) + "\n";
    for (index, row) in rows.iter().enumerate() {
        // Runs that stalled share a letter, whenever and why they did.
        let stalled = row.note.stalled.as_ref().map(|_| "stopped before the end: below");
        let phrases =
            stalled.into_iter().chain(row.note.doubts.iter().map(String::as_str)).chain(same[index].as_deref());
        let letters: String = phrases.map(|phrase| letter(phrase, &mut notes)).collect();
        let mark = if best.contains(&index) { '*' } else { ' ' };
        text += format!("{mark} {} {letters}", cells(row)).trim_end();
        text.push('\n');
    }
    for (index, note) in notes.iter().enumerate() {
        let _ = writeln!(text, "  {} {note}", char::from(b'a' + index as u8 % 26));
    }
    text
}

fn cells(row: &TradeRow) -> String {
    let knob = |value: Option<f64>| value.map(format::power).unwrap_or_default();
    let figure = |value: Option<f64>| value.map_or("-".into(), |value| format::digits(value, 1));
    format!(
        "{:6} {:4} {:5} {:>7} {:>7} {:>7} {:>7} {:>5} {:>5} {:>7} {:>3}",
        row.method,
        knob(row.dt),
        knob(row.tolerance),
        figure(row.position_error),
        figure(row.impact_time_error),
        format!("{}/{}", row.common_events, row.impacts),
        figure(row.energy_error),
        format::digits(row.deepest_degree, 0),
        format::digits(row.evaluations as f64, 1),
        row.cpu_per_s.map_or("-".into(), format::duration),
        row.cpu_spread.map(format::spread).unwrap_or_default(),
    )
}

/// The letter of a phrase, entered among the notes if it is new there.
fn letter(note: &str, notes: &mut Vec<String>) -> char {
    let index = notes.iter().position(|known| known == note).unwrap_or_else(|| {
        notes.push(note.into());
        notes.len() - 1
    });
    char::from(b'a' + index as u8 % 26)
}

/// A setting in words.
pub(super) fn setting(method: &str, dt: Option<f64>, tolerance: Option<f64>) -> String {
    let dt = dt.map(|dt| format!(", dt {} s", format::power(dt))).unwrap_or_default();
    let tolerance = tolerance.map(|tolerance| format!(", tolerance {}", format::power(tolerance))).unwrap_or_default();
    format!("{method}{dt}{tolerance}")
}

/// The cheapest setting for each decade of error.
fn sentences(rows: &[TradeRow], best: &[usize], axes: Axes) -> String {
    let (mut text, unit) = (String::new(), axes.y.unit());
    for found in cheapest(rows, best, axes) {
        let row = &rows[found.row];
        let range = match (found.from, found.to) {
            (from, to) if from == to => format!("an error up to {to:e}{unit}"),
            (from, to) => format!("errors of {from:e} down to {to:e}{unit}"),
        };
        let cost = axes.cost(row).map(|cost| axes.x.words(cost)).unwrap_or_default();
        let error = axes.error(row).unwrap_or(0.0);
        let _ = writeln!(
            text,
            "Cheapest for {range}: {};\n  {cost}, error {}{unit}.",
            setting(&row.method, row.dt, row.tolerance),
            format::digits(error, 1),
        );
    }
    if text.is_empty() { format!("No setting that may compete reached the end within 1{unit}.\n") } else { text }
}

/// What the yardstick costs, and whether anything on the front is cheaper.
fn price(rows: &[TradeRow], best: &[usize], yardstick: Option<&Yardstick>) -> String {
    let measured = rows.iter().find(|row| row.method == Method::Exact.name()).and_then(|row| row.cpu_per_s);
    let (name, price) = match (yardstick, measured) {
        (Some(yardstick), _) => (yardstick.method.name(), yardstick.cpu_per_s),
        (None, Some(price)) => (Method::Exact.name(), price),
        (None, None) => return String::new(),
    };
    let cheaper = best.iter().filter(|&&row| rows[row].cpu_per_s.is_some_and(|cost| cost < price)).count();
    let compared = match (cheaper, best.is_empty()) {
        (_, true) => String::new(),
        (0, _) => ",\n  less than any setting on the front".into(),
        (1, _) => ";\n  one setting on the front costs less".into(),
        (count, _) => format!(";\n  {count} settings on the front cost less"),
    };
    format!("The yardstick, {name}, takes {} per simulated second{compared}.\n", format::duration(price))
}

fn found_orders(rows: &[TradeRow], axes: Axes) -> String {
    let found: Vec<String> =
        orders(rows, axes, rows[0].floor.unwrap_or(0.0)).iter().map(|order| order.to_string()).collect();
    if found.is_empty() { String::new() } else { format!("Order of the error, with 95 %: {}.\n", found.join(";\n  ")) }
}

/// Settings that failed and are told one by one.
const TOLD: usize = 12;

/// Which settings stopped before the end, when and why.
fn failures(rows: &[TradeRow]) -> String {
    let failed: Vec<(&TradeRow, &String)> =
        rows.iter().filter_map(|row| Some((row, row.note.stalled.as_ref()?))).collect();
    let mut text = String::new();
    for (row, when) in failed.iter().take(TOLD) {
        let _ = writeln!(text, "Stopped: {} at {when}.", setting(&row.method, row.dt, row.tolerance));
    }
    if failed.len() > TOLD {
        let _ = writeln!(text, "And {} more: --csv.", failed.len() - TOLD);
    }
    text
}
