//! The application without a screen, for a screen reader or a dumb terminal: lines are keys, and what they lead to is
//! told in lines.

use std::collections::VecDeque;
use std::io::{self, Write};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::time::Duration;

use super::failure::{Failure, note};
use super::lines;
use super::output::Output;
use super::signals::Signals;
use crate::app::{Action, App, Code, Effect, Input, Key, Keymap, Setup};
use crate::explain;
use crate::format;
use crate::printable;
use crate::snapshot::{Class, EventFilter};

/// How often it is asked whether a signal has come.
const LOOK: Duration = Duration::from_millis(100);

/// Most cards that are told unasked.
const CARDS: usize = 5;

/// Most events of the log that are told.
const LOGGED: usize = 100;

/// What happens.
pub(super) enum Event {
    /// A line, or the end of them.
    Line(Option<String>),
    /// The application's worker has news.
    News,
}

/// The lines of standard input, and the way on which news comes, too.
pub(super) struct Ears {
    pub(super) sender: Sender<Event>,
    pub(super) events: Receiver<Event>,
}

impl Ears {
    /// Begins to listen.
    ///
    /// # Errors
    /// If the system has no thread to give.
    pub(super) fn open() -> io::Result<Ears> {
        let (sender, events) = mpsc::channel();
        lines::start(sender.clone(), Event::Line)?;
        Ok(Ears { sender, events })
    }
}

/// How a conversation begins.
pub(super) enum Begin {
    /// At the start, with a line if one has come.
    Here(Option<String>),
    /// At this time, s, with a line if one has come.
    At(f64, Option<String>),
    /// With a recording, which ends by this time, s, told event by event up to its end, or to a line.
    Tell(f64),
}

/// A conversation under way.
struct Talk {
    app: App,
    keymap: Keymap,
    out: Output,
    /// Lines that wait until what was asked for before is done; none: their end.
    waiting: VecDeque<Option<String>>,
    /// The time of the state that was told last, s.
    told: Option<f64>,
    /// Whether something was asked for that is to be told when it is done.
    asked: bool,
    /// What was said last in answer to the last key.
    said: Option<String>,
    /// Events told so far, while they are told as they come.
    following: Option<u64>,
}

/// Talks until the user has had enough or there are no more lines. A recording under way is written, whatever ends it.
///
/// # Errors
/// If the output cannot be written, the simulation fails, or a signal comes.
pub(super) fn talk(setup: Setup, begin: Begin, ears: &Ears, signals: &Signals) -> Result<(), Failure> {
    let (keymap, news) = (setup.keymap.clone(), ears.sender.clone());
    let app = App::new(setup, Arc::new(move || drop(news.send(Event::News))))?;
    let (out, waiting) = (Output::stdout(), VecDeque::new());
    let mut talk = Talk { app, keymap, out, waiting, told: None, asked: true, said: None, following: None };
    talk.welcome()?;
    let (time, first) = match begin {
        Begin::Here(first) => (None, first),
        Begin::At(time, first) => (Some(time).filter(|time| *time > 0.0), first),
        Begin::Tell(end) => {
            talk.following = Some(0);
            (Some(end), None)
        }
    };
    talk.waiting.extend(first.into_iter().map(Some));
    if let Some(time) = time {
        talk.type_in(&format!(":goto {time:?}"))?;
    }
    let ended = talk.listen(ears, signals);
    let farewell = talk.app.finish();
    farewell.iter().filter(|said| talk.said.as_ref() != Some(said)).for_each(|said| note(said));
    ended.and_then(|()| talk.out.finish())
}

impl Talk {
    /// Obeys lines and tells news until the talk is over.
    fn listen(&mut self, ears: &Ears, signals: &Signals) -> Result<(), Failure> {
        loop {
            if self.go_on()? {
                return Ok(());
            }
            match ears.events.recv_timeout(LOOK) {
                Ok(Event::Line(line)) => self.waiting.push_back(line),
                Ok(Event::News) => self.news()?,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => self.waiting.push_back(None),
            }
            signals.check()?;
        }
    }

    /// Takes the application's news, and tells what has happened where events are told as they come.
    fn news(&mut self) -> Result<(), Failure> {
        self.heed(Input::News)?;
        let Some(told) = self.following else { return Ok(()) };
        let log = Arc::clone(&self.app.report().log);
        for (_, event) in log.iter().filter(|(number, _)| *number > told) {
            writeln!(self.out, "{}", explain::event(event))?;
        }
        self.following = Some(log.total());
        Ok(())
    }

