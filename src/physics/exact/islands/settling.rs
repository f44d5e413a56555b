//! What an event does to the islands: spheres brought up to date, contacts released, islands settled anew.

use super::*;
use crate::physics::exact::class::SMALL_HOP;
use crate::physics::exact::rest::ROUNDING;

/// How long stuck contacts are held, in units of the time in which the spheres move by a radius: long enough that they
/// part by more than rounding, too short to be seen.
const PAUSE: f64 = 1e-7;

/// Contacts of one sphere are at one point if no farther apart than this, in radii: between rounding, and an angle at
/// which the approach to the second wall shows before it overlaps.
const SHARED_POINT: f64 = 1e-8;

/// Gap to a wall at such a point that counts as none, relative to the coordinates: 64 ulp.
const SHARED_GAP: f64 = 64.0 * f64::EPSILON;

impl<D: Detector> Exact<D> {
    /// Brings the line of sphere `i` to the present; if it moves on an arc, its whole island's, which must then settle.
    pub(in crate::physics::exact) fn bring(&mut self, model: &Model, i: usize) {
        let now = self.now;
        let island = self.rests.island_mut(i).filter(|island| island.curve.as_ref().is_some_and(|c| c.from < now));
        let Some(Island { spheres, curve: Some(curve), .. }) = island else {
            self.flight.bring(i, now);
            return;
        };
        let (spheres, followed) = (spheres.clone(), curve.clone());
        // the lines are off the chord now: it must not be followed, nor the step be read, any longer
        curve.from = f64::INFINITY;
        self.rests.keep(&spheres, &followed, now);
        let bodies = followed.real(model, now - followed.from);
        for (body, &sphere) in bodies.iter().zip(spheres.iter()) {
            self.flight.rewrite(sphere, now, body.x, body.v);
        }
        self.rests.dirty.push(i);
    }

    /// After an impulse on sphere `i`: a rest that is struck apart or driven together harder than rest allows is over.
    pub(in crate::physics::exact) fn disturb(&mut self, model: &Model, log: &mut Log, i: usize) {
        if self.rests.is_empty() || self.rests.of[i].is_empty() {
            return;
        }
        self.rests.dirty.push(i);
        for key in self.rests.of[i].clone() {
            let meeting = self.seen(model, key, self.now);
            if meeting.hops_within_rounding(self.pressure(model, key)) || self.instant.has_collapsed(key) {
                continue;
            }
            if meeting.v_n < -model.law.rest_speed && meeting.v_n < -1e-12 * self.flight.line(i).v.length() {
                if key.0 == Kind::Pair {
                    self.rests.dirty.extend([key.1, key.2]);
                }
                self.release(model, log, key);
            }
        }
    }

    fn release(&mut self, model: &Model, log: &mut Log, key: Key) {
        if self.rests.drop(key) {
            let meeting = self.seen(model, key, self.now);
            let row = meeting.row(self.now, Class::Release, 0.0, meeting.v_n);
            log.contacts.push(row);
            log.event(row);
        }
    }

    /// The parabolas of an island end: a foot comes to the end of its part, an arc or its chord is over.
    pub(in crate::physics::exact) fn end_parabola(&mut self, model: &Model, leader: usize) {
        let now = self.now;
        let Some(island) = self.rests.island(leader) else { return };
        let spheres = island.spheres.clone();
        if let Some(curve) = island.curve.clone().filter(|curve| !curve.changes) {
            self.rests.keep(&spheres, &curve, now);
            self.follow(&spheres, curve.next(model, now));
            return self.moved(model, &spheres);
        }
        for &i in &spheres {
            self.bring(model, i);
        }
        for &i in &spheres {
            let path = self.flight.path(i, now);
            for key in self.rests.of[i].clone().into_iter().filter(|key| key.0 == Kind::Wall) {
                let part = part_ahead(&model.faces[key.2], path.x, path.v, path.a, model.radii[i]);
                if let Some(held) = self.rests.held.get_mut(&key) {
                    held.part = part;
                }
            }
        }
        self.rests.dirty.push(leader);
    }

