//! Crowds of many seeds and settings side by side, or in parts that are joined: the same table either way.

use std::collections::BTreeMap;
use std::fmt;

use super::crowd::{Crowd, Ran, Stopped, crowd_run};
use super::interrupt::GoOn;
use super::ladder::Rung;
use super::sample::Budget;
use super::shard::Shard;
use super::side_by_side::side_by_side;
use crate::export::CrowdRun;
use crate::scene::{Method, Scene};

/// What is run of each scene.
#[derive(Debug, Clone, PartialEq)]
pub struct CrowdPlan {
    /// Settings, in their order.
    pub rungs: Vec<Rung>,
    /// Runs of each setting.
    pub seeds: u64,
    /// Budget of a run.
    pub budget: Budget,
    /// The part of the runs that is made.
    pub shard: Shard,
    /// Runs side by side.
    pub jobs: usize,
}

/// The crowds of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneCrowds {
    /// The scene's key.
    pub key: String,
    /// The scene's duration, s.
    pub until: f64,
    /// Runs of each setting that were planned.
    pub seeds: u64,
    /// Crowds, one for each setting: by method in the program's order, then coarse to fine.
    pub crowds: Vec<Crowd>,
}

/// A run and where it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedRun {
    /// `file:line`; empty if the run was read from no file.
    pub place: String,
    /// The run.
    pub run: CrowdRun,
}

impl CrowdPlan {
    /// The runs of a scene that are made: setting by setting, seed by seed.
    fn tasks(&self) -> Vec<usize> {
        (0..self.rungs.len() * self.seeds as usize).filter(|task| self.shard.has(*task)).collect()
    }

    /// Number of runs of a scene that are made.
    pub fn runs(&self) -> usize {
        self.tasks().len()
    }
}

/// Runs each setting from so many seeds, or a part of that; `done` is called after each run, on its thread. If `go_on`
/// returned false, the runs that were complete by then.
pub fn crowd_runs(
    (key, scene): (&str, &Scene),
    plan: &CrowdPlan,
    go_on: GoOn,
    done: &(dyn Fn() + Sync),
) -> Vec<CrowdRun> {
    let (seeds, tasks) = (plan.seeds as usize, plan.tasks());
    let runs = side_by_side(tasks.len(), plan.jobs, |index| {
        let (rung, seed) = (plan.rungs[tasks[index] / seeds], (tasks[index] % seeds) as u64 + 1);
        let ran = crowd_run(scene, rung, (seed, plan.budget), go_on)?;
        done();
        Ok(CrowdRun {
            scene: key.into(),
            until: scene.duration,
            method: rung.method.name().into(),
            dt: rung.dt,
            tolerance: rung.tolerance,
            seed,
            seeds: plan.seeds,
            reached: ran.reached,
            stopped: ran.stopped.map_or("", word).into(),
            figures: ran.figures,
        })
    });
    runs.into_iter().flatten().collect()
}

/// Runs each setting from so many seeds and gathers the means. None if `go_on` returned false.
pub fn crowds(scene: &Scene, plan: &CrowdPlan, go_on: GoOn) -> Option<Vec<Crowd>> {
    let runs = crowd_runs(("", scene), plan, go_on, &|| ());
    if runs.len() < plan.runs() {
        return None;
    }
    let placed = runs.into_iter().map(|run| PlacedRun { place: String::new(), run });
    gather(placed).ok().map(|scenes| scenes.into_iter().flat_map(|scene| scene.crowds).collect())
}

fn word(stopped: Stopped) -> &'static str {
    match stopped {
        Stopped::Stalled => "stalled",
        Stopped::Spent => "spent",
    }
}

/// Gathers runs, in whatever order they come, by scene and setting.
///
/// # Errors
/// An unknown method or reason to stop, a run that comes twice, parts of plans that differ in duration or in their number
/// of seeds.
pub fn gather(runs: impl IntoIterator<Item = PlacedRun>) -> Result<Vec<SceneCrowds>, GatherError> {
    let mut scenes: Vec<Gathered> = Vec::new();
    for PlacedRun { place, run } in runs {
        let refuse = |what: String| Err(GatherError { place: place.clone(), what });
        let Some((key, rung, ran)) = read(&run) else {
            return refuse(format!("no method {:?} stops with {:?}", run.method, run.stopped));
        };
        let index = scenes.iter().position(|scene| scene.key == run.scene).unwrap_or_else(|| {
            scenes.push(Gathered::of(&run));
            scenes.len() - 1
        });
        let scene = &mut scenes[index];
        if (scene.until.to_bits(), scene.seeds) != (run.until.to_bits(), run.seeds) {
            return refuse(format!("{} with its duration and seeds differs from the run read first", run.scene));
        }
        let runs = &mut scene.settings.entry(key).or_insert_with(|| (rung, BTreeMap::new())).1;
        if let Some((before, _)) = runs.insert(run.seed, (place.clone(), ran)) {
            return refuse(format!("this run is in {before} already"));
        }
    }
    Ok(scenes.into_iter().map(Gathered::close).collect())
}

