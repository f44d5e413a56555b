//! The running application without a terminal: keys and news in, a buffer out. A test drives it as a user would.

mod act;
mod action;
mod comparison;
mod keys;
mod knobs;
mod loading;
mod look;
mod prompt;
mod scene_list;

use std::{ffi::OsStr, path::PathBuf, sync::Arc};

pub use action::{Action, Direction};
use comparison::Comparison;
pub use keys::{Binding, Code, Key, action, help_rows, hints, table};
use loading::Loading;
use ratatui::{
    buffer::Buffer,
    layout::{Position, Rect},
};
use scene_list::SceneList;

use crate::{
    physics::{Scene, Settings},
    printable,
    scene::Opened,
    snapshot::{Ghost, Stage},
    view::{self, Colors, Look, Marker, Mode, Pace, Popup, Screen},
    worker::{Activity, Command, Ending, Errands, Job, Notify, Report, Worker},
};

/// What the application starts with.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The first scene.
    pub opened: Opened,
    /// What to solve it with.
    pub settings: Settings,
    /// Wait at t = 0 instead of running.
    pub paused: bool,
    /// Dots or characters.
    pub marker: Marker,
    /// Depth of colour.
    pub colors: Colors,
}

/// What reaches the application from outside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Input {
    /// A key was pressed.
    Key(Key),
    /// Text was pasted: taken where text is typed, and nowhere else.
    Paste(String),
    /// The worker has called `notify`.
    News,
}

/// What an input asks of whoever holds the screen.
#[derive(Debug, Clone, PartialEq, Eq)]
#[must_use]
pub enum Effect {
    /// Nothing.
    Nothing,
    /// Draw when it is time for the next picture.
    Draw,
    /// Draw at once: somebody is waiting for an answer.
    DrawNow,
    /// Draw everything again, whatever is on the screen.
    Repaint,
    /// Give the terminal back to the shell for a while.
    Suspend,
    /// End.
    Quit,
    /// End: the simulation's thread has panicked, which said this.
    Fail(String),
}

/// What is open over the views.
#[derive(Debug)]
enum Open {
    Nothing,
    Help { scroll: usize },
    Scenes(SceneList),
    Prompt(String),
}

/// The scene under way, as it was opened.
#[derive(Debug)]
struct Current {
    /// Built-in name or path, as it is shown.
    name: String,
    /// Its file, unless it is built in.
    path: Option<PathBuf>,
    scene: Arc<Scene>,
    /// What its snapshots show as constant.
    stage: Arc<Stage>,
}

impl Current {
    fn of(opened: Opened) -> Current {
        let Opened { key, path, scene } = opened;
        let stage = Arc::new(Stage::of(&key, &scene));
        Current { name: name_of(&key, path.as_ref()), path, scene: Arc::new(scene), stage }
    }

    /// What [`crate::scene::open`] takes to open this scene again.
    fn source(&self) -> &OsStr {
        self.path.as_ref().map_or(OsStr::new(&self.name), |path| path.as_os_str())
    }

    fn job(&self, settings: Settings) -> Job {
        Job { stage: Arc::clone(&self.stage), scene: Arc::clone(&self.scene), settings }
    }
}

