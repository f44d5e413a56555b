//! A column of the inspector, written row by row.

use ratatui::{layout::Rect, style::Style};

use super::{layout::split_top, sheet::Sheet};

/// A column written from the top down; what does not fit is left out.
pub(super) struct Column<'a, 'b> {
    rest: Rect,
    sheet: &'a mut Sheet<'b>,
}

impl<'a, 'b> Column<'a, 'b> {
    /// A column that fills `area`.
    pub(super) fn new(area: Rect, sheet: &'a mut Sheet<'b>) -> Column<'a, 'b> {
        Column { rest: area, sheet }
    }

    /// Width of the column, cells.
    pub(super) fn width(&self) -> usize {
        self.rest.width.into()
    }

    /// Rows that are left.
    pub(super) fn rows(&self) -> usize {
        self.rest.height.into()
    }

    /// The sheet's styles and signs.
    pub(super) fn sheet(&self) -> &Sheet<'_> {
        self.sheet
    }

    /// The sheet, to be drawn on where [`Column::take`] says.
    pub(super) fn sheet_mut(&mut self) -> &mut Sheet<'b> {
        self.sheet
    }

    /// The next `rows` rows, or as many as are left, for the caller to fill.
    pub(super) fn take(&mut self, rows: u16) -> Rect {
        let (taken, rest) = split_top(self.rest, rows);
        self.rest = rest;
        taken
    }

    /// Writes a row in one style.
    pub(super) fn row(&mut self, text: &str, style: Style) {
        self.pieces(&[(text, style)]);
    }

    /// Writes a row of pieces.
    pub(super) fn pieces(&mut self, pieces: &[(&str, Style)]) {
        let (row, rest) = split_top(self.rest, 1);
        self.sheet.put_all(row, pieces);
        self.rest = rest;
    }

    /// Leaves a row empty.
    pub(super) fn skip(&mut self) {
        self.rest = split_top(self.rest, 1).1;
    }

    /// Writes a heading with a faint remark.
    pub(super) fn heading(&mut self, text: &str, remark: &str) {
        let palette = self.sheet.palette;
        self.pieces(&[(text, palette.heading()), ("  ", palette.plain()), (remark, palette.faint())]);
    }

    /// Writes a name, a value right-aligned below the one above, and a unit.
    pub(super) fn entry(&mut self, name: &str, value: &str, unit: &str) {
        let palette = self.sheet.palette;
        let head = format!("{name:<9}");
        let value = format!("{value:>10}");
        self.pieces(&[
            (&head, palette.faint()),
            (&value, palette.plain()),
            (" ", palette.plain()),
            (unit, palette.faint()),
        ]);
    }
}
