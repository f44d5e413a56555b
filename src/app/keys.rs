//! The one key table: what the keys do, the help and the hint line all come from it.

use std::fmt;

use super::action::{Action, Direction};
use crate::scene::Method;

/// A key as a terminal can tell it: of a character the shift is in the character itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key {
    /// Which key.
    pub code: Code,
    /// Whether Ctrl is pressed; letters are then lower case.
    pub ctrl: bool,
    /// Whether Shift is pressed; never set for characters.
    pub shift: bool,
    /// Whether Alt is pressed.
    pub alt: bool,
}

/// Which key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names are engraved on the keys")]
pub enum Code {
    /// A character.
    Char(char),
    /// A function key.
    F(u8),
    Enter,
    Escape,
    Tab,
    Backspace,
    Delete,
    Left,
    Right,
    Up,
    Down,
    Home,
    End,
    PageUp,
    PageDown,
}

impl Key {
    /// The key alone.
    pub const fn plain(code: Code) -> Key {
        Key { code, ctrl: false, shift: false, alt: false }
    }

    /// The character, typed in whatever way the keyboard needs.
    pub const fn char(c: char) -> Key {
        Key::plain(Code::Char(c))
    }

    /// The letter with Ctrl.
    pub const fn ctrl(c: char) -> Key {
        Key { code: Code::Char(c), ctrl: true, shift: false, alt: false }
    }

    /// The key with Shift.
    pub const fn shift(code: Code) -> Key {
        Key { code, ctrl: false, shift: true, alt: false }
    }

    /// The character that the key types, if it types one.
    pub fn typed(self) -> Option<char> {
        match self.code {
            Code::Char(c) if !self.ctrl && !self.alt && !c.is_control() => Some(c),
            _ => None,
        }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (on, name) in [(self.ctrl, "Ctrl-"), (self.alt, "Alt-"), (self.shift, "Shift-")] {
            if on {
                f.write_str(name)?;
            }
        }
        match self.code {
            Code::Char(' ') => f.write_str("space"),
            Code::Char(c) if self.ctrl => write!(f, "{}", c.to_ascii_uppercase()),
            Code::Char(c) => write!(f, "{c}"),
            Code::F(n) => write!(f, "F{n}"),
            Code::Escape => f.write_str("Esc"),
            other => write!(f, "{other:?}"),
        }
    }
}

/// A row of the key table.
#[derive(Debug, Clone, Copy)]
pub struct Binding {
    /// Keys of which each does it.
    pub keys: &'static [Key],
    /// What the keys do.
    pub action: Action,
    /// What the keys do, in words for the help.
    pub does: &'static str,
    /// A word for the hint line, if it has a place there.
    pub hint: Option<&'static str>,
}

const fn bind(keys: &'static [Key], action: Action, does: &'static str) -> Binding {
    Binding { keys, action, does, hint: None }
}

const fn hint(keys: &'static [Key], action: Action, does: &'static str, hint: &'static str) -> Binding {
    Binding { keys, action, does, hint: Some(hint) }
}

use Key as K;

