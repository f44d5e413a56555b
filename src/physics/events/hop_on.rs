//! The hops of a sphere that takes the same ones again and again (`hopping`): when they begin and end, and how they are told.

use glam::DVec3;

use super::changed::Changed;
use super::contact_state::ContactState;
use super::hopping::{FEWEST, Hops};
use super::mechanics::Mechanics;
use super::rounding::TOUCHED_GAP;
use super::trajectories::Trajectories;
use crate::physics::contact::{Class, Contact, Key, Kind};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::wall::Face;
use crate::roots::quadratic_fall;

/// Most hops at once: a run that has nothing else to do still comes by now and then.
const MOST: u64 = 1 << 20;

impl Trajectories {
    /// Has a sphere hop on that has just bounced as often before.
    fn hop_on(&mut self, i: usize, hops: Hops) {
        let slot = self.slot(i);
        self.records[slot].trajectory = hops.hull();
        let [_, pull] = hops.slide();
        self.accelerate(i, pull);
        self.hopping.put(i, hops);
    }
}

impl Mechanics {
    /// Right after an impact on a wall of a sphere that has moved as it did since `since`, s: takes the hops that follow at
    /// once, if none of them differs, and if they are so low that the sphere touches the wall all the while: a state between
    /// two impacts that no row has told yet is none of a sphere that flies.
    pub(super) fn take_hops(&mut self, model: &Model, contact: &ContactState, since: f64) {
        let ((kind, i, wall), law) = (contact.key, &model.law);
        let pressed = kind == Kind::Wall && contact.flat && contact.a_n < 0.0;
        if !pressed || law.wall_restitution < 1.0 || self.rests.count(i) > 0 {
            return;
        }
        let (line, a) = (*self.trajectories.trajectory(i), self.trajectories.acceleration(i));
        let speed = line.v.dot(contact.normal);
        let (normal, press, keeps) = (contact.normal, -contact.a_n, law.tangential);
        let mut hops = Hops { wall, normal, line, a, speed, press, keeps, count: MOST };
        let low = hops.speed > law.rest_speed && hops.height() <= TOUCHED_GAP * contact.reach;
        if !(low && hops.is_series() && self.trajectories.hopping.is_row((i, wall), since, self.trajectories.now)) {
            return;
        }
        let stays = time_on_face(&model.faces[wall], &hops);
        hops.count = MOST.min((stays / hops.period()) as u64);
        if hops.count >= FEWEST {
            self.trajectories.hop_on(i, hops);
        }
    }

    /// Before a contact: puts those of its spheres that hop to where they are now, and tells the hops that are over. Whether
    /// there were any, so that the contact must be predicted anew.
    pub(super) fn leave_hops(&mut self, model: &Model, log: &mut Log, key: Key) -> bool {
        if self.trajectories.hopping.is_empty() {
            return false;
        }
        let now = self.trajectories.now;
        let mut left = false;
        for &i in Changed::of(key).spheres() {
            let Some(hops) = self.trajectories.hopping.take(i, now) else { continue };
            left = true;
            self.trajectories.advance(i);
            let slot = self.trajectories.slot(i);
            self.trajectories.records[slot].trajectory = hops.at(now);
            self.trajectories.accelerate(i, hops.a);
            self.trajectories.mark_changed(i);
            self.tell_hops(model, log, i, &hops);
        }
        left
    }

    /// Tells the impacts of the hops that are over in one row: of the sums of approach speeds and of impulses.
    fn tell_hops(&self, model: &Model, log: &mut Log, i: usize, hops: &Hops) {
        let now = self.trajectories.now;
        let impacts = hops.done(now);
        if impacts > 0 {
            let sum = impacts as f64 * hops.speed;
            let contact = self.trajectories.contact_state(model, (Kind::Wall, i, hops.wall));
            let summed = ContactState { v_n: -sum, ..contact };
            log.impact(Contact { impacts, ..summed.row(now, Class::Collide, 2.0 * sum * model.masses[i], sum) });
        }
    }
}

/// How long the foot of a sphere that hops stays on its face, s.
fn time_on_face(face: &Face, hops: &Hops) -> f64 {
    let [from, to] = hops.feet().map(|foot| foot - face.shape.center);
    let [v, a] = hops.slide();
    let leaves = |out: DVec3| match 0.5 - to.dot(out) {
        beyond if beyond < 0.0 => Some(0.0),
        _ => quadratic_fall([0.5 - from.dot(out), -v.dot(out), -0.5 * a.dot(out)]),
    };
    let [d1, d2] = [face.dual1, face.dual2];
    [d1, -d1, d2, -d2].into_iter().filter_map(leaves).fold(f64::INFINITY, f64::min)
}
