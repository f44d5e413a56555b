//! Colours and attributes as SGR sequences (ECMA-48 8.3.117), in their shortest forms.

use std::io::Write;

use ratatui::{
    buffer::Cell,
    style::{Color, Modifier},
};

/// Colours and attributes of what is written next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Pen {
    /// Foreground.
    pub(super) fg: Color,
    /// Background.
    pub(super) bg: Color,
    /// Attributes.
    pub(super) modifier: Modifier,
}

/// Attributes with the numbers that switch them on and off. Bold and dim share the one that switches them off.
const ATTRIBUTES: [(Modifier, u8, u8); 9] = [
    (Modifier::BOLD, 1, 22),
    (Modifier::DIM, 2, 22),
    (Modifier::ITALIC, 3, 23),
    (Modifier::UNDERLINED, 4, 24),
    (Modifier::SLOW_BLINK, 5, 25),
    (Modifier::RAPID_BLINK, 6, 25),
    (Modifier::REVERSED, 7, 27),
    (Modifier::HIDDEN, 8, 28),
    (Modifier::CROSSED_OUT, 9, 29),
];

impl Pen {
    /// What `CSI m` sets.
    pub(super) const DEFAULT: Pen = Pen { fg: Color::Reset, bg: Color::Reset, modifier: Modifier::empty() };

    /// The pen of a cell.
    pub(super) fn of(cell: &Cell) -> Pen {
        Pen { fg: cell.fg, bg: cell.bg, modifier: cell.modifier }
    }

    /// Appends what turns this pen into `next`: the shorter of changing what differs and of starting over.
    pub(super) fn change(&mut self, next: Pen, out: &mut Vec<u8>) {
        if *self == next {
            return;
        }
        let (mut step, mut anew) = (Vec::with_capacity(16), Vec::with_capacity(16));
        self.push_change(next, &mut step);
        if next != Pen::DEFAULT {
            anew.push(b';'); // an empty number is 0: everything off
            Pen::DEFAULT.push_change(next, &mut anew);
        }
        out.extend(b"\x1b[");
        out.extend(if step.len() <= anew.len() { step } else { anew });
        out.push(b'm');
        *self = next;
    }

    /// Appends the numbers of all that differs, with semicolons between.
    fn push_change(&self, next: Pen, numbers: &mut Vec<u8>) {
        let (gone, mut new) = (self.modifier - next.modifier, next.modifier - self.modifier);
        let mut last_off = 0;
        for (attribute, _, off) in ATTRIBUTES.into_iter().filter(|(attribute, ..)| gone.contains(*attribute)) {
            // What shares the number that switches it off has to be switched on again.
            let sharing = ATTRIBUTES.into_iter().filter(|(other, _, shared)| *shared == off && *other != attribute);
            new |= sharing.map(|(other, ..)| other).collect::<Modifier>() & next.modifier;
            if off != last_off {
                push(numbers, &[off]);
            }
            last_off = off;
        }
        for (_, on, _) in ATTRIBUTES.into_iter().filter(|(attribute, ..)| new.contains(*attribute)) {
            push(numbers, &[on]);
        }
        if self.fg != next.fg {
            push_color(numbers, next.fg, 30);
        }
        if self.bg != next.bg {
            push_color(numbers, next.bg, 40);
        }
    }
}

/// Appends a colour's numbers; `base` 30 is the foreground, 40 the background.
fn push_color(numbers: &mut Vec<u8>, color: Color, base: u8) {
    match color {
        Color::Reset => push(numbers, &[base + 9]),
        Color::Indexed(index) => push(numbers, &[base + 8, 5, index]),
        Color::Rgb(r, g, b) => push(numbers, &[base + 8, 2, r, g, b]),
        named => match ansi_index(named) {
            index @ 0..8 => push(numbers, &[base + index]),
            index => push(numbers, &[base + 52 + index]), // 90 and 100 up for the bright ones
        },
    }
}

/// A named colour's number among the terminal's 16.
pub(super) fn ansi_index(color: Color) -> u8 {
    match color {
        Color::Red => 1,
        Color::Green => 2,
        Color::Yellow => 3,
        Color::Blue => 4,
        Color::Magenta => 5,
        Color::Cyan => 6,
        Color::Gray => 7,
        Color::DarkGray => 8,
        Color::LightRed => 9,
        Color::LightGreen => 10,
        Color::LightYellow => 11,
        Color::LightBlue => 12,
        Color::LightMagenta => 13,
        Color::LightCyan => 14,
        Color::White => 15,
        Color::Black | Color::Reset | Color::Indexed(_) | Color::Rgb(..) => 0,
    }
}

fn push(numbers: &mut Vec<u8>, values: &[u8]) {
    for value in values {
        if !numbers.is_empty() && numbers.last() != Some(&b';') {
            numbers.push(b';');
        }
        write!(numbers, "{value}").expect("writing to memory does not fail");
    }
}
