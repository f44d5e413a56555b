//! Curved rest: spheres that slide over an edge, over a corner or over each other have no parabola. They are integrated
//! to 1e-12, and the time spent so is counted as not exact.
//!
//! While the same contacts hold, they are equations, J a + k = 0, and the motion is an ordinary differential equation in
//! x and v, integrated by the method of Runge, Kutta and Fehlberg of order 8 (NASA TR R-287, 1968); after each step x and
//! v are put back on the contacts. Within a step, an [`Arc`], the path is the polynomial of degree 5 that has x, v and a
//! of both its ends (Hermite). Its error, |x⁽⁶⁾| h⁶/46080, bounds the step to [`TOLERANCE`]; the integration is then far
//! below rounding, and reading the path costs next to nothing.
//!
//! Spheres outside the island see chord parabolas x₀ + v₀ s + a s²/2 with a = 2 (x_h − x₀ − v₀ h)/h², laid along the arc
//! one after another: a chord departs from the path by |jerk| h³/40, which must stay below
//! [`DEPARTURE`](super::ends::DEPARTURE), so that contact times with other bodies are predicted as in flight.

use glam::DVec3;

use super::bodies::{Body, Closed};
use super::ends::Ends;
use super::equation::{ConstrainedMotion, Order};
use super::hermite::{Hermite, cube_root, fall_below_zero};

/// Error allowed to the path between the ends of an arc, in radii (or coordinates, if larger): some ulp.
const TOLERANCE: f64 = 1e-15;

/// Length of the first arc, in units of the time in which the motion changes.
const FIRST: f64 = 0.05;

/// Length of the arc after something has happened, in units of the time in which the motion changes: it nearly always
/// happens again before that is over, up to a million times a second. One more look at the accelerations tells how they
/// grow; x is off by less than 1e-17 radii then, and v by 1e-13 radii per unit of time, as the square of the time.
const BRIEFEST: f64 = 1e-4;

/// Length of the arc after [`BRIEFEST`], in units of the time in which the motion changes: it costs a quarter of a longer
/// one. The classical method of order 4 is off by less than 1e-17 radii then.
const BRIEF: f64 = 1e-3;

/// Length of the arc of bodies that creep, in units of the time in which the motion changes: x is off by its cube.
const CREEP: f64 = 1e-5;

/// Share of a brief arc up to which a change is looked for.
const SOON: f64 = 0.125;

/// Share of an arc up to which v of its polynomial is as good as integrated: its error grows as the square.
const BEGINNING: f64 = 1e-3;

/// Length of the longest arc, in units of the time in which the motion changes: its loads must not change unseen.
const LONGEST: f64 = 0.2;

/// Length of an arc that is not halved any more, in units of the time in which the motion changes: its polynomial is off by
/// the sixth power of that, and what is still found beyond is the rounding of the contacts' own equations, as where two edges
/// of a narrow crack hold a sphere across it: rounding over the angle between their normals.
const SHORT: f64 = 1e-3;

/// Growth from which on that holds: the polynomial is off by 1e-12 radii. Below, spheres that just fit come into line.
const ROUGH: f64 = 0.32;

/// Length of an arc that is not halved even there, in units of the time in which the motion changes.
const SHORTEST: f64 = 1e-10;

/// Fractions of an arc at which its end conditions are looked at: a load that dips below 0 between two of them and comes
/// back would have to vary faster than the arc was chosen for.
const LOOKS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// By how much of the arc a change is overshot, so that it shows beyond rounding: a load of 1e-10 of what it varies by
/// during the arc, some 1e-12 s late.
const OVERSHOOT: f64 = 1e-10;

/// A stretch of a curved motion during which the same contacts hold.
#[derive(Debug, Clone)]
pub(crate) struct Arc {
    start: Ends,
    end: Ends,
    /// Time between the ends of the polynomial, s.
    span: f64,
    /// How long the contacts hold, s, at most `span`.
    pub(crate) length: f64,
    /// Whether a contact lets go or changes its part at `length`.
    pub(crate) changes: bool,
    /// A good span for the next arc, s.
    next: f64,
    /// Which contacts carry a load, and therefore hold.
    loaded: Vec<bool>,
    /// How the arc is integrated.
    order: Order,
}

