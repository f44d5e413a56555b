//! What events do to islands: rests end, chords follow each other, and islands that have changed are solved again.

use glam::DVec3;

use super::equilibrium::{Settled, closed_speed, lowest_hop, solve_island};
use super::resting::{Curve, Island, IslandContact, Other, closed};
use crate::physics::contact::{Class, Key, Kind};
use crate::physics::events::changed::Changed;
use crate::physics::events::contact_state::ContactState;
use crate::physics::events::curved::bodies::Body;
use crate::physics::events::mechanics::Mechanics;
use crate::physics::events::rest_reason::RestReason;
use crate::physics::events::rounding::{CLOCK_ULPS, DRIVEN, HOP, PAUSE, SUM, SUMMED_HOP};
use crate::physics::log::Log;
use crate::physics::model::Model;
use crate::physics::state::{Stall, StallKind};
use crate::physics::support::{Fate, Short, islands};
use crate::physics::wall_parts::{part_beyond, part_end, room};

/// Arcs in a row that are over at once, after which an island creeps for a moment: solving it again changes nothing.
const HURRIED: u32 = 8;

/// An island under way to be solved.
struct Members {
    /// Indices of the island's spheres, ascending.
    spheres: Vec<usize>,
    /// The spheres as bodies, in that order.
    bodies: Vec<Body>,
    /// Contacts of the island, in the order of their keys.
    contacts: Vec<IslandContact>,
}

impl Mechanics {
    /// Ends the rests of sphere `i`, after an impulse on it, that are struck apart or driven together harder than rest
    /// allows.
    pub(crate) fn disturb(&mut self, model: &Model, log: &mut Log, i: usize) {
        if self.rests.is_empty() || self.rests.of[i].is_empty() {
            return;
        }
        self.rests.dirty.push(i);
        for key in self.rests.of[i].clone() {
            let meeting = self.trajectories.contact_state(model, key);
            let held = self.rests.kept(key);
            // what squeezes a sphere it can't leave, whatever strikes it at this instant too
            let squeezed = held.reason == RestReason::Squeezed && held.settles_at == self.trajectories.now;
            let small = meeting.hops_within_rounding(self.rests.pressure(model, key));
            if squeezed || small || self.impacts.instant.has_collapsed(key) {
                continue;
            }
            if meeting.v_n < -model.law.rest_speed && meeting.v_n < -DRIVEN * self.trajectories.trajectory(i).v.length()
            {
                if key.0 == Kind::Pair {
                    self.rests.dirty.extend([key.1, key.2]);
                }
                self.release(model, log, key);
            }
        }
    }

    pub(super) fn release(&mut self, model: &Model, log: &mut Log, key: Key) {
        if let Some(held) = self.rests.drop(key) {
            let meeting = self.trajectories.contact_state(model, key);
            let now = self.trajectories.now;
            let untold = if held.announced { 0.0 } else { held.untold + held.load.given(now) };
            if untold > 0.0 {
                // its bounces were not over: what has stopped and carried it would stand nowhere
                let stopped = ContactState { v_n: held.v_n, ..meeting };
                log.tell(stopped.row(now, Class::Rest, untold, 0.0));
            }
            if held.announced || untold > 0.0 {
                log.tell(meeting.row(now, Class::Release, 0.0, meeting.v_n));
            }
        }
        self.set_free(model, key);
    }

    /// Has bounces of a sphere on a wall that were summed up told one by one from now on where something else strikes it:
    /// the sphere gets the velocity that they have left it, and not their mean one. Whether there were any.
    #[inline]
    pub(crate) fn interrupt_series(&mut self, model: &Model, log: &mut Log, struck: Key) -> bool {
        // only bounces that rub are summed up so
        !self.rests.is_empty() && model.law.tangential != 1.0 && self.interrupt_rubbing(model, log, struck)
    }

