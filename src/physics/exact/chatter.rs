//! Chatter: small bounces that other contacts keep from dying out, millions of times a second. Spheres wedged against
//! each other do that as soon as restitution takes energy. The limit of such a cascade is that they rest together.

use std::collections::BTreeMap;

use glam::DVec3;

use super::Exact;
use super::impact::{HOP, Meeting};
use crate::physics::contact::Key;
use crate::physics::detector::Detector;
use crate::physics::{Kind, Model};

/// A bounce is small if the gap has opened by less than this many radii since the impact before.
const SMALL: f64 = 1e-7;

/// So many bounces in a row must not have died out, and so many times 1 / (1 − e): restitution alone would have left e⁻⁵⁰
/// of their speed.
const MANY: u32 = 100;
const DECAY: f64 = 50.0;

/// Elastic bounces in a row that coordinates cannot tell from none.
const LOST: u32 = 1000;

/// Small bounces of some contacts, each in a row so far.
pub(super) type Chatter = BTreeMap<Key, Row>;

/// A row of small bounces of one contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    count: u32,
    /// When the last of them was, s.
    last: f64,
    /// The approach speed (m/s) that it should have had at most, had each lost at least the root of what restitution takes.
    due: f64,
}

impl Row {
    fn is_endless(&self, approach_speed: f64, keeps: f64) -> bool {
        if keeps == 1.0 {
            return self.count > LOST;
        }
        let count = f64::from(self.count);
        self.count > MANY && count * (1.0 - keeps) > DECAY && approach_speed > self.due
    }
}

impl<D: Detector> Exact<D> {
    /// Whether this impact is one of a row that should have died out long ago; `since` (s) is when the motion of its
    /// bodies last changed.
    pub(super) fn chatters(&mut self, model: &Model, meeting: &Meeting, since: f64) -> bool {
        if !self.is_fed(model, meeting.key) {
            return false;
        }
        let (now, approach_speed) = (self.now, -meeting.v_n);
        let since = self.chatter.get(&meeting.key).map_or(since, |row| row.last);
        let keeps = self.keeps(model, meeting.key);
        let small = if keeps < 1.0 { SMALL * meeting.reach } else { HOP * meeting.size() };
        // a hop h high by gravity takes 4 h / v_n; a rattle across a gap, twice the gap / v_n
        if approach_speed * (now - since) > 4.0 * small {
            self.chatter.remove(&meeting.key);
            return false;
        }
        let row = self.chatter.entry(meeting.key).or_insert(Row { count: 0, last: now, due: approach_speed });
        row.count = row.count.saturating_add(1);
        row.last = now;
        row.due *= keeps.sqrt();
        row.is_endless(approach_speed, keeps)
    }

    /// Whether [`Exact::chatters`] would have anything to count, or to forget, in a scene that pulls all spheres alike.
    #[inline(always)]
    pub(super) fn may_chatter(&self, meeting: &Meeting, since: f64) -> bool {
        let fed = self.flight.common() != Some(DVec3::ZERO);
        let small = (SMALL * meeting.reach).max(HOP * meeting.size());
        fed && (!self.chatter.is_empty() || -meeting.v_n * (self.now - since) <= 4.0 * small)
    }

    /// Whether anything pulls a body of this contact. What nothing feeds dies out, or collapses at one instant.
    fn is_fed(&self, model: &Model, (kind, a, b): Key) -> bool {
        let pulled = |i: usize| model.acceleration(i) != DVec3::ZERO;
        pulled(a) || (kind == Kind::Pair && pulled(b))
    }

    /// Which share of its speed a small bounce keeps at most if it dies out. An elastic one does so only where one of its
    /// bodies rests on something else too, and what it passes on to that is lost.
    fn keeps(&self, model: &Model, (kind, a, b): Key) -> f64 {
        let law = &model.law;
        let (own, other) = match kind {
            Kind::Pair => (law.restitution, law.wall_restitution),
            Kind::Wall => (law.wall_restitution, law.restitution),
        };
        let rests = self.rests.count(a) > 0 || (kind == Kind::Pair && self.rests.count(b) > 0);
        if own == 1.0 && rests { other.min(law.tangential) } else { own }
    }
}
