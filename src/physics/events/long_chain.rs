//! Long chains of impacts at one place that repeat a round: recognised here, and skipped by `repeated_round`.
//!
//! A light ball between a heavy one and a wall, or in the wedge between the two, is struck to and fro while nothing moves:
//! the clock may stand still, or go on by what rounding leaves of gaps. Each impact is computed by itself at first; when
//! the last hundred were the same few in turn, as many of the rounds to come are skipped as go on like that.

use glam::DVec3;

use super::contact_state::ContactState;
use super::last_impacts::COMPARED;
use super::mechanics::Mechanics;
use super::repeated_round::{Bystander, Round, Skipped, Strike};
use super::rounding::{BRUSH, CHAIN, HELD, HOP};
use crate::physics::contact::{Class, Contact, Key, Kind};
use crate::physics::impact_law::separation_speed;
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::overlap::touching;

/// Most spheres of a round.
const MOST_SPHERES: usize = 6;

/// Fewest rounds that are skipped: shorter chains are told impact by impact.
const FEWEST_ROUNDS: u64 = 64;

/// The bodies of a round and how they touch.
struct Chain {
    /// The spheres that it strikes, ascending.
    spheres: Vec<usize>,
    /// The contacts, in the order of the impacts.
    contacts: Vec<ContactState>,
}

impl Mechanics {
    /// Skips the rounds to come of a chain that has repeated one for long, and goes on like that; returns the spheres
    /// whose motion that has changed, none of them if it does not.
    #[cold]
    pub(super) fn skip_rounds(&mut self, model: &Model, log: &mut Log) -> Option<Vec<usize>> {
        let chain = self.chain(model)?;
        let bystanders = self.bystanders(model, &chain);
        let velocities: Vec<_> = chain.spheres.iter().map(|&i| self.trajectories.trajectory(i).v).collect();
        let skipped = self.skip(model, &chain, bystanders, &velocities)?;
        for contact in &chain.contacts {
            let speeds = self.trajectories.speeds(contact.key);
            self.impacts.instant.count_skipped(contact.key, skipped.rounds, speeds);
        }
        for (&i, v) in chain.spheres.iter().zip(&skipped.velocities) {
            let x = self.trajectories.trajectory(i).x;
            self.trajectories.rewrite(i, x, *v);
            self.trajectories.mark_changed(i);
            self.disturb(model, log, i);
        }
        for (contact, &approach_speed) in chain.contacts.iter().zip(&skipped.approaches) {
            self.tell(model, log, contact, (approach_speed, skipped.rounds));
        }
        // what was struck last parts, up to the rounding of what is kept
        let last = chain.contacts.last().expect("a round has impacts");
        self.ensure_separating(model, last.key, 0.0);
        Some(chain.spheres)
    }

    /// Skips rounds from these velocities (m/s) on. What touches beside the chain, and what each round drives a sphere into a
    /// little, because the normals of the impacts are not quite level with it, stops that sphere right after.
    fn skip(
        &self,
        model: &Model,
        chain: &Chain,
        mut bystanders: Vec<Bystander>,
        velocities: &[DVec3],
    ) -> Option<Skipped> {
        let mut strikes: Vec<Strike> = chain.contacts.iter().map(|contact| strike(model, chain, contact)).collect();
        let met = Round { strikes: &strikes, bystanders: &bystanders, rounding: CHAIN }.met(velocities);
        for met in met.iter().rev() {
            let bystander = bystanders[met.bystander];
            let fits = met.share <= bystander.most;
            if !fits && met.approach_speed > bystander.rests_up_to || bystander.moves_alone() {
                return None;
            }
            let fastest = if fits { f64::INFINITY } else { bystander.rests_up_to };
            strikes.insert(met.before, hold(model, chain, &bystander, fastest));
        }
        let is_met = |place: usize| met.iter().any(|met| met.bystander == place);
        let mut place = 0..bystanders.len();
        bystanders.retain(|_| place.next().is_some_and(|place| !is_met(place)));
        let round = Round { strikes: &strikes, bystanders: &bystanders, rounding: CHAIN };
        let mut skipped = round.skip(velocities, FEWEST_ROUNDS)?;
        let mut place = 0..strikes.len();
        skipped.approaches.retain(|_| place.next().is_some_and(|place| !strikes[place].stops));
        Some(skipped)
    }

    /// The chain of the last impacts, its spheres brought to the present; none if they repeat no round, if something moved
    /// meanwhile by more than rounding.
    fn chain(&mut self, model: &Model) -> Option<Chain> {
        let (keys, began) = self.impacts.last.take_round()?;
        let lasted = self.trajectories.now - began;
        let both = keys.iter().flat_map(|&(kind, a, b)| [Some(a), (kind == Kind::Pair).then_some(b)]);
        let mut spheres: Vec<usize> = both.flatten().collect();
        spheres.sort_unstable();
        spheres.dedup();
        if spheres.len() > MOST_SPHERES || keys.iter().any(|&key| self.rests.holds(key)) {
            return None;
        }
        let contacts: Vec<ContactState> = keys.iter().map(|&key| self.advanced_contact(model, key)).collect();
        self.add_touching(model, &mut spheres);
        let stays = |contact: &ContactState| {
            let slack = touching(contact.reach, contact.size());
            let way = self.trajectories.speeds(contact.key) * lasted;
            contact.gap.abs() <= slack && way <= COMPARED as f64 * slack
        };
        contacts.iter().all(stays).then_some(Chain { spheres, contacts })
    }

