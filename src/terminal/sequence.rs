//! Which key a complete control sequence (CSI) is, if it is one. What is no key is a reply, or unknown, and presses none.

use crate::app::{Code, Key};

/// Modifiers that change what a key does.
const SHIFT: u32 = 1;
const ALT: u32 = 2;
const CTRL: u32 = 4;
/// Super, Hyper and Meta: keys of the desktop, bound to nothing here.
const FOREIGN: u32 = 8 | 16 | 32;
/// Caps Lock and Num Lock are reported, but change nothing.
const LOCKS: u32 = 64 | 128;

/// The private use area, where extended protocols number the keys that type nothing.
const FUNCTIONAL: std::ops::RangeInclusive<u32> = 0xe000..=0xf8ff;

/// The key of `CSI parameters last`, by the legacy forms, xterm's `modifyOtherKeys` and the `CSI u` protocols.
pub(super) fn key(parameters: &[u8], last: u8) -> Option<Key> {
    if parameters == b"[" {
        // The Linux console's first five function keys.
        return matches!(last, b'A'..=b'E').then(|| Key::plain(Code::F(1 + last - b'A')));
    }
    let parameters = str::from_utf8(parameters).ok()?;
    if !parameters.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b';' | b':')) {
        return None; // private parameters and intermediate bytes: replies
    }
    let fields: Vec<&str> = parameters.split(';').collect();
    match (last, fields.as_slice()) {
        (b'~', ["27", modifiers, code]) => character(number(code)?, pressed_with(modifiers)?),
        (b'~', [code]) => with(tilde(number(code)?)?, 0),
        (b'~', [code, modifiers]) => with(tilde(number(code)?)?, pressed_with(modifiers)?),
        (b'u', [codes]) => coded(codes, 0),
        (b'u', [codes, modifiers] | [codes, modifiers, _]) => coded(codes, pressed_with(modifiers)?),
        (_, ["" | "1"]) => with(lettered(last)?, 0),
        (_, ["1", modifiers]) => with(lettered(last)?, pressed_with(modifiers)?),
        _ => None,
    }
}

/// The key of the single-shift sequence `ESC O last`.
pub(super) fn single_shift(last: u8) -> Option<Key> {
    match last {
        b'M' => Some(Key::plain(Code::Enter)), // of the keypad
        b'R' => Some(Key::plain(Code::F(3))),
        b'Z' => None,
        _ => lettered(last).map(Key::plain),
    }
}

fn number(text: &str) -> Option<u32> {
    text.parse().ok()
}

/// The modifiers of a field `modifiers[:event]`, one added to them; none if a key was released, which presses nothing,
/// or if the field is no such thing: a key is not pressed without the modifiers that it has.
fn pressed_with(field: &str) -> Option<u32> {
    let (modifiers, event) = field.split_once(':').unwrap_or((field, "1"));
    let known = SHIFT | ALT | CTRL | FOREIGN | LOCKS;
    let modifiers = if modifiers.is_empty() { 0 } else { number(modifiers)?.checked_sub(1)? };
    (matches!(event, "" | "1" | "2") && modifiers & !known == 0).then_some(modifiers & !LOCKS)
}

/// A key that types nothing, pressed with modifiers.
fn with(code: Code, modifiers: u32) -> Option<Key> {
    let has = |modifier| modifiers & modifier != 0;
    let shift = has(SHIFT) || code == Code::Tab && modifiers == 0; // its own letter is back-tab's
    (!has(FOREIGN)).then_some(Key { code, ctrl: has(CTRL), shift, alt: has(ALT) })
}

fn lettered(last: u8) -> Option<Code> {
    Some(match last {
        b'A' => Code::Up,
        b'B' => Code::Down,
        b'C' => Code::Right,
        b'D' => Code::Left,
        b'F' => Code::End,
        b'H' => Code::Home,
        b'P' => Code::F(1),
        b'Q' => Code::F(2),
        b'S' => Code::F(4), // F3 would be R, which is a report of the cursor's place
        b'Z' => Code::Tab,
        _ => return None,
    })
}

fn tilde(code: u32) -> Option<Code> {
    let function = |first: u32, number: u8| Some(Code::F(number + (code - first) as u8));
    match code {
        1 | 7 => Some(Code::Home),
        3 => Some(Code::Delete),
        4 | 8 => Some(Code::End),
        5 => Some(Code::PageUp),
        6 => Some(Code::PageDown),
        11..=15 => function(11, 1),
        17..=21 => function(17, 6),
        23..=24 => function(23, 11),
        _ => None,
    }
}

/// The key of `CSI key[:shifted[:base]] ; modifiers u`.
fn coded(codes: &str, modifiers: u32) -> Option<Key> {
    let mut codes = codes.split(':');
    let code = number(codes.next()?)?;
    match codes.next().and_then(number) {
        Some(shifted) if modifiers & (SHIFT | CTRL) == SHIFT => character(shifted, modifiers),
        _ => character(code, modifiers),
    }
}

