//! What an entry in the queue stands for, and which of several at one time comes first.

use crate::physics::contact::Kind;
use crate::physics::events::islands::resting::Rests;
use crate::physics::events::trajectories::Trajectories;

/// The order of events at one instant: walls, pairs, ends of islands' parabolas, crossings; then a, then b.
pub(crate) type EventOrder = (u8, usize, usize);

/// What comes next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum EventKind {
    /// A contact that a sphere has planned.
    Contact,
    /// The end of an island's parabolas.
    IslandEnd,
    /// The way of a sphere into the next cell; also stands for no event at all, at an infinite time.
    Crossing,
}

/// What the entry of a slot at `time` (s) stands for.
#[inline(always)]
pub(crate) fn event_kind(trajectories: &Trajectories, rests: &Rests, time: f64, slot: usize) -> EventKind {
    if time == f64::INFINITY {
        // nothing ever happens, perhaps because there is no sphere
        return EventKind::Crossing;
    }
    let record = &trajectories.records[slot];
    if record.plan.contact == time {
        EventKind::Contact
    } else if !rests.is_empty() && rests.end_led_by(record.sphere as usize) == time {
        EventKind::IslandEnd
    } else {
        EventKind::Crossing
    }
}

/// The place of the entry of a slot at `time` (s) among those of the same time.
pub(crate) fn event_order(trajectories: &Trajectories, rests: &Rests, time: f64, slot: usize) -> EventOrder {
    let i = trajectories.sphere(slot);
    match event_kind(trajectories, rests, time, slot) {
        EventKind::Contact => {
            let (kind, a, b) = trajectories.key(slot, &trajectories.records[slot].plan);
            (if kind == Kind::Wall { 0 } else { 1 }, a, b)
        }
        EventKind::IslandEnd => (2, i, 0),
        EventKind::Crossing => (3, i, 0),
    }
}

/// When the next event of a slot is, s: of its sphere's plan, or the end of the island that the sphere leads.
#[inline(always)]
pub(crate) fn event_time(trajectories: &Trajectories, rests: &Rests, slot: usize) -> f64 {
    let record = &trajectories.records[slot];
    let time = record.plan.contact.min(record.plan.crossing);
    if rests.is_empty() { time } else { time.min(rests.end_led_by(record.sphere as usize)) }
}
