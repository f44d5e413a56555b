//! The list of all that has happened, the newest at its end.

use ratatui::{
    layout::{Position, Rect},
    style::Style,
};

use super::{
    layout::{split_left, split_right, split_top},
    screen::EventsView,
    sheet::{self, Sheet},
};
use crate::format;
use crate::snapshot::{Class, Kind, Logged, Snapshot};

/// The text before the filter's.
const BEFORE: &str = " log  ";

/// Columns for a time.
const TIME: usize = 10;
/// Columns for the two bodies.
const BODIES: usize = 14;
/// Columns for a class.
const CLASS: usize = 10;
/// Columns for the speeds before and after.
const SPEEDS: usize = 23;

/// Draws heading, filter and as many events as fit, the one under the cursor among them.
pub(super) fn draw(list: &EventsView, snapshot: &Snapshot, body: Rect, sheet: &mut Sheet) {
    let (head, rows) = split_top(body, u16::from(body.height > 1));
    let shown: Vec<(u64, &Logged)> = list.log.iter().filter(|(_, event)| list.filter.passes(event)).collect();
    let at = list.cursor.unwrap_or(u64::MAX);
    let cursor = shown.partition_point(|(number, _)| *number <= at).saturating_sub(1);
    draw_head(list, &shown, cursor, head, sheet);
    if shown.is_empty() {
        let nothing = if list.log.total() == 0 { "nothing has happened yet" } else { "nothing of this kind" };
        sheet.put(split_left(rows, 1).1, nothing, sheet.palette.faint());
        return;
    }
    let height = usize::from(rows.height);
    let first = cursor.saturating_sub(height / 2).min(shown.len().saturating_sub(height));
    let mut rest = rows;
    for (place, (_, event)) in shown.iter().enumerate().skip(first).take(height) {
        let (row, below) = split_top(rest, 1);
        draw_event(event, (place == cursor, event.time > snapshot.t), row, sheet);
        rest = below;
    }
}

/// Draws an event in a row: when, which bodies, what, v_n before and after, impulse. What is still to come from the frame
/// shown recedes.
fn draw_event(event: &Logged, (chosen, to_come): (bool, bool), row: Rect, sheet: &mut Sheet) {
    let (palette, glyphs) = (sheet.palette, sheet.glyphs);
    let bodies = match event.kind {
        Kind::Wall => format!("#{}{}wall {}", event.a, glyphs.with, event.b),
        Kind::Pair => format!("#{}{}#{}", event.a, glyphs.with, event.b),
    };
    let (word, color) = match event.class {
        Class::Collide => ("collides", palette.alarm()),
        Class::Rest => ("rests", palette.notice()),
        Class::Leave => ("leaves", palette.plain()),
        Class::Release => ("released", palette.plain()),
    };
    let base = match (chosen, to_come) {
        (true, _) => palette.reverse(),
        (false, true) => palette.faint(),
        (false, false) => palette.plain(),
    };
    if chosen {
        sheet.put(row, &" ".repeat(row.width.into()), base);
    }
    let pointer = if chosen { glyphs.pointer } else { " " };
    let time = format!("{pointer} {} s  ", format::decimal(event.time, TIME, 6));
    // −v_n is how it is kept; v_n is how the card tells it
    let (before, after) = (0.0 - event.approach_speed, event.separation_speed);
    let speeds = format!("{} {} {} m/s", format::decimal(before, 8, 3), glyphs.arrow, format::decimal(after, 7, 3));
    let impulse = format!("  J {} N s", format::decimal(event.impulse, 9, 4));
    let style = |own: Style| own.patch(base);
    let pieces = [
        (time.as_str(), base),
        (&*format!("{bodies:<BODIES$}"), style(palette.strong())),
        (&*format!("{word:<CLASS$}"), style(color)),
        (&*format!("{speeds:<SPEEDS$}"), base),
        (&*impulse, base),
    ];
    // whole columns, or none of them: half a number is a wrong one
    let mut room = usize::from(row.width);
    let fitting = pieces.iter().take_while(|(text, _)| {
        let fits = sheet::width(text) <= room;
        room = room.saturating_sub(sheet::width(text));
        fits
    });
    let fitting = fitting.count().max(1);
    sheet.put_all(row, &pieces[..fitting]);
}

/// Draws what was typed, or how to type; how many events there are, and how many are not kept.
fn draw_head(list: &EventsView, shown: &[(u64, &Logged)], cursor: usize, head: Rect, sheet: &mut Sheet) {
    let palette = sheet.palette;
    let mut used = sheet.put_all(head, &[(BEFORE, palette.heading()), (list.typed, palette.strong())]);
    used += sheet.put(split_left(head, used).1, " ", palette.reverse());
    let (_, rest) = split_left(head, used + 1);
    let (rest, _) = split_right(rest, 1);
    if let Some(wrong) = list.wrong {
        sheet.put(rest, wrong, palette.alarm());
        return;
    }
    let hint = if list.typed.is_empty() { "type 3, 3 5, wall 0, rest to narrow   " } else { "" };
    let place = (cursor + 1).min(shown.len());
    let count = format!("{} of {}", format::thousands(place as u64), format::thousands(shown.len() as u64));
    let gone = match list.log.dropped() {
        0 => String::new(),
        dropped => format!(", the first {} are not kept", format::thousands(dropped)),
    };
    for remark in [format!("{hint}{count}{gone}"), format!("{count}{gone}"), count] {
        if sheet::width(&remark) <= rest.width.into() {
            return sheet.put_right(rest, &remark, palette.faint());
        }
    }
}

/// Where the terminal's cursor belongs.
pub(super) fn cursor(typed: &str, body: Rect) -> Option<Position> {
    let column = BEFORE.len() + sheet::width(typed);
    (!body.is_empty() && column < body.width.into()).then(|| Position::new(body.x + column as u16, body.y))
}
