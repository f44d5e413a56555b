//! Many settings on many scenes, side by side, a thread each.

use std::fmt;
use std::sync::Mutex;

use super::cost::cost;
use super::interrupt::{GoOn, Interrupted};
use super::ladder::{Ladder, Rung};
use super::shard::Shard;
use super::side_by_side::side_by_side;
use super::trade::{ASKED, Setting, Subject};
use crate::export::TradeRow;
use crate::scene::{Method, Scene};

/// Weight of a run that takes no steps, in steps: events, set-up and timing.
const EVENTFUL: f64 = 2e3;

/// What to measure.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// Scenes and what to call them, each name once; in the order of their names, so that parts of a sweep merge to
    /// the whole.
    scenes: Vec<(String, Scene)>,
    ladder: Ladder,
    shard: Shard,
    /// Processor time after which a setting is given up, s.
    timeout: f64,
    /// The error that references may have themselves, m.
    asked: f64,
}

/// What became of a sweep.
#[derive(Debug, Clone)]
pub struct Measured {
    /// The settings that are done, by scene, method, dt, tolerance.
    pub rows: Vec<TradeRow>,
    /// Number of settings that there were to do.
    pub wanted: usize,
    /// What the reference of each scene cost, s of thread CPU per simulated second.
    pub yardsticks: Vec<Yardstick>,
}

/// The reference of a scene, and its price.
#[derive(Debug, Clone, PartialEq)]
pub struct Yardstick {
    /// The scene's key.
    pub scene: String,
    /// Method of the reference.
    pub method: Method,
    /// Thread CPU time per simulated second, s.
    pub cpu_per_s: f64,
    /// The largest growth of a displacement up to the horizon or the end.
    pub growth: f64,
}

/// Why there is no sweep. Displays as a sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SweepError {
    /// The scene of this name lasts 0 s.
    NoDuration(String),
    /// Two scenes have this name.
    OneName(String),
}

impl fmt::Display for SweepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SweepError::NoDuration(key) => write!(f, "{key} lasts 0 s; there is nothing to measure"),
            SweepError::OneName(key) => write!(f, "two scenes are called {key}; their rows could not be told apart"),
        }
    }
}

impl std::error::Error for SweepError {}

/// How far a sweep is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Advance {
    /// Settings done.
    pub done: usize,
    /// Share of the work that is done, 0 to 1, estimated by steps.
    pub share: f64,
}

