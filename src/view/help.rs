//! The key table, in as many columns as fit.

use ratatui::layout::Rect;

use super::{
    layout::{split_left, split_top},
    sheet::{self, Sheet},
};

/// Columns between keys and what they do, and around a column of the table.
const GAP: usize = 2;

/// Columns that a description needs at least for a further column of the table.
const LEAST: usize = 22;

/// Draws the table in the body, scrolled down by so many rows.
pub(super) fn draw(rows: &[(&str, &str)], scroll: usize, body: Rect, sheet: &mut Sheet) {
    let (head, table) = split_top(body, u16::from(body.height > 2));
    let height = usize::from(table.height);
    if height == 0 || rows.is_empty() {
        return;
    }
    let keys = rows.iter().map(|(keys, _)| sheet::width(keys)).max().unwrap_or(0);
    let columns = columns(rows, keys, table);
    let lines = rows.len().div_ceil(columns);
    let scroll = scroll.min(lines.saturating_sub(height));
    draw_head(lines, scroll, height, head, sheet);
    let width = usize::from(table.width) / columns;
    for column in 0..columns {
        let entries = rows.iter().skip(column * lines).take(lines).skip(scroll).take(height);
        let (_, mut place) = split_left(table, (column * width) as u16);
        place.width = width as u16;
        for (keys_text, does) in entries {
            let (_, inner) = split_left(place, 1);
            let gap = keys - sheet::width(keys_text);
            let used = sheet.put(inner, keys_text, sheet.palette.strong()) + (gap + GAP) as u16;
            let text = split_left(inner, used).1;
            sheet.put(split_left(text, text.width.saturating_sub(1)).0, does, sheet.palette.plain());
            place = split_top(place, 1).1;
            place.height = 1;
        }
    }
}

/// As few columns as show everything, and never more than fit.
fn columns(rows: &[(&str, &str)], keys: usize, table: Rect) -> usize {
    let does = rows.iter().map(|(_, does)| sheet::width(does)).max().unwrap_or(0);
    let width = usize::from(table.width);
    let fit = (width / (keys + GAP + 2 + does.clamp(1, LEAST))).max(1);
    let needed = rows.len().div_ceil(usize::from(table.height));
    needed.clamp(1, fit)
}

fn draw_head(lines: usize, scroll: usize, height: usize, head: Rect, sheet: &mut Sheet) {
    let palette = sheet.palette;
    let below = lines.saturating_sub(scroll + height);
    let mut remark = String::new();
    if scroll > 0 {
        remark += &format!("{} {scroll} above  ", sheet.glyphs.more[0]);
    }
    if below > 0 {
        remark += &format!("{} {below} below  ", sheet.glyphs.more[1]);
    }
    sheet.put_all(
        head,
        &[(" ", palette.plain()), ("keys", palette.heading()), ("   ", palette.plain()), (&remark, palette.faint())],
    );
    if !head.is_empty() {
        sheet.put_right(split_left(head, head.width - 1).0, "Esc closes", palette.faint());
    }
}