    /// Adds the spheres that touch some of a chain, brought to the present, if there is room for all of them.
    fn add_touching(&mut self, model: &Model, spheres: &mut Vec<usize>) {
        let touches = |i: usize, j: usize| {
            let key = (Kind::Pair, i.min(j), i.max(j));
            let contact = self.trajectories.contact_geometry(model, key, self.trajectories.now);
            contact.gap <= HOP * contact.size()
        };
        let beside = |&j: &usize| {
            spheres.binary_search(&j).is_err()
                && !self.trajectories.hopping.holds(j)
                && spheres.iter().any(|&i| touches(i, j))
        };
        let more: Vec<usize> = (0..model.len()).filter(beside).collect();
        if spheres.len() + more.len() <= MOST_SPHERES {
            more.iter().for_each(|&i| self.advance(model, i));
            spheres.extend(more);
            spheres.sort_unstable();
        }
    }

    /// Whatever touches the spheres of a chain beside its own contacts, and the share of their speed with which a round may
    /// drive them into it and be stopped: into what they rest on, or graze.
    fn bystanders(&self, model: &Model, chain: &Chain) -> Vec<Bystander> {
        let mut found = Vec::new();
        let mut look = |key: Key| {
            if chain.contacts.iter().any(|contact| contact.key == key) {
                return;
            }
            let contact = self.trajectories.contact_geometry(model, key, self.trajectories.now);
            if contact.gap > HOP * contact.size() {
                return;
            }
            let place = |i: usize| chain.spheres.binary_search(&i);
            let (kind, one, other) = key;
            // the first is a sphere of the chain; where it is the other, the contact is turned round
            let (a, partner, normal) = match place(one) {
                Ok(a) => (a, other, contact.normal),
                Err(_) => (place(other).expect("one of the two is struck"), one, -contact.normal),
            };
            let b = if kind == Kind::Pair { place(partner).ok() } else { None };
            let moves = kind == Kind::Pair && b.is_none();
            let velocity = if moves { self.trajectories.path(partner, self.trajectories.now).v } else { DVec3::ZERO };
            let grazed = CHAIN.max(BRUSH + HOP * contact.size() / contact.reach);
            let (most, rests_up_to) = if self.rests.holds(key) { (HELD, model.law.rest_speed) } else { (grazed, 0.0) };
            found.push(Bystander { normal, a, b, velocity, is_pair: kind == Kind::Pair, most, rests_up_to });
        };
        for &i in &chain.spheres {
            (0..model.faces.len()).for_each(|wall| look((Kind::Wall, i, wall)));
            let others = (0..model.len()).filter(|&j| j != i && (j > i || chain.spheres.binary_search(&j).is_err()));
            others.for_each(|j| look((Kind::Pair, i.min(j), i.max(j))));
        }
        found
    }

    /// Tells the impacts of one contact that were skipped, so many, in one row: of all the sums of approach speeds and of
    /// impulses.
    fn tell(&self, model: &Model, log: &mut Log, contact: &ContactState, (approach_speed, count): (f64, u64)) {
        let (kind, a, b) = contact.key;
        let target = separation_speed(-approach_speed, Class::Collide, kind, &model.law);
        let other = if kind == Kind::Pair { model.inverse_masses[b] } else { 0.0 };
        let impulse = (target + approach_speed) / (model.inverse_masses[a] + other);
        let summed = ContactState { v_n: -approach_speed, ..*contact };
        let row = summed.row(self.trajectories.now, Class::Collide, impulse, target);
        log.impact(Contact { impacts: count, ..row });
    }
}

/// A contact of a chain as an impact of its round.
fn strike(model: &Model, chain: &Chain, contact: &ContactState) -> Strike {
    let (kind, a, b) = contact.key;
    let place = |i: usize| chain.spheres.binary_search(&i).expect("the spheres of all contacts are listed");
    let law = &model.law;
    let (b, other, restitution, tangential) = match kind {
        Kind::Wall => (None, 0.0, law.wall_restitution, law.tangential),
        Kind::Pair => (Some(place(b)), model.inverse_masses[b], law.restitution, 1.0),
    };
    let inverse_masses = [model.inverse_masses[a], other];
    let (normal, a, slowest, fastest) = (contact.normal, place(a), law.rest_speed, f64::INFINITY);
    Strike { normal, a, b, inverse_masses, restitution, tangential, slowest, fastest, stops: false }
}

/// A contact beside a chain as what stops an approach up to this speed, m/s.
fn hold(model: &Model, chain: &Chain, held: &Bystander, fastest: f64) -> Strike {
    let inverse_mass = |place: usize| model.inverse_masses[chain.spheres[place]];
    let inverse_masses = [inverse_mass(held.a), held.b.map_or(0.0, inverse_mass)];
    let &Bystander { normal, a, b, .. } = held;
    Strike { normal, a, b, inverse_masses, restitution: 0.0, tangential: 1.0, slowest: 0.0, fastest, stops: true }
}
