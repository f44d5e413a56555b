//! Chatter: small bounces that other contacts keep from dying out, millions of times a second. Spheres wedged against
//! each other do that as soon as restitution takes energy. The limit of such a cascade is that they rest together.

use std::collections::BTreeMap;

use glam::DVec3;

use super::contact_state::ContactState;
use super::islands::resting::Rests;
use super::rounding::{DECAY, ELASTIC_ROW, FED, HOP, LONG_ROW, MEMORY, SMALL, SUMMED_HOP};
use super::trajectories::Trajectories;
use crate::physics::contact::{Key, Kind};
use crate::physics::model::{ContactLaw, Model};

/// The law that takes nothing away: nothing dies out by it.
const LOSSLESS: ContactLaw = ContactLaw { restitution: 1.0, wall_restitution: 1.0, tangential: 1.0, rest_speed: 0.0 };

/// The rows of small bounces that are under way, by contact.
#[derive(Debug, Clone)]
pub(crate) struct Chatter {
    rows: BTreeMap<Key, BounceRow>,
    /// What all spheres weigh, their own forces included, N.
    weight: f64,
}

/// A row of small bounces of one contact.
#[derive(Debug, Clone, Copy)]
struct BounceRow {
    /// How many bounces there were.
    count: u32,
    /// How many bounces in a row, up to the last one, were lower than [`SUMMED_HOP`].
    tiny: u32,
    /// Time of the last bounce, s.
    last: f64,
    /// Approach speed (m/s) that the last bounce should have had at most, had each lost at least the root of what
    /// restitution takes.
    due: f64,
    /// Sum of 1 + e times the approach speeds of the last bounces, m/s.
    given: f64,
    /// How long the last bounces took, s.
    took: f64,
}

impl BounceRow {
    fn new(now: f64, approach_speed: f64) -> BounceRow {
        BounceRow { count: 0, tiny: 0, last: now, due: approach_speed, given: 0.0, took: 0.0 }
    }

    /// Whether the row goes on for ever: without the help of weights that change v_n by `pull` (m/s²) no chain of impacts
    /// is so long beside what each of them loses. The next impact approaches at `approach_speed` (m/s) and keeps the share
    /// `keeps` of it.
    fn is_endless(&self, approach_speed: f64, keeps: f64, pull: f64) -> bool {
        if keeps == 1.0 {
            return self.count > ELASTIC_ROW && self.is_driven(pull);
        }
        let loses = f64::from(self.count) * (1.0 - keeps) > DECAY;
        self.count > LONG_ROW && loses && approach_speed > self.due || self.tiny > LONG_ROW && self.is_driven(pull)
    }

    /// Whether weights that change v_n by `pull` (m/s²) can have kept the row going.
    fn is_driven(&self, pull: f64) -> bool {
        self.given <= FED * pull * self.took
    }
}

impl Chatter {
    /// A memory without bounces, for the weights of this model.
    pub(crate) fn new(model: &Model) -> Chatter {
        let weight = (0..model.len()).map(|i| model.acceleration(i).length() * model.masses[i]).sum();
        Chatter { rows: BTreeMap::new(), weight }
    }

    /// Number of contacts with a row of small bounces.
    pub(super) fn entries(&self) -> usize {
        self.rows.len()
    }

    /// Whether this impact is one of a row that should have died out long ago; `since` (s) is when the motion of its
    /// bodies last changed. A chain of impacts at one instant alone is no such row: nothing has fed it.
    #[inline]
    pub(super) fn is_endless(
        &mut self,
        model: &Model,
        bodies: (&Trajectories, &Rests),
        contact: &ContactState,
        since: f64,
    ) -> bool {
        let pull = self.pull(model, contact.key);
        pull != 0.0 && model.law != LOSSLESS && self.is_endless_row(model, bodies, contact, (pull, since))
    }

    /// Whether an impact is one of an endless row, where all weight of the scene pulls at `pull` (m/s²) and something is lost.
    /// Out of the way of a gas.
    #[inline(never)]
    fn is_endless_row(
        &mut self,
        model: &Model,
        (trajectories, rests): (&Trajectories, &Rests),
        contact: &ContactState,
        (pull, since): (f64, f64),
    ) -> bool {
        let (now, approach_speed) = (trajectories.now, -contact.v_n);
        let since = self.rows.get(&contact.key).map_or(since, |row| row.last);
        let keeps = speed_kept(model, rests, contact.key);
        let rounding = HOP * contact.size();
        let tiny = (SUMMED_HOP * contact.reach).max(rounding);
        let small = match keeps {
            1.0 if model.law.tangential == 1.0 => rounding,
            // what walls that rub take beside it ends it
            1.0 => tiny,
            _ => SMALL * contact.reach,
        };
        // a hop h high by gravity takes 4 h / v_n; a rattle across a gap, twice the gap / v_n
        let way = 0.25 * approach_speed * (now - since);
        if way > small {
            self.rows.remove(&contact.key);
            return false;
        }
        let row = self.rows.entry(contact.key).or_insert(BounceRow::new(now, approach_speed));
        row.given = MEMORY * row.given + (1.0 + keeps) * approach_speed;
        row.took = MEMORY * row.took + (now - row.last);
        row.count = row.count.saturating_add(1);
        row.tiny = if way <= tiny { row.tiny.saturating_add(1) } else { 0 };
        row.last = now;
        row.due *= keeps.sqrt();
        row.is_endless(approach_speed, keeps, pull)
    }

    /// Whether [`Chatter::is_endless`] would have anything to count, or to forget, in a scene that pulls all spheres alike.
    #[inline(always)]
    pub(super) fn may_be_endless(&self, trajectories: &Trajectories, contact: &ContactState, since: f64) -> bool {
        // asked first: nothing feeds a gas without forces, and the rest takes longer to compute than to skip
        if trajectories.common() == Some(DVec3::ZERO) {
            return false;
        }
        let small = || (SMALL * contact.reach).max(HOP * contact.size());
        !self.rows.is_empty() || -contact.v_n * (trajectories.now - since) <= 4.0 * small()
    }

    /// How fast all weight of the scene would change v_n, m/s². What nothing pulls dies out, or collapses at one instant.
    fn pull(&self, model: &Model, (kind, a, b): Key) -> f64 {
        let other = if kind == Kind::Pair { model.inverse_masses[b] } else { 0.0 };
        self.weight * (model.inverse_masses[a] + other)
    }
}

/// Which share of its speed a small bounce keeps at most if it dies out. An elastic one does so only where one of its
/// bodies rests on something else too, and what it passes on to that is lost.
fn speed_kept(model: &Model, rests: &Rests, (kind, a, b): Key) -> f64 {
    let law = &model.law;
    let (own, other) = match kind {
        Kind::Pair => (law.restitution, law.wall_restitution),
        Kind::Wall => (law.wall_restitution, law.restitution),
    };
    let rests = rests.count(a) > 0 || (kind == Kind::Pair && rests.count(b) > 0);
    if own == 1.0 && rests { other.min(law.tangential) } else { own }
}
