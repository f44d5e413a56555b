//! How long does it take to go back, and what does it cost a run that its past is kept? `cargo bench --bench history`
//!
//! A run of a scene by a method goes on for some seconds of wall time, or frames; then come a hundred frames back one by
//! one, places at random among all that are kept, and collisions backwards: the longest and the median processor time of
//! all threads until the worker has reported the frame, which is what passes where nothing else runs. The cost is the processor time of the run over that of a bare simulation with the same
//! watch over it. The memory is what the process has grown by since the run's start. Last comes
//! how many of the hundred frames back, and of the places at random, took no more than 5 ms and 100 ms. Names of scenes choose among them.

// Results go to stdout: this is a program for people.
#![allow(clippy::print_stdout)]

use std::sync::{
    Arc,
    mpsc::{self, Receiver},
};

use carom::{
    audit::Watch,
    measure,
    physics::{Method, Progress, Settings, Simulation, Until},
    random::SplitMix64,
    scene::{self, Scene},
    snapshot::Stage,
    worker::{Activity, Command, Job, Report, Worker},
};

/// A gas so large that few of its frames are kept.
const CROWD: &str = "Scene(duration: 100, contact: (restitution: 1, tangential: 1, rest_speed: 0), \
    walls: [Room(min: (-10, 0, -10), max: (10, 20, 10))], \
    spheres: [Gas(min: (-10, 0, -10), max: (10, 20, 10), count: 10000, seed: 7, speed: 1, mass: 1, radius: 0.1)])";

/// What one frame back, and any frame that is kept, may take, s.
const BACK: f64 = 5e-3;
/// See [`BACK`].
const ANY: f64 = 0.1;

/// Simulated time at which a run ends, s, by scene: some hundred thousand frames where they are cheap.
const RUNS: [(&str, &[(Method, f64)]); 6] = [
    ("paper-2", &[(Method::Paper, 10.0), (Method::Exact, 1000.0), (Method::Moreau, 1000.0)]),
    ("paper-3", &[(Method::Paper, 20.0), (Method::Swept, 1000.0)]),
    ("elastic-666", &[(Method::Paper, 3.0), (Method::Exact, 150.0), (Method::Moreau, 20.0)]),
    ("inelastic-666", &[(Method::Exact, 0.45), (Method::Moreau, 10.0)]),
    ("box-gas", &[(Method::Paper, 4.0), (Method::Exact, 300.0), (Method::Moreau, 20.0)]),
    ("crowd", &[(Method::Paper, 0.1), (Method::Swept, 10.0), (Method::Exact, 20.0), (Method::Moreau, 3.0)]),
];

fn main() {
    println!(
        "scene          method    frames   front  cost   MiB   100 back: ms    random: ms       C: ms       start  within"
    );
    println!(
        "                                                     median  most   median  most   median  most           limits"
    );
    let wanted: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    for (name, methods) in RUNS {
        if !wanted.is_empty() && !wanted.iter().any(|wanted| wanted == name) {
            continue;
        }
        let scene = if name == "crowd" { scene::parse(CROWD, "crowd") } else { scene::open(name).map(|o| o.scene) };
        let scene = Arc::new(scene.expect("a scene"));
        for &(method, until) in methods {
            measured(name, &scene, method, until);
        }
    }
}

fn measured(name: &str, scene: &Arc<Scene>, method: Method, until: f64) {
    let settings = Settings { method, ..scene.solver };
    let bare = bare(scene, settings, until);
    let before = resident();
    let mut user = User::start(name, scene, settings);
    user.until(Command::Goto(until));
    let report = user.worker.take();
    let (frames, front) = (report.kept.newest, report.kept.oldest);
    let grown = (resident() - before) / f64::from(1 << 20);
    let mut random = SplitMix64::new(1);
    let steps: Vec<f64> = (0..100).map(|_| user.until(Command::Back(1))).collect();
    let mut places = Vec::new();
    for _ in 0..100 {
        let frame = front + (random.unit() * (frames - front) as f64) as u64;
        let here = user.worker.take().snapshot.tallies.frames;
        let command = if frame < here { Command::Back(here - frame) } else { Command::Forward(frame - here) };
        places.push(user.until(command));
    }
    user.until(Command::Newest);
    let impacts: Vec<f64> = (0..20).map(|_| user.until(Command::PreviousImpact)).collect();
    let start = 1e3 * user.until(Command::Oldest);
    let share = |times: &[f64], most: f64| 100 * times.iter().filter(|time| **time <= most).count() / times.len();
    let within = format!("{}% {}%", share(&steps, BACK), share(&places, ANY));
    let times = [steps, places, impacts].map(figures).join("  ");
    println!(
        "{name:<14} {method:<7?} {frames:>8} {front:>7} {:>5.3} {grown:>5.1}   {times} {start:>8.2}  {within}",
        report.cpu / bare
    );
}

/// Median and longest, ms.
fn figures(mut times: Vec<f64>) -> String {
    times.sort_by(f64::total_cmp);
    format!("{:>6.2} {:>6.2}", 1e3 * times[times.len() / 2], 1e3 * times[times.len() - 1])
}

/// Processor time of the run alone, s.
fn bare(scene: &Scene, settings: Settings, until: f64) -> f64 {
    let mut run = Simulation::new(scene, settings);
    run.record_events(true);
    run.explain(true);
    let mut watch = Watch::new(&run);
    let start = measure::thread_cpu();
    while run.advance(Until::Time(until), Simulation::SLICE) == Progress::Yielded {
        watch.look(&run, false);
        run.take_events();
    }
    measure::thread_cpu() - start
}

/// Resident memory of this process, bytes.
fn resident() -> f64 {
    let pages = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages: f64 = pages.split(' ').nth(1).and_then(|pages| pages.parse().ok()).unwrap_or(f64::NAN);
    4096.0 * pages
}

/// Processor time of this process, s.
fn processor() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// A worker, and the channel of its news.
struct User {
    worker: Worker,
    news: Receiver<()>,
}

impl User {
    fn start(name: &str, scene: &Arc<Scene>, settings: Settings) -> User {
        let (sender, news) = mpsc::channel();
        let notify = Arc::new(move || {
            let _ = sender.send(());
        });
        let job = Job { stage: Arc::new(Stage::of(name, scene)), scene: Arc::clone(scene), settings, recording: None };
        User { worker: Worker::start(job, 1.0, notify).expect("a thread"), news }
    }

    /// Has a command obeyed; how long it took, s.
    fn until(&mut self, command: Command) -> f64 {
        let start = processor();
        self.worker.send(command);
        let sent = self.worker.sent();
        loop {
            let report: Arc<Report> = self.worker.take();
            if report.obeyed == sent && report.activity != Activity::Running {
                return processor() - start;
            }
            let _ = self.news.recv();
        }
    }
}