/// What every key does while nothing that takes typing is open.
const TABLE: &[Binding] = &[
    hint(&[K::char(' '), K::char('p')], Action::TogglePause, "pause / run", "pause/run"),
    hint(&[K::char('.'), K::char('n'), K::plain(Code::Right)], Action::Step, "step one frame", "step"),
    hint(&[K::char(','), K::char('N'), K::plain(Code::Left)], Action::StepBack, "step one frame back", "back"),
    hint(&[K::char('c')], Action::NextImpact, "to the next, previous collision; selects what collides", "collision"),
    bind(&[K::char('C')], Action::PreviousImpact, "to the next, previous collision; selects what collides"),
    bind(&[K::char('<')], Action::TenBack, "ten frames back, on"),
    bind(&[K::char('>')], Action::TenOn, "ten frames back, on"),
    bind(&[K::char('g')], Action::Oldest, "to the start, to the newest frame"),
    bind(&[K::char('G')], Action::Newest, "to the start, to the newest frame"),
    bind(&[K::char('u')], Action::Until, "run until something comes: type what"),
    bind(&[K::char('U')], Action::UntilAgain, "run until it comes again"),
    hint(&[K::char('r')], Action::Restart, "restart", "restart"),
    bind(&[K::char('R')], Action::Reload, "reload the scene's file"),
    bind(&[K::char('[')], Action::PreviousScene, "previous, next scene"),
    bind(&[K::char(']')], Action::NextScene, "previous, next scene"),
    hint(&[K::char('?'), K::plain(Code::F(1))], Action::Help, "help", "help"),
    hint(&[K::char('q'), K::ctrl('c')], Action::Quit, "quit", "quit"),
    hint(&[K::char('o')], Action::Scenes, "scene list", "scenes"),
    hint(&[K::char('+')], Action::Faster, "faster, slower", "faster"),
    hint(&[K::char('-')], Action::Slower, "faster, slower", "slower"),
    bind(&[K::char('=')], Action::RealTime, "real time"),
    bind(&[K::char('t')], Action::LowerTolerance, "tolerance / 10, x 10"),
    bind(&[K::char('T')], Action::RaiseTolerance, "tolerance / 10, x 10"),
    bind(&[K::char('s')], Action::HalveDt, "dt / 2, x 2"),
    bind(&[K::char('S')], Action::DoubleDt, "dt / 2, x 2"),
    bind(&[K::char('m')], Action::NextMethod, "next method"),
    hint(&[K::plain(Code::Tab)], Action::SelectNext, "select next, previous sphere", "select"),
    bind(&[K::shift(Code::Tab)], Action::SelectPrevious, "select next, previous sphere"),
    bind(&[K::char('f')], Action::Follow, "follow the selected sphere"),
    bind(&[K::char('i')], Action::Inspector, "inspector: numbers, a contact's card, off"),
    bind(
        &[K::char('w'), K::plain(Code::Enter)],
        Action::Card,
        "why: a contact's card; Up Down choose, PageUp PageDown scroll",
    ),
    bind(&[K::char('L')], Action::Events, "log: all that has happened; type to narrow it, Enter goes there"),
    bind(&[K::char('(')], Action::PreviousTrial, "previous, next trial step of the search, in the views too"),
    bind(&[K::char(')')], Action::NextTrial, "previous, next trial step of the search, in the views too"),
    hint(&[K::char('v')], Action::NextViews, "views: both, side, top", "views"),
    bind(&[K::char('d')], Action::NextOverlays, "overlays: contacts, + normals, velocities, ids, all, none"),
    bind(&[K::char('x')], Action::Ghost, "ghost: where the exact run is now, errors and cost over time"),
    bind(&[K::char('h'), K::shift(Code::Left)], Action::Pan(Direction::Left), "pan (Shift-arrows too)"),
    bind(&[K::char('j'), K::shift(Code::Down)], Action::Pan(Direction::Down), "pan (Shift-arrows too)"),
    bind(&[K::char('k'), K::shift(Code::Up)], Action::Pan(Direction::Up), "pan (Shift-arrows too)"),
    bind(&[K::char('l'), K::shift(Code::Right)], Action::Pan(Direction::Right), "pan (Shift-arrows too)"),
    bind(&[K::char('z')], Action::ZoomIn, "zoom in, out"),
    bind(&[K::char('Z')], Action::ZoomOut, "zoom in, out"),
    bind(&[K::char('0'), K::plain(Code::Home)], Action::WholeScene, "whole scene"),
    bind(&[K::char('e')], Action::TakeAway, "write the picture (SVG) and the state as a scene that goes on from here"),
    bind(&[K::char('E')], Action::Record, "record the run (.carom), changes of settings included; again: write it"),
    bind(&[K::char(':')], Action::Prompt, "exact values: dt 1e-3, tolerance 1e-9, goto 3.25, until rest, show forces"),
    bind(&[K::char('%')], Action::Mouse, "mouse on, off"),
    bind(&[K::ctrl('l')], Action::Repaint, "repaint"),
    bind(&[K::ctrl('z')], Action::Suspend, "suspend"),
    bind(&[K::plain(Code::Escape)], Action::Close, "close what is open"),
];

/// What the keys do in the scene list, for the help; `scene_list` obeys them.
pub(super) const IN_THE_LIST: (&str, &str) = ("j k Up Down / Enter", "in the scene list: move, filter, open");

/// The rows that have an effect in this program: with one method there is no next one.
pub fn table() -> impl Iterator<Item = &'static Binding> {
    TABLE.iter().filter(|row| row.action != Action::NextMethod || Method::ALL.len() > 1)
}

/// The rows of a table of keys as slices.
pub(super) fn pairs<'a>(rows: &'a [(String, &'static str)]) -> Vec<(&'a str, &'a str)> {
    rows.iter().map(|(keys, does)| (keys.as_str(), *does)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_is_bound_twice() {
        let keys: Vec<Key> = table().flat_map(|row| row.keys).copied().collect();
        for (i, key) in keys.iter().enumerate() {
            assert!(!keys[..i].contains(key), "{key}");
        }
    }

    #[test]
    fn keys_that_some_terminals_eat_are_never_the_only_way() {
        for row in table() {
            let plain = |key: &Key| matches!(key.code, Code::Char(_) | Code::Escape | Code::Tab);
            assert!(row.keys.iter().any(plain), "{}", row.does);
        }
    }
}
