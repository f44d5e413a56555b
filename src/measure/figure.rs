//! The trade as a figure for a lecture: error over cost on logarithmic axes, a panel for each scene. SVG without
//! colours that matter: each method has a marker of its own, filled on the front.

use std::fmt::Write;

use super::alike::folded;
use super::axes::{Axes, Error};
use super::front::front;
use super::scale::Scale;
use crate::export::TradeRow;
use crate::format;
use crate::printable;
use crate::scene::Method;

/// Width of the figure and height of one panel with all its words, px.
const WIDTH: f64 = 760.0;
const PANEL: f64 = 460.0;

/// The plot within its panel, px: left, top, width, height.
const PLOT: Plot = Plot { left: 80.0, top: 50.0, width: 520.0, height: 340.0 };

/// Marks along an axis at most: across, up.
const TICKS: (usize, usize) = (9, 12);

/// Colours that the colour-blind tell apart and that print as different greys (Okabe & Ito 2008), by marker.
pub(super) const COLORS: [&str; 5] = ["#0072b2", "#d55e00", "#000000", "#009e73", "#cc79a7"];

/// Where a plot lies, px.
#[derive(Clone, Copy)]
struct Plot {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

/// Two axes within a plot.
struct Frame {
    plot: Plot,
    axes: Axes,
    x: Scale,
    y: Scale,
}

impl Frame {
    /// Place of a row, px; none if it lacks a figure.
    fn point(&self, row: &TradeRow) -> Option<(f64, f64)> {
        let (cost, error) = self.axes.point(row)?;
        Some((self.across(self.x.place(cost)), self.up(self.y.place(error))))
    }

    fn across(&self, part: f64) -> f64 {
        self.plot.left + part * self.plot.width
    }

    fn up(&self, part: f64) -> f64 {
        self.plot.top + (1.0 - part) * self.plot.height
    }
}

/// The figure of all rows, a panel for each scene. `allowed` methods compete on the front; `about`, the machine and the
/// command, becomes the figure's description.
pub fn figure(rows: &[TradeRow], allowed: &[Method], axes: Axes, about: &str) -> String {
    let panels: Vec<&[TradeRow]> = rows.chunk_by(|a, b| a.scene == b.scene).collect();
    let height = PANEL * panels.len().max(1) as f64;
    let names: Vec<&str> = panels.iter().map(|rows| rows[0].scene.as_str()).collect();
    let description = if about.is_empty() { String::new() } else { format!("<desc>{}</desc>\n", escape(about)) };
    let mut svg = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}" role="img" aria-labelledby="title" font-family="sans-serif" font-size="13" fill="#000000">
<title id="title">{} over cost: {}</title>
{description}<rect width="100%" height="100%" fill="#ffffff"/>
"##,
        axes.y.title(),
        escape(&names.join(", ")),
    );
    for (index, rows) in panels.into_iter().enumerate() {
        let _ = writeln!(svg, r#"<g transform="translate(0 {})">"#, index as f64 * PANEL);
        panel(rows, (allowed, axes), &mut svg);
        svg += "</g>\n";
    }
    svg + "</svg>\n"
}

fn panel(rows: &[TradeRow], (allowed, axes): (&[Method], Axes), svg: &mut String) {
    let (rows, same): (Vec<TradeRow>, Vec<Option<String>>) = folded(rows).into_iter().unzip();
    let rows = &rows[..];
    let points = || rows.iter().filter_map(|row| axes.point(row));
    let (x, y) = (Scale::around(points().map(|p| p.0)), Scale::around(points().map(|p| p.1).chain(floor(rows, axes))));
    let framed = Frame { plot: PLOT, axes, x, y };
    let best = front(rows, allowed, axes);
    frame(&framed, svg);
    words(rows, &framed, svg);
    own_error(rows, &framed, svg);
    steps(rows, &best, &framed, svg);
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by_key(|index| best.contains(index)); // the front last: nothing covers it
    for index in order {
        if let Some(place) = framed.point(&rows[index]) {
            let look = if best.contains(&index) { Look::Filled } else { look(&rows[index]) };
            marker(&rows[index].method, place, look, &tip(&rows[index], same[index].as_deref()), svg);
        }
    }
    legend(rows, svg);
}

