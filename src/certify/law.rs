//! What an impact does to velocities, from docs/paper.md.

use super::vector::Vector;
use crate::double::Double;
use crate::scene::ContactLaw;

/// Velocity (m/s) after an impact with a wall: v_n becomes −e v_n, what is across the unit normal loses by the factor.
pub(super) fn off_wall(law: &ContactLaw, v: Vector, normal: Vector) -> Vector {
    let along = normal * v.dot(normal);
    (v - along) * Double::from(law.tangential) - along * Double::from(law.wall_restitution)
}

/// Velocities (m/s) after two spheres of these masses (kg) met: the relative one along the unit normal becomes −e times
/// itself, and momentum is kept.
pub(super) fn off_each_other(
    law: &ContactLaw,
    [v_a, v_b]: [Vector; 2],
    [m_a, m_b]: [Double; 2],
    normal: Vector,
) -> [Vector; 2] {
    let v_n = (v_a - v_b).dot(normal);
    let push = -((Double::ONE + Double::from(law.restitution)) * v_n) / (Double::ONE / m_a + Double::ONE / m_b);
    [v_a + normal * (push / m_a), v_b - normal * (push / m_b)]
}
