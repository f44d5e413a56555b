//! What may be printed. Text from outside (names of files, values of options, scenes, the argument parser's messages)
//! passes through here before it reaches a terminal, a table or a picture, and nowhere else is it decided.

use std::ffi::OsStr;
use std::fmt::Write;
use std::io;

use unicode_properties::{GeneralCategory, UnicodeGeneralCategory};

/// Whether a character shows itself and nothing else: none that controls a terminal, turns the direction of its
/// neighbours, is invisible, or means nothing to Unicode.
pub fn is_printable(c: char) -> bool {
    if c.is_ascii() {
        return !c.is_ascii_control();
    }
    let silent = matches!(
        c.general_category(),
        GeneralCategory::Control
            | GeneralCategory::Format
            | GeneralCategory::LineSeparator
            | GeneralCategory::ParagraphSeparator
            | GeneralCategory::Surrogate
            | GeneralCategory::PrivateUse
            | GeneralCategory::Unassigned
    );
    !silent && !is_invisible(c)
}

/// The characters of other categories that Unicode says to leave out if they can't be shown (`Default_Ignorable`):
/// combining grapheme joiner, Hangul and Khmer fillers, variation selectors.
fn is_invisible(c: char) -> bool {
    matches!(
        c,
        '\u{34f}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}' | '\u{180b}'..='\u{180f}' | '\u{3164}'
            | '\u{fe00}'..='\u{fe0f}' | '\u{ffa0}' | '\u{e0100}'..='\u{e01ef}'
    )
}

/// The text with everything that is not printable spelled out: `\n`, `\u{202e}`.
pub fn escaped(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut shown, c| {
        push(&mut shown, c);
        shown
    })
}

/// The text with everything that is not printable spelled out, cut after about `limit` characters.
pub fn shortened(text: &str, limit: usize) -> String {
    let mut shown = String::new();
    let mut used = 0;
    for c in text.chars() {
        if used >= limit {
            shown.push('…');
            break;
        }
        used += if is_printable(c) { 1 } else { c.escape_default().len() };
        push(&mut shown, c);
    }
    shown
}

fn push(shown: &mut String, c: char) {
    if is_printable(c) {
        shown.push(c);
    } else {
        let _ = write!(shown, "{}", c.escape_default()); // a String takes everything
    }
}

/// The name of a file, or any word of the command line: what is not UTF-8 in it is spelled out byte by byte, `\xff`.
pub fn name(word: &OsStr) -> String {
    let mut shown = String::new();
    for chunk in word.as_encoded_bytes().utf8_chunks() {
        shown += &escaped(chunk.valid());
        chunk.invalid().iter().for_each(|byte| {
            let _ = write!(shown, "\\x{byte:02x}"); // a String takes everything
        });
    }
    shown
}

/// What an unprintable character is, in words: `U+200D (a zero-width joiner)`.
pub fn described(c: char) -> String {
    let what = match c {
        '\u{200b}' => "a zero-width space",
        '\u{200c}' => "a zero-width non-joiner",
        '\u{200d}' => "a zero-width joiner",
        '\u{ad}' => "a soft hyphen",
        '\u{feff}' => "a byte order mark",
        '\u{180b}'..='\u{180f}' | '\u{fe00}'..='\u{fe0f}' | '\u{e0100}'..='\u{e01ef}' => "a variation selector",
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => "a direction mark",
        c => match c.general_category() {
            GeneralCategory::Control => "a control character",
            GeneralCategory::Format => "a format character",
            GeneralCategory::LineSeparator | GeneralCategory::ParagraphSeparator => "a line break",
            GeneralCategory::PrivateUse => "a character for private use",
            GeneralCategory::Unassigned | GeneralCategory::Surrogate => "no character of Unicode",
            _ => "an invisible character",
        },
    };
    format!("U+{:04X} ({what})", c as u32)
}

