//! A crowd judged beyond the horizon, where places mean nothing any longer: means over many runs that begin a hair's breadth
//! aside, which any right method must share.

use glam::DVec3;

use super::displaced::aside;
use super::interrupt::{GoOn, Interrupted};
use super::ladder::Rung;
use super::sample::run_through;
use crate::physics::{Class, Effect, Kind, Progress, Simulation, State, Until, knobs};
use crate::scene::Scene;

/// How far each sphere is displaced, as a part of the smallest radius: no figure sees it, and every collision enlarges it.
const ASIDE: f64 = 1e-9;

/// Part of the run, at its end, over which the load on the walls is taken.
const WINDOW: f64 = 0.2;

/// What lies apart by less than this part of its reach counts as a contact.
const TOUCHES: f64 = 1e-3;

/// Settled is a crowd whose kinetic energy stays below this part of the largest.
const SETTLED: f64 = 1e-3;

/// Instants at which energy is read.
const INSTANTS: usize = 200;

/// Means that differ by less than this part of themselves are the same: what rounding leaves of a sum.
const SAME: f64 = 1e-9;

/// Standard errors by which means may differ.
const ERRORS: f64 = 3.0;

/// What is measured, and in which unit.
pub const FIGURES: [(&str, &str); 11] = [
    ("energy at a quarter", "J"),
    ("energy at half", "J"),
    ("energy at the end", "J"),
    ("load on walls / weight", ""),
    ("contacts of a sphere", ""),
    ("packing", ""),
    ("height of the lowest tenth", "m"),
    ("median height", "m"),
    ("height of the highest tenth", "m"),
    ("settled after", "s"),
    ("gap × force at rest", "J"),
];

/// The figures of one run, in the order of [`FIGURES`]; none where there is no such figure.
type Figures = [Option<f64>; FIGURES.len()];

/// A mean over runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// Mean of the runs that have the figure.
    pub mean: f64,
    /// Its standard error; 0 of one run.
    pub error: f64,
    /// How many runs have it.
    pub runs: usize,
}

/// One setting's means.
#[derive(Debug, Clone, PartialEq)]
pub struct Crowd {
    /// Which setting.
    pub rung: Rung,
    /// Runs that came to the end, of those begun.
    pub finished: (usize, usize),
    /// In the order of [`FIGURES`].
    pub means: Vec<Option<Mean>>,
}

impl Mean {
    fn of(values: &[f64]) -> Option<Mean> {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        let error = if values.len() > 1 { (squares / (n - 1.0) / n).sqrt() } else { 0.0 };
        (!values.is_empty()).then_some(Mean { mean, error, runs: values.len() })
    }

    /// Whether two means differ by no more than three standard errors, or rounding.
    pub fn agrees(&self, other: &Mean) -> bool {
        let apart = (self.mean - other.mean).abs();
        let errors = (self.error * self.error + other.error * other.error).sqrt();
        apart <= ERRORS * errors + SAME * (self.mean.abs() + other.mean.abs())
    }
}

impl Crowd {
    /// The means of a setting's runs; a run that did not come to its end is none.
    pub fn of(rung: Rung, runs: &[Option<Figures>]) -> Crowd {
        let done: Vec<&Figures> = runs.iter().flatten().collect();
        let mean = |k: usize| Mean::of(&done.iter().filter_map(|figures| figures[k]).collect::<Vec<_>>());
        Crowd { rung, finished: (done.len(), runs.len()), means: (0..FIGURES.len()).map(mean).collect() }
    }
}

/// One run of a setting, displaced by a seed; none if it stalls or takes more than `timeout` (s of processor time).
///
/// # Errors
/// If `go_on` returns false.
pub fn crowd_run(
    scene: &Scene,
    rung: Rung,
    (seed, timeout): (u64, f64),
    go_on: GoOn,
) -> Result<Option<Figures>, Interrupted> {
    let smallest = scene.spheres.iter().map(|sphere| sphere.radius).fold(f64::INFINITY, f64::min);
    let scene = aside(scene, seed, ASIDE * smallest);
    let until = scene.duration;
    let mut settings = rung.settings(until);
    if knobs(rung.method).dt != Effect::Error {
        // frames only say where to pause: they must be short enough for the window
        settings.dt = settings.dt.min(until / INSTANTS as f64);
    }
    let mut run = Simulation::new(&scene, settings);
    let watch = super::clock::Watch::start();
    let (mut energies, mut kinetic) = (Vec::new(), Vec::new());
    let (mut load, mut since) = (0.0, 0.0);
    for k in 0..=INSTANTS {
        let time = k as f64 * until / INSTANTS as f64;
        if time > until * (1.0 - WINDOW) {
            load += match carry(&mut run, time, go_on)? {
                Some(load) => load,
                None => return Ok(None),
            };
        } else if run_through(&mut run, time, go_on)? {
            since = run.time(); // the end of a frame, which may be later than was asked for
        } else {
            return Ok(None);
        }
        if watch.cpu() > timeout {
            return Ok(None);
        }
        let state = run.at(time);
        energies.push(state.energy(run.model()));
        kinetic.push(moving(&run, &state));
    }
    Ok(Some(figures(&run, until, [&energies, &kinetic], load / (run.time() - since))))
}

