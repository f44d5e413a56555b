//! Which contacts rest, and the islands they form: from one event of an island to the next.

use std::collections::{BTreeMap, BTreeSet};

use super::Exact;
use super::curved::{Arc, Body, Closed, On};
use super::flight::Flight;
use super::impact::{Meeting, ZENO};
use super::rest::{Settled, settle};
use crate::physics::contact::Key;
use crate::physics::contact_time::Part;
use crate::physics::log::Log;
use crate::physics::parts::{part_ahead, part_end};
use crate::physics::support::{Fate, islands};
use crate::physics::{Class, Kind, Model, Stall, State};

/// No island.
const NONE: u32 = u32::MAX;

/// A contact that rests, or is about to.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Held {
    /// The part of the wall it rests on; for pairs without meaning.
    part: Part,
    /// Whether its `rest` row has been written.
    announced: bool,
    /// v_n when it was proposed, m/s.
    v_n: f64,
    /// Until when ever smaller bounces go on in truth, s: the rest is announced then.
    bounces_until: f64,
}

/// Spheres connected by resting contacts, until something changes.
#[derive(Debug, Clone)]
struct Island {
    /// Ascending; the first leads: its entry in the queue stands for the island.
    spheres: Vec<usize>,
    /// When its parabolas end, s.
    end: f64,
    curve: Option<Curve>,
}

/// A curved motion, and the chord parabola that stands for it now.
#[derive(Debug, Clone)]
struct Curve {
    arc: Arc,
    contacts: Vec<Contact>,
    /// Where on the arc the chord begins, s.
    offset: f64,
    /// When the chord began, s; infinite once the spheres have been brought off it.
    from: f64,
    /// Its length, s.
    length: f64,
    /// Whether a contact lets go or changes its part at the end.
    changes: bool,
}

/// A contact of an island: its sphere by its place there, and what it touches.
#[derive(Debug, Clone, Copy)]
struct Contact {
    a: usize,
    other: Other,
}

#[derive(Debug, Clone, Copy)]
enum Other {
    Wall(usize, Part),
    Place(usize),
}

impl Contact {
    fn closed(self, model: &Model) -> Closed<'_> {
        let on = match self.other {
            Other::Wall(wall, part) => On::Wall(&model.faces[wall], part),
            Other::Place(place) => On::Body(place),
        };
        Closed { a: self.a, on }
    }
}

fn closed<'a>(model: &'a Model, contacts: &[Contact]) -> Vec<Closed<'a>> {
    contacts.iter().map(|contact| contact.closed(model)).collect()
}

impl Curve {
    /// The motion of bodies from now on.
    fn new(model: &Model, bodies: Vec<Body>, contacts: Vec<Contact>, now: f64) -> Curve {
        let arc = Arc::new(bodies, &closed(model, &contacts));
        Curve { arc, contacts, offset: 0.0, from: now, length: 0.0, changes: false }.chord()
    }

    /// The next chord, on this arc or on the one after it.
    fn next(self, model: &Model, now: f64) -> Curve {
        let offset = self.offset + self.length;
        if offset < self.arc.length {
            return Curve { offset, from: now, ..self }.chord();
        }
        let arc = self.arc.go_on(&closed(model, &self.contacts));
        Curve { arc, offset: 0.0, from: now, ..self }.chord()
    }

    /// Lays a chord from `offset` on.
    fn chord(mut self) -> Curve {
        let left = self.arc.length - self.offset;
        self.length = self.arc.chord(self.offset);
        self.changes = self.arc.changes && self.length >= left;
        self
    }

    /// The spheres `time` (s) after the chord's beginning.
    fn at(&self, time: f64) -> Vec<Body> {
        self.arc.at(self.offset + time.min(self.length))
    }
}

/// All resting contacts.
#[derive(Debug, Clone, Default)]
pub(super) struct Rests {
    held: BTreeMap<Key, Held>,
    /// Contacts by sphere; empty until something rests.
    of: Vec<Vec<Key>>,
    islands: Vec<Option<Island>>,
    vacant: Vec<u32>,
    island_of: Vec<u32>,
    /// Spheres whose islands must be settled before the clock goes on.
    dirty: Vec<usize>,
    curves: usize,
    curved_since: f64,
    curved_time: f64,
}

