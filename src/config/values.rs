//! Ranges as types: a value that exists is allowed.

use std::{error::Error, fmt};

use serde::Deserialize;

use super::settings::FASTEST;
use crate::{
    format::number,
    printable::{described, is_printable},
    scene::quote,
    view::{Colors, Ink, MOST_TURNS, Marker},
};

/// Longest path, characters.
const LONGEST: usize = 1000;

/// The word for what the terminal decides.
const AUTO: &str = "auto";

/// The markers by name, as on the command line.
pub(super) const MARKERS: [(&str, Marker); 3] =
    [("braille", Marker::Braille), ("block", Marker::Block), ("ascii", Marker::Ascii)];

/// The depths of colour by name, as on the command line.
pub(super) const DEPTHS: [(&str, Colors); 4] =
    [("never", Colors::Never), ("16", Colors::Ansi16), ("256", Colors::Ansi256), ("rgb", Colors::Rgb)];

/// The terminal's own colours by name, in the order of their numbers.
pub(super) const INKS: [&str; 16] = [
    "black",
    "red",
    "green",
    "yellow",
    "blue",
    "magenta",
    "cyan",
    "white",
    "bright-black",
    "bright-red",
    "bright-green",
    "bright-yellow",
    "bright-blue",
    "bright-magenta",
    "bright-cyan",
    "bright-white",
];

/// A name or path, fit to be printed.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct Word(pub(super) String);

impl TryFrom<String> for Word {
    type Error = String;

    fn try_from(text: String) -> Result<Word, String> {
        if let Some(c) = text.chars().find(|c| !is_printable(*c)) {
            let what = described(c);
            return Err(format!("the character {what} is refused; allowed is text of characters that can be seen"));
        }
        match text.chars().count() {
            0 => Err("an empty text is refused; allowed is the name of a built-in scene, or a path".into()),
            count if count > LONGEST => {
                Err(format!("a text of {count} characters is refused; allowed are up to {LONGEST}"))
            }
            _ => Ok(Word(text)),
        }
    }
}

/// The value of a name, `None` for `auto`.
fn named<T: Copy>(name: &str, known: &[(&str, T)]) -> Result<Option<T>, String> {
    if name == AUTO {
        return Ok(None);
    }
    let names = || [AUTO].into_iter().chain(known.iter().map(|(name, _)| *name)).map(quote).collect::<Vec<_>>();
    let found = known.iter().find(|(known, _)| *known == name).map(|(_, value)| Some(*value));
    found.ok_or_else(|| format!("{} is refused; allowed are {}", quote(name), names().join(", ")))
}

/// A marker.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct Dots(pub(super) Option<Marker>);

impl TryFrom<String> for Dots {
    type Error = String;

    fn try_from(name: String) -> Result<Dots, String> {
        named(&name, &MARKERS).map(Dots)
    }
}

/// A depth of colour.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct ColorDepth(pub(super) Option<Colors>);

impl TryFrom<String> for ColorDepth {
    type Error = String;

    fn try_from(name: String) -> Result<ColorDepth, String> {
        named(&name, &DEPTHS).map(ColorDepth)
    }
}

/// Pictures per second.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "f64")]
pub(super) struct Rate(pub(super) u32);

impl TryFrom<f64> for Rate {
    type Error = String;

    fn try_from(value: f64) -> Result<Rate, String> {
        if value % 1.0 == 0.0 && (1.0..=f64::from(FASTEST)).contains(&value) {
            Ok(Rate(value as u32))
        } else {
            Err(format!("{} is refused; allowed is a whole number from 1 to {FASTEST}", number(value)))
        }
    }
}

/// Bytes per second.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct Bandwidth(pub(super) Option<u64>);

impl TryFrom<String> for Bandwidth {
    type Error = String;

    fn try_from(text: String) -> Result<Bandwidth, String> {
        if text == UNLIMITED {
            return Ok(Bandwidth(None));
        }
        let bytes = bandwidth(&text).map(|bytes| Bandwidth(Some(bytes)));
        bytes.map_err(|said| format!("{} is refused; it {said}, or {}", quote(&text), quote(UNLIMITED)))
    }
}

