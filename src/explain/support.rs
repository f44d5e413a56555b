//! The force that holds a contact at rest.

use crate::snapshot::{Class, Contact, Kind, Snapshot};

/// The support force of a resting contact, N, as the mean over the frame; of `moreau` what stops its bodies is in it. None
/// if the contact does not rest, or has only just come to rest.
pub fn support_force(snapshot: &Snapshot, contact: &Contact) -> Option<f64> {
    let Snapshot { step, slack, method, .. } = *snapshot;
    if contact.class != Class::Rest || step <= 0.0 {
        return None;
    }
    let stops = contact.approach_speed != 0.0 && slack.is_none() && method != "moreau";
    let stop = if slack.is_some() { effective_mass(snapshot, contact) * contact.approach_speed } else { 0.0 };
    Some((contact.impulse - stop) / step).filter(|force| !stops && force.is_finite())
}

/// Effective mass of a contact, kg: an impulse along the normal over the change of v_n, m or m₁ m₂ / (m₁ + m₂).
pub(super) fn effective_mass(snapshot: &Snapshot, contact: &Contact) -> f64 {
    let mass = |i: usize| snapshot.stage.masses.get(i).copied().unwrap_or(f64::NAN);
    match contact.kind {
        Kind::Wall => mass(contact.a),
        Kind::Pair => 1.0 / (1.0 / mass(contact.a) + 1.0 / mass(contact.b)),
    }
}