    #[cold]
    #[inline(never)]
    fn interrupt_rubbing(&mut self, model: &Model, log: &mut Log, struck: Key) -> bool {
        let mut interrupted = false;
        for &i in Changed::of(struck).spheres() {
            for key in self.rests.of(i).to_vec().into_iter().filter(|&key| key != struck) {
                interrupted |= self.interrupt_bounces(model, log, key);
            }
        }
        interrupted
    }

    /// Ends a rest whose bounces were summed up and are not over; whether it was one. From now on they are told one by one,
    /// from the velocity that they have left the sphere.
    fn interrupt_bounces(&mut self, model: &Model, log: &mut Log, key: Key) -> bool {
        let (held, i) = (self.rests.kept(key), key.1);
        let Some(rub) = held.rub.filter(|_| held.settles_at > self.trajectories.now) else { return false };
        self.advance(model, i);
        let (normal, line) = (self.trajectories.contact_state(model, key).normal, *self.trajectories.trajectory(i));
        self.release(model, log, key);
        let v = rub.interrupt(line.v, normal, self.trajectories.now, model.acceleration(i));
        self.trajectories.rewrite(i, line.x, v);
        self.trajectories.mark_changed(i);
        self.rests.dirty.push(i);
        true
    }

    /// Has the spheres of a contact that no longer rest on anything pulled as in flight from now on: what they meet at this
    /// instant asks how they are pressed, before any island is solved.
    fn set_free(&mut self, model: &Model, key: Key) {
        for &i in Changed::of(key).spheres() {
            if self.rests.of[i].is_empty() {
                self.advance(model, i);
                self.trajectories.accelerate(i, model.acceleration(i));
            }
        }
    }

    /// Handles the end of an island's parabolas: a foot comes to the end of its part, an arc or its chord is over. Returns
    /// the spheres whose motion that has changed.
    pub(crate) fn end_parabola(&mut self, model: &Model, log: &mut Log, leader: usize) -> Changed {
        let now = self.trajectories.now;
        let island = self.rests.island(leader).expect("an end that is due is that of an island");
        let spheres = island.spheres.clone();
        if let Some(curve) = island.curve.clone().filter(|curve| !curve.changes) {
            self.rests.hurried = 0;
            self.rests.remember_chord(&spheres, &curve, now);
            let keys: Short<Key> = spheres.iter().flat_map(|&i| self.rests.of[i].iter().copied()).collect();
            // a series that is over, or a pause, ends any chord
            self.set_chord(&spheres, curve.next(model, now).cut(self.settling_time(&keys) - now));
            return self.changed(spheres);
        }
        // after a creep the next arc is tried as it should be
        let over_at_once = island.curve.as_ref().is_some_and(|curve| curve.arc.is_over_at_once());
        self.rests.hurried = if over_at_once { self.rests.hurried + 1 } else { self.rests.hurried.saturating_sub(1) };
        for &i in &spheres {
            self.advance(model, i);
        }
        for &i in &spheres {
            for key in self.rests.of[i].clone().into_iter().filter(|key| key.0 == Kind::Wall) {
                // anew: to interrupt bounces changes its velocity
                let path = self.trajectories.path(i, now);
                let (face, r) = (&model.faces[key.2], model.radii[i]);
                // What has not come to its border keeps its part: ahead of it is an edge that it is not at.
                let told = self.trajectories.border_rounding(&path, r);
                // bounces on a face are not summed up beyond its border
                if room(face, self.rests.kept(key).part, path.x) <= told && !self.interrupt_bounces(model, log, key) {
                    self.rests.kept_mut(key).part = part_beyond(face, &path, r, told);
                }
            }
        }
        self.rests.dirty.push(leader);
        Changed::Nothing
    }

