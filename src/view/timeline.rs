//! The timeline: when the impacts were, and where we are.

use ratatui::layout::Rect;

use super::{
    layout::{split_left, split_right},
    screen::Screen,
    sheet::{self, Sheet},
};
use crate::format;

/// Draws the timeline: 0, a tick for every column with impacts, higher for more, a cursor at t, the end, and as much of
/// what is said to the right as fits.
pub(super) fn draw(screen: &Screen, area: Rect, sheet: &mut Sheet) {
    let Parts { end, track, right, right_area } = Parts::of(screen, area);
    let faint = sheet.palette.faint();
    sheet.put(area, BEGIN, faint);
    sheet.put(right_area, &right, faint);
    draw_track(screen, end, track, sheet);
}

/// The text behind the track: its end; then how many impacts there were, or which frame of how many is shown; then from
/// when on frames are kept, if not from the start. Each where there is room.
fn right(screen: &Screen, end: f64, columns: u16) -> String {
    let (tallies, kept) = (&screen.snapshot.tallies, &screen.kept);
    let mut right = format!(" {} s ", format::setting(end));
    if columns >= 50 && kept.is_past {
        right += &format!(" frame {} of {} ", format::thousands(tallies.frames), format::thousands(kept.newest));
    } else if columns >= 50 {
        let impacts = if tallies.impacts == 1 { "impact " } else { "impacts" };
        right += &format!(" {:>6} {impacts} ", format::thousands(tallies.impacts));
    }
    if columns >= 70 && kept.oldest > 0 {
        right += &format!(" kept from {} s ", format::setting(kept.from));
    }
    right
}

/// The text before the track.
const BEGIN: &str = " 0 ";

/// What the timeline is made of.
struct Parts {
    /// The time at the track's end, s.
    end: f64,
    track: Rect,
    /// The text behind the track.
    right: String,
    right_area: Rect,
}

impl Parts {
    fn of(screen: &Screen, area: Rect) -> Parts {
        let snapshot = screen.snapshot;
        let end = end(snapshot.t.max(screen.kept.until), snapshot.stage.duration);
        let (_, rest) = split_left(area, BEGIN.len() as u16);
        let right = right(screen, end, rest.width);
        let columns = (sheet::width(&right) as u16).min(rest.width);
        let (track, right_area) = split_right(rest, columns);
        Parts { end, track, right, right_area }
    }
}

/// The time, s, in the middle of a column of the track; none beside it. That of the first column is 0.
pub(super) fn time_at(screen: &Screen, area: Rect, column: u16) -> Option<f64> {
    let Parts { end, track, .. } = Parts::of(screen, area);
    let at = column.checked_sub(track.x).filter(|at| *at < track.width)?;
    Some(if at == 0 { 0.0 } else { end * (f64::from(at) + 0.5) / f64::from(track.width) })
}

/// The time at the track's end, s: the scene's duration, doubled as long as the run is beyond it.
fn end(t: f64, duration: f64) -> f64 {
    let mut end = if duration.is_finite() && duration > 0.0 { duration } else { 1.0 };
    while end < t && end < f64::MAX / 2.0 {
        end *= 2.0;
    }
    end
}

fn draw_track(screen: &Screen, end: f64, track: Rect, sheet: &mut Sheet) {
    if track.is_empty() {
        return;
    }
    let bins = columns(screen, end, track.width.into());
    let most = bins.iter().copied().max().unwrap_or(0).max(1);
    let [kept, gone, future, cursor_sign] = sheet.glyphs.track;
    let cursor = column(screen.snapshot.t, end, track.width);
    let newest = column(screen.kept.until.max(screen.snapshot.t), end, track.width);
    let oldest = if screen.kept.oldest > 0 { column(screen.kept.from, end, track.width) } else { 0 };
    let (palette, levels) = (sheet.palette, sheet.glyphs.levels);
    for (x, impacts) in (0..track.width).zip(bins) {
        let (sign, style) = match (x, impacts) {
            (x, _) if x == cursor => (cursor_sign, palette.notice().patch(palette.strong())),
            // what has been, but is still to come from where one is, recedes
            (x, 1..) if x > cursor && screen.kept.is_past => {
                (level(impacts, most, levels), palette.alarm().patch(palette.faint()))
            }
            (_, 1..) => (level(impacts, most, levels), palette.alarm()),
            (x, _) if x < oldest => (gone, palette.faint()),
            (x, _) if x < newest || x == newest && screen.kept.is_past => (kept, palette.faint()),
            _ => (future, palette.faint()),
        };
        sheet.put(Rect { x: track.x + x, width: 1, ..track }, sign.encode_utf8(&mut [0; 4]), style);
    }
}

/// The column of a time `t` on a track that ends at `end`, s.
fn column(t: f64, end: f64, width: u16) -> u16 {
    ((t / end * f64::from(width)).floor().max(0.0) as u16).min(width - 1)
}

/// Impacts per column of the track: each bin counts in the column of its middle, or, if bins are wider than columns, in
/// the first of its columns.
fn columns(screen: &Screen, end: f64, width: usize) -> Vec<u64> {
    let ticks = screen.ticks;
    let mut columns = vec![0_u64; width];
    let bin = ticks.span / ticks.impacts.len() as f64;
    for (i, impacts) in ticks.impacts.iter().enumerate().filter(|(_, impacts)| **impacts > 0) {
        let middle = (i as f64 + 0.5) * bin;
        if middle < end {
            columns[usize::from(column(middle, end, width as u16))] += u64::from(*impacts);
        }
    }
    columns
}

/// The sign for a number of impacts: square roots, so that single impacts are still seen beside crowded columns.
fn level(impacts: u64, most: u64, levels: &[char]) -> char {
    let share = (impacts as f64 / most as f64).sqrt();
    let step = (share * levels.len() as f64).ceil() as usize;
    levels[step.clamp(1, levels.len()) - 1]
}
