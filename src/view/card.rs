//! One contact taken apart: the frame's contacts with a cursor, the card of the one under it, the search that led there.

use ratatui::{layout::Rect, style::Style};

use super::{
    column::Column,
    layout::split_left,
    probes,
    screen::{CardView, Screen},
    sheet::{self, Sheet},
};
use crate::explain::{self, Card, Line};
use crate::format;
use crate::snapshot::{Class, Contact, Kind, Snapshot};

/// Rows of the list of contacts, at most.
const LIST: usize = 5;

/// Columns for a contact's class.
const CLASS: usize = 9;
/// Columns for a contact's degree.
const DEGREE: usize = 8;

/// Columns for the bodies of a contact, at least.
const BODIES: usize = 10;

/// Columns for what a line is about.
const LABEL: usize = 8;

/// A row: pieces of text.
type Row = Vec<(String, Style)>;

/// The contacts of a frame in the order in which they are gone through: the selected sphere's first.
pub fn order(snapshot: &Snapshot, selected: Option<usize>) -> Vec<usize> {
    let of_selected = |contact: &Contact| {
        let other = (contact.kind == Kind::Pair).then_some(contact.b);
        selected.is_some_and(|i| contact.a == i || other == Some(i))
    };
    let mut order: Vec<usize> = (0..snapshot.contacts.len()).collect();
    order.sort_by_key(|&index| !of_selected(&snapshot.contacts[index]));
    order
}

/// The index of the contact under the cursor, if the frame has any.
pub(super) fn chosen(screen: &Screen, card: CardView) -> Option<usize> {
    let order = order(screen.snapshot, screen.view_settings.selected);
    order.get(card.cursor.min(order.len().saturating_sub(1))).copied()
}

/// Draws the card in the inspector's place.
pub(super) fn draw(screen: &Screen, card: CardView, area: Rect, sheet: &mut Sheet) {
    let (_, area) = split_left(area, 1);
    let mut column = Column::new(Rect { width: area.width.saturating_sub(1), ..area }, sheet);
    let contacts = &screen.snapshot.contacts;
    let Some(chosen) = chosen(screen, card) else {
        column.heading("contact", "none in this frame");
        let faint = column.sheet().palette.faint();
        column.row("Esc closes", faint);
        let acting = explain::acting(screen.snapshot, column.sheet().glyphs.with);
        return draw_rows(&lines(&acting, &column), &mut column);
    };
    let order = order(screen.snapshot, screen.view_settings.selected);
    let cursor = order.iter().position(|&index| index == chosen).unwrap_or(0);
    let glyphs = column.sheet().glyphs;
    let remark = remark(cursor + 1, contacts.len(), glyphs.more, column.width().saturating_sub("contact  ".len()));
    column.heading("contact", &remark);
    draw_list(screen, &order, cursor, &mut column);
    let Some(text) = explain::card(screen.snapshot, chosen, glyphs.with) else { return };
    let search = probes::Search::new(screen.snapshot, card.probe);
    // Going through the search one looks at that: it takes the card's place.
    let mut rows = rows(&text, &column);
    rows.extend(lines(&explain::acting(screen.snapshot, glyphs.with), &column));
    let rows = if card.probe.is_some() { &rows[..1] } else { &rows[..] };
    let hidden = rows.len().saturating_sub(column.rows());
    let from = card.scroll.min(hidden);
    draw_rows(&rows[from..], &mut column);
    column.skip();
    probes::draw(&search, &mut column);
}

/// Which contact it is of how many, and as much of the keys as fits into so many columns: a hint that is cut tells nothing.
fn remark(number: usize, count: usize, [up, down]: [&str; 2], room: usize) -> String {
    let place = format!("{number} of {count}");
    let hints =
        [format!("  {up}{down} choose  Esc closes"), format!("  {up}{down}  Esc closes"), "  Esc closes".into()];
    let hint = hints.iter().find(|hint| sheet::width(&place) + sheet::width(hint) <= room);
    hint.map_or_else(|| place.clone(), |hint| format!("{place}{hint}"))
}

