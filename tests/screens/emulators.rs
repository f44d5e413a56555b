//! Two terminal emulators of different origin that read the same bytes: what one of them forgives, the other may not.

use ratatui::{
    buffer::Buffer,
    style::{Color, Modifier},
};

/// Both of them.
pub(crate) struct Terminals {
    vt100: vt100::Parser,
    avt: avt::Terminal,
}

impl Terminals {
    pub(crate) fn new(width: u16, height: u16) -> Terminals {
        Terminals {
            vt100: vt100::Parser::new(height.try_into().expect("not 0"), width.try_into().expect("not 0"), 0),
            avt: avt::Terminal::new(width.into(), height.into()).expect("not 0"),
        }
    }

    pub(crate) fn process(&mut self, bytes: &[u8]) {
        self.vt100.process(bytes);
        // This emulator gives a combining mark a cell of its own, as no terminal does: it is spared them.
        self.avt.feed(str::from_utf8(bytes).expect("whole characters").replace('\u{301}', "").as_str());
    }

    pub(crate) fn resize(&mut self, width: u16, height: u16) {
        let (rows, columns) = (height.try_into().expect("not 0"), width.try_into().expect("not 0"));
        self.vt100.screen_mut().set_size(rows, columns);
        self.avt.resize(width.into(), height.into());
    }

    /// Both show the cursor there, column and row, or hide it.
    pub(crate) fn assert_cursor(&self, at: Option<(u16, u16)>) {
        let screen = self.vt100.screen();
        assert_eq!(!screen.hide_cursor(), at.is_some());
        let cursor = self.avt.cursor();
        assert_eq!(cursor.visible, at.is_some());
        if let Some((column, row)) = at {
            assert_eq!(screen.cursor_position(), (row, column));
            assert_eq!((cursor.col, cursor.row), (column.into(), row.into()));
        }
    }

    /// Both show the buffer.
    pub(crate) fn assert_show(&self, buffer: &Buffer) {
        assert_vt100_shows(&self.vt100, buffer);
        assert_avt_shows(&self.avt, buffer);
    }
}

fn shown(color: Color) -> vt100::Color {
    match color {
        Color::Red => vt100::Color::Idx(1),
        Color::LightBlue => vt100::Color::Idx(12),
        Color::DarkGray => vt100::Color::Idx(8),
        Color::Indexed(index) => vt100::Color::Idx(index),
        Color::Rgb(r, g, b) => vt100::Color::Rgb(r, g, b),
        _ => vt100::Color::Default,
    }
}

/// The same of a colour as the other one tells it.
fn shown_by_avt(color: Color) -> Option<avt::Color> {
    match shown(color) {
        vt100::Color::Default => None,
        vt100::Color::Idx(index) => Some(avt::Color::Indexed(index)),
        vt100::Color::Rgb(r, g, b) => Some(avt::Color::rgb(r, g, b)),
    }
}

/// Compares every cell with the buffer; of a cluster the first character, which is all that this emulator keeps.
fn assert_avt_shows(terminal: &avt::Terminal, buffer: &Buffer) {
    let area = buffer.area();
    for y in 0..area.height {
        let line = terminal.screen().line(y.into()).expect("on the screen");
        for (x, on_screen) in (0..area.width).zip(line.cells()) {
            let cell = &buffer[(x, y)];
            let at = format!("column {x}, row {y}: {cell:?} but the terminal shows {on_screen:?}");
            let wide = |x: u16| matches!(buffer[(x, y)].symbol(), "あ" | "漢");
            // Of two wide ones side by side the second has no room but after the first.
            let mut hidden = false;
            for before in 0..x {
                hidden = wide(before) && !hidden;
            }
            if hidden {
                assert_eq!(on_screen.width(), 0, "{at}");
                continue;
            }
            let expected = match cell.symbol() {
                "" => ' ',
                _ if wide(x) && x + 1 == area.width => ' ', // no room for it
                symbol => symbol.chars().next().expect("a character"),
            };
            let pen = on_screen.pen();
            assert_eq!(on_screen.char(), expected, "{at}");
            assert_eq!(pen.background(), shown_by_avt(cell.bg), "{at}");
            assert_eq!(pen.is_inverse(), cell.modifier.contains(Modifier::REVERSED), "{at}");
            assert_eq!(pen.is_underline(), cell.modifier.contains(Modifier::UNDERLINED), "{at}");
            if expected != ' ' || pen.is_inverse() || pen.is_underline() {
                assert_eq!(pen.foreground(), shown_by_avt(cell.fg), "{at}");
                assert_eq!(pen.is_bold(), cell.modifier.contains(Modifier::BOLD), "{at}");
                assert_eq!(pen.is_faint(), cell.modifier.contains(Modifier::DIM), "{at}");
                assert_eq!(pen.is_italic(), cell.modifier.contains(Modifier::ITALIC), "{at}");
            }
        }
    }
}

/// Compares every cell of the emulated screen with the buffer. A blank shows its background only.
fn assert_vt100_shows(parser: &vt100::Parser, buffer: &Buffer) {
    let area = buffer.area();
    for y in 0..area.height {
        let mut hidden = false;
        for x in 0..area.width {
            let (cell, on_screen) = (&buffer[(x, y)], parser.screen().cell(y, x).expect("on the screen"));
            let at = format!("column {x}, row {y}: {cell:?} but the terminal shows {on_screen:?}");
            if std::mem::take(&mut hidden) {
                assert!(on_screen.is_wide_continuation(), "{at}");
                continue;
            }
            hidden = matches!(cell.symbol(), "あ" | "漢") && x + 1 < area.width;
            let expected = match cell.symbol() {
                "" => " ",
                "あ" | "漢" if !hidden => " ", // no room for it
                symbol => symbol,
            };
            let contents = if on_screen.has_contents() { on_screen.contents() } else { " " };
            assert_eq!(contents, expected, "{at}");
            assert_eq!(on_screen.bgcolor(), shown(cell.bg), "{at}");
            assert_eq!(on_screen.inverse(), cell.modifier.contains(Modifier::REVERSED), "{at}");
            assert_eq!(on_screen.underline(), cell.modifier.contains(Modifier::UNDERLINED), "{at}");
            if expected != " " || on_screen.inverse() || on_screen.underline() {
                assert_eq!(on_screen.fgcolor(), shown(cell.fg), "{at}");
                assert_eq!(on_screen.bold(), cell.modifier.contains(Modifier::BOLD), "{at}");
                assert_eq!(on_screen.dim(), cell.modifier.contains(Modifier::DIM), "{at}");
                assert_eq!(on_screen.italic(), cell.modifier.contains(Modifier::ITALIC), "{at}");
            }
        }
    }
}
