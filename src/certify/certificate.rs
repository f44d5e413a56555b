//! A run of `exact` and its shadow, side by side.

use super::ending::{Cause, Ending};
use super::growth::Growth;
use super::meeting::SAME_TIME;
use super::shadow::Shadow;
use crate::double::Double;
use crate::physics::{Contact, Progress, Simulation, Until};
use crate::scene::{Method, Scene, Settings};

/// Pairs of bodies that a certificate looks at, at most: half a minute.
const MOST_LOOKS: u64 = 1_000_000_000;

/// What is certified of a run by `exact`.
#[derive(Debug, Clone, PartialEq)]
pub struct Certificate {
    /// Until when, s: up to here the shadow run met the same contacts in an order that bodies cannot tell from the same, of
    /// the same class, and no other.
    pub until: f64,
    /// The largest distance of a sphere from its place in the shadow run up to then, m.
    pub error: f64,
    /// Why the certificate ends before the run does; none if it does not.
    pub ending: Option<Ending>,
    /// Impacts, rests and releases that the shadow run has followed.
    pub events: u64,
    /// Impacts of which `exact` alone says that they come before another one of the same sphere at the same time: by
    /// symmetry or touch, where the law leaves the order open.
    pub ties: u64,
    /// Pairs of bodies that were looked at to show that no other contact comes; a piece of a curved motion counts as thousands.
    pub looks: u64,
    growth: Growth,
    places: Vec<[Double; 3]>,
}

impl Certificate {
    /// Where the shadow run has sphere `i` at `until`, m.
    pub fn place(&self, i: usize) -> Option<[Double; 3]> {
        self.places.get(i).copied()
    }

    /// Until when the error is at most `asked` (m), s: `until`, if it never is larger; else the last moment before which it
    /// cannot have passed `asked`, or half of it, since it is kept by powers of two.
    pub fn within(&self, asked: f64) -> f64 {
        if self.error <= asked { self.until } else { self.growth.first(asked).min(self.until) }
    }
}

/// Runs a scene by `exact` up to `until` (s) and certifies what it can; nothing if `go_on`, asked every few milliseconds,
/// says no.
pub fn certify(scene: &Scene, until: f64, go_on: &dyn Fn() -> bool) -> Option<Certificate> {
    certify_within(scene, until, MOST_LOOKS, go_on)
}

/// Runs a scene by `exact` up to `until` (s) and certifies what it can with at most so many looks at pairs of bodies, some
/// 30 ns each; nothing if `go_on`, asked every few milliseconds, says no.
pub fn certify_within(scene: &Scene, until: f64, looks: u64, go_on: &dyn Fn() -> bool) -> Option<Certificate> {
    let (found, at_its_end) = pursue(scene, (until, looks), go_on)?;
    if at_its_end {
        return Some(found);
    }
    // what ends it was seen only after later events: once more, up to there
    let (again, _) = pursue(scene, (found.until, looks), go_on)?;
    let ending = found.ending.map(|ending| Ending { time: again.until, ..ending });
    Some(Certificate { ending, ..again })
}

/// The certificate of a run, and whether the shadow stopped where it ends.
fn pursue(scene: &Scene, (until, looks): (f64, u64), go_on: &dyn Fn() -> bool) -> Option<(Certificate, bool)> {
    follow(scene, Shadow::new(scene, until, looks), go_on)
}

/// The certificate of a run by a shadow that may be of another scene, and whether the shadow stopped where it ends.
fn follow(scene: &Scene, shadow: Shadow, go_on: &dyn Fn() -> bool) -> Option<(Certificate, bool)> {
    let until = shadow.until;
    let settings = Settings { method: Method::Exact, dt: until.max(f64::MIN_POSITIVE), tolerance: 0.0 };
    let mut run = Simulation::new(scene, settings);
    run.record_events(true);
    let mut pursuit = Pursuit { shadow, until, events: 0 };
    if pursuit.shadow.is_too_large() {
        return Some((pursuit.nothing(), true));
    }
    let mut followed = pursuit.frame(&mut run);
    while followed.is_ok() && run.time() < until {
        if !go_on() {
            return None;
        }
        followed = match run.advance(Until::Frame, Simulation::SLICE) {
            Progress::Yielded => Ok(()),
            Progress::Reached => pursuit.frame(&mut run),
            Progress::Stalled(stall) => Err(Ending { time: stall.time, bodies: None, cause: Cause::Stalled }),
        };
    }
    Some(pursuit.close(followed.err(), &run))
}

/// A shadow run under way.
struct Pursuit {
    shadow: Shadow,
    until: f64,
    events: u64,
}

impl Pursuit {
    /// Follows what `exact` tells of a frame that is complete.
    fn frame(&mut self, run: &mut Simulation) -> Result<(), Ending> {
        let mut rows = run.take_events();
        rows.retain(|row| row.time <= self.until);
        let mut instant = f64::NEG_INFINITY;
        for row in &rows {
            if row.time != instant {
                self.shadow.settle()?;
                self.shadow.pass(Double::from(row.time) + Double::from(row.time * SAME_TIME))?;
            }
            instant = row.time;
            self.follow(row)?;
        }
        let end = run.time().min(self.until);
        self.shadow.settle()?;
        self.shadow.pass(end.into())?;
        for (time, i, place) in std::mem::take(&mut self.shadow.checks) {
            self.shadow.differs(i, &run.at(time), place)?;
        }
        let state = if run.time() <= self.until { run.state() } else { run.at(self.until) };
        self.shadow.compare(&state)
    }

