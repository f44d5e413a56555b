//! Does a terminal that reads our bytes show the buffer we drew?

use carom::frame::{Encoder, ansi, svg, text};
use proptest::{prelude::*, test_runner::RngSeed};
use ratatui::{
    buffer::{Buffer, Cell},
    layout::{Position, Rect},
    style::{Color, Modifier, Style},
};

use crate::emulators::Terminals;

const SYMBOLS: [&str; 13] = [" ", " ", " ", "a", "b", "⣿", "⠁", "│", "▀", "あ", "漢", "e\u{301}", ""];

fn color() -> impl Strategy<Value = Color> {
    prop_oneof![
        4 => Just(Color::Reset),
        1 => Just(Color::Red),
        1 => Just(Color::LightBlue),
        1 => Just(Color::DarkGray),
        1 => (16_u8..=255).prop_map(Color::Indexed),
        1 => any::<(u8, u8, u8)>().prop_map(|(r, g, b)| Color::Rgb(r, g, b)),
    ]
}

/// Attributes; not bold and dim at once, which the emulator cannot hold.
fn modifier() -> impl Strategy<Value = Modifier> {
    let weight = prop_oneof![Just(Modifier::empty()), Just(Modifier::BOLD), Just(Modifier::DIM)];
    let rest = proptest::sample::subsequence(vec![Modifier::ITALIC, Modifier::UNDERLINED, Modifier::REVERSED], 0..=3);
    (weight, rest).prop_map(|(weight, rest)| rest.into_iter().fold(weight, |all, one| all | one))
}

fn cell() -> impl Strategy<Value = Cell> {
    let style =
        prop_oneof![3 => Just((Color::Reset, Color::Reset, Modifier::empty())), 2 => (color(), color(), modifier())];
    (proptest::sample::select(&SYMBOLS[..]), style).prop_map(|(symbol, (fg, bg, modifier))| {
        let mut cell = Cell::default();
        cell.set_symbol(symbol);
        (cell.fg, cell.bg, cell.modifier) = (fg, bg, modifier);
        cell
    })
}

/// Buffers of a size: mostly blank, or full.
fn buffer(width: u16, height: u16) -> impl Strategy<Value = Buffer> {
    let cell = prop_oneof![1 => cell(), 1 => Just(Cell::default())];
    proptest::collection::vec(cell, usize::from(width * height)).prop_map(move |cells| {
        let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
        buffer.content = cells;
        buffer
    })
}

/// A change to a buffer: some cells replaced.
fn changes(width: u16, height: u16) -> impl Strategy<Value = Vec<(Position, Cell)>> {
    let place = (0..width, 0..height).prop_map(|(x, y)| Position::new(x, y));
    proptest::collection::vec((place, cell()), 0..30)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_full_frame_and_differences_after_it_show_each_buffer(
        first in buffer(23, 6),
        steps in proptest::collection::vec(changes(23, 6), 1..4),
        whole in buffer(23, 6),
    ) {
        let (mut encoder, mut parser) = (Encoder::new(), Terminals::new(23, 6));
        parser.process(b"what was there before, in \x1b[31;44;7mcolours");
        let mut buffer = first;
        parser.process(&encoder.encode(&buffer, None));
        parser.assert_show(&buffer);
        for step in steps {
            for (at, cell) in step {
                buffer[at] = cell;
            }
            parser.process(&encoder.encode(&buffer, None));
            parser.assert_show(&buffer);
        }
        parser.process(&encoder.encode(&whole, None));
        parser.assert_show(&whole);
    }

    #[test]
    fn another_size_repaints_everything(first in buffer(20, 5), second in buffer(9, 7)) {
        let (mut encoder, mut parser) = (Encoder::new(), Terminals::new(20, 5));
        parser.process(&encoder.encode(&first, None));
        parser.resize(9, 7);
        parser.process(&encoder.encode(&second, None));
        parser.assert_show(&second);
    }

    #[test]
    fn coloured_text_shows_the_buffer(buffer in buffer(17, 4)) {
        let mut parser = Terminals::new(17, 4);
        parser.process(ansi(&buffer).trim_end_matches('\n').replace('\n', "\r\n").as_bytes());
        parser.assert_show(&buffer);
    }
}

fn lines(lines: &[&str]) -> Buffer {
    Buffer::with_lines(lines.iter().copied())
}

#[test]
fn an_unchanged_frame_is_no_bytes() {
    let mut encoder = Encoder::new();
    let buffer = lines(&["carom", "⣿⠁"]);
    assert!(!encoder.encode(&buffer, None).is_empty());
    assert_eq!(encoder.encode(&buffer, None), b"");
    encoder.forget();
    assert!(!encoder.encode(&buffer, None).is_empty());
}

