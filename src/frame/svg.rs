//! A buffer as a self-contained SVG image: no fonts needed for dots, blocks and bars, and none but a monospaced one for
//! text.

use std::{collections::BTreeMap, fmt::Write};

use ratatui::{
    buffer::Buffer,
    style::{Color, Modifier},
};

use super::{
    cells::{self, Glyph},
    sgr::{Pen, ansi_index},
};

/// Width of a cell, px.
const WIDTH: usize = 10;

/// Height of a cell, px: twice its width, so that braille dots are square apart.
const HEIGHT: usize = 20;

/// Diameter of a dot, px, of the 5 px from one to the next.
const DOT: &str = "3.6";

/// Colour of the screen behind everything.
const BACKGROUND: &str = "#14161b";

/// Colour of text without one of its own.
const FOREGROUND: &str = "#d8dee9";

/// The terminal's 16 colours, legible on [`BACKGROUND`].
const ANSI: [&str; 16] = [
    "#3b4048", "#e06c75", "#8fbf6a", "#e0b35e", "#6a9fe8", "#c586d6", "#56b6c2", "#b8bfca", //
    "#6b7380", "#ff8080", "#a8d888", "#f5d080", "#8fb8ff", "#dda6ec", "#7fd4de", "#f4f6fa",
];

/// Monospaced fonts, the last of a size at which its characters are as wide as a cell; others are stretched.
const FONT: &str = r#"font-family="ui-monospace,Menlo,Consolas,'DejaVu Sans Mono',monospace" font-size="16.6""#;

/// What is drawn in one colour, as path data.
#[derive(Default)]
struct Layer {
    /// Braille dots: round-capped lines of no length.
    dots: String,
    /// Blocks and bars.
    boxes: String,
}

