//! The `:` line while it is typed: cursor, orders given before, and what a word may go on as.

use tui_input::{Input, InputRequest};

use super::{
    keys::{Code, Key},
    prompt::{self, Context},
};

/// Longest text the line takes; more than any order needs.
pub(super) const LONGEST: usize = 200;

/// Most orders that are remembered.
const REMEMBERED: usize = 100;

/// What a key on the line leads to.
pub(super) enum Typed {
    /// A text still being typed.
    Text,
    /// Nothing: the line closes.
    Nothing,
    /// A text to obey.
    Order(String),
}

/// Orders given before, the newest last.
#[derive(Debug, Default)]
pub(super) struct Orders(Vec<String>);

impl Orders {
    /// Remembers an order, once if it is given twice in a row.
    pub(super) fn remember(&mut self, order: &str) {
        if order.trim().is_empty() || self.0.last().is_some_and(|last| last == order) {
            return;
        }
        if self.0.len() >= REMEMBERED {
            self.0.remove(0);
        }
        self.0.push(order.to_owned());
    }
}

/// The line.
#[derive(Debug, Default)]
pub(super) struct Line {
    input: Input,
    /// How many orders ago the order was given that is shown, and what had been typed before.
    recalled: Option<(usize, String)>,
}

impl Line {
    /// A line that begins with a text.
    pub(super) fn new(text: &str) -> Line {
        Line { input: Input::from(text), recalled: None }
    }

    pub(super) fn text(&self) -> &str {
        self.input.value()
    }

    /// The byte before which the cursor is.
    pub(super) fn cursor(&self) -> usize {
        let text = self.text();
        text.char_indices().nth(self.input.cursor()).map_or(text.len(), |(byte, _)| byte)
    }

    /// What the word under the cursor may go on as, if the cursor is at the line's end.
    pub(super) fn offers(&self, context: &Context) -> Vec<String> {
        if self.cursor() == self.text().len() { prompt::offers(self.text(), context) } else { Vec::new() }
    }

    /// Takes a key.
    pub(super) fn key(&mut self, key: Key, orders: &Orders, context: &Context) -> Typed {
        let request = match (key.code, key.ctrl) {
            (Code::Enter, _) => return Typed::Order(self.text().to_owned()),
            (Code::Escape, _) | (Code::Char('c'), true) => return Typed::Nothing,
            (Code::Backspace, _) if self.text().is_empty() => return Typed::Nothing,
            (Code::Tab, _) => return self.complete(context),
            (Code::Up, _) | (Code::Char('p'), true) => return self.recall(orders, true),
            (Code::Down, _) | (Code::Char('n'), true) => return self.recall(orders, false),
            (code, _) => match request(code, key) {
                Some(InputRequest::InsertChar(_)) if self.text().len() >= LONGEST => return Typed::Text,
                Some(request) => request,
                None => return Typed::Text,
            },
        };
        self.input.handle(request);
        Typed::Text
    }

    /// Types as much as all that the word may go on as have in common.
    fn complete(&mut self, context: &Context) -> Typed {
        let offers = self.offers(context);
        let Some(first) = offers.first() else { return Typed::Text };
        let common = offers[1..].iter().fold(first.as_str(), |common, offer| {
            let same = common.char_indices().zip(offer.chars()).find(|((_, a), b)| a != b);
            let length = same.map_or(common.len().min(offer.len()), |((byte, _), _)| byte);
            &common[..length]
        });
        let word = self.text().rfind(char::is_whitespace).map_or(0, |space| space + 1);
        let mut text = self.text()[..word].to_owned() + common;
        if offers.len() == 1 && !text.ends_with(['=', '>']) {
            text.push(' ');
        }
        self.input = Input::from(text);
        Typed::Text
    }

    /// Shows the order before the one shown, or after it; after the last comes what was being typed.
    fn recall(&mut self, orders: &Orders, back: bool) -> Typed {
        let count = orders.0.len();
        let (at, typed) = self.recalled.take().unwrap_or_else(|| (0, self.text().to_owned()));
        let next = if back { (at + 1).min(count) } else { at.saturating_sub(1) };
        let text = if next == 0 { typed.clone() } else { orders.0[count - next].clone() };
        self.input = Input::from(text);
        self.recalled = (next > 0).then_some((next, typed));
        Typed::Text
    }
}