impl Rests {
    /// Whether nothing rests.
    #[inline]
    pub(super) fn is_empty(&self) -> bool {
        self.of.is_empty()
    }

    /// Whether this contact rests.
    #[inline]
    pub(super) fn holds(&self, key: Key) -> bool {
        !self.of.is_empty() && !self.of[key.1].is_empty() && self.held.contains_key(&key)
    }

    /// How many contacts of sphere `i` rest.
    pub(super) fn count(&self, i: usize) -> usize {
        self.of.get(i).map_or(0, Vec::len)
    }

    /// Whether islands wait to be settled.
    #[inline]
    pub(super) fn is_dirty(&self) -> bool {
        !self.dirty.is_empty()
    }

    /// When the island led by sphere `i` ends its parabolas, s; infinite if it leads none.
    #[inline]
    pub(super) fn end_led_by(&self, i: usize) -> f64 {
        match self.island(i) {
            Some(island) if island.spheres[0] == i => island.end,
            _ => f64::INFINITY,
        }
    }

    #[inline]
    fn island(&self, i: usize) -> Option<&Island> {
        let &number = self.island_of.get(i)?;
        self.islands.get(number as usize)?.as_ref()
    }

    /// Time spent in curved rest until `now`, s.
    pub(super) fn curved_time(&self, now: f64) -> f64 {
        self.curved_time + if self.curves > 0 { now - self.curved_since } else { 0.0 }
    }

    fn count_curves(&mut self, now: f64, change: isize) {
        self.curved_time = self.curved_time(now);
        self.curved_since = now;
        self.curves = self.curves.saturating_add_signed(change);
    }

    /// A contact may rest from now on: the island it belongs to will decide.
    pub(super) fn propose(&mut self, model: &Model, flight: &Flight, now: f64, meeting: &Meeting, bounces_until: f64) {
        let (kind, a, b) = meeting.key;
        let part = match kind {
            Kind::Wall => {
                let path = flight.path(a, now);
                let v = path.v - meeting.normal * meeting.v_n;
                part_ahead(&model.faces[b], path.x, v, path.a, model.radii[a])
            }
            Kind::Pair => Part::Face,
        };
        if self.of.is_empty() {
            self.of = vec![Vec::new(); model.len()];
            self.island_of = vec![NONE; model.len()];
        }
        let held = Held { part, announced: false, v_n: meeting.v_n, bounces_until };
        if self.held.insert(meeting.key, held).is_none() {
            self.of[a].push(meeting.key);
            if kind == Kind::Pair {
                self.of[b].push(meeting.key);
            }
        }
        self.dirty.push(a);
    }

    /// A contact rests no longer; returns whether its rest had been announced.
    fn drop(&mut self, key: Key) -> bool {
        let (kind, a, b) = key;
        self.of[a].retain(|&other| other != key);
        if kind == Kind::Pair {
            self.of[b].retain(|&other| other != key);
        }
        self.held.remove(&key).is_some_and(|held| held.announced)
    }

    /// The spheres of every island that a dirty sphere belongs or is connected to, ascending.
    fn take_dirty(&mut self) -> Vec<usize> {
        let mut found = BTreeSet::new();
        let mut open = std::mem::take(&mut self.dirty);
        while let Some(i) = open.pop() {
            if !found.insert(i) {
                continue;
            }
            if let Some(island) = self.island(i) {
                open.extend(&island.spheres);
            }
            for &(kind, a, b) in self.of.get(i).into_iter().flatten() {
                open.push(a);
                if kind == Kind::Pair {
                    open.push(b);
                }
            }
        }
        found.into_iter().collect()
    }

    fn dissolve(&mut self, i: usize, now: f64) {
        let number = self.island_of[i];
        if number == NONE {
            return;
        }
        if let Some(island) = self.islands[number as usize].take() {
            self.vacant.push(number);
            for &sphere in &island.spheres {
                self.island_of[sphere] = NONE;
            }
            if island.curve.is_some() {
                self.count_curves(now, -1);
            }
        }
    }

