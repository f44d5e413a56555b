//! Does every key of the application do what the key table says? The whole application, without a terminal.

use std::{
    sync::{Arc, mpsc},
    time::Duration,
};

use carom::{
    app::{Action, App, Code, Effect, Input, Key, Keymap, Setup, table},
    physics::{Progress, Settings, Simulation, Until},
    recording::Recording,
    scene::{self, Opened},
    snapshot::{Class, Snapshot, Stage},
    view::{Colors, Inks, Marker, Views},
    worker::{Activity, Bodies, Command, Job, Notify, Stop, Worker},
};
use ratatui::{buffer::Buffer, layout::Rect};

/// Longest wait for the worker: generous, because it only ends a test that has failed.
const PATIENCE: Duration = Duration::from_secs(60);

/// News as a message; the test that would read it may be over.
fn tell(sender: mpsc::Sender<()>) -> Notify {
    Arc::new(move || {
        let _ = sender.send(());
    })
}

/// The application as a user sees it.
pub(crate) struct User {
    pub(crate) app: App,
    news: mpsc::Receiver<()>,
    /// Where it writes files.
    pub(crate) folder: tempfile::TempDir,
    pub(crate) screen: Buffer,
}

impl User {
    pub(crate) fn at(scene: &str, paused: bool) -> User {
        User::bound(scene, paused, Keymap::default())
    }

    /// With keys bound otherwise.
    pub(crate) fn bound(scene: &str, paused: bool, keymap: Keymap) -> User {
        let opened = scene::open(scene).expect("the scene loads");
        let settings = opened.scene.solver;
        User::set_up(opened, settings, (paused, false), (keymap, None))
    }

    /// Paused on a recording.
    pub(crate) fn replays(recording: Recording) -> User {
        let scene = scene::parse(&recording.scene, &recording.key).expect("the scene loads");
        let opened = Opened { key: recording.key.clone(), path: None, scene };
        User::set_up(opened, recording.settings, (true, false), (Keymap::default(), Some(recording)))
    }

    /// What a newcomer sees first, on a screen of that size.
    pub(crate) fn new_here(width: u16, height: u16) -> User {
        let opened = scene::open("billiard").expect("built in");
        let settings = opened.scene.solver;
        let mut user = User::set_up(opened, settings, (false, true), (Keymap::default(), None));
        user.screen = Buffer::empty(Rect::new(0, 0, width, height));
        user.settle();
        user
    }

    fn set_up(
        opened: Opened,
        settings: Settings,
        (paused, taken_apart): (bool, bool),
        more: (Keymap, Option<Recording>),
    ) -> User {
        let (keymap, recording) = more;
        let inks = Inks::default();
        let folder = tempfile::tempdir().expect("a folder");
        let (marker, colors) = (Marker::Ascii, Colors::Ansi16);
        let path = folder.path().into();
        let setup =
            Setup { opened, settings, paused, taken_apart, marker, colors, inks, keymap, recording, folder: path };
        let (sender, news) = mpsc::channel();
        let app = App::new(setup, tell(sender)).expect("there is a thread to be had");
        let mut user = User { app, folder, news, screen: Buffer::empty(Rect::new(0, 0, 80, 24)) };
        user.look();
        user
    }

    /// A paused program.
    pub(crate) fn with(scene: &str) -> User {
        User::at(scene, true)
    }

    pub(crate) fn look(&mut self) {
        self.screen.reset();
        self.app.draw(&mut self.screen);
    }

    /// Takes the worker's news until it is as wanted.
    pub(crate) fn until(&mut self, what: &str, wanted: impl Fn(&App) -> bool) {
        while !wanted(&self.app) {
            self.news.recv_timeout(PATIENCE).unwrap_or_else(|_| panic!("never {what}"));
            assert!(!matches!(self.app.handle(Input::News), Effect::Fail(_)));
        }
        self.look();
    }

    pub(crate) fn settle(&mut self) {
        self.until("settled", App::settled);
    }

    /// Presses a key and waits for what comes of it.
    pub(crate) fn press(&mut self, key: Key) -> Effect {
        let effect = self.app.handle(Input::Key(key));
        self.settle();
        effect
    }

    /// Types, `\n` for Enter, `\x1b` for Esc and `\t` for Tab.
    pub(crate) fn type_in(&mut self, keys: &str) {
        for c in keys.chars() {
            let key = match c {
                '\n' => Key::plain(Code::Enter),
                '\x1b' => Key::plain(Code::Escape),
                '\t' => Key::plain(Code::Tab),
                c => Key::char(c),
            };
            let _ = self.press(key);
        }
    }

