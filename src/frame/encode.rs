//! Terminal differences: the bytes that turn the frame a terminal shows into the next one.
//!
//! Short because runs of changed cells are reached by relative moves or by writing the few unchanged cells before them
//! again, attributes are kept from run to run, and blanks do not change colours. One frame is one byte string within
//! the brackets of synchronized output (DEC private mode 2026), so that no half of it is ever seen.

use std::io::Write;

use ratatui::{buffer::Buffer, layout::Position};

use super::{
    cells::{self, BLANK, Glyph},
    sgr::Pen,
};

/// Blanks at the end of a row from which on erasing is shorter than writing them.
const ERASE_FROM: usize = 4;

/// Fewest cells of a row that become blank from which on erasing the row and writing the others again may be worth it.
const WORTH_ERASING: usize = 8;

/// Turns buffers into bytes; remembers what the terminal shows.
///
/// The terminal has to be in raw mode: a line feed must not return the carriage.
#[derive(Debug, Clone)]
pub struct Encoder {
    /// What was encoded last, row by row; `None`: what the terminal shows is unknown.
    sent: Option<Buffer>,
    /// Where the terminal's cursor is shown.
    cursor: Option<Position>,
    /// Whether the terminal may know synchronized updates.
    brackets: bool,
}

impl Default for Encoder {
    fn default() -> Encoder {
        Encoder { sent: None, cursor: None, brackets: true }
    }
}

impl Encoder {
    /// An encoder for a terminal about which nothing is known.
    pub fn new() -> Encoder {
        Encoder::default()
    }

    /// Whether frames go in the brackets of synchronized updates, as they do at first: a terminal that does not know them
    /// leaves them out.
    pub fn bracket(&mut self, brackets: bool) {
        self.brackets = brackets;
    }

    /// Forgets what the terminal shows: the next frame is a full one. Due after anything else was written to it.
    pub fn forget(&mut self) {
        self.sent = None;
    }

    /// The bytes that make the terminal show `next`, its cursor at `cursor` or hidden; none if it does already.
    ///
    /// Encode a buffer only when its bytes will be sent: differences are taken against the last one encoded. A buffer
    /// of another size than the last gives a full repaint. The buffer's upper left corner is the screen's.
    pub fn encode(&mut self, next: &Buffer, cursor: Option<Position>) -> Vec<u8> {
        let known = self.sent.take().filter(|sent| sent.area() == next.area());
        let mut writer = Writer::new();
        if known.is_none() {
            writer.out.extend(b"\x1b[m\x1b[2J\x1b[?25l");
            self.cursor = None;
        }
        let blank = writer.out.len();
        for y in 0..next.area().height {
            let old: Vec<Glyph> = match &known {
                Some(sent) => cells::row(sent, y).collect(),
                None => vec![BLANK; next.area().width.into()],
            };
            writer.row(y, &old, &cells::row(next, y).collect::<Vec<_>>());
        }
        let drawn = known.is_none() || writer.out.len() > blank;
        writer.pen.change(Pen::DEFAULT, &mut writer.out);
        writer.cursor(self.cursor, cursor, drawn);
        self.cursor = cursor;
        // Reuses the memory of the buffer before.
        let mut sent = known.unwrap_or_default();
        sent.clone_from(next);
        self.sent = Some(sent);
        writer.finish(self.brackets)
    }
}

/// Where the terminal's cursor is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Place {
    row: u16,
    /// `None` after the last column, where terminals differ, and after clusters, about whose width they differ.
    column: Option<u16>,
}

/// A frame under way.
struct Writer {
    out: Vec<u8>,
    pen: Pen,
    place: Option<Place>,
}

impl Writer {
    fn new() -> Writer {
        Writer { out: Vec::new(), pen: Pen::DEFAULT, place: None }
    }

    /// The bytes, in their brackets if they have any; none if there are none.
    fn finish(self, brackets: bool) -> Vec<u8> {
        if self.out.is_empty() || !brackets {
            return self.out;
        }
        [b"\x1b[?2026h", &self.out[..], b"\x1b[?2026l"].concat()
    }

    /// Shows, moves or hides the cursor as needed after a frame that moved it (`drawn`) or did not.
    fn cursor(&mut self, before: Option<Position>, now: Option<Position>, drawn: bool) {
        match now {
            Some(at) if drawn || before != now => {
                self.go(at.y, at.x, &[]);
                if before.is_none() {
                    self.out.extend(b"\x1b[?25h");
                }
            }
            None if before.is_some() => self.out.extend(b"\x1b[?25l"),
            _ => {}
        }
    }

    /// Writes what differs in a row, where it is shorter by erasing the row from the first difference on.
    fn row(&mut self, y: u16, old: &[Glyph], new: &[Glyph]) {
        let (begin, before) = (self.out.len(), (self.pen, self.place));
        self.differences(y, old, new);
        let blanked = |(old, new): (&Glyph, &Glyph)| new.looks_like(&BLANK) && !old.looks_like(&BLANK);
        if old.iter().zip(new).filter(|pair| blanked(*pair)).count() < WORTH_ERASING {
            return;
        }
        let (plain, after) = (self.out.split_off(begin), (self.pen, self.place));
        (self.pen, self.place) = before;
        self.erased(y, old, new);
        if self.out.len() - begin >= plain.len() {
            self.out.truncate(begin);
            self.out.extend(plain);
            (self.pen, self.place) = after;
        }
    }

