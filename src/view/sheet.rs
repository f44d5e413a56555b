//! Where text goes into the buffer: cut to its area by display width, and to ASCII where the marker asks for it.

use std::borrow::Cow;

use ratatui::{
    buffer::{Buffer, CellWidth},
    layout::Rect,
    style::Style,
    text::Span,
};

use super::{
    glyphs::{Glyphs, glyphs},
    palette::Palette,
    screen::{Marker, ViewSettings},
};

/// The buffer with what every strip of the screen needs to write on it.
pub(super) struct Sheet<'a> {
    /// The buffer that is written to.
    pub(super) buffer: &'a mut Buffer,
    /// Colours by role.
    pub(super) palette: Palette,
    /// How dots become characters.
    pub(super) marker: Marker,
    /// The signs that go with the marker.
    pub(super) glyphs: &'static Glyphs,
}

impl<'a> Sheet<'a> {
    /// A sheet over the buffer.
    pub(super) fn new(buffer: &'a mut Buffer, settings: &ViewSettings) -> Sheet<'a> {
        Sheet { buffer, palette: Palette::new(settings), marker: settings.marker, glyphs: glyphs(settings.marker) }
    }

    /// Blanks an area.
    pub(super) fn clear(&mut self, area: Rect) {
        for y in area.rows() {
            for x in y.columns() {
                self.buffer[(x.x, x.y)].reset();
            }
        }
    }

    /// Writes text at the start of the area's first row, cut to fit; returns the columns used.
    pub(super) fn put(&mut self, area: Rect, text: &str, style: Style) -> u16 {
        if area.is_empty() {
            return 0;
        }
        let text = self.cut(text, area.width);
        let (end, _) = self.buffer.set_stringn(area.x, area.y, &*text, area.width.into(), style);
        end - area.x
    }

    /// Writes pieces one after another; returns the columns used.
    pub(super) fn put_all(&mut self, area: Rect, pieces: &[(&str, Style)]) -> u16 {
        let mut used = 0;
        for (text, style) in pieces {
            used += self.put(Rect { x: area.x + used, width: area.width - used, ..area }, text, *style);
        }
        used
    }

    /// Writes text that ends in the area's last column.
    pub(super) fn put_right(&mut self, area: Rect, text: &str, style: Style) {
        let used = width(&self.plain(text)).min(area.width.into()) as u16;
        self.put(Rect { x: area.x + area.width - used, width: used, ..area }, text, style);
    }

    /// Text in the characters the marker allows.
    fn plain<'t>(&self, text: &'t str) -> Cow<'t, str> {
        if self.marker != Marker::Ascii || text.is_ascii() {
            return Cow::Borrowed(text);
        }
        Cow::Owned(text.chars().fold(String::with_capacity(text.len()), |mut plain, c| {
            match c {
                '≤' => plain.push_str("<="),
                '≥' => plain.push_str(">="),
                c => plain.push(ascii(c)),
            }
            plain
        }))
    }

    /// Text cut to so many columns, an ellipsis at the end if it was cut.
    fn cut<'t>(&self, text: &'t str, columns: u16) -> Cow<'t, str> {
        let text = self.plain(text);
        if width(&text) <= columns.into() {
            return text;
        }
        let ellipsis = if columns > 3 { self.glyphs.ellipsis } else { "" };
        let (start, _) = split(&text, usize::from(columns) - width(ellipsis));
        Cow::Owned(format!("{start}{ellipsis}"))
    }
}

/// The ASCII character closest in meaning, for the signs that our own texts use.
fn ascii(character: char) -> char {
    match character {
        c if c.is_ascii() => c,
        '→' => '>',
        '←' => '<',
        '↑' | '⇧' => '^',
        '↓' => 'v',
        '×' => 'x',
        '÷' => '/',
        '–' | '−' => '-',
        'τ' => 't',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '₁' => '1',
        '₂' => '2',
        '…' | '·' => '.',
        _ => '?',
    }
}

/// Columns a text takes.
pub(super) fn width(text: &str) -> usize {
    match text.is_ascii() {
        true => text.len(),
        false => Span::raw(text).styled_graphemes(Style::new()).map(|g| usize::from(g.symbol.cell_width())).sum(),
    }
}

/// (as much of the start of a text as fits so many columns, the rest), never splitting what is one character to the
/// reader.
fn split(text: &str, columns: usize) -> (&str, &str) {
    let mut used = 0;
    let first_out = Span::raw(text).styled_graphemes(Style::new()).map(|g| g.symbol).find_map(|symbol| {
        used += usize::from(symbol.cell_width());
        (used > columns).then(|| symbol.as_ptr() as usize - text.as_ptr() as usize)
    });
    text.split_at(first_out.unwrap_or(text.len()))
}

/// A text broken between words into lines of at most so many columns; words longer than a line are broken too.
pub(super) fn wrap(text: &str, columns: u16) -> Vec<String> {
    let columns = usize::from(columns);
    let (mut lines, mut line) = (Vec::new(), String::new());
    for word in text.split_whitespace() {
        if !line.is_empty() && width(&line) + 1 + width(word) > columns {
            lines.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        let mut word = word;
        while width(word) > columns {
            let (start, rest) = split(word, columns);
            if start.is_empty() {
                break; // not even one character fits: what follows is cut when it is written
            }
            lines.push(start.into());
            word = rest;
        }
        line.push_str(word);
    }
    lines.push(line);
    lines
}
