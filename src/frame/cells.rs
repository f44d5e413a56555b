//! Cells as a terminal can show them: one printable glyph, one or two columns wide.

use ratatui::{
    buffer::{Buffer, Cell, CellWidth},
    style::Modifier,
};

use super::sgr::Pen;
use crate::printable::is_printable;

/// What one cell shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Glyph<'a> {
    /// Printable text that takes `width` columns.
    pub(super) text: &'a str,
    /// Width, columns: 1 or 2, or 0 for the right half of the wide glyph before.
    pub(super) width: u16,
    /// Colours and attributes.
    pub(super) pen: Pen,
}

/// A blank in the default style: what a cleared screen shows.
pub(super) const BLANK: Glyph = Glyph { text: " ", width: 1, pen: Pen::DEFAULT };

/// Attributes that show on a blank.
const SHOWN_ON_BLANKS: Modifier = Modifier::REVERSED.union(Modifier::UNDERLINED).union(Modifier::CROSSED_OUT);

impl Glyph<'_> {
    /// Whether nothing but its background shows, so that the foreground's colour does not matter.
    pub(super) fn is_blank(&self) -> bool {
        self.text == " " && !self.pen.modifier.intersects(SHOWN_ON_BLANKS)
    }

    /// Whether the glyph looks right if it is written with that pen.
    pub(super) fn suits(&self, pen: &Pen) -> bool {
        self.pen == *pen || self.is_blank() && pen.bg == self.pen.bg && !pen.modifier.intersects(SHOWN_ON_BLANKS)
    }

    /// Whether a terminal that shows `other` shows this glyph too.
    pub(super) fn looks_like(&self, other: &Glyph) -> bool {
        self.text == other.text && self.width == other.width && (self.suits(&other.pen) || other.suits(&self.pen))
    }

    /// Whether every terminal agrees on the glyph's width: one character, not a cluster of several.
    pub(super) fn is_simple(&self) -> bool {
        self.text.chars().nth(1).is_none()
    }
}

/// The glyphs of row `y` (from 0 at the top of the buffer), one per column.
pub(super) fn row(buffer: &Buffer, y: u16) -> impl Iterator<Item = Glyph<'_>> {
    let columns = usize::from(buffer.area().width);
    let cells = buffer.content().get(usize::from(y) * columns..).unwrap_or(&[]);
    let mut hidden = false;
    cells.iter().take(columns).enumerate().map(move |(x, cell)| {
        let glyph = if hidden { Glyph { text: "", width: 0, pen: Pen::of(cell) } } else { glyph(cell, columns - x) };
        hidden = glyph.width == 2;
        glyph
    })
}

/// What a cell shows with so many columns left in its row: a blank for anything that is not printable or does not fit.
fn glyph(cell: &Cell, columns: usize) -> Glyph<'_> {
    let (text, pen) = (cell.symbol(), Pen::of(cell));
    if !text.chars().all(is_printable) {
        return Glyph { text: " ", width: 1, pen };
    }
    match text.cell_width() {
        width @ 1..=2 if usize::from(width) <= columns => Glyph { text, width, pen },
        _ => Glyph { text: " ", width: 1, pen },
    }
}