/// Where a setting belongs: methods in the program's order, then coarse to fine. All numbers are ≥ 0, whose bits are in the
/// order of their values.
type Place = (usize, u64, u64);

/// Runs by seed, each with its place.
type Seeds = BTreeMap<u64, (String, Ran)>;

/// The runs of a scene by setting and seed.
struct Gathered {
    key: String,
    until: f64,
    seeds: u64,
    settings: BTreeMap<Place, (Rung, Seeds)>,
}

impl Gathered {
    fn of(run: &CrowdRun) -> Gathered {
        Gathered { key: run.scene.clone(), until: run.until, seeds: run.seeds, settings: BTreeMap::new() }
    }

    fn close(self) -> SceneCrowds {
        let of =
            |(rung, runs): (Rung, Seeds)| Crowd::of(rung, &runs.into_values().map(|(_, ran)| ran).collect::<Vec<_>>());
        let crowds = self.settings.into_values().map(of).collect();
        SceneCrowds { key: self.key, until: self.until, seeds: self.seeds, crowds }
    }
}

/// What a row says: where its setting belongs, the setting, the run.
fn read(run: &CrowdRun) -> Option<(Place, Rung, Ran)> {
    let method = Method::ALL.iter().position(|method| method.name() == run.method)?;
    let stopped = match run.stopped.as_str() {
        "" => None,
        "stalled" => Some(Stopped::Stalled),
        "spent" => Some(Stopped::Spent),
        _ => return None,
    };
    let coarse_first = |value: Option<f64>| u64::MAX - value.map_or(0, f64::to_bits);
    let rung = Rung { method: Method::ALL[method], dt: run.dt, tolerance: run.tolerance };
    let place = (method, coarse_first(run.dt), coarse_first(run.tolerance));
    Some((place, rung, Ran { reached: run.reached, stopped, figures: run.figures }))
}

/// Why runs do not make crowds. Displays as a sentence that begins with the place, `file:line`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GatherError {
    place: String,
    what: String,
}

impl fmt::Display for GatherError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.what)
    }
}

impl std::error::Error for GatherError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::FIGURES;

    fn run(seed: u64) -> PlacedRun {
        let run = CrowdRun {
            scene: "heap".into(),
            until: 2.0,
            method: "moreau".into(),
            dt: Some(1e-2),
            tolerance: Some(1e-6),
            seed,
            seeds: 3,
            reached: 2.0,
            stopped: String::new(),
            figures: [Some(seed as f64 * 0.1); FIGURES.len()],
        };
        PlacedRun { place: format!("part.csv:{}", seed + 1), run }
    }

    #[test]
    fn the_order_of_runs_changes_no_bit() {
        let forward = gather([run(1), run(2), run(3)]).expect("runs");
        assert_eq!(gather([run(3), run(1), run(2)]), Ok(forward.clone()));
        assert_eq!((forward[0].crowds[0].finished, forward[0].crowds[0].reached), ((3, 3), (2.0, 2.0)));
    }

    #[test]
    fn runs_that_do_not_belong_together_are_refused_with_their_place() {
        let with = |change: fn(&mut CrowdRun)| {
            let mut other = run(2);
            change(&mut other.run);
            gather([run(1), other]).expect_err("a refusal").to_string()
        };
        for (error, word) in [
            (with(|run| run.seed = 1), "in part.csv:2 already"),
            (with(|run| run.method = "euler".into()), "euler"),
            (with(|run| run.stopped = "tired".into()), "tired"),
            (with(|run| run.until = 3.0), "differs"),
            (with(|run| run.seeds = 4), "differs"),
        ] {
            assert!(error.starts_with("part.csv:3: ") && error.contains(word), "{error}");
        }
    }
}