    /// Sends the spheres along a chord, and gives it to their island.
    fn set_chord(&mut self, spheres: &[usize], curve: Curve) {
        let h = curve.length;
        let accelerations = curve.arc.chord_accelerations(curve.offset, h);
        for ((&i, start), a) in spheres.iter().zip(curve.at(0.0)).zip(accelerations) {
            self.trajectories.rewrite(i, start.x, start.v);
            if h > 0.0 {
                self.trajectories.accelerate(i, a);
            }
        }
        let until = (self.trajectories.now + h).max(self.trajectories.now.next_up());
        match self.rests.island_mut(spheres[0]) {
            Some(island) => (island.end, island.curve) = (until, Some(curve)),
            None => {
                let island = Island { spheres: spheres.to_vec(), end: until, curve: Some(curve) };
                self.rests.insert_island(island, self.trajectories.now);
            }
        }
    }

    /// Notes that the motion of these spheres has changed: plans of others that name them are stale.
    fn changed(&mut self, spheres: Vec<usize>) -> Changed {
        for &i in &spheres {
            self.trajectories.mark_changed(i);
        }
        Changed::Spheres(spheres)
    }

    /// Decides what holds, island by island, once no contact is left at this instant. Returns the spheres whose motion that
    /// has changed.
    pub(crate) fn settle(&mut self, model: &Model, log: &mut Log) -> Result<Changed, Stall> {
        let spheres = self.rests.take_dirty();
        for &i in &spheres {
            self.advance(model, i);
        }
        for &i in &spheres {
            self.rests.remove_island(i, self.trajectories.now);
        }
        for &i in &spheres {
            self.add_walls_at_point(model, i);
        }
        // what has just been added is solved here too
        let covered = self.covered(model, log, &spheres);
        self.rests.dirty.clear();
        let mut keys: Short<Key> = Short::new();
        spheres.iter().for_each(|&i| keys.extend_from_slice(&self.rests.of[i]));
        keys.retain(|key| covered.binary_search(key).is_err());
        keys.sort_unstable();
        keys.dedup();
        let mut open: Vec<Short<Key>> = vec![keys];
        while let Some(keys) = open.pop() {
            let groups = self.groups(&keys);
            for group in &groups {
                let connected: Short<Key> = group.iter().map(|&contact| keys[contact]).collect();
                open.extend(self.settle_island(model, log, &connected)?);
            }
        }
        self.uncover(model, log, &covered);
        for &i in &spheres {
            if self.rests.of[i].is_empty() {
                self.trajectories.accelerate(i, model.acceleration(i));
            }
            self.trajectories.check_range(i)?;
        }
        Ok(self.changed(spheres))
    }

    /// The connected sets of some contacts, by their places in the list.
    fn groups(&self, keys: &[Key]) -> Vec<Short<usize>> {
        let links: Short<_> = keys.iter().map(|&(kind, a, b)| (a, (kind == Kind::Pair).then_some(b))).collect();
        islands(&links).into_iter().map(|island| island.contacts).collect()
    }

