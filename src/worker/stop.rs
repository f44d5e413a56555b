//! Until when a run goes on: what is waited for, and how it is known when it comes.

use glam::DVec3;

use super::course::Course;
use crate::{
    physics::{Class, Contact, Kind, Simulation},
    snapshot::Stage,
};

/// What a run goes on until, as fast as possible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stop {
    /// An event of these bodies: an impact, the beginning of a rest, or its end.
    Event(Class, Bodies),
    /// A sphere's centre leaves the box around all walls; without walls, the scene's view.
    Exit,
    /// A frame ends at or after this time, s.
    Time(f64),
    /// A sphere is faster than this at the end of a frame, m/s.
    Speed(f64),
    /// A contact of a frame overlaps by more than this, dimensionless.
    Degree(f64),
    /// The energy differs from the initial one by more than this share of it; by this, J, where that is 0.
    Energy(f64),
}

/// The bodies of an event that is waited for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bodies {
    /// Any bodies.
    Any,
    /// One sphere, with any other body.
    Sphere(usize),
    /// A sphere and a wall.
    Wall(usize, usize),
    /// Two spheres.
    Pair(usize, usize),
}

impl Bodies {
    /// Whether a contact is between these bodies.
    fn are(self, contact: &Contact) -> bool {
        let Contact { kind, a, b, .. } = *contact;
        match self {
            Bodies::Any => true,
            Bodies::Sphere(i) => a == i || kind == Kind::Pair && b == i,
            Bodies::Wall(i, wall) => (kind, a, b) == (Kind::Wall, i, wall),
            Bodies::Pair(i, j) => (kind, a, b) == (Kind::Pair, i.min(j), i.max(j)),
        }
    }
}

/// What has come to pass of what was waited for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Met {
    /// An event has happened.
    Event(Contact),
    /// A sphere has left the box.
    Exit(usize),
    /// The time has come.
    Time,
    /// A sphere is as fast as this, m/s.
    Speed(usize, f64),
    /// A contact overlaps by more than was waited for.
    Degree(Contact),
    /// The energy differs by this share of the initial one; by this, J, where that is 0.
    Energy(f64),
}

/// A search under way.
#[derive(Debug)]
pub(super) struct Search {
    pub(super) stop: Stop,
    /// The frame and the time (s) at which it began.
    pub(super) from: (u64, f64),
    /// Time after which the search is given up, s.
    pub(super) within: f64,
    /// Whether the search began before the newest frame.
    pub(super) in_the_past: bool,
    /// Spheres that were outside in the last frame, if that matters.
    outside: Vec<bool>,
    bounds: [DVec3; 2],
}

impl Search {
    /// A search from a run at the end of a frame, given up after the scene's duration, unless a time is waited for.
    pub(super) fn new(stop: Stop, course: &Course) -> Search {
        let (run, stage) = (course.simulation(), &course.job().stage);
        let (frame, t) = (run.tallies().frames, run.time());
        let within = if matches!(stop, Stop::Time(_)) { f64::INFINITY } else { stage.duration };
        let (outside, bounds) = (Vec::new(), room(stage));
        let mut search = Search { stop, from: (frame, t), within, in_the_past: course.is_past(), outside, bounds };
        if stop == Stop::Exit {
            search.outside = search.outside(run);
        }
        search
    }

    fn outside(&self, run: &Simulation) -> Vec<bool> {
        let [min, max] = self.bounds;
        run.state().x.iter().map(|x| x.cmplt(min).any() || x.cmpgt(max).any()).collect()
    }

    /// What has come to pass with the frame that has just ended, in which `events` happened; none if what is waited for has
    /// not.
    pub(super) fn met(&mut self, run: &Simulation, events: &[Contact]) -> Option<Met> {
        match self.stop {
            Stop::Event(class, bodies) => {
                events.iter().find(|event| event.class == class && bodies.are(event)).copied().map(Met::Event)
            }
            Stop::Exit => {
                let outside = self.outside(run);
                let before = std::mem::replace(&mut self.outside, outside);
                self.outside.iter().zip(before).position(|(now, before)| *now && !before).map(Met::Exit)
            }
            Stop::Time(t) => (run.time() >= t).then_some(Met::Time),
            Stop::Speed(least) => {
                let speeds = run.state().v.into_iter().map(DVec3::length).enumerate();
                let (i, fastest) = speeds.fold((0, 0.0), |best, next| if next.1 > best.1 { next } else { best });
                (fastest > least).then_some(Met::Speed(i, fastest))
            }
            Stop::Degree(least) => {
                run.contacts().iter().find(|contact| contact.degree > least).copied().map(Met::Degree)
            }
            Stop::Energy(least) => {
                let initial = run.initial_energy();
                let off = (run.energy() - initial) / if initial == 0.0 { 1.0 } else { initial.abs() };
                (off.abs() > least).then_some(Met::Energy(off))
            }
        }
    }
}

/// The corners of the box around all walls, m; of the scene's view if there are none.
fn room(stage: &Stage) -> [DVec3; 2] {
    let corners = || stage.walls.iter().flat_map(|(corners, _)| corners.iter().copied());
    match (corners().reduce(DVec3::min), corners().reduce(DVec3::max)) {
        (Some(min), Some(max)) => [min, max],
        _ => [stage.view.min, stage.view.max],
    }
}