    /// The certificate of a scene with too many bodies: of its start alone.
    fn nothing(self) -> Certificate {
        let ending = Some(Ending { time: 0.0, bodies: None, cause: Cause::Spent });
        let places = self.shadow.bodies.iter().map(|body| body.now.x.components()).collect();
        Certificate { until: 0.0, error: 0.0, ending, events: 0, ties: 0, looks: 0, growth: Growth::default(), places }
    }

    fn follow(&mut self, row: &Contact) -> Result<(), Ending> {
        let amid = self.shadow.is_amid(row);
        self.shadow.follow(row).map_err(|ending| match ending.cause {
            Cause::NoContact | Cause::OtherClass if amid => Ending { cause: Cause::AmidImpacts, ..ending },
            _ => ending,
        })?;
        self.events += 1;
        Ok(())
    }

    /// The certificate, up to where nothing speaks against it, and whether no sphere has had two events since then.
    fn close(self, ending: Option<Ending>, run: &Simulation) -> (Certificate, bool) {
        let Pursuit { mut shadow, until, events } = self;
        let ending = ending.or_else(|| (0..shadow.let_go.len()).find_map(|_| shadow.still_holds(0).err()));
        let last = ending.as_ref().map_or(until, |ending| ending.time.min(until));
        let doubt = shadow.first_doubt(last.into());
        let until = doubt.as_ref().map_or(last, |doubt| doubt.time.min(last));
        // as bodies come together for the contact that ends it, or amid impacts of one instant, nothing shows that they do not touch
        let known = |doubt: &Ending| {
            let at_once = |ending: &Ending| doubt.time >= ending.time * (1.0 - SAME_TIME);
            ending.as_ref().is_some_and(|ending| ending.bodies == doubt.bodies || at_once(ending))
        };
        let ending = doubt.filter(|doubt| !known(doubt)).or(ending);
        let t = Double::from(until);
        let is_seen = shadow.look(run, until);
        let mut growth = shadow.growth.clone();
        for body in &shadow.bodies {
            let since = body.rises(body.course(t), until, &mut growth);
            growth.note(since, body.error(t));
        }
        let error = shadow.bodies.iter().map(|body| body.error(t)).fold(shadow.error, f64::max);
        let places = shadow.bodies.iter().map(|body| body.course(t).at(t).components()).collect();
        let ending = ending.map(|ending| Ending { time: until, ..ending });
        let at_its_end = is_seen && shadow.bodies.iter().all(|body| body.before.t <= t);
        let (ties, looks) = (shadow.ties, shadow.looks);
        (Certificate { until, error, ending, events, ties, looks, growth, places }, at_its_end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::law_fault::with_restitution_times;
    use crate::scene;

    #[test]
    fn an_exact_that_breaks_the_impact_law_is_found_out() {
        // Until when, s; and what the restitution of pairs and of walls is multiplied by.
        let broken = [
            ("paper-0", 4.0, [1.0, 0.999_999]),
            ("paper-3", 4.0, [1.0, 0.999_999]),
            ("billiard", 0.9, [0.999_999, 1.0]),
        ];
        for (name, until, [pairs, walls]) in broken {
            let scene = scene::open(name).expect("a built-in scene").scene;
            let run = || certify(&scene, until, &|| true).expect("it is not interrupted");
            let right = run();
            assert!(right.ending.is_none() && right.error < 1e-12, "{name}: {right:?}");
            // A part in a million of a bounce of some m/s, over a second: micrometres, which rounding does not make here.
            let wrong = with_restitution_times(pairs, walls, run);
            assert!(wrong.ending.is_some() || wrong.error > 1e-7, "{name}: {wrong:?}");
        }
    }

    #[test]
    fn an_exact_that_has_curved_rest_wrong_is_found_out() {
        // A ball on an edge, and one on another ball, that `exact` draws by a millionth more: it begins to roll as it should.
        let cases = [
            "(0.3, 0.4, 0), mass: 1, radius: 0.5",
            "(-2, 0.5, 0), mass: 1, radius: 0.5), Sphere(x: (-1.4, 1.3, 0), mass: 1, radius: 0.5",
        ];
        for spheres in cases {
            let of = |gravity: f64| {
                let floor = "Wall(center: (-4, 0, 0), s1: (8, 0, 0), s2: (0, 0, -8))";
                let text = format!(
                    "Scene(gravity: (0, {gravity}, 0), walls: [{floor}], spheres: [Sphere(x: {spheres})], duration: 1)"
                );
                scene::parse(&text, "a test").expect("a scene")
            };
            let shadow = || Shadow::new(&of(-8.0), 0.2, MOST_LOOKS);
            let run = |gravity: f64| follow(&of(gravity), shadow(), &|| true).expect("it is not interrupted").0;
            let right = run(-8.0);
            assert!(right.ending.is_none() && right.error < 1e-12, "{right:?}");
            let wrong = run(-8.000_008);
            assert!(wrong.ending.is_some() || wrong.error > 1e-8, "{wrong:?}");
        }
    }
}
