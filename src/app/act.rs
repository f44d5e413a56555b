//! What each input does to the application.

use super::{
    action::{Action, Direction},
    comparison, event_list,
    input::Effect,
    keys::{Code, Key, pairs},
    knobs,
    line::{LONGEST, Line, Typed},
    prompt::{self, Order},
    scene_list::{self, Outcome, SceneList},
    state::{Open, Sought, State},
    view_settings,
};
use crate::{
    printable,
    scene::Settings,
    snapshot::Class,
    view::{self, CardView},
    worker::{Activity, Bodies, Command, Stop},
};

/// Rows by which PageUp and PageDown move a card.
const CARD_PAGE: usize = 5;

impl State {
    pub(super) fn key(&mut self, key: Key) -> Effect {
        (self.answer, self.news, self.farewell) = (None, None, None);
        self.cost_told = self.cost_told.saturating_sub(1);
        // These work whatever is open and is being typed into, but that Ctrl-C closes the `:` line first.
        let typing = matches!(self.open, Open::Prompt(_));
        match self.keymap.action(key).filter(|_| key.ctrl) {
            Some(Action::Quit) if typing => {}
            Some(action @ (Action::Quit | Action::Repaint | Action::Suspend)) => return self.act(action),
            _ => {}
        }
        if typing {
            self.key_on_the_line(key);
            return Effect::DrawNow;
        }
        match &mut self.open {
            Open::Prompt(_) => {}
            Open::Scenes(list) => match list.handle(key) {
                Outcome::Stay => {}
                Outcome::Close => self.open = Open::Nothing,
                Outcome::Open(name) => {
                    self.open = Open::Nothing;
                    self.open_scene(&name);
                }
                Outcome::NotMine => return self.act_on(key),
            },
            Open::Help { scroll } => {
                let limit = view::help_scroll_limit(&pairs(&self.help), &self.view_settings, self.area);
                match scrolled(key, *scroll, limit, self.area.height.into()) {
                    Some(next) => *scroll = next,
                    None => return self.act_on(key),
                }
            }
            Open::Events(list) => match list.handle(key, &self.report.log) {
                event_list::Outcome::Stay => {}
                event_list::Outcome::Close => self.open = Open::Nothing,
                event_list::Outcome::Go(number) => self.go_to_event(number),
                event_list::Outcome::NotMine => return self.act_on(key),
            },
            Open::Nothing => {
                if !self.turns_card(key) {
                    return self.act_on(key);
                }
            }
        }
        Effect::DrawNow
    }

    fn key_on_the_line(&mut self, key: Key) {
        let scenes = self.scene_names();
        let context = self.context(&scenes);
        let Open::Prompt(line) = &mut self.open else { return };
        match line.key(key, &self.orders, &context) {
            Typed::Text => {}
            Typed::Nothing => self.open = Open::Nothing,
            Typed::Order(text) => {
                self.open = Open::Nothing;
                self.orders.remember(&text);
                self.order(&text);
            }
        }
    }

    /// Takes pasted text where text is typed.
    pub(super) fn paste(&mut self, text: &str) -> Effect {
        let typing = match &self.open {
            Open::Prompt(_) | Open::Events(_) => true,
            Open::Scenes(list) => list.filtering(),
            Open::Help { .. } | Open::Nothing => false,
        };
        if !typing {
            return Effect::Nothing;
        }
        for c in text.chars().filter(|c| printable::is_printable(*c)).take(LONGEST) {
            let _ = self.key(Key::char(c));
        }
        Effect::DrawNow
    }

    fn act_on(&mut self, key: Key) -> Effect {
        match self.keymap.action(key) {
            Some(action) => self.act(action),
            None => Effect::DrawNow, // the message has vanished
        }
    }

