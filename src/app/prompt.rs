//! The `:` line: exact values, and what to run until.

use super::until::{self, Named};
use super::view_settings::NAMED;
use crate::{scene::Method, worker::Stop};

/// What was asked for on the `:` line; every value is already within its rule.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Order {
    /// Longest frame, s, > 0.
    Dt(f64),
    /// Intersection tolerance, dimensionless, ≥ 0.
    Tolerance(f64),
    /// Simulated seconds per second, > 0.
    Speed(f64),
    /// Time to go to, s, ≥ 0.
    Goto(f64),
    /// Run until this comes to pass.
    Until(Stop),
    /// Solve by this method from here on.
    Method(Method),
    /// Open this scene.
    Scene(String),
    /// Show, or hide, overlays of these names.
    Show(String, bool),
    /// Select this sphere, or none.
    Select(Option<usize>),
    /// Say the time and the hash of the state shown, as the closing line of `carom run` does.
    Hash,
    /// Panic, so that a test can see what a user would; not in the release program.
    #[cfg(debug_assertions)]
    #[doc(hidden)]
    Panic {
        /// Whether the simulation's thread panics, not the one that draws.
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

/// The words that take something else than a number; the first takes nothing.
const OTHERS: [&str; 7] = ["hash", "until", "method", "scene", "select", "show", "hide"];

/// What can be named on the line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Context<'a> {
    pub(super) spheres: usize,
    pub(super) walls: usize,
    /// The selected sphere.
    pub(super) selected: Option<usize>,
    /// Scenes by name.
    pub(super) scenes: &'a [String],
}

/// Reads the text after the colon; `None` if there is none.
///
/// # Errors
/// A sentence that names the offending word and what is allowed.
pub(super) fn read(text: &str, context: &Context) -> Result<Option<Order>, String> {
    let mut parts = text.split_whitespace();
    let Some(name) = parts.next() else { return Ok(None) };
    #[cfg(debug_assertions)]
    if name == "panic" {
        return Ok(Some(Order::Panic { simulation: parts.next().is_some() }));
    }
    let value = text.trim_start().strip_prefix(name).unwrap_or("").trim();
    match name {
        "hash" if value.is_empty() => return Ok(Some(Order::Hash)),
        "hash" => return Err(":hash takes no value: it tells the hash of the state shown.".into()),
        "until" => {
            let Context { spheres, walls, selected, .. } = *context;
            return until::read(value, Named { spheres, walls, selected }).map(|stop| Some(Order::Until(stop)));
        }
        "method" => return method(value).map(Some),
        "scene" if value.is_empty() => return Err(":scene needs a name or a path, as in :scene paper-2.".into()),
        "scene" => return Ok(Some(Order::Scene(value.into()))),
        "show" | "hide" => return Ok(Some(Order::Show(value.into(), name == "show"))),
        "select" => return select(value, context.spheres).map(Some),
        _ => {}
    }
    let Some(word) = WORDS.iter().find(|word| word.name == name) else {
        let known: Vec<&str> = WORDS.iter().map(|word| word.name).chain(OTHERS).collect();
        return Err(format!("There is no :{name}; there are {}.", known.join(", ")));
    };
    let value = value.split_whitespace().collect::<Vec<_>>().join(" ");
    match value.parse::<f64>() {
        Ok(number) if number.is_finite() && (word.allows)(number) => Ok(Some((word.order)(number))),
        _ if value.is_empty() => {
            Err(format!(":{name} needs a number ({}), as in :{name} {}.", word.rule, word.example))
        }
        _ => Err(format!("{value} is not allowed: :{name} takes {}, as in :{name} {}.", word.rule, word.example)),
    }
}

fn method(value: &str) -> Result<Order, String> {
    let found = Method::ALL.iter().find(|method| method.name() == value);
    found.map(|method| Order::Method(*method)).ok_or_else(|| {
        let names: Vec<&str> = Method::ALL.iter().map(|method| method.name()).collect();
        let what = if value.is_empty() { "Nothing" } else { value };
        format!("{what} is not allowed: :method takes {}.", names.join(", "))
    })
}

