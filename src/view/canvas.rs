//! A grid of dots, 2×4 a cell, that remembers for each cell which layer gives its colour.
//!
//! A cell has one colour: the highest layer drawn into it decides, and within a layer the last, so the same snapshot
//! always gives the same cells.

use ratatui::{
    layout::Rect,
    style::{Color, Modifier, Style},
};

use super::{
    glyphs,
    projection::{ACROSS, DOWN},
    sheet::Sheet,
};

/// Which layer gives a cell its colour: the highest that is in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(super) enum Layer {
    /// Nothing drawn.
    #[default]
    Empty,
    /// Walls.
    Wall,
    /// Spheres of the exact run.
    Ghost,
    /// Arrows of velocities and normals.
    Arrow,
    /// Spheres in free flight.
    Sphere,
    /// Spheres in contact.
    Contact,
    /// The selected sphere.
    Selected,
}

impl Layer {
    /// Whether the layer is of the run's own spheres, which hide each other.
    fn is_body(self) -> bool {
        matches!(self, Layer::Sphere | Layer::Contact | Layer::Selected)
    }
}

/// Colour, attributes and layer of what is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Stroke {
    /// The layer that is drawn on.
    pub(super) layer: Layer,
    color: Color,
    modifier: Modifier,
}

impl Stroke {
    /// The stroke of a style (foreground colour and added attributes) on a layer.
    pub(super) fn new(layer: Layer, style: Style) -> Stroke {
        Stroke { layer, color: style.fg.unwrap_or_default(), modifier: style.add_modifier }
    }
}

#[derive(Debug, Clone, Copy, Default)]
struct Cell {
    /// Dots of what no sphere hides: walls, arrows.
    mask: u8,
    stroke: Stroke,
    /// Dots of spheres, of which a nearer one hides those behind it.
    bodies: u8,
    body_stroke: Stroke,
    /// A character in place of the dots.
    sign: Option<char>,
    sign_stroke: Stroke,
}

impl Cell {
    /// The stroke of what is seen: a sign's, else that of the higher layer among the dots.
    fn seen(&self) -> Stroke {
        if self.sign.is_some() {
            return self.sign_stroke;
        }
        let bodies = if self.bodies == 0 { Stroke::default() } else { self.body_stroke };
        if bodies.layer >= self.stroke.layer { bodies } else { self.stroke }
    }
}

/// The dots of one view.
#[derive(Debug, Clone)]
pub(super) struct Canvas {
    columns: usize,
    cells: Vec<Cell>,
    width: i32,
    height: i32,
}

impl Canvas {
    /// An empty canvas for so many cells.
    pub(super) fn new(area: Rect) -> Canvas {
        let (columns, rows) = (usize::from(area.width), usize::from(area.height));
        let (width, height) = (i32::from(area.width) * i32::from(ACROSS), i32::from(area.height) * i32::from(DOWN));
        Canvas { columns, cells: vec![Cell::default(); columns * rows], width, height }
    }

    /// Width, dots.
    pub(super) fn width(&self) -> i32 {
        self.width
    }

    /// Height, dots.
    pub(super) fn height(&self) -> i32 {
        self.height
    }

    /// Draws the dot at (x, y), if it is on the canvas.
    pub(super) fn dot(&mut self, x: i32, y: i32, stroke: Stroke) {
        if x < 0 || y < 0 || x >= self.width || y >= self.height {
            return;
        }
        let (x, y) = (x as usize, y as usize);
        let cell = &mut self.cells[y / 4 * self.columns + x / 2];
        let bit = glyphs::bit(x % 2, y % 4);
        let (mask, kept) = match stroke.layer.is_body() {
            true => (&mut cell.bodies, &mut cell.body_stroke),
            false => (&mut cell.mask, &mut cell.stroke),
        };
        if *mask == 0 || stroke.layer >= kept.layer {
            *kept = stroke;
        }
        *mask |= bit;
    }

    /// Takes away the dots of spheres in a row from `from` to before `to`: what is nearer hides them.
    pub(super) fn hide(&mut self, from: i32, to: i32, y: i32) {
        if y < 0 || y >= self.height {
            return;
        }
        let (from, to) = (from.max(0), to.min(self.width));
        if from >= to {
            return;
        }
        let (from, to, y) = (from as usize, to as usize, y as usize);
        let row = y / 4 * self.columns;
        let (left, right) = (glyphs::bit(0, y % 4), glyphs::bit(1, y % 4));
        // Cell by cell, the first and the last perhaps by half.
        let (first, last) = (from / 2, (to - 1) / 2);
        for (column, cell) in self.cells[row + first..=row + last].iter_mut().enumerate() {
            let keeps_left = column == 0 && from % 2 == 1;
            let keeps_right = first + column == last && to % 2 == 1;
            cell.bodies &= !(if keeps_left { 0 } else { left } | if keeps_right { 0 } else { right });
        }
    }

    /// Puts a character in the cell of the dot at (x, y), in place of its dots, unless one of a higher layer is there.
    pub(super) fn sign(&mut self, x: i32, y: i32, sign: char, stroke: Stroke) {
        if x < 0 || y < 0 || x >= self.width || y >= self.height {
            return;
        }
        let cell = &mut self.cells[y as usize / 4 * self.columns + x as usize / 2];
        if cell.sign.is_none() || stroke.layer >= cell.sign_stroke.layer {
            (cell.sign, cell.sign_stroke) = (Some(sign), stroke);
        }
    }

    /// Writes ASCII text in cells, its first character in the cell of the dot at (x, y).
    pub(super) fn text(&mut self, x: i32, y: i32, text: &str, stroke: Stroke) {
        for (i, character) in text.chars().enumerate() {
            self.sign(x.saturating_add(2 * i as i32), y, character, stroke);
        }
    }

    /// Whether the dot at (x, y) is drawn.
    #[cfg(test)]
    pub(super) fn has(&self, x: i32, y: i32) -> bool {
        let (x, y) = (x as usize, y as usize);
        let cell = &self.cells[y / 4 * self.columns + x / 2];
        (cell.mask | cell.bodies) & glyphs::bit(x % 2, y % 4) != 0
    }

    /// Writes every cell with something in it to the sheet.
    pub(super) fn paint(&self, area: Rect, sheet: &mut Sheet) {
        for (i, cell) in self.cells.iter().enumerate() {
            let mask = cell.mask | cell.bodies;
            if mask == 0 && cell.sign.is_none() {
                continue;
            }
            let (column, row) = (i % self.columns, i / self.columns);
            let target = &mut sheet.buffer[(area.x + column as u16, area.y + row as u16)];
            target.set_char(cell.sign.unwrap_or_else(|| glyphs::dots(sheet.marker, mask)));
            let stroke = cell.seen();
            (target.fg, target.modifier) = (stroke.color, stroke.modifier);
        }
    }
}
