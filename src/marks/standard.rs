//! What a trajectory is held against: `exact`, or another trajectory.

use std::io::Read;

use glam::DVec3;

use super::bodies::Bodies;
use super::interval::Interval;
use super::ledger::Totals;
use super::observer::{Observer, Seen};
use super::truth::Truth;
use crate::export::{Moment, ReadError, States};

/// A trajectory as it is read from a file or pipe.
pub type Source = States<Box<dyn Read + Send>>;

/// A trajectory between whose rows another is looked up.
pub(super) struct Follow<'a> {
    bodies: &'a Bodies,
    source: Source,
    /// The moment before the last time asked for.
    before: Moment,
    /// The moment after the last time asked for; none at the end of the file.
    after: Option<Moment>,
    observer: Observer<'a>,
    /// Largest distance of the parabolas from two rows where they should meet, m.
    apart: f64,
    spacing: f64,
}

/// Where spheres should be.
#[derive(Debug)]
pub(super) struct Wanted {
    pub(super) x: Vec<DVec3>,
    /// Energy and momentum then, if they are known.
    pub(super) totals: Option<Totals>,
}

impl<'a> Follow<'a> {
    pub(super) fn new(bodies: &'a Bodies, mut source: Source) -> Result<Follow<'a>, ReadError> {
        let before = source.moment()?.unwrap_or_default();
        let after = source.moment()?;
        let observer = Observer::new(bodies);
        Ok(Follow { bodies, source, before, after, observer, apart: 0.0, spacing: 0.0 })
    }

    fn at(&mut self, t: f64) -> Result<Option<Wanted>, ReadError> {
        while let Some(after) = self.after.take() {
            if t <= after.time {
                self.after = Some(after);
                break;
            }
            self.observe(&after);
            self.after = self.source.moment()?;
            self.before = after;
        }
        let Some(after) = &self.after else {
            return Ok((t == self.before.time).then(|| Wanted { x: self.before.x.clone(), totals: None }));
        };
        if t < self.before.time {
            return Ok(None);
        }
        let ends = [&self.before, after].map(|moment| moment.time == t);
        if let Some(same) = [&self.before, after].into_iter().zip(ends).find_map(|(moment, is)| is.then_some(moment)) {
            return Ok(Some(Wanted { x: same.x.clone(), totals: None }));
        }
        let pair = with_speeds(self.bodies, &self.before, after);
        let interval = Interval::new(self.bodies, &pair[0], &pair[1]);
        let places: Vec<(DVec3, f64)> = (0..after.x.len()).map(|i| interval.place(i, t)).collect();
        self.apart = places.iter().map(|place| place.1).fold(self.apart, f64::max);
        Ok(Some(Wanted { x: places.into_iter().map(|place| place.0).collect(), totals: None }))
    }

    fn observe(&mut self, after: &Moment) {
        self.spacing = self.spacing.max(after.time - self.before.time);
        if after.v.is_empty() {
            return;
        }
        let interval = Interval::new(self.bodies, &self.before, after);
        let touches = [&self.before, after].map(|moment| self.observer.touches(moment));
        self.observer.interval(&interval, &touches[0], &touches[1]);
    }
}

/// Two moments with velocities: where a file has none, those of the parabola through both.
fn with_speeds(bodies: &Bodies, before: &Moment, after: &Moment) -> [Moment; 2] {
    let mut pair = [before.clone(), after.clone()];
    if before.v.is_empty() {
        let h = (after.time - before.time).max(f64::MIN_POSITIVE);
        let mean = |i: usize| (after.x[i] - before.x[i]) / h;
        for (moment, sign) in pair.iter_mut().zip([-0.5, 0.5]) {
            moment.v = (0..after.x.len()).map(|i| mean(i) + bodies.pulls[i] * (sign * h)).collect();
        }
    }
    pair
}

/// What a trajectory is held against.
pub(super) enum Standard<'a> {
    Exact(Box<Truth>),
    Other(Box<Follow<'a>>),
}

impl Standard<'_> {
    /// Where spheres should be at `t` (s), asked in the order of time; none beyond where that is known.
    pub(super) fn at(
        &mut self,
        bodies: &Bodies,
        t: f64,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Option<Wanted>, ReadError> {
        match self {
            Standard::Other(follow) => follow.at(t),
            Standard::Exact(truth) => {
                let totals = |x: &[DVec3], v: &[DVec3]| Some(bodies.totals(x, v));
                Ok(truth.at(t, go_on).map(|state| Wanted { totals: totals(&state.x, &state.v), x: state.x }))
            }
        }
    }

    /// All impacts so far, in order of time; longest time between two rows, s; uncertainty of places between rows, m.
    pub(super) fn close(&mut self) -> (Vec<Seen>, f64, f64) {
        match self {
            Standard::Exact(truth) => (std::mem::take(&mut truth.impacts), 0.0, 0.0),
            Standard::Other(follow) => {
                follow.observer.finish();
                (std::mem::take(&mut follow.observer.impacts), follow.spacing, follow.apart)
            }
        }
    }
}