    fn welcome(&mut self) -> Result<(), Failure> {
        let name = |action| self.keymap.keys(action).first().map_or_else(|| "no key".into(), Key::to_string);
        let (help, quit) = (name(Action::Help), name(Action::Quit));
        let stage = &self.app.report().snapshot.stage;
        writeln!(self.out, "{}", stage.name)?;
        if !stage.about.is_empty() {
            writeln!(self.out, "{}", stage.about)?;
        }
        let (spheres, walls) = (stage.radii.len(), stage.walls.len());
        writeln!(self.out, "{}, {}.", format::counted(spheres, "sphere"), format::counted(walls, "wall"))?;
        writeln!(
            self.out,
            "Each line is keys, or an order after a colon. An empty line steps, or pauses a run; card tells the contacts, \
             log all that has happened; \
             {help} lists the keys; {quit} quits."
        )?;
        Ok(())
    }

    /// Tells what is done, and obeys the lines whose turn has come; whether the talk is over.
    fn go_on(&mut self) -> Result<bool, Failure> {
        loop {
            if self.app.settled() {
                self.tell()?;
            }
            let free = self.app.settled() || self.app.runs_freely();
            let stops = matches!(self.waiting.front(), Some(Some(line)) if line.eq_ignore_ascii_case("esc"));
            if matches!(self.waiting.front(), Some(Some(_))) && self.following.take().is_some() {
                self.heed(Input::Key(Key::plain(Code::Escape)))?; // what is told as it comes ends with a line
                continue;
            }
            if !free && !stops {
                return Ok(false);
            }
            match self.waiting.pop_front() {
                None => return Ok(false),
                Some(None) => return Ok(true),
                Some(Some(line)) => {
                    if self.obey(&line)? {
                        return Ok(true);
                    }
                    self.say()?;
                }
            }
        }
    }

    /// Obeys a line; whether it ends the talk.
    fn obey(&mut self, line: &str) -> Result<bool, Failure> {
        self.asked = true;
        let word = line.trim();
        match word.split_once(' ').unwrap_or((word, "")) {
            ("card" | "cards", number) => self.card(number)?,
            ("log", filter) => self.log(filter)?,
            _ if line.is_empty() && self.app.runs_freely() => return self.action(Action::TogglePause),
            _ if line.is_empty() => return self.action(Action::Step),
            _ if word.starts_with(':') => self.type_in(word)?,
            _ => {
                let whole = word.parse::<Key>().ok().map(|key| vec![key]);
                for key in whole.unwrap_or_else(|| line.chars().map(Key::char).collect()) {
                    if self.press(key)? {
                        return Ok(true);
                    }
                }
            }
        }
        Ok(false)
    }

    /// Presses the first key of an action.
    fn action(&mut self, action: Action) -> Result<bool, Failure> {
        match self.keymap.keys(action).first() {
            Some(key) => self.press(*key),
            None => Ok(false),
        }
    }

    /// Presses a key, or tells what it would show on a screen; whether it ends the talk.
    fn press(&mut self, key: Key) -> Result<bool, Failure> {
        match self.keymap.action(key) {
            Some(Action::Help) => self.help()?,
            Some(Action::Quit) => {
                self.heed(Input::Key(key))?; // a recording under way is written
                self.say()?;
                return Ok(true);
            }
            Some(Action::Prompt | Action::Until) => {
                writeln!(self.out, "An order is a line of its own, such as :goto 3.25, or :until rest.")?;
            }
            Some(Action::Inspector | Action::Card) => self.card("")?,
            Some(Action::Events) => self.log("")?,
            Some(
                Action::Scenes
                | Action::Mouse
                | Action::Repaint
                | Action::Suspend
                | Action::NextViews
                | Action::NextOverlays
                | Action::Pan(_)
                | Action::ZoomIn
                | Action::ZoomOut
                | Action::WholeScene
                | Action::Follow
                | Action::PreviousTrial
                | Action::NextTrial,
            ) => writeln!(self.out, "{key} has a use on a screen only.")?,
            None => writeln!(self.out, "{key} is bound to nothing.")?,
            Some(_) => self.heed(Input::Key(key))?,
        }
        self.out.flush()?;
        Ok(false)
    }