/// The bandwidth of a line of which nothing is spared.
pub(super) const UNLIMITED: &str = "unlimited";

/// A text that is no bandwidth; it prints what is allowed, a sentence without its subject.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoBandwidth;

impl fmt::Display for NoBandwidth {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("must be a whole number of bytes per second from 1, such as 64k or 2M")
    }
}

impl Error for NoBandwidth {}

/// Bytes per second: a whole number from 1, k for thousands, M for millions.
///
/// # Errors
/// The text is no such number.
pub fn bandwidth(text: &str) -> Result<u64, NoBandwidth> {
    let (digits, unit) = match text.as_bytes().last() {
        Some(b'k' | b'K') => (&text[..text.len() - 1], 1_000),
        Some(b'm' | b'M') => (&text[..text.len() - 1], 1_000_000),
        _ => (text, 1),
    };
    let whole = digits.bytes().all(|byte| byte.is_ascii_digit()).then(|| digits.parse::<u64>().ok()).flatten();
    let bytes = whole.and_then(|count| count.checked_mul(unit)).filter(|bytes| *bytes > 0);
    bytes.ok_or(NoBandwidth)
}

/// A colour; `None`: chosen by the background.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct InkName(pub(super) Option<Ink>);

impl TryFrom<String> for InkName {
    type Error = String;

    fn try_from(name: String) -> Result<InkName, String> {
        match name.as_str() {
            AUTO => Ok(InkName(None)),
            name => ink(name).map(|ink| InkName(Some(ink))),
        }
    }
}

fn ink(name: &str) -> Result<Ink, String> {
    if name == "text" {
        return Ok(Ink::Text);
    }
    if let Some(number) = INKS.iter().position(|known| *known == name) {
        return Ok(Ink::Ansi(number as u8));
    }
    let digits = name.strip_prefix('#').filter(|digits| digits.len() == 6);
    let digits = digits.filter(|digits| digits.bytes().all(|byte| byte.is_ascii_hexdigit()));
    match digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()) {
        Some(rgb) => Ok(Ink::Rgb((rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8)),
        None => Err(format!(
            "{} is refused; allowed are {}, text, {AUTO}, or #rrggbb with hexadecimal digits",
            quote(name),
            INKS.join(", ")
        )),
    }
}

/// Colours that spheres take in turn; none: chosen by the background.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "Vec<InkName>")]
pub(super) struct InkNames(pub(super) [Option<Ink>; MOST_TURNS]);

impl TryFrom<Vec<InkName>> for InkNames {
    type Error = String;

    fn try_from(names: Vec<InkName>) -> Result<InkNames, String> {
        let mut inks = [None; MOST_TURNS];
        if names.len() > MOST_TURNS {
            return Err(format!("a list of {} colours is refused; allowed are up to {MOST_TURNS}", names.len()));
        }
        for (place, name) in inks.iter_mut().zip(names) {
            let ink = name.0.ok_or(format!("{AUTO} is refused in a list; an empty list leaves the choice to carom"))?;
            *place = Some(ink);
        }
        Ok(InkNames(inks))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bandwidth_is_in_bytes_per_second() {
        for (text, bytes) in [("64k", 64_000), ("64K", 64_000), ("2M", 2_000_000), ("1", 1), ("007k", 7_000)] {
            assert_eq!(bandwidth(text), Ok(bytes), "{text}");
        }
        for refused in
            ["", "0", "0k", "k", "-1", "+1", "1.5k", "64 k", "64kb", "1G", "1e3", "99999999999999999999", "é"]
        {
            assert!(bandwidth(refused).is_err(), "{refused:?} is no bandwidth");
        }
    }

    #[test]
    fn colours_have_names_or_six_digits() {
        assert_eq!(ink("bright-blue"), Ok(Ink::Ansi(12)));
        assert_eq!(ink("text"), Ok(Ink::Text));
        assert_eq!(ink("#0aFf10"), Ok(Ink::Rgb(10, 255, 16)));
        for refused in ["", "#", "#12345", "#1234567", "#+12345", "#12345é", "Red", "12", "\u{1b}[31m"] {
            assert!(ink(refused).is_err_and(|said| said.chars().all(is_printable)), "{refused:?} is no colour");
        }
    }
}
