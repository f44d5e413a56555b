//! Curved rest: spheres that slide over an edge, over a corner or over each other have no parabola. They are integrated
//! to 1e-12, and the time spent so is counted as not exact.
//!
//! While the same contacts hold, they are equations, J a + k = 0, and the motion is an ordinary differential equation in
//! x and v, solved by the classical method of Runge and Kutta (order 4). After each step x and v are put back on the
//! contacts. The step is bounded by something else than the order: between the ends of a step everybody else sees the
//! chord parabola x₀ + v₀ s + a s²/2 with a = 2 (x_h − x₀ − v₀ h)/h², whose departure from the true path, |jerk| h³/40,
//! must stay below [`DEPARTURE`] of the radius, so that contact times with other bodies are predicted as in flight. At
//! such steps (some 1e-4 of the time scale) the error of the integration is far below rounding.

use glam::DVec3;

use super::super::contact_time::{Part, edge_direction, touch_part};
use super::super::model::Face;
use super::super::support::{Bodies, Resting, Row, Surface, accelerations, bind};
use crate::physics::parts::room;

/// How far the chord parabola may be from the path, in radii.
const DEPARTURE: f64 = 1e-13;

/// Longest step, in units of the time in which the motion changes: bounds the departure where the jerk is 0 only for an
/// instant (a start from rest), by |x⁗| h⁴/50.
const LONGEST: f64 = 1e-3;

/// By how much of the step a change is overshot, so that it shows beyond rounding: a load of 1e-8 of what it varies by
/// during the step, some 1e-13 s late.
const OVERSHOOT: f64 = 1e-8;

/// How far beyond its border a contact belongs to the next part, in radii: more than rounding, less than matters.
const BORDER: f64 = 1e-12;

/// A body of the island.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Body {
    /// Centre, m.
    pub(super) x: DVec3,
    /// Velocity, m/s.
    pub(super) v: DVec3,
    /// Acceleration by everything but contacts, m/s².
    pub(super) applied: DVec3,
    /// 1/kg.
    pub(super) inverse_mass: f64,
    /// Radius, m.
    pub(super) r: f64,
}

/// What a body of the island touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum On<'a> {
    /// This part of a wall.
    Wall(&'a Face, Part),
    /// Another body of the island.
    Body(usize),
}

/// A closed contact of the island.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Closed<'a> {
    /// The body.
    pub(super) a: usize,
    /// What it touches.
    pub(super) on: On<'a>,
}

/// How `advance` ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Ended {
    /// All of h, every contact still closed and loaded (or idle as before).
    Kept,
    /// After this many seconds a contact opens or changes its part; the bodies are there.
    Changed(f64),
}

/// Proposes a step, s: the longest at which the chord departs from the path by less than 1e-13 of the smallest radius.
/// The contacts are closed (v_n = 0).
pub(super) fn step(bodies: &[Body], contacts: &[Closed]) -> f64 {
    let motion = Motion::of(bodies, contacts);
    let radius = bodies.iter().map(|body| body.r).fold(f64::INFINITY, f64::min);
    let now = motion.accelerations(bodies).0;
    let largest = |of: &dyn Fn(usize) -> DVec3| (0..bodies.len()).map(|i| of(i).length()).fold(0.0, f64::max);
    let pull = largest(&|i| bodies[i].applied).max(largest(&|i| now[i]));
    let longest = LONGEST / (largest(&|i| bodies[i].v) / radius + (pull / radius).sqrt());
    let ahead: Vec<Body> = (bodies.iter().zip(&now))
        .map(|(body, a)| Body {
            x: body.x + (body.v + *a * (0.5 * longest)) * longest,
            v: body.v + *a * longest,
            ..*body
        })
        .collect();
    let then = motion.accelerations(&ahead).0;
    let jerk = largest(&|i| then[i] - now[i]) / longest;
    longest.min(cube_root(40.0 * DEPARTURE * radius / jerk))
}

/// Moves all bodies by `h` (s, no longer than [`step`] proposes) with their contacts kept closed; less if a contact that
/// carries a load stops doing so or changes its part before.
pub(super) fn advance(bodies: &mut [Body], contacts: &[Closed], h: f64) -> Ended {
    let motion = Motion::of(bodies, contacts);
    let start = bodies.to_vec();
    let before = motion.rooms(&start);
    let end = motion.moved(&start, h);
    if motion.margin(&end, &before) >= 0.0 {
        bodies.copy_from_slice(&end);
        return Ended::Kept;
    }
    let time = first_change(h, |time| motion.margin(&motion.moved(&start, time), &before));
    bodies.copy_from_slice(&motion.moved(&start, time));
    Ended::Changed(time)
}

/// When a margin that is below 0 at `h` first is, by bisection, [`OVERSHOOT`] of the step late.
fn first_change(h: f64, margin: impl Fn(f64) -> f64) -> f64 {
    let (mut good, mut bad) = (0.0, h);
    // Twenty-eight halvings are finer than the overshoot.
    for _ in 0..28 {
        let middle = 0.5 * (good + bad);
        if margin(middle) < 0.0 { bad = middle } else { good = middle }
    }
    (bad + OVERSHOOT * h).min(h)
}