    pub(crate) fn snapshot(&self) -> &Snapshot {
        &self.app.report().snapshot
    }

    /// Row `y` of the screen; negative: from the bottom.
    pub(crate) fn row(&self, y: i32) -> String {
        let Rect { width, height, .. } = self.screen.area;
        let y = y.rem_euclid(height.into()) as u16;
        (0..width).map(|x| self.screen[(x, y)].symbol()).collect()
    }

    pub(crate) fn text(&self) -> String {
        (0..i32::from(self.screen.area.height)).map(|y| self.row(y) + "\n").collect()
    }
}

/// What has to be pressed for an action to have something to act on.
fn before(action: Action) -> &'static str {
    match action {
        Action::Restart => ".",
        Action::RealTime => "+",
        Action::WholeScene => "z",
        Action::Close => "?",
        _ => "",
    }
}

#[test]
fn every_key_of_the_table_has_an_effect_that_can_be_seen() {
    for row in table() {
        for key in row.keys {
            let mut user = User::with("paper-2");
            user.type_in(before(row.action));
            let (screen, t) = (user.screen.clone(), user.snapshot().t);
            if row.action == Action::TogglePause {
                let _ = user.app.handle(Input::Key(*key));
                user.until("running", |app| app.report().snapshot.t > t);
                continue;
            }
            match user.press(*key) {
                Effect::DrawNow => assert_ne!(user.screen, screen, "{key}: {}\n{}", row.does, user.text()),
                other => assert!(matches!(other, Effect::Quit | Effect::Repaint | Effect::Suspend), "{key}: {other:?}"),
            }
        }
    }
}

#[test]
fn the_help_says_of_every_row_of_the_table_what_its_first_key_does() {
    let mut user = User::with("paper-0");
    user.type_in("?");
    for row in table() {
        let first = row.keys[0].to_string();
        let said = |(keys, does): &(String, &str)| *does == row.does && keys.split(' ').any(|key| key == first);
        assert!(carom::app::help_rows().iter().any(said), "{first}: {}", row.does);
    }
    assert!(user.text().contains("space p") && user.text().contains("pause / run"), "{}", user.text());
}

#[test]
fn an_unknown_key_does_nothing_but_clear_the_message() {
    let mut user = User::with("paper-0");
    user.type_in("R");
    assert!(user.row(-1).contains("there is no file to reload"), "{}", user.row(-1));
    user.type_in("Q");
    assert!(user.row(-1).contains("space pause"), "{}", user.row(-1));
    assert!(user.app.settled());
}

#[test]
fn a_step_is_one_frame_and_c_goes_on_to_an_impact() {
    let mut user = User::with("paper-0");
    user.type_in(".");
    assert_eq!((user.snapshot().tallies.frames, user.snapshot().t), (1, 0.01));
    user.type_in("n");
    assert_eq!(user.snapshot().tallies.frames, 2);
    user.type_in("c");
    assert_eq!(user.snapshot().tallies.impacts, 1);
    // 9 m of fall at 9.8 m/s²: √(2·9/9.8) s, and the Euler frames are early or late by less than one dt.
    assert!((user.snapshot().t - 1.3553).abs() < 0.01, "{}", user.snapshot().t);
    assert_eq!(user.app.report().ticks.impacts.iter().sum::<u32>(), 1);
    user.type_in("r");
    assert_eq!((user.snapshot().t, user.snapshot().tallies.frames), (0.0, 0));
    assert_eq!(user.app.report().ticks.impacts.iter().sum::<u32>(), 0);
}

#[test]
fn a_running_run_follows_the_wall_and_a_key_stops_it() {
    let mut user = User::at("paper-0", false);
    user.until("under way", |app| app.report().snapshot.t > 0.05);
    assert!(user.row(0).contains("RUN"), "{}", user.row(0));
    user.type_in(" ");
    assert!(user.row(0).contains("PAUSE"), "{}", user.row(0));
    let t = user.snapshot().t;
    user.type_in(".");
    assert!(user.snapshot().t > t);
}

