//! The differential equation of an island of resting contacts, and one step of Runge, Kutta and Fehlberg along it.

use glam::DVec3;

use super::bodies::{Body, Closed, On, geometry};
use crate::physics::events::rounding::{BRUSH, SUM};
use crate::physics::support::{Row, Short, bind, restore, restore_both, restore_places, restore_unmet};
use crate::physics::wall_parts::{BORDER, room};

/// How fast an idle contact may close, in units of the applied acceleration, before its island is settled anew: more than
/// rounding, and less than moves anything by 1e-14 m during an arc.
const IDLE: f64 = 1e-11;

/// How fast an idle contact may open, in units of the applied acceleration, before it must let go: a contact that opens by
/// no more than the acceleration of a chord is off would be met again at once.
pub(crate) const BARELY: f64 = 1e-3;

/// How far an idle contact may open, in radii, before it must let go: so far that the chords, which depart from the path by
/// a hundredth of that, do not meet it again, and so little that it may carry again as it is.
pub(crate) const OPENED: f64 = 5e-11;

/// How far an idle contact may sink in, in radii, before its island is settled anew: where the normals of two contacts are
/// nearly parallel, rounding decides which of them carries, and the other closes more slowly than its acceleration shows.
const SUNK: f64 = 1e-13;

/// How far a body may be moved to put gaps right, in units of the widest of them; else the rows of which less than the
/// inverse of this is new are left as they are. Three spheres that just fit between two walls, 1e-5 rad off their line,
/// would move by a hundred thousand times what rounding has left of their gaps, into others.
const LEVER: f64 = 1e3;

/// How an arc is integrated: the shorter it is, the lower the order that is exact to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    /// Integrated by accelerations that grow evenly from its beginning to its end, without steps.
    Three,
    /// Integrated by the classical method of Runge and Kutta.
    Four,
    /// Integrated by the method of Runge, Kutta and Fehlberg.
    Eight,
}

/// The differential equation of an island while the contacts that carry a load now go on holding.
pub(crate) struct ConstrainedMotion<'a> {
    holding: Short<Closed<'a>>,
    /// The gaps to keep, m: what rounding, or the scene, has left of 0. Nothing must jump, but of small overlaps half is
    /// healed by every arc: where a contact opens and closes over and over, they would add up.
    gaps: Short<f64>,
    /// By how much the gaps to keep differ at most from those of now, m.
    pub(super) healed: f64,
    /// Contacts that stay closed without carrying anything.
    idle: Short<Closed<'a>>,
    inverse_mass: Short<f64>,
}

