//! Bounces on a wall that rubs, summed up: what they leave of a tangential velocity once they are over, or where something
//! else strikes the sphere meanwhile.

use glam::DVec3;

use super::bounce_series::{Bounces, Ending};

/// What bounces that were summed up do to the tangential velocity of a sphere. Until they are over it goes on with their
/// mean velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rub {
    /// The bounces; without `pull` where other contacts decide how the sphere is pulled.
    bounces: Bounces,
    /// When the bounces began, s.
    began: f64,
    /// The end of the bounces.
    ending: Ending,
    /// The velocity that the sphere was given when the bounces began, m/s.
    mean: DVec3,
    /// How the mean velocity changes if nothing else happens, m/s².
    drift: DVec3,
    /// Share of the acceleration along the face that acts until the bounces are over.
    pub(crate) share: f64,
}

impl Rub {
    /// Bounces from `began` (s) on, over which a sphere moves at `mean` (m/s), changed by a `share` of `pull` (m/s²).
    pub(crate) fn new(bounces: Bounces, ending: Ending, began: f64, mean: DVec3, (pull, share): (DVec3, f64)) -> Rub {
        Rub { bounces, began, ending, mean, drift: pull * share, share }
    }

    /// Whether the bounces have begun by `time`, s.
    pub(crate) fn has_begun(&self, time: f64) -> bool {
        self.began <= time
    }

    /// The velocity (m/s) after the bounces on a face with this normal, from the one that it had come to.
    pub(crate) fn end(&self, v: DVec3, normal: DVec3) -> DVec3 {
        let across = normal * normal.dot(v);
        let expected = self.mean + self.drift * self.ending.after;
        across + self.ending.slip + (v - across - expected) * self.ending.keeps
    }

    /// The velocity (m/s) at `time` (s), when something else strikes the sphere: that after the last bounce before, and
    /// what pulls it since; from the one that it had come to. What is `applied` (m/s²) has worked along the way that it was
    /// shown to go, which the speed allows for.
    pub(crate) fn interrupt(&self, v: DVec3, normal: DVec3, time: f64, applied: DVec3) -> DVec3 {
        let elapsed = time - self.began;
        let at = self.bounces.at(elapsed);
        // where other contacts decide how it is pulled, that has moved and changed it in either way
        let changed = if self.bounces.pull == DVec3::ZERO { DVec3::ZERO } else { self.drift * elapsed };
        let across = normal * normal.dot(v);
        let real = at.slip + (v - across - self.mean - changed) * at.keeps + normal * at.speed;
        let ahead = at.way - (self.mean + changed * 0.5) * elapsed;
        let square = real.length_squared();
        let share = 1.0 - 2.0 * applied.dot(ahead) / square.max(f64::MIN_POSITIVE);
        real * share.max(0.0).sqrt()
    }

    /// How much more energy by unit of mass (m²/s²) the bounces have at `time` (s) than the velocity `v` (m/s) shows.
    pub(crate) fn hidden_energy(&self, v: DVec3, normal: DVec3, time: f64, applied: DVec3) -> f64 {
        0.5 * (self.interrupt(v, normal, time, applied).length_squared() - v.length_squared())
    }
}