#[test]
fn knobs_turn_from_here_on_and_survive_a_restart() {
    let mut user = User::with("paper-0");
    user.type_in(".ttSs+");
    let Snapshot { tolerance, dt, .. } = *user.snapshot();
    assert_eq!((tolerance, dt, user.app.report().wanted), (1e-5, 0.01, 2.0));
    user.type_in("s=Tr");
    let Snapshot { tolerance, dt, t, .. } = *user.snapshot();
    assert_eq!((tolerance, dt, t, user.app.report().wanted), (1e-4, 0.005, 0.0, 1.0));
}

#[test]
fn the_prompt_takes_exact_values_and_names_what_is_allowed() {
    let mut user = User::with("paper-0");
    user.type_in(":dt 1e-4\n:tolerance 1e-9\n:speed 0.1\n:goto 1\n");
    let Snapshot { tolerance, dt, t, .. } = *user.snapshot();
    assert_eq!((tolerance, dt, user.app.report().wanted), (1e-9, 1e-4, 0.1));
    assert!((1.0..1.0 + 2e-4).contains(&t), "the first frame that ends at or after 1 s: {t}");
    user.type_in(":goto 0.5\n");
    assert!((0.5..0.5 + 2e-4).contains(&user.snapshot().t), "what has passed is reached from the start");
    user.type_in(":dt -1\n");
    assert!(user.row(-1).contains("-1 is not allowed: :dt takes seconds above 0"), "{}", user.row(-1));
    assert_eq!(user.snapshot().dt, 1e-4);
    user.type_in(":dt 5\x1b");
    assert_eq!(user.snapshot().dt, 1e-4, "Esc closes without an effect");
}

#[test]
fn escape_never_quits() {
    let mut user = User::with("paper-0");
    for opened in ["", "?", "o", "o/x", ":", ":dt"] {
        user.type_in(opened);
        for _ in 0..3 {
            assert_eq!(user.press(Key::plain(Code::Escape)), Effect::DrawNow);
        }
        assert!(user.row(-1).contains("space pause"), "{opened:?}: {}", user.text());
    }
}

#[test]
fn letters_are_text_where_text_is_typed_but_control_keys_still_work() {
    let mut user = User::with("paper-0");
    user.type_in(":q");
    assert!(user.row(-1).contains(":q"), "{}", user.row(-1));
    let _ = user.app.handle(Input::Paste("uick\n".into()));
    user.look();
    assert!(user.row(-1).contains(":quick"), "{}", user.row(-1));
    assert_eq!(user.press(Key::ctrl('l')), Effect::Repaint);
    assert_eq!(user.press(Key::ctrl('c')), Effect::DrawNow, "the line closes first");
    assert!(!user.row(-1).contains(":quick"), "{}", user.row(-1));
    assert_eq!(user.press(Key::ctrl('c')), Effect::Quit);
}

#[test]
fn pasted_text_is_no_keys() {
    let mut user = User::with("paper-0");
    assert_eq!(user.app.handle(Input::Paste("q...".into())), Effect::Nothing);
    user.settle();
    assert_eq!(user.snapshot().t, 0.0);
}

#[test]
fn the_list_opens_scenes_and_brackets_go_through_it() {
    let mut user = User::with("paper-1");
    user.type_in("]");
    assert_eq!(user.snapshot().stage.key, "paper-2");
    user.type_in("[[");
    assert_eq!(user.snapshot().stage.key, "paper-0");
    user.type_in("[");
    let last = scene::builtin::ALL.last().expect("there are scenes").name;
    assert_eq!(user.snapshot().stage.key, last, "round from the first to the last");
    user.type_in("o/paper-3\n");
    assert_eq!(user.snapshot().stage.key, "paper-3");
    user.type_in("ok\n");
    assert_eq!(user.snapshot().stage.key, "paper-2");
}

#[test]
fn another_scene_keeps_how_it_is_drawn_and_forgets_where_one_looked() {
    let mut user = User::with("paper-2");
    user.type_in("vdizhf.");
    let before = user.app.view_settings().clone();
    assert!(before.follow && before.views == Views::Side && before.selected == Some(0));
    user.type_in("]");
    let after = user.app.view_settings();
    assert_eq!((after.marker, after.colors, after.views), (before.marker, before.colors, before.views));
    assert_eq!((after.overlays, after.inspector), (before.overlays, before.inspector));
    assert_eq!((after.zoom, after.follow, after.selected), (1.0, false, None));
    assert_eq!(user.app.report().activity, Activity::Paused);
}