impl Sweep {
    /// # Errors
    /// If two scenes have one name, so that their rows could not be told apart, or if one lasts 0 s.
    pub fn new(mut scenes: Vec<(String, Scene)>, ladder: Ladder, shard: Shard) -> Result<Sweep, SweepError> {
        let (timeout, asked) = (f64::INFINITY, ASKED);
        scenes.sort_by(|a, b| a.0.cmp(&b.0));
        if let Some((key, _)) = scenes.iter().find(|(_, scene)| scene.duration <= 0.0) {
            return Err(SweepError::NoDuration(key.clone()));
        }
        match scenes.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            Some(pair) => Err(SweepError::OneName(pair[0].0.clone())),
            None => Ok(Sweep { scenes, ladder, shard, timeout, asked }),
        }
    }

    /// The sweep, with each setting given up after `timeout` (s) of processor time, and judged up to there.
    pub fn with_timeout(self, timeout: f64) -> Sweep {
        Sweep { timeout, ..self }
    }

    /// The sweep, with horizons where the certified error of a reference leaves `asked`, m.
    pub fn asking(self, asked: f64) -> Sweep {
        Sweep { asked, ..self }
    }

    /// The settings of the sweep's shard, each with the index of its scene.
    fn tasks(&self) -> Vec<(usize, Rung)> {
        let rungs = self.ladder.rungs();
        let all = (0..self.scenes.len()).flat_map(|scene| rungs.iter().map(move |rung| (scene, *rung)));
        all.enumerate().filter(|(index, _)| self.shard.has(*index)).map(|(_, task)| task).collect()
    }

    /// Number of settings that there are to do.
    pub fn wanted(&self) -> usize {
        self.tasks().len()
    }

    /// Measures, with `jobs` threads. What was done when `go_on` returned false is kept.
    pub fn run(&self, jobs: usize, go_on: GoOn, advanced: &(dyn Fn(Advance) + Sync)) -> Measured {
        let tasks = self.tasks();
        let needed = |scene: usize| tasks.iter().any(|task| task.0 == scene);
        let subjects = side_by_side(self.scenes.len(), jobs, |index| {
            let (key, scene) = &self.scenes[index];
            needed(index).then(|| self.subject(key, scene, go_on)).transpose()
        });
        let subjects: Vec<Option<(Subject, Yardstick)>> = subjects.into_iter().map(Option::flatten).collect();
        let progress = Progress::of(self, &tasks);
        let begun = side_by_side(tasks.len(), jobs, |index| {
            let (scene, rung) = tasks[index];
            let (subject, _) = subjects[scene].as_ref().ok_or(Interrupted)?;
            let setting = subject.begin(rung, self.timeout, go_on)?;
            advanced(progress.after(index));
            Ok(Mutex::new(setting))
        });
        // Turn about, so that a slow minute does not hit one method.
        loop {
            let wants = |setting: &&Mutex<Setting>| lock(setting).timings.wants_more();
            let open: Vec<usize> = (0..tasks.len())
                .filter(|&index| begun[index].as_ref().is_some_and(|setting| wants(&setting)))
                .collect();
            let round = side_by_side(open.len(), jobs, |place| {
                let (index, (scene, _)) = (open[place], tasks[open[place]]);
                let setting = begun[index].as_ref().ok_or(Interrupted)?;
                lock(setting).timings.add(&self.scenes[scene].1, go_on)
            });
            if open.is_empty() || round.iter().any(Option::is_none) {
                break;
            }
        }
        Measured {
            rows: begun.iter().flatten().map(|setting| lock(setting).row()).collect(),
            wanted: tasks.len(),
            yardsticks: subjects.into_iter().flatten().map(|(_, yardstick)| yardstick).collect(),
        }
    }

    fn subject(&self, key: &str, scene: &Scene, go_on: GoOn) -> Result<(Subject, Yardstick), Interrupted> {
        let subject = Subject::asking(key, scene.clone(), self.asked, go_on)?;
        let reference = &subject.reference;
        let price = cost(scene, reference.settings, reference.end, go_on)?;
        let yardstick = Yardstick {
            scene: key.into(),
            method: reference.settings.method,
            cpu_per_s: price.cpu_per_s,
            growth: reference.horizon.growth,
        };
        Ok((subject, yardstick))
    }
}

/// How far a sweep is, weighed by the steps of each setting.
struct Progress {
    weights: Vec<f64>,
    done: Mutex<(usize, f64)>,
}

impl Progress {
    fn of(sweep: &Sweep, tasks: &[(usize, Rung)]) -> Progress {
        let weight = |(scene, rung): &(usize, Rung)| {
            let scene = &sweep.scenes[*scene].1;
            (EVENTFUL + rung.dt.map_or(0.0, |dt| scene.duration / dt)) * scene.spheres.len() as f64
        };
        Progress { weights: tasks.iter().map(weight).collect(), done: Mutex::new((0, 0.0)) }
    }

    /// Where the sweep is after one more setting.
    fn after(&self, index: usize) -> Advance {
        let mut done = self.done.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        done.0 += 1;
        done.1 += self.weights[index];
        Advance { done: done.0, share: done.1 / self.weights.iter().sum::<f64>().max(f64::MIN_POSITIVE) }
    }
}

fn lock(setting: &Mutex<Setting>) -> std::sync::MutexGuard<'_, Setting> {
    setting.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}