fn select(value: &str, spheres: usize) -> Result<Order, String> {
    match value.parse::<usize>() {
        _ if value == "none" => Ok(Order::Select(None)),
        Ok(index) if index < spheres => Ok(Order::Select(Some(index))),
        _ if spheres == 0 => Err("This scene has no spheres.".into()),
        _ => {
            let what = if value.is_empty() { "Nothing" } else { value };
            Err(format!("{what} is not allowed: :select takes a sphere, 0 to {}, or none.", spheres - 1))
        }
    }
}

/// What the last word of a text may go on as: the words that are allowed there and begin like it.
pub(super) fn offers(text: &str, context: &Context) -> Vec<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let (before, word) = match words.split_last() {
        Some((last, before)) if !text.ends_with(char::is_whitespace) => (before, *last),
        _ => (&words[..], ""),
    };
    let allowed: Vec<&str> = match before {
        [] => WORDS.iter().map(|word| word.name).chain(OTHERS).collect(),
        ["until"] => until::WORDS.to_vec(),
        ["until", "collision" | "rest" | "release"] => vec!["selected"],
        ["until", "collision" | "rest" | "release", _] => vec!["wall"],
        ["method"] => Method::ALL.iter().map(|method| method.name()).collect(),
        ["scene"] => context.scenes.iter().map(String::as_str).collect(),
        ["select"] => vec!["none"],
        ["show" | "hide", ..] => NAMED.iter().map(|(name, _)| *name).chain(["all"]).collect(),
        _ => Vec::new(),
    };
    allowed.into_iter().filter(|offer| offer.starts_with(word) && *offer != word).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{snapshot::Class, worker::Bodies};

    fn read(text: &str) -> Result<Option<Order>, String> {
        super::read(text, &Context { spheres: 3, walls: 1, selected: None, scenes: &[] })
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
        assert_eq!(read("method swept"), Ok(Some(Order::Method(Method::Swept))));
        assert_eq!(read("scene  my scenes/a.ron "), Ok(Some(Order::Scene("my scenes/a.ron".into()))));
        assert_eq!(read("select 2"), Ok(Some(Order::Select(Some(2)))));
        assert_eq!(read("select none"), Ok(Some(Order::Select(None))));
        assert_eq!(read("  "), Ok(None));
    }

    #[test]
    fn an_error_names_the_value_and_what_is_allowed() {
        assert_eq!(
            read("dtt 1"),
            Err("There is no :dtt; there are dt, tolerance, speed, goto, hash, until, method, scene, select, show, hide.".into())
        );
        assert_eq!(read("hash 1"), Err(":hash takes no value: it tells the hash of the state shown.".into()));
        assert_eq!(
            read("method euler"),
            Err("euler is not allowed: :method takes METHODS.".replace("METHODS", &methods()))
        );
        let allowed = "is not allowed: :select takes a sphere, 0 to 2, or none.";
        assert_eq!(read("select 3"), Err(format!("3 {allowed}")));
        assert_eq!(read("select"), Err(format!("Nothing {allowed}")));
        assert_eq!(read("scene"), Err(":scene needs a name or a path, as in :scene paper-2.".into()));
        assert_eq!(read("dt"), Err(":dt needs a number (seconds above 0), as in :dt 1e-3.".into()));
        for bad in ["0", "-1", "nan", "inf", "1 2", "1e-3s"] {
            let said = read(&format!("dt {bad}"));
            assert_eq!(said, Err(format!("{bad} is not allowed: :dt takes seconds above 0, as in :dt 1e-3.")));
        }
    }

    fn methods() -> String {
        Method::ALL.iter().map(|method| method.name()).collect::<Vec<_>>().join(", ")
    }

    #[test]
    fn words_are_offered_where_they_are_allowed() {
        let scenes = ["paper-0".to_owned(), "pile".to_owned()];
        let offers = |text: &str| {
            super::offers(text, &Context { spheres: 3, walls: 1, selected: None, scenes: &scenes }).join(" ")
        };
        assert_eq!(offers("s"), "speed scene select show");
        assert_eq!(offers("hide path pre"), "predicted");
        assert_eq!(offers("scene p"), "paper-0 pile");
        assert_eq!(offers("until "), until::WORDS.join(" "));
        assert_eq!(offers("until rest 2 "), "wall");
        assert_eq!(offers("dt 1"), "");
    }
}
