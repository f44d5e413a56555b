//! One instant: chains of impacts while the clock stands still, which of them never end, and when a run gives up.
//!
//! A chain that ends, however long, is computed to its end: a light ball between a wall and a heavy one is hit π √(M/m)
//! times (Galperin 2003), and restitution just below 1 changes that little. Two impacts of such a round multiply the two
//! speeds by a matrix whose eigenvalues are complex, so that the chain ends, as long as 1 − e is less than 4 √(m/M) or so:
//! n impacts of a chain that ends have n (1 − e) < 4π. A chain that never ends, inelastic collapse (McNamara, Young 1992),
//! goes far beyond that, and multiplies every approach speed by a factor below 1 again and again: its limit is that nothing
//! approaches. So a chain has collapsed when one of its contacts has had four times as many impacts as that, or approaches
//! by no more than rounding leaves of what it did at this instant, or than the clock can tell of what pulls it.

use std::collections::BTreeMap;

use super::Exact;
use super::chatter::DECAY;
use super::impact::Meeting;
use crate::physics::contact::Key;
use crate::physics::detector::Detector;
use crate::physics::{Kind, Model, Stall, State};

/// Events at one instant after which it is watched whether approaches die out: chains that die sooner end by themselves.
pub(super) const LONG_CHAIN: u64 = 1000;

/// Releases of one contact without the clock advancing after which it is held for a moment.
const STUCK: u32 = 20;

/// What an impact counts that moves its bodies by more than rounding, and any other event, towards the limits below.
const IMPACT: u64 = 1;
const OTHER: u64 = 100;

/// How much may happen without the clock advancing before the run ends: a million events, or a hundred million impacts.
/// Each sphere adds a thousand events.
const MOST_AT_ONCE: u64 = 1_000_000 * OTHER;

/// How much may happen before the clock must have advanced by more than rounding.
const STRETCH: u64 = 20 * MOST_AT_ONCE;

/// Share of the time scale of its fastest sphere below which a run's clock counts as at its zero: 2⁻⁸.
const BEGINNING: f64 = 1.0 / 256.0;

/// Below this share of the fastest approach of a chain, or of the speeds of its bodies, an approach is what the rounding of
/// a thousand impacts may have made: 4096 ulp.
const ROUNDING: f64 = 4096.0 * f64::EPSILON;

/// Impacts by then of a contact that belongs to the same collapse, and rests with it: the limit of the chain is that none of
/// them approaches any longer.
const SHARE: u32 = 100;

/// Approaches below this share of the speeds of their bodies are rounding: 64 ulp.
const LOST: f64 = 64.0 * f64::EPSILON;

/// What happened without the clock advancing.
#[derive(Debug, Clone, Default)]
pub(super) struct Instant {
    /// When it began, s. At the clock's zero, which resolves any time, what follows within rounding of the time that
    /// matters first belongs to it too.
    began: f64,
    pub(super) events: u64,
    /// What they count, and those of this stretch, which began at the time `since`, s.
    spent: u64,
    stretch: u64,
    since: f64,
    /// The impacts of each contact in a long chain, and the fastest that its bodies have been or approached, m/s.
    chain: BTreeMap<Key, (u32, f64)>,
    /// Whether one of them has collapsed.
    collapsed: bool,
    /// How often each contact has opened, or brushed.
    releases: BTreeMap<Key, u32>,
}

impl Instant {
    /// Whether this contact rests because the chain of impacts it belongs to has collapsed.
    pub(super) fn has_collapsed(&self, key: Key) -> bool {
        self.collapsed && self.chain.get(&key).is_some_and(|&(count, _)| count > SHARE)
    }

    /// The same of a contact that is about to collide once more, at a speed (m/s) of which an impact takes the share `loses`;
    /// `speeds` are those of its bodies in all, and no approach slower than `least` can be told from none, m/s.
    fn collapses(&mut self, key: Key, approach_speed: f64, loses: f64, [speeds, least]: [f64; 2]) -> bool {
        if self.events <= LONG_CHAIN {
            return false;
        }
        let (count, fastest) = self.chain.entry(key).or_default();
        *count = count.saturating_add(1);
        *fastest = fastest.max(approach_speed).max(speeds);
        let dies = f64::from(*count) * loses > DECAY && u64::from(*count) > LONG_CHAIN;
        let rounds = approach_speed <= least.max(ROUNDING * *fastest);
        self.collapsed |= dies || *count > SHARE && rounds;
        self.has_collapsed(key)
    }