impl Arc {
    /// The motion of bodies from now on, while the contacts that are `loaded` go on holding. The contacts are closed
    /// (v_n = 0), and `a` are the accelerations, m/s².
    pub(crate) fn new(bodies: Vec<Body>, a: Vec<DVec3>, contacts: &[Closed], loaded: Vec<bool>) -> Arc {
        let motion = ConstrainedMotion::held_by(&bodies, contacts, &loaded);
        let start = Ends { bodies, a };
        let span = BRIEFEST * start.time_scale();
        Arc::briefest(&start, &motion, span, &loaded).unwrap_or_else(|| Arc::of(start.bodies, contacts, loaded, None))
    }

    /// The motion of bodies from now on with the accelerations `a` (m/s²) that they have now, for a moment after which their
    /// contacts are solved again: where supports depend on each other to rounding, the equation of those that hold is none.
    pub(crate) fn creeping(bodies: Vec<Body>, a: Vec<DVec3>, loaded: Vec<bool>) -> Arc {
        let start = Ends { bodies, a };
        let span = CREEP * start.time_scale();
        let end = start.moved(span);
        Arc { changes: true, ..Arc::between(start, end, span, (loaded, Order::Three)) }
    }

    /// Whether a contact changes as soon as the arc begins.
    pub(crate) fn is_over_at_once(&self) -> bool {
        self.changes && self.length <= 2.0 * OVERSHOOT * self.span
    }

    /// The arc that goes on from the end of this one.
    pub(crate) fn go_on(&self, contacts: &[Closed]) -> Arc {
        let span = (self.order != Order::Three).then_some(self.next);
        Arc::of(self.real(self.length, contacts), contacts, self.loaded.clone(), span)
    }

    /// The bodies `time` (s) after the arc's beginning, integrated up to there: the polynomial is as good in x, but its v is
    /// off by its error over its span, which adds up where an arc is interrupted over and over.
    pub(crate) fn real(&self, time: f64, contacts: &[Closed]) -> Vec<Body> {
        if time <= 0.0 {
            return self.start.bodies.clone();
        }
        if time >= self.span && self.order != Order::Three {
            return self.end.bodies.clone();
        }
        let motion = ConstrainedMotion::held_by(&self.start.bodies, contacts, &self.loaded);
        match self.order {
            Order::Four => return motion.step_rk4(self.start.moving(), time),
            Order::Eight if time > BEGINNING * self.span => return motion.step_rkf8(self.start.moving(), time),
            Order::Three | Order::Eight => {}
        }
        let mut bodies = self.at(time.min(self.span));
        motion.restore(&mut bodies);
        bodies
    }

    fn of(mut bodies: Vec<Body>, contacts: &[Closed], loaded: Vec<bool>, span: Option<f64>) -> Arc {
        let motion = ConstrainedMotion::held_by(&bodies, contacts, &loaded);
        motion.restore_velocities(&mut bodies);
        let start = Ends { a: motion.accelerations(&bodies).0, bodies };
        let scale = start.time_scale();
        let (start, mut span) = match span {
            None => match Arc::brief(start, &motion, BRIEF * scale, &loaded) {
                Ok(arc) => return arc,
                Err(start) => (start, SOON * BRIEF * scale),
            },
            Some(span) => (start, if span > BRIEF * scale { span.min(LONGEST * scale) } else { FIRST * scale }),
        };
        for _ in 0..30 {
            let (bodies, seen) = motion.seen_rkf8(start.moving(), span);
            let end = Ends { a: motion.accelerations(&bodies).0, bodies };
            let mut arc = Arc::between(start.clone(), end, span, (loaded.clone(), Order::Eight));
            let growth = arc.growth(&motion).min(arc.growth_beside(&motion, &seen));
            arc.next = span * (0.8 * growth).min(2.0);
            if growth >= if span <= SHORT * scale { ROUGH } else { 1.0 } || span <= SHORTEST * scale {
                arc.cut_short(&motion, &LOOKS);
                return arc;
            }
            span *= (0.8 * growth).max(0.05);
        }
        // out of reach of numbers: no motion at all, which the method's watchdog notices
        Arc { changes: true, ..Arc::between(start.clone(), start, 0.0, (loaded, Order::Four)) }
    }

