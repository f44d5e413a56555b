//! A buffer as plain text, and as text with colours.

use ratatui::buffer::Buffer;

use super::{
    cells::{self, Glyph},
    sgr::Pen,
};

/// The characters of a buffer, a line per row, blanks at the ends of lines left out, each line ended.
pub fn text(buffer: &Buffer) -> String {
    let mut text = String::new();
    for y in 0..buffer.area().height {
        let line: String = cells::row(buffer, y).map(|glyph| glyph.text).collect();
        text += line.trim_end_matches(' ');
        text.push('\n');
    }
    text
}

/// The text of a buffer with colours and attributes as SGR sequences; every line ends in the default style.
pub fn ansi(buffer: &Buffer) -> String {
    let mut out = Vec::new();
    for y in 0..buffer.area().height {
        let glyphs: Vec<Glyph> = cells::row(buffer, y).collect();
        let end = glyphs.iter().rposition(|glyph| !glyph.looks_like(&cells::BLANK)).map_or(0, |last| last + 1);
        let mut pen = Pen::DEFAULT;
        for glyph in &glyphs[..end] {
            if !glyph.suits(&pen) {
                pen.change(glyph.pen, &mut out);
            }
            out.extend(glyph.text.as_bytes());
        }
        pen.change(Pen::DEFAULT, &mut out);
        out.push(b'\n');
    }
    String::from_utf8(out).expect("made of strings and ASCII")
}
