//! Errors over time as a figure: a line for each file on a logarithmic axis, the yardstick's own error, what passes.

use std::fmt::Write;

use super::class::Marked;
use super::exam::{Exam, Mark};
use crate::format;
use crate::printable;

/// Width and height of the figure, px.
const SIZE: (f64, f64) = (760.0, 440.0);

/// The plot in it, px: left, top, width, height.
const PLOT: [f64; 4] = [80.0, 50.0, 480.0, 330.0];

/// Files that are drawn: more cannot be told apart.
const DRAWN: usize = 8;

/// Colours that the colour-blind tell apart (Okabe & Ito 2008); beyond four lines the dashes differ too.
const COLORS: [&str; 4] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"];

/// Dashes of the first four lines and of the next.
const DASHES: [&str; 2] = ["none", "5 3"];

/// Errors below are drawn on the lowest line, m.
const NOTHING: f64 = 1e-16;

/// The map from time (s) and error (m) to px.
struct Axes {
    end: f64,
    low: i32,
    high: i32,
}

impl Axes {
    fn of(exam: &Exam, marks: &[(&str, &Mark)]) -> Axes {
        let errors = marks.iter().flat_map(|(_, mark)| mark.series.points()).map(|point| point.1);
        let others = [Some(exam.certificate.error), exam.tolerance].into_iter().flatten();
        let logs = errors.chain(others).filter(|error| error.is_finite()).map(|error| error.max(NOTHING).log10());
        let (low, high) = logs.fold((0.0_f64, -16.0_f64), |(low, high), log| (low.min(log), high.max(log)));
        let end = marks.iter().map(|(_, mark)| mark.compared).fold(0.0, f64::max);
        let low = low.floor() as i32;
        Axes { end: if end > 0.0 { end } else { 1.0 }, low, high: (high.ceil() as i32).max(low + 1) }
    }

    fn across(&self, time: f64) -> f64 {
        PLOT[0] + (time / self.end).clamp(0.0, 1.0) * PLOT[2]
    }

    fn up(&self, error: f64) -> f64 {
        let part = (error.max(NOTHING).log10() - f64::from(self.low)) / f64::from(self.high - self.low);
        PLOT[1] + (1.0 - part.clamp(0.0, 1.0)) * PLOT[3]
    }
}

/// The figure of all files that could be read, the first few of them.
pub fn figure(exam: &Exam, scene: &str, other: Option<&str>, marked: &[Marked]) -> String {
    let read: Vec<(&str, &Mark)> =
        marked.iter().filter_map(|marked| Some((marked.name.as_str(), marked.mark.as_ref().ok()?))).collect();
    let more = read.len().saturating_sub(DRAWN);
    let drawn = &read[..read.len().min(DRAWN)];
    let axes = Axes::of(exam, drawn);
    let (width, height) = SIZE;
    let title = escape(&format!("{scene}: position error over time, against {}", other.unwrap_or("exact")));
    let mut svg = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" role="img" aria-labelledby="title" font-family="sans-serif" font-size="13" fill="#000000">
<title id="title">{title}</title>
<rect width="100%" height="100%" fill="#ffffff"/>
<text x="{}" y="{}" font-size="17" font-weight="bold">{title}</text>
"##,
        PLOT[0],
        PLOT[1] - 20.0,
    );
    frame(&axes, &mut svg);
    levels(exam, other.is_none(), &axes, &mut svg);
    for (index, (name, mark)) in drawn.iter().enumerate() {
        curve(index, name, mark, &axes, &mut svg);
    }
    if more > 0 {
        label(drawn.len(), &format!("and {more} files more"), &mut svg);
    }
    svg + "</svg>\n"
}