    /// An arc of this span (s) during which nothing changes that has been found yet.
    fn between(start: Ends, end: Ends, span: f64, (loaded, order): (Vec<bool>, Order)) -> Arc {
        Arc { start, end, span, length: span, changes: false, next: span, loaded, order }
    }

    /// The briefest of arcs; none if a contact changes, or the accelerations leap, on the way.
    fn briefest(start: &Ends, motion: &ConstrainedMotion, span: f64, loaded: &[bool]) -> Option<Arc> {
        let ahead = start.moved(span).bodies;
        let (a, forces) = motion.accelerations(&ahead);
        let grown = |((body, from), to): ((&Body, &DVec3), &DVec3)| {
            let growth = (*to - *from) * span;
            Body { x: body.x + growth * (span / 6.0), v: body.v + growth * 0.5, ..*body }
        };
        let bodies: Vec<Body> = ahead.iter().zip(&start.a).zip(&a).map(grown).collect();
        let before = motion.marks(&start.bodies, &start.a);
        let holds = motion.margin(&bodies, (&a, &forces), &before) >= 0.0;
        let arc = Arc::between(start.clone(), Ends { bodies, a }, span, (loaded.to_vec(), Order::Three));
        (holds && !arc.start.leap_to(&arc.end, span)).then_some(arc)
    }

    /// An arc so short that neither its integration nor its polynomial needs looking at while the contacts hold. Where one
    /// changes on the way but not soon, the arc ends before: most of these arcs are interrupted long before, and when that
    /// is need not be found. Gives its start back where accelerations leap or the equation is none on the way.
    fn brief(start: Ends, motion: &ConstrainedMotion, span: f64, loaded: &[bool]) -> Result<Arc, Ends> {
        let bodies = motion.step_rk4(start.moving(), span);
        let (a, forces) = motion.accelerations(&bodies);
        let before = motion.marks(&start.bodies, &start.a);
        let holds = motion.margin(&bodies, (&a, &forces), &before) >= 0.0;
        let mut arc = Arc::between(start, Ends { bodies, a }, span, (loaded.to_vec(), Order::Four));
        if arc.start.leap_to(&arc.end, span) || !holds && arc.growth(motion) < ROUGH {
            return Err(arc.start);
        }
        if !holds {
            if motion.distance_to_change(&arc.at(SOON * span), &before) >= 0.0 {
                arc.length = SOON * span;
            } else {
                arc.cut_short(motion, &[SOON]);
            }
        }
        Ok(arc)
    }

    /// By how much the arc might be longer, as its middle tells.
    fn growth(&self, motion: &ConstrainedMotion) -> f64 {
        self.growth_at(0.5, &motion.accelerations(&self.at(0.5 * self.span)).0, |_| 0.0)
    }

    /// By how much the arc might be longer, as the accelerations (m/s²) tell that were `seen` on the way, by share of it. What
    /// is healed of gaps at its end, or rounded there, bends the polynomial by 6/h² of it at most, but not in the middle.
    fn growth_beside(&self, motion: &ConstrainedMotion, seen: &[(f64, Vec<DVec3>)]) -> f64 {
        let bent = |body: &Body| 6.0 * (motion.healed + body.finest());
        seen.iter().map(|(share, a)| self.growth_at(*share, a, bent)).fold(f64::INFINITY, f64::min)
    }

