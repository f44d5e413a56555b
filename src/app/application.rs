//! The application as its owner sees it: inputs in, a buffer out.

use ratatui::{
    buffer::Buffer,
    layout::{Position, Rect},
};

use super::{
    comparison::Comparison,
    hints::hints,
    input::{Effect, Input, Setup},
    keys::pairs,
    said,
    state::{Open, Sought, State},
};
use crate::{
    frame,
    snapshot::{Ghost, Snapshot},
    view::{self, EventsView, Mode, Pace, Popup, Screen, ViewSettings},
    worker::{Activity, Notify, Report, Said},
};

/// Size of a picture that is taken away where there is no screen.
const PICTURE: Rect = Rect { x: 0, y: 0, width: 120, height: 40 };

/// The application.
pub struct App {
    state: State,
}

impl App {
    /// Loads the scene and starts its worker, which calls `notify` when there is [`Input::News`].
    ///
    /// # Errors
    /// If the system has no thread for the worker.
    pub fn new(setup: Setup, notify: Notify) -> std::io::Result<App> {
        Ok(App { state: State::begin(setup, notify)? })
    }

    /// Obeys one input.
    pub fn handle(&mut self, input: Input) -> Effect {
        let effect = match input {
            Input::Key(key) => self.state.key(key),
            Input::Mouse(mouse) => self.state.mouse(mouse, |state, show| with_screen(state, show)),
            Input::Paste(text) => self.state.paste(&text),
            Input::News => self.news(),
        };
        self.state.look_around();
        self.state.show_trial();
        effect
    }

    /// Draws the application as it stands over the whole buffer.
    pub fn draw(&mut self, buffer: &mut Buffer) {
        self.state.area = buffer.area;
        self.with_screen(|screen| view::draw(screen, buffer.area, buffer));
    }

    /// What there is to say, until the next key.
    pub fn said(&self) -> Option<String> {
        self.state.message()
    }

    /// Whether the run goes on and on, to no target.
    pub fn runs_freely(&self) -> bool {
        self.state.running && !self.state.has_target
    }

    /// Changes how things are shown, now that more is known of the terminal.
    pub fn adapt(&mut self, change: impl FnOnce(&mut ViewSettings)) {
        change(&mut self.state.view_settings);
    }

    /// Whether the terminal shall report the mouse.
    pub fn wants_mouse(&self) -> bool {
        self.state.pointer.on
    }

    /// Where the terminal's cursor belongs in the picture last drawn; `None`: nowhere.
    pub fn cursor(&self) -> Option<Position> {
        self.with_screen(|screen| view::cursor(screen, self.state.area))
    }

    /// Says what happened unasked, in place of the key hints and behind the answer to the last key, until the next key.
    pub fn tell(&mut self, news: impl Into<String>) {
        self.state.tell(news);
    }

    /// Ends the application: a recording under way is written, and what there is to say of that is returned, as of one that
    /// quitting has written.
    pub fn finish(&mut self) -> Option<String> {
        if self.awaits_report() || self.state.report.recorded.is_some() {
            self.state.write_tape();
        }
        self.state.farewell.take()
    }

    /// The latest report of the run.
    pub fn report(&self) -> &Report {
        &self.state.report
    }

    /// Whether the run has been told something that its latest report does not show yet.
    pub fn awaits_report(&self) -> bool {
        self.state.report.obeyed < self.state.worker.sent()
    }

    /// Whether the run, and the exact run beside it, have obeyed every key so far and wait for the next.
    pub fn settled(&self) -> bool {
        let compared = |comparison: &Comparison| comparison.is_settled(self.state.report.snapshot.t);
        let obeyed =
            self.state.report.obeyed == self.state.worker.sent() && self.state.report.activity != Activity::Running;
        obeyed
            && self.state.loading.is_none()
            && self.state.taken.is_none()
            && self.state.comparison.as_ref().is_none_or(compared)
    }

    /// The exact run beside the one shown, where it was asked for and has said anything yet.
    pub fn ghost(&self) -> Option<&Ghost> {
        self.state.comparison.as_ref().and_then(Comparison::ghost)
    }

    /// What the user chose to look at.
    pub fn view_settings(&self) -> &ViewSettings {
        &self.state.view_settings
    }

    /// Takes the scene on its way if it has come, and the worker's latest report.
    fn news(&mut self) -> Effect {
        let (scene, report) = (self.state.look_for_scene(), self.report_news());
        let written = self.state.taken_away().map(|taken| {
            let picture = self.picture(&taken.snapshot);
            self.state.write_away(&taken, &picture);
            Effect::DrawNow
        });
        match (scene.or(written), report) {
            (Some(Effect::DrawNow), Effect::Draw) => Effect::DrawNow,
            (_, effect) => effect,
        }
    }

