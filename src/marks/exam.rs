//! A scene, and trajectories of any program held against it.

use super::bodies::Bodies;
use super::interval::Interval;
use super::ledger::{Ledger, Totals};
use super::mistake::Suspicion;
use super::norm::{Beside, Norm};
use super::observer::{Deepest, Observer};
use super::order::{Compared, Sight, WrongImpact, compare};
use super::series::Series;
use super::standard::{Follow, Source, Standard};
use super::truth::Truth;
use crate::certify::{Certificate, certify};
use crate::export::{Moment, ReadError};
use crate::measure::{Deviation, Observables};
use crate::scene::Scene;

/// Error asked for where there is no tolerance, as a part of the smallest radius.
const ASKED: f64 = 1e-3;

/// The yardstick's own error may be this part of the error asked for.
const FLOOR: f64 = 0.1;

/// A scene to mark trajectories on.
#[derive(Debug, Clone)]
pub struct Exam {
    scene: Scene,
    bodies: Bodies,
    /// Largest position error that passes, m; none: there is no verdict.
    pub tolerance: Option<f64>,
    /// Time up to which trajectories are marked, s.
    pub until: f64,
    /// Up to when positions are held against `exact`, s: there its own error is a tenth of the tolerance at most.
    pub horizon: f64,
    /// What is known of `exact` itself.
    pub certificate: Certificate,
    /// What many runs do, for figures beyond the horizon.
    pub norm: Option<Norm>,
}

/// What a mark says of a trajectory.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Number of times in the file.
    pub moments: u64,
    /// Last time in the file, s.
    pub end: f64,
    /// Longest time between two rows of a sphere, s.
    pub spacing: f64,
    /// Up to when positions were compared, s.
    pub compared: f64,
    /// Largest distance of a sphere from its place, m; its time, s; the sphere.
    pub error: (f64, f64, usize),
    /// The largest distance of a sphere from its place, m, over time, s.
    pub series: Series,
    /// Uncertainty of places between rows of the other trajectory, m; 0 against `exact`.
    pub interpolation: f64,
    /// Impacts up to `compared`; none if the file has no velocities.
    pub impacts: Option<Impacts>,
    /// The deepest overlap in any row.
    pub deepest: Option<Deepest>,
    /// Energy and momentum; none if the file has no velocities.
    pub energy: Option<Ledger>,
    /// Largest momentum that an impact of a pair by itself made or lost, as a part of what it exchanged.
    pub imbalance: f64,
    /// When a velocity first changed that neither a contact nor a pull explains, s, and of which sphere.
    pub unexplained: Option<(f64, usize)>,
    /// Figures as a crowd beside those of many runs; empty if the trajectory is held against none.
    pub crowd: Vec<Beside>,
    /// The likeliest mistake, if the trajectory is wrong.
    pub mistake: Option<Suspicion>,
    /// Whether the trajectory goes on to the horizon, or to a row before it.
    pub complete: bool,
    /// Whether the trajectory passes; none if no tolerance is asked for.
    pub passes: Option<bool>,
}

/// Impacts held against those of the standard.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impacts {
    /// The first impact that is missing, late, early or extra.
    pub first_wrong: Option<WrongImpact>,
    /// Number of impacts found, of those that can be seen.
    pub found: usize,
    /// Number of impacts that can be seen: the spheres of the others meet again within two rows, or so slowly that it may
    /// be support.
    pub wanted: usize,
}

/// Why there is no mark.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoMark {
    /// `go_on` returned false.
    Interrupted,
    /// The file cannot be read.
    Unreadable(ReadError),
}

impl From<ReadError> for NoMark {
    fn from(error: ReadError) -> NoMark {
        NoMark::Unreadable(error)
    }
}

impl Exam {
    /// Certifies `exact` on a scene up to `until` (s); none if `go_on` returns false.
    pub fn new(scene: &Scene, until: f64, tolerance: Option<f64>, go_on: &dyn Fn() -> bool) -> Option<Exam> {
        let certificate = certify(scene, until, go_on)?;
        let bodies = Bodies::of(scene);
        let mut exam = Exam { scene: scene.clone(), bodies, tolerance, until, horizon: until, certificate, norm: None };
        let asked = tolerance.unwrap_or(ASKED * exam.smallest_radius());
        exam.horizon = exam.certificate.within(FLOOR * asked);
        Some(exam)
    }

    /// The exam with figures of a crowd held against those of many runs.
    pub fn beside(self, norm: Option<Norm>) -> Exam {
        Exam { norm, ..self }
    }

    /// Number of spheres that a file must have.
    pub fn spheres(&self) -> usize {
        self.bodies.radii.len()
    }

