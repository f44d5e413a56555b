//! What comes of bytes, however they are torn.

use super::{
    super::paste::{ENDS, KEPT},
    *,
};
use crate::app::{Gesture, Mouse};
use proptest::{prelude::ProptestConfig, test_runner::RngSeed};

/// A decoder fed piece by piece, with silence as long as the escape time-out between.
fn torn(pieces: &[&[u8]]) -> Decoder {
    let mut decoder = Decoder::new(Duration::from_millis(25));
    for (i, piece) in pieces.iter().enumerate() {
        if i > 0 && decoder.patience().is_some_and(|patience| patience <= decoder.escape_time) {
            decoder.silence();
        }
        decoder.feed(piece);
    }
    decoder
}

/// What comes of it when there is silence after that.
fn end(mut decoder: Decoder) -> Vec<Input> {
    while decoder.patience().is_some() {
        decoder.silence();
    }
    decoder.inputs
}

fn decode(bytes: &[u8]) -> Vec<Input> {
    end(torn(&[bytes]))
}

fn bytewise(bytes: &[u8]) -> Vec<Input> {
    end(torn(&bytes.chunks(1).collect::<Vec<_>>()))
}

fn keys(keys: &[Key]) -> Vec<Input> {
    keys.iter().copied().map(Input::Key).collect()
}

const ESC: Key = Key::plain(Code::Escape);
const RIGHT: Key = Key::plain(Code::Right);

#[test]
fn keys_arrive_as_the_key_table_names_them() {
    let expected = [
        Key::char('R'),
        Key::char(' '),
        Key::ctrl('c'),
        Key::shift(Code::Tab),
        Key::shift(Code::Left),
        Key::plain(Code::F(1)),
        Key::plain(Code::Home),
        Key::plain(Code::Enter),
        Key::char('é'),
    ];
    assert_eq!(decode("R \x03\x1b[Z\x1b[1;2D\x1bOP\x1b[H\ré".as_bytes()), keys(&expected));
    assert_eq!(decode("\x1bq\x1bé".as_bytes()), keys(&['q', 'é'].map(|c| Key { alt: true, ..Key::char(c) })));
    assert_eq!(decode(b"\x1b\x1b[A"), keys(&[ESC, Key::plain(Code::Up)]));
}

#[test]
fn a_torn_key_is_that_key_wherever_it_is_torn() {
    assert_eq!(end(torn(&[b"\x1b[", b"C"])), keys(&[RIGHT]));
    assert_eq!(end(torn(&[b"\x1b[1;", b"2D"])), keys(&[Key::shift(Code::Left)]));
    assert_eq!(end(torn(&[b"\x1b[1;2", b"D"])), keys(&[Key::shift(Code::Left)]));
    assert_eq!(end(torn(&[b"\x1bO", b"P"])), keys(&[Key::plain(Code::F(1))]));
    assert_eq!(end(torn(&[b"\xc3", b"\xa9q"])), keys(&[Key::char('q')]), "half a character is none");
    // After a lone escape the time-out has made a key of it already.
    for bytes in [&b"\x1b[C"[..], b"\x1b[1C", b"\x1b[1;1C"] {
        assert_eq!(bytewise(bytes), keys(&[ESC, RIGHT]), "{bytes:?}");
        assert_eq!(end(torn(&[&bytes[..1], &bytes[1..]])), keys(&[ESC, RIGHT]), "{bytes:?}");
    }
    assert_eq!(end(torn(&[b"\x1b", b"OC"])), keys(&[ESC, RIGHT]));
}

#[test]
fn keys_after_an_escape_or_a_torn_sequence_are_keys() {
    assert_eq!(decode(b"\x1b"), keys(&[ESC]));
    assert_eq!(end(torn(&[b"\x1b", b"["])), keys(&[ESC, Key::char('[')]), "late, but it comes");
    for key in "]OPX_^qoC?:".chars() {
        let mut bytes = [0; 4];
        let typed = key.encode_utf8(&mut bytes).as_bytes();
        assert_eq!(end(torn(&[b"\x1b", typed])), keys(&[ESC, Key::char(key)]), "Esc {key}");
        assert_eq!(end(torn(&[b"\x1b", b"[", typed])).len(), if "CP".contains(key) { 2 } else { 3 }, "Esc [ {key}");
    }
    for begun in ["\x1b[", "\x1b[?9", "\x1b[12", "\x1b[1;", "\x1bO", "\x1bX\x1b", "\x1b[M "] {
        for key in "?qo: ]".chars() {
            let mut bytes = [0; 4];
            let typed = key.encode_utf8(&mut bytes).as_bytes();
            assert_eq!(end(torn(&[begun.as_bytes(), typed])), keys(&[Key::char(key)]), "{begun:?} {key}");
        }
    }
}

