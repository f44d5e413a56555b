//! Which events of a list are wanted, as a user types it.

use std::fmt;

use super::event_log::Logged;
use crate::physics::{Class, Kind};

/// The words for what can happen.
const CLASSES: [(&str, Class); 3] = [("collision", Class::Collide), ("rest", Class::Rest), ("release", Class::Release)];

/// Which events are wanted: all that these words allow.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct EventFilter {
    /// Classes of which the event is one; any class if the list is empty.
    classes: Vec<Class>,
    /// Spheres that all take part in the event.
    spheres: Vec<u32>,
    /// The wall that takes part, or `Some(None)` for any wall; none if a wall need not take part.
    wall: Option<Option<u32>>,
}

/// A word that a filter does not know. Displays as a sentence that says what is allowed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownWord(pub String);

impl fmt::Display for UnknownWord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let UnknownWord(word) = self;
        write!(f, "{word} is not allowed: a filter takes spheres (3, or 3 5), wall 0, collision, rest, release.")
    }
}

impl std::error::Error for UnknownWord {}

impl EventFilter {
    /// Reads words in any order: numbers of spheres, `wall` and its number, `collision`, `rest` and `release` or how they
    /// begin. Of several spheres each must take part; of several classes one is enough.
    ///
    /// # Errors
    /// The first word that is none of these.
    pub fn read(text: &str) -> Result<EventFilter, UnknownWord> {
        let mut filter = EventFilter::default();
        let mut words = text.split_whitespace().peekable();
        while let Some(word) = words.next() {
            let classes = CLASSES.iter().filter(|(name, _)| name.starts_with(word)).map(|(_, class)| *class);
            let before = filter.classes.len();
            filter.classes.extend(classes);
            if filter.classes.len() > before {
                continue;
            }
            if "wall".starts_with(word) {
                let number = words.peek().and_then(|next| next.parse().ok());
                words.next_if(|_| number.is_some());
                filter.wall = Some(number);
            } else if let Ok(sphere) = word.strip_prefix('#').unwrap_or(word).parse() {
                filter.spheres.push(sphere);
            } else {
                return Err(UnknownWord(word.into()));
            }
        }
        Ok(filter)
    }

    /// Whether an event is wanted.
    pub fn passes(&self, event: &Logged) -> bool {
        let Logged { kind, a, b, class, .. } = *event;
        let takes_part = |sphere: &u32| *sphere == a || kind == Kind::Pair && *sphere == b;
        let wall = self.wall.is_none_or(|wall| kind == Kind::Wall && wall.is_none_or(|wall| wall == b));
        wall && (self.classes.is_empty() || self.classes.contains(&class)) && self.spheres.iter().all(takes_part)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(kind: Kind, a: u32, b: u32, class: Class) -> Logged {
        Logged { time: 1.0, approach_speed: 1.0, separation_speed: 0.8, impulse: 1.8, a, b, kind, class }
    }

    #[test]
    fn spheres_walls_and_classes_narrow_the_list() {
        let hit = event(Kind::Wall, 3, 0, Class::Collide);
        let pair = event(Kind::Pair, 3, 5, Class::Collide);
        let rest = event(Kind::Wall, 5, 2, Class::Rest);
        let release = event(Kind::Pair, 0, 5, Class::Release);
        for (text, wanted) in [
            ("", [true, true, true, true]),
            (" 3 ", [true, true, false, false]),
            ("#5", [false, true, true, true]),
            ("3 5", [false, true, false, false]),
            ("0", [false, false, false, true]), // wall 0 is no sphere
            ("wall", [true, false, true, false]),
            ("wall 0", [true, false, false, false]),
            ("wall 2 5", [false, false, true, false]),
            ("coll", [true, true, false, false]),
            ("re", [false, false, true, true]), // rest and release begin so
            ("rest", [false, false, true, false]),
            ("rest collision", [true, true, true, false]),
            ("release 5", [false, false, false, true]),
        ] {
            let filter = EventFilter::read(text).expect(text);
            assert_eq!([hit, pair, rest, release].map(|event| filter.passes(&event)), wanted, "{text:?}");
        }
    }

    #[test]
    fn a_word_that_says_nothing_is_named() {
        let error = EventFilter::read("3 bounce").expect_err("no such word").to_string();
        assert!(error.starts_with("bounce is not allowed: a filter takes spheres"), "{error}");
    }
}