    /// The picture of a snapshot as an image, without what lies over the views.
    fn picture(&self, snapshot: &Snapshot) -> String {
        let area = if self.state.area.is_empty() { PICTURE } else { self.state.area };
        let mut buffer = Buffer::empty(area);
        self.with_screen(|screen| {
            let screen = Screen { snapshot, popup: Popup::None, message: None, ..*screen };
            view::draw(&screen, area, &mut buffer);
        });
        frame::svg(&buffer)
    }

    fn report_news(&mut self) -> Effect {
        let before = std::mem::replace(&mut self.state.report, self.state.worker.take());
        if let Some(said) = &self.state.report.panic {
            return Effect::Fail(said.clone());
        }
        if before.snapshot.t != self.state.report.snapshot.t
            && let Some(card) = &mut self.state.view_settings.card
        {
            (card.probe, card.scroll) = (None, 0); // another frame, another search
        }
        if let Some(comparison) = &mut self.state.comparison {
            comparison.follow(&before, &self.state.report);
        }
        let first_look = self.state.sought == Some(Sought::FirstLook);
        if self.state.report.obeyed == self.state.worker.sent() {
            self.state.running = self.state.report.activity == Activity::Running;
            self.state.has_target &= self.state.running;
            self.state.settings = self.state.report.settings;
            self.state.look_at_sought();
        }
        if let Some((count, said)) = &self.state.report.said
            && before.said.is_none_or(|(before, _)| before < *count)
            && !(first_look && matches!(said, Said::Met { .. }))
        {
            let sentence = said::sentence(said, self.state.report.snapshot.stage.duration);
            self.state.tell(sentence);
        }
        if self.state.report.activity == Activity::Stalled && before.activity != Activity::Stalled {
            self.state.tell(self.state.stalled());
        }
        if self.state.report.obeyed == before.obeyed && self.state.report.activity == before.activity {
            Effect::Draw
        } else {
            Effect::DrawNow
        }
    }

    /// The screen as it stands, lent to `show`.
    fn with_screen<T>(&self, show: impl FnOnce(&Screen) -> T) -> T {
        with_screen(&self.state, show)
    }
}

/// The screen of a state, lent to `show`.
fn with_screen<T>(state: &State, show: impl FnOnce(&Screen) -> T) -> T {
    let message = state.message();
    let snapshot = &state.report.snapshot;
    let hints = hints(&state.keymap, state.place());
    let (help, hints) = (pairs(&state.help), pairs(&hints));
    let entries: Vec<(&str, &str)> = match &state.open {
        Open::Scenes(list) => list.shown().map(|entry| (entry.name.as_str(), entry.about.as_str())).collect(),
        _ => Vec::new(),
    };
    let offers = match &state.open {
        Open::Prompt(line) => line.offers(&state.context(&state.scene_names())).join("  "),
        _ => String::new(),
    };
    show(&Screen {
        snapshot: state.trial.as_ref().map_or(snapshot, |trial| &trial.shown),
        pace: pace(&state.report),
        ticks: &state.report.ticks,
        kept: state.report.kept,
        recorded: state.report.recorded,
        trail: &state.report.trail,
        ahead: state.report.ahead.as_deref(),
        log: Some(&state.report.log),
        comparison: state.comparison.as_ref().map(Comparison::shown),
        view_settings: &state.view_settings,
        popup: match &state.open {
            Open::Nothing => Popup::None,
            Open::Prompt(line) => Popup::Prompt { text: line.text(), cursor: line.cursor(), offers: &offers },
            Open::Events(list) => Popup::Events(EventsView {
                log: &state.report.log,
                filter: list.filter(),
                typed: list.typed(),
                wrong: list.wrong(),
                cursor: list.cursor(),
            }),
            Open::Help { scroll } => Popup::Help { rows: &help, scroll: *scroll },
            Open::Scenes(list) => Popup::Scenes {
                filter: list.filter(),
                filtering: list.filtering(),
                entries: &entries,
                cursor: list.cursor(),
            },
        },
        message: message.as_deref(),
        hints: &hints,
    })
}

fn pace(report: &Report) -> Pace {
    let mode = match report.activity {
        _ if report.kept.is_past => Mode::Back,
        Activity::Running => Mode::Run,
        Activity::Paused => Mode::Pause,
        Activity::Stalled => Mode::Stalled,
    };
    Pace { mode, wanted: report.wanted, reached: report.reached }
}
