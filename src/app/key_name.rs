//! Keys by name, as a configuration spells them and the help shows them.

use std::str::FromStr;

use super::keys::{Code, Key};
use crate::printable::{described, is_printable};

/// The names of the keys that type nothing, and of the space.
const NAMES: [(&str, Code); 19] = [
    ("space", Code::Char(' ')),
    ("Enter", Code::Enter),
    ("Return", Code::Enter),
    ("Esc", Code::Escape),
    ("Escape", Code::Escape),
    ("Tab", Code::Tab),
    ("Backspace", Code::Backspace),
    ("Delete", Code::Delete),
    ("Del", Code::Delete),
    ("Left", Code::Left),
    ("Right", Code::Right),
    ("Up", Code::Up),
    ("Down", Code::Down),
    ("Home", Code::Home),
    ("End", Code::End),
    ("PageUp", Code::PageUp),
    ("PgUp", Code::PageUp),
    ("PageDown", Code::PageDown),
    ("PgDn", Code::PageDown),
];

/// What every terminal sends for these letters with Ctrl, and what this program takes it for.
const SAME_AS: [(char, &str); 5] = [('h', "Backspace"), ('i', "Tab"), ('j', "Enter"), ('m', "Enter"), ('[', "Esc")];

/// Characters that begin a control sequence after the escape that Alt sends.
const INTRODUCERS: &str = "[O]PX^_";

impl FromStr for Key {
    type Err = String;

    /// Reads `q`, `space`, `F1`, `Ctrl-L`, `Shift-Tab`, `Alt-x`: what [`Key`] displays as, names in any case.
    ///
    /// # Errors
    /// A sentence without its subject, the name: why a terminal cannot send such a key, or that there is none.
    fn from_str(name: &str) -> Result<Key, String> {
        if let Some(c) = name.chars().find(|c| !is_printable(*c)) {
            return Err(format!(
                "holds the character {}; allowed are names of characters that can be seen",
                described(c)
            ));
        }
        let (mut key, mut rest) = (Key::plain(Code::Escape), name);
        while let Some((modifier, after)) = rest.split_once('-').filter(|(_, after)| !after.is_empty()) {
            let set = match modifier.to_ascii_lowercase().as_str() {
                "ctrl" | "control" => &mut key.ctrl,
                "alt" | "meta" => &mut key.alt,
                "shift" => &mut key.shift,
                _ => break,
            };
            *set = true;
            rest = after;
        }
        key.code = code(rest).ok_or(
            "is no key; a key is a character, space, Enter, Esc, Tab, Backspace, Delete, Left, Right, Up, Down, Home, \
             End, PageUp, PageDown or F1 to F12, after Ctrl-, Alt- or Shift- if it is pressed with them",
        )?;
        told_apart(key)
    }
}

fn code(name: &str) -> Option<Code> {
    let mut characters = name.chars();
    if let (Some(c), None) = (characters.next(), characters.next()) {
        return (c != ' ').then_some(Code::Char(c));
    }
    let function = name.strip_prefix(['F', 'f']).and_then(|number| number.parse().ok());
    let known = NAMES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, code)| *code);
    known.or(function.filter(|number| (1..=12).contains(number)).map(Code::F))
}

/// The key, if a terminal can tell it from every other.
fn told_apart(key: Key) -> Result<Key, String> {
    match key.code {
        Code::Char(c) if key.shift => Err(format!("is written as the character that it types: {}", c.to_uppercase())),
        Code::Char(c) if key.ctrl => with_ctrl(key, c.to_ascii_lowercase()),
        Code::Char(c) if key.alt && INTRODUCERS.contains(c) => {
            Err("is the beginning of other keys to a terminal".into())
        }
        Code::Enter | Code::Escape | Code::Backspace if key.ctrl || key.shift => {
            Err("is sent by most terminals as the key alone".into())
        }
        Code::Tab if key.ctrl || key.alt => Err("is sent by most terminals as the key alone".into()),
        Code::Escape if key.alt => Err("is sent by most terminals as the key alone".into()),
        _ => Ok(key),
    }
}

fn with_ctrl(key: Key, c: char) -> Result<Key, String> {
    if let Some((_, other)) = SAME_AS.iter().find(|(letter, _)| *letter == c) {
        return Err(format!("is the same as {other} to a terminal"));
    }
    match c {
        'a'..='z' | ' ' | '4'..='7' => Ok(Key { code: Code::Char(c), ..key }),
        _ => Err("is not sent by terminals; with Ctrl there are letters, space and 4 to 7".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::table;

    #[test]
    fn every_key_of_the_table_is_read_by_the_name_that_it_shows() {
        for key in table().flat_map(|row| row.keys) {
            assert_eq!(key.to_string().parse(), Ok(*key), "{key}");
        }
    }

    #[test]
    fn names_are_read_in_any_case_and_characters_in_their_own() {
        let key = |name: &str| name.parse::<Key>();
        assert_eq!(key("ctrl-L"), Ok(Key::ctrl('l')));
        assert_eq!(key("CTRL-l"), Ok(Key::ctrl('l')));
        assert_eq!(key("shift-tab"), Ok(Key::shift(Code::Tab)));
        assert_eq!(key("escape"), Ok(Key::plain(Code::Escape)));
        assert_eq!(key("f12"), Ok(Key::plain(Code::F(12))));
        assert_eq!((key("f"), key("F"), key("-")), (Ok(Key::char('f')), Ok(Key::char('F')), Ok(Key::char('-'))));
        assert_eq!(key("ü"), Ok(Key::char('ü')));
        assert_eq!(key("Alt--"), Ok(Key { alt: true, ..Key::char('-') }));
        assert_eq!(key("Ctrl-Alt-q"), Ok(Key { alt: true, ..Key::ctrl('q') }));
        assert_eq!(key("Ctrl-space"), Ok(Key::ctrl(' ')));
    }

    #[test]
    fn what_no_terminal_can_tell_apart_is_no_key() {
        for name in [
            "",
            " ",
            "qq",
            "F0",
            "F13",
            "Ctrl-",
            "Ctrl-1",
            "Ctrl-i",
            "Ctrl-M",
            "Ctrl-[",
            "Ctrl-é",
            "Shift-a",
            "Shift-space",
            "Ctrl-Shift-a",
            "Ctrl-Enter",
            "Ctrl-Tab",
            "Alt-Esc",
            "Alt-[",
            "Super-q",
            "\u{200d}",
            "a\u{301}",
            "\u{1b}",
        ] {
            let refusal = name.parse::<Key>();
            assert!(refusal.as_ref().is_err_and(|said| said.chars().all(is_printable)), "{name:?}: {refusal:?}");
        }
    }
}
