//! What is said to rest is at rest: its bodies touch, and do not move along their normal.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::physics::contact::Key;
use crate::physics::{Class, Contact, Kind, Method, Model, Settings};

use super::distance::Board;
use super::finding::{Bodies, Fault, Findings};
use super::frame::Frame;
use super::promise::{Promise, ULPS};

/// Share of its speed that a resting body may have along the normal: curved rest is integrated to 1e-12, and read between
/// the ends of its arcs with some digits less.
const SHARE: f64 = 1e-9;

/// Judges the contacts that rest at the end of a frame.
pub(super) fn judge(model: &Model, settings: &Settings, frame: &Frame, findings: &mut Findings) {
    let t = frame.state.t;
    let released = frame.events.iter().filter(|row| row.class == Class::Release);
    let released: BTreeSet<Key> = released.map(Contact::key).collect();
    let most = (0..model.len()).map(|i| model.acceleration(i).length()).fold(0.0, f64::max);
    let fastest = frame.state.v.iter().map(|v| v.length()).fold(0.0, f64::max);
    let rests = |row: &&Contact| row.class == Class::Rest && row.time == t && !released.contains(&row.key());
    for row in frame.contacts.iter().filter(rests) {
        let (offset, reach, size) = measured(model, frame, row);
        let distance = offset.length();
        let bodies = Bodies::from(row);
        let gap = distance - reach;
        let allowed = Promise::of(settings).curved.max(-0.0) * reach + ULPS * size;
        // how deep is judged as an overlap
        findings.hold(Fault::RestGap, t, bodies, [gap, allowed]);
        let v = |i: usize| frame.state.v[i];
        let other = if row.kind == Kind::Pair { v(row.b) } else { DVec3::ZERO };
        let opening = (v(row.a) - other).dot(offset / distance);
        let mut slowest = slowest(model, settings, row, ([v(row.a), other], most));
        // what carries nothing any longer opens until its gap shows, or closes the gap that it has: the speed that it has
        // come to by then
        let way = if opening > 0.0 { allowed } else { gap.clamp(0.0, allowed) };
        let pull = |i: usize| model.acceleration(i).length();
        let both = pull(row.a) + if row.kind == Kind::Pair { pull(row.b) } else { 0.0 };
        slowest += (2.0 * both * way).sqrt();
        // and of what lies between others, the rounding of their speeds
        findings.hold(Fault::RestSpeed, t, bodies, [opening.abs(), slowest + ULPS * fastest]);
    }
}

/// A contact measured anew: the way from the closest point, or the other centre, to the centre, m; r, or r₁ + r₂, m; what
/// rounding is relative to, m.
fn measured(model: &Model, frame: &Frame, row: &Contact) -> (DVec3, f64, f64) {
    let (x, r) = (frame.state.x[row.a], model.radii[row.a]);
    match row.kind {
        Kind::Wall => {
            let board = Board::of(&model.faces[row.b]);
            (board.offset(x), r, board.size(x))
        }
        Kind::Pair => {
            let other = frame.state.x[row.b];
            (x - other, r + model.radii[row.b], x.abs().max(other.abs()).max_element())
        }
    }
}

/// The normal speed that counts as rest, m/s. Event-driven methods: a share of the speeds, or of what the bodies would gain
/// by falling their own size at `most`, m/s²: what nothing pulls may be pressed by what is pulled the most. `paper` and
/// `moreau` answer in the next frame what they call resting now.
fn slowest(model: &Model, settings: &Settings, row: &Contact, (v, most): ([DVec3; 2], f64)) -> f64 {
    let pull = |i: usize| (model.acceleration(i).length(), model.radii[i]);
    let (a, r) = pull(row.a);
    let (b, s) = if row.kind == Kind::Pair { pull(row.b) } else { (0.0, 0.0) };
    let speeds = v[0].length() + v[1].length();
    let scale = speeds + ((a + b) * (r + s)).sqrt();
    match settings.method {
        Method::Exact | Method::Swept => {
            let bodies = if row.kind == Kind::Pair { 2.0 } else { 1.0 };
            SHARE * (speeds + (bodies * most * (r + s)).sqrt())
        }
        Method::Paper => model.law.rest_speed + (a + b) * settings.dt + SHARE * scale,
        Method::Moreau => {
            let missed = settings.tolerance.min(1.0) * (r + s) / settings.dt;
            model.law.rest_speed + (a + b) * settings.dt + missed + SHARE * scale
        }
    }
}