/// Outline, grid, ticks and the names of the axes.
fn frame(axes: &Axes, svg: &mut String) {
    let [left, top, width, height] = PLOT;
    let bottom = top + height;
    let step = (1..).find(|step| (axes.high - axes.low) / step < 12).unwrap_or(1);
    for power in (axes.low..=axes.high).rev().step_by(step as usize) {
        let y = axes.up(10.0_f64.powi(power));
        let _ = writeln!(svg, r##"<path stroke="#dddddd" d="M{left} {y:.1}h{width}"/>"##);
        let exponent = power.to_string().replace('-', "−");
        let _ = writeln!(
            svg,
            r#"<text x="{}" y="{:.1}" text-anchor="end">10<tspan dy="-5" font-size="10">{exponent}</tspan></text>"#,
            left - 8.0,
            y + 4.5
        );
    }
    for k in 0..=5 {
        let time = axes.end * f64::from(k) / 5.0;
        let x = axes.across(time);
        let _ = writeln!(svg, r##"<path stroke="#dddddd" d="M{x:.1} {top}v{height}"/>"##);
        let _ = writeln!(
            svg,
            r#"<text x="{x:.1}" y="{}" text-anchor="middle">{}</text>"#,
            bottom + 20.0,
            format::significant(time, 2)
        );
    }
    let _ = writeln!(
        svg,
        r##"<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#000000"/>"##
    );
    let (across, up) = (left + width / 2.0, top + height / 2.0);
    let _ = writeln!(svg, r#"<text x="{across}" y="{}" text-anchor="middle">time, s</text>"#, bottom + 44.0);
    let _ = writeln!(
        svg,
        r#"<text transform="translate(22 {up}) rotate(-90)" text-anchor="middle">largest position error, m</text>"#
    );
}

/// What passes, and how far the yardstick itself is off.
fn levels(exam: &Exam, against_exact: bool, axes: &Axes, svg: &mut String) {
    let floor = against_exact.then_some((exam.certificate.error, "exact's own error"));
    let passes = exam.tolerance.map(|tolerance| (tolerance, "passes below"));
    for (error, words) in [floor, passes].into_iter().flatten() {
        let y = axes.up(error);
        let _ =
            writeln!(svg, r##"<path stroke="#000000" stroke-dasharray="2 3" d="M{} {y:.1}h{}"/>"##, PLOT[0], PLOT[2]);
        let right = PLOT[0] + PLOT[2] - 6.0;
        let _ =
            writeln!(svg, r#"<text x="{right}" y="{:.1}" text-anchor="end" font-size="11">{words}</text>"#, y - 4.0);
    }
}

fn curve(index: usize, name: &str, mark: &Mark, axes: &Axes, svg: &mut String) {
    let mut path = String::new();
    for (time, error) in mark.series.points() {
        let letter = if path.is_empty() { 'M' } else { 'L' };
        let _ = write!(path, "{letter}{:.1} {:.1}", axes.across(*time), axes.up(*error));
    }
    let look = look(index);
    let _ = writeln!(svg, r#"<path fill="none" stroke-width="1.6" {look} d="{path}"/>"#);
    let y = label(index, name, svg);
    let _ = writeln!(svg, r#"<path stroke-width="1.6" {look} d="M{} {y}h18"/>"#, PLOT[0] + PLOT[2] + 12.0);
}

fn look(index: usize) -> String {
    let (color, dash) = (COLORS[index % COLORS.len()], DASHES[index / COLORS.len() % DASHES.len()]);
    format!(r#"stroke="{color}" stroke-dasharray="{dash}""#)
}

/// A line of the legend; its height, px.
fn label(index: usize, words: &str, svg: &mut String) -> f64 {
    let y = PLOT[1] + 12.0 + 24.0 * index as f64;
    let words = printable::shortened(words.rsplit('/').next().unwrap_or(words), 20);
    let _ = writeln!(svg, r#"<text x="{}" y="{}">{}</text>"#, PLOT[0] + PLOT[2] + 36.0, y + 4.5, escape(&words));
    y
}

fn escape(text: &str) -> String {
    printable::escaped(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