/// Draws the contacts around the cursor, a row each; nothing if there is only one.
fn draw_list(screen: &Screen, order: &[usize], cursor: usize, column: &mut Column) {
    if order.len() < 2 {
        return;
    }
    let rows = LIST.min(order.len());
    let from = cursor.saturating_sub(rows / 2).min(order.len() - rows);
    for (place, &index) in order.iter().enumerate().skip(from).take(rows) {
        let contact = &screen.snapshot.contacts[index];
        let (palette, glyphs) = (column.sheet().palette, column.sheet().glyphs);
        let pointer = if place == cursor { glyphs.pointer } else { " " };
        let bodies = match contact.kind {
            Kind::Wall => format!("#{}{}wall {}", contact.a, glyphs.with, contact.b),
            Kind::Pair => format!("#{}{}#{}", contact.a, glyphs.with, contact.b),
        };
        let (word, style) = class(contact.class, column);
        let strong = if place == cursor { palette.strong() } else { palette.plain() };
        let room = column.width().saturating_sub(2 + CLASS + DEGREE).max(BODIES);
        let degree = column.width().saturating_sub(2 + room + CLASS).min(DEGREE);
        column.pieces(&[
            (&format!("{pointer} {bodies:<room$}"), strong),
            (&format!("{word:<CLASS$}"), style),
            (&format::scientific(contact.degree, degree), palette.faint()),
        ]);
    }
    column.skip();
}

/// The word and colour of a class.
fn class(class: Class, column: &Column) -> (&'static str, Style) {
    let palette = column.sheet().palette;
    match class {
        Class::Collide => ("collides", palette.alarm()),
        Class::Rest => ("rests", palette.notice()),
        Class::Leave => ("leaves", palette.plain()),
        Class::Release => ("released", palette.plain()),
    }
}

/// The card as rows: bodies and class, then each line with its label, wrapped beside it.
fn rows(card: &Card, column: &Column) -> Vec<Row> {
    let palette = column.sheet().palette;
    let (word, style) = class(card.class, column);
    let mut rows = vec![vec![(format!("{}  ", card.bodies), palette.strong()), (word.to_owned(), style)]];
    rows.extend(lines(&card.lines, column));
    rows
}

/// Lines with their labels, wrapped beside them.
fn lines(lines: &[Line], column: &Column) -> Vec<Row> {
    let palette = column.sheet().palette;
    let room = column.width().saturating_sub(LABEL).max(1);
    let mut rows = Vec::new();
    for line in lines {
        for (index, text) in sheet::wrap(&line.text, room as u16).into_iter().enumerate() {
            let label = if index == 0 { line.label } else { "" };
            rows.push(vec![(format!("{label:<LABEL$}"), palette.faint()), (text, palette.plain())]);
        }
    }
    rows
}

fn draw_rows(rows: &[Row], column: &mut Column) {
    for row in rows {
        let pieces: Vec<(&str, Style)> = row.iter().map(|(text, style)| (text.as_str(), *style)).collect();
        column.pieces(&pieces);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hint_is_shown_whole_or_not_at_all() {
        for (number, count) in [(1, 1), (10, 12), (100, 666), (12_345, 100_000)] {
            for room in 0..60 {
                let remark = remark(number, count, ["↑", "↓"], room);
                let hint = remark.strip_prefix(&format!("{number} of {count}")).expect("the place always comes first");
                assert!(
                    hint.is_empty() || hint.ends_with("Esc closes") && sheet::width(&remark) <= room,
                    "{room}: {remark}"
                );
            }
        }
        // 29 columns are left beside the heading at 80 columns
        assert_eq!(remark(1, 9, ["↑", "↓"], 29), "1 of 9  ↑↓ choose  Esc closes");
        assert_eq!(remark(100, 666, ["↑", "↓"], 29), "100 of 666  ↑↓  Esc closes");
    }
}
