//! The list of all that has happened: where its cursor is, and what was typed to narrow it.

use super::keys::{Code, Key};
use crate::snapshot::{EventFilter, EventLog};

/// Longest filter, bytes; no filter that says anything is as long.
const FILTER: usize = 100;

/// Events by which PageUp and PageDown move.
const PAGE: usize = 10;

/// The list while it is open.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct EventList {
    typed: String,
    filter: EventFilter,
    /// What is wrong with what was typed.
    wrong: Option<String>,
    /// The number of the event under the cursor; none: the newest, whichever that is.
    cursor: Option<u64>,
}

/// What a key in the list leads to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    /// The list stays open.
    Stay,
    /// The list closes.
    Close,
    /// The list closes, and the run goes to the event of this number.
    Go(u64),
    /// The key is none of the list's.
    NotMine,
}

impl EventList {
    /// A list whose cursor is on the last event until `time`, s, if there are later ones.
    pub(super) fn at(log: &EventLog, time: f64) -> EventList {
        let later = log.iter().next_back().is_some_and(|(_, last)| last.time > time);
        let last = log.iter().rev().find(|(_, event)| event.time <= time).or(log.iter().next());
        EventList { cursor: last.filter(|_| later).map(|(number, _)| number), ..EventList::default() }
    }

    /// What was typed.
    pub(super) fn typed(&self) -> &str {
        &self.typed
    }

    /// What it means.
    pub(super) fn filter(&self) -> &EventFilter {
        &self.filter
    }

    /// What is wrong with what was typed.
    pub(super) fn wrong(&self) -> Option<&str> {
        self.wrong.as_deref()
    }

    /// The number of the event under the cursor; none: the newest.
    pub(super) fn cursor(&self) -> Option<u64> {
        self.cursor
    }

    /// Obeys a key, in a list of what the filter lets through.
    pub(super) fn handle(&mut self, key: Key, log: &EventLog) -> Outcome {
        match key.code {
            Code::Up => self.back(log, 1),
            Code::PageUp => self.back(log, PAGE),
            Code::Home => self.back(log, usize::MAX),
            Code::Down => self.on(log, 1),
            Code::PageDown => self.on(log, PAGE),
            Code::End => self.cursor = None,
            Code::Enter => return self.chosen(log).map_or(Outcome::Stay, Outcome::Go),
            Code::Escape if self.typed.is_empty() => return Outcome::Close,
            Code::Escape => self.retype(String::new()),
            Code::Backspace if self.typed.is_empty() => return Outcome::Close,
            Code::Backspace => {
                let mut typed = std::mem::take(&mut self.typed);
                typed.pop();
                self.retype(typed);
            }
            _ => match key.typed() {
                Some(c) if self.typed.len() < FILTER => self.retype(format!("{}{c}", self.typed)),
                Some(_) => {}
                None => return Outcome::NotMine,
            },
        }
        Outcome::Stay
    }

    /// The number of the event that Enter goes to: the last one let through up to the cursor, or the first after it.
    fn chosen(&self, log: &EventLog) -> Option<u64> {
        let at = self.cursor.unwrap_or(u64::MAX);
        let mut shown = log.iter().filter(|(_, event)| self.filter.passes(event)).map(|(number, _)| number);
        let last = shown.clone().rev().find(|number| *number <= at);
        last.or_else(|| shown.next())
    }

    /// Goes so many events back among those let through.
    fn back(&mut self, log: &EventLog, events: usize) {
        let Some(at) = self.chosen(log) else { return };
        let before = log.iter().rev().filter(|(number, event)| *number < at && self.filter.passes(event));
        self.cursor = before.take(events).last().map(|(number, _)| number).or(Some(at));
    }

    /// Goes so many events on among those let through; at the last one it stays with the newest.
    fn on(&mut self, log: &EventLog, events: usize) {
        let Some(at) = self.chosen(log) else { return };
        let after = log.iter().filter(|(number, event)| *number > at && self.filter.passes(event));
        let mut after = after.map(|(number, _)| number);
        self.cursor = after.by_ref().take(events).last().filter(|_| after.next().is_some());
    }

    fn retype(&mut self, typed: String) {
        match EventFilter::read(&typed) {
            Ok(filter) => (self.filter, self.wrong) = (filter, None),
            Err(unknown) => self.wrong = Some(unknown.to_string()),
        }
        self.typed = typed;
    }
}
