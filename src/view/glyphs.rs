//! Characters by marker: how a cell's dots look, and the signs of the frame, which ASCII has its own for.

use super::screen::Marker;

/// The signs a frame is made of, beside dots and words.
#[derive(Debug, PartialEq)]
pub(super) struct Glyphs {
    /// The end of a text cut short.
    pub(super) ellipsis: &'static str,
    /// The sign for "becomes".
    pub(super) arrow: &'static str,
    /// The sign before a factor.
    pub(super) times: &'static str,
    /// The sign between two bodies.
    pub(super) with: &'static str,
    /// Labels of the side view's axes.
    pub(super) side_axes: &'static str,
    /// Labels of the top-down view's axes.
    pub(super) top_axes: &'static str,
    /// The scale bar: whole cell, half cell.
    pub(super) bar: [&'static str; 2],
    /// Timeline: frames that are kept, those that are not any more, the future, cursor.
    pub(super) track: [char; 4],
    /// Timeline: impacts in a column, from few to many.
    pub(super) levels: &'static [char],
    /// Marks of a contact: impact, rest, leaving.
    pub(super) contact: [char; 3],
    /// Signs for more rows above and below.
    pub(super) more: [&'static str; 2],
    /// Signs for a wall that goes on beyond the view: to the left, the right, up, down.
    pub(super) on: [char; 4],
    /// The sign before the entry under the cursor.
    pub(super) pointer: &'static str,
}

const UNICODE: Glyphs = Glyphs {
    ellipsis: "…",
    arrow: "→",
    times: "×",
    with: "–",
    side_axes: "x→ y↑",
    top_axes: "x→ z↓",
    bar: ["━", "╸"],
    track: ['─', '╌', '┈', '┃'],
    levels: &['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'],
    contact: ['×', '•', '·'],
    more: ["↑", "↓"],
    on: ['←', '→', '↑', '↓'],
    pointer: "▸",
};

const ASCII: Glyphs = Glyphs {
    ellipsis: "...",
    arrow: "->",
    times: "x",
    with: "-",
    side_axes: "x right, y up",
    top_axes: "x right, z down",
    bar: ["=", ""],
    track: ['-', '~', ' ', '|'],
    levels: &['.', ':', '+', '*', '#'],
    contact: ['x', '=', '.'],
    more: ["^", "v"],
    on: ['<', '>', '^', 'v'],
    pointer: ">",
};

/// The signs that go with a marker.
pub(super) const fn glyphs(marker: Marker) -> &'static Glyphs {
    match marker {
        Marker::Braille | Marker::Block => &UNICODE,
        Marker::Ascii => &ASCII,
    }
}

/// The bit of the dot at column `x` in 0..2 and row `y` in 0..4 of a cell, as Unicode numbers braille dots.
pub(super) const fn bit(x: usize, y: usize) -> u8 {
    match y {
        3 => 0x40 << x,
        _ => 1 << (3 * x + y),
    }
}

/// The character for a cell's dots.
pub(super) fn dots(marker: Marker, mask: u8) -> char {
    match marker {
        Marker::Braille => char::from_u32(0x2800 + u32::from(mask)).unwrap_or(' '),
        Marker::Block => QUADRANTS[quadrants(mask)],
        Marker::Ascii => char::from(ASCII_DOTS[usize::from(mask)]),
    }
}

/// Quadrant blocks by bits: 1 upper left, 2 upper right, 4 lower left, 8 lower right.
const QUADRANTS: [char; 16] = [' ', '▘', '▝', '▀', '▖', '▌', '▞', '▛', '▗', '▚', '▐', '▜', '▄', '▙', '▟', '█'];

/// Which quadrants hold a dot.
const fn quadrants(mask: u8) -> usize {
    let upper_left = mask & (bit(0, 0) | bit(0, 1)) != 0;
    let upper_right = mask & (bit(1, 0) | bit(1, 1)) != 0;
    let lower_left = mask & (bit(0, 2) | bit(0, 3)) != 0;
    let lower_right = mask & (bit(1, 2) | bit(1, 3)) != 0;
    upper_left as usize | (upper_right as usize) << 1 | (lower_left as usize) << 2 | (lower_right as usize) << 3
}

/// Characters with the dots they look like, rows from top to bottom, left dot in bit 1 and right dot in bit 0. On a
/// tie the earlier wins, so the plainer come first.
const SHAPES: [(u8, [u8; 4]); 24] = [
    (b'\'', [0b01, 0b00, 0b00, 0b00]),
    (b'\'', [0b10, 0b00, 0b00, 0b00]),
    (b'\'', [0b01, 0b01, 0b00, 0b00]),
    (b'\'', [0b10, 0b10, 0b00, 0b00]),
    (b'.', [0b00, 0b00, 0b00, 0b01]),
    (b'.', [0b00, 0b00, 0b00, 0b10]),
    (b'.', [0b00, 0b00, 0b01, 0b01]),
    (b'.', [0b00, 0b00, 0b10, 0b10]),
    (b'"', [0b11, 0b00, 0b00, 0b00]),
    (b'-', [0b00, 0b11, 0b00, 0b00]),
    (b'-', [0b00, 0b00, 0b11, 0b00]),
    (b'-', [0b00, 0b10, 0b01, 0b00]),
    (b'-', [0b00, 0b01, 0b10, 0b00]),
    (b'_', [0b00, 0b00, 0b00, 0b11]),
    (b'|', [0b10, 0b10, 0b10, 0b10]),
    (b'|', [0b01, 0b01, 0b01, 0b01]),
    (b'/', [0b01, 0b01, 0b10, 0b10]),
    (b'\\', [0b10, 0b10, 0b01, 0b01]),
    (b'(', [0b01, 0b10, 0b10, 0b01]),
    (b')', [0b10, 0b01, 0b01, 0b10]),
    (b'=', [0b11, 0b00, 0b00, 0b11]),
    (b'o', [0b00, 0b11, 0b11, 0b00]),
    (b'%', [0b10, 0b11, 0b11, 0b01]),
    (b'#', [0b11, 0b11, 0b11, 0b11]),
];

/// The ASCII character closest to each of the 256 patterns: fewest dots differ.
const ASCII_DOTS: [u8; 256] = {
    let mut table = [b' '; 256];
    let mut mask = 1;
    while mask < 256 {
        table[mask] = closest(mask as u8);
        mask += 1;
    }
    table
};

const fn closest(mask: u8) -> u8 {
    let (mut best, mut least, mut i) = (b' ', u32::MAX, 0);
    while i < SHAPES.len() {
        let distance = (pattern(&SHAPES[i].1) ^ mask).count_ones();
        if distance < least {
            (best, least) = (SHAPES[i].0, distance);
        }
        i += 1;
    }
    best
}

const fn pattern(rows: &[u8; 4]) -> u8 {
    let (mut mask, mut y) = (0, 0);
    while y < 4 {
        mask |= if rows[y] & 0b10 != 0 { bit(0, y) } else { 0 };
        mask |= if rows[y] & 0b01 != 0 { bit(1, y) } else { 0 };
        y += 1;
    }
    mask
}
