//! Which contacts rest, and the islands they form: from one event of an island to the next.

use std::collections::{BTreeMap, BTreeSet};

use super::Exact;
use super::curved::Arc;
use super::flight::Flight;
use super::impact::Meeting;
use super::rest::{Group, Motion, On, Rest, Settled, part_ahead, part_end};
use crate::physics::contact_time::Part;
use crate::physics::contact::Key;
use crate::physics::log::Log;
use crate::physics::support::{Fate, islands};
use crate::physics::{Class, Kind, Model, Stall, State};

/// No island.
const NONE: u32 = u32::MAX;

/// How far a parabola may depart from the arc it stands for: 1e-13 of the radius, below what predictions resolve.
const DEPARTURE: f64 = 1e-13;

/// A contact that rests, or is about to.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Held {
    /// The part of the wall it rests on; for pairs without meaning.
    part: Part,
    /// Whether its `rest` row has been written.
    announced: bool,
    /// How it came about: the row it gets when its load is known.
    meeting: Option<f64>,
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

/// A curved motion and the chord that stands for it.
#[derive(Debug, Clone)]
struct Curve {
    arc: Box<Arc>,
    /// When the arc began, s.
    began: f64,
    /// When the chord began, s.
    from: f64,
    /// Its length, s.
    chord: f64,
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
    pub(super) fn propose(&mut self, model: &Model, flight: &Flight, now: f64, meeting: &Meeting) {
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
        let held = Held { part, announced: false, meeting: Some(meeting.v_n) };
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
    pub(super) fn bend(&self, model: &Model, state: &mut State) {
        for island in self.islands.iter().flatten() {
            let Some(curve) = &island.curve else { continue };
            if curve.from > state.t {
                continue;
            }
            let group = curve.arc.at(model, state.t - curve.began);
            for (place, &i) in group.spheres.iter().enumerate() {
                (state.x[i], state.v[i]) = (group.x[place], group.v[place]);
            }
        }
    }
}

impl Exact {
    /// Brings the line of sphere `i` to the present; if it moves on an arc, its whole island's, which must then settle.
    pub(super) fn bring(&mut self, model: &Model, i: usize) {
        let now = self.now;
        let curved = self.rests.island(i).and_then(|island| island.curve.as_ref()).filter(|curve| curve.from < now);
        let Some(group) = curved.map(|curve| curve.arc.at(model, now - curve.began)) else {
            self.flight.bring(i, now);
            return;
        };
        for (place, &sphere) in group.spheres.iter().enumerate() {
            self.flight.rewrite(sphere, now, group.x[place], group.v[place]);
        }
        self.rests.dirty.push(i);
        // the lines are off the old chord: it must not be followed, nor the arc be read, any longer
        if let Some(curve) = self.rests.curve_mut(i) {
            curve.from = f64::INFINITY;
        }
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
        if let Some(curve) = island.curve.clone()
            && now < curve.began + curve.arc.length
        {
            return self.next_chord(model, &spheres, curve);
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

    fn next_chord(&mut self, model: &Model, spheres: &[usize], mut curve: Curve) {
        let group = curve.arc.at(model, self.now - curve.began);
        let end = self.chord(model, &group, &mut curve);
        if let Some(island) = self.rests.island_mut(spheres[0]) {
            (island.end, island.curve) = (end, Some(curve));
        }
        for &i in spheres {
            self.stamps[i] = self.stamps[i].wrapping_add(1);
        }
        for &i in spheres {
            self.predict(model, i);
        }
    }

    /// Lays parabolas along an arc from `group` (now) on, as far as they stay close; returns until when, s.
    fn chord(&mut self, model: &Model, group: &Group, curve: &mut Curve) -> f64 {
        let start = self.now - curve.began;
        let left = curve.arc.length - start;
        let mut h = curve.chord.min(left);
        let allowed = |i: usize| {
            let size = group.x[i].abs().max_element();
            (DEPARTURE * model.radii[group.spheres[i]]).max(16.0 * f64::EPSILON * size)
        };
        for _ in 0..200 {
            let (middle, end) = (curve.arc.at(model, start + 0.5 * h), curve.arc.at(model, start + h));
            let bend = |i: usize| (end.x[i] - group.x[i] - group.v[i] * h) * (2.0 / (h * h));
            let off = |i: usize| {
                let chord = group.x[i] + (group.v[i] + bend(i) * (0.25 * h)) * (0.5 * h);
                (chord - middle.x[i]).length() / allowed(i)
            };
            let worst = (0..group.spheres.len()).map(off).fold(0.0, f64::max);
            if worst <= 1.0 || self.now + 0.5 * h == self.now {
                for (place, &i) in group.spheres.iter().enumerate() {
                    self.flight.rewrite(i, self.now, group.x[place], group.v[place]);
                    self.flight.accelerate(i, bend(place));
                }
                curve.from = self.now;
                curve.chord = if worst < 0.1 { 2.0 * h } else { h };
                break;
            }
            // departure grows with h³
            h *= if worst > 64.0 { 0.25 } else { 0.5 };
        }
        // the last chord ends where the arc does, to the bit
        let end = if h >= left { curve.began + curve.arc.length } else { self.now + h };
        end.max(self.now.next_up())
    }

    /// No contact is left at this instant: decides what holds, island by island.
    pub(super) fn settle(&mut self, model: &Model, log: &mut Log) -> Result<(), Stall> {
        let spheres = self.rests.take_dirty();
        for &i in &spheres {
            self.bring(model, i);
        }
        self.rests.dirty.clear();
        for &i in &spheres {
            self.rests.dissolve(i, self.now);
        }
        let keys: BTreeSet<Key> = spheres.iter().flat_map(|&i| self.rests.of[i].iter().copied()).collect();
        let mut open: Vec<Vec<Key>> = vec![keys.into_iter().collect()];
        while let Some(keys) = open.pop() {
            for group in self.groups(&keys) {
                if let Some(left) = self.settle_group(model, log, &group)? {
                    open.push(left);
                }
            }
        }
        for &i in &spheres {
            if self.rests.of[i].is_empty() {
                self.flight.accelerate(i, model.acceleration(i));
            }
            self.finite(i)?;
            self.stamps[i] = self.stamps[i].wrapping_add(1);
        }
        for &i in &spheres {
            self.predict(model, i);
        }
        Ok(())
    }

    /// The connected sets of some contacts.
    fn groups(&self, keys: &[Key]) -> Vec<Vec<Key>> {
        let links: Vec<_> = keys.iter().map(|&(kind, a, b)| (a, (kind == Kind::Pair).then_some(b))).collect();
        islands(&links).iter().map(|island| island.contacts.iter().map(|&c| keys[c]).collect()).collect()
    }

    /// Settles connected contacts; returns those that are left if some opened, for they may have fallen apart.
    fn settle_group(&mut self, model: &Model, log: &mut Log, keys: &[Key]) -> Result<Option<Vec<Key>>, Stall> {
        let mut group = self.group(keys);
        let settled = group.settle(model);
        if !settled.converged {
            return Err(self.not_held(keys));
        }
        for (place, &i) in group.spheres.iter().enumerate() {
            self.flight.rewrite(i, self.now, group.x[place], group.v[place]);
            self.flight.accelerate(i, settled.a[place]);
        }
        self.announce(model, log, keys, &settled);
        let (opening, kept): (Vec<_>, Vec<_>) =
            keys.iter().zip(&settled.fate).partition(|&(_, &fate)| fate == Fate::Opening);
        for (&key, _) in &opening {
            self.release(model, log, key);
            self.part(model, key);
        }
        if !opening.is_empty() {
            return Ok(Some(kept.into_iter().map(|(&key, _)| key).collect()));
        }
        self.found_island(model, group, &settled);
        Ok(None)
    }

    fn group(&self, keys: &[Key]) -> Group {
        let mut spheres: Vec<usize> =
            keys.iter().flat_map(|&(kind, a, b)| [Some(a), (kind == Kind::Pair).then_some(b)]).flatten().collect();
        spheres.sort_unstable();
        spheres.dedup();
        let rest = |&(kind, a, b): &Key| {
            let on = match kind {
                Kind::Wall => On::Wall(b, self.rests.held.get(&(kind, a, b)).map_or(Part::Face, |held| held.part)),
                Kind::Pair => On::Sphere(b),
            };
            Rest { a, on }
        };
        let (x, v) = spheres.iter().map(|&i| (self.flight.lines[i].x, self.flight.lines[i].v)).unzip();
        Group { rests: keys.iter().map(rest).collect(), spheres, x, v }
    }

    /// Writes a `rest` row for every contact that begins to carry a load.
    fn announce(&mut self, model: &Model, log: &mut Log, keys: &[Key], settled: &Settled) {
        for (index, &key) in keys.iter().enumerate() {
            let mut meeting = self.seen(model, key);
            let Some(held) = self.rests.held.get_mut(&key) else { continue };
            if settled.fate[index] != Fate::Loaded || held.announced {
                continue;
            }
            held.announced = true;
            meeting.v_n = held.meeting.take().unwrap_or(0.0);
            let row = meeting.row(self.now, Class::Rest, settled.impulses[index], 0.0);
            log.contacts.push(row);
            log.event(row);
        }
    }

    /// From now on these spheres move together.
    fn found_island(&mut self, model: &Model, group: Group, settled: &Settled) {
        let spheres = group.spheres.clone();
        if settled.motion != Motion::Curved {
            let end = self.parts_end(model, &group);
            return self.rests.found(Island { spheres, end, curve: None }, self.now);
        }
        let arc = Box::new(Arc::take(model, &group, settled, 0.0));
        let mut curve = Curve { chord: arc.length, arc, began: self.now, from: self.now };
        let end = self.chord(model, &group, &mut curve);
        self.rests.found(Island { spheres, end, curve: Some(curve) }, self.now);
    }

    /// When the first foot of a group on parabolas comes to the end of its part, s.
    fn parts_end(&self, model: &Model, group: &Group) -> f64 {
        let mut first = f64::INFINITY;
        for rest in &group.rests {
            if let On::Wall(wall, part) = rest.on {
                let path = self.flight.path(rest.a, self.now);
                if let Some(t) = part_end(&model.faces[wall], part, &path, first) {
                    first = first.min(t);
                }
            }
        }
        self.now + first
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

    fn curve_mut(&mut self, i: usize) -> Option<&mut Curve> {
        self.island_mut(i)?.curve.as_mut()
    }
}
