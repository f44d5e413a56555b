//! Reports of the mouse, in the form that has no end at column 223 (SGR, DEC private mode 1006).

use crate::app::{Gesture, Mouse};

/// Asks for reports: buttons and motion while one is pressed.
pub(super) const ON: &[u8] = b"\x1b[?1002h\x1b[?1006h";

/// Asks for no reports.
pub(super) const OFF: &[u8] = b"\x1b[?1006l\x1b[?1002l";

/// Bits of the button's number.
const MODIFIERS: u32 = 4 | 8 | 16;
const MOTION: u32 = 32;
const WHEEL: u32 = 64;

/// The report that is the control sequence `CSI parameters last`, if it is one that says something here. A place beyond
/// what a screen can have is its last column or row.
pub(super) fn mouse(parameters: &[u8], last: u8) -> Option<Mouse> {
    let parameters = str::from_utf8(parameters.strip_prefix(b"<")?).ok()?;
    let mut numbers = parameters.split(';').map(number);
    let (button, column, row) = (numbers.next()??, numbers.next()??, numbers.next()??);
    if numbers.next().is_some() {
        return None;
    }
    let place = |count: u32| Some(u16::try_from(count.checked_sub(1)?).unwrap_or(u16::MAX));
    let gesture = match (button & !MODIFIERS, last) {
        (0, b'M') => Gesture::Press,
        (0, b'm') => Gesture::Release,
        (MOTION, b'M') => Gesture::Drag,
        (WHEEL, b'M') => Gesture::WheelUp,
        (65, b'M') => Gesture::WheelDown,
        _ => return None,
    };
    Some(Mouse { gesture, column: place(column)?, row: place(row)? })
}

/// A number of any length; beyond all numbers it is the largest.
fn number(text: &str) -> Option<u32> {
    let digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    digits.then(|| text.parse().unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(sequence: &str) -> Option<Mouse> {
        let (last, parameters) = sequence.as_bytes().split_last().expect("a last byte");
        mouse(parameters, *last)
    }

    #[test]
    fn reports_are_read_whatever_modifiers_are_held() {
        let at = |gesture, column, row| Some(Mouse { gesture, column, row });
        assert_eq!(of("<0;1;1M"), at(Gesture::Press, 0, 0));
        assert_eq!(of("<28;80;24m"), at(Gesture::Release, 79, 23));
        assert_eq!(of("<32;300;5M"), at(Gesture::Drag, 299, 4));
        assert_eq!((of("<64;2;3M"), of("<81;2;3M")), (at(Gesture::WheelUp, 1, 2), at(Gesture::WheelDown, 1, 2)));
    }

    #[test]
    fn places_beyond_all_screens_are_the_last_and_nonsense_is_nothing() {
        let at = |gesture, column, row| Some(Mouse { gesture, column, row });
        assert_eq!(of("<0;99999999999999999999;65537M"), at(Gesture::Press, u16::MAX, u16::MAX));
        for nonsense in [
            "<0;0;1M",
            "<0;1;0M",
            "<0;1M",
            "<0;1;1;1M",
            "<;;M",
            "<M",
            "<-1;1;1M",
            "<0;1;1z",
            "0;1;1M",
            "?0;1;1M",
            "<1;1;1M",
            "<35;1;1M",
            "<66;1;1M",
            "<128;1;1M",
            "<99999999999999999999;1;1M",
        ] {
            assert_eq!(of(nonsense), None, "{nonsense}");
        }
    }
}