    /// Sends the spheres along a chord, and gives it to their island.
    fn follow(&mut self, spheres: &[usize], curve: Curve) {
        let h = curve.length;
        let accelerations = curve.arc.chord_accelerations(curve.offset, h);
        for ((&i, start), a) in spheres.iter().zip(curve.at(0.0)).zip(accelerations) {
            self.flight.rewrite(i, self.now, start.x, start.v);
            if h > 0.0 {
                self.flight.accelerate(i, a);
            }
        }
        let until = (self.now + h).max(self.now.next_up());
        match self.rests.island_mut(spheres[0]) {
            Some(island) => (island.end, island.curve) = (until, Some(curve)),
            None => {
                let island = Island { spheres: spheres.to_vec(), end: until, curve: Some(curve) };
                self.rests.found(island, self.now);
            }
        }
    }

    /// The motion of these spheres has changed: all their plans are made anew.
    fn moved(&mut self, model: &Model, spheres: &[usize]) {
        for &i in spheres {
            self.flight.stamp(i);
        }
        for &i in spheres {
            self.predict(model, i);
        }
    }

    /// No contact is left at this instant: decides what holds, island by island.
    pub(in crate::physics::exact) fn settle(&mut self, model: &Model, log: &mut Log) -> Result<(), Stall> {
        let spheres = self.rests.take_dirty();
        for &i in &spheres {
            self.bring(model, i);
        }
        self.rests.dirty.clear();
        for &i in &spheres {
            self.rests.dissolve(i, self.now);
        }
        for &i in &spheres {
            self.add_walls_at_point(model, i);
        }
        let keys: BTreeSet<Key> = spheres.iter().flat_map(|&i| self.rests.of[i].iter().copied()).collect();
        let mut open: Vec<Vec<Key>> = vec![keys.into_iter().collect()];
        while let Some(keys) = open.pop() {
            for connected in self.groups(&keys) {
                if let Some(left) = self.settle_island(model, log, &connected)? {
                    open.push(left);
                }
            }
        }
        for &i in &spheres {
            if self.rests.of[i].is_empty() {
                self.flight.accelerate(i, model.acceleration(i));
            }
            self.finite(i)?;
        }
        self.moved(model, &spheres);
        Ok(())
    }

    /// Adds the walls that share a resting contact's point with its wall: the tile beyond a seam, the slope beyond a
    /// ridge. Their gap and its rate of change are 0 then, so that no approach announces them; unless they belong to the
    /// island when the closest point moves on to them, the sphere would sink in.
    fn add_walls_at_point(&mut self, model: &Model, i: usize) {
        if !self.rests.of[i].iter().any(|key| key.0 == Kind::Wall) {
            return;
        }
        let path = self.flight.path(i, self.now);
        let r = model.radii[i];
        let shared = |wall: usize, part: Part| touch_part(&model.faces[wall], part, path.x, r);
        let held: Vec<(usize, Touch)> = (self.rests.of[i].iter().filter(|key| key.0 == Kind::Wall))
            .filter_map(|key| Some((key.2, shared(key.2, self.rests.held.get(key)?.part))))
            .collect();
        let size = path.x.abs().max_element().max(r);
        let open = held.iter().map(|(_, at)| at.gap).fold(0.0, f64::max);
        let most = open + SHARED_GAP * size;
        for wall in 0..model.faces.len() {
            if held.iter().any(|&(other, _)| other == wall) {
                continue;
            }
            let at = touch(&model.faces[wall], path.x, r);
            let near = |(_, held): &(usize, Touch)| {
                held.point.distance_squared(at.point) <= (SHARED_POINT * r) * (SHARED_POINT * r)
            };
            if at.gap > most || !held.iter().any(near) {
                continue;
            }
            let meeting = self.seen(model, (Kind::Wall, i, wall), self.now);
            let pull = model.acceleration(i).length();
            if meeting.v_n.abs() <= ROUNDING * path.v.length() || meeting.hops_within_rounding(pull) {
                self.rests.propose(model, &self.flight, self.now, &meeting, self.now);
            }
        }
    }

    /// The connected sets of some contacts.
    fn groups(&self, keys: &[Key]) -> Vec<Vec<Key>> {
        let links: Vec<_> = keys.iter().map(|&(kind, a, b)| (a, (kind == Kind::Pair).then_some(b))).collect();
        islands(&links).iter().map(|island| island.contacts.iter().map(|&c| keys[c]).collect()).collect()
    }