    /// Settles connected contacts; returns those that are left if some opened, for they may have fallen apart.
    fn settle_island(&mut self, model: &Model, log: &mut Log, keys: &[Key]) -> Result<Option<Short<Key>>, Stall> {
        self.rub_off(model, keys);
        let Members { spheres, mut bodies, contacts } = self.members(model, keys);
        let loads: Short<f64> = keys.iter().map(|&key| self.rests.kept(key).load.force).collect();
        let clock = CLOCK_ULPS * self.trajectories.clock_ulp();
        let stuck = self.stuck_speeds(keys, &bodies);
        let settled =
            solve_island(&mut bodies, &closed(model, &contacts), (&loads, &stuck), (clock, lowest_hop(model)));
        if !settled.converged {
            return Err(self.not_held(keys));
        }
        if settled.curved
            && let Some(more) = self.carry_covered(keys, &spheres)
        {
            return Ok(Some(more));
        }
        self.take_over(model, log, keys, (&spheres, &bodies, &settled));
        let opens = |(&key, fate): (&Key, &Fate)| (*fate == Fate::Opening).then_some(key);
        let opening: Short<Key> = keys.iter().zip(&settled.fate).filter_map(opens).collect();
        let (stuck, opening): (Short<Key>, Short<Key>) =
            opening.into_iter().partition(|&key| self.is_stuck(model, key, &bodies));
        if opening.is_empty() {
            let members = Members { spheres, bodies, contacts };
            self.begin_motion(model, keys, members, (settled.a, settled.forces, settled.curved), stuck);
            return Ok(None);
        }
        let interrupted = self.open(model, log, &opening);
        let stays = |index: &usize| opening.binary_search(&keys[*index]).is_err();
        let (kept, gone): (Short<usize>, Short<usize>) = (0..keys.len()).partition(stays);
        let left: Short<Key> = kept.iter().map(|&index| keys[index]).collect();
        let rounding = if settled.curved { SUM } else { 0.0 };
        let moved = |(i, body): (&usize, &Body)| {
            self.trajectories.trajectory(*i).v.distance(body.v) > rounding * body.v.length()
        };
        let carried = gone.iter().any(|&index| settled.forces[index] > 0.0);
        let moves = carried || interrupted || !settled.cleared || spheres.iter().zip(&bodies).any(moved);
        if moves || left.len() < 2 || self.groups(&left).len() > 1 {
            return Ok(Some(left));
        }
        // what opened carried nothing: the others are as they were solved with it, up to the rounding that opens it, which an
        // arc takes back at its end
        let members = self.members(model, &left);
        let a = members.spheres.iter().map(|&i| settled.a[spheres.partition_point(|&other| other < i)]).collect();
        let forces = kept.iter().map(|&index| settled.forces[index]).collect();
        self.begin_motion(model, &left, members, (a, forces, settled.curved), stuck);
        Ok(None)
    }

    /// Ends these rests, which open; whether bounces of one were summed up, which are told one by one from now on.
    fn open(&mut self, model: &Model, log: &mut Log, opening: &[Key]) -> bool {
        let mut interrupted = false;
        for &key in opening {
            if self.interrupt_bounces(model, log, key) {
                interrupted = true;
            } else {
                self.release(model, log, key);
            }
            self.ensure_separating(model, key, 0.0);
        }
        interrupted
    }

    /// Gives spheres what their island has been solved to, and writes what its contacts do.
    fn take_over(
        &mut self,
        model: &Model,
        log: &mut Log,
        keys: &[Key],
        (spheres, bodies, settled): (&[usize], &[Body], &Settled),
    ) {
        for (place, &i) in spheres.iter().enumerate() {
            self.trajectories.rewrite(i, bodies[place].x, bodies[place].v);
            self.trajectories.accelerate(i, settled.a[place] * self.share_of_pull(keys));
        }
        self.write_rest_events(model, log, keys, settled);
        self.rests.carry(keys, &settled.forces, self.trajectories.now);
    }

    /// Sends the members of an island on their way, on a curve or on parabolas, by their accelerations (m/s²) and the
    /// forces (N) of its contacts, of which those that are stuck are held for a moment.
    fn begin_motion(
        &mut self,
        model: &Model,
        keys: &[Key],
        Members { spheres, bodies, contacts }: Members,
        (a, forces, curved): (Vec<DVec3>, Vec<f64>, bool),
        stuck: Short<Key>,
    ) {
        let now = self.trajectories.now;
        let pause = if stuck.is_empty() { f64::INFINITY } else { self.pause(&bodies) };
        for key in stuck {
            self.rests.hold_until(key, now + pause);
        }
        if curved {
            let creeps = self.rests.hurried >= HURRIED;
            let curve = Curve::new(model, (bodies, a), (contacts, &forces), (now, creeps));
            self.set_chord(&spheres, curve.cut(pause.min(self.settling_time(keys) - now)));
        } else {
            let end = self.parts_end(model, &spheres, &contacts).min(self.settling_time(keys));
            let end = end.min(self.covered_end(model, &spheres));
            self.rests.insert_island(Island { spheres, end, curve: None }, now);
        }
    }