/// What a key asks of the text.
fn request(code: Code, key: Key) -> Option<InputRequest> {
    Some(match (code, key.ctrl) {
        (Code::Left, true) => InputRequest::GoToPrevWord,
        (Code::Right, true) => InputRequest::GoToNextWord,
        (Code::Left, _) | (Code::Char('b'), true) => InputRequest::GoToPrevChar,
        (Code::Right, _) | (Code::Char('f'), true) => InputRequest::GoToNextChar,
        (Code::Home, _) | (Code::Char('a'), true) => InputRequest::GoToStart,
        (Code::End, _) | (Code::Char('e'), true) => InputRequest::GoToEnd,
        (Code::Backspace, _) => InputRequest::DeletePrevChar,
        (Code::Delete, _) | (Code::Char('d'), true) => InputRequest::DeleteNextChar,
        (Code::Char('w'), true) => InputRequest::DeletePrevWord,
        (Code::Char('u'), true) => InputRequest::DeleteLine,
        (Code::Char('k'), true) => InputRequest::DeleteTillEnd,
        _ => InputRequest::InsertChar(key.typed()?),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTEXT: Context = Context { spheres: 3, walls: 2, selected: None, scenes: &[] };

    /// The line after these keys; `<` and `>` are cursor keys, `^` is Up, `v` Down, `\t` Tab.
    fn typed(keys: &str, orders: &Orders) -> Line {
        let mut line = Line::default();
        for c in keys.chars() {
            let key = match c {
                '<' => Key::plain(Code::Left),
                '>' => Key::plain(Code::Right),
                '^' => Key::plain(Code::Up),
                'v' => Key::plain(Code::Down),
                '\t' => Key::plain(Code::Tab),
                c => Key::char(c),
            };
            let _ = line.key(key, orders, &CONTEXT);
        }
        line
    }

    #[test]
    fn a_mistake_is_mended_where_it_is() {
        let none = Orders::default();
        let line = typed("goo 3<<t", &none);
        assert_eq!((line.text(), line.cursor()), ("goot 3", 4));
        let mut line = typed("goto 3", &none);
        let _ = line.key(Key::ctrl('a'), &none, &CONTEXT);
        let _ = line.key(Key::ctrl('k'), &none, &CONTEXT);
        assert_eq!(line.text(), "");
        assert!(matches!(line.key(Key::plain(Code::Backspace), &none, &CONTEXT), Typed::Nothing));
        assert!(matches!(line.key(Key::ctrl('c'), &none, &CONTEXT), Typed::Nothing));
    }

    #[test]
    fn orders_come_back_and_what_was_being_typed_is_not_lost() {
        let mut orders = Orders::default();
        for order in ["goto 1", "goto 2", "goto 2", " "] {
            orders.remember(order);
        }
        assert_eq!(typed("dt^", &orders).text(), "goto 2");
        assert_eq!(typed("dt^^", &orders).text(), "goto 1");
        assert_eq!(typed("dt^^^v", &orders).text(), "goto 2");
        assert_eq!(typed("dt^^vv", &orders).text(), "dt");
    }

    #[test]
    fn tab_types_what_is_certain() {
        let none = Orders::default();
        assert_eq!(typed("me\t", &none).text(), "method ");
        assert_eq!(typed("s\t", &none).text(), "s", "speed, scene, select");
        assert_eq!(typed("se\tn\t", &none).text(), "select none ");
        assert_eq!(typed("unt\tre\t", &none).text(), "until re", "rest, release");
        assert_eq!(typed("unt\tcol\tsel\t", &none).text(), "until collision selected ");
        assert_eq!(typed("unt\tsp\t3", &none).text(), "until speed>3");
        assert_eq!(typed("method m\t", &none).text(), "method moreau ");
        assert_eq!(typed("x\t", &none).text(), "x");
    }

    #[test]
    fn the_line_is_bounded() {
        let line = typed(&"é".repeat(300), &Orders::default());
        assert!(line.text().len() <= LONGEST + 1);
    }
}
