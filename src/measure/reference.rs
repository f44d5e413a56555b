//! The yardstick: an `exact` run of a scene, kept at fixed instants, and the horizon up to which it means something.

use std::ops::ControlFlow;

use glam::DVec3;

use super::horizon::{self, Horizon};
use super::report::decimal;
use super::walk::{Budget, Cut, Impact, Instants, walk};
use super::{GoOn, Interrupted};
use crate::physics::{Method, Scene, Settings, Simulation, Tallies};

/// Who stands in where `exact` can't go on, if there is such a method, and its finest setting: (name, dt in s, tolerance).
const STAND_IN: (&str, f64, f64) = ("moreau", 1e-4, 1e-12);

/// A run of a scene to compare others with.
#[derive(Debug, Clone)]
pub struct Reference {
    /// What it was run with.
    pub settings: Settings,
    /// When it was read.
    pub instants: Instants,
    /// How far it got, s.
    pub end: f64,
    /// Its impacts up to `end`, in order.
    pub impacts: Vec<Impact>,
    /// What it counted.
    pub tallies: Tallies,
    /// Up to when positions mean something.
    pub horizon: Horizon,
    /// What speaks against trusting it, a phrase; empty if nothing does.
    pub doubt: String,
    positions: Vec<DVec3>,
    energies: Vec<f64>,
    spheres: usize,
}

/// What `exact` runs with as the reference: frames as long as the run, since they only say where to pause.
pub(super) fn settings(until: f64) -> Settings {
    Settings { method: Method::Exact, dt: until.max(f64::MIN_POSITIVE), tolerance: 0.0 }
}

impl Reference {
    /// Runs a scene to `until` (s) by `exact` and finds its horizon; by `moreau` at its finest where `exact` stalls or
    /// takes more than `budget` events, if that method gets farther.
    ///
    /// # Errors
    /// If `go_on` says no.
    pub fn of(scene: &Scene, until: f64, budget: Budget, go_on: GoOn) -> Result<Reference, Interrupted> {
        let (mut reference, cut) = Reference::by(scene, settings(until), until, budget, go_on)?;
        if let Some(cut) = cut {
            reference.doubt = format!("exact {} at {} s", describe(&cut), decimal(reference.end));
            let (name, dt, tolerance) = STAND_IN;
            if let Some(method) = Method::from_name(name) {
                let finest = Settings { method, dt, tolerance };
                let (stand_in, _) = Reference::by(scene, finest, until, Budget::UNLIMITED, go_on)?;
                if stand_in.end > reference.end {
                    let doubt = format!("reference is {name} dt {dt:e} because {}", reference.doubt);
                    reference = Reference { doubt, ..stand_in };
                }
            }
        }
        reference.horizon = horizon::of(scene, &reference, budget, go_on)?;
        Ok(reference)
    }

    /// The same by `exact` alone, up to `until` (s) or as far as `budget` events take it.
    ///
    /// # Errors
    /// If `go_on` says no.
    pub fn brief(scene: &Scene, until: f64, budget: Budget, go_on: GoOn) -> Result<Reference, Interrupted> {
        let (mut reference, _) = Reference::by(scene, settings(until), until, budget, go_on)?;
        reference.horizon = horizon::of(scene, &reference, budget, go_on)?;
        Ok(reference)
    }

    fn by(
        scene: &Scene,
        settings: Settings,
        until: f64,
        budget: Budget,
        go_on: GoOn,
    ) -> Result<(Reference, Option<Cut>), Interrupted> {
        let mut simulation = Simulation::new(scene, settings);
        let model = simulation.model().clone();
        let instants = Instants::new(until, model.len());
        let (mut positions, mut energies) = (Vec::new(), Vec::new());
        let walked = walk(&mut simulation, instants, budget, go_on, |_, state| {
            positions.extend_from_slice(&state.x);
            energies.push(state.energy(&model));
            ControlFlow::Continue(())
        })?;
        let reference = Reference {
            settings,
            instants,
            end: walked.end,
            impacts: walked.impacts,
            tallies: walked.tallies,
            horizon: Horizon::unknown(),
            doubt: String::new(),
            positions,
            energies,
            spheres: model.len(),
        };
        Ok((reference, walked.cut))
    }

    /// Where the spheres are at instant `k`, m by index; none beyond the reference's end.
    pub fn positions(&self, k: usize) -> Option<&[DVec3]> {
        let whole = k < self.energies.len();
        if whole { self.positions.get(k * self.spheres..(k + 1) * self.spheres) } else { None }
    }

    /// Energy at the last instant not after `t` (s), J.
    pub fn energy(&self, t: f64) -> f64 {
        let k = (0..self.energies.len()).rev().find(|&k| self.instants.at(k) <= t).unwrap_or(0);
        self.energies.get(k).copied().unwrap_or(0.0)
    }

    /// The largest |energy| on the way, J: what energy errors are relative to.
    pub fn energy_scale(&self) -> f64 {
        self.energies.iter().fold(0.0, |largest: f64, energy| largest.max(energy.abs()))
    }

    /// Until when positions can be compared, s: the horizon, or how far the reference got.
    pub fn meaningful(&self) -> f64 {
        self.horizon.time.map_or(self.end, |horizon| horizon.min(self.end))
    }
}

fn describe(cut: &Cut) -> String {
    match cut {
        Cut::Stalled(stall) => format!("stalls ({})", stall.kind),
        Cut::Spent => "passes its budget".into(),
        Cut::Enough => "was stopped".into(),
    }
}
