//! Each contact by itself: its normal, its impulse, its jump of velocity, as the impact law has them.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::physics::contact::Key;
use crate::physics::{Class, Contact, Kind, Method, Model, State};

use super::distance::Board;
use super::finding::{Bodies, Fault, Findings};
use super::overlap::restitution;
use super::promise::{Promise, ULPS};

/// Relative rounding of products of some numbers.
const ROUNDING: f64 = 1e-12;

/// How far apart (in radii) contact points, and normals, are the same.
const SAME: f64 = 1e-9;

/// A row by itself: the unit normal, the sign of its impulse, and the law. `moreau` solves all contacts of a frame
/// together, so that there the law holds of no contact by itself.
pub(super) fn judge(model: &Model, method: Method, row: &Contact, findings: &mut Findings) {
    let bodies = Bodies::from(row);
    let unit = (row.normal.length() - 1.0).abs();
    findings.hold(Fault::Normal, row.time, bodies, [unit, ROUNDING]);
    // what rests may be held by what is zero but for rounding
    let mass = reduced_mass(model, row);
    let speed = row.approach_speed.abs() + row.separation_speed.abs();
    findings.hold(Fault::Pull, row.time, bodies, [-row.impulse, ROUNDING * mass * speed]);
    if row.class != Class::Collide || method == Method::Moreau {
        return;
    }
    let e = restitution(model, row.kind);
    let target = e * row.approach_speed;
    let jump = (row.separation_speed - target).abs();
    findings.hold(Fault::Jump, row.time, bodies, [jump, ROUNDING * row.approach_speed.abs()]);
    findings.hold(Fault::Approach, row.time, bodies, [-row.approach_speed, 0.0]);
    let impulse = (1.0 + e) * row.approach_speed * mass;
    let off = (row.impulse - impulse).abs();
    findings.hold(Fault::Impulse, row.time, bodies, [off, ROUNDING * impulse.abs()]);
}

/// 1 / (1/m_a + 1/m_b), or m_a against a wall, kg.
pub(super) fn reduced_mass(model: &Model, row: &Contact) -> f64 {
    let m = model.masses[row.a];
    match row.kind {
        Kind::Wall => m,
        Kind::Pair => 1.0 / (1.0 / m + 1.0 / model.masses[row.b]),
    }
}

/// A contact of a state at its own time: the normal points from the closest point to the centre, and the point is there.
/// Its bodies may have `moved` so far (m) since.
pub(super) fn judge_place(
    model: &Model,
    promise: Promise,
    (state, moved): (&State, f64),
    row: &Contact,
    findings: &mut Findings,
) {
    if row.time != state.t {
        return;
    }
    let (x, r) = (state.x[row.a], model.radii[row.a]);
    let (offset, reach, size) = match row.kind {
        Kind::Wall => {
            let board = Board::of(&model.faces[row.b]);
            (board.offset(x), r, board.size(x))
        }
        Kind::Pair => {
            let other = state.x[row.b];
            (x - other, r + model.radii[row.b], x.abs().max(other.abs()).max_element())
        }
    };
    let distance = offset.length();
    let rounding = ULPS * size + SAME * reach;
    let bodies = Bodies::from(row);
    if distance > rounding {
        let off = (row.normal - offset / distance).length();
        findings.hold(Fault::Normal, row.time, bodies, [off, SAME + (4.0 * rounding + 2.0 * moved) / distance]);
    }
    // of a pair it lies anywhere in the overlap
    let depth = (reach - distance).abs() + promise.curved * reach;
    let point = match row.kind {
        Kind::Wall => [x - offset, DVec3::ZERO],
        Kind::Pair => [x - row.normal * r, DVec3::splat(depth + 2.0 * moved)],
    };
    let off = (row.point - point[0]).length();
    findings.hold(Fault::Point, row.time, bodies, [off, point[1].x + 4.0 * rounding]);
}

/// The loss of tangential speed at one point of the walls is taken once: two impacts of a sphere in a row at the same
/// point, with the same normal and at the same time, are one. What has sent it back in between is a contact of its own; one
/// that rests may do so without a row, so that spheres which something else holds are left out; and what one row sums up has
/// happened before.
pub(super) fn judge_friction(
    model: &Model,
    contacts: &[Contact],
    held: &BTreeSet<Key>,
    time: f64,
    findings: &mut Findings,
) {
    if model.law.tangential == 1.0 {
        return;
    }
    let impacts: Vec<&Contact> = contacts.iter().filter(|row| row.class == Class::Collide).collect();
    let is_held = |i: usize| held.iter().any(|&(kind, a, b)| a == i || (kind == Kind::Pair && b == i));
    for (k, one) in impacts.iter().enumerate().filter(|(_, row)| row.kind == Kind::Wall && row.impacts == 1) {
        let near = SAME * model.radii[one.a] + ULPS * one.point.abs().max_element();
        let own = impacts[k + 1..].iter().filter(|row| touches(row, one.a));
        let again = own.take_while(|row| {
            row.kind == Kind::Wall
                && row.time == one.time
                && (row.point - one.point).length() <= near
                && (row.normal - one.normal).length() <= SAME
        });
        let times = 1 + again.count();
        if times == 1 || is_held(one.a) {
            continue;
        }
        findings.hold(Fault::Friction, time, Bodies::Sphere(one.a), [times as f64, 1.0]);
    }
}

fn touches(row: &Contact, sphere: usize) -> bool {
    row.a == sphere || (row.kind == Kind::Pair && row.b == sphere)
}
