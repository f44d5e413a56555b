//! The last row: the `:` line while it is typed, else news, else key hints.

use ratatui::layout::{Position, Rect};

use super::{
    layout::{split_bottom, split_left, split_top},
    screen::{Popup, Screen},
    sheet::{self, Sheet},
};

/// Draws the last row of `area`, and as many over it as a long message needs.
pub(super) fn draw_last_row(screen: &Screen, area: Rect, sheet: &mut Sheet) {
    let (_, last) = split_bottom(area, 1);
    if let Popup::Prompt { text, cursor, offers } = screen.popup {
        draw_prompt(text, cursor, offers, last, sheet);
    } else if let Some(message) = screen.message {
        draw_message(message, area, sheet);
    } else {
        draw_hints(screen.hints, last, sheet);
    }
}

/// Draws news in the last row of `area` and as many over it as it needs; the first row of `area` stays, since it says what
/// runs.
fn draw_message(message: &str, area: Rect, sheet: &mut Sheet) {
    let lines = sheet::wrap(message, area.width.saturating_sub(2));
    let rows = (lines.len() as u16).clamp(1, area.height.saturating_sub(1).max(1));
    let (_, mut rest) = split_bottom(area, rows);
    sheet.clear(rest);
    for line in lines {
        let (row, below) = split_top(rest, 1);
        sheet.put(split_left(row, 1).1, &line, sheet.palette.notice().patch(sheet.palette.strong()));
        rest = below;
    }
}

/// Draws the `:` line. The cursor stays visible, however long the text is; what a word may go on as stands behind it, where
/// there is room.
fn draw_prompt(text: &str, cursor: usize, offers: &str, area: Rect, sheet: &mut Sheet) {
    let used = sheet.put(area, ":", sheet.palette.strong());
    let (_, rest) = split_left(area, used);
    let (before, after) = split(text, cursor);
    let before = tail(before, rest.width.saturating_sub(1).into());
    let under = after.chars().next();
    let behind = &after[under.map_or(0, char::len_utf8)..];
    let under = under.map_or(" ".into(), String::from);
    let (plain, faint) = (sheet.palette.plain(), sheet.palette.faint());
    let pieces = [(before, plain), (&under, sheet.palette.reverse()), (behind, plain), ("  ", plain), (offers, faint)];
    sheet.put_all(rest, &pieces);
}

/// The text before the cursor, and the text from there on.
fn split(text: &str, cursor: usize) -> (&str, &str) {
    text.split_at_checked(cursor).unwrap_or((text, ""))
}

/// The end of a text, as much as fits `columns`.
fn tail(text: &str, columns: usize) -> &str {
    let starts = text.char_indices().map(|(i, _)| &text[i..]);
    starts.chain([""]).find(|tail| sheet::width(tail) <= columns).unwrap_or("")
}

/// Where the terminal's cursor belongs while the prompt is typed.
pub(super) fn cursor(text: &str, cursor: usize, area: Rect) -> Option<Position> {
    let before = tail(split(text, cursor).0, usize::from(area.width).saturating_sub(2));
    let column = 1 + sheet::width(before);
    (column < area.width.into()).then(|| Position::new(area.x + column as u16, area.y))
}

/// Draws as many hints as fit whole.
fn draw_hints(hints: &[(&str, &str)], area: Rect, sheet: &mut Sheet) {
    let (_, mut rest) = split_left(area, 1);
    for (keys, does) in hints {
        if sheet::width(keys) + 1 + sheet::width(does) > rest.width.into() {
            return;
        }
        let pieces = [(*keys, sheet.palette.strong()), (" ", sheet.palette.plain()), (*does, sheet.palette.faint())];
        let used = sheet.put_all(rest, &pieces);
        rest = split_left(rest, used + 2).1;
    }
}