#[test]
fn one_changed_cell_is_one_move_and_one_character_in_sync_brackets() {
    let mut encoder = Encoder::new();
    encoder.encode(&lines(&["t 1.0", "     "]), None);
    assert_eq!(encoder.encode(&lines(&["t 1.1", "     "]), None), b"\x1b[?2026h\x1b[1;5H1\x1b[?2026l");
}

#[test]
fn a_small_gap_is_written_again_and_the_next_row_is_reached_by_a_line_feed() {
    let mut encoder = Encoder::new();
    encoder.encode(&lines(&["abcdefgh", "abcdefgh"]), None);
    let bytes = encoder.encode(&lines(&["Xb Yefgh", "abcdXfgh"]), None);
    assert_eq!(String::from_utf8_lossy(&bytes), "\x1b[?2026h\x1b[HXb Y\nX\x1b[?2026l");
}

#[test]
fn named_colours_are_sent_in_their_short_forms_and_reset_once() {
    let mut encoder = Encoder::new();
    let mut buffer = lines(&["        "]);
    encoder.encode(&buffer, None);
    buffer.set_string(0, 0, "ab", Style::new().fg(Color::LightRed));
    buffer.set_string(3, 0, "c", Style::new().fg(Color::LightRed));
    assert_eq!(
        String::from_utf8_lossy(&encoder.encode(&buffer, None)),
        "\x1b[?2026h\x1b[H\x1b[91mab c\x1b[m\x1b[?2026l"
    );
}

#[test]
fn the_cursor_is_hidden_unless_it_has_a_place() {
    let (mut encoder, mut parser) = (Encoder::new(), Terminals::new(8, 2));
    let mut buffer = lines(&["        ", ":dt     "]);
    parser.process(&encoder.encode(&buffer, None));
    parser.assert_cursor(None);
    parser.process(&encoder.encode(&buffer, Some(Position::new(3, 1))));
    parser.assert_cursor(Some((3, 1)));
    buffer[(0, 0)].set_char('x');
    parser.process(&encoder.encode(&buffer, Some(Position::new(3, 1))));
    parser.assert_cursor(Some((3, 1))); // drawing moved it, so it is put back
    assert_eq!(encoder.encode(&buffer, Some(Position::new(3, 1))), b"", "nothing to move");
    parser.process(&encoder.encode(&buffer, None));
    parser.assert_cursor(None);
}

#[test]
fn no_output_holds_a_control_character_of_a_cell() {
    let mut buffer = lines(&["abc"]);
    for bell in ["\u{7}", "a\u{1b}[2J", "\u{9b}"] {
        buffer[(1, 0)].set_symbol(bell);
        assert_eq!(text(&buffer), "a c\n");
        assert_eq!(ansi(&buffer), "a c\n");
        assert!(!svg(&buffer).contains(bell));
        assert!(String::from_utf8_lossy(&Encoder::new().encode(&buffer, None)).ends_with("a c\x1b[?2026l"));
    }
}

#[test]
fn text_leaves_out_blanks_at_line_ends_only() {
    assert_eq!(text(&lines(&["  a b   ", "        ", "あb      "])), "  a b\n\nあb\n");
}

#[test]
fn coloured_text_ends_each_line_in_the_default_style() {
    let mut buffer = lines(&["ab  ", "cd  "]);
    buffer.set_style(Rect::new(0, 0, 2, 1), Style::new().fg(Color::Green).add_modifier(Modifier::BOLD));
    assert_eq!(ansi(&buffer), "\x1b[1;32mab\x1b[m\ncd\n");
}

#[test]
fn an_image_escapes_its_text_and_names_itself() {
    let image = svg(&lines(&["a<b & \"c\"", "⠁▀"]));
    assert!(image.contains("<title id=\"title\">Carom: a&lt;b &amp; &quot;c&quot;</title>"), "{image}");
    assert!(image.contains("viewBox=\"0 0 90 40\""), "{image}");
    // The dot of ⠁ is in the upper left of its cell; ▀ fills the upper half of the cell beside it.
    assert!(image.contains("M2.5 22.5h.01"), "{image}");
    assert!(image.contains("M10 20h10v10h-10z"), "{image}");
}

#[test]
fn buffers_of_no_size_are_no_trouble() {
    for size in [(0, 0), (3, 0), (0, 3)] {
        let buffer = Buffer::empty(Rect::new(0, 0, size.0, size.1));
        let _ = (text(&buffer), ansi(&buffer), svg(&buffer), Encoder::new().encode(&buffer, None));
    }
}