    /// Settles connected contacts; returns those that are left if some opened, for they may have fallen apart.
    fn settle_island(&mut self, model: &Model, log: &mut Log, keys: &[Key]) -> Result<Option<Vec<Key>>, Stall> {
        self.rub_off(model, keys);
        let (spheres, mut bodies, contacts) = self.island_of(model, keys);
        let settled = settle(&mut bodies, &closed(model, &contacts), ZENO * self.tick());
        if !settled.converged {
            return Err(self.not_held(keys));
        }
        for (place, &i) in spheres.iter().enumerate() {
            self.flight.rewrite(i, self.now, bodies[place].x, bodies[place].v);
            self.flight.accelerate(i, settled.a[place] * self.share_of_pull(keys));
        }
        self.announce(model, log, keys, &settled);
        self.carry(keys, &settled.forces);
        let opens = |(&key, fate): (&Key, &Fate)| (*fate == Fate::Opening).then_some(key);
        let opening: Vec<Key> = keys.iter().zip(&settled.fate).filter_map(opens).collect();
        let (stuck, opening): (Vec<Key>, Vec<Key>) = opening.into_iter().partition(|&key| self.instant.is_stuck(key));
        for &key in &opening {
            self.release(model, log, key);
            self.part(model, key, 0.0);
        }
        if !opening.is_empty() {
            let kept = keys.iter().filter(|key| opening.binary_search(key).is_err());
            return Ok(Some(kept.copied().collect()));
        }
        let pause = if stuck.is_empty() { f64::INFINITY } else { self.pause(&bodies) };
        for key in stuck {
            self.rests.hold_until(key, self.now + pause);
        }
        if settled.curved {
            self.follow(
                &spheres,
                Curve::new(model, bodies, contacts, self.now).cut(pause.min(self.rubbing_time(keys) - self.now)),
            );
        } else {
            let end = self.parts_end(model, &spheres, &contacts).min(self.settling_time(keys));
            self.rests.found(Island { spheres, end, curve: None }, self.now);
        }
        Ok(None)
    }

    /// Bounces that were summed up are over: what they have left of the tangential velocity.
    fn rub_off(&mut self, model: &Model, keys: &[Key]) {
        for &key in keys {
            let due = |held: &&mut Held| held.settles_at <= self.now;
            let Some(rub) = self.rests.held.get_mut(&key).filter(due).and_then(|held| held.rub.take()) else {
                continue;
            };
            let (normal, line) = (self.seen(model, key, self.now).normal, *self.flight.line(key.1));
            self.flight.rewrite(key.1, self.now, line.x, rub.end(line.v, normal));
        }
    }

    /// When the first series of bounces of these contacts that was summed up is over, s.
    fn rubbing_time(&self, keys: &[Key]) -> f64 {
        let held = keys.iter().filter_map(|key| self.rests.held.get(key)).filter(|held| held.rub.is_some());
        held.map(|held| held.settles_at).filter(|&end| end > self.now).fold(f64::INFINITY, f64::min)
    }

    /// How much of its acceleration moves on a sphere whose only contact is one of bounces that were summed up.
    fn share_of_pull(&self, keys: &[Key]) -> f64 {
        let [key] = keys else { return 1.0 };
        self.rests.held.get(key).and_then(|held| held.rub).map_or(1.0, |rub| rub.share)
    }

    /// How long contacts that keep being released and found again at one instant are held all the same, s: a moment in
    /// the time that these spheres would take to fall by their radius.
    fn pause(&self, bodies: &[Body]) -> f64 {
        let of = |body: &Body| body.r / (body.applied.length() + body.v.length_squared() / body.r);
        let squared = bodies.iter().map(of).fold(f64::INFINITY, f64::min);
        (PAUSE * squared.sqrt()).max(ZENO * self.tick())
    }

