//! What the terminal can show, from the environment: a flag wins over everything.

use crate::view::{Colors, Marker};

/// Terminals that have no colours, by their name in TERM.
const MONOCHROME: [&str; 6] = ["vt52", "vt100", "vt102", "vt220", "vt320", "vt420"];

/// The variables that matter here, empty ones as if unset.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Environment {
    locale: Option<String>,
    no_color: bool,
    color_term: Option<String>,
    term: Option<String>,
    ssh: bool,
    multiplexed: bool,
    columns: Option<u16>,
    lines: Option<u16>,
}

impl Environment {
    /// The environment whose variables have the values that `variable` returns.
    pub(super) fn read(variable: impl Fn(&str) -> Option<String>) -> Environment {
        let set = |name: &str| variable(name).filter(|value| !value.is_empty());
        let count = |name: &str| set(name).and_then(|value| value.trim().parse().ok()).filter(|&count| count > 0);
        Environment {
            locale: ["LC_ALL", "LC_CTYPE", "LANG"].into_iter().find_map(set),
            no_color: set("NO_COLOR").is_some(),
            color_term: set("COLORTERM"),
            term: set("TERM"),
            ssh: set("SSH_CONNECTION").is_some(),
            // The last is mosh-server's fingerprint: it sets nothing else.
            multiplexed: ["TMUX", "STY", "NCURSES_NO_UTF8_ACS"].into_iter().any(|name| set(name).is_some()),
            columns: count("COLUMNS"),
            lines: count("LINES"),
        }
    }

    /// The environment of this process.
    pub(super) fn ours() -> Environment {
        Environment::read(|name| std::env::var_os(name).map(|value| value.to_string_lossy().into_owned()))
    }

    /// The marker: braille, unless the locale names an encoding that has no such characters, or the terminal is the Linux
    /// console, whose fonts have none. An ssh session often arrives without any locale: that is unknown, not C.
    pub(super) fn marker(&self, flag: Option<Marker>) -> Marker {
        let utf8 = |locale: &str| {
            let locale = locale.to_ascii_lowercase();
            locale.contains("utf-8") || locale.contains("utf8")
        };
        flag.unwrap_or(match &self.locale {
            _ if self.is_console() => Marker::Ascii,
            Some(locale) if !utf8(locale) => Marker::Ascii,
            _ => Marker::Braille,
        })
    }

    /// Depth of colour: as many as the terminal says it has, 16 if it says nothing.
    pub(super) fn colors(&self, flag: Option<Colors>) -> Colors {
        let term = self.term.as_deref().unwrap_or("");
        flag.unwrap_or(match self.color_term.as_deref() {
            _ if self.no_color => Colors::Never,
            Some("truecolor" | "24bit") => Colors::Rgb,
            _ if term.ends_with("-direct") => Colors::Rgb,
            _ if term.contains("256color") => Colors::Ansi256,
            _ if MONOCHROME.contains(&term) || term.ends_with("-mono") || term.ends_with("-m") => Colors::Never,
            _ => Colors::Ansi16,
        })
    }

    /// Whether the terminal may have more colours than it says: the name in TERM is often that of the least that is there.
    pub(super) fn may_have_more_colors(&self) -> bool {
        !self.multiplexed && matches!(self.colors(None), Colors::Ansi16 | Colors::Ansi256)
    }

    /// Whether nothing is said of the encoding.
    pub(super) fn has_no_locale(&self) -> bool {
        self.locale.is_none()
    }

    /// Whether the terminal may be asked what it can: the Linux console prints questions that it does not know.
    pub(super) fn may_be_asked(&self) -> bool {
        !self.is_console()
    }

    fn is_console(&self) -> bool {
        self.term.as_deref() == Some("linux")
    }

    /// Columns and rows of a terminal that reports these. Some, a serial line among them, report 0: that is unknown.
    pub(super) fn size(&self, (columns, rows): (u16, u16)) -> (u16, u16) {
        let known =
            |reported: u16, said: Option<u16>, usual| if reported > 0 { reported } else { said.unwrap_or(usual) };
        (known(columns, self.columns, 80), known(rows, self.lines, 24))
    }