/// The image of a buffer, titled by the text of its first row and described by all of it.
pub fn svg(buffer: &Buffer) -> String {
    let (columns, rows) = (usize::from(buffer.area().width), usize::from(buffer.area().height));
    let mut backgrounds: BTreeMap<String, String> = BTreeMap::new();
    let mut layers: BTreeMap<String, Layer> = BTreeMap::new();
    let mut words = String::new();
    for y in 0..rows {
        for (x, glyph) in cells::row(buffer, y as u16).enumerate().filter(|(_, glyph)| glyph.width > 0) {
            let (ink, paper) = colors(&glyph.pen);
            if paper != BACKGROUND {
                push_box(backgrounds.entry(paper).or_default(), x, y, [0, 0, 8 * usize::from(glyph.width), 8]);
            }
            draw_shape(&glyph, x, y, layers.entry(ink).or_default());
        }
        push_words(buffer, y, &mut words);
    }
    let mut svg = head(buffer, columns * WIDTH, rows * HEIGHT);
    for (color, boxes) in &backgrounds {
        push_line(&mut svg, &format!(r#"<path fill="{color}" d="{boxes}"/>"#));
    }
    for (color, layer) in &layers {
        push_layer(&mut svg, color, layer);
    }
    push_line(&mut svg, &format!("<g {FONT}>"));
    svg + &words + "</g>\n</svg>\n"
}

/// Opening tag, title, description and background.
fn head(buffer: &Buffer, width: usize, height: usize) -> String {
    let text = super::text(buffer);
    let first = text.lines().next().unwrap_or("").trim();
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" role="img" aria-labelledby="title desc">
<title id="title">Carom: {}</title>
<desc id="desc">{}</desc>
<rect width="100%" height="100%" fill="{BACKGROUND}"/>
"#,
        escape(first),
        escape(text.trim_end()),
    )
}

/// The words of a row, each at its own column and stretched to its columns, so that they stay aligned whatever the font.
fn push_words(buffer: &Buffer, y: usize, svg: &mut String) {
    let written: Vec<(usize, Glyph)> =
        cells::row(buffer, y as u16).enumerate().filter(|(_, glyph)| is_text(glyph)).collect();
    let together =
        |(x, a): &(usize, Glyph), (next, b): &(usize, Glyph)| x + usize::from(a.width) == *next && a.pen == b.pen;
    for word in written.chunk_by(together) {
        let pen = word[0].1.pen;
        let columns: usize = word.iter().map(|(_, glyph)| usize::from(glyph.width)).sum();
        let text: String = word.iter().map(|(_, glyph)| glyph.text).collect();
        let (x, y, length) = (word[0].0 * WIDTH, y * HEIGHT + 15, columns * WIDTH);
        let style = text_style(&pen);
        push_line(svg, &format!(r#"<text x="{x}" y="{y}" textLength="{length}"{style}>{}</text>"#, escape(&text)));
    }
}

/// Colour and attributes of a text, as XML attributes.
fn text_style(pen: &Pen) -> String {
    let mut style = format!(r#" fill="{}""#, colors(pen).0);
    for (attribute, xml) in [
        (Modifier::BOLD, r#" font-weight="bold""#),
        (Modifier::ITALIC, r#" font-style="italic""#),
        (Modifier::UNDERLINED, r#" text-decoration="underline""#),
        (Modifier::CROSSED_OUT, r#" text-decoration="line-through""#),
    ] {
        if pen.modifier.contains(attribute) {
            style += xml;
        }
    }
    style
}

/// Whether the glyph is written, not drawn.
fn is_text(glyph: &Glyph) -> bool {
    !matches!(glyph.text.chars().next(), None | Some(' ' | '─' | '━' | '┃' | '┈' | '╸' | '\u{2580}'..='\u{259F}' | '\u{2800}'..='\u{28FF}'))
}

/// Draws dots, blocks and bars.
fn draw_shape(glyph: &Glyph, x: usize, y: usize, layer: &mut Layer) {
    let Some(character) = glyph.text.chars().next() else { return };
    let boxes = &mut layer.boxes;
    match character {
        '\u{2800}'..='\u{28FF}' => push_dots(character as u32 - 0x2800, x, y, &mut layer.dots),
        '▀' => push_box(boxes, x, y, [0, 0, 8, 4]),
        '▁'..='█' => {
            let height = character as usize - '▁' as usize + 1;
            push_box(boxes, x, y, [0, 8 - height, 8, height]);
        }
        '▌' => push_box(boxes, x, y, [0, 0, 4, 8]),
        '▐' => push_box(boxes, x, y, [4, 0, 4, 8]),
        '▖'..='▟' => push_quadrants(character, x, y, boxes),
        '─' => push_rule(boxes, [x * WIDTH, y * HEIGHT + 9, WIDTH, 1]),
        '┈' => (0..WIDTH).step_by(3).for_each(|dx| push_rule(boxes, [x * WIDTH + dx, y * HEIGHT + 9, 1, 1])),
        '━' => push_rule(boxes, [x * WIDTH, y * HEIGHT + 8, WIDTH, 3]),
        '╸' => push_rule(boxes, [x * WIDTH, y * HEIGHT + 8, WIDTH / 2, 3]),
        '┃' => push_rule(boxes, [x * WIDTH + 4, y * HEIGHT, 3, HEIGHT]),
        _ => {}
    }
}

/// The dots of a braille character by its bits.
fn push_dots(bits: u32, x: usize, y: usize, dots: &mut String) {
    const PLACES: [(usize, usize); 8] = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3)];
    for (_, (column, row)) in PLACES.into_iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1) {
        let (x, y) = (x * WIDTH + column * 5, y * HEIGHT + row * 5);
        push(dots, format_args!("M{x}.5 {y}.5h.01", x = x + 2, y = y + 2));
    }
}

/// The quadrants U+2596 … U+259F, by bits: 1 upper left, 2 upper right, 4 lower left, 8 lower right.
fn push_quadrants(character: char, x: usize, y: usize, boxes: &mut String) {
    const BITS: [u8; 10] = [4, 8, 1, 13, 9, 7, 11, 2, 6, 14];
    let bits = BITS.get(character as usize - '▖' as usize).copied().unwrap_or(0);
    for (i, place) in [[0, 0], [4, 0], [0, 4], [4, 4]].into_iter().enumerate() {
        if bits >> i & 1 == 1 {
            push_box(boxes, x, y, [place[0], place[1], 4, 4]);
        }
    }
}

/// A box within a cell: left, top, width and height in eighths of the cell.
fn push_box(path: &mut String, x: usize, y: usize, [left, top, width, height]: [usize; 4]) {
    let eighths = |n: usize, size: usize| (n * size) as f64 / 8.0;
    let (x, y) = ((x * WIDTH) as f64 + eighths(left, WIDTH), (y * HEIGHT) as f64 + eighths(top, HEIGHT));
    let (width, height) = (eighths(width, WIDTH), eighths(height, HEIGHT));
    push(path, format_args!("M{x} {y}h{width}v{height}h-{width}z"));
}

/// A box by left, top, width and height, px.
fn push_rule(path: &mut String, [x, y, width, height]: [usize; 4]) {
    push(path, format_args!("M{x} {y}h{width}v{height}h-{width}z"));
}

fn push_layer(svg: &mut String, color: &str, layer: &Layer) {
    if !layer.boxes.is_empty() {
        push_line(svg, &format!(r#"<path fill="{color}" d="{}"/>"#, layer.boxes));
    }
    if !layer.dots.is_empty() {
        let line =
            format!(r#"<path stroke="{color}" stroke-width="{DOT}" stroke-linecap="round" d="{}"/>"#, layer.dots);
        push_line(svg, &line);
    }
}

fn push_line(svg: &mut String, line: &str) {
    svg.push_str(line);
    svg.push('\n');
}

fn push(path: &mut String, data: std::fmt::Arguments) {
    path.write_fmt(data).expect("writing to memory does not fail");
}

/// Colours of text and background of a pen, as the reverse attribute leaves them; dim is half way to the background.
fn colors(pen: &Pen) -> (String, String) {
    let (ink, paper) = (color(pen.fg, FOREGROUND), color(pen.bg, BACKGROUND));
    let (ink, paper) = if pen.modifier.contains(Modifier::REVERSED) { (paper, ink) } else { (ink, paper) };
    if pen.modifier.contains(Modifier::HIDDEN) {
        return (paper.clone(), paper);
    }
    if pen.modifier.contains(Modifier::DIM) { (blend(&ink, &paper), paper) } else { (ink, paper) }
}

fn color(color: Color, default: &str) -> String {
    match color {
        Color::Reset => default.into(),
        Color::Rgb(r, g, b) => format!("#{r:02x}{g:02x}{b:02x}"),
        Color::Indexed(index @ 0..16) => ANSI[usize::from(index)].into(),
        Color::Indexed(index @ 16..232) => {
            let level = |n: u8| if n == 0 { 0 } else { 55 + 40 * n };
            let index = index - 16;
            format!("#{:02x}{:02x}{:02x}", level(index / 36), level(index / 6 % 6), level(index % 6))
        }
        Color::Indexed(index) => {
            let grey = 8 + 10 * (index - 232);
            format!("#{grey:02x}{grey:02x}{grey:02x}")
        }
        named => ANSI[usize::from(ansi_index(named))].into(),
    }
}

/// Two parts of one colour and one of another, both as #rrggbb.
fn blend(a: &str, b: &str) -> String {
    let channel = |text: &str, i: usize| u16::from_str_radix(text.get(i..i + 2).unwrap_or("0"), 16).unwrap_or(0);
    let mixed = |i: usize| (2 * channel(a, i) + channel(b, i)) / 3;
    format!("#{:02x}{:02x}{:02x}", mixed(1), mixed(3), mixed(5))
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