    /// By how much the arc might be longer, by the accelerations (m/s²) that the equation tells at a share of it, of which `bent`
    /// over h² (m) is none of the arc's. The error of the polynomial is x⁽⁶⁾/720 s³ (h − s)³, so that in the middle, where it is
    /// most, it is h²/24 times that of the acceleration; it grows with the sixth power of h.
    fn growth_at(&self, share: f64, real: &[DVec3], bent: impl Fn(&Body) -> f64) -> f64 {
        let fits = |(i, (body, real)): (usize, (&Body, &DVec3))| {
            let off = self.polynomial(i).chord_acceleration(share * self.span, 0.0).distance(*real);
            let left = off * (self.span * self.span) - bent(body);
            if left <= 0.0 { f64::INFINITY } else { TOLERANCE * body.size() / (left / 24.0) }
        };
        let all = self.start.bodies.iter().zip(real).enumerate().map(fits);
        // no number fits not at all
        let worse = |least: f64, fits: f64| if fits.is_nan() { 0.0 } else { least.min(fits) };
        cube_root(all.fold(1e6, worse).sqrt())
    }

    /// The bodies `time` (s) after the arc's beginning.
    pub(crate) fn at(&self, time: f64) -> Vec<Body> {
        let start = self.start.bodies.iter().enumerate();
        let moved = |(i, body): (usize, &Body)| {
            let (x, v) = self.polynomial(i).read(time);
            Body { x, v, ..*body }
        };
        start.map(moved).collect()
    }

    /// How long a chord may be that begins at `from` (s) of the arc; no longer than what is left of it.
    pub(crate) fn chord(&self, from: f64) -> f64 {
        let left = self.length - from;
        let of = |(i, body): (usize, &Body)| {
            let path = self.polynomial(i);
            let reach = |jerk: f64| cube_root(40.0 * body.departure() / jerk).min(left);
            let now = path.jerk(from).length();
            // A start from rest has no jerk yet.
            reach(now.max(path.jerk(from + reach(now)).length()))
        };
        self.start.bodies.iter().enumerate().map(of).fold(left, f64::min)
    }

    /// Accelerations (m/s²), by body, of the chord that begins at `from` of the arc and is `h` long, s.
    pub(crate) fn chord_accelerations(&self, from: f64, h: f64) -> Vec<DVec3> {
        (0..self.start.bodies.len()).map(|i| self.polynomial(i).chord_acceleration(from, h)).collect()
    }

    /// The path of body `i`.
    fn polynomial(&self, i: usize) -> Hermite {
        let (start, end, h) = (&self.start.bodies[i], &self.end.bodies[i], self.span);
        let a = self.start.a[i];
        if h == 0.0 {
            return Hermite { x: start.x, v: start.v, a, b: [DVec3::ZERO; 3], span: 1.0 };
        }
        if self.order == Order::Three {
            // not from the ends, whose rounding over so short a time would be far more than that of v
            let b = [(self.end.a[i] - a) * (h * h / 6.0), DVec3::ZERO, DVec3::ZERO];
            return Hermite { x: start.x, v: start.v, a, b, span: h };
        }
        // What the end leaves to the cubic and higher powers, all as lengths.
        let dx = end.x - start.x - (start.v + a * (0.5 * h)) * h;
        let dv = (end.v - start.v - a * h) * h;
        let da = (self.end.a[i] - a) * (h * h);
        let b = [dx * 10.0 - dv * 4.0 + da * 0.5, dv * 7.0 - dx * 15.0 - da, dx * 6.0 - dv * 3.0 + da * 0.5];
        Hermite { x: start.x, v: start.v, a, b, span: h }
    }

