//! The RON shape of a scene as written. Every range that concerns one value alone is checked here, by its type.

use serde::Deserialize;
use serde_path_to_error::Segment;

use super::error::{Error, QUOTE, Source, quote};
use super::locate::{Position, Step, locate, position, rest_at};
use super::number::{Amount, Count, Fraction, Interval, NotNegative, Positive, Rgb, Text, Vector, method};
use super::validated::Method;
use crate::printable::shortened;

/// A scene file.
#[derive(Debug, Deserialize)]
#[serde(rename = "Scene", deny_unknown_fields)]
pub(super) struct SceneFile {
    pub(super) name: Option<Text>,
    #[serde(default)]
    pub(super) about: Text,
    #[serde(default)]
    pub(super) gravity: Vector,
    #[serde(default)]
    pub(super) contact: ContactFile,
    #[serde(default)]
    pub(super) solver: SolverFile,
    pub(super) duration: Option<NotNegative>,
    pub(super) view: Option<BoxFile>,
    #[serde(default)]
    pub(super) walls: Vec<WallFile>,
    #[serde(default)]
    pub(super) spheres: Vec<SphereFile>,
}

/// The contact law; what is left out has the paper's value.
#[derive(Debug, Default, Deserialize)]
#[serde(rename = "Contact", deny_unknown_fields)]
pub(super) struct ContactFile {
    pub(super) restitution: Option<Fraction>,
    pub(super) wall_restitution: Option<Fraction>,
    pub(super) tangential: Option<Fraction>,
    pub(super) rest_speed: Option<NotNegative>,
}

/// What to solve with; what is left out has the paper's value.
#[derive(Debug, Default, Deserialize)]
#[serde(rename = "Solver", deny_unknown_fields)]
pub(super) struct SolverFile {
    #[serde(default, deserialize_with = "method")]
    pub(super) method: Option<Method>,
    pub(super) dt: Option<Interval>,
    pub(super) tolerance: Option<NotNegative>,
}

/// A box, m.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename = "View", deny_unknown_fields)]
pub(super) struct BoxFile {
    pub(super) min: Vector,
    pub(super) max: Vector,
}

/// An entry of `walls`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) enum WallFile {
    Wall { center: Vector, s1: Vector, s2: Vector, color: Option<Rgb> },
    Room { min: Vector, max: Vector, color: Option<Rgb> },
}

/// An entry of `spheres`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) enum SphereFile {
    Sphere {
        x: Vector,
        #[serde(default)]
        v: Vector,
        mass: Positive,
        radius: Positive,
        #[serde(default)]
        force: Vector,
        color: Option<Rgb>,
        name: Option<Text>,
    },
    Lattice {
        origin: Vector,
        counts: (Count, Count, Count),
        spacing: Positive,
        jitter: Option<Amount>,
        #[serde(default)]
        seed: u64,
        mass: Positive,
        radius: Positive,
        #[serde(default)]
        v: Vector,
        speed: Option<Amount>,
        color: Option<Rgb>,
    },
    Gas {
        min: Vector,
        max: Vector,
        count: Count,
        #[serde(default)]
        seed: u64,
        speed: Option<Amount>,
        mass: Positive,
        radius: Positive,
        color: Option<Rgb>,
    },
}

/// Reads the text of a scene.
pub(super) fn read(source: Source) -> Result<SceneFile, Error> {
    // Optional fields are written as plain values, as the whole format is: `Some(…)` is noise in a file written by hand.
    let options = ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME);
    let mut deserializer = ron::Deserializer::from_str_with_options(source.text, &options)
        .map_err(|error| refusal(source, &[], error.code, error.span))?;
    match serde_path_to_error::deserialize(&mut deserializer) {
        Ok(file) => match deserializer.end() {
            Ok(()) => Ok(file),
            Err(code) => {
                let place = position(source.text, source.text.len() - deserializer.remainder().len());
                Err(source.refuse_at(Some(place), &[], sentence(&code, rest_at(source.text, place))))
            }
        },
        Err(error) => {
            let path: Vec<Step> = error.path().iter().filter_map(step).collect();
            let spanned = deserializer.span_error(error.inner().clone());
            Err(refusal(source, &path, spanned.code, spanned.span))
        }
    }
}