#[test]
fn a_scene_file_is_reloaded_and_one_that_breaks_leaves_the_run_alive() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.ron");
    let write = |dt: &str| {
        let scene =
            format!("Scene(name: \"Mine\", solver: (dt: {dt}), spheres: [Sphere(x: (0, 0, 0), mass: 1, radius: 1)])");
        std::fs::write(&path, scene).expect("a file");
    };
    write("0.5");
    let mut user = User::with(path.to_str().expect("a plain path"));
    user.type_in("..");
    assert_eq!((user.snapshot().t, user.snapshot().stage.key.as_str()), (1.0, "mine"));
    write("-1");
    user.type_in("R");
    assert!(user.text().contains("mine.ron"), "{}", user.text());
    assert_eq!(user.snapshot().t, 1.0);
    write("0.25");
    user.type_in("R");
    assert!(user.row(-1).contains("Reloaded"), "{}", user.row(-1));
    assert_eq!((user.snapshot().t, user.snapshot().dt), (0.0, 0.25));
    user.type_in("]");
    assert_eq!(user.snapshot().stage.key, "paper-0");
    user.type_in("[");
    assert_eq!(user.snapshot().stage.key, "mine", "the file stays in the list");
}

#[test]
fn a_run_that_cannot_go_on_says_so_once_and_again_when_asked() {
    // Resting in a wedge stalls the printed method near 10.3 s: a result of the paper, not of ours.
    let mut user = User::with("paper-2");
    user.type_in(":goto 20\n");
    assert_eq!(user.app.report().activity, Activity::Stalled);
    assert!(user.snapshot().t < 20.0);
    let reason = user.snapshot().stall.clone().expect("it has a reason");
    let start: String = reason.chars().take(30).collect();
    assert!(user.row(2).contains(&start), "{}", user.text());
    assert!(user.row(-1).contains("m changes the method"), "{}", user.row(-1));
    user.type_in("v");
    assert!(!user.row(-1).contains("m changes the method"), "{}", user.row(-1));
    user.type_in(" ");
    assert!(user.row(-1).contains("m changes the method"), "{}", user.row(-1));
    user.type_in("r");
    assert_eq!((user.app.report().activity, user.snapshot().t), (Activity::Paused, 0.0));
    assert_eq!(user.snapshot().stall, None);
}

#[test]
fn the_ghost_shows_how_far_paper_is_off_and_that_exact_is_not() {
    let mut user = User::with("paper-0");
    user.type_in(":dt 0.1\n:goto 1\nx");
    // Free fall from rest by Euler's rule is g t dt / 2 too low after t, here 9.8 · 1 · 0.1 / 2 m (to rounding of the sum).
    let t = user.snapshot().t;
    let ghost = user.app.ghost().expect("it has been compared").clone();
    assert_eq!(ghost.t, t);
    assert!((ghost.deviations[0] - 0.5 * 9.8 * t * 0.1).abs() < 1e-12, "{ghost:?}");
    assert!(user.text().contains("exact run  t"), "{}", user.text());
    user.type_in("r:dt 0.1\nmm:goto 1\n");
    assert_eq!(user.snapshot().method, "exact");
    let ghost = user.app.ghost().expect("it has been compared");
    assert_eq!((ghost.deviations[0], ghost.energy_error), (0.0, 0.0));
    user.type_in("]");
    assert_eq!(user.app.ghost().map(|ghost| ghost.t), Some(0.0), "another scene is compared from its start");
    user.type_in("x");
    assert_eq!(user.app.ghost(), None);
    assert!(!user.text().contains("exact run  t"), "{}", user.text());
}

#[test]
fn past_its_horizon_a_scene_says_so() {
    let mut user = User::with("paper-3");
    user.type_in("x:goto 12\n");
    // The horizon is looked for when there is nothing else to do; it lies between 7 and 11 s.
    user.until("past the horizon", |app| app.ghost().is_some_and(carom::snapshot::Ghost::is_past_horizon));
    assert!(user.text().contains("positions mean nothing"), "{}", user.text());
}