    fn found(&mut self, island: Island, now: f64) {
        if island.curve.is_some() {
            self.count_curves(now, 1);
        }
        let number = self.vacant.pop().unwrap_or(self.islands.len() as u32);
        for &sphere in &island.spheres {
            self.island_of[sphere] = number;
        }
        if number as usize == self.islands.len() {
            self.islands.push(None);
        }
        self.islands[number as usize] = Some(island);
    }

    /// Puts the spheres of curved islands where their arcs are, in a state read at or after the last event.
    pub(super) fn bend(&self, state: &mut State) {
        for island in self.islands.iter().flatten() {
            let Some(curve) = &island.curve else { continue };
            if curve.from > state.t {
                continue;
            }
            let bodies = curve.at(state.t - curve.from);
            for (body, &i) in bodies.iter().zip(&island.spheres) {
                (state.x[i], state.v[i]) = (body.x, body.v);
            }
        }
    }
}

impl Exact {
    /// Brings the line of sphere `i` to the present; if it moves on an arc, its whole island's, which must then settle.
    pub(super) fn bring(&mut self, i: usize) {
        let now = self.now;
        let island = self.rests.island_mut(i).filter(|island| island.curve.as_ref().is_some_and(|c| c.from < now));
        let Some(Island { spheres, curve: Some(curve), .. }) = island else {
            self.flight.bring(i, now);
            return;
        };
        let bodies = curve.at(now - curve.from);
        // the lines are off the chord now: it must not be followed, nor the step be read, any longer
        curve.from = f64::INFINITY;
        for (body, &sphere) in bodies.iter().zip(spheres.iter()) {
            self.flight.rewrite(sphere, now, body.x, body.v);
        }
        self.rests.dirty.push(i);
    }

    /// After an impulse on sphere `i`: a rest that is struck apart or driven together harder than rest allows is over.
    pub(super) fn disturb(&mut self, model: &Model, log: &mut Log, i: usize) {
        if self.rests.is_empty() || self.rests.of[i].is_empty() {
            return;
        }
        self.rests.dirty.push(i);
        for key in self.rests.of[i].clone() {
            let meeting = self.seen(model, key);
            if meeting.v_n < -model.law.rest_speed && meeting.v_n < -1e-12 * self.flight.lines[i].v.length() {
                if key.0 == Kind::Pair {
                    self.rests.dirty.extend([key.1, key.2]);
                }
                self.release(model, log, key);
            }
        }
    }

    fn release(&mut self, model: &Model, log: &mut Log, key: Key) {
        if self.rests.drop(key) {
            let meeting = self.seen(model, key);
            let row = meeting.row(self.now, Class::Release, 0.0, meeting.v_n);
            log.contacts.push(row);
            log.event(row);
        }
    }

