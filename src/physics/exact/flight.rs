//! Delayed states: a sphere's line (x, v at its own time) is rewritten only when something happens to it.
//!
//! Looking never rewrites a line, so that no display rate changes a bit of the trajectory; what a frame rewrote is kept
//! until the next one, so that a state within the frame can be read.

use glam::DVec3;

use crate::physics::State;
use crate::physics::contact_time::Path;
use crate::physics::model::{Model, Pull};

/// Where a sphere was at its own time: 64 bytes, one cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    /// Centre, m.
    pub(super) x: DVec3,
    /// Velocity, m/s.
    pub(super) v: DVec3,
    /// When, s.
    pub(super) t: f64,
    /// Radius, m.
    pub(super) r: f64,
}

/// A line that was rewritten in this frame.
#[derive(Debug, Clone, Copy)]
struct Past {
    sphere: u32,
    /// When it was replaced, s.
    until: f64,
    line: Line,
    acceleration: DVec3,
}

/// The lines of all spheres.
#[derive(Debug, Clone)]
pub(super) struct Flight {
    pub(super) lines: Vec<Line>,
    /// What accelerates every sphere alike, m/s², as long as `accelerations` is empty.
    common: DVec3,
    /// Acceleration of each, m/s²: in flight g + F/m, at rest what the supports leave of it. Empty until they differ.
    accelerations: Vec<DVec3>,
    past: Vec<Past>,
}

impl Flight {
    pub(super) fn new(model: &Model, state: &State) -> Flight {
        let line = |i: usize| Line { x: state.x[i], v: state.v[i], t: state.t, r: model.radii[i] };
        let (common, accelerations) = match model.pull {
            Pull::None => (DVec3::ZERO, Vec::new()),
            Pull::Uniform(g) => (g, Vec::new()),
            Pull::PerSphere => (DVec3::ZERO, model.accelerations.clone()),
        };
        Flight { lines: (0..model.len()).map(line).collect(), common, accelerations, past: Vec::new() }
    }

    /// Acceleration of sphere `i`, m/s².
    #[inline]
    pub(super) fn acceleration(&self, i: usize) -> DVec3 {
        if self.accelerations.is_empty() { self.common } else { self.accelerations[i] }
    }

    /// What accelerates every sphere alike, m/s²; none once they differ.
    #[inline]
    pub(super) fn common(&self) -> Option<DVec3> {
        self.accelerations.is_empty().then_some(self.common)
    }

    /// The path of sphere `i` from time `t` (s) on.
    #[inline]
    pub(super) fn path(&self, i: usize, t: f64) -> Path {
        let (line, a) = (&self.lines[i], self.acceleration(i));
        let dt = t - line.t;
        Path { x: line.x + (line.v + a * (0.5 * dt)) * dt, v: line.v + a * dt, a }
    }

    /// Rewrites the line of sphere `i`: from time `t` on it starts at `x` with `v`.
    #[inline]
    pub(super) fn rewrite(&mut self, i: usize, t: f64, x: DVec3, v: DVec3) {
        self.keep(i, t);
        self.lines[i] = Line { x, v, t, r: self.lines[i].r };
    }

    /// Brings the line of sphere `i` to time `t`, s.
    #[inline]
    pub(super) fn bring(&mut self, i: usize, t: f64) -> Path {
        let path = self.path(i, t);
        if self.lines[i].t != t {
            self.rewrite(i, t, path.x, path.v);
        }
        path
    }

    /// Gives sphere `i`, whose line is at the present, another acceleration, m/s².
    pub(super) fn accelerate(&mut self, i: usize, a: DVec3) {
        if a == self.acceleration(i) {
            return;
        }
        self.keep(i, self.lines[i].t);
        self.accelerations.resize(self.lines.len(), self.common);
        self.accelerations[i] = a;
    }

    /// From here on, frames before are forgotten.
    pub(super) fn forget(&mut self) {
        self.past.clear();
    }

    /// Every sphere's path from time `t` on, by the lines of now.
    pub(super) fn now(&self, t: f64) -> State {
        let paths = || (0..self.lines.len()).map(|i| self.path(i, t));
        State { t, x: paths().map(|p| p.x).collect(), v: paths().map(|p| p.v).collect() }
    }

    /// The state at a time `t` (s) of this frame, by the lines that held then.
    pub(super) fn then(&self, t: f64) -> State {
        let mut state = self.now(t);
        // latest first, so that the oldest line still in force at t is applied last
        for past in self.past.iter().rev().filter(|past| past.until > t) {
            let (i, a, dt) = (past.sphere as usize, past.acceleration, t - past.line.t);
            state.x[i] = past.line.x + (past.line.v + a * (0.5 * dt)) * dt;
            state.v[i] = past.line.v + a * dt;
        }
        state
    }

    fn keep(&mut self, i: usize, until: f64) {
        // a line replaced at its own time was never in force
        if self.lines[i].t == until {
            return;
        }
        let past = Past { sphere: i as u32, until, line: self.lines[i], acceleration: self.acceleration(i) };
        self.past.push(past);
    }
}
