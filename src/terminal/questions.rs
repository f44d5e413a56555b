//! What only the terminal itself can say, asked with the first picture and heard whenever it answers: that picture never
//! waits. What was not asked, and what was answered already, is not heard.

use super::{detect::Environment, reply::Reply};
use crate::view::{Background, Colors, Marker};

/// Asks whether the terminal can print a character beyond ASCII: where the cursor is after one of three bytes in UTF-8.
const WIDTH: &[u8] = "\x1b[H\u{283f}\x1b[6n".as_bytes();

/// Asks which colour the terminal has made of one of 24 bits, and whether its own description has such colours (`RGB`).
const COLORS: &[u8] = b"\x1b[48;2;1;2;3m\x1bP$qm\x1b\\\x1b[m\x1bP+q524742\x1b\\";

/// Asks for the colour of the terminal's background.
const BACKGROUND: &[u8] = b"\x1b]11;?\x1b\\";

/// Asks whether the terminal knows synchronized updates.
const SYNCHRONIZED: &[u8] = b"\x1b[?2026$p";

/// Questions that are not answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Questions {
    characters: bool,
    colors: bool,
    background: bool,
    synchronized: bool,
}

/// What an answer changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Change {
    Marker(Marker),
    Colors(Colors),
    Background(Background),
    /// Whether pictures go in the brackets of synchronized updates.
    Brackets(bool),
}

impl Questions {
    /// The questions that the user (`marker`, `colors`) and the environment leave open.
    pub(super) fn open(environment: &Environment, marker: Option<Marker>, colors: Option<Colors>) -> Questions {
        if !environment.may_be_asked() {
            return Questions::default();
        }
        Questions {
            characters: marker.is_none() && environment.has_no_locale(),
            colors: colors.is_none() && environment.may_have_more_colors(),
            background: environment.colors(colors) != Colors::Never,
            synchronized: true,
        }
    }

    /// The questions in bytes; they leave a trace on the screen, which is to be drawn after them.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let all = [
            (self.characters, WIDTH),
            (self.colors, COLORS),
            (self.background, BACKGROUND),
            (self.synchronized, SYNCHRONIZED),
        ];
        all.into_iter().filter(|(asked, _)| *asked).flat_map(|(_, bytes)| bytes.iter().copied()).collect()
    }

    /// What a reply changes.
    pub(super) fn hear(&mut self, reply: Reply) -> Option<Change> {
        let mut open = |question: fn(&mut Questions) -> &mut bool| std::mem::take(question(self));
        match reply {
            Reply::Attributes => None,
            // After one column it has understood UTF-8, after three it has not; anything else was said of another place.
            Reply::Column(column @ (2 | 4)) if open(|asked| &mut asked.characters) => {
                (column == 4).then_some(Change::Marker(Marker::Ascii))
            }
            Reply::TrueColor if open(|asked| &mut asked.colors) => Some(Change::Colors(Colors::Rgb)),
            Reply::Background { light } if open(|asked| &mut asked.background) => {
                Some(Change::Background(if light { Background::Light } else { Background::Dark }))
            }
            Reply::Synchronized(known) if open(|asked| &mut asked.synchronized) => Some(Change::Brackets(known)),
            Reply::Column(_) | Reply::TrueColor | Reply::Background { .. } | Reply::Synchronized(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(set: &[(&str, &str)]) -> Environment {
        Environment::read(|name| set.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).to_owned()))
    }

    #[test]
    fn only_what_user_and_environment_leave_open_is_asked() {
        let asked = |set: &[(&str, &str)]| Questions::open(&with(set), None, None);
        let all = Questions { characters: true, colors: true, background: true, synchronized: true };
        assert_eq!(asked(&[("TERM", "xterm-256color")]), all);
        assert!(!asked(&[("TERM", "xterm"), ("LANG", "C")]).characters);
        assert!(!asked(&[("TERM", "xterm"), ("LANG", "C.UTF-8")]).characters);
        assert!(!asked(&[("TERM", "xterm"), ("COLORTERM", "truecolor")]).colors);
        assert!(!asked(&[("TERM", "xterm-direct")]).colors);
        assert!(
            !asked(&[("TERM", "screen"), ("STY", "1")]).colors,
            "its own colours count, not the terminal's behind it"
        );
        let none = Questions { colors: false, background: false, ..all };
        assert_eq!(asked(&[("TERM", "xterm"), ("NO_COLOR", "1")]), none);
        assert_eq!(asked(&[("TERM", "linux")]), Questions::default(), "the console prints what it does not know");
        let environment = with(&[("TERM", "xterm")]);
        let fixed = Questions::open(&environment, Some(Marker::Braille), Some(Colors::Ansi16));
        assert_eq!(fixed, Questions { characters: false, colors: false, ..all });
    }

    #[test]
    fn each_question_is_answered_once_and_nothing_else_is_heard() {
        let mut questions = Questions { characters: true, colors: true, background: true, synchronized: true };
        assert_eq!(questions.hear(Reply::Column(17)), None, "of another place");
        assert_eq!(questions.hear(Reply::Column(4)), Some(Change::Marker(Marker::Ascii)));
        assert_eq!(questions.hear(Reply::Column(4)), None);
        assert_eq!(questions.hear(Reply::TrueColor), Some(Change::Colors(Colors::Rgb)));
        assert_eq!(questions.hear(Reply::TrueColor), None);
        let light = Reply::Background { light: true };
        assert_eq!(questions.hear(light), Some(Change::Background(Background::Light)));
        assert_eq!(questions.hear(Reply::Background { light: false }), None);
        assert_eq!(questions.hear(Reply::Synchronized(false)), Some(Change::Brackets(false)));
        assert_eq!(questions, Questions::default());
        for reply in [Reply::Attributes, Reply::Column(4), Reply::TrueColor, light, Reply::Synchronized(true)] {
            assert_eq!(Questions::default().hear(reply), None, "not asked");
        }
    }
}