/// ∛y for y ≥ 0 (∞ of ∞), by Newton's method from above: with + − × ÷ alone, the same on every machine.
fn cube_root(y: f64) -> f64 {
    if !(y > 0.0 && y.is_finite()) {
        return y;
    }
    let mut root = y.max(1.0);
    // From above every step shrinks by a third at least until it is near: 1e300 takes some six hundred.
    for _ in 0..2000 {
        let next = (2.0 * root + y / (root * root)) / 3.0;
        if next >= root {
            break;
        }
        root = next;
    }
    root
}

/// The differential equation of an island while the contacts that carry a load now go on holding.
struct Motion<'a> {
    holding: Vec<Closed<'a>>,
    inverse_mass: Vec<f64>,
}

impl<'a> Motion<'a> {
    fn of(bodies: &[Body], contacts: &[Closed<'a>]) -> Motion<'a> {
        let inverse_mass: Vec<f64> = bodies.iter().map(|body| body.inverse_mass).collect();
        let velocity: Vec<DVec3> = bodies.iter().map(|body| body.v).collect();
        let applied: Vec<DVec3> = bodies.iter().map(|body| body.applied).collect();
        let all = Bodies { inverse_mass: &inverse_mass, velocity: &velocity, applied: &applied };
        let resting: Vec<Resting> = contacts.iter().map(|&contact| geometry(bodies, contact).0).collect();
        let forces = accelerations(all, &resting, &[]).multipliers;
        let holding =
            contacts.iter().zip(forces).filter(|(_, force)| *force > 0.0).map(|(contact, _)| *contact).collect();
        Motion { holding, inverse_mass }
    }

    /// A row per holding contact; its offset is chosen from (gap in m, k in m/s²).
    fn rows(&self, bodies: &[Body], offset: impl Fn(f64, f64) -> f64) -> Vec<Row> {
        let row = |&contact: &Closed| {
            let (resting, gap) = geometry(bodies, contact);
            let relative = bodies[resting.a].v - resting.b.map_or(DVec3::ZERO, |b| bodies[b].v);
            let curvature = resting.surface.curvature_term(resting.normal, relative);
            Row { a: resting.a, b: resting.b, normal: resting.normal, offset: offset(gap, curvature) }
        };
        self.holding.iter().map(row).collect()
    }

    /// Accelerations, m/s², and forces of the holding contacts, N.
    fn accelerations(&self, bodies: &[Body]) -> (Vec<DVec3>, Vec<f64>) {
        let applied: Vec<DVec3> = bodies.iter().map(|body| body.applied).collect();
        bind(&self.inverse_mass, &applied, &self.rows(bodies, |_, curvature| curvature))
    }

    /// The bodies `h` seconds later.
    fn moved(&self, start: &[Body], h: f64) -> Vec<Body> {
        let by = |time: f64, slope: &[(DVec3, DVec3)]| -> Vec<Body> {
            let moved = |(body, slope): (&Body, &(DVec3, DVec3))| Body {
                x: body.x + slope.0 * time,
                v: body.v + slope.1 * time,
                ..*body
            };
            start.iter().zip(slope).map(moved).collect()
        };
        let slope = |at: &[Body]| -> Vec<(DVec3, DVec3)> {
            at.iter().zip(self.accelerations(at).0).map(|(body, a)| (body.v, a)).collect()
        };
        let one = slope(start);
        let two = slope(&by(0.5 * h, &one));
        let three = slope(&by(0.5 * h, &two));
        let four = slope(&by(h, &three));
        let mean: Vec<_> = (0..start.len())
            .map(|i| {
                let sum = |of: &dyn Fn(&(DVec3, DVec3)) -> DVec3| {
                    (of(&one[i]) + (of(&two[i]) + of(&three[i])) * 2.0 + of(&four[i])) / 6.0
                };
                (sum(&|slope| slope.0), sum(&|slope| slope.1))
            })
            .collect();
        let mut end = by(h, &mean);
        self.restore(&mut end);
        end
    }

    /// Puts the bodies back on the holding contacts by the least change in the metric of the masses: gap = 0, then
    /// J v = 0. The gap left by a step is so small that one step of Newton's method closes it.
    fn restore(&self, bodies: &mut [Body]) {
        let still = vec![DVec3::ZERO; bodies.len()];
        let shift = bind(&self.inverse_mass, &still, &self.rows(bodies, |gap, _| gap)).0;
        bodies.iter_mut().zip(shift).for_each(|(body, shift)| body.x += shift);
        let velocity: Vec<DVec3> = bodies.iter().map(|body| body.v).collect();
        let v = bind(&self.inverse_mass, &velocity, &self.rows(bodies, |_, _| 0.0)).0;
        bodies.iter_mut().zip(v).for_each(|(body, v)| body.v = v);
    }

    /// How far each holding contact is from where another part of its wall takes over, in radii; ∞ for pairs.
    fn rooms(&self, bodies: &[Body]) -> Vec<f64> {
        let of = |contact: &Closed| match contact.on {
            On::Wall(face, part) => room(face, part, bodies[contact.a].x) / bodies[contact.a].r,
            On::Body(_) => f64::INFINITY,
        };
        self.holding.iter().map(of).collect()
    }

    /// The least that is left to any holding contact: load as an acceleration in units of what is applied, or room in
    /// radii. What began at the border or beyond (`before`) counts only if it has gone on outwards, beyond rounding.
    fn margin(&self, bodies: &[Body], before: &[f64]) -> f64 {
        let forces = self.accelerations(bodies).1;
        let pull = bodies.iter().map(|body| body.applied.length()).fold(f64::MIN_POSITIVE, f64::max);
        let loads =
            self.holding.iter().zip(forces).map(|(contact, force)| force * bodies[contact.a].inverse_mass / pull);
        let outwards = |(room, before): (f64, &f64)| room - before.min(0.0) + BORDER;
        let rooms = self.rooms(bodies).into_iter().zip(before).map(outwards);
        loads.chain(rooms).fold(f64::INFINITY, f64::min)
    }
}

/// A contact as `support` sees it, and its gap, m.
pub(super) fn geometry(bodies: &[Body], contact: Closed) -> (Resting, f64) {
    let body = &bodies[contact.a];
    match contact.on {
        On::Wall(face, part) => {
            let touch = touch_part(face, part, body.x, body.r);
            let radius = body.r + touch.gap;
            let surface = match part {
                Part::Face => Surface::Face,
                Part::Edge(k) => Surface::Edge { along: edge_direction(face, k), radius },
                Part::Corner(_) => Surface::Round { radius },
            };
            (Resting { a: contact.a, b: None, normal: touch.normal, surface }, touch.gap)
        }
        On::Body(b) => {
            let arm = body.x - bodies[b].x;
            let radius = arm.length();
            let surface = Surface::Round { radius };
            (Resting { a: contact.a, b: Some(b), normal: arm / radius, surface }, radius - (body.r + bodies[b].r))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Parallelogram;

    const G: f64 = 9.8;

    fn floor() -> Face {
        Face::new(Parallelogram { center: DVec3::ZERO, s1: DVec3::X * 2.0, s2: DVec3::NEG_Z * 2.0 })
    }

    fn sphere(x: DVec3, v: DVec3) -> Body {
        Body { x, v, applied: DVec3::NEG_Y * G, inverse_mass: 0.5, r: 0.5 }
    }

    /// Half the energy per mass, relative to that of the level of the contact.
    fn energy(body: &Body, level: f64) -> f64 {
        0.5 * body.v.length_squared() + G * (body.x.y - level)
    }

    /// Goes on until a contact changes; how long that took, s, and in how many steps.
    fn until_change(bodies: &mut [Body], contacts: &[Closed]) -> (f64, u32) {
        let mut time = 0.0;
        for count in 1..1_000_000 {
            let h = step(bodies, contacts);
            match advance(bodies, contacts, h) {
                Ended::Kept => time += h,
                Ended::Changed(after) => return (time + after, count),
            }
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
    fn the_chord_stays_within_its_departure_of_the_path() {
        let face = floor();
        let contacts = [Closed { a: 0, on: On::Wall(&face, Part::Corner(2)) }];
        let corner = face.shape.corners()[2];
        let mut start = [sphere(corner + DVec3::new(0.18, 0.4, -0.24), DVec3::ZERO)];
        for _ in 0..1000 {
            let h = step(&start, &contacts);
            let mut end = start;
            assert_eq!(advance(&mut end, &contacts, h), Ended::Kept);
            let a = (end[0].x - start[0].x - start[0].v * h) * (2.0 / (h * h));
            for share in [0.25, 0.5, 2.0 / 3.0, 0.9] {
                let mut true_path = start;
                advance(&mut true_path, &contacts, share * h);
                let s = share * h;
                let chord = start[0].x + start[0].v * s + a * (0.5 * s * s);
                // 1e-13 radii and two ulp of the coordinates.
                assert!((chord - true_path[0].x).length() < 1e-13 * 0.5 + 5e-16);
            }
            start = end;
        }
    }

    #[test]
    fn halving_the_steps_changes_nothing_beyond_rounding() {
        let face = floor();
        let contacts = [Closed { a: 0, on: On::Wall(&face, Part::Corner(2)) }];
        let corner = face.shape.corners()[2];
        let begin = [sphere(corner + DVec3::new(0.18, 0.4, -0.24), DVec3::ZERO)];
        let go = |parts: u32| {
            let mut bodies = begin;
            for _ in 0..1000 * parts {
                advance(&mut bodies, &contacts, 1e-4 / f64::from(parts));
            }
            bodies[0]
        };
        let (one, two) = (go(1), go(2));
        // 0.1 s in 1000 steps, each rounded to 1e-16.
        assert!((one.x - two.x).length() < 1e-13 && (one.v - two.v).length() < 1e-12);
    }
}