/// The key that types the character of that code, or the key of that number.
fn character(code: u32, modifiers: u32) -> Option<Key> {
    let plain = match code {
        9 if modifiers == 0 => return Some(Key::plain(Code::Tab)),
        9 => Code::Tab,
        13 | 57414 => Code::Enter,
        27 => Code::Escape,
        127 | 8 => Code::Backspace,
        57417 => Code::Left,
        57418 => Code::Right,
        57419 => Code::Up,
        57420 => Code::Down,
        57421 => Code::PageUp,
        57422 => Code::PageDown,
        57423 => Code::Home,
        57424 => Code::End,
        57426 => Code::Delete,
        _ => return typed(keypad(code)?, modifiers),
    };
    with(plain, modifiers)
}

/// The character of a code; the keys of the keypad type theirs.
fn keypad(code: u32) -> Option<char> {
    match code {
        57399..=57408 => char::from_digit(code - 57399, 10),
        57409..=57413 => ['.', '/', '*', '-', '+'].get(code as usize - 57409).copied(),
        57415 => Some('='),
        57416 => Some(','),
        code if FUNCTIONAL.contains(&code) => None,
        code => char::from_u32(code).filter(|c| !c.is_control()),
    }
}

fn typed(c: char, modifiers: u32) -> Option<Key> {
    let has = |modifier| modifiers & modifier != 0;
    // With Ctrl or Alt, Shift makes another key of it: Ctrl-Shift-C copies.
    if has(FOREIGN) || has(CTRL) && has(SHIFT) {
        return None;
    }
    // Some protocols name the letter on the key, others the one that is typed.
    let c = if has(SHIFT) { c.to_ascii_uppercase() } else { c };
    Some(Key { code: Code::Char(c), ctrl: has(CTRL), shift: false, alt: has(ALT) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The key of a sequence written without its introducer.
    fn of(sequence: &str) -> Option<Key> {
        let (last, parameters) = sequence.as_bytes().split_last().expect("a last byte");
        key(parameters, *last)
    }

    #[test]
    fn the_forms_of_a_key_are_one_key() {
        for up in ["A", "1A", "1;1A", "1;1:1A", "1;1:2A", "1;65A", "57419u", "57419;129u"] {
            assert_eq!(of(up), Some(Key::plain(Code::Up)), "{up}");
        }
        for help in ["63;2u", "47:63;2u", "27;2;63~", "63u"] {
            assert_eq!(of(help), Some(Key::char('?')), "{help}");
        }
        for quit in ["113u", "113;1u", "113;1:1u", "113;129u", "113;65u", "27;1;113~", "113;1;113u"] {
            assert_eq!(of(quit), Some(Key::char('q')), "{quit}");
        }
        for end in ["99;5u", "27;5;99~", "99;133u"] {
            assert_eq!(of(end), Some(Key::ctrl('c')), "{end}");
        }
        for back in ["Z", "1;2Z", "9;2u", "27;2;9~"] {
            assert_eq!(of(back), Some(Key::shift(Code::Tab)), "{back}");
        }
        assert_eq!(of("[A"), Some(Key::plain(Code::F(1))));
        assert_eq!(of("24~"), Some(Key::plain(Code::F(12))));
        assert_eq!(of("1;2D"), Some(Key::shift(Code::Left)));
    }

    #[test]
    fn with_super_hyper_or_meta_and_when_released_a_key_is_none() {
        for bit in 3..6 {
            let modifiers = 1 + (1 << bit);
            for (before, after) in
                [("113;", "u"), ("27;", ";113~"), ("1;", "C"), ("3;", "~"), ("99;", "u"), ("9;", "u")]
            {
                for locks in [0, 64, 128, 192] {
                    let sequence = format!("{before}{}{after}", modifiers + locks);
                    assert_eq!(of(&sequence), None, "{sequence}");
                }
            }
        }
        for other in
            ["113;1:3u", "113;257u", "113;256u", "113;4294967296u", "113;xu", "113;0u", "99;6u", "57441u", "1;1:3A"]
        {
            assert_eq!(of(other), None, "{other}");
        }
        assert_eq!(of("113;2u"), Some(Key::char('Q')), "Shift-q");
        assert_eq!(of("113;3u"), Some(Key { alt: true, ..Key::char('q') }), "Alt-q");
    }

    #[test]
    fn replies_are_no_keys() {
        let replies = [
            "0n",
            "3n",
            "?997;1n",
            "24;80R",
            "1;1R",
            "?1;1R",
            "?62;22c",
            ">0;276;0c",
            "=1c",
            "?2026;2$y",
            "4;2$y",
            "8;24;80t",
            "4;600;800t",
            "?1;0;256S",
            "?1u",
            "?31u",
            "<0;1;1M",
            "<0;1;1m",
            "32;1;1M",
            "I",
            "O",
            "2 q",
            "99z",
            "2;3H",
            "0H",
            "1;2;3A",
            "4;1F",
            "~",
            ";~",
            "u",
            ":u",
        ];
        for reply in replies {
            assert_eq!(of(reply), None, "{reply}");
        }
    }
}