/// The plot's outline, its grid and its tick labels.
fn frame(axes: &Frame, svg: &mut String) {
    let Plot { left, top, width, height } = axes.plot;
    let bottom = top + height;
    for (place, label) in axes.x.ticks(TICKS.0) {
        let x = axes.across(place);
        let _ = writeln!(svg, r##"<path stroke="#dddddd" d="M{x:.1} {top}V{bottom}"/>"##);
        let _ =
            writeln!(svg, r#"<text x="{x:.1}" y="{}" text-anchor="middle">{}</text>"#, bottom + 20.0, power(&label));
    }
    for (place, label) in axes.y.ticks(TICKS.1) {
        let y = axes.up(place);
        let _ = writeln!(svg, r##"<path stroke="#dddddd" d="M{left} {y:.1}H{}"/>"##, left + width);
        let _ =
            writeln!(svg, r#"<text x="{}" y="{:.1}" text-anchor="end">{}</text>"#, left - 8.0, y + 4.5, power(&label));
    }
    let _ = writeln!(
        svg,
        r##"<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#000000"/>"##
    );
}

/// 1e-3 as a power of ten.
fn power(label: &str) -> String {
    match label.split_once('e') {
        Some((_, exponent)) => {
            format!(r#"10<tspan dy="-5" font-size="10">{}</tspan>"#, exponent.replace('-', "−"))
        }
        None => label.into(),
    }
}

/// The title and what the axes are.
fn words(rows: &[TradeRow], axes: &Frame, svg: &mut String) {
    let Plot { left, top, width, height } = axes.plot;
    let horizon = match rows[0].horizon {
        Some(time) => format!("horizon {} s", format::time(time)),
        None => "no horizon within the run".into(),
    };
    let title = escape(&format!("{}: accuracy for time ({horizon})", rows[0].scene));
    let (across, up) = (left + width / 2.0, top + height / 2.0);
    let _ = writeln!(svg, r#"<text x="{left}" y="{}" font-size="17" font-weight="bold">{title}</text>"#, top - 20.0);
    let _ = writeln!(
        svg,
        r#"<text x="{across}" y="{}" text-anchor="middle">{}</text>"#,
        top + height + 46.0,
        axes.axes.x.label(),
    );
    let _ = writeln!(
        svg,
        r#"<text transform="translate(22 {up}) rotate(-90)" text-anchor="middle">{}</text>"#,
        axes.axes.y.label(),
    );
}

/// The yardstick's own error, if it is known and is one of these errors.
fn floor(rows: &[TradeRow], axes: Axes) -> Option<f64> {
    rows[0].floor.filter(|floor| axes.y == Error::Position && *floor > 0.0)
}

/// The line below which no position error means anything.
fn own_error(rows: &[TradeRow], framed: &Frame, svg: &mut String) {
    let Some(floor) = floor(rows, framed.axes) else { return };
    let (left, right, y) = (framed.across(0.0), framed.across(1.0), framed.up(framed.y.place(floor)));
    let _ = writeln!(svg, r##"<path stroke="#000000" stroke-dasharray="2 3" d="M{left} {y:.1}H{right}"/>"##);
    let _ = writeln!(
        svg,
        r#"<text x="{}" y="{:.1}" text-anchor="end" font-size="11">exact's own error</text>"#,
        right - 6.0,
        y - 4.0
    );
}

/// The front as steps: from each setting's cost on, its error is to be had.
fn steps(rows: &[TradeRow], best: &[usize], axes: &Frame, svg: &mut String) {
    let corners: Vec<(f64, f64)> = best.iter().filter_map(|&row| axes.point(&rows[row])).collect();
    let Some(&(x, y)) = corners.first() else { return };
    let mut path = format!("M{x:.1} {y:.1}");
    for (x, y) in &corners[1..] {
        let _ = write!(path, "H{x:.1}V{y:.1}");
    }
    let _ = write!(path, "H{:.1}", axes.across(1.0));
    let _ = writeln!(svg, r##"<path fill="none" stroke="#555555" stroke-width="1.5" d="{path}"/>"##);
}

/// How a mark looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Look {
    /// On the front.
    Filled,
    /// Beaten by others, or apart from them.
    Open,
    /// Of a run that stopped before the end.
    Dashed,
}

fn look(row: &TradeRow) -> Look {
    if row.note.stalled.is_some() { Look::Dashed } else { Look::Open }
}

/// The mark of a method; `tip` shows when the pointer rests on it.
pub(super) fn marker(method: &str, (x, y): (f64, f64), look: Look, tip: &str, svg: &mut String) {
    let index = Method::from_name(method).and_then(|method| Method::ALL.iter().position(|other| *other == method));
    let index = index.unwrap_or(COLORS.len() - 1) % COLORS.len();
    let color = COLORS[index];
    let fill = if look == Look::Filled { color } else { "#ffffff" };
    let dashes = if look == Look::Dashed { r#" stroke-dasharray="2 2""# } else { "" };
    let shape = match index {
        0 => "m-5-5h10v10h-10z",
        1 => "m0-6.5l6 11h-12z",
        2 => "m0-7l6 7l-6 7l-6-7z",
        3 => "m-5.5 0a5.5 5.5 0 1 0 11 0a5.5 5.5 0 1 0-11 0z",
        _ => "m0 6.5l6-11h-12z",
    };
    let title = if tip.is_empty() { String::new() } else { format!("<title>{}</title>", escape(tip)) };
    let _ = writeln!(
        svg,
        r#"<path fill="{fill}" fill-opacity="0.9" stroke="{color}" stroke-width="1.4"{dashes} d="M{x:.1} {y:.1}{shape}">{title}</path>"#
    );
}

fn tip(row: &TradeRow, same: Option<&str>) -> String {
    let note = row.note.to_string();
    let said: Vec<&str> = [same, Some(note.as_str())].into_iter().flatten().filter(|said| !said.is_empty()).collect();
    let colon = if said.is_empty() { "" } else { ": " };
    super::report::setting(&row.method, row.dt, row.tolerance) + colon + &said.join("; ")
}

/// A marker and a name for each method, at the right of the plot.
fn legend(rows: &[TradeRow], svg: &mut String) {
    let left = PLOT.left + PLOT.width + 25.0;
    let mut y = PLOT.top + 12.0;
    let mut line = |text: &str, svg: &mut String| {
        let _ = writeln!(svg, r#"<text x="{}" y="{}">{}</text>"#, left + 14.0, y + 4.5, escape(text));
        y += 24.0;
        y - 24.0
    };
    let mut names: Vec<&str> = rows.iter().map(|row| row.method.as_str()).collect();
    names.dedup();
    for name in names {
        let y = line(name, svg);
        marker(name, (left, y), Look::Open, "", svg);
    }
    let stopped = rows.iter().filter(|row| row.note.stalled.is_some());
    if let Some(row) = stopped.clone().next() {
        let y = line(&format!("{} stopped early", stopped.count()), svg);
        marker(&row.method, (left, y), Look::Dashed, "", svg);
    }
    let y = line("the front (filled)", svg);
    let _ = writeln!(svg, r##"<path stroke="#555555" stroke-width="1.5" d="M{} {y}h16"/>"##, left - 8.0);
}

pub(super) fn escape(text: &str) -> String {
    printable::escaped(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
