//! All that moves: t, x, v; tallies; and why a run cannot go on.

use std::fmt;

use glam::DVec3;

/// Time, positions and velocities. P = m v.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct State {
    /// Time, s.
    pub t: f64,
    /// Centres, m, by sphere index.
    pub x: Vec<DVec3>,
    /// Velocities, m/s, by sphere index.
    pub v: Vec<DVec3>,
}

impl State {
    /// Memory that it takes beside its own size, bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.x) + size_of_val(&*self.v)
    }

    /// 64-bit FNV-1a (standard offset basis and prime) over the little-endian bytes of t, then of x, then of v, in
    /// index order: equal hashes mean equal bits.
    pub fn hash(&self) -> u64 {
        let coordinates = self.x.iter().chain(&self.v).flat_map(|p| p.to_array());
        std::iter::once(self.t)
            .chain(coordinates)
            .flat_map(f64::to_le_bytes)
            .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
    }
}

/// Counted work and outcomes since t = 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tallies {
    /// Frames completed.
    pub frames: u64,
    /// Impacts (`collide` rows).
    pub impacts: u64,
    /// Rests begun.
    pub rests: u64,
    /// Rests ended.
    pub releases: u64,
    /// Degree evaluations (gap computations of one sphere with one wall or sphere).
    pub evaluations: u64,
    /// Trial steps of searches for a collision time.
    pub probes: u64,
    /// Deepest intersection degree at the end of any frame, dimensionless.
    pub deepest_degree: f64,
    /// Time that `exact` spent in curved rest, which it integrates to 1e-12 instead of solving it, s.
    pub inexact_time: f64,
    /// Inelastic collapses: contacts that `exact` lets rest because they struck a thousand times at one instant.
    pub collapses: u64,
    /// Rows that `moreau` solved, one at a time: its counted work beside the degree evaluations.
    pub relaxations: u64,
    /// Frames whose complementarity problem `moreau`'s solver left unsolved: their contacts must not be trusted.
    pub unconverged: u64,
}

/// Largest coordinate (m), speed (m/s) and acceleration (m/s²) with which a run goes on: their fourth powers, of which
/// contact times are made, are still numbers.
pub const LARGEST: f64 = 1e75;

/// The one place where motion that is no number, or runs away beyond [`LARGEST`], is found and ends a run: nothing, or the
/// sphere, the time (s) and the `cause`, which goes on after a colon. It is asked of all spheres before a method begins,
/// and by each method where it has changed a motion.
#[inline(always)]
pub(super) fn runaway(sphere: usize, t: f64, [x, v]: [DVec3; 2], cause: &str) -> Option<Stall> {
    let held = |u: DVec3| (u.x.abs() <= LARGEST) & (u.y.abs() <= LARGEST) & (u.z.abs() <= LARGEST);
    if held(x) & held(v) { None } else { Some(ran_away(sphere, t, [x, v], cause)) }
}

#[cold]
fn ran_away(sphere: usize, t: f64, [x, v]: [DVec3; 2], cause: &str) -> Stall {
    let vector = |u: DVec3| format!("({:e}, {:e}, {:e})", u.x, u.y, u.z);
    let reason = format!(
        "Sphere {sphere} leaves the range of numbers, {LARGEST:e}, at t = {t} s with x = {} m, v = {} m/s: {cause}.",
        vector(x),
        vector(v)
    );
    Stall { time: t, kind: StallKind::NotFinite, reason }
}

/// Why a run cannot go on.
#[derive(Debug, Clone, PartialEq)]
pub struct Stall {
    /// Time of the stall, s.
    pub time: f64,
    /// What kind of stall it is.
    pub kind: StallKind,
    /// A full sentence for people: where, why, and what to try.
    pub reason: String,
}

impl Stall {
    /// At `time` (s) the clock is so far on that a step of `dt` (s) rounds to none.
    pub(super) fn step_too_small(time: f64, dt: f64) -> Stall {
        let reason = format!("At t = {time} s a step of {dt} s is too small to change the time; take a larger dt.");
        Stall { time, kind: StallKind::StepTooSmall, reason }
    }
}

/// The kinds of stall. Each displays as the word of `stall=…`, e.g. `resting-contact`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StallKind {
    /// A step changes the time by less than one ulp.
    StepTooSmall,
    /// A step leads too many spheres past each other.
    StepTooLarge,
    /// A position or velocity leaves the range of numbers.
    NotFinite,
    /// Events went on and on at one time.
    NoProgress,
    /// The support forces of resting contacts could not be found, or do not hold.
    RestingContact,
    /// Slow impacts come back before they have left the overlap that is accepted.
    SlowBounce,
}

impl fmt::Display for StallKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            StallKind::StepTooSmall => "step-too-small",
            StallKind::StepTooLarge => "step-too-large",
            StallKind::NotFinite => "not-finite",
            StallKind::NoProgress => "no-progress",
            StallKind::RestingContact => "resting-contact",
            StallKind::SlowBounce => "slow-bounce",
        })
    }
}