    /// Types an order with its colon.
    fn type_in(&mut self, order: &str) -> Result<(), Failure> {
        let Some(prompt) = self.keymap.keys(Action::Prompt).first().copied() else {
            writeln!(self.out, "Orders have no key in the configuration.")?;
            return Ok(());
        };
        let typed = order.chars().skip(1).map(Key::char);
        for key in [prompt].into_iter().chain(typed).chain([Key::plain(Code::Enter)]) {
            self.heed(Input::Key(key))?;
        }
        Ok(())
    }

    fn heed(&mut self, input: Input) -> Result<(), Failure> {
        if matches!(input, Input::Key(_)) {
            self.said = None;
        }
        match self.app.handle(input) {
            Effect::Fail(said) => Err(Failure::Failed(format!("carom has made a mistake and cannot go on: {said}"))),
            _ => Ok(()),
        }
    }

    /// Tells where the run is, what has happened in its last frame, and what there is to say.
    fn tell(&mut self) -> Result<(), Failure> {
        if !std::mem::take(&mut self.asked) {
            return Ok(());
        }
        let snapshot = Arc::clone(&self.app.report().snapshot);
        if self.told.replace(snapshot.t) != Some(snapshot.t) {
            writeln!(self.out, "At {} seconds.", format::spoken(snapshot.t))?;
            let impacts = snapshot.contacts.iter().filter(|contact| contact.class == Class::Collide);
            for contact in impacts.clone().take(CARDS) {
                writeln!(self.out, "{}", explain::sentence(contact))?;
            }
            let more = impacts.count().saturating_sub(CARDS);
            if more > 0 {
                writeln!(self.out, "And {more} more.")?;
            }
        }
        self.say()
    }

    /// What the application has to say, unless it was told.
    fn say(&mut self) -> Result<(), Failure> {
        let said = self.app.said();
        if let Some(said) = said.as_ref().filter(|_| self.said != said) {
            writeln!(self.out, "{}", printable::escaped(said))?;
        }
        self.said = said;
        Ok(self.out.flush()?)
    }

    /// The contacts of the last frame, or that of a number, from 0.
    fn card(&mut self, number: &str) -> Result<(), Failure> {
        let contacts = &self.app.report().snapshot.contacts;
        match (number.trim().parse::<usize>(), contacts.len()) {
            (_, 0) => writeln!(self.out, "There are no contacts in this frame.")?,
            (Ok(index), count) if index < count => {
                writeln!(self.out, "{}", explain::sentence(&contacts[index]))?;
                let card = explain::card(&self.app.report().snapshot, index, " and ");
                for line in card.iter().flat_map(|card| &card.lines) {
                    writeln!(self.out, "{}: {}.", line.label, line.text)?;
                }
            }
            (Err(_), _) if number.trim().is_empty() => {
                for (index, contact) in contacts.iter().enumerate().take(100) {
                    writeln!(self.out, "{index}. {}", explain::sentence(contact))?;
                }
            }
            (_, count) => writeln!(self.out, "{number} is not allowed: there are contacts 0 to {}.", count - 1)?,
        }
        for line in explain::acting(&self.app.report().snapshot, " and ").iter().take(100) {
            writeln!(self.out, "{}: {}.", line.label, line.text)?;
        }
        Ok(self.out.flush()?)
    }

    /// What has happened so far, as far as the filter lets it through, the newest last.
    fn log(&mut self, filter: &str) -> Result<(), Failure> {
        let log = Arc::clone(&self.app.report().log);
        match EventFilter::read(filter) {
            Ok(filter) => {
                let wanted = || log.iter().filter(|(_, event)| filter.passes(event));
                let count = wanted().count();
                if log.dropped() > 0 {
                    writeln!(self.out, "The first {} events are not kept.", log.dropped())?;
                }
                if count > LOGGED {
                    writeln!(self.out, "{} before these.", format::counted((count - LOGGED) as u64, "event"))?;
                }
                for (number, event) in wanted().skip(count.saturating_sub(LOGGED)) {
                    writeln!(self.out, "{number}. {}", explain::event(event))?;
                }
                if count == 0 {
                    writeln!(self.out, "Nothing of this has happened.")?;
                }
            }
            Err(unknown) => writeln!(self.out, "{}", printable::escaped(&unknown.to_string()))?,
        }
        Ok(self.out.flush()?)
    }

    fn help(&mut self) -> Result<(), Failure> {
        for (keys, does) in self.keymap.help_rows() {
            writeln!(self.out, "{keys}: {does}.")?;
        }
        Ok(self.out.flush()?)
    }
}
