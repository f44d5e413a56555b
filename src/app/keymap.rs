//! Which key does what: the key table, as far as a configuration binds none of its actions otherwise.

use super::{
    action::Action,
    keys::{Binding, Code, IN_THE_LIST, Key, table},
};

/// Keys that always do this, whatever else does it too: a way out must not be lost by a slip in a file.
const FIXED: [(Key, Action); 2] = [(Key::ctrl('c'), Action::Quit), (Key::plain(Code::Escape), Action::Close)];

/// Which key does what.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Keymap {
    rows: Vec<Row>,
}

/// A row of the key table with the keys that are bound to it.
#[derive(Debug, Clone)]
struct Row {
    keys: Vec<Key>,
    binding: &'static Binding,
}

impl PartialEq for Row {
    fn eq(&self, other: &Row) -> bool {
        self.keys == other.keys && self.binding.action == other.binding.action
    }
}

impl Eq for Row {}

/// Why a key cannot be bound to an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clash {
    /// The key is bound to this action as well.
    Taken(Action),
    /// The key always does this.
    Fixed(Action),
    /// The key is bound to the action twice.
    Twice,
}

impl Default for Keymap {
    /// The key table.
    fn default() -> Keymap {
        Keymap { rows: table().map(|binding| Row { keys: binding.keys.to_vec(), binding }).collect() }
    }
}

impl Keymap {
    /// Binds these keys, and the fixed ones of the action, instead of those of the table. [`Keymap::clash`] tells whether
    /// that went well, once all are bound.
    pub fn bind(&mut self, action: Action, keys: &[Key]) {
        let fixed = FIXED.iter().filter(|(key, does)| *does == action && !keys.contains(key)).map(|(key, _)| key);
        let all: Vec<Key> = keys.iter().chain(fixed).copied().collect();
        if let Some(row) = self.rows.iter_mut().find(|row| row.binding.action == action) {
            row.keys = all;
        }
    }

    /// What speaks against a key of an action.
    pub fn clash(&self, action: Action, key: Key) -> Option<Clash> {
        let fixed = FIXED.iter().find(|(fixed, does)| *fixed == key && *does != action);
        let other = self.rows.iter().find(|row| row.binding.action != action && row.keys.contains(&key));
        let own = self.keys(action).iter().filter(|own| **own == key).count();
        fixed
            .map(|(_, does)| Clash::Fixed(*does))
            .or(other.map(|row| Clash::Taken(row.binding.action)))
            .or((own > 1).then_some(Clash::Twice))
    }

    /// What `key` does.
    pub fn action(&self, key: Key) -> Option<Action> {
        self.rows.iter().find(|row| row.keys.contains(&key)).map(|row| row.binding.action)
    }

    /// The keys of an action.
    pub fn keys(&self, action: Action) -> &[Key] {
        self.rows.iter().find(|row| row.binding.action == action).map_or(&[], |row| &row.keys)
    }

    /// The help: keys, and what they do. Rows with equal words share a line with their first key each.
    pub fn help_rows(&self) -> Vec<(String, &'static str)> {
        let rows: Vec<&Row> = self.rows.iter().filter(|row| !row.keys.is_empty()).collect();
        let lines = rows.chunk_by(|a, b| a.binding.does == b.binding.does).map(|same| {
            let each = if same.len() > 1 { 1 } else { usize::MAX };
            let keys = same.iter().flat_map(|row| row.keys.iter().take(each));
            (keys.map(Key::to_string).collect::<Vec<_>>().join(" "), does(same))
        });
        lines.chain([(IN_THE_LIST.0.to_owned(), IN_THE_LIST.1)]).collect()
    }

    /// The hint line: a key and a word each, the most needed first.
    pub fn hints(&self) -> Vec<(String, &'static str)> {
        let hint = |row: &Row| Some((row.keys.first()?.to_string(), row.binding.hint?));
        self.rows.iter().filter_map(hint).collect()
    }
}

