//! What a terminal answers when it is asked.

/// Asks a terminal what it is (primary device attributes): the request that nearly every one answers, in its turn, when
/// all that was sent before is on the screen.
pub(super) const REQUEST: &[u8] = b"\x1b[c";

/// Longest string that may hold an answer, bytes.
pub(super) const LONGEST: usize = 128;

/// A reply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reply {
    /// The answer to [`REQUEST`].
    Attributes,
    /// The column of the cursor, from 1.
    Column(u16),
    /// The terminal shows colours of 24 bits.
    TrueColor,
    /// The background.
    Background {
        /// Whether the background is light.
        light: bool,
    },
    /// Whether the terminal knows synchronized updates.
    Synchronized(bool),
}

/// The reply that is the control sequence `CSI parameters last`, if it is one.
pub(super) fn reply(parameters: &[u8], last: u8) -> Option<Reply> {
    match (parameters, last) {
        ([b'?', ..], b'c') => Some(Reply::Attributes),
        (_, b'R') => {
            let (row, column) = str::from_utf8(parameters).ok()?.split_once(';')?;
            row.parse::<u16>().ok()?;
            column.parse().ok().map(Reply::Column)
        }
        (_, b'y') => match parameters.strip_prefix(b"?2026;")? {
            b"1$" | b"2$" | b"3$" => Some(Reply::Synchronized(true)),
            b"0$" | b"4$" => Some(Reply::Synchronized(false)),
            _ => None,
        },
        _ => None,
    }
}

/// The reply that is the string `ESC kind payload`, if it is one.
pub(super) fn string(kind: u8, payload: &[u8]) -> Option<Reply> {
    let text = str::from_utf8(payload).ok()?;
    match kind {
        b']' => background(text.strip_prefix("11;")?),
        b'P' => {
            let sgr = |text: &str| {
                let text = text.replace(':', ";").replace(";;", ";");
                text.contains("48;2;1;2;3") || text.contains("48;2;0;1;2;3") // some name the colour space, too
            };
            let described = text.to_ascii_lowercase().starts_with("1+r524742");
            let made = text.strip_prefix("1$r").and_then(|text| text.strip_suffix('m'));
            (described || made.is_some_and(sgr)).then_some(Reply::TrueColor)
        }
        _ => None,
    }
}

/// A colour as X11 writes it, `rgb:ffff/ffff/ffff` with 1 to 4 digits each, or as `#rrggbb`.
fn background(text: &str) -> Option<Reply> {
    let channels: Vec<&str> = match text.split_once(':') {
        Some(("rgb" | "rgba", channels)) => channels.split('/').take(3).collect(),
        _ => {
            let digits = text.strip_prefix('#').filter(|digits| digits.is_ascii() && digits.len() % 3 == 0)?;
            let length = digits.len() / 3;
            (0..3).filter_map(|i| digits.get(i * length..(i + 1) * length)).collect()
        }
    };
    let part = |digits: &&str| {
        let most = (1_u32 << (4 * digits.len().clamp(1, 4))) - 1;
        let value = u32::from_str_radix(digits, 16).ok().filter(|value| *value <= most)?;
        Some(f64::from(value) / f64::from(most))
    };
    let parts: Vec<f64> = channels.iter().filter_map(part).collect();
    let [r, g, b] = parts.try_into().ok()?;
    // By the eye's weights; half of white's signal is where black and white text are read equally well, or nearly.
    Some(Reply::Background { light: 0.299 * r + 0.587 * g + 0.114 * b > 0.5 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn control(sequence: &str) -> Option<Reply> {
        let (last, parameters) = sequence.as_bytes().split_last().expect("a last byte");
        reply(parameters, *last)
    }

    #[test]
    fn answers_are_told_from_what_is_none() {
        assert_eq!(control("?62;22c"), Some(Reply::Attributes));
        assert_eq!(control("1;2R"), Some(Reply::Column(2)));
        assert_eq!(control("?2026;2$y"), Some(Reply::Synchronized(true)));
        assert_eq!(control("?2026;0$y"), Some(Reply::Synchronized(false)));
        for other in
            [">0;276;0c", "R", ";R", "1R", "1;99999R", "?1;2R", "?2026;9$y", "?2027;2$y", "2026;2$y", "?2026$y"]
        {
            assert_eq!(control(other), None, "{other}");
        }
    }

    #[test]
    fn a_background_is_light_or_dark_in_every_spelling() {
        for (text, light) in [
            ("11;rgb:ffff/ffff/ffff", true),
            ("11;rgb:fdfd/f6f6/e3e3", true),
            ("11;rgb:ff/ff/ff", true),
            ("11;rgba:ffff/ffff/ffff/8000", true),
            ("11;#ffffff", true),
            ("11;rgb:0000/2b2b/3636", false),
            ("11;rgb:0/0/0", false),
            ("11;#1e1e2e", false),
        ] {
            assert_eq!(string(b']', text.as_bytes()), Some(Reply::Background { light }), "{text}");
        }
        for other in [
            "10;rgb:ffff/ffff/ffff",
            "11;?",
            "11;rgb:",
            "11;rgb:g/0/0",
            "11;rgb:1/2",
            "11;#12345",
            "11;#é12345",
            "11;rgb:fffff/0/0",
            "",
        ] {
            assert_eq!(string(b']', other.as_bytes()), None, "{other}");
        }
    }

    #[test]
    fn colours_of_24_bits_are_known_by_what_the_terminal_made_of_one() {
        for yes in [
            "1$r0;48:2:1:2:3m",
            "1$r48;2;1;2;3m",
            "1$r0;48:2::1:2:3m",
            "1$r48:2:0:1:2:3m",
            "1+r524742=382F382F38",
            "1+R524742",
        ] {
            assert_eq!(string(b'P', yes.as_bytes()), Some(Reply::TrueColor), "{yes}");
        }
        for no in ["1$r0m", "1$r0;48:5:16m", "0$r", "0+r524742", "1$r48:2:1:2:3", "", "\u{7f}"] {
            assert_eq!(string(b'P', no.as_bytes()), None, "{no}");
        }
        assert_eq!(string(b'X', b"1$r48:2:1:2:3m"), None);
    }
}