    /// Gives spheres what summed bounces that are over have left of the tangential velocity.
    fn rub_off(&mut self, model: &Model, keys: &[Key]) {
        for &key in keys {
            let held = self.rests.kept_mut(key);
            let Some(rub) = held.rub.take_if(|_| held.settles_at <= self.trajectories.now) else { continue };
            // what the bounces have taken is told as the begin of the rest, though something has told of one before
            held.announced = false;
            let (normal, line) =
                (self.trajectories.contact_state(model, key).normal, *self.trajectories.trajectory(key.1));
            self.trajectories.rewrite(key.1, line.x, rub.end(line.v, normal));
        }
    }

    /// Share of its acceleration that moves on a sphere whose only contact is one of bounces that were summed up; else 1.
    fn share_of_pull(&self, keys: &[Key]) -> f64 {
        let [key] = keys else { return 1.0 };
        self.rests.kept(*key).rub.map_or(1.0, |rub| rub.share)
    }

    /// How long contacts that keep being released and found again, at one instant or within such a time, are held, s: a
    /// moment in the time that these spheres would take to fall by their radius.
    fn pause(&self, bodies: &[Body]) -> f64 {
        let of = |body: &Body| body.r / (body.applied.length() + body.v.length_squared() / body.r);
        let squared = bodies.iter().map(of).fold(f64::INFINITY, f64::min);
        (PAUSE * squared.sqrt()).max(CLOCK_ULPS * self.trajectories.clock_ulp())
    }

    /// Whether a contact that opens has let go too often, at this instant or, where it opens by less than coordinates tell,
    /// within a pause: it is held for one. What opens by more than rounding is not, if that is above 1e-12 r in a pause.
    fn is_stuck(&mut self, model: &Model, key: Key, bodies: &[Body]) -> bool {
        let (now, pause) = (self.trajectories.now, self.pause(bodies));
        let contact = self.trajectories.contact_state(model, key);
        let of = |&i: &usize| {
            closed_speed(&Body::of(model, &self.trajectories, i), CLOCK_ULPS * self.trajectories.clock_ulp())
        };
        let slack = || Changed::of(key).spheres().iter().map(of).sum::<f64>();
        if contact.v_n * pause > SUMMED_HOP * contact.reach && contact.v_n > slack() {
            return false;
        }
        let creeps = contact.v_n <= self.creeping_speed(bodies);
        let again = creeps && self.rests.releases.is_stuck(key, now, pause);
        self.impacts.instant.is_stuck(key) || again
    }

    /// Fastest speed (m/s) that during a pause moves no body by more than coordinates tell.
    fn creeping_speed(&self, bodies: &[Body]) -> f64 {
        let size = bodies.iter().map(|body| body.x.abs().max_element().max(body.r)).fold(0.0, f64::max);
        HOP * size / self.pause(bodies)
    }

    /// By contact, the approach (m/s) from which on it must be closed, lest it be driven in while it is held for a moment;
    /// infinite of contacts that are not stuck.
    fn stuck_speeds(&self, keys: &[Key], bodies: &[Body]) -> Short<f64> {
        let now = self.trajectories.now;
        let sticks = |key: &Key| self.impacts.instant.sticks(*key) || self.rests.releases.sticks(*key, now);
        if !keys.iter().any(sticks) {
            return Short::from_elem(f64::INFINITY, keys.len());
        }
        let fastest = self.creeping_speed(bodies);
        keys.iter().map(|key| if sticks(key) { fastest } else { f64::INFINITY }).collect()
    }