/// The help of the default keys: keys, and what they do.
pub fn help_rows() -> Vec<(String, &'static str)> {
    Keymap::default().help_rows()
}

/// The hint line of the default keys: a key and a word each, the most needed first.
pub fn hints() -> Vec<(String, &'static str)> {
    Keymap::default().hints()
}

/// What the rows do; what their text says of further keys, in brackets, only where those are bound.
fn does(same: &[&Row]) -> &'static str {
    let text = same[0].binding.does;
    match same.iter().all(|row| row.keys == row.binding.keys) {
        true => text,
        false => text.split(" (").next().unwrap_or(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_that_is_bound_anew_does_the_new_thing_and_help_and_hints_say_so() {
        let mut keymap = Keymap::default();
        let does = |action| table().find(|row| row.action == action).expect("in the table").does;
        let told = |keymap: &Keymap, action| {
            keymap.help_rows().into_iter().find(|(_, told)| *told == does(action)).map(|(keys, _)| keys)
        };
        keymap.bind(Action::Restart, &[Key::char('!'), Key::plain(Code::F(5))]);
        assert_eq!(keymap.action(Key::char('!')), Some(Action::Restart));
        assert_eq!(keymap.action(Key::plain(Code::F(5))), Some(Action::Restart));
        assert_eq!(keymap.action(Key::char('r')), None);
        assert!(keymap.hints().contains(&("!".into(), "restart")));
        assert_eq!(told(&keymap, Action::Restart).as_deref(), Some("! F5"));
        keymap.bind(Action::Restart, &[]);
        assert_eq!(told(&keymap, Action::Restart), None);
        assert!(!keymap.hints().iter().any(|(_, word)| *word == "restart"));
    }

    #[test]
    fn every_action_of_the_table_can_be_bound_and_let_go_of() {
        for row in table() {
            let mut keymap = Keymap::default();
            keymap.bind(row.action, &[Key::plain(Code::F(12))]);
            assert_eq!(keymap.action(Key::plain(Code::F(12))), Some(row.action));
            let fixed = |key: &&Key| FIXED.iter().any(|(fixed, _)| fixed == *key);
            for key in row.keys.iter().filter(|key| !fixed(key)) {
                assert_eq!(keymap.action(*key), None, "{key}");
            }
        }
    }

    #[test]
    fn the_hints_lead_to_the_help_and_out_on_80_columns_and_all_labels_are_plain_ascii() {
        let mut column = 0;
        for (key, word) in hints() {
            column += key.len() + 1 + word.len() + 2;
            if word == "quit" {
                break;
            }
        }
        assert!(column <= 80, "`quit` ends in column {column}");
        for (keys, does) in help_rows() {
            assert!(keys.is_ascii() && does.is_ascii(), "{keys} {does}");
        }
    }

    #[test]
    fn the_ways_out_stay() {
        let mut keymap = Keymap::default();
        keymap.bind(Action::Quit, &[]);
        keymap.bind(Action::Close, &[Key::char('b')]);
        assert_eq!(keymap.action(Key::ctrl('c')), Some(Action::Quit));
        assert_eq!(keymap.action(Key::plain(Code::Escape)), Some(Action::Close));
        assert_eq!(keymap.clash(Action::Step, Key::ctrl('c')), Some(Clash::Fixed(Action::Quit)));
    }

    #[test]
    fn a_key_of_two_actions_clashes_until_one_lets_go() {
        let mut keymap = Keymap::default();
        keymap.bind(Action::Step, &[Key::char('q')]);
        assert_eq!(keymap.clash(Action::Step, Key::char('q')), Some(Clash::Taken(Action::Quit)));
        keymap.bind(Action::Quit, &[Key::char('Q')]);
        assert_eq!(keymap.clash(Action::Step, Key::char('q')), None);
        keymap.bind(Action::Step, &[Key::char('y'), Key::char('y')]);
        assert_eq!(keymap.clash(Action::Step, Key::char('y')), Some(Clash::Twice));
    }
}