/// The application.
pub struct App {
    worker: Worker,
    report: Arc<Report>,
    current: Current,
    /// The file the program was started with, in the list beside the built-in scenes.
    given: Option<(scene_list::Entry, PathBuf)>,
    settings: Settings,
    speed: f64,
    /// Whether the run was told to run; the worker's latest report may not know yet.
    running: bool,
    /// Whether it runs to a collision or a time, where it stops; Esc stops it before.
    headed: bool,
    /// The exact run beside it, if it was asked for.
    comparison: Option<Comparison>,
    /// The exact run that was shown last, while it ends.
    ending: Option<Ending>,
    /// The scene that comes next, if one is being opened, and the channel that it arrives on.
    loading: Option<Loading>,
    errands: Option<Errands>,
    notify: Notify,
    look: Look,
    open: Open,
    message: Option<String>,
    /// Size of the last picture.
    area: Rect,
    help: Vec<(String, &'static str)>,
    hints: Vec<(String, &'static str)>,
}

impl App {
    /// Loads the scene and starts its worker, which calls `notify` when there is [`Input::News`].
    ///
    /// # Errors
    /// If the system has no thread for the worker.
    pub fn new(setup: Setup, notify: Notify) -> std::io::Result<App> {
        let current = Current::of(setup.opened);
        let worker = Worker::start(current.job(setup.settings), 1.0, Arc::clone(&notify))?;
        let report = worker.take();
        let about = current.scene.about.clone();
        let entry = scene_list::Entry { name: current.name.clone(), about };
        let given = current.path.clone().map(|path| (entry, path));
        let mut app = App {
            worker,
            report,
            current,
            given,
            settings: setup.settings,
            speed: 1.0,
            running: false,
            headed: false,
            comparison: None,
            ending: None,
            loading: None,
            errands: None,
            notify,
            look: first_look(setup.marker, setup.colors),
            open: Open::Nothing,
            message: None,
            area: Rect::default(),
            help: help_rows(),
            hints: hints(),
        };
        app.warn();
        if !setup.paused {
            app.run(true);
        }
        Ok(app)
    }

    /// Obeys one input.
    pub fn handle(&mut self, input: Input) -> Effect {
        match input {
            Input::Key(key) => self.key(key),
            Input::Paste(text) => self.paste(&text),
            Input::News => self.news(),
        }
    }

    /// Draws the application as it stands over the whole buffer.
    pub fn draw(&mut self, buffer: &mut Buffer) {
        self.area = buffer.area;
        self.with_screen(|screen| view::draw(screen, buffer.area, buffer));
    }

    /// Where the terminal's cursor belongs in the picture last drawn; `None`: nowhere.
    pub fn cursor(&self) -> Option<Position> {
        self.with_screen(|screen| view::cursor(screen, self.area))
    }

    /// One line of news in place of the key hints, until the next key.
    pub fn say(&mut self, message: impl Into<String>) {
        self.message = Some(message.into());
    }

    /// The latest report of the run.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Whether the run has obeyed every key so far and waits for the next, and the exact run beside it likewise.
    pub fn settled(&self) -> bool {
        let compared = |comparison: &Comparison| comparison.is_settled(self.report.snapshot.t);
        let obeyed = self.report.obeyed == self.worker.sent() && self.report.activity != Activity::Running;
        obeyed && self.loading.is_none() && self.comparison.as_ref().is_none_or(compared)
    }

    /// The exact run beside the one shown, where it was asked for and has said anything yet.
    pub fn ghost(&self) -> Option<&Ghost> {
        self.comparison.as_ref().and_then(Comparison::ghost)
    }

    /// What the user chose to look at.
    pub fn look(&self) -> &Look {
        &self.look
    }

    /// Takes the scene on its way if it has come, and the worker's latest report.
    fn news(&mut self) -> Effect {
        match (self.look_for_scene(), self.report_news()) {
            (Some(Effect::DrawNow), Effect::Draw) => Effect::DrawNow,
            (_, effect) => effect,
        }
    }

    fn report_news(&mut self) -> Effect {
        let before = std::mem::replace(&mut self.report, self.worker.take());
        if let Some(said) = &self.report.panic {
            return Effect::Fail(said.clone());
        }
        if let Some(comparison) = &mut self.comparison {
            comparison.follow(&before, &self.report);
        }
        if self.report.obeyed == self.worker.sent() {
            self.running = self.report.activity == Activity::Running;
            self.headed &= self.running;
        }
        if self.report.activity == Activity::Stalled && before.activity != Activity::Stalled {
            self.say(act::STALLED);
        }
        if self.report.obeyed == before.obeyed && self.report.activity == before.activity {
            Effect::Draw
        } else {
            Effect::DrawNow
        }
    }

    fn run(&mut self, on: bool) {
        (self.running, self.headed) = (on, false);
        self.worker.send(Command::Run(on));
    }

    /// The screen as it stands, lent to `show`.
    fn with_screen<T>(&self, show: impl FnOnce(&Screen) -> T) -> T {
        let (help, hints) = (pairs(&self.help), pairs(&self.hints));
        let entries: Vec<(&str, &str)> = match &self.open {
            Open::Scenes(list) => list.shown().map(|entry| (entry.name.as_str(), entry.about.as_str())).collect(),
            _ => Vec::new(),
        };
        show(&Screen {
            snapshot: &self.report.snapshot,
            pace: pace(&self.report),
            ticks: &self.report.ticks,
            beside: self.comparison.as_ref().map(Comparison::shown),
            look: &self.look,
            popup: match &self.open {
                Open::Nothing => Popup::None,
                Open::Prompt(text) => Popup::Prompt { text },
                Open::Help { scroll } => Popup::Help { rows: &help, scroll: *scroll },
                Open::Scenes(list) => Popup::Scenes {
                    filter: list.filter(),
                    filtering: list.filtering(),
                    entries: &entries,
                    cursor: list.cursor(),
                },
            },
            message: self.message.as_deref(),
            hints: &hints,
        })
    }
}

/// How a scene is called on the screen: by its path, as far as it can be printed, or its built-in name.
fn name_of(key: &str, path: Option<&PathBuf>) -> String {
    path.map_or_else(|| key.to_owned(), |path| printable::name(path.as_os_str()))
}

/// Both views, the whole scene, nothing selected.
fn first_look(marker: Marker, colors: Colors) -> Look {
    Look { marker, colors, ..Look::default() }
}

fn pace(report: &Report) -> Pace {
    let mode = match report.activity {
        Activity::Running => Mode::Run,
        Activity::Paused => Mode::Pause,
        Activity::Stalled => Mode::Stalled,
    };
    Pace { mode, wanted: report.wanted, reached: report.reached }
}

fn pairs<'a>(rows: &'a [(String, &'static str)]) -> Vec<(&'a str, &'a str)> {
    rows.iter().map(|(keys, does)| (keys.as_str(), *does)).collect()
}