    /// Whether a contact that opens, or brushes, has done so too often at this instant: each time brings back another contact
    /// of its island, which brings back this one. Held together for a moment, they are solved together.
    pub(super) fn is_stuck(&mut self, key: Key) -> bool {
        let count = self.releases.entry(key).or_default();
        *count += 1;
        *count > STUCK
    }

    /// The event in progress is an impact that changes what its bodies do: no loop of rounding, but part of a chain.
    fn count_impact(&mut self) {
        self.spent = self.spent.saturating_sub(OTHER - IMPACT);
        self.stretch = self.stretch.saturating_sub(OTHER - IMPACT);
    }
}

/// The time that matters first after the start, s: a small share of what the first sphere takes to fall, or to go, by its
/// radius. It only keeps the clock from being taken for infinitely fine at its zero; 0 if nothing moves.
pub(super) fn beginning(model: &Model, state: &State) -> f64 {
    let of = |i: usize| {
        let r = model.radii[i];
        (r / model.acceleration(i).length()).sqrt().min(r / state.v[i].length())
    };
    let first = (0..model.len()).map(of).fold(f64::INFINITY, f64::min);
    if first.is_finite() { BEGINNING * first } else { 0.0 }
}

impl<D: Detector> Exact<D> {
    /// The clock goes on to `time`, s; says so if it does not for too many events.
    pub(super) fn advance_clock(&mut self, time: f64, spheres: usize) -> Result<(), Stall> {
        let tick = self.tick();
        let Exact { instant, now, beginning, .. } = self;
        *now = now.max(time);
        if time - instant.began >= tick {
            instant.began = time;
            (instant.events, instant.spent, instant.collapsed) = (0, 0, false);
            if !instant.chain.is_empty() || !instant.releases.is_empty() {
                instant.chain.clear();
                instant.releases.clear();
            }
        }
        instant.events += 1;
        instant.spent += OTHER;
        instant.stretch += OTHER;
        let more = 1000 * OTHER * spheres as u64;
        if instant.spent > MOST_AT_ONCE + more {
            return Err(self.no_progress());
        }
        if instant.stretch > STRETCH + more {
            // a nanosecond of the time scale: what a hundred million such stretches would still not leave behind
            if *now - instant.since < 1e-9 * now.abs().max(*beginning) {
                return Err(self.no_progress());
            }
            (instant.stretch, instant.since) = (0, *now);
        }
        Ok(())
    }

    fn no_progress(&self) -> Stall {
        let reason = format!(
            "Events went on and on at t = {} s without the clock advancing; set a larger rest_speed, or change the method from here.",
            self.now
        );
        Stall { time: self.now, kind: "no-progress", reason }
    }

    /// Rounding of the clock, s.
    pub(super) fn tick(&self) -> f64 {
        let t = self.now.abs().max(self.beginning);
        t.next_up() - t
    }

    /// Whether a contact that is about to collide once more at this instant has collapsed.
    pub(super) fn collapses(&mut self, model: &Model, meeting: &Meeting) -> bool {
        let (kind, a, b) = meeting.key;
        let (restitution, other) = match kind {
            Kind::Wall => (model.law.wall_restitution, 0.0),
            Kind::Pair => (model.law.restitution, model.acceleration(b).length()),
        };
        let least = self.tick() * (model.acceleration(a).length() + other);
        let limits = [self.speeds(meeting.key), least];
        self.instant.collapses(meeting.key, -meeting.v_n, 1.0 - restitution, limits)
    }

    /// Tells an impact in a long chain from a loop of rounding.
    pub(super) fn count_impact(&mut self, meeting: &Meeting) {
        let long = self.instant.events > LONG_CHAIN || self.instant.stretch >= MOST_AT_ONCE;
        if long && -meeting.v_n > LOST * self.speeds(meeting.key) {
            self.instant.count_impact();
        }
    }

    /// The speeds of the bodies of a contact in all, m/s.
    fn speeds(&self, (kind, a, b): Key) -> f64 {
        let other = if kind == Kind::Pair { self.flight.line(b).v.length() } else { 0.0 };
        self.flight.line(a).v.length() + other
    }
}
