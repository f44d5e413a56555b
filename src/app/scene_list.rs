//! The scenes there are, and the list in which one is chosen.

use super::keys::{Code, Key};
use crate::scene;

/// Longest filter, bytes; no scene's description is as long.
const FILTER: usize = 200;

/// A scene that can be opened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Entry {
    /// Built-in name, or the path as it was given.
    pub name: String,
    /// What the scene is, a line.
    pub about: String,
}

impl Entry {
    /// The entry of a built-in scene, which says itself what it is.
    fn built_in(name: &str) -> Entry {
        let about = scene::open(name).map(|opened| opened.scene.about.clone()).unwrap_or_default();
        Entry { name: name.into(), about }
    }
}

/// The names of the built-in scenes, in their order.
pub(super) fn built_in_names() -> impl Iterator<Item = &'static str> {
    scene::builtin::ALL.iter().map(|builtin| builtin.name)
}

/// The built-in scenes, in their order.
pub(super) fn built_in() -> impl Iterator<Item = Entry> {
    built_in_names().map(Entry::built_in)
}

/// The list while it is open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct SceneList {
    entries: Vec<Entry>,
    filter: String,
    filtering: bool,
    cursor: usize,
}

/// What a key in the list leads to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Outcome {
    /// The list stays open.
    Stay,
    /// The list closes.
    Close,
    /// The list closes, and this scene is opened.
    Open(String),
    /// The key is none of the list's.
    NotMine,
}

impl SceneList {
    /// All `entries`, the cursor on the one called `current`.
    pub(super) fn new(entries: Vec<Entry>, current: &str) -> SceneList {
        let cursor = entries.iter().position(|entry| entry.name == current).unwrap_or(0);
        SceneList { entries, filter: String::new(), filtering: false, cursor }
    }

    /// Whether typing goes into the filter.
    pub(super) fn filtering(&self) -> bool {
        self.filtering
    }

    /// What was typed into the filter.
    pub(super) fn filter(&self) -> &str {
        &self.filter
    }

    /// Place of the cursor among the [`SceneList::shown`].
    pub(super) fn cursor(&self) -> usize {
        self.cursor
    }

    /// The entries that pass the filter: their name or description contains it, whatever the case.
    pub(super) fn shown(&self) -> impl Iterator<Item = &Entry> {
        let filter = self.filter.to_lowercase();
        let passes = move |text: &str| text.to_lowercase().contains(&filter);
        self.entries.iter().filter(move |entry| passes(&entry.name) || passes(&entry.about))
    }

    /// Obeys a key.
    pub(super) fn handle(&mut self, key: Key) -> Outcome {
        match key.code {
            Code::Up => self.move_to(self.cursor.saturating_sub(1)),
            Code::Down => self.move_to(self.cursor + 1),
            Code::PageUp => self.move_to(self.cursor.saturating_sub(10)),
            Code::PageDown => self.move_to(self.cursor + 10),
            Code::Home => self.move_to(0),
            Code::End => self.move_to(usize::MAX),
            Code::Enter => match self.shown().nth(self.cursor) {
                Some(entry) => Outcome::Open(entry.name.clone()),
                None => Outcome::Stay,
            },
            _ if key.ctrl || key.alt => Outcome::NotMine,
            _ if self.filtering => self.edit(key),
            Code::Char('k') => self.move_to(self.cursor.saturating_sub(1)),
            Code::Char('j') => self.move_to(self.cursor + 1),
            Code::Char('/') => {
                self.filtering = true;
                Outcome::Stay
            }
            Code::Escape => Outcome::Close,
            _ => Outcome::NotMine,
        }
    }

    /// Obeys a key while the filter is typed.
    fn edit(&mut self, key: Key) -> Outcome {
        match (key.code, key.typed()) {
            (Code::Escape, _) => {
                self.filter.clear();
                self.filtering = false;
            }
            (Code::Backspace, _) => self.filtering = self.filter.pop().is_some(),
            (_, Some(c)) if self.filter.len() < FILTER => self.filter.push(c),
            (_, Some(_)) => {}
            _ => return Outcome::NotMine,
        }
        self.move_to(0)
    }

    fn move_to(&mut self, cursor: usize) -> Outcome {
        self.cursor = cursor.min(self.shown().count().saturating_sub(1));
        Outcome::Stay
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list() -> SceneList {
        let entry = |name: &str, about: &str| Entry { name: name.into(), about: about.into() };
        SceneList::new(vec![entry("paper-0", "One sphere"), entry("paper-1", "A ramp"), entry("gas", "Many")], "gas")
    }

    fn press(list: &mut SceneList, keys: &str) -> Outcome {
        keys.chars().map(|c| list.handle(Key::char(c))).last().expect("at least one key")
    }

    #[test]
    fn it_opens_on_the_current_scene_and_moves_within_its_ends() {
        let mut list = list();
        assert_eq!(list.cursor(), 2);
        press(&mut list, "jj");
        assert_eq!(list.cursor(), 2);
        press(&mut list, "kkkk");
        assert_eq!(list.handle(Key::plain(Code::Enter)), Outcome::Open("paper-0".into()));
    }

    #[test]
    fn the_filter_takes_letters_that_are_keys_elsewhere() {
        let mut list = list();
        press(&mut list, "/RAM");
        assert_eq!(list.handle(Key::plain(Code::Enter)), Outcome::Open("paper-1".into()));
        press(&mut list, "jq");
        assert_eq!(list.shown().count(), 0);
        assert_eq!(list.handle(Key::plain(Code::Enter)), Outcome::Stay, "nothing to open");
        assert_eq!(list.handle(Key::plain(Code::Escape)), Outcome::Stay, "the filter closes first");
        assert_eq!(list.shown().count(), 3);
        assert_eq!(list.handle(Key::plain(Code::Escape)), Outcome::Close);
    }
}
