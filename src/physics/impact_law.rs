//! The one impact law (source: paper 2.4).
//!
//! Every method classifies a contact and computes its impulse here, and every one takes the sign of v_n from
//! [`normal_velocity`]: a predictor and a handler that disagree by one rounding would fire the same event for ever.

use glam::DVec3;

use super::contact::{Class, Kind};
use super::model::{ContactLaw, Model};

/// v_n = (v_a − v_b)·n, m/s; positive: leaving. A wall's `v_b` is 0.
#[inline]
pub fn normal_velocity(v_a: DVec3, v_b: DVec3, normal: DVec3) -> f64 {
    (v_a - v_b).dot(normal)
}

/// v_n of a pair at offset `x` (m) with relative velocity `v`, m/s: the handler's expression.
#[inline]
pub fn pair_normal_velocity(x: DVec3, v: DVec3) -> f64 {
    normal_velocity(v, DVec3::ZERO, x / x.length())
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

/// Whether no impact takes any energy.
pub(crate) fn is_lossless(law: &ContactLaw) -> bool {
    law.restitution == 1.0 && law.wall_restitution == 1.0 && law.tangential == 1.0
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

/// The impulse on the sphere of a wall contact with velocity `v` (m/s), N s: it takes the normal velocity to that after the
/// response, and of an impact the tangential velocity to `tangential` times itself.
#[inline]
pub fn wall_impulse(model: &Model, sphere: usize, v: DVec3, normal: DVec3, class: Class) -> DVec3 {
    let v_n = normal_velocity(v, DVec3::ZERO, normal);
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

/// The change of velocity (m/s) that changes v_n by `change` (m/s): n `change` / n². A wall's normal is off by the same
/// ulp in every impact, and so would be the energy.
pub(crate) fn along(normal: DVec3, change: f64) -> DVec3 {
    // n² − 1 to 1e-23: the squares of the multiples of 2⁻²⁶ next to the components, and their sum, are exact
    let shift = DVec3::splat(1.5 * (1_u64 << 26) as f64);
    let high = (normal + shift) - shift;
    let low = normal - high;
    let excess = (high.length_squared() - 1.0) + (2.0 * high + low).dot(low);
    normal * (change - change * excess)
}

/// The impulse (N s) on the first of two spheres at offset `arm` (m) with relative velocity `w` (m/s), `share` = 1/m₁ +
/// 1/m₂: along the arm by its actual length, since a unit normal's rounding would let the energy creep upwards.
#[inline(always)]
pub(crate) fn pair_push(arm: DVec3, w: DVec3, share: f64, restitution: f64) -> DVec3 {
    arm * (-(1.0 + restitution) * arm.dot(w) / (arm.length_squared() * share))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::along;

    #[test]
    fn a_change_along_a_rounded_normal_is_made_to_far_below_an_ulp() {
        // Normals of one direction, off by more than rounding ever is: n·(n change / n²) is the change in both.
        let n = DVec3::new(2.0, 3.0, 6.0) / 7.0;
        for size in [1.0, 1.0 + 1e-12, 1.0 - 1e-12] {
            let change = (n * size).dot(along(n * size, 3.0));
            // Five products and sums of numbers under 3 round.
            assert!((change - 3.0).abs() <= 8.0 * f64::EPSILON, "{size}: {change}");
        }
    }
}
