//! The run against the exact one: where that is, errors now and over time, and what they cost.

use ratatui::layout::Rect;

use super::{
    layout::{split_left, split_right, split_top},
    screen::{Comparison, Screen},
    sheet::Sheet,
};
use crate::format;
use crate::snapshot::{Ghost, Trend};

/// Columns for a quantity's name, value and unit.
const HEAD: u16 = 29;

/// Columns for the range of a sparkline.
const RANGE: u16 = 16;

/// Fewest columns of a sparkline.
const NARROW: u16 = 8;

/// How a sparkline maps values to heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scale {
    /// Heights by decades, for errors.
    Log,
    /// Heights from 0 on, for costs.
    Linear,
}

/// A quantity: name, unit, trend, scale.
type Row<'a> = (&'a str, &'a str, &'a Trend, Scale);

/// Draws the comparison: a heading, and a row for each quantity as far as there are rows.
pub(super) fn draw(screen: &Screen, comparison: &Comparison, area: Rect, sheet: &mut Sheet) {
    let (row, mut rest) = split_top(area, 1);
    draw_heading(screen, comparison, row, sheet);
    let trade = comparison.trade;
    let rows: [Row; 5] = [
        ("error", "m", &trade.deviation, Scale::Log),
        ("energy", "relative", &trade.energy_error, Scale::Log),
        ("deepest", "overlap", &trade.deepest_degree, Scale::Log),
        ("gaps", "a frame", &trade.evaluations, Scale::Linear),
        ("CPU", "ms/s", &trade.cost, Scale::Linear),
    ];
    let past = comparison.ghost.filter(|ghost| ghost.is_past_horizon()).and_then(|ghost| ghost.horizon);
    for (i, quantity) in rows.iter().enumerate() {
        let (row, below) = split_top(rest, 1);
        match past {
            Some(horizon) if i == 0 => draw_past(horizon, row, sheet),
            _ => draw_quantity(quantity, row, sheet),
        }
        rest = below;
    }
}

/// Draws where the exact run is, and how far off the selected sphere is, or the worst.
fn draw_heading(screen: &Screen, comparison: &Comparison, row: Rect, sheet: &mut Sheet) {
    let (heading, plain, faint) = (sheet.palette.heading(), sheet.palette.plain(), sheet.palette.faint());
    let Some(ghost) = comparison.ghost else {
        sheet.put_all(row, &[(" exact run ", heading), ("on its way", faint)]);
        return;
    };
    if let Some(reason) = &ghost.stall {
        sheet.put_all(row, &[(" exact run ", heading), ("stops: ", sheet.palette.alarm()), (reason, plain)]);
        return;
    }
    let snapshot = screen.snapshot;
    let t = format::clock(ghost.t, snapshot.stage.duration.max(ghost.t), snapshot.dt);
    let behind = match snapshot.t - ghost.t {
        lag if lag > 0.0 => format!("  {} s behind", format::decimal(lag, 5, 2).trim_start()),
        _ => String::new(),
    };
    let pieces =
        [(" exact run ", heading), (" t ", faint), (&*t, plain), (" s", faint), (&*behind, sheet.palette.notice())];
    let used = sheet.put_all(row, &pieces);
    let off = offset(screen, ghost);
    let (_, rest) = split_left(row, used + 2);
    if off.len() <= rest.width.into() {
        sheet.put_right(rest, &off, plain);
    }
}

/// "#2 is off by 1.2e-3 m": the selected sphere, or the one that is furthest off. Nothing beyond the horizon.
fn offset(screen: &Screen, ghost: &Ghost) -> String {
    if ghost.is_past_horizon() {
        return String::new();
    }
    let selected = screen.view_settings.selected.and_then(|i| Some((i, *ghost.deviations.get(i)?)));
    match (selected, ghost.worst()) {
        (Some((i, off)), _) => format!("#{i} selected, off by {} m ", format_args!("{off:.2e}")),
        (None, Some((i, off))) if off > 0.0 => format!("#{i} is furthest off, by {} m ", format_args!("{off:.2e}")),
        _ => String::new(),
    }
}

/// Draws, in the error's place, that positions mean nothing any more from `horizon` (s) on.
fn draw_past(horizon: f64, row: Rect, sheet: &mut Sheet) {
    let text = format!("past this scene's horizon of {} s: positions mean nothing", format::setting(horizon));
    sheet.put_all(row, &[(" error    ", sheet.palette.faint()), (&text, sheet.palette.notice())]);
}

fn draw_quantity((name, unit, trend, scale): &Row, row: Rect, sheet: &mut Sheet) {
    let (faint, plain) = (sheet.palette.faint(), sheet.palette.plain());
    let show = |value: f64| match scale {
        Scale::Log => format::scientific(value, 10),
        Scale::Linear => format::decimal(value, 10, 1),
    };
    let value = trend.last.map_or_else(|| format!("{:>10}", "-"), show);
    sheet.put_all(row, &[(&format!(" {name:<8}"), faint), (&value, plain), (&format!(" {unit}"), faint)]);
    let (_, rest) = split_left(row, HEAD);
    let (track, range) = split_right(rest, RANGE.min(rest.width.saturating_sub(NARROW)));
    let known = |value: &&f64| value.is_finite() && (**value > 0.0 || *scale == Scale::Linear);
    let most = trend.values.iter().filter(known).copied().fold(0.0, f64::max);
    if track.width < NARROW || most == 0.0 {
        return;
    }
    let least = match scale {
        Scale::Log => trend.values.iter().filter(known).copied().fold(most, f64::min),
        Scale::Linear => 0.0,
    };
    let signs: String = columns(trend, track.width).map(|value| sign(value, least, most, *scale, sheet)).collect();
    sheet.put(track, &signs, plain);
    if range.width == RANGE {
        let show = |value: f64| match scale {
            Scale::Log => format!("{value:.0e}"),
            Scale::Linear => format::setting(value),
        };
        let ends = format!("{} {} {} ", show(least), sheet.glyphs.ellipsis, show(most));
        sheet.put_right(range, &ends, faint);
    }
}

/// The largest value in each of `width` columns; NaN where none is known.
fn columns(trend: &Trend, width: u16) -> impl Iterator<Item = f64> {
    let (bins, width) = (trend.values.len(), usize::from(width));
    (0..width).map(move |x| {
        let (from, to) = (x * bins / width, ((x + 1) * bins / width).max(x * bins / width + 1));
        trend.values[from.min(bins)..to.min(bins)].iter().fold(f64::NAN, |most, value| most.max(*value))
    })
}

/// A column's height as a character: a blank where nothing is known or there is no error at all.
fn sign(value: f64, least: f64, most: f64, scale: Scale, sheet: &Sheet) -> char {
    let levels = sheet.glyphs.levels;
    let share = match scale {
        Scale::Log if value > 0.0 => (value / least).log10() / (most / least).log10().max(1.0),
        Scale::Linear => value / most,
        Scale::Log => f64::NAN,
    };
    if !(share > 0.0 || (share == 0.0 && scale == Scale::Log)) {
        return ' ';
    }
    let step = (share * levels.len() as f64).ceil() as usize;
    levels[step.clamp(1, levels.len()) - 1]
}
