//! A run of a scene to compare others with, kept at fixed instants.

use std::ops::ControlFlow;

use glam::DVec3;

use super::interrupt::{GoOn, Interrupted};
use super::sample::{Budget, EndReason, Impact, Instants, sample};
use crate::physics::{Simulation, Tallies};
use crate::scene::{Method, Scene, Settings};

/// A run of a scene to compare others with.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Settings of the run.
    pub settings: Settings,
    /// Instants at which the run was read.
    pub instants: Instants,
    /// Time that the run reached, s.
    pub end: f64,
    /// Impacts up to `end`, in order.
    pub impacts: Vec<Impact>,
    /// Counted work and outcomes of the run.
    pub tallies: Tallies,
    /// Time up to which positions can be compared with others.
    pub horizon: Horizon,
    /// What is known of the reference's own error; none if it is not certified.
    pub own: Option<OwnError>,
    /// A reason to doubt the reference, a phrase; empty if there is none.
    pub doubt: String,
    positions: Vec<DVec3>,
    energies: Vec<f64>,
    spheres: usize,
}

/// Up to when a reference means something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Horizon {
    /// The time at which the worst displaced run has grown by 1e6, s; none if none has up to the reference's end.
    pub time: Option<f64>,
    /// The largest growth of a displacement up to there, dimensionless.
    pub growth: f64,
}

/// How far a reference itself is off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OwnError {
    /// Time up to which the error is known to be within what is asked, s.
    pub until: f64,
    /// The largest distance of a sphere from where it should be, up to then, m.
    pub error: f64,
}

impl Horizon {
    /// The horizon before any displaced run.
    pub(super) fn unknown() -> Horizon {
        Horizon { time: None, growth: 1.0 }
    }
}

/// What `exact` runs with as the reference: frames as long as the run, since they only say where to pause.
pub(super) fn settings(until: f64) -> Settings {
    Settings { method: Method::Exact, dt: until.max(f64::MIN_POSITIVE), tolerance: 0.0 }
}

impl Reference {
    /// The run itself by `settings` up to `until` (s), its horizon not yet known; and why it ended before, if it did.
    ///
    /// # Errors
    /// If `go_on` returns false.
    pub(super) fn by(
        scene: &Scene,
        settings: Settings,
        until: f64,
        budget: Budget,
        go_on: GoOn,
    ) -> Result<(Reference, Option<EndReason>), Interrupted> {
        let mut simulation = Simulation::new(scene, settings);
        let model = simulation.model().clone();
        let instants = Instants::new(until, model.len());
        let (mut positions, mut energies) = (Vec::new(), Vec::new());
        let sampled = sample(&mut simulation, instants, budget, go_on, |_, state| {
            positions.extend_from_slice(&state.x);
            energies.push(state.energy(&model));
            ControlFlow::Continue(())
        })?;
        let reference = Reference {
            settings,
            instants,
            end: sampled.end,
            impacts: sampled.impacts,
            tallies: sampled.tallies,
            horizon: Horizon::unknown(),
            own: None,
            doubt: String::new(),
            positions,
            energies,
            spheres: model.len(),
        };
        Ok((reference, sampled.end_reason))
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
