//! The `:` line: exact values, and what to run until.

use super::until::{self, Named};
use crate::worker::Stop;

/// What was asked for on the `:` line; every value is already within its rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Order {
    /// Longest frame, s, > 0.
    Dt(f64),
    /// Intersection tolerance, dimensionless, ≥ 0.
    Tolerance(f64),
    /// Simulated seconds per second, > 0.
    Speed(f64),
    /// Time to go to, s, ≥ 0.
    Goto(f64),
    /// Run until this comes.
    Until(Stop),
    /// Say the time and the hash of the state shown, as the closing line of `carom run` does.
    Hash,
    /// Panic, so that a test can see what a user would; not in the release program.
    #[cfg(debug_assertions)]
    #[doc(hidden)]
    Panic {
        /// In the simulation's thread, not in the one that draws.
        simulation: bool,
    },
}

/// A word of the `:` line and the rule for its value.
struct Word {
    name: &'static str,
    rule: &'static str,
    example: &'static str,
    allows: fn(f64) -> bool,
    order: fn(f64) -> Order,
}

const WORDS: &[Word] = &[
    Word { name: "dt", rule: "seconds above 0", example: "1e-3", allows: |v| v > 0.0, order: Order::Dt },
    Word { name: "tolerance", rule: "0 or more", example: "1e-9", allows: |v| v >= 0.0, order: Order::Tolerance },
    Word {
        name: "speed",
        rule: "seconds per second above 0",
        example: "0.1",
        allows: |v| v > 0.0,
        order: Order::Speed,
    },
    Word { name: "goto", rule: "seconds, 0 or more", example: "3.25", allows: |v| v >= 0.0, order: Order::Goto },
];

/// The word that takes no value.
const HASH: &str = "hash";

/// The word that takes a language of its own.
const UNTIL: &str = "until";

/// Reads the text after the colon, in which these bodies can be named; `None` if there is no text.
///
/// # Errors
/// A sentence that names the offending word and what is allowed.
pub(super) fn read(text: &str, named: Named) -> Result<Option<Order>, String> {
    let mut parts = text.split_whitespace();
    let Some(name) = parts.next() else { return Ok(None) };
    #[cfg(debug_assertions)]
    if name == "panic" {
        return Ok(Some(Order::Panic { simulation: parts.next().is_some() }));
    }
    if name == UNTIL {
        let rest = text.trim_start().strip_prefix(UNTIL).unwrap_or("");
        return until::read(rest, named).map(|stop| Some(Order::Until(stop)));
    }
    if name == HASH {
        return match parts.next() {
            None => Ok(Some(Order::Hash)),
            Some(_) => Err(format!(":{HASH} takes no value: it tells the hash of the state shown.")),
        };
    }
    let Some(word) = WORDS.iter().find(|word| word.name == name) else {
        let known: Vec<&str> = WORDS.iter().map(|word| word.name).chain([UNTIL, HASH]).collect();
        return Err(format!("There is no :{name}; there are {}.", known.join(", ")));
    };
    let value = parts.collect::<Vec<_>>().join(" ");
    match value.parse::<f64>() {
        Ok(number) if number.is_finite() && (word.allows)(number) => Ok(Some((word.order)(number))),
        _ if value.is_empty() => {
            Err(format!(":{name} needs a number ({}), as in :{name} {}.", word.rule, word.example))
        }
        _ => Err(format!("{value} is not allowed: :{name} takes {}, as in :{name} {}.", word.rule, word.example)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{snapshot::Class, worker::Bodies};

    fn read(text: &str) -> Result<Option<Order>, String> {
        super::read(text, Named { spheres: 3, walls: 1, selected: None })
    }

    #[test]
    fn every_word_takes_its_value() {
        assert_eq!(read("dt 1e-3"), Ok(Some(Order::Dt(1e-3))));
        assert_eq!(read(" tolerance  0 "), Ok(Some(Order::Tolerance(0.0))));
        assert_eq!(read("speed .1"), Ok(Some(Order::Speed(0.1))));
        assert_eq!(read("goto 3.25"), Ok(Some(Order::Goto(3.25))));
        let stop = Stop::Event(Class::Collide, Bodies::Pair(0, 2));
        assert_eq!(
            read(" until collision 2 0"),
            Ok(Some(Order::Until(Stop::Event(Class::Collide, Bodies::Pair(2, 0)))))
        );
        assert_eq!(read("until collision 0 2"), Ok(Some(Order::Until(stop))));
        assert_eq!(read("hash"), Ok(Some(Order::Hash)));
        assert_eq!(read("  "), Ok(None));
    }

    #[test]
    fn an_error_names_the_value_and_what_is_allowed() {
        assert_eq!(read("dtt 1"), Err("There is no :dtt; there are dt, tolerance, speed, goto, until, hash.".into()));
        assert_eq!(read("hash 1"), Err(":hash takes no value: it tells the hash of the state shown.".into()));
        assert_eq!(read("dt"), Err(":dt needs a number (seconds above 0), as in :dt 1e-3.".into()));
        for bad in ["0", "-1", "nan", "inf", "1 2", "1e-3s"] {
            let said = read(&format!("dt {bad}"));
            assert_eq!(said, Err(format!("{bad} is not allowed: :dt takes seconds above 0, as in :dt 1e-3.")));
        }
    }
}