    /// Does what a key is for. Every action is named, so that a new one that nothing does cannot be built.
    fn act(&mut self, action: Action) -> Effect {
        match action {
            Action::Quit => return self.quit(),
            Action::Suspend => return Effect::Suspend,
            Action::Repaint => return Effect::Repaint,
            Action::TogglePause => self.toggle_pause(),
            Action::Step => self.advance(Command::Forward(1)),
            Action::TenOn => self.advance(Command::Forward(10)),
            Action::StepBack => self.head_for(Command::Back(1), true),
            Action::TenBack => self.head_for(Command::Back(10), true),
            Action::NextImpact | Action::PreviousImpact => self.go_to_impact(action == Action::NextImpact),
            Action::Oldest | Action::Newest => self.go_to_the_end(action == Action::Newest),
            Action::Until => self.open = Open::Prompt(Line::new("until ")),
            Action::UntilAgain => self.until_again(),
            Action::Restart => self.restart(),
            Action::Reload => self.reload(),
            Action::PreviousScene | Action::NextScene => self.neighbor_scene(action == Action::NextScene),
            Action::LowerTolerance => self.solve_with(knobs::tolerance(self.settings, 0.1)),
            Action::RaiseTolerance => self.solve_with(knobs::tolerance(self.settings, 10.0)),
            Action::HalveDt => self.solve_with(knobs::dt(self.settings, 0.5)),
            Action::DoubleDt => self.solve_with(knobs::dt(self.settings, 2.0)),
            Action::NextMethod => self.solve_with(Ok(knobs::next_method(self.settings))),
            Action::Faster => self.go_at(knobs::speed(self.speed, 2.0)),
            Action::Slower => self.go_at(knobs::speed(self.speed, 0.5)),
            Action::RealTime => self.go_at(Ok(1.0)),
            Action::Ghost => self.toggle_ghost(),
            Action::TakeAway => self.take_away(),
            Action::Record => self.toggle_recording(),
            Action::Prompt => self.open = Open::Prompt(Line::default()),
            Action::Help => self.toggle_help(),
            Action::Scenes => self.toggle_scenes(),
            Action::Close => self.close(),
            Action::NextViews => view_settings::next_views(&mut self.view_settings),
            Action::Pan(direction) => self.pan(direction),
            Action::ZoomIn => self.zoom(view_settings::ZOOM, "This is the closest view."),
            Action::ZoomOut => self.zoom(1.0 / view_settings::ZOOM, "This is the widest view."),
            Action::WholeScene => view_settings::whole_scene(&mut self.view_settings),
            Action::Follow => self.follow(),
            Action::SelectNext | Action::SelectPrevious => self.select(action == Action::SelectNext),
            Action::Inspector => self.next_inspector(),
            Action::Card => self.toggle_card(),
            Action::Events => self.toggle_events(),
            Action::PreviousTrial | Action::NextTrial => self.turn_trial(action == Action::NextTrial),
            Action::NextOverlays => self.next_overlays(),
            Action::Mouse => self.toggle_mouse(),
        }
        Effect::DrawNow
    }

    /// Gives up the scene on its way; else stops a run that goes to a target, and closes what is open.
    fn close(&mut self) {
        if self.stop_loading() {
            return;
        }
        if self.has_target {
            self.run(false);
        }
        if matches!(self.open, Open::Nothing) {
            self.view_settings.card = None;
        }
        self.open = Open::Nothing;
    }

    /// Magnifies by `factor`, or says `at_the_end` where it is already at the end.
    pub(super) fn zoom(&mut self, factor: f64, at_the_end: &str) {
        if !view_settings::zoom(&mut self.view_settings, factor) {
            self.say(at_the_end);
        }
    }

    fn next_overlays(&mut self) {
        let said = view_settings::next_overlays(&mut self.view_settings);
        self.say(said);
    }

    fn toggle_pause(&mut self) {
        if !self.say_if_stalled() {
            self.run(!self.running);
        }
    }

    /// Steps or runs on from a pause.
    fn advance(&mut self, command: Command) {
        if !self.say_if_stalled() {
            let on = !matches!(command, Command::Forward(1));
            self.head_for(command, on);
        }
    }

    fn restart(&mut self) {
        let stalled = self.report.activity == Activity::Stalled;
        self.end_recording();
        self.worker.send(Command::Restart);
        if stalled {
            self.run(false);
        }
    }

    /// Shows the exact run, once what it costs has been said, or no longer.
    fn toggle_ghost(&mut self) {
        let cost = comparison::cost(self.current.scene.spheres.len())
            .filter(|_| self.cost_told == 0 && self.comparison.is_none());
        if let Some(cost) = cost {
            self.cost_told = 2;
            return self.say(format!("{cost}; {} again starts it.", self.key_of(Action::Ghost)));
        }
        match self.comparison.take() {
            Some(comparison) => {
                self.ending = Some(comparison.end());
                self.say("The exact run is no longer shown.");
            }
            None => {
                self.say("Dotted: where the exact run is now.");
                self.compare();
            }
        }
        self.view_settings.ghost = self.comparison.is_some();
    }

    /// Ends, once a recording under way is written.
    fn quit(&mut self) -> Effect {
        self.end_recording();
        Effect::Quit
    }