    /// Erases a row from the first difference on, and writes what is not blank there.
    fn erased(&mut self, y: u16, old: &[Glyph], new: &[Glyph]) {
        let differs = |x: &usize| !new[*x].looks_like(&old[*x]);
        let Some(mut first) = (0..new.len()).find(differs) else { return };
        // Never the right half of a wide glyph alone, of either.
        while first > 0 && (old[first].width == 0 || new[first].width == 0) {
            first -= 1;
        }
        self.go(y, first as u16, new);
        self.erase_rest();
        let rest = old[..first].iter().copied().chain(vec![BLANK; new.len() - first]).collect::<Vec<_>>();
        self.differences(y, &rest, new);
    }

    /// Writes cell by cell what differs in a row.
    fn differences(&mut self, y: u16, old: &[Glyph], new: &[Glyph]) {
        let differs = |x: usize| match (old[x].width, new[x].width) {
            (_, 0) => false,  // written with its left half
            (0, 1..) => true, // its left half is gone, so the terminal may have blanked it
            _ => !new[x].looks_like(&old[x]),
        };
        let Some(last) = (0..new.len()).rev().find(|x| differs(*x)) else { return };
        let blank_from = new.iter().rposition(|glyph| !glyph.looks_like(&BLANK)).map_or(0, |x| x + 1);
        for x in (0..=last).filter(|x| differs(*x)) {
            self.go(y, x as u16, new);
            if x >= blank_from && last - x + 1 >= ERASE_FROM {
                self.erase_rest();
                return;
            }
            self.put(&new[x], new.len());
        }
    }

    /// Erases from the cursor to the end of the row.
    fn erase_rest(&mut self) {
        if !BLANK.suits(&self.pen) {
            self.pen.change(Pen::DEFAULT, &mut self.out);
        }
        self.out.extend(b"\x1b[K");
    }

    /// Writes one glyph where the cursor is.
    fn put(&mut self, glyph: &Glyph, columns: usize) {
        if !glyph.suits(&self.pen) {
            self.pen.change(glyph.pen, &mut self.out);
        }
        let here = self.place;
        if !glyph.is_simple() {
            // Terminals differ about its width: blank all that it may cover, then write it.
            self.out.resize(self.out.len() + usize::from(glyph.width), b' ');
            self.place = None;
            if let Some(Place { row, column: Some(column) }) = here {
                self.go(row, column, &[]);
            }
        }
        self.out.extend(glyph.text.as_bytes());
        self.place = here.map(|Place { row, column }| {
            let next = column.map(|column| column + glyph.width);
            Place { row, column: next.filter(|next| glyph.is_simple() && usize::from(*next) < columns) }
        });
    }

    /// Moves the cursor by the shortest way. `new`: the row it goes to, parts of which may be written on the way.
    fn go(&mut self, y: u16, x: u16, new: &[Glyph]) {
        let target = Place { row: y, column: Some(x) };
        if self.place == Some(target) {
            return;
        }
        let mut way = absolute(y, x);
        let mut consider = |other: Option<Vec<u8>>| {
            if let Some(other) = other.filter(|other| other.len() < way.len()) {
                way = other;
            }
        };
        if let Some(Place { row, column }) = self.place.filter(|place| place.row <= y) {
            let down = vec![b'\n'; usize::from(y - row)];
            if let Some(column) = column {
                consider(Some([&down[..], &sideways(column, x)].concat()));
                let between = new.get(column.into()..x.into()).filter(|_| row == y);
                consider(between.and_then(|cells| self.bridge(cells)));
            }
            consider(Some([b"\r", &down[..], &sideways(0, x)].concat()));
        }
        self.out.extend(way);
        self.place = Some(target);
    }

    /// Cells written again to get past them, if the pen suits them all.
    fn bridge(&self, cells: &[Glyph]) -> Option<Vec<u8>> {
        let plain = |glyph: &Glyph| glyph.width == 1 && glyph.is_simple() && glyph.suits(&self.pen);
        let few = cells.len() < 8; // nothing longer beats an absolute move
        (few && cells.iter().all(plain)).then(|| cells.iter().flat_map(|glyph| glyph.text.bytes()).collect())
    }
}

/// A move to a row and column, whatever the cursor's place.
fn absolute(y: u16, x: u16) -> Vec<u8> {
    match (y, x) {
        (0, 0) => b"\x1b[H".to_vec(),
        (_, 0) => sequence(y + 1, 'H'),
        _ => format!("\x1b[{};{}H", y + 1, x + 1).into_bytes(),
    }
}

/// A move within a row.
fn sideways(from: u16, to: u16) -> Vec<u8> {
    match from.abs_diff(to) {
        0 => Vec::new(),
        n if to > from => sequence(n, 'C'),
        n if n <= 3 => vec![b'\x08'; n.into()],
        n => sequence(n, 'D'),
    }
}

/// A control sequence with one number, which is left out if it is 1.
fn sequence(number: u16, end: char) -> Vec<u8> {
    let mut bytes = b"\x1b[".to_vec();
    let written = if number == 1 { write!(bytes, "{end}") } else { write!(bytes, "{number}{end}") };
    written.expect("writing to memory does not fail");
    bytes
}
