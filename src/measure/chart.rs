//! Error over cost as a chart of characters, 80 columns wide: a letter for each method, so that no colour is needed.

use super::axes::{Axes, Error};
use super::front::front;
use super::scale::Scale;
use crate::export::TradeRow;
use crate::scene::Method;

/// Columns and rows of the plot itself; with its labels 80 columns.
const WIDTH: usize = 70;
const HEIGHT: usize = 18;

/// Columns of the labels at the left.
const LABELS: usize = 7;

/// Columns that a label below needs.
const TICK: usize = 9;

/// The letter of a method: small, and a capital on the front.
fn letter(row: &TradeRow, on_front: bool) -> char {
    let first = row.method.chars().next().unwrap_or('?');
    if on_front { first.to_ascii_uppercase() } else { first }
}

/// The chart of one scene's rows; nothing if no row has both figures.
pub(super) fn chart(rows: &[TradeRow], allowed: &[Method], axes: Axes) -> String {
    let points = || rows.iter().filter_map(|row| axes.point(row));
    if points().next().is_none() {
        return String::new();
    }
    let (x, y) = (Scale::around(points().map(|p| p.0)), Scale::around(points().map(|p| p.1).chain(floor(rows, axes))));
    let floor = floor(rows, axes);
    let mut plot = vec![[' '; WIDTH]; HEIGHT];
    let column = |value: f64| (x.place(value) * (WIDTH - 1) as f64).round() as usize;
    let line = |value: f64| HEIGHT - 1 - (y.place(value) * (HEIGHT - 1) as f64).round() as usize;
    let best = front(rows, allowed, axes);
    let corners: Vec<(usize, usize)> =
        best.iter().filter_map(|&i| axes.point(&rows[i])).map(|(cost, error)| (column(cost), line(error))).collect();
    floor.iter().for_each(|floor| plot[line(*floor)].fill('-'));
    draw_steps(&mut plot, &corners);
    let on_front = |index: &usize| best.contains(index);
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by_key(on_front); // capitals last: nothing covers them
    for index in order {
        if let Some((cost, error)) = axes.point(&rows[index]) {
            plot[line(error)][column(cost)] = letter(&rows[index], on_front(&index));
        }
    }
    framed(&plot, [x, y], axes) + &legend(rows, axes)
}

/// The yardstick's own error, if it is known and is one of these errors.
fn floor(rows: &[TradeRow], axes: Axes) -> Option<f64> {
    rows[0].floor.filter(|floor| axes.y == Error::Position && *floor > 0.0)
}

/// The front as steps: from each setting's cost on, its error is to be had.
fn draw_steps(plot: &mut [[char; WIDTH]], corners: &[(usize, usize)]) {
    for (index, &(left, height)) in corners.iter().enumerate() {
        let (right, down) = corners.get(index + 1).copied().unwrap_or((WIDTH - 1, height));
        plot[height][left..=right].fill('·');
        plot[height..=down].iter_mut().for_each(|line| line[right] = '·');
    }
}

/// The plot with its axes and their labels.
fn framed(plot: &[[char; WIDTH]], [x, y]: [Scale; 2], axes: Axes) -> String {
    let mut text = format!("{}\n", axes.y.axis());
    let ticks = y.ticks(HEIGHT / 2);
    for (index, line) in plot.iter().enumerate() {
        let place = |tick: &&(f64, String)| (tick.0 * (HEIGHT - 1) as f64).round() as usize == HEIGHT - 1 - index;
        let tick = ticks.iter().find(place);
        let (label, edge) = tick.map_or(("", '│'), |tick| (tick.1.as_str(), '┤'));
        let line: String = line.iter().collect();
        text += format!("{label:>LABELS$} {edge}{line}").trim_end();
        text.push('\n');
    }
    let mut axis = ['─'; WIDTH];
    let mut labels = vec![' '; LABELS + 2 + WIDTH + TICK];
    for (place, label) in x.ticks(WIDTH / TICK) {
        let column = (place * (WIDTH - 1) as f64).round() as usize;
        axis[column] = '┴';
        let start = (LABELS + 2 + column).saturating_sub(label.len() / 2).min(LABELS + 2 + WIDTH - label.len());
        labels.splice(start..start + label.len(), label.chars());
    }
    let (axis, labels): (String, String) = (axis.iter().collect(), labels.iter().collect());
    text + &format!("{:>LABELS$} └{axis}\n{}\n", "", labels.trim_end())
}

/// What the letters mean, and what the axis below is.
fn legend(rows: &[TradeRow], axes: Axes) -> String {
    let mut names: Vec<&str> = rows.iter().map(|row| row.method.as_str()).collect();
    names.dedup();
    let words = names.iter().map(|name| format!("{} {name}", name.chars().next().unwrap_or('?')));
    let words: Vec<String> = words.collect();
    let axis = format!("{:>LABELS$}  {:^WIDTH$}", "", axes.x.axis());
    let own = floor(rows, axes).map(|_| format!("{:>LABELS$}  -: exact's own error\n", "")).unwrap_or_default();
    format!("{}\n{:>LABELS$}  {}; capital and ·: the front\n{own}", axis.trim_end(), "", words.join(", "))
}
