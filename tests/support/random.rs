//! Random cases that are the same everywhere.

// Each test file is a crate of its own and uses what it needs.
#![allow(dead_code)]

use carom::random::SplitMix64;
use glam::DVec3;

/// The random numbers that a case is made of.
pub(crate) struct Random(SplitMix64);

impl Random {
    /// The stream of a seed.
    pub(crate) fn new(seed: u64) -> Random {
        Random(SplitMix64::new(seed))
    }

    /// In [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    /// In [low, high).
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A power of ten, its exponent in [low, high).
    pub(crate) fn decade(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.between(low, high))
    }

    /// In the cube from −1 to 1.
    pub(crate) fn vector(&mut self) -> DVec3 {
        DVec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }

    /// A direction, more often toward a corner of the cube than toward a side.
    pub(crate) fn direction(&mut self) -> DVec3 {
        self.vector().normalize_or(DVec3::Y)
    }

    /// A whole number in [0, bound).
    pub(crate) fn below(&mut self, bound: usize) -> usize {
        self.0.below(bound)
    }

    /// One of these.
    pub(crate) fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }
}