    fn neighbor_scene(&mut self, next: bool) {
        let offset = if next { 1 } else { -1 };
        let names = self.scene_names();
        let at = names.iter().position(|name| *name == self.wanted_name());
        let next = at.map_or(0, |at| (at as isize + offset).rem_euclid(names.len() as isize) as usize);
        self.open_scene(&names[next]);
    }

    /// The scenes there are: the file the program was started with, then the built-in ones.
    fn entries(&self) -> Vec<scene_list::Entry> {
        self.given.iter().map(|(entry, _)| entry.clone()).chain(scene_list::built_in()).collect()
    }

    fn toggle_scenes(&mut self) {
        self.open = match self.open {
            Open::Scenes(_) => Open::Nothing,
            _ => Open::Scenes(SceneList::new(self.entries(), &self.current.name)),
        };
    }

    fn toggle_help(&mut self) {
        self.open = match self.open {
            Open::Help { .. } => Open::Nothing,
            _ => Open::Help { scroll: 0 },
        };
    }

    fn pan(&mut self, direction: Direction) {
        self.let_go();
        let span = view::visible_span(&self.view_settings, &self.report.snapshot.stage, self.area);
        view_settings::pan(&mut self.view_settings, direction, span);
    }

    pub(super) fn let_go(&mut self) {
        let x = self.view_settings.selected.and_then(|i| self.report.snapshot.x.get(i));
        view_settings::let_go(&mut self.view_settings, &self.report.snapshot.stage.view, x.copied());
    }

    fn follow(&mut self) {
        if self.view_settings.follow {
            self.let_go();
            return self.say("The view stays where it is.");
        }
        if self.view_settings.selected.is_none() {
            self.select(true);
        }
        if let Some(i) = self.view_settings.selected {
            self.view_settings.follow = true;
            self.view_settings.pan = glam::DVec3::ZERO;
            self.say(format!("The view follows sphere {i}."));
        }
    }

    fn select(&mut self, forward: bool) {
        let x = self.view_settings.selected.and_then(|i| self.report.snapshot.x.get(i)).copied();
        let followed = self.view_settings.follow;
        view_settings::select(&mut self.view_settings, self.current.scene.spheres.len(), forward);
        if self.current.scene.spheres.is_empty() {
            self.say("This scene has no spheres.");
        } else if followed && self.view_settings.selected.is_none() {
            self.view_settings.follow = true;
            view_settings::let_go(&mut self.view_settings, &self.report.snapshot.stage.view, x);
        }
    }

    /// Shows the numbers, then a contact's card, then nothing, and round again.
    fn next_inspector(&mut self) {
        let settings = &mut self.view_settings;
        let shown = view::inspector_is_shown(settings, self.area);
        let (inspector, card) = match (shown, settings.card) {
            (false, _) => (true, None),
            (true, None) => (true, Some(CardView::default())),
            (true, Some(_)) => (false, None),
        };
        (settings.inspector, settings.card) = (Some(inspector), card);
    }

    /// Goes to the first collision, with its card open: what a newcomer sees first.
    pub(super) fn first_look(&mut self) {
        self.go_to_impact(true);
        self.sought = Some(Sought::FirstLook);
        self.view_settings.card = Some(CardView::default());
        let [run, next, help] =
            [Action::TogglePause, Action::NextImpact, Action::Help].map(|action| self.key_of(action));
        self.say(format!("A collision taken apart. {run} runs on, {next} goes to the next, {help} lists the keys."));
    }

    fn toggle_card(&mut self) {
        self.view_settings.card = match self.view_settings.card {
            Some(_) => None,
            None => Some(CardView::default()),
        };
    }

    /// Goes through the trial steps of the frame's search, from the first to the last and back to the frame's end.
    fn turn_trial(&mut self, forward: bool) {
        let trials = self.report.snapshot.trials.len();
        if trials == 0 {
            let searched = !self.report.snapshot.probes.is_empty();
            return self.say(if searched {
                "This frame's trial steps are not kept: they have too many spheres, or one came back to it.".into()
            } else {
                format!(
                    "This frame has searched for no collision time: {} goes to a collision.",
                    self.key_of(Action::NextImpact)
                )
            });
        }
        let card = self.view_settings.card.get_or_insert_default();
        card.probe = match (card.probe, forward) {
            (None, true) => Some(0),
            (None, false) => Some(trials - 1),
            (Some(at), true) => Some(at + 1).filter(|at| *at < trials),
            (Some(at), false) => at.checked_sub(1),
        };
    }