    /// What some connected contacts name, at the present.
    fn members(&self, model: &Model, keys: &[Key]) -> Members {
        let mut spheres: Vec<usize> = Vec::with_capacity(2 * keys.len());
        for &(kind, a, b) in keys {
            spheres.push(a);
            spheres.extend((kind == Kind::Pair).then_some(b));
        }
        spheres.sort_unstable();
        spheres.dedup();
        let place = |i: usize| spheres.partition_point(|&other| other < i);
        let contact = |&key: &Key| {
            let (kind, a, b) = key;
            let part = self.rests.kept(key).part;
            let other = if kind == Kind::Wall { Other::Wall(b, part) } else { Other::Place(place(b)) };
            IslandContact { a: place(a), other }
        };
        let contacts = keys.iter().map(contact).collect();
        let bodies = spheres.iter().map(|&i| Body::of(model, &self.trajectories, i)).collect();
        Members { spheres, bodies, contacts }
    }

    /// Writes a `rest` row for every contact that begins to carry a load, and for every other one whose impulse stopped an
    /// approach, here or further up the pile: without it, a change of velocity would stand nowhere.
    fn write_rest_events(&mut self, model: &Model, log: &mut Log, keys: &[Key], settled: &Settled) {
        for (index, &key) in keys.iter().enumerate() {
            let held = self.rests.kept_mut(key);
            let begins = settled.fate[index] == Fate::Loaded && !held.announced;
            // a contact whose bounces are summed up rests when they are over, unless more than a bounce stops it
            let bounces = !held.announced && held.settles_at > self.trajectories.now;
            if !settled.struck[index] && (bounces || !begins) {
                continue;
            }
            let mut meeting = self.trajectories.contact_state(model, key);
            let struck = settled.struck[index] && !(bounces && is_a_bounce(model, &meeting, settled.impulses[index]));
            if !struck && (bounces || !begins) {
                held.untold += settled.impulses[index];
                continue;
            }
            meeting.v_n = if struck { settled.v_n[index] } else { held.v_n };
            (held.announced, held.untold) = (true, 0.0);
            log.tell(meeting.row(self.trajectories.now, Class::Rest, settled.impulses[index], 0.0));
        }
    }

    /// Time at which the first foot of an island on parabolas comes to the end of its part, s.
    fn parts_end(&self, model: &Model, spheres: &[usize], contacts: &[IslandContact]) -> f64 {
        let mut first = f64::INFINITY;
        for contact in contacts {
            if let Other::Wall(wall, part) = contact.other {
                let path = self.trajectories.path(spheres[contact.a], self.trajectories.now);
                let r = model.radii[spheres[contact.a]];
                if let Some(t) = part_end(&model.faces[wall], part, &path, r, first) {
                    first = first.min(t);
                }
            }
        }
        self.trajectories.now + first
    }

    /// Time at which the first of these contacts asks for its island to be settled again, s.
    fn settling_time(&self, keys: &[Key]) -> f64 {
        let ends = keys.iter().map(|&key| self.rests.kept(key)).map(|held| held.settles_at);
        ends.filter(|&end| end > self.trajectories.now).fold(f64::INFINITY, f64::min)
    }

    fn not_held(&self, keys: &[Key]) -> Stall {
        let reason = format!(
            "The support forces of {} resting contacts (sphere {} among them) could not be found at t = {} s; start them a little apart, or change the method from here.",
            keys.len(),
            keys[0].1,
            self.trajectories.now
        );
        Stall { time: self.trajectories.now, kind: StallKind::RestingContact, reason }
    }
}

/// Whether an impulse (N s) changes v_n by no more than one of the bounces that are summed up.
fn is_a_bounce(model: &Model, meeting: &ContactState, impulse: f64) -> bool {
    let (kind, a, b) = meeting.key;
    let of = |i: usize| (impulse * model.inverse_masses[i], model.acceleration(i).length());
    let ((one, pull), (other, more)) = (of(a), if kind == Kind::Pair { of(b) } else { (0.0, 0.0) });
    let change = one + other;
    change * change <= 8.0 * (pull + more) * SUMMED_HOP * meeting.reach
}