/// Kinetic energy, J.
fn moving(run: &Simulation, state: &State) -> f64 {
    state.v.iter().zip(&run.model().masses).map(|(v, m)| 0.5 * m * v.length_squared()).sum()
}

/// Runs to `time` (s) frame by frame; what the walls gave against gravity, N s. None if it stalls.
fn carry(run: &mut Simulation, time: f64, go_on: GoOn) -> Result<Option<f64>, Interrupted> {
    let up = -pull(run).normalize_or_zero();
    let mut given = 0.0;
    while run.time() < time {
        if !go_on() {
            return Err(Interrupted);
        }
        match run.advance(Until::Frame, Simulation::SLICE) {
            Progress::Yielded => {}
            Progress::Stalled(_) => return Ok(None),
            Progress::Reached => {
                let walls = run.contacts().iter().filter(|row| row.kind == Kind::Wall && row.class != Class::Leave);
                given += walls.map(|row| row.impulse * row.normal.dot(up)).sum::<f64>();
            }
        }
    }
    Ok(Some(given))
}

/// Σ of all constant forces, N.
fn pull(run: &Simulation) -> DVec3 {
    let model = run.model();
    (0..model.len()).map(|i| model.acceleration(i) * model.masses[i]).sum()
}

/// The figures of a run at its end; `load` is what the walls gave against gravity, N.
fn figures(run: &Simulation, until: f64, [energies, kinetic]: [&[f64]; 2], load: f64) -> Figures {
    let model = run.model();
    let state = run.at(until);
    let weight = pull(run);
    let up = if weight == DVec3::ZERO { DVec3::Y } else { -weight.normalize() };
    let mut heights: Vec<f64> = state.x.iter().map(|x| x.dot(up)).collect();
    heights.sort_by(f64::total_cmp);
    let height = |part: f64| heights.get((part * heights.len() as f64) as usize).copied();
    let most = kinetic.iter().copied().fold(0.0, f64::max);
    let moves = kinetic.iter().rposition(|energy| *energy > SETTLED * most);
    let settled = moves.filter(|last| last + 1 < kinetic.len()).map(|last| (last + 1) as f64 * until / INSTANTS as f64);
    let rest = run.contacts().iter().filter(|row| row.class == Class::Rest && run.step() > 0.0);
    let product = rest.map(|row| {
        let reach = model.radii[row.a] + if row.kind == Kind::Pair { model.radii[row.b] } else { 0.0 };
        (row.degree * reach * row.impulse / run.step()).abs()
    });
    [
        energies.get(INSTANTS / 4).copied(),
        energies.get(INSTANTS / 2).copied(),
        energies.last().copied(),
        (weight != DVec3::ZERO).then(|| load / weight.length()),
        Some(contacts(run, &state)),
        Some(packing(run, &state)),
        height(0.1),
        height(0.5),
        height(0.9),
        settled,
        product.fold(None, |most: Option<f64>, value| Some(most.unwrap_or(0.0).max(value))),
    ]
}

/// Mean number of bodies that touch a sphere.
fn contacts(run: &Simulation, state: &State) -> f64 {
    let model = run.model();
    let n = model.len();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| state.x[a].x.total_cmp(&state.x[b].x));
    let widest = model.radii.iter().copied().fold(0.0, f64::max);
    let mut count = 0_usize;
    for (place, &a) in order.iter().enumerate() {
        let near = state.x[a].x + (model.radii[a] + widest) * (1.0 + TOUCHES);
        let after = order[place + 1..].iter().take_while(|&&b| state.x[b].x <= near);
        let touch = |b: &&usize| {
            let reach = model.radii[a] + model.radii[**b];
            state.x[a].distance(state.x[**b]) <= reach * (1.0 + TOUCHES)
        };
        count += 2 * after.filter(touch).count();
        let reach = model.radii[a] * (1.0 + TOUCHES);
        count += model.faces.iter().filter(|face| face.shape.distance(state.x[a]) <= reach).count();
    }
    count as f64 / n.max(1) as f64
}

/// The spheres' volume over that of the box around them.
fn packing(run: &Simulation, state: &State) -> f64 {
    let radii = &run.model().radii;
    let around = |sign: f64| {
        let edge = |(x, r): (&DVec3, &f64)| *x * sign + DVec3::splat(*r);
        state.x.iter().zip(radii).map(edge).fold(DVec3::NEG_INFINITY, DVec3::max)
    };
    let size = around(1.0) + around(-1.0);
    let volume: f64 = radii.iter().map(|r| 4.0 / 3.0 * std::f64::consts::PI * r * r * r).sum();
    volume / (size.x * size.y * size.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_have_their_standard_error_and_agree_within_three_of_it() {
        let mean = Mean::of(&[1.0, 2.0, 3.0, 4.0]).expect("values");
        // Variance 5/3, over four runs.
        assert_eq!((mean.mean, mean.runs), (2.5, 4));
        assert!((mean.error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
        let at = |value: f64| Mean { mean: value, error: 0.0, runs: 1 };
        assert!(mean.agrees(&at(2.5 + 2.9 * mean.error)) && !mean.agrees(&at(2.5 + 3.1 * mean.error)));
        assert!(at(1.0).agrees(&at(1.0 + 1e-12)) && !at(1.0).agrees(&at(1.0 + 1e-6)));
        assert_eq!(Mean::of(&[]), None);
    }
}