impl<'a> ConstrainedMotion<'a> {
    /// The motion from `bodies` on while the loaded contacts hold.
    pub(crate) fn held_by(bodies: &[Body], contacts: &[Closed<'a>], loaded: &[bool]) -> ConstrainedMotion<'a> {
        let pick = |wanted: bool| {
            let of = |(_, loaded): &(&Closed<'a>, &bool)| **loaded == wanted;
            contacts.iter().zip(loaded).filter(of).map(|(&contact, _)| contact).collect()
        };
        let (holding, idle): (Short<Closed<'a>>, _) = (pick(true), pick(false));
        let kept = |contact: &Closed| {
            let gap = geometry(bodies, *contact).1;
            let heals = if gap < 0.0 && gap > -bodies[contact.a].healed { -0.5 * gap } else { 0.0 };
            (gap + heals, heals)
        };
        let (gaps, healed): (Short<f64>, Short<f64>) = holding.iter().map(kept).unzip();
        let healed = healed.iter().copied().fold(0.0, f64::max);
        let inverse_mass = bodies.iter().map(|body| body.inverse_mass).collect();
        ConstrainedMotion { holding, gaps, healed, idle, inverse_mass }
    }

    /// A row per holding contact; its offset is chosen from (gap in m, k in m/s²).
    fn rows(&self, bodies: &[Body], offset: impl Fn(f64, f64) -> f64) -> Short<Row> {
        self.holding.iter().map(|&contact| row(bodies, contact, &offset)).collect()
    }

    /// Accelerations, m/s², and forces of the holding contacts, N.
    pub(crate) fn accelerations(&self, bodies: &[Body]) -> (Vec<DVec3>, Vec<f64>) {
        let applied: Short<DVec3> = bodies.iter().map(|body| body.applied).collect();
        bind(&self.inverse_mass, &applied, &self.rows(bodies, |_, curvature| curvature))
    }

    /// The bodies `h` seconds later, which accelerate by `a` (m/s²) now.
    pub(crate) fn step_rkf8(&self, start: (&[Body], &[DVec3]), h: f64) -> Vec<Body> {
        self.result(start.0, h, &self.slopes(start, h, &STAGES), &ORDER_8)
    }

    /// The bodies `h` seconds later, which accelerate by `a` (m/s²) now, and their accelerations on the way, by share of `h`.
    pub(crate) fn seen_rkf8(&self, start: (&[Body], &[DVec3]), h: f64) -> (Vec<Body>, [(f64, Vec<DVec3>); 4]) {
        let slopes = self.slopes(start, h, &STAGES);
        let seen = INSIDE.map(|(stage, share)| (share, slopes[stage].iter().map(|slope| slope.1).collect()));
        (self.result(start.0, h, &slopes, &ORDER_8), seen)
    }

    /// The bodies `h` seconds later, which accelerate by `a` (m/s²) now, by the classical method of Runge and Kutta, for so
    /// small a step that its error of order h⁵ is far below rounding.
    pub(crate) fn step_rk4(&self, start: (&[Body], &[DVec3]), h: f64) -> Vec<Body> {
        self.result(start.0, h, &self.slopes(start, h, &CLASSICAL), &ORDER_4)
    }

    /// Velocities and accelerations, m/s and m/s², by stage and body, by the weights of all stages but the first, which is the
    /// start itself.
    fn slopes(&self, (start, a): (&[Body], &[DVec3]), h: f64, stages: &[&[f64]]) -> Vec<Slopes> {
        let mut slopes: Vec<Slopes> = Vec::with_capacity(stages.len() + 1);
        slopes.push(start.iter().zip(a).map(|(body, a)| (body.v, *a)).collect());
        for weights in stages {
            let at = weighted(start, h, weights, &slopes);
            let a = self.accelerations(&at).0;
            slopes.push(at.iter().zip(a).map(|(body, a)| (body.v, a)).collect());
        }
        slopes
    }

    /// The bodies `h` seconds later by the weights of all stages, back on the holding contacts.
    fn result(&self, start: &[Body], h: f64, slopes: &[Slopes], weights: &[f64]) -> Vec<Body> {
        let mut end = weighted(start, h, weights, slopes);
        self.restore(&mut end);
        end
    }

    /// Puts the bodies back on the holding contacts by the least change in the metric of the masses: gaps as they were,
    /// J v = 0. The gap left by a step is so small that one step of Newton's method closes it.
    pub(crate) fn restore(&self, bodies: &mut [Body]) {
        let velocity: Short<DVec3> = bodies.iter().map(|body| body.v).collect();
        let mut rows = self.rows(bodies, |gap, _| gap);
        rows.iter_mut().zip(&self.gaps).for_each(|(row, gap)| row.offset -= gap);
        let (mut shift, v) = restore_both(&self.inverse_mass, &velocity, &rows);
        let off = rows.iter().map(|row| row.offset.abs()).fold(0.0, f64::max);
        let is_far = |(body, shift): (&Body, &DVec3)| shift.length() > body.finest().max(LEVER * off);
        if bodies.iter().zip(&shift).any(is_far) {
            shift = restore_places(&self.inverse_mass, &rows, 1.0 / LEVER);
        }
        for (body, (shift, v)) in bodies.iter_mut().zip(shift.into_iter().zip(v)) {
            (body.x, body.v) = (body.x + shift, v);
        }
        self.close_unmet(bodies, &rows);
    }

    /// Puts the velocities back on the holding contacts: J v = 0.
    pub(crate) fn restore_velocities(&self, bodies: &mut [Body]) {
        let velocity: Short<DVec3> = bodies.iter().map(|body| body.v).collect();
        let rows = self.rows(bodies, |_, _| 0.0);
        let v = restore(&self.inverse_mass, &velocity, &rows);
        bodies.iter_mut().zip(v).for_each(|(body, v)| body.v = v);
        self.close_unmet(bodies, &rows);
    }

    /// Closes the rows of velocities just restored that were left out as nearly dependent, where their loads would work:
    /// next to where spheres just fit, loads of 1e9 N make much of what rounding leaves of a normal velocity.
    fn close_unmet(&self, bodies: &mut [Body], rows: &[Row]) {
        let velocity: Short<DVec3> = bodies.iter().map(|body| body.v).collect();
        let v_n = |row: &Row, v: &[DVec3]| row.normal.dot(v[row.a] - row.b.map_or(DVec3::ZERO, |b| v[b])).abs();
        let fastest = velocity.iter().map(|v| v.length_squared()).fold(0.0, f64::max).sqrt();
        if rows.iter().all(|row| v_n(row, &velocity) <= BRUSH * fastest) {
            return;
        }
        let (forces, power) = (self.accelerations(bodies).1, power(bodies));
        let unmet = |index: usize, v: &[DVec3]| forces[index] * v_n(&rows[index], v) > SUM * power;
        let level: Short<Row> = rows.iter().map(|row| Row { offset: 0.0, ..*row }).collect();
        let v = restore_unmet(&self.inverse_mass, &velocity, &level, unmet);
        bodies.iter_mut().zip(v).for_each(|(body, v)| body.v = v);
    }

    /// Rooms, openings and gaps of idle contacts now, from which later margins are measured; `a` are the bodies'
    /// accelerations, m/s².
    pub(crate) fn marks(&self, bodies: &[Body], a: &[DVec3]) -> Marks {
        let openings = self.openings(bodies, a);
        Marks { rooms: self.rooms(bodies), openings, gaps: self.idle_gaps(bodies) }
    }

    /// Distance of each contact, holding ones before idle ones, from where another part of its wall takes over, in radii;
    /// ∞ for pairs. An idle contact counts too: on the edge that two walls share, the one that carries nothing takes over
    /// when the sphere rolls on to its face.
    pub(crate) fn rooms(&self, bodies: &[Body]) -> Short<f64> {
        let of = |contact: &Closed| match contact.on {
            On::Wall(face, part) => room(face, part, bodies[contact.a].x) / bodies[contact.a].r,
            On::Body(_) => f64::INFINITY,
        };
        self.holding.iter().chain(&self.idle).map(of).collect()
    }

    /// Gaps of the idle contacts, in radii.
    fn idle_gaps(&self, bodies: &[Body]) -> Short<f64> {
        self.idle.iter().map(|&contact| geometry(bodies, contact).1 / bodies[contact.a].r).collect()
    }

    /// J a + k of the idle contacts, in units of the applied acceleration.
    pub(crate) fn openings(&self, bodies: &[Body], a: &[DVec3]) -> Short<f64> {
        let of = |&contact: &Closed| {
            let row = row(bodies, contact, &|_, curvature| curvature);
            let relative = a[row.a] - row.b.map_or(DVec3::ZERO, |b| a[b]);
            (row.normal.dot(relative) + row.offset) / pull(bodies)
        };
        self.idle.iter().map(of).collect()
    }

    /// The least that is left before something changes: load as an acceleration in units of what is applied; room in
    /// radii, where what began at the border or beyond counts only if it has gone on outwards, beyond rounding; what an
    /// idle contact may still open or close.
    pub(crate) fn distance_to_change(&self, bodies: &[Body], before: &Marks) -> f64 {
        let (a, forces) = self.accelerations(bodies);
        self.margin(bodies, (&a, &forces), before)
    }

    /// The least that is left before something changes, as [`ConstrainedMotion::distance_to_change`] tells, of bodies whose
    /// accelerations (m/s²) and forces of the holding contacts (N) are known.
    pub(crate) fn margin(&self, bodies: &[Body], (a, forces): (&[DVec3], &[f64]), before: &Marks) -> f64 {
        let loads = self.holding.iter().zip(forces).zip(self.rounding(forces));
        let loads = loads
            .map(|((contact, force), rounding)| (force + rounding) * bodies[contact.a].inverse_mass / pull(bodies));
        let outwards = |(room, before): (f64, &f64)| room - before.min(0.0) + BORDER;
        let rooms = self.rooms(bodies).into_iter().zip(&before.rooms).map(outwards);
        let openings = self.openings(bodies, a).into_iter().zip(&before.openings);
        let idle = openings.map(|(opening, before)| {
            let closing = IDLE + opening - before.min(0.0);
            closing.min(BARELY + before.max(0.0) - opening)
        });
        // what has sunk in sinks no farther, or arc by arc it would go on
        let least = |before: f64, body: &Body| (-SUNK).min(before - body.finest() / body.r);
        let sunk = |((gap, before), contact): ((f64, &f64), &Closed)| {
            (gap - least(*before, &bodies[contact.a])).min(OPENED + before.max(0.0) - gap)
        };
        let gaps = self.idle_gaps(bodies).into_iter().zip(&before.gaps).zip(&self.idle).map(sunk);
        loads.chain(rooms).chain(idle).chain(gaps).fold(f64::INFINITY, f64::min)
    }

    /// Rounding of the loads of the holding contacts, N: of the largest that both bodies of a contact bear. A load of no more
    /// than that falls below 0 again and again, and the arc would be over as it begins.
    fn rounding(&self, forces: &[f64]) -> Short<f64> {
        let mut most: Short<f64> = Short::from_elem(0.0, self.inverse_mass.len());
        for (contact, force) in self.holding.iter().zip(forces) {
            for body in contact.spheres() {
                most[body] = force.max(most[body]);
            }
        }
        let bears = |contact: &Closed| contact.spheres().map(|body| most[body]).fold(f64::INFINITY, f64::min);
        self.holding.iter().map(|contact| BRUSH * bears(contact)).collect()
    }
}

/// Rooms, openings and gaps of idle contacts at the beginning of an arc.
pub(crate) struct Marks {
    rooms: Short<f64>,
    openings: Short<f64>,
    gaps: Short<f64>,
}

/// Largest applied acceleration, m/s²: the unit of loads.
pub(crate) fn pull(bodies: &[Body]) -> f64 {
    bodies.iter().map(|body| body.applied.length()).fold(f64::MIN_POSITIVE, f64::max)
}

/// What may change the energy of an island, W: Σ m (|applied| + v²/r) |v|.
pub(crate) fn power(bodies: &[Body]) -> f64 {
    let of =
        |body: &Body| (body.applied.length() + body.v.length_squared() / body.r) * body.v.length() / body.inverse_mass;
    bodies.iter().map(of).sum()
}

/// A contact as a row; its offset is chosen from (gap in m, k in m/s²).
fn row(bodies: &[Body], contact: Closed, offset: &impl Fn(f64, f64) -> f64) -> Row {
    let (resting, gap) = geometry(bodies, contact);
    let relative = bodies[resting.a].v - resting.b.map_or(DVec3::ZERO, |b| bodies[b].v);
    let curvature = resting.surface.curvature_term(resting.normal, relative);
    Row { a: resting.a, b: resting.b, normal: resting.normal, offset: offset(gap, curvature) }
}

/// Velocities (m/s) and accelerations (m/s²) of the bodies at one stage of a step.
type Slopes = Vec<(DVec3, DVec3)>;

/// The start moved on by h Σ wᵢ kᵢ.
fn weighted(start: &[Body], h: f64, weights: &[f64], slopes: &[Slopes]) -> Vec<Body> {
    let moved = |(i, body): (usize, &Body)| {
        let (mut dx, mut dv) = (DVec3::ZERO, DVec3::ZERO);
        for (&weight, slopes) in weights.iter().zip(slopes).filter(|(weight, _)| **weight != 0.0) {
            dx += slopes[i].0 * weight;
            dv += slopes[i].1 * weight;
        }
        Body { x: body.x + dx * h, v: body.v + dv * h, ..*body }
    };
    start.iter().enumerate().map(moved).collect()
}

/// Weights of the stages of the classical method but the first, each over the stages before it.
const CLASSICAL: [&[f64]; 3] = [&[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]];

/// Weights of the result of the classical method.
const ORDER_4: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

/// Weights of the stages of RKF 7(8) but the first, each over the stages before it.
const STAGES: [&[f64]; 12] = [
    &[2.0 / 27.0],
    &[1.0 / 36.0, 1.0 / 12.0],
    &[1.0 / 24.0, 0.0, 1.0 / 8.0],
    &[5.0 / 12.0, 0.0, -25.0 / 16.0, 25.0 / 16.0],
    &[1.0 / 20.0, 0.0, 0.0, 1.0 / 4.0, 1.0 / 5.0],
    &[-25.0 / 108.0, 0.0, 0.0, 125.0 / 108.0, -65.0 / 27.0, 125.0 / 54.0],
    &[31.0 / 300.0, 0.0, 0.0, 0.0, 61.0 / 225.0, -2.0 / 9.0, 13.0 / 900.0],
    &[2.0, 0.0, 0.0, -53.0 / 6.0, 704.0 / 45.0, -107.0 / 9.0, 67.0 / 90.0, 3.0],
    &[-91.0 / 108.0, 0.0, 0.0, 23.0 / 108.0, -976.0 / 135.0, 311.0 / 54.0, -19.0 / 60.0, 17.0 / 6.0, -1.0 / 12.0],
    &[
        2383.0 / 4100.0,
        0.0,
        0.0,
        -341.0 / 164.0,
        4496.0 / 1025.0,
        -301.0 / 82.0,
        2133.0 / 4100.0,
        45.0 / 82.0,
        45.0 / 164.0,
        18.0 / 41.0,
    ],
    &[3.0 / 205.0, 0.0, 0.0, 0.0, 0.0, -6.0 / 41.0, -3.0 / 205.0, -3.0 / 41.0, 3.0 / 41.0, 6.0 / 41.0, 0.0],
    &[
        -1777.0 / 4100.0,
        0.0,
        0.0,
        -341.0 / 164.0,
        4496.0 / 1025.0,
        -289.0 / 82.0,
        2193.0 / 4100.0,
        51.0 / 82.0,
        33.0 / 164.0,
        12.0 / 41.0,
        0.0,
        1.0,
    ],
];

/// Weights of the result of order 8.
const ORDER_8: [f64; 13] = [
    0.0,
    0.0,
    0.0,
    0.0,
    0.0,
    34.0 / 105.0,
    9.0 / 35.0,
    9.0 / 35.0,
    9.0 / 280.0,
    9.0 / 280.0,
    0.0,
    41.0 / 840.0,
    41.0 / 840.0,
];

/// Stages inside the step but in its middle whose weight in the result is not 0, and when they are, in steps.
const INSIDE: [(usize, f64); 4] = [(7, 1.0 / 6.0), (9, 1.0 / 3.0), (8, 2.0 / 3.0), (6, 5.0 / 6.0)];
