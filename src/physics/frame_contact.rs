//! A contact at the end of a frame, before anything answers it: what `paper` and `moreau` begin their responses with.

use glam::DVec3;

use super::contact::{Class, Contact, Key, Kind};
use super::impact_law;
use super::model::Model;
use super::overlap;
use super::state::State;

/// A contact as it stands, and what presses its bodies together.
#[derive(Debug, Clone, Copy)]
pub(super) struct FrameContact {
    /// The contact without a response: class `leave`, impulse 0, the speed after it as the speed before it.
    pub(super) contact: Contact,
    /// Relative velocity along the normal, m/s; negative: the bodies approach.
    pub(super) v_n: f64,
    /// Acceleration of the first body, and of the second if it is a sphere, m/s².
    pub(super) accelerations: [DVec3; 2],
}

impl FrameContact {
    /// The contact `key` of the spheres at the `end` of a frame that began with the centres `start` (m).
    pub(super) fn new(model: &Model, start: &[DVec3], end: &State, key: Key) -> FrameContact {
        let (kind, a, b) = key;
        let touch = overlap::touch(model, start, &end.x, key);
        let (v_b, a_b) = match kind {
            Kind::Wall => (DVec3::ZERO, DVec3::ZERO),
            Kind::Pair => (end.v[b], model.acceleration(b)),
        };
        let v_n = impact_law::normal_velocity(end.v[a], v_b, touch.normal);
        let contact = Contact {
            time: end.t,
            kind,
            a,
            b,
            point: touch.point,
            normal: touch.normal,
            velocity: end.v[a] - v_b,
            approach_speed: -v_n,
            separation_speed: v_n,
            impulse: 0.0,
            degree: touch.degree,
            class: Class::Leave,
            impacts: 1,
        };
        FrameContact { contact, v_n, accelerations: [model.acceleration(a), a_b] }
    }
}
