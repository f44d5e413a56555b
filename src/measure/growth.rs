//! The horizon of a scene as a run meets it: displaced runs taken along, a slice at a time.

use super::displaced::{Parting, RUNS, displaced};
use super::reference::settings;
use super::sample::Instants;
use crate::physics::{Progress, Simulation, Until};
use crate::scene::Scene;

/// More spheres than this get one displaced run instead of eight: there is memory for two runs, and in a crowd each
/// displacement grows alike.
const CROWD: usize = 1000;

/// Exact runs of a scene, the first as it is and the others displaced by 1e-12 m, watched for their parting.
#[derive(Debug, Clone)]
pub struct Growth {
    /// The runs; the first is the scene as it is.
    runs: Vec<Simulation>,
    /// How far each of the others has parted from the first.
    partings: Vec<Parting>,
    instants: Instants,
    /// The instant that comes next, counted as those of [`Instants`], but without end.
    next: u64,
    found: Option<f64>,
}

impl Growth {
    /// The runs of a scene at t = 0.
    pub fn of(scene: &Scene) -> Growth {
        let instants = Instants::new(scene.duration.max(f64::MIN_POSITIVE), scene.spheres.len());
        let settings = settings(instants.until);
        let seeds = if scene.spheres.len() > CROWD { 1..=1 } else { 1..=RUNS };
        let (aside, partings): (Vec<_>, Vec<_>) = seeds.map(|seed| displaced(scene, settings, seed)).unzip();
        let runs = std::iter::once(Simulation::new(scene, settings)).chain(aside).collect();
        Growth { runs, partings, instants, next: 1, found: None }
    }

    /// The horizon, s, once it is met.
    pub fn horizon(&self) -> Option<f64> {
        self.found
    }

    /// Whether there is anything left to find out up to `t`, s.
    pub fn is_behind(&self, t: f64) -> bool {
        self.found.is_none() && self.instant() <= t
    }

    /// Takes every run about `work` units (events) further, or to the next instant, where they are compared.
    pub fn advance(&mut self, work: u64) {
        let instant = self.instant();
        let mut there = true;
        for run in &mut self.runs {
            match run.advance(Until::Time(instant), work) {
                Progress::Reached => {}
                Progress::Yielded => there = false,
                // Beyond the end of one of them, positions cannot be trusted.
                Progress::Stalled(stall) => self.found = Some(stall.time),
            }
        }
        if there && self.found.is_none() {
            self.compare(instant);
        }
        if self.found.is_some() {
            self.runs.clear();
        }
    }

    fn compare(&mut self, instant: f64) {
        self.next += 1;
        let states: Vec<_> = self.runs.iter().map(|run| run.at(instant)).collect();
        let Some((first, others)) = states.split_first() else { return };
        let mut pairs = self.partings.iter_mut().zip(others);
        if pairs.any(|(parting, other)| parting.compare(&other.x, &first.x)) {
            self.found = Some(instant);
        }
    }

    /// The instant that comes next, s.
    fn instant(&self) -> f64 {
        self.next as f64 * (self.instants.until / self.instants.count as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    fn horizon(name: &str, until: f64) -> Option<f64> {
        let scene = scene::open(name).expect("built in").scene;
        let mut growth = Growth::of(&scene);
        while growth.is_behind(until) {
            growth.advance(100);
        }
        growth.horizon()
    }

    #[test]
    fn paper_0_has_no_horizon_and_paper_3_has_one_between_7_and_11_seconds() {
        // The prototype of the plan: a displacement grows by 1 and by 2e8 within 20 s.
        assert_eq!(horizon("paper-0", 20.0), None);
        assert!((7.0..11.0).contains(&horizon("paper-3", 20.0).expect("it parts")));
    }
}