    /// The spheres that some connected contacts name, as bodies at the present, and those contacts.
    fn island_of(&self, model: &Model, keys: &[Key]) -> (Vec<usize>, Vec<Body>, Vec<Contact>) {
        let named = |&(kind, a, b): &Key| [Some(a), (kind == Kind::Pair).then_some(b)];
        let spheres: BTreeSet<usize> = keys.iter().flat_map(named).flatten().collect();
        let spheres: Vec<usize> = spheres.into_iter().collect();
        let place = |i: usize| spheres.partition_point(|&other| other < i);
        let contact = |&key: &Key| {
            let (kind, a, b) = key;
            let part = self.rests.held.get(&key).map_or(Part::Face, |held| held.part);
            let other = if kind == Kind::Wall { Other::Wall(b, part) } else { Other::Place(place(b)) };
            Contact { a: place(a), other }
        };
        let contacts = keys.iter().map(contact).collect();
        let bodies = spheres.iter().map(|&i| self.body(model, i)).collect();
        (spheres, bodies, contacts)
    }

    /// Sphere `i`, whose line is at the present, as a body of an island.
    pub(in crate::physics::exact) fn body(&self, model: &Model, i: usize) -> Body {
        Body {
            x: self.flight.line(i).x,
            v: self.flight.line(i).v,
            applied: model.acceleration(i),
            inverse_mass: model.inverse_masses[i],
            r: model.radii[i],
        }
    }

    /// Writes a `rest` row for every contact that begins to carry a load, and for every other one whose impulse stopped an
    /// approach, here or further up the pile: without it, a change of velocity would stand nowhere.
    fn announce(&mut self, model: &Model, log: &mut Log, keys: &[Key], settled: &Settled) {
        for (index, &key) in keys.iter().enumerate() {
            let mut meeting = self.seen(model, key, self.now);
            let Some(held) = self.rests.held.get_mut(&key) else { continue };
            let begins = settled.fate[index] == Fate::Loaded && !held.announced;
            // a contact whose bounces are summed up rests when they are over, unless more than a bounce stops it
            let bounces = !held.announced && held.settles_at > self.now;
            let struck = settled.struck[index] && !(bounces && is_a_bounce(model, &meeting, settled.impulses[index]));
            if !struck && (bounces || !begins) {
                continue;
            }
            meeting.v_n = if struck { settled.v_n[index] } else { held.v_n };
            held.announced = true;
            let row = meeting.row(self.now, Class::Rest, settled.impulses[index], 0.0);
            log.contacts.push(row);
            log.event(row);
        }
    }

    /// When the first foot of an island on parabolas comes to the end of its part, s.
    fn parts_end(&self, model: &Model, spheres: &[usize], contacts: &[Contact]) -> f64 {
        let mut first = f64::INFINITY;
        for contact in contacts {
            if let Other::Wall(wall, part) = contact.other {
                let path = self.flight.path(spheres[contact.a], self.now);
                let r = model.radii[spheres[contact.a]];
                if let Some(t) = part_end(&model.faces[wall], part, &path, r, first) {
                    first = first.min(t);
                }
            }
        }
        self.now + first
    }

    /// When the first of these contacts asks for its island to be settled again, s.
    fn settling_time(&self, keys: &[Key]) -> f64 {
        let ends = keys.iter().filter_map(|key| self.rests.held.get(key)).map(|held| held.settles_at);
        ends.filter(|&end| end > self.now).fold(f64::INFINITY, f64::min)
    }

    fn not_held(&self, keys: &[Key]) -> Stall {
        let reason = format!(
            "The support forces of {} resting contacts (sphere {} among them) could not be found at t = {} s; start them a little apart, or change the method from here.",
            keys.len(),
            keys[0].1,
            self.now
        );
        Stall { time: self.now, kind: "resting-contact", reason }
    }
}

/// Whether an impulse (N s) changes v_n by no more than one of the bounces that are summed up.
fn is_a_bounce(model: &Model, meeting: &Meeting, impulse: f64) -> bool {
    let (kind, a, b) = meeting.key;
    let of = |i: usize| (impulse * model.inverse_masses[i], model.acceleration(i).length());
    let ((one, pull), (other, more)) = (of(a), if kind == Kind::Pair { of(b) } else { (0.0, 0.0) });
    let change = one + other;
    change * change <= 8.0 * (pull + more) * SMALL_HOP * meeting.reach
}
