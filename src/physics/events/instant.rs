//! One instant: chains of impacts while the clock stands still, which of them never end, and when a run gives up.
//!
//! A chain that ends, however long, is computed to its end (`long_chain` follows many rounds at once): a light ball between
//! a wall and a heavy one is hit π √(M/m) times (Galperin 2003), and restitution just below 1 changes that little. Two
//! impacts of such a round multiply the two speeds by a matrix whose eigenvalues are complex, so that the chain ends, as long
//! as 1 − e is less than 4 √(m/M) or so: n impacts of a chain that ends have n (1 − e) < 4π. A chain that never ends,
//! inelastic collapse (McNamara, Young 1992),
//! goes far beyond that, and multiplies every approach speed by a factor below 1 again and again: its limit is that nothing
//! approaches. So a chain has collapsed when one of its contacts has had four times as many impacts as that, or approaches
//! by no more than rounding leaves of what it did at this instant, or than the clock can tell of what pulls it.

use std::collections::BTreeMap;

use super::contact_state::ContactState;
use super::rounding::{CHAIN, DECAY, LONG_CHAIN, LOST, SHARE, STUCK};
use super::trajectories::Trajectories;
use crate::physics::contact::{Key, Kind};
use crate::physics::model::Model;
use crate::physics::state::{Stall, StallKind};

/// What an impact counts that moves its bodies by more than rounding, and any other event, towards the limits below.
const IMPACT: u64 = 1;
const OTHER: u64 = 100;

/// How much may happen without the clock advancing before the run ends: a million events, or a hundred million impacts.
/// Each sphere adds a thousand events.
const MOST_AT_ONCE: u64 = 1_000_000 * OTHER;

/// How much may happen before the clock must have advanced by more than rounding.
const STRETCH: u64 = 20 * MOST_AT_ONCE;

/// What happened without the clock advancing.
#[derive(Debug, Clone, Default)]
pub(super) struct Instant {
    /// When the instant began, s. At the clock's zero, which resolves any time, what follows within rounding of the time
    /// that matters first belongs to it too.
    began: f64,
    /// Events at this instant.
    pub(super) events: u64,
    /// What the events of this instant count towards [`MOST_AT_ONCE`].
    spent: u64,
    /// What the events since the time `since` count towards [`STRETCH`].
    stretch: u64,
    /// When the stretch began, s.
    since: f64,
    /// The impacts of each contact in a long chain, and the fastest that its bodies have been or approached, m/s.
    chain: BTreeMap<Key, (u32, f64)>,
    /// Whether a contact of the chain has collapsed.
    collapsed: bool,
    /// How often each contact has opened, or approached by rounding.
    releases: BTreeMap<Key, u32>,
}

impl Instant {
    /// Number of contacts remembered, those of both maps.
    pub(super) fn entries(&self) -> usize {
        self.chain.len() + self.releases.len()
    }

    /// Whether the chain of events at this instant is long.
    #[inline(always)]
    pub(super) fn is_long(&self) -> bool {
        self.events > LONG_CHAIN
    }

    /// Whether this contact rests because the chain of impacts it belongs to has collapsed.
    pub(crate) fn has_collapsed(&self, key: Key) -> bool {
        self.collapsed && self.chain.get(&key).is_some_and(|&(count, _)| count > SHARE)
    }