    /// Moves the card that is open; whether that is what the key does.
    fn turns_card(&mut self, key: Key) -> bool {
        let Some(card) = &mut self.view_settings.card else { return false };
        let last = self.report.snapshot.contacts.len().saturating_sub(1);
        let cursor = card.cursor.min(last);
        let turned = match key {
            Key { shift: false, ctrl: false, alt: false, code } => match code {
                Code::Down => CardView { cursor: (cursor + 1).min(last), scroll: 0, ..*card },
                Code::Up => CardView { cursor: cursor.saturating_sub(1), scroll: 0, ..*card },
                Code::PageDown => CardView { cursor, scroll: card.scroll + CARD_PAGE, ..*card },
                Code::PageUp => CardView { cursor, scroll: card.scroll.saturating_sub(CARD_PAGE), ..*card },
                _ => return false,
            },
            _ => return false,
        };
        *card = turned;
        true
    }

    /// Goes to the newest frame, or to the first that is kept.
    fn go_to_the_end(&mut self, newest: bool) {
        self.head_for(if newest { Command::Newest } else { Command::Oldest }, true);
    }

    /// Goes to the next impact or the one before, to select what collides.
    fn go_to_impact(&mut self, next: bool) {
        match next {
            true => self.advance(Command::Until(Stop::Event(Class::Collide, Bodies::Any))),
            false => self.head_for(Command::PreviousImpact, true),
        }
        self.sought = Some(Sought::Impact);
    }

    /// The first key of an action, as a text names it.
    fn key_of(&self, action: Action) -> String {
        self.keymap.keys(action).first().map_or_else(|| format!("the key of {}", action.name()), Key::to_string)
    }

    /// Goes on until what was waited for last comes again.
    fn until_again(&mut self) {
        match self.until {
            Some(stop) => self.advance(Command::Until(stop)),
            None => {
                self.say(format!("Nothing was waited for yet; {} asks until what to run.", self.key_of(Action::Until)))
            }
        }
    }

    fn order(&mut self, text: &str) {
        match prompt::read(text, &self.context(&[])) {
            Ok(None) => {}
            Ok(Some(Order::Dt(dt))) => self.solve_with(Ok(Settings { dt, ..self.settings })),
            Ok(Some(Order::Tolerance(tolerance))) => self.solve_with(Ok(Settings { tolerance, ..self.settings })),
            Ok(Some(Order::Speed(speed))) => self.go_at(Ok(speed)),
            Ok(Some(Order::Goto(t))) => self.goto(t),
            Ok(Some(Order::Method(method))) => self.solve_with(Ok(Settings { method, ..self.settings })),
            Ok(Some(Order::Scene(name))) => self.open_scene(&name),
            Ok(Some(Order::Select(index))) => {
                self.let_go();
                self.view_settings.selected = index;
            }
            Ok(Some(Order::Until(stop))) => {
                self.until = Some(stop);
                self.until_again();
            }
            Ok(Some(Order::Show(names, on))) => {
                let said = view_settings::show(&mut self.view_settings, &names, on);
                self.say(said.unwrap_or_else(|wrong| wrong));
            }
            Ok(Some(Order::Hash)) => {
                let snapshot = &self.report.snapshot;
                self.say(format!("t={:?} hash={:016x}", snapshot.t, snapshot.hash()));
            }
            #[cfg(debug_assertions)]
            Ok(Some(Order::Panic { simulation: true })) => self.worker.send(Command::Panic),
            #[cfg(debug_assertions)]
            Ok(Some(Order::Panic { simulation: false })) => panic!("asked to panic"),
            Err(said) => self.say(said),
        }
    }
}

/// Where a key scrolls a text that goes down by `limit` rows at most, on a screen of `screen` rows; none if it scrolls
/// nothing.
fn scrolled(key: Key, scroll: usize, limit: usize, screen: usize) -> Option<usize> {
    // Status, heading, timeline and hints leave the rest of the screen to the text.
    let page = screen.saturating_sub(4).max(1);
    let to = match key.code {
        Code::Up => scroll.saturating_sub(1),
        Code::Down => scroll + 1,
        Code::PageUp => scroll.saturating_sub(page),
        Code::PageDown => scroll + page,
        Code::Home => 0,
        Code::End => limit,
        Code::Char('k') if !key.ctrl && !key.alt => scroll.saturating_sub(1),
        Code::Char('j') if !key.ctrl && !key.alt => scroll + 1,
        _ => return None,
    };
    Some(to.min(limit))
}
