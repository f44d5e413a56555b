//! What the application holds, and the steps that keys and news are made of.

use std::{
    path::PathBuf,
    sync::{Arc, mpsc::Receiver},
};

use ratatui::layout::Rect;

use super::{
    action::Action,
    comparison::Comparison,
    current::Current,
    event_list::EventList,
    hints::Place,
    input::Setup,
    keymap::Keymap,
    knobs,
    line::{Line, Orders},
    loading::Loading,
    mouse::Pointer,
    prompt::Context,
    said,
    scene_list::{self, SceneList},
    view_settings,
};
use crate::{
    printable,
    scene::{self, Settings},
    snapshot::{Class, Logged, Snapshot},
    view::{self, ViewSettings},
    worker::{Activity, Command, Ending, Errands, Notify, Report, Stop, TakenAway, Worker},
};

/// What is open over the views.
#[derive(Debug)]
pub(super) enum Open {
    Nothing,
    Help { scroll: usize },
    Scenes(SceneList),
    Events(EventList),
    Prompt(Line),
}

/// What a run is on its way to, to be looked at there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sought {
    /// An event of the list, whose card is opened.
    Event(Logged),
    /// Any impact, of which what collides is selected.
    Impact,
    /// A time.
    Time,
    /// The impact that a newcomer sees first, which is selected, and of which what is said is already there.
    FirstLook,
}

/// A trial step of a frame's search, to be drawn as often as need be.
pub(super) struct Trial {
    /// The frame, and the number of the trial step.
    of: (Arc<Snapshot>, usize),
    /// The frame with its spheres where they were tried.
    pub(super) shown: Snapshot,
}

/// What the application holds.
pub(super) struct State {
    pub(super) worker: Worker,
    pub(super) report: Arc<Report>,
    pub(super) current: Current,
    /// The file the program was started with, in the list beside the built-in scenes.
    pub(super) given: Option<(scene_list::Entry, PathBuf)>,
    pub(super) settings: Settings,
    pub(super) speed: f64,
    /// Whether the run was told to run; the worker's latest report may not know yet.
    pub(super) running: bool,
    /// Whether the run goes to a collision or a time, where it stops; Esc stops it before.
    pub(super) has_target: bool,
    /// What the run is on its way to, to be looked at there.
    pub(super) sought: Option<Sought>,
    /// What was waited for last.
    pub(super) until: Option<Stop>,
    /// The exact run beside the one shown, if it was asked for.
    pub(super) comparison: Option<Comparison>,
    /// Number of keys, the one under way among them, for which it holds that what the exact run costs was told just before.
    pub(super) cost_told: u8,
    /// The exact run shown before, while its thread ends.
    pub(super) ending: Option<Ending>,
    /// The scene that comes next, if one is being opened, and the channel that it arrives on.
    pub(super) loading: Option<Loading>,
    pub(super) errands: Option<Errands>,
    pub(super) notify: Notify,
    pub(super) view_settings: ViewSettings,
    pub(super) open: Open,
    /// Orders given on the `:` line.
    pub(super) orders: Orders,
    /// What the last key has led to, until the next key.
    pub(super) answer: Option<String>,
    /// What has become of the recording that the last key has ended.
    pub(super) farewell: Option<String>,
    /// What happened unasked and is worth a line, until the next key.
    pub(super) news: Option<String>,
    pub(super) keymap: Keymap,
    pub(super) pointer: Pointer,
    /// Size of the last picture.
    pub(super) area: Rect,
    pub(super) help: Vec<(String, &'static str)>,
    /// Where files are written.
    pub(super) folder: PathBuf,
    /// What was asked for around the frame shown: trails, and what comes next of a sphere.
    pub(super) around: (bool, Option<usize>),
    /// The trial step in the views, if one is.
    pub(super) trial: Option<Trial>,
    /// What is to be written, once the worker has handed it over.
    pub(super) taken: Option<Receiver<TakenAway>>,
}

impl State {
    /// Starts the worker of the first scene, which calls `notify` when it has a report.
    ///
    /// # Errors
    /// If the system has no thread for the worker.
    pub(super) fn begin(setup: Setup, notify: Notify) -> std::io::Result<State> {
        let recording = setup.recording.map(Arc::new);
        let current = Current { recording, ..Current::of(setup.opened) };
        let worker = Worker::start(current.job(setup.settings), 1.0, Arc::clone(&notify))?;
        let report = worker.take();
        let about = current.scene.about.clone();
        let entry = scene_list::Entry { name: current.name.clone(), about };
        let given = current.path.clone().map(|path| (entry, path));
        let view_settings =
            ViewSettings { marker: setup.marker, colors: setup.colors, inks: setup.inks, ..ViewSettings::default() };
        let mut state = State {
            worker,
            report,
            current,
            given,
            settings: setup.settings,
            speed: 1.0,
            running: false,
            has_target: false,
            sought: None,
            until: None,
            comparison: None,
            cost_told: 0,
            ending: None,
            loading: None,
            errands: None,
            notify,
            view_settings,
            open: Open::Nothing,
            orders: Orders::default(),
            answer: None,
            farewell: None,
            news: None,
            area: Rect::default(),
            help: setup.keymap.help_rows(),
            keymap: setup.keymap,
            folder: setup.folder,
            trial: None,
            around: (false, None),
            taken: None,
            pointer: Pointer::default(),
        };
        state.start(setup.paused, setup.taken_apart);
        Ok(state)
    }