    /// Whether a contact that is about to collide once more at this instant has collapsed.
    #[inline(never)]
    pub(super) fn collapses(&mut self, model: &Model, trajectories: &Trajectories, contact: &ContactState) -> bool {
        let ((kind, a, b), approach_speed) = (contact.key, -contact.v_n);
        let faint = approach_speed * approach_speed < f64::MIN_POSITIVE;
        if !self.is_long() && !faint {
            return false;
        }
        let (restitution, other) = match kind {
            Kind::Wall => (model.law.wall_restitution, 0.0),
            Kind::Pair => (model.law.restitution, model.acceleration(b).length()),
        };
        // no approach slower than that can be told from none
        let least = trajectories.clock_ulp() * (model.acceleration(a).length() + other);
        let (count, fastest) = self.chain.entry(contact.key).or_default();
        // what each impact divides by hundreds is soon so slow that numbers have no square of it, and no direction
        *count = if faint { u32::MAX } else { count.saturating_add(1) };
        *fastest = fastest.max(approach_speed).max(trajectories.speeds(contact.key));
        let dies = f64::from(*count) * (1.0 - restitution) > DECAY && u64::from(*count) > LONG_CHAIN;
        let rounds = approach_speed <= least.max(CHAIN * *fastest);
        self.collapsed |= dies || *count > SHARE && rounds;
        self.has_collapsed(contact.key)
    }

    /// Whether a contact that opens, or approaches by rounding, has done so too often at this instant: each time brings
    /// back another contact of its island, which brings back this one. Held together for a moment, they are solved
    /// together.
    pub(crate) fn is_stuck(&mut self, key: Key) -> bool {
        let count = self.releases.entry(key).or_default();
        *count += 1;
        *count > STUCK
    }

    /// Whether a contact has been released so often at this instant that it will be held if it opens once more.
    pub(crate) fn sticks(&self, key: Key) -> bool {
        self.releases.get(&key).is_some_and(|&count| count >= STUCK)
    }

    /// Counts so many impacts of a contact at this instant that were skipped together, before which its bodies had these
    /// speeds in all, m/s.
    pub(super) fn count_skipped(&mut self, key: Key, impacts: u64, speeds: f64) {
        self.events = self.events.saturating_add(impacts);
        let (count, fastest) = self.chain.entry(key).or_default();
        // what is left to come says whether the chain dies out
        *count = (*count).max(SHARE);
        *fastest = fastest.max(speeds);
    }

    /// Tells an impact of a long chain, which changes what its bodies do, from a loop of rounding.
    pub(super) fn count_impact(&mut self, trajectories: &Trajectories, contact: &ContactState) {
        let long = self.is_long() || self.stretch >= MOST_AT_ONCE;
        if long && -contact.v_n > LOST * trajectories.speeds(contact.key) {
            self.spent = self.spent.saturating_sub(OTHER - IMPACT);
            self.stretch = self.stretch.saturating_sub(OTHER - IMPACT);
        }
    }

    /// The clock goes on to `time`, s; says so if it does not for too many events.
    #[inline(always)]
    pub(super) fn advance_clock(&mut self, trajectories: &mut Trajectories, time: f64) -> Result<(), Stall> {
        let before = trajectories.now;
        // only at the clock's zero can it advance by less than the ulp that counts
        let advances =
            time > before && (before >= trajectories.clock_size() || time - self.began >= trajectories.clock_ulp());
        trajectories.now = before.max(time);
        if advances {
            self.began = time;
            (self.events, self.spent, self.collapsed) = (0, 0, false);
            if !self.chain.is_empty() || !self.releases.is_empty() {
                self.chain.clear();
                self.releases.clear();
            }
        }
        self.events += 1;
        self.spent += OTHER;
        self.stretch += OTHER;
        let now = trajectories.now;
        let more = 1000 * OTHER * trajectories.records.len() as u64;
        if self.spent > MOST_AT_ONCE + more {
            return Err(no_progress(now));
        }
        if self.stretch > STRETCH + more {
            // a nanosecond of the time scale: what a hundred million such stretches would still not leave behind
            if now - self.since < 1e-9 * trajectories.clock_size() {
                return Err(no_progress(now));
            }
            (self.stretch, self.since) = (0, now);
        }
        Ok(())
    }
}

#[cold]
fn no_progress(now: f64) -> Stall {
    let reason = format!(
        "Events went on and on at t = {now} s without the clock advancing; set a larger rest_speed, or change the method from here."
    );
    Stall { time: now, kind: StallKind::NoProgress, reason }
}
