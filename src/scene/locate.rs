//! Where a value stands in a file. RON keeps no positions once a value is read, and rules across bodies are
//! checked only then: so the text is walked once more, and only when there is something to refuse.

/// One step down from a value to a part of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Step<'a> {
    /// To the field of that name.
    Field(&'a str),
    /// To the element of that index.
    Index(usize),
}

/// A place in a text; both count from 1, columns in characters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
}

/// Where the value at `path` starts; none if the text has no such value.
pub(super) fn locate(text: &str, path: &[Step]) -> Option<Position> {
    let mut scan = Scan { text, at: 0 };
    scan.skip_attributes();
    for step in path {
        scan.enter()?;
        match step {
            Step::Index(index) => (0..*index).try_for_each(|_| scan.skip_element())?,
            Step::Field(name) => scan.find_field(name)?,
        }
        scan.skip_blank();
    }
    Some(position(text, scan.at))
}

/// Line and column of a byte offset.
pub(super) fn position(text: &str, offset: usize) -> Position {
    let before = &text[..offset];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    Position { line: 1 + before.matches('\n').count(), column: 1 + before[line_start..].chars().count() }
}

/// The text from a position to the end; empty if there is no such position.
pub(super) fn rest_at(text: &str, place: Position) -> &str {
    let start: usize = text.split_inclusive('\n').take(place.line - 1).map(str::len).sum();
    let line = &text[start..];
    line.char_indices().nth(place.column - 1).map_or("", |(offset, _)| &line[offset..])
}

/// A cursor over RON text that knows just enough to step over values.
struct Scan<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Scan<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn skip_while(&mut self, condition: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.at += rest.find(|c| !condition(c)).unwrap_or(rest.len());
    }

    fn skip_past(&mut self, end: &str) {
        let rest = self.rest();
        self.at += rest.find(end).map_or(rest.len(), |found| found + end.len());
    }

    fn consume(&mut self, expected: char) -> Option<()> {
        self.rest().starts_with(expected).then(|| self.at += expected.len_utf8())
    }

    /// Moves past white space and comments.
    fn skip_blank(&mut self) {
        loop {
            self.skip_while(|c| c.is_whitespace() || matches!(c, '\u{200e}' | '\u{200f}' | '\u{feff}'));
            match self.rest() {
                rest if rest.starts_with("//") => self.skip_past("\n"),
                rest if rest.starts_with("/*") => self.skip_block_comment(),
                _ => return,
            }
        }
    }

    /// Moves past one block comment; block comments nest.
    fn skip_block_comment(&mut self) {
        let mut depth = 0_usize;
        while !self.rest().is_empty() {
            if self.rest().starts_with("/*") {
                (depth, self.at) = (depth + 1, self.at + 2);
            } else if self.rest().starts_with("*/") {
                (depth, self.at) = (depth - 1, self.at + 2);
            } else {
                self.skip_char();
            }
            if depth == 0 {
                return;
            }
        }
    }

    fn skip_char(&mut self) {
        self.at += self.rest().chars().next().map_or(0, char::len_utf8);
    }

    /// Moves past `#![enable(…)]` lines.
    fn skip_attributes(&mut self) {
        self.skip_blank();
        while self.rest().starts_with("#!") {
            self.skip_past("]");
            self.skip_blank();
        }
    }

    /// Moves into the value under the cursor: past its name, if any, and its opening bracket.
    fn enter(&mut self) -> Option<()> {
        self.skip_blank();
        self.identifier();
        self.skip_blank();
        self.consume('(').or_else(|| self.consume('[')).or_else(|| self.consume('{'))
    }

    fn identifier(&mut self) -> &'a str {
        let start = self.at;
        self.skip_while(|c| c.is_alphanumeric() || c == '_' || c == '#');
        self.text[start..self.at].trim_start_matches("r#")
    }

    /// Moves to the value of the field of that name, among those of the struct just entered.
    fn find_field(&mut self, name: &str) -> Option<()> {
        loop {
            self.skip_blank();
            let found = self.identifier();
            self.skip_blank();
            self.consume(':')?;
            if found == name {
                return Some(());
            }
            self.skip_element()?;
        }
    }

    /// Moves past one value and the comma behind it; none at the end of the list.
    fn skip_element(&mut self) -> Option<()> {
        let mut depth = 0_usize;
        loop {
            self.skip_blank();
            match self.rest().chars().next()? {
                ',' if depth == 0 => return self.consume(','),
                '(' | '[' | '{' => depth += 1,
                ')' | ']' | '}' => depth = depth.checked_sub(1)?,
                '"' => {
                    self.skip_string();
                    continue;
                }
                'r' if self.skip_raw_string() => continue,
                _ => {}
            }
            self.skip_char();
        }
    }

    fn skip_string(&mut self) {
        self.skip_char();
        while let Some(c) = self.rest().chars().next() {
            self.skip_char();
            match c {
                '"' => return,
                '\\' => self.skip_char(),
                _ => {}
            }
        }
    }

    /// Moves past `r"…"` or `r#"…"#`; false if there is none.
    fn skip_raw_string(&mut self) -> bool {
        let hashes = self.rest()[1..].chars().take_while(|&c| c == '#').count();
        let raw = self.rest()[1 + hashes..].starts_with('"');
        if raw {
            self.at += 2 + hashes;
            self.skip_past(&format!("\"{}", "#".repeat(hashes)));
        }
        raw
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r####"#![enable(implicit_some)]
/* a /* nested */ comment ) */
Scene(
    name: "a \" ), spheres: [", // spheres: (
    about: r#"x" ) ["#,
    walls: [],
    spheres: [
        Sphere(x: (0, 1, 2), mass: 1),
        // Sphere(mass: 9),
        Sphere(mass: 2, x: (3, 4,
            5)), Gas(count: 7),
    ],
)"####;

    fn place(path: &[Step]) -> Option<(usize, usize)> {
        locate(TEXT, path).map(|p| (p.line, p.column))
    }

    #[test]
    fn strings_and_comments_do_not_mislead_it() {
        use Step::{Field, Index};
        assert_eq!(place(&[Field("spheres")]), Some((7, 14)));
        assert_eq!(place(&[Field("spheres"), Index(1)]), Some((10, 9)));
        assert_eq!(place(&[Field("spheres"), Index(1), Field("x"), Index(2)]), Some((11, 13)));
        assert_eq!(place(&[Field("spheres"), Index(2), Field("count")]), Some((11, 29)));
        assert_eq!(place(&[]), Some((3, 1)));
    }

    #[test]
    fn what_is_not_there_has_no_place() {
        use Step::{Field, Index};
        assert_eq!(place(&[Field("gravity")]), None);
        assert_eq!(place(&[Field("spheres"), Index(9)]), None);
        assert_eq!(place(&[Field("name"), Index(0)]), None);
    }

    #[test]
    fn a_position_leads_back_to_its_text() {
        let found = locate(TEXT, &[Step::Field("walls")]).map(|p| rest_at(TEXT, p));
        assert!(found.is_some_and(|rest| rest.starts_with("[],\n")));
        assert_eq!(rest_at("ab", Position { line: 3, column: 1 }), "");
    }
}