#[test]
fn a_message_takes_the_rows_it_needs_and_what_is_hardly_meant_is_said_at_once() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("fast.ron");
    let fast = "Scene(spheres: [Sphere(x: (0, 0, 0), v: (1e3, 0, 0), mass: 1, radius: 0.5)])";
    std::fs::write(&path, fast).expect("writable");
    let mut user = User::with(&path.to_string_lossy());
    assert!(user.text().contains("Note: sphere 0 is so fast"), "{}", user.text());
    assert!(user.row(-1).trim_end().ends_with("lower dt."), "its end is on the last row: {}", user.text());
    user.type_in("v");
    assert!(!user.text().contains("so fast"), "{}", user.text());
    std::fs::write(&path, "Scene(\n  sphere: []\n)").expect("writable");
    user.type_in("R");
    let said: String = user.text().split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("2:3: unknown field") || said.contains("sphere"), "{}", user.text());
    assert!(said.contains("`spheres`"), "what is allowed is seen too: {}", user.text());
}

#[test]
fn sizes_down_to_nothing_are_drawn() {
    let mut user = User::with("paper-2");
    for popup in ["", "?", "\x1bo", "\x1b:"] {
        user.type_in(popup);
        for (width, height) in [(0, 0), (1, 1), (0, 24), (80, 0), (12, 3), (30, 8), (60, 16), (200, 60)] {
            user.app.draw(&mut Buffer::empty(Rect::new(0, 0, width, height)));
            let _ = user.app.cursor();
        }
    }
}

/// A worker on a scene, and its news.
fn worker(scene: &str) -> (Worker, mpsc::Receiver<()>, Job) {
    let opened = scene::open(scene).expect("the scene loads");
    let settings = Settings { dt: 1e-3, ..opened.scene.solver };
    let stage = Arc::new(Stage::of(&opened.key, &opened.scene));
    let job = Job { stage, scene: Arc::new(opened.scene), settings, recording: None };
    let (sender, news) = mpsc::channel();
    let worker = Worker::start(job.clone(), 1.0, tell(sender)).expect("a thread");
    (worker, news, job)
}

/// The bits of a run.
fn bits(t: f64, x: &[glam::DVec3], v: &[glam::DVec3]) -> Vec<u64> {
    let numbers = x.iter().chain(v).flat_map(glam::DVec3::to_array);
    [t].into_iter().chain(numbers).map(f64::to_bits).collect()
}

#[test]
fn the_worker_changes_no_bit_of_a_run() {
    let impact = Stop::Event(Class::Collide, Bodies::Any);
    for scene in ["paper-1", "paper-2", "paper-3"] {
        let (mut worker, news, job) = worker(scene);
        worker.send(Command::Speed(50.0));
        worker.send(Command::Run(true));
        let wait = |worker: &Worker, enough: &dyn Fn(&carom::worker::Report) -> bool| loop {
            news.recv_timeout(PATIENCE).expect("news");
            let report = worker.take();
            if enough(&report) {
                return report;
            }
        };
        wait(&worker, &|report| report.snapshot.t > 4.0);
        for command in
            [Command::Run(false), Command::Forward(1), Command::Until(impact), Command::Speed(0.5), Command::Forward(1)]
        {
            worker.send(command);
        }
        let sent = worker.sent();
        let report = wait(&worker, &|report| report.obeyed == sent && report.activity == Activity::Paused);
        let mut alone = Simulation::new(&job.scene, job.settings);
        for _ in 0..report.snapshot.tallies.frames {
            assert_eq!(alone.advance(Until::Frame, u64::MAX), Progress::Reached);
        }
        let state = alone.state();
        let snapshot = &report.snapshot;
        assert_eq!(bits(snapshot.t, &snapshot.x, &snapshot.v), bits(state.t, &state.x, &state.v), "{scene}");
        assert_eq!(snapshot.tallies, alone.tallies());
    }
}

#[test]
fn a_worker_that_waits_sends_no_news() {
    let (mut worker, news, _job) = worker("paper-0");
    worker.send(Command::Forward(1));
    news.recv_timeout(PATIENCE).expect("the step");
    while worker.take().obeyed < 1 {
        news.recv_timeout(PATIENCE).expect("the step");
    }
    let silence = Duration::from_millis(300); // longer than eighteen reports of a running run
    assert_eq!(news.recv_timeout(silence), Err(mpsc::RecvTimeoutError::Timeout));
}

#[test]
fn escape_stops_on_the_way_to_a_time() {
    let mut user = User::with("box-gas");
    user.type_in(":goto 1e9");
    let _ = user.app.handle(Input::Key(Key::plain(Code::Enter)));
    user.until("under way", |app| app.report().snapshot.t > 0.0);
    user.type_in("\x1b");
    assert!(user.snapshot().t < 1e9);
    assert!(user.row(0).contains("PAUSE"), "{}", user.row(0));
}