    /// The parabolas of an island end: a foot comes to the end of its part, an arc or its chord is over.
    pub(super) fn end_parabola(&mut self, model: &Model, leader: usize) {
        let now = self.now;
        let Some(island) = self.rests.island(leader) else { return };
        let spheres = island.spheres.clone();
        if let Some(curve) = island.curve.clone().filter(|curve| !curve.changes) {
            self.follow(&spheres, curve.next(model, now));
            return self.moved(model, &spheres);
        }
        for &i in &spheres {
            self.bring(i);
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
        for ((&i, start), end) in spheres.iter().zip(curve.at(0.0)).zip(curve.at(h)) {
            self.flight.rewrite(i, self.now, start.x, start.v);
            if h > 0.0 {
                self.flight.accelerate(i, (end.x - start.x - start.v * h) * (2.0 / (h * h)));
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
            self.stamps[i] = self.stamps[i].wrapping_add(1);
        }
        for &i in spheres {
            self.predict(model, i);
        }
    }

    /// No contact is left at this instant: decides what holds, island by island.
    pub(super) fn settle(&mut self, model: &Model, log: &mut Log) -> Result<(), Stall> {
        let spheres = self.rests.take_dirty();
        for &i in &spheres {
            self.bring(i);
        }
        self.rests.dirty.clear();
        for &i in &spheres {
            self.rests.dissolve(i, self.now);
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

    /// The connected sets of some contacts.
    fn groups(&self, keys: &[Key]) -> Vec<Vec<Key>> {
        let links: Vec<_> = keys.iter().map(|&(kind, a, b)| (a, (kind == Kind::Pair).then_some(b))).collect();
        islands(&links).iter().map(|island| island.contacts.iter().map(|&c| keys[c]).collect()).collect()
    }

    /// Settles connected contacts; returns those that are left if some opened, for they may have fallen apart.
    fn settle_island(&mut self, model: &Model, log: &mut Log, keys: &[Key]) -> Result<Option<Vec<Key>>, Stall> {
        let (spheres, mut bodies, contacts) = self.island_of(model, keys);
        let settled = settle(&mut bodies, &closed(model, &contacts), ZENO * self.tick());
        if !settled.converged {
            return Err(self.not_held(keys));
        }
        for (place, &i) in spheres.iter().enumerate() {
            self.flight.rewrite(i, self.now, bodies[place].x, bodies[place].v);
            self.flight.accelerate(i, settled.a[place]);
        }
        self.announce(model, log, keys, &settled);
        let pick = |opening: bool| {
            let of = |(_, fate): &(&Key, &Fate)| (**fate == Fate::Opening) == opening;
            keys.iter().zip(&settled.fate).filter(of).map(|(&key, _)| key).collect::<Vec<Key>>()
        };
        let (opening, kept) = (pick(true), pick(false));
        for &key in &opening {
            self.release(model, log, key);
            self.part(model, key, 0.0);
        }
        if !opening.is_empty() {
            return Ok(Some(kept));
        }
        if settled.curved {
            self.follow(&spheres, Curve::new(model, bodies, contacts, self.now));
        } else {
            let end = self.parts_end(model, &spheres, &contacts).min(self.bounces_end(keys));
            self.rests.found(Island { spheres, end, curve: None }, self.now);
        }
        Ok(None)
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
        let body = |&i: &usize| Body {
            x: self.flight.lines[i].x,
            v: self.flight.lines[i].v,
            applied: model.acceleration(i),
            inverse_mass: model.inverse_masses[i],
            r: model.radii[i],
        };
        let bodies = spheres.iter().map(body).collect();
        (spheres, bodies, contacts)
    }

    /// Writes a `rest` row for every contact that begins to carry a load.
    fn announce(&mut self, model: &Model, log: &mut Log, keys: &[Key], settled: &Settled) {
        for (index, &key) in keys.iter().enumerate() {
            let mut meeting = self.seen(model, key);
            let Some(held) = self.rests.held.get_mut(&key) else { continue };
            if settled.fate[index] != Fate::Loaded || held.announced || held.bounces_until > self.now {
                continue;
            }
            held.announced = true;
            meeting.v_n = held.v_n;
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
                if let Some(t) = part_end(&model.faces[wall], part, &path, first) {
                    first = first.min(t);
                }
            }
        }
        self.now + first
    }

    /// When the first bounces of these contacts that still go on come to their end, s.
    fn bounces_end(&self, keys: &[Key]) -> f64 {
        let ends = keys.iter().filter_map(|key| self.rests.held.get(key)).map(|held| held.bounces_until);
        ends.filter(|&end| end > self.now).fold(f64::INFINITY, f64::min)
    }

    fn not_held(&self, keys: &[Key]) -> Stall {
        let reason = format!(
            "The support forces of {} resting contacts (sphere {} among them) could not be found at t = {} s; use the method moreau.",
            keys.len(),
            keys[0].1,
            self.now
        );
        Stall { time: self.now, kind: "resting-contact", reason }
    }
}

impl Rests {
    fn island_mut(&mut self, i: usize) -> Option<&mut Island> {
        let number = *self.island_of.get(i)?;
        self.islands.get_mut(number as usize)?.as_mut()
    }
}
