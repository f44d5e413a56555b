//! The search for the collision time: degree over step as a chart, and trial step by trial step.

use ratatui::layout::Rect;

use super::{
    canvas::{Canvas, Layer, Stroke},
    column::Column,
    sheet::Sheet,
};
use crate::format;
use crate::snapshot::{Probe, Snapshot};

/// Rows of the chart.
const CHART: u16 = 6;

/// Rows that must be left beside the chart: heading, legend, and a few trial steps.
const BESIDE: usize = 6;

/// Fewest columns that a chart needs.
const NARROW: usize = 20;

/// Largest degree on the chart over the one accepted; what is beyond lies on the chart's edge.
const RANGE: f64 = 4.0;

/// Columns of a row without its last word.
const PLAIN: usize = 26;

/// What there is to show of a search.
pub(super) struct Search<'a> {
    probes: &'a [Probe],
    /// The largest degree accepted, dimensionless; none if no overlap is.
    limit: f64,
    /// The trial step that is shown in the views, if one is.
    at: Option<usize>,
}

impl<'a> Search<'a> {
    /// The search of a snapshot's frame; `at`: the trial step shown in the views.
    pub(super) fn new(snapshot: &'a Snapshot, at: Option<usize>) -> Search<'a> {
        let limit = snapshot.tolerance + snapshot.slack.unwrap_or(0.0);
        Search { probes: &snapshot.probes, limit, at: at.filter(|at| *at < snapshot.probes.len()) }
    }

    /// The word for a trial step's result.
    fn verdict(&self, index: usize) -> &'static str {
        match self.probes[index].degree {
            _ if index + 1 == self.probes.len() => "accepted",
            degree if degree > self.limit => "too deep",
            degree if degree <= 0.0 => "apart",
            _ => "touches",
        }
    }

    /// Half the height of the chart, in degrees of overlap.
    fn range(&self) -> f64 {
        let finite = self.probes.iter().map(|probe| probe.degree.abs()).filter(|degree| degree.is_finite());
        let most = finite.fold(0.0, f64::max);
        if self.limit > 0.0 { most.min(RANGE * self.limit).max(self.limit) } else { most }
    }
}

/// Draws the chart where there is room, then the trial steps: those around the one that is shown, else the last ones,
/// which are the closest to the collision.
pub(super) fn draw(search: &Search, column: &mut Column) {
    let probes = search.probes;
    if probes.is_empty() || column.rows() < 3 {
        return;
    }
    let remark = match search.at {
        Some(at) => format!("trial step {} of {}", at + 1, probes.len()),
        None => format!("{} trial steps", probes.len()),
    };
    column.heading("search", &remark);
    if column.rows() >= usize::from(CHART) + BESIDE && column.width() >= NARROW {
        draw_chart(search, column);
    }
    let palette = column.sheet().palette;
    column.row("      step s     overlap", palette.faint());
    let rows = column.rows().saturating_sub(1).min(probes.len());
    let last = search.at.map_or(probes.len(), |at| (at + 1 + rows / 2).clamp(rows, probes.len()));
    for index in last - rows..last {
        draw_step(search, index, column);
    }
}

fn draw_step(search: &Search, index: usize, column: &mut Column) {
    let (palette, glyphs) = (column.sheet().palette, column.sheet().glyphs);
    let Probe { step, degree } = search.probes[index];
    let touching = if degree >= 0.0 { glyphs.contact[0] } else { ' ' };
    // Methods that look only for overlap report how deep it is, and of what is apart no more than that.
    let shown = if degree == f64::NEG_INFINITY { format!("{:>10}", "apart") } else { format::scientific(degree, 10) };
    let verdict = if column.width() >= PLAIN + 9 { search.verdict(index) } else { "" };
    let style = if search.at == Some(index) { palette.reverse() } else { palette.plain() };
    column.row(&format!("{}  {shown} {touching} {verdict}", format::decimal(step, 12, 9)), style);
}

/// Draws degree over step: touching at the middle line, accepted between it and the one above, each trial step a sign.
fn draw_chart(search: &Search, column: &mut Column) {
    let area = column.take(CHART);
    let longest = search.probes.iter().map(|probe| probe.step).fold(0.0, f64::max);
    let range = search.range();
    if !(longest > 0.0 && range > 0.0) {
        return;
    }
    let sheet = column.sheet_mut();
    let mut canvas = Canvas::new(area);
    let (right, bottom) = (f64::from(canvas.width() - 1), f64::from(canvas.height() - 1));
    let height = |degree: f64| (0.5 - 0.5 * (degree / range).clamp(-1.0, 1.0)) * bottom;
    draw_band(&mut canvas, [height(0.0), height(search.limit)], sheet);
    for (index, probe) in search.probes.iter().enumerate() {
        let (x, y) = ((probe.step / longest * right).round(), height(probe.degree).round());
        let [deep, good, apart] = sheet.glyphs.contact;
        let (sign, style) = match search.verdict(index) {
            "accepted" => (good, sheet.palette.good()),
            "too deep" => (deep, sheet.palette.alarm()),
            _ => (apart, sheet.palette.plain()),
        };
        let style = if search.at == Some(index) { style.patch(sheet.palette.strong()) } else { style };
        let layer = if search.at == Some(index) { Layer::Selected } else { Layer::Contact };
        canvas.sign(x as i32, y as i32, sign, Stroke::new(layer, style));
    }
    canvas.paint(area, sheet);
    draw_legend(search, [range, longest], area, sheet);
}

/// Draws the bounds of the accepted degrees as two dotted lines.
fn draw_band(canvas: &mut Canvas, lines: [f64; 2], sheet: &Sheet) {
    let stroke = Stroke::new(Layer::Wall, sheet.palette.notice());
    for (line, every) in lines.into_iter().zip([2, 4]) {
        (0..canvas.width()).step_by(every).for_each(|x| canvas.dot(x, line.round() as i32, stroke));
    }
}

/// Draws the ends of both axes, in the corners.
fn draw_legend(search: &Search, [range, longest]: [f64; 2], area: Rect, sheet: &mut Sheet) {
    let faint = sheet.palette.faint();
    let top = format::digits(range, 0);
    sheet.put(area, &top, faint); // on the right is the longest step, too deep in most searches
    let low = Rect { y: area.y + area.height.saturating_sub(1), height: 1, ..area };
    let end = format!("{} s", format::setting(longest));
    sheet.put_right(low, &end, faint);
    let accepted = format!("accepted up to {}", format::digits(search.limit, 1));
    if accepted.len() + end.len() + 2 <= area.width.into() {
        sheet.put(low, &accepted, sheet.palette.notice());
    }
}