#[test]
fn strings_and_replies_press_no_key_at_once_and_byte_by_byte() {
    let strings =
        ["\x1bXq\x1b\\", "\x1b_q:q\x1b\\", "\x1b^q\x1b\\", "\x1bPq\x18", "\x1bP1$rq\x1b\\", "\x1bXq\x07q\x1a"];
    assert_eq!(decode(b"\x1b]0;\x1b]0;q\x07?"), keys(&[Key::char('?')]), "one string cut off by another");
    let more = ["\x1b]11;rgb:00/00/00\x07", "\x1b]q\x1b\\", "\x1bXé\u{9c}q\x1b\\"];
    for string in strings.iter().chain(&more) {
        for after in ["", "?"] {
            let expected = keys(&after.chars().map(Key::char).collect::<Vec<_>>());
            let bytes = [string.as_bytes(), after.as_bytes()].concat();
            assert_eq!(decode(&bytes), expected, "{string:?}");
            let (begun, payload) = bytes.split_at(2);
            let pieces: Vec<&[u8]> = std::iter::once(begun).chain(payload.chunks(1)).collect();
            assert_eq!(end(torn(&pieces)), expected, "{string:?} byte by byte");
        }
    }
    for reply in ["\x1b[?2026;2$y", "\x1b[0n", "\x1b[?62;22c", "\x1b[99z", "\x1b[24;80R", "\x1b[Mq!!"] {
        assert_eq!(decode(format!("{reply}?").as_bytes()), keys(&[Key::char('?')]), "{reply:?}");
        for at in 2..reply.len() {
            let (begun, rest) = reply.as_bytes().split_at(at);
            let known = !matches!(*reply.as_bytes().last().unwrap_or(&0), b'z' | b'!');
            assert!(!known || end(torn(&[begun, rest])).is_empty(), "{reply:?} torn at {at}");
        }
    }
}

#[test]
fn an_answer_is_told_wherever_it_is_torn() {
    let answer = b"\x1b[?62;22c";
    for at in 1..answer.len() {
        let decoder = torn(&[&answer[..at], &answer[at..]]);
        assert_eq!(decoder.replies, [Reply::Attributes], "torn at {at}");
    }
    assert_eq!(torn(&[b"\x1b[?1;2c\x1b[?6c"]).replies, [Reply::Attributes; 2]);
    for other in ["\x1b[>1;10;0c", "\x1b[0n", "\x1b[c", "\x1bP?62c\x1b\\", "\x1b[200~\x1b[?62c\x1b[201~"] {
        assert_eq!(torn(&[other.as_bytes()]).replies, [], "{other:?}");
    }
}

#[test]
fn an_escape_or_silence_gives_an_endless_string_up() {
    let mut decoder = torn(&[b"\x1bXabc", b"\x1b", b"q"]);
    assert_eq!(decoder.inputs, keys(&[Key::char('q')]));
    decoder.feed(b"\x1b_abc");
    assert_eq!(decoder.patience(), Some(STRING_PAUSE));
    decoder.silence();
    decoder.feed(b"r");
    assert_eq!(decoder.inputs, keys(&[Key::char('q'), Key::char('r')]));
}

#[test]
fn ctrl_c_is_pressed_whatever_was_begun() {
    let begun = [
        "",
        "\x1b",
        "\x1b[",
        "\x1b[1;",
        "\x1bO",
        "\x1bX",
        "\x1bPq",
        "\x1b]0;",
        "\x1b]0;\x1b",
        "\x1b[M",
        "\u{e9}",
        "\x1b[200~q",
    ];
    for begun in begun.iter().map(|begun| begun.as_bytes()).chain([&b"\xc3"[..], b"\x1b[200~q\x1b[20"]) {
        assert_eq!(decode(&[begun, b"\x03"].concat()).last(), Some(&Input::Key(Key::ctrl('c'))), "{begun:?}");
        assert_eq!(end(torn(&[begun, b"\x03"])).last(), Some(&Input::Key(Key::ctrl('c'))), "{begun:?} torn");
    }
    let flood = [b"\x1b[200~q\x03", &[b'x'; 2 * KEPT][..]].concat();
    assert_eq!(torn(&[&flood]).inputs, keys(&[Key::ctrl('c')]), "without a pause in a paste that does not end");
}

#[test]
fn a_paste_is_one_input_whatever_is_in_it() {
    let expected = vec![Input::Paste("q\u{1b}[20x\u{3}y".into()), Input::Key(Key::char('r'))];
    assert_eq!(decode(b"\x1b[200~q\x1b[20x\x03y\x1b[201~r"), expected);
    let huge = [b"\x1b[200~", &[b'x'; 3 * KEPT][..], ENDS].concat();
    assert_eq!(decode(&huge), [Input::Paste("x".repeat(KEPT))]);
}

proptest::proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(5), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_bytes_make_it_panic_or_wait_for_ever(bytes: Vec<u8>) {
        decode(&bytes);
        bytewise(&bytes);
    }

    #[test]
    fn no_sequence_makes_it_panic(tail in "[\\[\\]OP][0-9;:<>?A-Za-z~$ ]{0,12}") {
        decode(format!("\x1b{tail}").as_bytes());
    }

    #[test]
    fn no_private_sequence_presses_a_key(middle in "[<=>?][0-9;:]{0,80}[ $\"'!]{0,2}", last in "[@-~]") {
        proptest::prop_assert_eq!(decode(format!("\x1b[{middle}{last}").as_bytes()), []);
    }

    #[test]
    fn no_payload_presses_a_key(kind in "[PX^_\\]]", payload in "[ -~é]{0,40}", last in "\x1b\\\\|\x18|\x1a") {
        proptest::prop_assert_eq!(decode(format!("\x1b{kind}{payload}{last}").as_bytes()), []);
    }
}

#[test]
fn a_report_of_the_mouse_is_one_however_it_is_torn() {
    let report = b"\x1b[<0;12;7M";
    let pressed = Input::Mouse(Mouse { gesture: Gesture::Press, column: 11, row: 6 });
    for at in 3..report.len() {
        let (first, rest) = report.split_at(at);
        assert_eq!(end(torn(&[first, rest])), std::slice::from_ref(&pressed), "torn after {at}");
    }
    assert_eq!(end(torn(&[b"\x1b[<0;1", b"q"])).last(), Some(&Input::Key(Key::char('q'))), "given up");
}
