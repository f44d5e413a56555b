//! The key table, in as many columns as fit.

use ratatui::layout::Rect;

use super::{
    layout::{split_left, split_top},
    sheet::{self, Sheet},
};

/// Columns that a column of the table needs at least.
const LEAST: u16 = 36;

/// Columns for keys at most; longer ones go on in the next row, as do descriptions.
const KEYS: usize = 11;

/// A row of the table: a piece of the keys, a piece of what they do.
type Row = (String, String);

/// Draws the table in the body, scrolled down by so many rows.
pub(super) fn draw(entries: &[(&str, &str)], scroll: usize, body: Rect, sheet: &mut Sheet) {
    let (head, table) = split(body);
    if table.is_empty() {
        return;
    }
    let keys = keys_width(entries);
    let columns = columns(entries, keys, table);
    let width = table.width / columns.len() as u16;
    let height = usize::from(table.height);
    let limit = hidden(&columns, table);
    let scroll = scroll.min(limit);
    draw_head(scroll, limit - scroll, head, sheet);
    for (i, column) in columns.iter().enumerate() {
        let mut rest = split_left(split_left(table, i as u16 * width).1, width).0;
        for row in column.iter().skip(scroll).take(height) {
            let (line, below) = split_top(rest, 1);
            draw_row(row, keys, line, sheet);
            rest = below;
        }
    }
}

/// How many rows the table in the body can be scrolled down.
pub(super) fn scroll_limit(entries: &[(&str, &str)], body: Rect) -> usize {
    let (_, table) = split(body);
    if table.is_empty() { 0 } else { hidden(&columns(entries, keys_width(entries), table), table) }
}

/// (heading, table).
fn split(body: Rect) -> (Rect, Rect) {
    split_top(body, u16::from(body.height > 2))
}

fn keys_width(entries: &[(&str, &str)]) -> u16 {
    entries.iter().map(|(keys, _)| sheet::width(keys)).max().unwrap_or(0).min(KEYS) as u16
}

/// Rows that do not fit.
fn hidden(columns: &[Vec<Row>], table: Rect) -> usize {
    columns.iter().map(Vec::len).max().unwrap_or(0).saturating_sub(table.height.into())
}

/// As few columns as show everything at once, and never more than fit side by side; entries stay whole.
fn columns(entries: &[(&str, &str)], keys: u16, table: Rect) -> Vec<Vec<Row>> {
    let most = (table.width / LEAST).max(1);
    let split = |count: u16| fill(entries, keys, count, table);
    let fits = |columns: &Vec<Vec<Row>>| columns.iter().all(|column| column.len() <= table.height.into());
    (1..most).map(split).find(fits).unwrap_or_else(|| split(most))
}

/// The entries over `count` columns of about the same height.
fn fill(entries: &[(&str, &str)], keys: u16, count: u16, table: Rect) -> Vec<Vec<Row>> {
    let does = (table.width / count).saturating_sub(keys + 4);
    let blocks: Vec<Vec<Row>> = entries.iter().map(|entry| block(entry, keys, does)).collect();
    let share = blocks.iter().map(Vec::len).sum::<usize>().div_ceil(count.into());
    let mut columns = vec![Vec::new()];
    for block in blocks {
        let last = columns.len() - 1;
        if !columns[last].is_empty() && columns[last].len() + block.len() > share && columns.len() < count.into() {
            columns.push(block);
        } else {
            columns[last].extend(block);
        }
    }
    columns
}

/// The rows of one entry, its keys and description wrapped side by side.
fn block(entry: &(&str, &str), keys: u16, does: u16) -> Vec<Row> {
    let (keys, does) = (sheet::wrap(entry.0, keys), sheet::wrap(entry.1, does));
    let row = |i: usize| (keys.get(i).cloned().unwrap_or_default(), does.get(i).cloned().unwrap_or_default());
    (0..keys.len().max(does.len())).map(row).collect()
}

fn draw_row(row: &Row, keys: u16, line: Rect, sheet: &mut Sheet) {
    let (_, line) = split_left(line, 1);
    sheet.put(split_left(line, keys).0, &row.0, sheet.palette.strong());
    let (_, does) = split_left(line, keys + 2);
    sheet.put(split_left(does, does.width.saturating_sub(1)).0, &row.1, sheet.palette.plain());
}

fn draw_head(above: usize, below: usize, head: Rect, sheet: &mut Sheet) {
    let palette = sheet.palette;
    let mut remark = String::from("   ");
    if above > 0 {
        remark += &format!("{} {above} above  ", sheet.glyphs.more[0]);
    }
    if below > 0 {
        remark += &format!("{} {below} below  ", sheet.glyphs.more[1]);
    }
    let used = sheet.put_all(head, &[(" ", palette.plain()), ("keys", palette.heading()), (&remark, palette.faint())]);
    let (_, rest) = split_left(head, used);
    if rest.width > 12 {
        sheet.put_right(split_left(rest, rest.width - 1).0, "Esc closes", palette.faint());
    }
}