    /// Ends the arc where a contact changes first, as far as these fractions of it show, [`OVERSHOOT`] of it late.
    fn cut_short(&mut self, motion: &ConstrainedMotion, looks: &[f64]) {
        let before = motion.marks(&self.start.bodies, &self.start.a);
        let margin = |time: f64| motion.distance_to_change(&self.at(time), &before);
        let mut good = (0.0, f64::INFINITY);
        for share in looks {
            let look = (share * self.span, margin(share * self.span));
            if look.1 < 0.0 {
                let change = fall_below_zero(&margin, good, look, 0.25 * OVERSHOOT * self.span);
                self.length = (change + OVERSHOOT * self.span).min(self.span);
                self.changes = true;
                return;
            }
            good = look;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Parallelogram;
    use crate::physics::events::curved::bodies::{On, geometry};
    use crate::physics::support::{Bodies, Resting, accelerations};
    use crate::physics::wall::{Face, Part};
    use crate::physics::wall_parts::room;

    const G: f64 = 9.8;

    fn floor() -> Face {
        Face::new(Parallelogram { center: DVec3::ZERO, s1: DVec3::X * 2.0, s2: DVec3::NEG_Z * 2.0 })
    }

    fn sphere(x: DVec3, v: DVec3) -> Body {
        Body { x, v, applied: DVec3::NEG_Y * G, inverse_mass: 0.5, r: 0.5, healed: 5e-11 }
    }

    /// Which contacts carry a load now.
    fn loaded(bodies: &[Body], contacts: &[Closed]) -> Vec<bool> {
        let inverse_mass: Vec<f64> = bodies.iter().map(|body| body.inverse_mass).collect();
        let (velocity, applied): (Vec<DVec3>, Vec<DVec3>) = bodies.iter().map(|body| (body.v, body.applied)).unzip();
        let all = Bodies { inverse_mass: &inverse_mass, velocity: &velocity, applied: &applied };
        let resting: Vec<Resting> = contacts.iter().map(|&contact| geometry(bodies, contact).0).collect();
        accelerations(all, &resting, &[]).multipliers.iter().map(|&force| force > 0.0).collect()
    }

    fn arc(bodies: Vec<Body>, contacts: &[Closed]) -> Arc {
        let loaded = loaded(&bodies, contacts);
        let a = ConstrainedMotion::held_by(&bodies, contacts, &loaded).accelerations(&bodies).0;
        Arc::new(bodies, a, contacts, loaded)
    }

    /// Half the energy per mass, relative to that of the level of the contact.
    fn energy(body: &Body, level: f64) -> f64 {
        0.5 * body.v.length_squared() + G * (body.x.y - level)
    }

    /// Goes on until a contact changes; how long that took, s, and in how many steps.
    fn until_change(bodies: &mut [Body], contacts: &[Closed]) -> (f64, u32) {
        let mut arc = arc(bodies.to_vec(), contacts);
        let mut time = 0.0;
        for count in 1..1_000_000 {
            time += arc.length;
            bodies.copy_from_slice(&arc.at(arc.length));
            if arc.changes {
                return (time, count);
            }
            arc = arc.go_on(contacts);
        }
        panic!("nothing changes: {bodies:?}");
    }

    /// An edge of the floor seen along itself: 1 is the one at x = 1, its direction −z.
    fn on_edge(angle: (f64, f64)) -> Body {
        let (sin, cos) = angle;
        sphere(DVec3::new(1.0 + 0.5 * sin, 0.5 * cos, 0.0), DVec3::ZERO)
    }

    #[test]
    fn a_sphere_slides_off_an_edge_at_two_thirds_of_the_height_it_started_from() {
        // N = 0 where v² = g r cos θ, and v² = 2 g r (cos θ₀ − cos θ): cos θ = 2/3 cos θ₀.
        for (sin, cos) in [(0.6, 0.8), (0.28, 0.96), (0.0, 1.0)] {
            let face = floor();
            let edge = (0..4).find(|&k| room(&face, Part::Edge(k), DVec3::new(1.3, 0.4, 0.0)) > 0.0).expect("an edge");
            let mut body = on_edge((sin, cos));
            if sin == 0.0 {
                body.v = DVec3::X * 0.1;
            }
            let began = energy(&body, 0.0);
            let mut bodies = [body];
            let (_, steps) = until_change(&mut bodies, &[Closed { a: 0, on: On::Wall(&face, Part::Edge(edge)) }]);
            let expected = 2.0 / 3.0 * began / (G * 0.5);
            let cosine = bodies[0].x.y / 0.5;
            // The overshoot is 1e-8 of a step of 1e-4 s; rounding of some ten thousand steps adds 1e-13.
            assert!((cosine - expected).abs() < 1e-11, "left at {cosine} instead of {expected} after {steps} steps");
            let error = energy(&bodies[0], 0.0) / began - 1.0;
            assert!(error.abs() < 1e-12, "energy changed by {error:e} in {steps} steps");
            let gap = (bodies[0].x - DVec3::X).length() - 0.5;
            assert!(gap.abs() < 1e-15, "gap {gap:e}");
        }
    }

    #[test]
    fn a_sphere_slides_off_a_corner_like_off_an_edge() {
        let face = floor();
        let corner = face.shape.corners()[2];
        let outward = (corner * 1.0).normalize();
        let mut bodies = [sphere(corner + outward * 0.3 + DVec3::Y * 0.4, DVec3::ZERO)];
        until_change(&mut bodies, &[Closed { a: 0, on: On::Wall(&face, Part::Corner(2)) }]);
        let cosine = bodies[0].x.y / 0.5;
        assert!((cosine - 2.0 / 3.0 * 0.8).abs() < 1e-11, "left at {cosine}");
    }

    #[test]
    fn motion_along_an_edge_does_not_count_as_turning() {
        // Balanced on the edge and sliding along it, 0.7 m before its end: it gets there unbraked.
        let face = floor();
        let edge = (0..4).find(|&k| room(&face, Part::Edge(k), DVec3::new(1.3, 0.4, 0.0)) > 0.0).expect("an edge");
        let start = DVec3::new(1.0, 0.5, 0.3);
        let mut bodies = [sphere(start, DVec3::NEG_Z)];
        let contacts = [Closed { a: 0, on: On::Wall(&face, Part::Edge(edge)) }];
        let (time, _) = until_change(&mut bodies, &contacts);
        assert!((time - 1.3).abs() < 1e-11, "{time}");
        assert!((bodies[0].v - DVec3::NEG_Z).length() < 1e-14, "{}", bodies[0].v);
    }

    #[test]
    fn a_sphere_sliding_off_an_equal_one_on_a_smooth_floor_keeps_energy_and_momentum() {
        // Both free to move along the floor: leaves at cos³θ − 6 cos θ + 4 cos θ₀ = 0 for equal masses.
        let face = floor();
        let (sin, cos) = (0.28, 0.96);
        let mut bodies =
            [sphere(DVec3::new(0.0, 0.5, 0.0), DVec3::ZERO), sphere(DVec3::new(sin, 0.5 + cos, 0.0), DVec3::ZERO)];
        let contacts = [Closed { a: 0, on: On::Wall(&face, Part::Face) }, Closed { a: 1, on: On::Body(0) }];
        until_change(&mut bodies, &contacts);
        let cosine = bodies[1].x.y - bodies[0].x.y;
        let left = cosine * cosine * cosine - 6.0 * cosine + 4.0 * cos;
        assert!(left.abs() < 1e-10, "left at {cosine}: {left:e}");
        let total = bodies.iter().map(|body| energy(body, 0.5)).sum::<f64>() - G * cos;
        assert!(total.abs() < 1e-12, "energy changed by {total:e}");
        assert!((bodies[0].v.x + bodies[1].v.x).abs() < 1e-12, "momentum changed");
    }

    #[test]
    fn chords_and_arcs_stay_within_their_departure_of_the_path() {
        let face = floor();
        let contacts = [Closed { a: 0, on: On::Wall(&face, Part::Corner(2)) }];
        let corner = face.shape.corners()[2];
        let start = vec![sphere(corner + DVec3::new(0.18, 0.4, -0.24), DVec3::ZERO)];
        let mut arc = arc(start.clone(), &contacts);
        let motion = ConstrainedMotion::held_by(&start, &contacts, &loaded(&start, &contacts));
        for _ in 0..5 {
            let mut from = 0.0;
            while from < arc.length {
                let h = arc.chord(from);
                let (one, two) = (arc.at(from)[0], arc.at(from + h)[0]);
                let a = (two.x - one.x - one.v * h) * (2.0 / (h * h));
                for share in [0.25, 0.5, 2.0 / 3.0, 0.9] {
                    let s = share * h;
                    let chord = one.x + one.v * s + a * (0.5 * s * s);
                    let real = motion.step_rkf8(arc.start.moving(), from + s)[0].x;
                    // 5e-13 of a radius of 0.5 m; and, of the arc, 1e-15 of coordinates below 1.3 m.
                    assert!(chord.distance(real) < 0.27e-12, "{:e}", chord.distance(real));
                    assert!(arc.at(from + s)[0].x.distance(real) < 2e-15);
                }
                from += h;
            }
            arc = arc.go_on(&contacts);
        }
    }

    #[test]
    fn what_is_read_of_an_arc_is_as_good_as_integrated() {
        let face = floor();
        let contacts = [Closed { a: 0, on: On::Wall(&face, Part::Corner(2)) }];
        let v = DVec3::new(0.3, 0.0, 0.1);
        let start = vec![sphere(face.shape.corners()[2] + DVec3::new(0.18, 0.4, -0.24), v)];
        let contact = geometry(&start, contacts[0]).0;
        let start = vec![Body { v: v - contact.normal * contact.normal.dot(v), ..start[0] }];
        let briefest = arc(start, &contacts);
        let brief = briefest.go_on(&contacts);
        let long = brief.go_on(&contacts);
        assert_eq!([briefest.order, brief.order, long.order], [Order::Three, Order::Four, Order::Eight]);
        for arc in [briefest, brief, long] {
            let motion = ConstrainedMotion::held_by(&arc.start.bodies, &contacts, &arc.loaded);
            for share in [1e-9, 1e-6, 0.99 * BEGINNING, 0.3, 1.0] {
                let time = share * arc.span;
                let (read, real) = (arc.real(time, &contacts)[0], motion.step_rkf8(arc.start.moving(), time)[0]);
                // An ulp or two of places below 1.3 m and of speeds below 1 m/s; and what the lowest order leaves of v.
                let unit = arc.start.bodies[0].r / arc.start.time_scale();
                let grown = if arc.order == Order::Three { 1e-13 * unit * share * share } else { 0.0 };
                assert!(read.x.distance(real.x) <= 5e-16, "{:?} {share}: {:e} m", arc.order, read.x.distance(real.x));
                assert!(
                    read.v.distance(real.v) <= 5e-16 + grown,
                    "{:?} {share}: {:e} m/s",
                    arc.order,
                    read.v.distance(real.v)
                );
            }
        }
    }

    #[test]
    fn shorter_arcs_change_nothing_beyond_rounding() {
        let face = floor();
        let contacts = [Closed { a: 0, on: On::Wall(&face, Part::Corner(2)) }];
        let corner = face.shape.corners()[2];
        let begin = vec![sphere(corner + DVec3::new(0.18, 0.4, -0.24), DVec3::ZERO)];
        let motion = ConstrainedMotion::held_by(&begin, &contacts, &loaded(&begin, &contacts));
        let step = |on: Vec<Body>, h: f64| motion.step_rkf8((&on, &motion.accelerations(&on).0), h);
        let go = |parts: u32| (0..parts).fold(begin.clone(), |on, _| step(on, 0.1 / f64::from(parts)))[0];
        let (few, many) = (go(10), go(1000));
        // Each of a thousand steps rounds to 1e-16; the error of ten steps of order 8 is below that.
        assert!(few.x.distance(many.x) < 1e-13 && few.v.distance(many.v) < 1e-12, "{few:?} {many:?}");
    }
}
