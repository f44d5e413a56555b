//! The key table, in as many columns as fit.

use ratatui::layout::Rect;

use super::{
    glyphs::{Glyphs, glyphs},
    layout::{split_left, split_top},
    legend,
    screen::Marker,
    sheet::{self, Sheet},
};

/// Columns that a column of the table needs at least.
const LEAST: u16 = 36;

/// Columns for keys, from and to; longer ones go on in the next row, as do descriptions.
const KEYS: std::ops::RangeInclusive<u16> = 6..=18;

/// A row of the table: a piece of the keys, a piece of what they do.
type Row = (String, String);

/// The table as laid out for its place.
struct Table {
    columns: Vec<Vec<Row>>,
    /// Columns for the keys within each column of the table.
    keys: u16,
}

/// Draws the table in the body, scrolled down by so many rows: the keys, then the signs.
pub(super) fn draw(keys: &[(&str, &str)], scroll: usize, body: Rect, sheet: &mut Sheet) {
    let (head, place) = split(body);
    if place.is_empty() {
        return;
    }
    let table = Table::of(keys, sheet.glyphs, place);
    let width = place.width / table.columns.len() as u16;
    let height = usize::from(place.height);
    let limit = table.rows().saturating_sub(height);
    let scroll = scroll.min(limit);
    draw_head(scroll, limit - scroll, head, sheet);
    for (i, column) in table.columns.iter().enumerate() {
        let mut rest = split_left(split_left(place, i as u16 * width).1, width).0;
        for row in column.iter().skip(scroll).take(height) {
            let (line, below) = split_top(rest, 1);
            draw_row(row, table.keys, line, sheet);
            rest = below;
        }
    }
}

/// How many rows the table in the body can be scrolled down.
pub(super) fn scroll_limit(keys: &[(&str, &str)], marker: Marker, body: Rect) -> usize {
    let (_, place) = split(body);
    if place.is_empty() {
        return 0;
    }
    Table::of(keys, glyphs(marker), place).rows().saturating_sub(place.height.into())
}

/// The places of the heading and of the table.
fn split(body: Rect) -> (Rect, Rect) {
    split_top(body, u16::from(body.height > 2))
}

impl Table {
    /// The table of keys, and of the signs that go with a marker.
    fn of(keys: &[(&str, &str)], glyphs: &Glyphs, place: Rect) -> Table {
        let signs = legend::signs(glyphs);
        let signs = signs.iter().map(|(sign, means)| (sign.as_str(), *means));
        let entries: Vec<(&str, &str)> = keys.iter().copied().chain(signs).collect();
        Table::new(&entries, place)
    }

    /// The table in as few columns as show everything at once, and never in more than fit side by side.
    fn new(entries: &[(&str, &str)], place: Rect) -> Table {
        let most = (place.width / LEAST).max(1);
        let fits = |table: &Table| table.rows() <= place.height.into();
        let table = |count| Table::shortest(entries, count, place);
        (1..most).map(table).find(fits).unwrap_or_else(|| table(most))
    }

    /// The table of so many columns, its room shared between keys and descriptions so that it has the fewest rows.
    fn shortest(entries: &[(&str, &str)], count: u16, place: Rect) -> Table {
        let widest = entries.iter().map(|(keys, _)| sheet::width(keys)).max().unwrap_or(0);
        let longest = widest.clamp((*KEYS.start()).into(), (*KEYS.end()).into()) as u16;
        let shared = |keys| Table { columns: fill(entries, keys, count, place), keys };
        // The widest first, which wins a tie: keys that stay whole are easier to read.
        let all = (*KEYS.start()..=longest).rev().map(shared);
        all.min_by_key(Table::rows).unwrap_or_else(|| shared(longest))
    }

    fn rows(&self) -> usize {
        self.columns.iter().map(Vec::len).max().unwrap_or(0)
    }
}

/// The entries over `count` columns of about the same height; each stays whole.
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
    let used = sheet
        .put_all(head, &[(" ", palette.plain()), ("keys and signs", palette.heading()), (&remark, palette.faint())]);
    let (_, rest) = split_left(head, used);
    if rest.width > 12 {
        sheet.put_right(split_left(rest, rest.width - 1).0, "Esc closes", palette.faint());
    }
}