/// A step of a path as serde follows it; the names of variants are no fields.
fn step(segment: &Segment) -> Option<Step<'_>> {
    match segment {
        Segment::Seq { index } => Some(Step::Index(*index)),
        Segment::Map { key } => Some(Step::Field(key)),
        Segment::Enum { .. } | Segment::Unknown => None,
    }
}

/// What RON refused, at its place: where the value at `path` starts if the value is wrong, where the parser stopped if
/// the text is.
fn refusal(source: Source, path: &[Step], code: ron::Error, span: ron::error::Span) -> Error {
    use ron::Error::*;
    let parser = |place: ron::error::Position| Some(Position { line: place.line, column: place.col });
    let place = match code {
        NoSuchStructField { .. } | NoSuchEnumVariant { .. } | DuplicateStructField { .. } => parser(span.start),
        Message(_)
        | InvalidValueForType { .. }
        | MissingStructField { .. }
        | ExpectedDifferentLength { .. }
        | ExpectedFloat
        | FloatUnderscore
        | ExpectedInteger
        | IntegerOutOfBounds
        | ExpectedString
        | ExpectedDifferentStructName { .. } => locate(source.text, path).or(parser(span.start)),
        _ => parser(span.end),
    };
    let rest = place.map_or("", |place| rest_at(source.text, place));
    source.refuse_at(place, path, sentence(&code, rest))
}

/// What RON refused, for people; `rest` is the text from there on.
fn sentence(code: &ron::Error, rest: &str) -> String {
    use ron::Error::*;
    let found = found(rest);
    match code {
        Eof | ExpectedStringEnd | UnclosedBlockComment => "the file ends before what was begun is closed".to_owned(),
        ExpectedStructLike | ExpectedNamedStructLike(_) if rest.is_empty() => "the file holds no scene".to_owned(),
        Message(message) => message.clone(),
        NoSuchStructField { expected, found, .. } => {
            format!("there is no field {}; allowed are {}", quote(found), listed(expected))
        }
        NoSuchEnumVariant { expected, found, .. } => {
            format!("{} is refused; allowed are {}", quote(found), listed(expected))
        }
        MissingStructField { field, .. } => format!("the field {} is missing", quote(field)),
        DuplicateStructField { field, .. } => format!("the field {} is given twice", quote(field)),
        InvalidValueForType { expected, found } => {
            format!("{} is refused; allowed is {expected}", shortened(found, QUOTE))
        }
        ExpectedDifferentLength { expected, found } => {
            format!("a tuple of size {found} is refused; allowed is {expected}")
        }
        ExpectedDifferentStructName { expected, found } => {
            format!("{} is refused; allowed is {}", quote(found), quote(expected))
        }
        ExpectedFloat | FloatUnderscore => format!("{found} is refused; allowed is a number"),
        ExpectedInteger | IntegerOutOfBounds => {
            format!("{found} is refused; allowed is a whole number from 0 to {}", u64::MAX)
        }
        ExpectedString => format!("{found} is refused; allowed is a text in double quotes"),
        ExpectedArray => format!("{found} is refused; allowed is a list in square brackets"),
        ExpectedIdentifier => {
            format!("{found} is refused; a name without quotes must stand here, like `Sphere`, `Wall` or `paper`")
        }
        ExpectedStructLike | ExpectedNamedStructLike(_) => {
            format!("{found} is refused; an opening `(` must stand here")
        }
        ExpectedStructLikeEnd => format!("{found} is refused; a closing `)` must stand here"),
        ExpectedArrayEnd => format!("{found} is refused; a closing `]` must stand here"),
        ExpectedComma => format!("{found} is refused; a comma or the closing bracket must stand here"),
        ExpectedMapColon => format!("{found} is refused; a colon must stand here"),
        NoSuchExtension(name) => format!("there is no RON extension {}", quote(name)),
        TrailingCharacters => format!("{found} is refused; nothing may follow the scene's closing `)`"),
        ExceededRecursionLimit => "brackets are nested too deeply; a scene needs five levels".to_owned(),
        other => format!("{found} is refused: {other}"),
    }
}

/// The piece of the file at which a reader stumbles.
fn found(rest: &str) -> String {
    let word = rest.split(|c: char| c.is_whitespace() || ",()[]{}".contains(c)).next().unwrap_or("");
    match (word, rest.chars().next()) {
        ("", Some(c)) => quote(&c.to_string()),
        ("", None) => "the end of the file".to_owned(),
        (word, _) => quote(word),
    }
}

/// The allowed names.
fn listed(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
