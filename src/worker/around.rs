//! What was shortly before the frame that is shown, and what comes next of a sphere: asked for, or it costs nothing.

use std::{collections::VecDeque, sync::Arc};

use glam::DVec3;

use super::course::Course;
use crate::{
    physics::{Class, Contact, Kind, Progress, Simulation, Until},
    scene::Settings,
    snapshot::Ahead,
};

/// Memory for where all spheres were, bytes.
const TRAIL: usize = 4 << 20;

/// Frames of a trail, at most.
const FRAMES: usize = 200;

/// Frames that are looked ahead, at most.
const AHEAD: usize = 2000;

/// Most spheres of a run that is looked ahead in: a copy of a larger one would be noticed.
const MOST: usize = 20_000;

/// How long it is looked ahead before commands are looked at again, s.
const LOOKING: f64 = 2e-3;

/// Centres at the end of a frame, m.
pub type Places = Arc<Vec<DVec3>>;

/// A frame, and the settings by which the run goes on from it.
type Here = (u64, Settings);

/// What is kept and looked for around the frame shown.
#[derive(Debug, Default)]
pub(super) struct Around {
    /// Whether trails are kept.
    path: bool,
    /// The sphere whose next contact is looked for.
    sphere: Option<usize>,
    trail: VecDeque<(u64, Places)>,
    search: Option<Box<LookAhead>>,
    found: Option<(Here, Arc<Ahead>)>,
}

/// A look ahead under way.
#[derive(Debug)]
struct LookAhead {
    from: Here,
    run: Simulation,
    ahead: Ahead,
    /// Time up to which is looked ahead, s.
    until: f64,
}

impl Around {
    /// Asks for trails, and for what comes next of a sphere.
    pub(super) fn ask(&mut self, path: bool, sphere: Option<usize>) {
        (self.path, self.sphere) = (path, sphere);
        if !path {
            self.trail.clear();
        }
        if sphere.is_none() {
            (self.search, self.found) = (None, None);
        }
    }

    /// Whether the run has to be seen frame by frame.
    pub(super) fn follows(&self) -> bool {
        self.path
    }

    /// Takes note of the frame at which the run is.
    pub(super) fn pass(&mut self, run: &Simulation) {
        let frame = run.tallies().frames;
        let place = self.trail.partition_point(|(kept, _)| *kept < frame);
        if !self.path || self.trail.get(place).is_some_and(|(kept, _)| *kept == frame) {
            return;
        }
        self.trail.insert(place, (frame, Arc::new(run.state().x)));
        let most = (TRAIL / (size_of::<DVec3>() * run.model().len().max(1))).clamp(2, FRAMES);
        if self.trail.len() > most {
            // what is farther from where one is goes
            let gone = if place < self.trail.len() / 2 { self.trail.pop_back() } else { self.trail.pop_front() };
            drop(gone);
        }
    }

    /// Forgets what came after a frame, or all.
    pub(super) fn cut(&mut self, frame: Option<u64>) {
        self.trail.retain(|(kept, _)| frame.is_some_and(|frame| *kept <= frame));
        (self.search, self.found) = (None, None);
    }

    /// Where all spheres were in the last frames up to this one, without a gap, the newest last.
    pub(super) fn trail(&self, frame: u64) -> Vec<Places> {
        let count = self.trail.partition_point(|(kept, _)| *kept <= frame);
        let back = self.trail.iter().take(count).rev().zip(0_u64..);
        let unbroken = back.take_while(|((kept, _), back)| kept + back == frame);
        let mut trail: Vec<Places> = unbroken.map(|((_, places), _)| Arc::clone(places)).collect();
        trail.reverse();
        trail
    }

    /// What comes next of the sphere asked for, if it is known of the frame shown.
    pub(super) fn ahead(&self, course: &Course) -> Option<Arc<Ahead>> {
        let found = self.found.as_ref().filter(|(from, _)| *from == here(course))?;
        Some(Arc::clone(&found.1)).filter(|ahead| Some(ahead.sphere) == self.sphere)
    }

    /// Looks ahead for a while, with nothing else to do; whether there is more to do. `clock` tells the time, s.
    pub(super) fn look(&mut self, course: &Course, work: u64, clock: impl Fn() -> f64) -> bool {
        let Some(sphere) = self.sphere.filter(|sphere| *sphere < course.simulation().model().len().min(MOST)) else {
            return false;
        };
        if self.ahead(course).is_some() || !course.is_whole() || course.stall().is_some() {
            return false;
        }
        let from = here(course);
        let search = match self.search.take().filter(|search| search.from == from && search.ahead.sphere == sphere) {
            Some(search) => search,
            None => Box::new(LookAhead::begin(course, sphere)),
        };
        let search = self.search.insert(search);
        let start = clock();
        while clock() - start < LOOKING {
            if search.is_over(work) {
                self.found = self.search.take().map(|search| (from, Arc::new(search.ahead)));
                return false;
            }
        }
        true
    }
}

impl LookAhead {
    fn begin(course: &Course, sphere: usize) -> LookAhead {
        let mut run = course.simulation().keyframe().run();
        run.record_events(true);
        run.explain(false);
        let t = run.time();
        let path = run.state().x.get(sphere).copied().into_iter().collect();
        let until = t + course.job().stage.duration;
        LookAhead { from: here(course), run, ahead: Ahead { sphere, path, contact: None, until: t }, until }
    }

    /// Goes on for a call; whether there is no more to be seen.
    fn is_over(&mut self, work: u64) -> bool {
        let sphere = self.ahead.sphere;
        let progress = self.run.advance(Until::Frame, work);
        if progress == Progress::Yielded {
            return false;
        }
        let next = self.run.take_events().into_iter().find(|event| takes_part(event, sphere));
        let time = next.map_or(self.run.time(), |contact| contact.time);
        self.ahead.path.extend(self.run.at(time).x.get(sphere));
        (self.ahead.contact, self.ahead.until) = (next, time);
        next.is_some() || progress != Progress::Reached || self.ahead.path.len() > AHEAD || time >= self.until
    }
}

fn here(course: &Course) -> Here {
    (course.frame(), course.simulation().settings())
}

fn takes_part(event: &Contact, sphere: usize) -> bool {
    let meets = matches!(event.class, Class::Collide | Class::Rest);
    meets && (event.a == sphere || event.kind == Kind::Pair && event.b == sphere)
}
