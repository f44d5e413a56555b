//! The hops and orbits that a sphere repeats (`hopping`): when they begin and end, and how they are told.

use glam::DVec3;

use super::changed::Changed;
use super::contact_state::ContactState;
use super::hopping::{FEWEST, Repeated};
use super::hops::Hops;
use super::mechanics::Mechanics;
use super::orbit::{Leg, MOST, Orbit};
use super::rounding::TOUCHED_GAP;
use super::trajectories::Trajectories;
use crate::physics::contact::{Class, Contact, Key, Kind};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::wall::Face;
use crate::roots::quadratic_fall;

impl Trajectories {
    /// Has a sphere go on with what it has just done as often before.
    #[cold]
    #[inline(never)]
    fn hop_on(&mut self, i: usize, repeated: Repeated) {
        let slot = self.slot(i);
        self.records[slot].trajectory = repeated.hull();
        let [_, pull] = repeated.slide();
        self.accelerate(i, pull);
        self.hopping.put(i, repeated);
    }
}

impl Mechanics {
    /// Right after an impact on a wall of a sphere that has moved as it did since `since`, s: takes the flights that follow at
    /// once, if none of them differs, and if they are so low that the sphere touches the wall all the while: a state between
    /// two impacts that no row has told yet is none of a sphere that flies.
    pub(super) fn take_hops(&mut self, model: &Model, contact: &ContactState, since: f64) {
        let ((kind, i, _), law) = (contact.key, &model.law);
        let on_face = kind == Kind::Wall && contact.flat;
        if !on_face || law.wall_restitution < 1.0 || self.rests.count(i) > 0 {
            return;
        }
        let hops = self.hops(model, contact, since).map(Repeated::Hops);
        if let Some(repeated) = hops.or_else(|| self.orbit(model, contact, since).map(Box::new).map(Repeated::Orbit)) {
            self.trajectories.hop_on(i, repeated);
        }
    }

    /// The hops on a face that has just been struck, if there is a row of them.
    fn hops(&mut self, model: &Model, contact: &ContactState, since: f64) -> Option<Hops> {
        let ((_, i, wall), law) = (contact.key, &model.law);
        if contact.a_n >= 0.0 {
            return None;
        }
        let (line, a) = (*self.trajectories.trajectory(i), self.trajectories.acceleration(i));
        let speed = line.v.dot(contact.normal);
        let (normal, press, keeps) = (contact.normal, -contact.a_n, law.tangential);
        let mut hops = Hops { wall, normal, line, a, speed, press, keeps, count: MOST };
        let low = hops.speed > law.rest_speed && hops.height() <= TOUCHED_GAP * contact.reach;
        if !(low && hops.is_series() && self.trajectories.hopping.is_row((i, wall), since, self.trajectories.now)) {
            return None;
        }
        let stays = time_on_face(&model.faces[wall], hops.feet(), hops.slide());
        hops.count = MOST.min((stays / hops.period()) as u64);
        (hops.count >= FEWEST).then_some(hops)
    }

    /// The orbit of a sphere that has just struck a face, if it has gone round often enough.
    fn orbit(&mut self, model: &Model, contact: &ContactState, since: f64) -> Option<Orbit> {
        let speed = self.trajectories.trajectory(contact.key.1).v.dot(contact.normal);
        let low = speed * (self.trajectories.now - since) <= 4.0 * TOUCHED_GAP * contact.reach;
        if !low || speed <= model.law.rest_speed {
            return None;
        }
        self.low_orbit(model, contact, since)
    }

    /// The orbit of a sphere after a low flight on it. Out of the way of all others.
    #[cold]
    #[inline(never)]
    fn low_orbit(&mut self, model: &Model, contact: &ContactState, since: f64) -> Option<Orbit> {
        let (_, i, wall) = contact.key;
        let (line, a) = (*self.trajectories.trajectory(i), self.trajectories.acceleration(i));
        let (leg, clock_ulp) = (Leg { wall, normal: contact.normal, line }, self.trajectories.clock_ulp());
        let motion = (a, model.law.tangential);
        let mut orbit = self.trajectories.hopping.orbit(i, (leg, since), motion, clock_ulp)?;
        let slide = orbit.slide();
        let stays = |leg: &Leg| time_on_face(&model.faces[leg.wall], [leg.line.x; 2], slide);
        let stays = orbit.legs.iter().map(stays).fold(f64::INFINITY, f64::min);
        orbit.count = orbit.rounds(MOST.min((stays / orbit.period()) as u64));
        (orbit.count >= FEWEST).then_some(orbit)
    }

    /// Before a contact: puts those of its spheres that hop to where they are now, and tells the hops that are over. Whether
    /// there were any, so that the contact must be predicted anew.
    #[inline(always)]
    pub(super) fn leave_hops(&mut self, model: &Model, log: &mut Log, key: Key) -> bool {
        !self.trajectories.hopping.is_empty() && self.end_hops(model, log, key)
    }

    /// Ends the hops of the spheres of a contact; whether there were any. Out of the way of scenes in which nothing hops.
    #[cold]
    #[inline(never)]
    fn end_hops(&mut self, model: &Model, log: &mut Log, key: Key) -> bool {
        let now = self.trajectories.now;
        let mut left = false;
        for &i in Changed::of(key).spheres() {
            let Some(repeated) = self.trajectories.hopping.take(i, now) else { continue };
            left = true;
            self.trajectories.advance(i);
            let slot = self.trajectories.slot(i);
            self.trajectories.records[slot].trajectory = repeated.at(now);
            self.trajectories.accelerate(i, repeated.acceleration());
            self.trajectories.mark_changed(i);
            match &repeated {
                Repeated::Hops(hops) => self.tell_hops(model, log, (i, hops.wall), (hops.done(now), hops.speed)),
                Repeated::Orbit(orbit) => {
                    for (place, leg) in orbit.legs.iter().enumerate() {
                        let impacts = (orbit.impacts_of(place, now), orbit.approach_speed(place));
                        self.tell_hops(model, log, (i, leg.wall), impacts);
                    }
                }
            }
        }
        left
    }

    /// Tells the impacts on a wall that are over, so many at this speed (m/s), in one row: of the sums of approach speeds and of
    /// impulses.
    fn tell_hops(&self, model: &Model, log: &mut Log, (i, wall): (usize, usize), (impacts, speed): (u64, f64)) {
        let now = self.trajectories.now;
        if impacts > 0 {
            let sum = impacts as f64 * speed;
            let contact = self.trajectories.contact_state(model, (Kind::Wall, i, wall));
            let summed = ContactState { v_n: -sum, ..contact };
            log.impact(Contact { impacts, ..summed.row(now, Class::Collide, 2.0 * sum * model.masses[i], sum) });
        }
    }
}

/// How long the foot of a sphere stays on a face, s, of which the hops begin and end at these places (m) and which slides with
/// this velocity (m/s) and acceleration (m/s²).
fn time_on_face(face: &Face, feet: [DVec3; 2], [v, a]: [DVec3; 2]) -> f64 {
    let [from, to] = feet.map(|foot| foot - face.shape.center);
    let leaves = |out: DVec3| match 0.5 - to.dot(out) {
        beyond if beyond < 0.0 => Some(0.0),
        _ => quadratic_fall([0.5 - from.dot(out), -v.dot(out), -0.5 * a.dot(out)]),
    };
    let [d1, d2] = [face.dual1, face.dual2];
    [d1, -d1, d2, -d2].into_iter().filter_map(leaves).fold(f64::INFINITY, f64::min)
}