    /// Says what there is to say at first, and sets out.
    fn start(&mut self, paused: bool, taken_apart: bool) {
        self.warn();
        if let Some((_, said)) = self.report.said {
            self.tell(said::sentence(&said, self.current.scene.duration));
        }
        if taken_apart {
            self.first_look();
        } else if !paused {
            self.run(true);
        }
    }

    /// The names of all scenes: the file the program was started with, then the built-in ones.
    pub(super) fn scene_names(&self) -> Vec<String> {
        let given = self.given.iter().map(|(entry, _)| entry.name.clone());
        given.chain(scene_list::built_in_names().map(str::to_owned)).collect()
    }

    /// What the hint line is for.
    pub(super) fn place(&self) -> Place {
        let snapshot = &self.report.snapshot;
        let struck = || snapshot.contacts.iter().any(|contact| contact.class == Class::Collide);
        match (&self.open, self.report.activity) {
            (Open::Scenes(_), _) => Place::List,
            (Open::Help { .. }, _) => Place::Help,
            (Open::Events(list), _) => Place::Events { narrowed: !list.typed().is_empty() },
            _ if self.report.kept.is_past => Place::Past,
            (_, Activity::Paused) if struck() => Place::Impact { searched: !snapshot.trials.is_empty() },
            _ => Place::Run,
        }
    }

