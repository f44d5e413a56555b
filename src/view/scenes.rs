//! The scene list with its filter.

use ratatui::layout::{Position, Rect};

use super::{
    layout::{split_left, split_top},
    sheet::{self, Sheet},
};

/// The list's contents.
pub(super) struct List<'a> {
    /// What was typed after `/`.
    pub(super) filter: &'a str,
    /// Whether the filter is being typed.
    pub(super) filtering: bool,
    /// Name and `about` of the scenes that pass the filter.
    pub(super) entries: &'a [(&'a str, &'a str)],
    /// Index of the scene under the cursor.
    pub(super) cursor: usize,
}

/// The text before the filter's.
const BEFORE_FILTER: &str = " scenes  /";

/// Draws heading, filter and as many entries as fit, the one under the cursor among them.
pub(super) fn draw(list: &List, body: Rect, sheet: &mut Sheet) {
    let (head, rows) = split_top(body, u16::from(body.height > 1));
    draw_head(list, head, sheet);
    if list.entries.is_empty() {
        sheet.put(split_left(rows, 1).1, "no scene matches; Esc clears the filter", sheet.palette.faint());
        return;
    }
    let height = usize::from(rows.height);
    let cursor = list.cursor.min(list.entries.len() - 1);
    // The cursor stays in the middle, except near the ends of the list.
    let first = cursor.saturating_sub(height / 2).min(list.entries.len().saturating_sub(height));
    let names = list.entries.iter().map(|(name, _)| sheet::width(name)).max().unwrap_or(0);
    let names = names.min(usize::from(rows.width) / 2) as u16;
    let mut rest = rows;
    for (i, (name, about)) in list.entries.iter().enumerate().skip(first).take(height) {
        let (row, below) = split_top(rest, 1);
        draw_entry((name, about), i == cursor, names, row, sheet);
        rest = below;
    }
}

fn draw_entry(entry: (&str, &str), chosen: bool, names: u16, row: Rect, sheet: &mut Sheet) {
    let palette = sheet.palette;
    let (name_style, about_style) = if chosen {
        sheet.put(row, &" ".repeat(row.width.into()), palette.reverse());
        sheet.put(row, sheet.glyphs.pointer, palette.reverse());
        (palette.reverse().patch(palette.strong()), palette.reverse())
    } else {
        (palette.strong(), palette.faint())
    };
    let (_, row) = split_left(row, 2);
    let (name, rest) = split_left(row, names);
    sheet.put(name, entry.0, name_style);
    let (_, about) = split_left(rest, 2);
    sheet.put(split_left(about, about.width.saturating_sub(1)).0, entry.1, about_style);
}

fn draw_head(list: &List, head: Rect, sheet: &mut Sheet) {
    let palette = sheet.palette;
    let (before, slash) = BEFORE_FILTER.split_at(BEFORE_FILTER.len() - 1);
    let shown = list.filtering || !list.filter.is_empty();
    let slash = if shown { slash } else { "" };
    let mut used =
        sheet.put_all(head, &[(before, palette.heading()), (slash, palette.strong()), (list.filter, palette.plain())]);
    if list.filtering {
        used += sheet.put(split_left(head, used).1, " ", palette.reverse());
    }
    let count = match list.entries.len() {
        1 => "1 scene".into(),
        n => format!("{n} scenes"),
    };
    let remark = if shown { count } else { format!("{count}   / filters") };
    let (_, rest) = split_left(head, used + 2);
    let rest = Rect { width: rest.width.saturating_sub(1), ..rest };
    if sheet::width(&remark) <= rest.width.into() {
        sheet.put_right(rest, &remark, palette.faint());
    }
}

/// Where the terminal's cursor belongs while the filter is typed.
pub(super) fn cursor(filter: &str, body: Rect) -> Option<Position> {
    let column = BEFORE_FILTER.len() + sheet::width(filter);
    (!body.is_empty() && column < body.width.into()).then(|| Position::new(body.x + column as u16, body.y))
}
