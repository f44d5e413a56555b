//! Ranges as types: a value that exists is allowed, and RON reports the line and column of one that is not.

use std::fmt;

use glam::DVec3;
use serde::{Deserialize, Deserializer, de};

use super::error::quote;
use super::validated::{Color, Method};
use crate::format::number;
use crate::printable::{described, is_printable};

/// Largest magnitude of a coordinate, speed, mass or radius, in SI units. Beyond it the products of the solvers
/// (areas squared, masses times squared speeds) would come near the end of f64.
pub(super) const LARGEST: f64 = 1e30;
/// Smallest mass (kg), radius and edge (m): below it the products of the solvers would come near the smallest f64.
pub(super) const SMALLEST: f64 = 1e-30;
/// Most spheres in a scene.
pub(super) const MOST_SPHERES: usize = 1_000_000;
/// Most walls in a scene, a room's six counted. Every sphere of `paper` asks for every wall in every frame, so that more
/// would be of no use.
pub(super) const MOST_WALLS: usize = 100_000;
/// Longest name or `about`, characters.
const LONGEST_TEXT: usize = 300;

/// Defines a number type by the test that its values pass and the words for them.
macro_rules! number {
    ($(#[$doc:meta])* $name:ident, $passes:expr, $allowed:expr) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
        #[serde(try_from = "f64")]
        pub(super) struct $name(pub(super) f64);

        impl TryFrom<f64> for $name {
            type Error = String;

            fn try_from(value: f64) -> Result<$name, String> {
                let passes: fn(f64) -> bool = $passes;
                let refusal = || format!("{} is refused; allowed is {}", number(value), $allowed);
                passes(value).then_some($name(value)).ok_or_else(refusal)
            }
        }
    };
}

number!(
    /// A coordinate or a component of a velocity where a run has taken it.
    Finite,
    |value| value.is_finite(),
    "a finite number"
);
number!(
    /// A coordinate or a component of a vector.
    Number,
    |value| value.abs() <= LARGEST,
    "a finite number from -1e30 to 1e30"
);
number!(
    /// A mass, radius or spacing.
    Positive,
    |value| (SMALLEST..=LARGEST).contains(&value),
    "a number above 0 (from 1e-30 to 1e30)"
);
number!(
    /// A step in time.
    Interval,
    |value| value > 0.0 && value.is_finite(),
    "a finite number above 0"
);
number!(
    /// A tolerance, a duration or the rest speed: any size, since nothing multiplies them.
    NotNegative,
    |value| value >= 0.0 && value.is_finite(),
    "a finite number from 0 upwards"
);
number!(
    /// A speed or a jitter: part of a velocity or coordinate, so bounded like them.
    Amount,
    |value| (0.0..=LARGEST).contains(&value),
    "a number from 0 to 1e30"
);
number!(
    /// A coefficient, or a channel of a colour.
    Fraction,
    |value| (0.0..=1.0).contains(&value),
    "a number from 0 to 1"
);

/// A number of things.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "f64")]
pub(super) struct Count(pub(super) usize);

impl TryFrom<f64> for Count {
    type Error = String;

    fn try_from(value: f64) -> Result<Count, String> {
        if value % 1.0 == 0.0 && (1.0..=MOST_SPHERES as f64).contains(&value) {
            Ok(Count(value as usize))
        } else {
            Err(format!("{} is refused; allowed is a whole number from 1 to {MOST_SPHERES}", number(value)))
        }
    }
}

/// A position (m), velocity (m/s), force (N) or acceleration (m/s²).
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(from = "(Number, Number, Number)")]
pub(super) struct Vector(pub(super) DVec3);

impl From<(Number, Number, Number)> for Vector {
    fn from((x, y, z): (Number, Number, Number)) -> Vector {
        Vector(DVec3::new(x.0, y.0, z.0))
    }
}

/// A colour as written.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(from = "(Fraction, Fraction, Fraction)")]
pub(super) struct Rgb(pub(super) Color);

impl From<(Fraction, Fraction, Fraction)> for Rgb {
    fn from((red, green, blue): (Fraction, Fraction, Fraction)) -> Rgb {
        Rgb([red.0, green.0, blue.0])
    }
}

/// A name or a line of text, fit to be printed.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct Text(pub(super) String);

impl TryFrom<String> for Text {
    type Error = String;

    fn try_from(text: String) -> Result<Text, String> {
        if let Some(c) = text.chars().find(|&c| !is_printable(c)) {
            let what = described(c);
            return Err(format!("the character {what} is refused; allowed is text of characters that can be seen"));
        }
        match text.chars().count() {
            count if count > LONGEST_TEXT => {
                Err(format!("a text of {count} characters is refused; allowed are up to {LONGEST_TEXT}"))
            }
            _ => Ok(Text(text)),
        }
    }
}

/// The method by its name, whichever methods there are.
pub(super) fn method<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Method>, D::Error> {
    deserializer.deserialize_identifier(MethodName).map(Some)
}

struct MethodName;

impl de::Visitor<'_> for MethodName {
    type Value = Method;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name of a method")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Method, E> {
        Method::from_name(name).ok_or_else(|| {
            let names: Vec<_> = Method::ALL.iter().map(|method| quote(method.name())).collect();
            E::custom(format!("{} is refused; allowed is {}", quote(name), names.join(", ")))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extremes_that_runs_must_stand_are_allowed() {
        assert!([1e-9, 1e9, 1e12].into_iter().all(|value| Positive::try_from(value).is_ok()));
        assert!([1e-12, 1e6].into_iter().all(|value| Interval::try_from(value).is_ok()));
        assert!([0.0, 1e300].into_iter().all(|value| NotNegative::try_from(value).is_ok()));
        assert!([-1e9, 1e9].into_iter().all(|value| Number::try_from(value).is_ok()));
    }

    #[test]
    fn what_is_not_a_finite_number_is_refused_by_every_type() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(Number::try_from(value).is_err() && Positive::try_from(value).is_err());
            assert!(Interval::try_from(value).is_err() && NotNegative::try_from(value).is_err());
            assert!(Amount::try_from(value).is_err() && Fraction::try_from(value).is_err());
            assert!(Count::try_from(value).is_err());
        }
    }
}