    /// What can be named on the `:` line, where there are these scenes.
    pub(super) fn context<'a>(&self, scenes: &'a [String]) -> Context<'a> {
        let stage = &self.current.stage;
        let (spheres, walls) = (stage.radii.len(), stage.walls.len());
        Context { spheres, walls, selected: self.view_settings.selected, scenes }
    }

    /// Asks for what is shown around the frame: where spheres were, what comes next of the selected one.
    pub(super) fn look_around(&mut self) {
        let settings = &self.view_settings;
        let wanted = settings.overlays.predicted || view::inspector_is_shown(settings, self.area);
        let around = (settings.overlays.path, settings.selected.filter(|_| wanted));
        if around != self.around {
            self.around = around;
            self.worker.send(Command::Around { path: around.0, sphere: around.1 });
        }
    }

    /// Has the trial step that the card asks for ready to be drawn.
    pub(super) fn show_trial(&mut self) {
        let snapshot = &self.report.snapshot;
        let Some(probe) = self.view_settings.card.and_then(|card| card.probe) else {
            self.trial = None;
            return;
        };
        let is = |trial: &Trial| Arc::ptr_eq(&trial.of.0, snapshot) && trial.of.1 == probe;
        if !self.trial.as_ref().is_some_and(is) {
            let shown = snapshot.at_trial(probe);
            self.trial = shown.map(|shown| Trial { of: (Arc::clone(snapshot), probe), shown });
        }
    }

    /// Answers the last key, in place of the key hints, until the next key.
    pub(super) fn say(&mut self, answer: impl Into<String>) {
        self.answer = Some(answer.into());
    }

    /// Says what happened unasked, behind the answer to the last key, until the next key.
    pub(super) fn tell(&mut self, news: impl Into<String>) {
        self.news = Some(news.into());
    }

    /// The message in place of the key hints.
    pub(super) fn message(&self) -> Option<String> {
        let said: Vec<&str> = [&self.answer, &self.news].into_iter().flatten().map(String::as_str).collect();
        (!said.is_empty()).then(|| said.join(" "))
    }

    /// Lets the run go on and on, or pauses it.
    pub(super) fn run(&mut self, on: bool) {
        (self.running, self.has_target) = (on, false);
        self.sought = None;
        self.worker.send(Command::Run(on));
    }

    /// Runs to where a command leads, not on and on.
    pub(super) fn head_for(&mut self, command: Command, on: bool) {
        (self.running, self.has_target) = (on, on);
        self.sought = None;
        self.worker.send(command);
    }

    /// What to do where a run cannot go on; why it cannot is on the screen already.
    pub(super) fn stalled(&self) -> String {
        let ways = [(Action::NextMethod, "changes the method"), (Action::Restart, "restarts")];
        let way = |(action, does): (Action, &str)| self.keymap.keys(action).first().map(|key| format!("{key} {does}"));
        let ways: Vec<String> = ways.into_iter().filter_map(way).collect();
        let ways = if ways.is_empty() { String::new() } else { format!(": {}", ways.join(", ")) };
        format!("The run cannot go on from here{ways}.")
    }

    /// A stalled run can't go on: says why, and whether that was so.
    pub(super) fn say_if_stalled(&mut self) -> bool {
        let stalled = self.report.obeyed == self.worker.sent() && self.report.activity == Activity::Stalled;
        if stalled {
            self.say(self.stalled());
        }
        stalled
    }

    /// Puts the worker on another scene; what is drawn of it, and how, stays as chosen.
    pub(super) fn show(&mut self, current: Current, settings: Settings) {
        let running = self.running;
        self.end_recording();
        self.current = current;
        self.settings = settings;
        self.worker.send(Command::Load(self.current.job(settings)));
        self.run(running);
        view_settings::whole_scene(&mut self.view_settings);
        self.view_settings.selected = None;
        self.until = None;
        if self.comparison.is_some() {
            self.compare();
        }
    }

    /// Starts the exact run beside this one.
    pub(super) fn compare(&mut self) {
        let before = self.comparison.take().map(Comparison::end).or(self.ending.take());
        match Comparison::start(&self.current, &self.report, before, Arc::clone(&self.notify)) {
            Ok(comparison) => self.comparison = Some(comparison),
            Err(error) => self.say(format!("The exact run cannot start: {}.", printable::cause(&error))),
        }
    }

    /// Says what of the scene is allowed but hardly meant.
    pub(super) fn warn(&mut self) {
        let warnings = scene::warnings(&self.current.scene, self.settings, self.current.scene.duration);
        if !warnings.is_empty() {
            self.say(format!("Note: {}.", warnings.join("; ")));
        }
    }

    pub(super) fn solve_with(&mut self, settings: Result<Settings, String>) {
        match settings {
            Ok(settings) => {
                if let Some(said) = knobs::in_vain(self.settings, settings) {
                    self.say(said);
                }
                self.settings = settings;
                self.worker.send(Command::Settings(settings));
            }
            Err(said) => self.say(said),
        }
    }

    pub(super) fn go_at(&mut self, speed: Result<f64, String>) {
        match speed {
            Ok(speed) => {
                self.speed = speed;
                self.worker.send(Command::Speed(speed));
            }
            Err(said) => self.say(said),
        }
    }
}
