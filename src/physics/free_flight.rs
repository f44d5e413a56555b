//! What flight without contacts does to velocities.

use glam::DVec3;

/// What flight does to a velocity; a type for each [`Pull`](super::model::Pull), so that a loop over spheres contains
/// nothing that the scene does not require.
pub(super) trait Flight: Copy {
    /// Whether it changes velocities at all.
    const BENDS: bool = true;

    /// The velocity of sphere `i` (m/s) a time `h` (s) after it was `v`.
    fn velocity(self, v: DVec3, i: usize, h: f64) -> DVec3;
}

/// Nothing accelerates: `Pull::None`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Straight;

/// Gravity alone, m/s²: `Pull::Uniform`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Uniform(pub(super) DVec3);

/// Accelerations by sphere, m/s²: `Pull::PerSphere`.
#[derive(Debug, Clone, Copy)]
pub(super) struct PerSphere<'a>(pub(super) &'a [DVec3]);

impl Flight for Straight {
    const BENDS: bool = false;

    #[inline(always)]
    fn velocity(self, v: DVec3, _: usize, _: f64) -> DVec3 {
        v
    }
}

impl Flight for Uniform {
    #[inline(always)]
    fn velocity(self, v: DVec3, _: usize, h: f64) -> DVec3 {
        v + self.0 * h
    }
}

impl Flight for PerSphere<'_> {
    #[inline(always)]
    fn velocity(self, v: DVec3, i: usize, h: f64) -> DVec3 {
        v + self.0[i] * h
    }
}

/// Calls a generic function with the model's type of [`Flight`].
macro_rules! with_flight {
    ($model:expr, $flight:ident => $call:expr) => {
        match $model.pull {
            $crate::physics::model::Pull::None => {
                let $flight = $crate::physics::free_flight::Straight;
                $call
            }
            $crate::physics::model::Pull::Uniform(g) => {
                let $flight = $crate::physics::free_flight::Uniform(g);
                $call
            }
            $crate::physics::model::Pull::PerSphere => {
                let $flight = $crate::physics::free_flight::PerSphere(&$model.accelerations);
                $call
            }
        }
    };
}
pub(crate) use with_flight;