    /// The smallest radius, m.
    pub(super) fn smallest_radius(&self) -> f64 {
        self.bodies.radii.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Marks a trajectory against `exact`.
    ///
    /// # Errors
    /// If the file cannot be read, or `go_on` returns false.
    pub fn mark(&self, source: Source, go_on: &dyn Fn() -> bool) -> Result<Mark, NoMark> {
        let truth = Box::new(Truth::new(&self.scene, self.horizon));
        self.hold(source, Standard::Exact(truth), go_on)
    }

    /// Marks a trajectory against another, up to where the shorter ends.
    ///
    /// # Errors
    /// If a file cannot be read, or `go_on` returns false.
    pub fn mark_against(&self, source: Source, other: Source, go_on: &dyn Fn() -> bool) -> Result<Mark, NoMark> {
        let follow = Follow::new(&self.bodies, other).map_err(NoMark::Unreadable)?;
        self.hold(source, Standard::Other(Box::new(follow)), go_on)
    }

    fn hold(&self, mut source: Source, mut standard: Standard, go_on: &dyn Fn() -> bool) -> Result<Mark, NoMark> {
        let mut reading = Reading::new(&self.bodies);
        reading.crowd = self.norm.as_ref().map(|_| Observables::new(&self.scene, self.scene.duration));
        let mut known = true;
        while let Some(moment) = source.moment()? {
            if !go_on() {
                return Err(NoMark::Interrupted);
            }
            let wanted = if known { standard.at(&self.bodies, moment.time, go_on)? } else { None };
            known = known && (wanted.is_some() || reading.compared == 0.0);
            if let Some(wanted) = &wanted {
                reading.compare(&moment, &wanted.x);
            }
            if let Some(crowd) = &mut reading.crowd {
                crowd.enter(moment.time, &moment.x, &moment.v);
            }
            reading.enter(moment, wanted.and_then(|wanted| wanted.totals));
        }
        if !go_on() {
            return Err(NoMark::Interrupted);
        }
        let against_exact = matches!(standard, Standard::Exact(_));
        Ok(self.close(reading, standard, against_exact))
    }

    fn close(&self, reading: Reading, mut standard: Standard, against_exact: bool) -> Mark {
        let Reading { mut observer, compared, spacing, .. } = reading;
        let crowd = reading.crowd.as_ref().map(Observables::figures);
        let crowd = self.norm.as_ref().zip(crowd).map(|(norm, figures)| norm.beside(&figures)).unwrap_or_default();
        observer.finish();
        let (exact, other, interpolation) = standard.close();
        let tolerance = self.tolerance.unwrap_or(0.0);
        let sight = Sight { until: compared, spacing: spacing.max(other), tolerance };
        let floor = |key| observer.floor(key, spacing);
        let Compared { first_wrong, found, wanted } = compare(&exact, &observer.impacts, sight, floor);
        let end = reading.last.as_ref().map_or(0.0, |last| last.time);
        let complete = !against_exact || end + spacing >= self.horizon;
        let passes = self.tolerance.map(|tolerance| reading.error.0 <= tolerance && complete);
        let wrong = passes != Some(true);
        Mark {
            moments: reading.moments,
            end,
            spacing,
            compared,
            error: reading.error,
            series: reading.series,
            interpolation,
            impacts: reading.moves.then_some(Impacts { first_wrong, found, wanted }),
            deepest: observer.deepest,
            energy: reading.moves.then_some(reading.ledger),
            imbalance: observer.imbalance,
            unexplained: observer.unexplained,
            crowd,
            mistake: observer.evidence.suspicion().filter(|_| wrong),
            complete,
            passes,
        }
    }
}

/// A trajectory that is being read.
struct Reading<'a> {
    bodies: &'a Bodies,
    observer: Observer<'a>,
    last: Option<Moment>,
    touches: Vec<super::bodies::Touch>,
    moves: bool,
    moments: u64,
    spacing: f64,
    compared: f64,
    error: (f64, f64, usize),
    series: Series,
    ledger: Ledger,
    crowd: Option<Observables>,
}

impl<'a> Reading<'a> {
    fn new(bodies: &'a Bodies) -> Reading<'a> {
        Reading {
            bodies,
            observer: Observer::new(bodies),
            last: None,
            touches: Vec::new(),
            moves: false,
            moments: 0,
            spacing: 0.0,
            compared: 0.0,
            error: (0.0, 0.0, 0),
            series: Series::default(),
            ledger: Ledger::default(),
            crowd: None,
        }
    }

    fn compare(&mut self, moment: &Moment, wanted: &[glam::DVec3]) {
        let Deviation { distance, sphere } = Deviation::between(&moment.x, wanted);
        self.compared = moment.time;
        self.series.enter(moment.time, distance);
        if distance > self.error.0 {
            self.error = (distance, moment.time, sphere);
        }
    }

    fn enter(&mut self, moment: Moment, exact: Option<Totals>) {
        self.moments += 1;
        self.moves = !moment.v.is_empty();
        if self.moves {
            self.ledger.enter(moment.time, self.bodies.totals(&moment.x, &moment.v), exact);
        }
        let touches = self.observer.touches(&moment);
        if let Some(last) = &self.last {
            self.spacing = self.spacing.max(moment.time - last.time);
            if self.moves {
                self.observer.interval(&Interval::new(self.bodies, last, &moment), &self.touches, &touches);
            }
        }
        (self.last, self.touches) = (Some(moment), touches);
    }
}
