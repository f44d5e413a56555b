//! RON as text and as values: reading it, and telling what is wrong with it where.

use serde::Deserialize;
use serde_path_to_error::Segment;

use super::error::{Error, QUOTE, Source, quote};
use super::locate::{Position, Step, locate, position, rest_at};
use crate::printable::shortened;

/// What a kind of file is called in messages.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Words {
    /// What the file holds, a noun: `scene`.
    pub(crate) what: &'static str,
    /// Names that may stand in it without quotes.
    pub(crate) names: &'static str,
    /// Levels of brackets that it needs.
    pub(crate) levels: &'static str,
}

/// Reads a text as what it should hold.
///
/// # Errors
/// The first thing in it that is not as it should be, with its line, column and field.
pub(crate) fn read<'a, T: Deserialize<'a>>(source: Source<'a>, words: Words) -> Result<T, Error> {
    // Optional fields are written as plain values, as the whole format is: `Some(…)` is noise in a file written by hand.
    let options = ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME);
    let mut deserializer = ron::Deserializer::from_str_with_options(source.text, &options)
        .map_err(|error| Refusal { source, words }.of(&[], error.code, error.span))?;
    match serde_path_to_error::deserialize(&mut deserializer) {
        Ok(file) => match deserializer.end() {
            Ok(()) => Ok(file),
            Err(code) => {
                let place = position(source.text, source.text.len() - deserializer.remainder().len());
                Err(source.refuse_at(Some(place), &[], sentence(&code, rest_at(source.text, place), words)))
            }
        },
        Err(error) => {
            let path: Vec<Step> = error.path().iter().filter_map(step).collect();
            let spanned = deserializer.span_error(error.inner().clone());
            Err(Refusal { source, words }.of(&path, spanned.code, spanned.span))
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

/// A text that RON refuses.
#[derive(Clone, Copy)]
struct Refusal<'a> {
    source: Source<'a>,
    words: Words,
}

impl Refusal<'_> {
    /// What RON refused, at its place: where the value at `path` starts if the value is wrong, where the parser stopped
    /// if the text is.
    fn of(self, path: &[Step], code: ron::Error, span: ron::error::Span) -> Error {
        use ron::Error::*;
        let text = self.source.text;
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
            | ExpectedDifferentStructName { .. } => locate(text, path).or(parser(span.start)),
            _ => parser(span.end),
        };
        let rest = place.map_or("", |place| rest_at(text, place));
        self.source.refuse_at(place, path, sentence(&code, rest, self.words))
    }
}

/// What RON refused, for people; `rest` is the text from there on.
fn sentence(code: &ron::Error, rest: &str, words: Words) -> String {
    use ron::Error::*;
    let Words { what, names, levels } = words;
    let found = found(rest);
    match code {
        Eof | ExpectedStringEnd | UnclosedBlockComment => "the file ends before what was begun is closed".to_owned(),
        ExpectedStructLike | ExpectedNamedStructLike(_) if rest.is_empty() => format!("the file holds no {what}"),
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
            format!("{found} is refused; a name without quotes must stand here, like {names}")
        }
        ExpectedStructLike | ExpectedNamedStructLike(_) => {
            format!("{found} is refused; an opening `(` must stand here")
        }
        ExpectedStructLikeEnd => format!("{found} is refused; a closing `)` must stand here"),
        ExpectedArrayEnd => format!("{found} is refused; a closing `]` must stand here"),
        ExpectedComma => format!("{found} is refused; a comma or the closing bracket must stand here"),
        ExpectedMapColon => format!("{found} is refused; a colon must stand here"),
        NoSuchExtension(name) => format!("there is no RON extension {}", quote(name)),
        TrailingCharacters => format!("{found} is refused; nothing may follow the {what}'s closing `)`"),
        ExceededRecursionLimit => format!("brackets are nested too deeply; a {what} needs {levels} levels"),
        other => format!("{found} is refused: {other}"),
    }
}

/// The piece of the file that stands where reading failed.
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
