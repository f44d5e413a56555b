//! Flight and impact: the one impact law (source: paper 2.4).
//!
//! Every method classifies a contact and computes its impulse here, and every one takes the sign of v_n from
//! [`normal_velocity`]: a predictor and a handler that disagree by one rounding would fire the same event for ever.

use glam::DVec3;

use super::model::ContactLaw;
use super::{Class, Kind, Model};

/// What flight does to a velocity; a type for each [`Pull`](super::model::Pull), so that a loop over spheres contains nothing that the
/// scene does not require.
pub trait Flight: Copy {
    /// Whether it changes velocities at all.
    const BENDS: bool = true;

    /// The velocity of sphere `i` (m/s) a time `h` (s) after it was `v`.
    fn velocity(self, v: DVec3, i: usize, h: f64) -> DVec3;
}

/// Nothing accelerates: `Pull::None`.
#[derive(Debug, Clone, Copy)]
pub struct Straight;

/// Gravity alone, m/s²: `Pull::Uniform`.
#[derive(Debug, Clone, Copy)]
pub struct Uniform(pub DVec3);

/// Accelerations by sphere, m/s²: `Pull::PerSphere`.
#[derive(Debug, Clone, Copy)]
pub struct PerSphere<'a>(pub &'a [DVec3]);

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
                let $flight = $crate::physics::motion::Straight;
                $call
            }
            $crate::physics::model::Pull::Uniform(g) => {
                let $flight = $crate::physics::motion::Uniform(g);
                $call
            }
            $crate::physics::model::Pull::PerSphere => {
                let $flight = $crate::physics::motion::PerSphere(&$model.accelerations);
                $call
            }
        }
    };
}
pub(crate) use with_flight;

/// v_n = (v_a − v_b)·n, m/s; positive: leaving. A wall's `v_b` is 0.
#[inline]
pub fn normal_velocity(v_a: DVec3, v_b: DVec3, normal: DVec3) -> f64 {
    (v_a - v_b).dot(normal)
}

/// What the impact law makes of a contact with normal velocity `v_n` (m/s), whose bodies are or are not pressed
/// together. v_n = −rest_speed rests. Unpressed, a contact that does not approach leaves; one that approaches slowly
/// rests for as long as it takes to stop approaching.
#[inline]
pub fn classify(v_n: f64, pressed: bool, law: &ContactLaw) -> Class {
    if v_n < -law.rest_speed {
        Class::Collide
    } else if v_n < 0.0 || (v_n == 0.0 && pressed) {
        Class::Rest
    } else {
        Class::Leave
    }
}

/// v_n after the response, m/s: −e v_n of an impact, 0 at rest, unchanged if leaving.
#[inline]
pub fn separation_speed(v_n: f64, class: Class, kind: Kind, law: &ContactLaw) -> f64 {
    match (class, kind) {
        (Class::Collide, Kind::Wall) => -law.wall_restitution * v_n,
        (Class::Collide, Kind::Pair) => -law.restitution * v_n,
        (Class::Rest, _) => 0.0,
        (Class::Leave | Class::Release, _) => v_n,
    }
}

/// The impulse on the sphere of a wall contact, N s: it takes the normal velocity from `v_n` to `separation`, and of an
/// impact the tangential velocity to `tangential` times itself.
#[inline]
pub fn wall_impulse(model: &Model, sphere: usize, v: DVec3, normal: DVec3, v_n: f64, class: Class) -> DVec3 {
    let law = &model.law;
    let along = normal * (separation_speed(v_n, class, Kind::Wall, law) - v_n);
    let across = if class == Class::Collide { (v - normal * v_n) * (law.tangential - 1.0) } else { DVec3::ZERO };
    (along + across) * model.masses[sphere]
}

/// The impulse along the normal on the first sphere of a pair, N s, (v_n' − v_n) / (1/m_a + 1/m_b); the second gets
/// its opposite.
#[inline]
pub fn pair_impulse(model: &Model, a: usize, b: usize, v_n: f64, class: Class) -> f64 {
    (separation_speed(v_n, class, Kind::Pair, &model.law) - v_n) / (model.inverse_masses[a] + model.inverse_masses[b])
}
