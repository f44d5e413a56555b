//! The keys of a configuration.

use std::{fmt, sync::LazyLock};

use serde::{
    Deserialize, Deserializer,
    de::{self, MapAccess},
};

use crate::{
    app::{Action, Clash, Key, Keymap, table},
    scene::{Error, Source, Step, quote},
};

/// The names of all actions that keys can be bound to.
static NAMES: LazyLock<Vec<&'static str>> = LazyLock::new(|| table().map(|row| &*row.action.name().leak()).collect()); // once in the life of the program

/// Most keys of one action.
const MOST: usize = 16;

/// The actions that are named, each with its keys.
#[derive(Debug, Default)]
pub(super) struct KeysFile(Vec<(Action, Vec<Key>)>);

/// The keys of an action.
struct Keys(Vec<Key>);

/// A key by its name.
#[derive(Deserialize)]
#[serde(try_from = "String")]
struct KeyName(Key);

impl TryFrom<String> for KeyName {
    type Error = String;

    fn try_from(name: String) -> Result<KeyName, String> {
        name.parse().map(KeyName).map_err(|said| format!("{} {said}", quote(&name)))
    }
}

impl<'de> Deserialize<'de> for Keys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Keys, D::Error> {
        let names = Vec::<KeyName>::deserialize(deserializer)?;
        if names.len() > MOST {
            return Err(de::Error::custom(format!("{} keys are refused; allowed are up to {MOST}", names.len())));
        }
        Ok(Keys(names.into_iter().map(|name| name.0).collect()))
    }
}

impl<'de> Deserialize<'de> for KeysFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<KeysFile, D::Error> {
        deserializer.deserialize_struct("Keys", &NAMES, Actions)
    }
}

/// Reads actions and their keys; which actions there are, the key table says.
struct Actions;

impl<'de> de::Visitor<'de> for Actions {
    type Value = KeysFile;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("actions with their keys")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<KeysFile, A::Error> {
        let mut found = KeysFile::default();
        while let Some(Name(action)) = map.next_key()? {
            if let Some((known, _)) = found.0.iter().find(|(known, _)| *known == action) {
                let name = NAMES.iter().find(|name| **name == known.name()).copied().unwrap_or_default();
                return Err(de::Error::duplicate_field(name));
            }
            let Keys(keys) = map.next_value()?;
            found.0.push((action, keys));
        }
        Ok(found)
    }
}

/// An action by its name.
struct Name(Action);

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Name, D::Error> {
        deserializer.deserialize_identifier(NameVisitor)
    }
}

struct NameVisitor;

impl de::Visitor<'_> for NameVisitor {
    type Value = Name;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name of an action")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Name, E> {
        let found = table().map(|row| row.action).find(|action| action.name() == name);
        found.map(Name).ok_or_else(|| de::Error::unknown_field(name, &NAMES))
    }
}

/// The key table with the keys of the file.
///
/// # Errors
/// The first key of the file that is bound twice.
pub(super) fn keymap(file: &KeysFile, source: Source) -> Result<Keymap, Error> {
    let mut keymap = Keymap::default();
    for (action, keys) in &file.0 {
        keymap.bind(*action, keys);
    }
    for (action, keys) in &file.0 {
        for (index, key) in keys.iter().enumerate() {
            if let Some(clash) = keymap.clash(*action, *key) {
                let name = action.name();
                let path = [Step::Field("keys"), Step::Field(&name), Step::Index(index)];
                return Err(source.refuse(&path, sentence(*key, clash)));
            }
        }
    }
    Ok(keymap)
}

fn sentence(key: Key, clash: Clash) -> String {
    let key = quote(&key.to_string());
    match clash {
        Clash::Taken(other) => {
            let name = other.name();
            format!("{key} is a key of {name} too; allowed is one action per key: name the keys of {name} without it")
        }
        Clash::Fixed(action) => format!("{key} is refused; it always does {}", action.name()),
        Clash::Twice => format!("{key} is given twice"),
    }
}