    /// Whether a program (tmux, screen, mosh) stands between, which answers for the terminal behind it at once, however far
    /// that is. What runs on the near side of the network (its TERM alone tells) answers as late as the terminal does.
    pub(super) fn multiplexed(&self) -> bool {
        self.multiplexed
    }

    /// Whether a network lies between us and the screen.
    pub(super) fn remote(&self) -> bool {
        self.ssh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(set: &[(&str, &str)]) -> Environment {
        Environment::read(|name| set.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).to_owned()))
    }

    #[test]
    fn the_first_locale_that_is_set_decides_about_braille() {
        let marker = |set: &[(&str, &str)]| with(set).marker(None);
        assert_eq!(marker(&[]), Marker::Braille, "unknown");
        assert_eq!(marker(&[("LANG", "")]), Marker::Braille, "unknown");
        assert_eq!(marker(&[("LANG", "C")]), Marker::Ascii);
        assert_eq!(marker(&[("LANG", "POSIX")]), Marker::Ascii);
        assert_eq!(marker(&[("LANG", "C.UTF-8")]), Marker::Braille);
        assert_eq!(marker(&[("LANG", "de_DE.utf8"), ("LC_ALL", "C")]), Marker::Ascii);
        assert_eq!(marker(&[("LANG", "C"), ("LC_CTYPE", "en_US.UTF-8"), ("LC_ALL", "")]), Marker::Braille);
        assert_eq!(marker(&[("LANG", "ja_JP.eucJP")]), Marker::Ascii);
        assert_eq!(marker(&[("LANG", "C.UTF-8"), ("TERM", "linux")]), Marker::Ascii, "what its fonts have");
        assert_eq!(with(&[("LANG", "C")]).marker(Some(Marker::Block)), Marker::Block, "the flag wins");
    }

    #[test]
    fn no_color_wins_over_what_the_terminal_can_do_and_the_flag_over_both() {
        let colors = |set: &[(&str, &str)]| with(set).colors(None);
        assert_eq!(colors(&[("TERM", "xterm")]), Colors::Ansi16);
        assert_eq!(colors(&[("TERM", "xterm-256color")]), Colors::Ansi256);
        assert_eq!(colors(&[("TERM", "xterm-256color"), ("COLORTERM", "truecolor")]), Colors::Rgb);
        assert_eq!(colors(&[("NO_COLOR", "1"), ("COLORTERM", "24bit")]), Colors::Never);
        assert_eq!(colors(&[("NO_COLOR", ""), ("COLORTERM", "24bit")]), Colors::Rgb, "empty is unset");
        for (term, depth) in [("vt100", Colors::Never), ("xterm-mono", Colors::Never), ("linux", Colors::Ansi16)] {
            assert_eq!(colors(&[("TERM", term)]), depth, "{term}");
        }
        assert_eq!(with(&[("NO_COLOR", "1")]).colors(Some(Colors::Rgb)), Colors::Rgb);
    }

    #[test]
    fn programs_that_answer_for_the_terminal_are_known_by_their_variables() {
        assert!(
            !with(&[("TERM", "screen-256color"), ("SSH_CONNECTION", "::1 1 ::1 2")]).multiplexed(),
            "on the near side"
        );
        for name in ["TMUX", "STY", "NCURSES_NO_UTF8_ACS"] {
            assert!(with(&[(name, "1")]).multiplexed(), "{name}");
            assert!(!with(&[(name, "")]).multiplexed(), "{name}");
        }
    }

    #[test]
    fn a_terminal_of_unknown_size_has_that_of_the_environment_or_the_usual_one() {
        assert_eq!(with(&[]).size((0, 0)), (80, 24));
        assert_eq!(with(&[("COLUMNS", "100"), ("LINES", "30")]).size((0, 0)), (100, 30));
        assert_eq!(with(&[("COLUMNS", "100"), ("LINES", "30")]).size((1, 0)), (1, 30), "what is reported wins");
        for nonsense in ["", "0", "-1", "many", "70000"] {
            assert_eq!(with(&[("COLUMNS", nonsense), ("LINES", nonsense)]).size((0, 0)), (80, 24), "{nonsense:?}");
        }
    }
}
