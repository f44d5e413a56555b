//! One scene by one engine: what both have in common, so that they are driven and judged alike.

use carom::physics::{Method, Progress, Scene, Settings, Simulation, Until};
use glam::DVec3;

use crate::peer::{Tuning, World};

/// An engine with its settings.
#[derive(Debug, Clone, Copy)]
pub enum Entrant {
    /// This project.
    Carom(Settings),
    /// `rapier3d-f64`.
    Rapier(Tuning),
}

/// A scene under way.
pub enum Run {
    /// By Carom.
    Carom(Box<Simulation>),
    /// By rapier.
    Rapier(Box<World>),
}

impl Entrant {
    /// The engine's name.
    pub fn engine(&self) -> &'static str {
        match self {
            Entrant::Carom(_) => "carom",
            Entrant::Rapier(_) => "rapier3d-f64",
        }
    }

    /// The settings that matter, in words without a comma.
    pub fn settings(&self) -> String {
        match self {
            Entrant::Carom(Settings { method: Method::Exact, .. }) => "exact".into(),
            Entrant::Carom(Settings { method: Method::Swept, tolerance, .. }) => format!("swept tol {tolerance:.0e}"),
            Entrant::Carom(Settings { method, dt, tolerance }) => {
                format!("{} dt 1/{:.0} tol {tolerance:.0e}", method.name(), 1.0 / dt)
            }
            Entrant::Rapier(tuning) => tuning.to_string(),
        }
    }

    /// Frames or steps in a second: how often its state is looked at.
    pub fn rate(&self) -> f64 {
        match self {
            Entrant::Carom(settings) => 1.0 / settings.dt,
            Entrant::Rapier(tuning) => f64::from(tuning.rate),
        }
    }

    /// The scene by this engine, at t = 0.
    pub fn begin(&self, scene: &Scene) -> Run {
        match self {
            Entrant::Carom(settings) => Run::Carom(Box::new(Simulation::new(scene, *settings))),
            Entrant::Rapier(tuning) => Run::Rapier(Box::new(World::new(scene, *tuning))),
        }
    }
}

impl Run {
    /// Goes on for one frame, which ends at `t` (s).
    pub fn advance(&mut self, t: f64) {
        match self {
            Run::Carom(run) => {
                // `exact` and `swept` end their frames at events; `moreau` has steps of one length
                let until = if run.settings().method == Method::Moreau { Until::Frame } else { Until::Time(t) };
                assert_eq!(run.advance(until, u64::MAX), Progress::Reached, "a run stalled");
            }
            Run::Rapier(world) => world.step(),
        }
    }

    /// Centres (m) and velocities (m/s) by sphere at the end `t` (s) of the frame.
    pub fn state(&self, t: f64) -> (Vec<DVec3>, Vec<DVec3>) {
        match self {
            Run::Carom(run) => {
                let state = if run.settings().method == Method::Moreau { run.state() } else { run.at(t) };
                (state.x, state.v)
            }
            Run::Rapier(world) => world.state(),
        }
    }

    /// Impacts so far, where the engine counts them: a time-stepping engine has contacts, not impacts.
    pub fn impacts(&self) -> Option<u64> {
        match self {
            Run::Carom(run) if run.settings().method != Method::Moreau => Some(run.tallies().impacts),
            _ => None,
        }
    }
}