/// The system's words for what went wrong, without Rust's `(os error N)`: one form for every message.
pub fn cause(error: &io::Error) -> String {
    let text = error.to_string();
    let numbered = text.rsplit_once(" (os error ").filter(|(_, number)| number.ends_with(')'));
    escaped(numbered.map_or(text.as_str(), |(words, _)| words))
}

#[cfg(test)]
mod tests {
    use std::os::unix::ffi::OsStrExt;

    use super::*;

    #[test]
    fn what_controls_hides_or_turns_is_spelled_out() {
        assert_eq!(escaped("a\u{1b}[2Jb\nc\u{9b}d\u{202e}é→"), "a\\u{1b}[2Jb\\nc\\u{9b}d\\u{202e}é→");
        let ranges = [
            0..=0x1f,
            0x7f..=0x9f,
            0xad..=0xad,
            0x34f..=0x34f,
            0x600..=0x605,
            0x61c..=0x61c,
            0x6dd..=0x6dd,
            0x70f..=0x70f,
            0x890..=0x891,
            0x8e2..=0x8e2,
            0x115f..=0x1160,
            0x17b4..=0x17b5,
            0x180b..=0x180f,
            0x200b..=0x200f,
            0x2028..=0x202e,
            0x2060..=0x206f,
            0x3164..=0x3164,
            0xe000..=0xe000,
            0xfe00..=0xfe0f,
            0xfeff..=0xfeff,
            0xffa0..=0xffa0,
            0xfff9..=0xfffb,
            0xfffe..=0xffff,
            0x110bd..=0x110bd,
            0x110cd..=0x110cd,
            0x13430..=0x1343f,
            0x1bca0..=0x1bca3,
            0x1d173..=0x1d17a,
            0xe0001..=0xe0001,
            0xe0020..=0xe007f,
            0xe0100..=0xe01ef,
            0x10_ffff..=0x10_ffff,
        ];
        for c in ranges.into_iter().flatten().filter_map(char::from_u32) {
            assert!(!is_printable(c), "U+{:04X} is not seen", c as u32);
            assert!(escaped(&c.to_string()).is_ascii(), "U+{:04X}", c as u32);
        }
    }

    #[test]
    fn what_people_write_is_left_alone() {
        for text in
            ["plain words, 1e-3 m² → ×", "Grüße e\u{301}", "日本語　の", "नमस्ते", "العربية", "🎱", "a\u{a0}b", "⡇"]
        {
            assert_eq!(escaped(text), text);
        }
    }

    #[test]
    fn a_name_that_is_no_utf_8_shows_its_bytes() {
        assert_eq!(name(OsStr::from_bytes(b"a\xff\xfe\x1bb\xc3\xa9")), "a\\xff\\xfe\\u{1b}bé");
    }

    #[test]
    fn an_escape_is_cut_by_what_it_takes() {
        assert_eq!(shortened("abc", 3), "abc");
        assert_eq!(shortened("abcd", 3), "abc…");
        assert!(shortened(&"\u{202e}".repeat(1000), 60).chars().count() < 70);
    }

    #[test]
    fn joiners_and_marks_have_names() {
        for (c, words) in [
            ('\u{200d}', "U+200D (a zero-width joiner)"),
            ('\u{200c}', "U+200C (a zero-width non-joiner)"),
            ('\u{202e}', "U+202E (a direction mark)"),
            ('\u{13430}', "U+13430 (a format character)"),
            ('\u{fe0f}', "U+FE0F (a variation selector)"),
            ('\u{3164}', "U+3164 (an invisible character)"),
            ('\u{7}', "U+0007 (a control character)"),
        ] {
            assert_eq!(described(c), words);
        }
    }

    #[test]
    fn system_errors_come_without_their_number() {
        assert_eq!(cause(&io::Error::from_raw_os_error(2)), "No such file or directory");
        assert_eq!(cause(&io::Error::other("our own words")), "our own words");
    }
}
