//! Which contacts rest, and the islands they form: from one event of an island to the next.

use std::collections::BTreeMap;
use std::sync::Arc as Shared;

use glam::DVec3;

use super::releases::Releases;
use crate::physics::contact::{Key, Kind};
use crate::physics::events::contact_state::ContactState;
use crate::physics::events::curved::arc::Arc;
use crate::physics::events::curved::bodies::{Body, Closed, On};
use crate::physics::events::rest_reason::RestReason;
use crate::physics::events::rub::Rub;
use crate::physics::events::trajectories::Trajectories;
use crate::physics::model::Model;
use crate::physics::path::Path;
use crate::physics::state::State;
use crate::physics::support::Short;
use crate::physics::wall::Part;
use crate::physics::wall_parts::part_beyond;

/// The number of no island.
pub(super) const NONE: u32 = u32::MAX;

/// Memory that a resting contact takes here, bytes: itself, its places in lists and trees, and its share of an arc.
const BYTES_A_CONTACT: usize = 512;

/// Memory that a sphere takes here once anything rests, bytes: its list of contacts, and its places in an island.
const BYTES_A_SPHERE: usize = 96;

/// Memory that a chord of the past takes, bytes: its arc is shared.
const BYTES_A_PAST: usize = 256;

/// A contact that rests, or is about to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RestingContact {
    /// The part of the wall it rests on; for pairs without meaning.
    pub(super) part: Part,
    /// Whether its `rest` row has been written.
    pub(super) announced: bool,
    /// Why the contact rests.
    pub(super) reason: RestReason,
    /// Normal velocity when the contact was added, m/s.
    pub(super) v_n: f64,
    /// Time (s) at which the island is solved again: end of a summed bounce series, or of a pause. No rest is told before.
    pub(super) settles_at: f64,
    /// Impulse that has stopped the contact's bounces while none of them was told, N s.
    pub(super) untold: f64,
    /// The contact's support force.
    pub(super) load: Load,
    /// What bounces that were summed up have done by `settles_at`.
    pub(super) rub: Option<Rub>,
}

/// The support force of a resting contact, and what it has given since the frame began.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Load {
    /// Support force along the normal, N; of a curved rest when its island was last solved.
    pub(super) force: f64,
    /// Time since which the force has been that, s.
    pub(super) since: f64,
    /// Impulse given in this frame before that time, N s.
    pub(super) impulse: f64,
}

impl Load {
    /// The impulse of the frame until `time` (s), N s.
    pub(super) fn given(&self, time: f64) -> f64 {
        self.impulse + self.force * (time - self.since)
    }
}

/// Spheres connected by resting contacts, until something changes.
#[derive(Debug, Clone)]
pub(super) struct Island {
    /// Indices of the spheres, ascending; the first leads: its entry in the queue stands for the island.
    pub(super) spheres: Vec<usize>,
    /// Time at which the island's parabolas end, s.
    pub(super) end: f64,
    /// Motion of the spheres if that is no parabola.
    pub(super) curve: Option<Curve>,
}

/// A curved motion, and the chord parabola that stands for it now.
#[derive(Debug, Clone)]
pub(crate) struct Curve {
    /// The stretch of the motion that the chord belongs to.
    pub(super) arc: Shared<Arc>,
    /// The contacts of the island.
    pub(super) contacts: Shared<[IslandContact]>,
    /// Time on the arc at which the chord begins, s.
    pub(super) offset: f64,
    /// When the chord began, s; infinite once the spheres have left it.
    pub(crate) from: f64,
    /// Length of the chord, s.
    pub(super) length: f64,
    /// Whether a contact lets go or changes its part at the end of the chord.
    pub(super) changes: bool,
}

/// A contact of an island.
#[derive(Debug, Clone, Copy)]
pub(super) struct IslandContact {
    /// The sphere, by its place in the island.
    pub(super) a: usize,
    /// What the sphere touches.
    pub(super) other: Other,
}

/// What a sphere of an island touches.
#[derive(Debug, Clone, Copy)]
pub(super) enum Other {
    /// A wall, by its index, and the part of it.
    Wall(usize, Part),
    /// Another sphere, by its place in the island.
    Place(usize),
}

impl IslandContact {
    /// The contact as the solvers see it.
    pub(super) fn closed(self, model: &Model) -> Closed<'_> {
        let on = match self.other {
            Other::Wall(wall, part) => On::Wall(&model.faces[wall], part),
            Other::Place(place) => On::Body(place),
        };
        Closed { a: self.a, on }
    }
}

/// Contacts of an island as the solvers see them.
pub(super) fn closed<'a>(model: &'a Model, contacts: &[IslandContact]) -> Vec<Closed<'a>> {
    contacts.iter().map(|contact| contact.closed(model)).collect()
}

impl Curve {
    /// The motion from now (s) on of bodies with these accelerations (m/s²), whose contacts carry these forces (N); for a
    /// moment if they only creep.
    pub(super) fn new(
        model: &Model,
        (bodies, a): (Vec<Body>, Vec<DVec3>),
        (contacts, forces): (Vec<IslandContact>, &[f64]),
        (now, creeps): (f64, bool),
    ) -> Curve {
        let loaded = forces.iter().map(|&force| force > 0.0).collect();
        let arc = Shared::new(match creeps {
            true => Arc::creeping(bodies, a, loaded),
            false => Arc::new(bodies, a, &closed(model, &contacts), loaded),
        });
        Curve { arc, contacts: contacts.into(), offset: 0.0, from: now, length: 0.0, changes: false }.chord()
    }

    /// The curve with the next chord, on this arc or on the one after it.
    pub(super) fn next(self, model: &Model, now: f64) -> Curve {
        let offset = self.offset + self.length;
        if offset < self.arc.length {
            return Curve { offset, from: now, ..self }.chord();
        }
        let arc = Shared::new(self.arc.go_on(&closed(model, &self.contacts)));
        Curve { arc, offset: 0.0, from: now, ..self }.chord()
    }

    /// Lays a chord from `offset` on.
    pub(super) fn chord(mut self) -> Curve {
        let left = self.arc.length - self.offset;
        self.length = self.arc.chord(self.offset);
        self.changes = self.arc.changes && self.length >= left;
        self
    }

    /// Ends the chord after `time` (s), if that is sooner, to have the island solved again.
    pub(super) fn cut(self, time: f64) -> Curve {
        if time < self.length { Curve { length: time, changes: true, ..self } } else { self }
    }

    /// The spheres `time` (s) after the chord's beginning, read from the arc.
    pub(super) fn at(&self, time: f64) -> Vec<Body> {
        self.arc.at(self.offset + time.min(self.length))
    }

    /// The spheres `time` (s) after the chord's beginning, integrated.
    pub(crate) fn real(&self, model: &Model, time: f64) -> Vec<Body> {
        self.arc.real(self.offset + time.min(self.length), &closed(model, &self.contacts))
    }
}

/// A chord of this frame that is over.
#[derive(Debug, Clone)]
pub(super) struct Past {
    /// The spheres that followed it.
    pub(super) spheres: Vec<usize>,
    pub(super) curve: Curve,
    /// Time up to which they followed it, s.
    pub(super) until: f64,
}

/// All resting contacts.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rests {
    /// Resting contacts, by the bodies that touch.
    pub(super) held: BTreeMap<Key, RestingContact>,
    /// Contacts by sphere; empty until something rests.
    pub(super) of: Vec<Vec<Key>>,
    /// Islands by number; none where a number is free.
    pub(super) islands: Vec<Option<Island>>,
    /// Numbers that are free.
    pub(super) vacant: Vec<u32>,
    /// The number of each sphere's island, or [`NONE`]; empty until something rests.
    pub(super) island_of: Vec<u32>,
    /// Spheres whose islands must be solved before the clock goes on.
    pub(super) dirty: Vec<usize>,
    /// Chords of this frame that are over, in the order of their ends.
    pub(super) past: Vec<Past>,
    /// When the frame under way began, s.
    pub(super) frame_start: f64,
    /// Contacts that let go again and again.
    pub(super) releases: Releases,
    /// Number of arcs in a row that were over at once.
    pub(super) hurried: u32,
    /// Number of islands that move on a curve.
    curves: usize,
    /// Time since which that many islands move on a curve, s.
    curved_since: f64,
    /// Time spent in curved rest up to then, s.
    curved_time: f64,
}

impl Rests {
    /// The rests of a run in which nothing rests, and a frame begins at `time`, s.
    pub(crate) fn new(time: f64) -> Rests {
        Rests { frame_start: time, ..Rests::default() }
    }

    /// Why a contact rests; none if it does not.
    pub(crate) fn reason(&self, key: Key) -> Option<RestReason> {
        self.held.get(&key).filter(|held| held.announced).map(|held| held.reason)
    }

    /// A contact that rests, or is about to.
    pub(super) fn kept(&self, key: Key) -> &RestingContact {
        self.held.get(&key).expect("what is listed by sphere is kept")
    }

    /// A contact that rests, or is about to, to be changed.
    pub(super) fn kept_mut(&mut self, key: Key) -> &mut RestingContact {
        self.held.get_mut(&key).expect("what is listed by sphere is kept")
    }

    /// Whether nothing rests.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.of.is_empty()
    }

    /// Whether this contact rests.
    #[inline]
    pub(crate) fn holds(&self, key: Key) -> bool {
        // a sphere has few contacts: quicker to look through than the map of all
        !self.of.is_empty() && self.of[key.1].contains(&key)
    }

    /// The contacts of sphere `i` that rest.
    pub(crate) fn of(&self, i: usize) -> &[Key] {
        self.of.get(i).map_or(&[], Vec::as_slice)
    }

    /// Number of contacts of sphere `i` that rest.
    pub(crate) fn count(&self, i: usize) -> usize {
        self.of.get(i).map_or(0, Vec::len)
    }

    /// Whether islands wait to be solved.
    #[inline]
    pub(crate) fn is_dirty(&self) -> bool {
        !self.dirty.is_empty()
    }

    /// When the island led by sphere `i` ends its parabolas, s; infinite if it leads none.
    #[inline]
    pub(crate) fn end_led_by(&self, i: usize) -> f64 {
        match self.island(i) {
            Some(island) if island.spheres[0] == i => island.end,
            _ => f64::INFINITY,
        }
    }

    /// When the parabola of sphere `i` ends with its island's, s: all plans of its spheres are made anew then.
    #[inline]
    pub(crate) fn end_of(&self, i: usize) -> f64 {
        self.island(i).map_or(f64::INFINITY, |island| island.end)
    }

    #[inline]
    pub(super) fn island(&self, i: usize) -> Option<&Island> {
        let &number = self.island_of.get(i)?;
        self.islands.get(number as usize)?.as_ref()
    }

    /// Time spent in curved rest until `now`, s.
    pub(crate) fn curved_time(&self, now: f64) -> f64 {
        self.curved_time + if self.curves > 0 { now - self.curved_since } else { 0.0 }
    }

    /// Counts the time of curved rest from `now` (s) on.
    pub(crate) fn forget_curved_time(&mut self, now: f64) {
        (self.curved_time, self.curved_since) = (0.0, now);
    }

    pub(super) fn count_curves(&mut self, now: f64, change: isize) {
        self.curved_time = self.curved_time(now);
        self.curved_since = now;
        self.curves = self.curves.saturating_add_signed(change);
    }

    /// Adds a contact that may rest from now on, for `reason`: the island that it belongs to will decide, and is solved
    /// again at `settles_at`, s.
    pub(crate) fn add(
        &mut self,
        model: &Model,
        trajectories: &Trajectories,
        contact: &ContactState,
        reason: RestReason,
        settles_at: f64,
    ) {
        let (kind, a, b) = contact.key;
        let part = match kind {
            Kind::Wall => {
                let path = trajectories.path(a, trajectories.now);
                let v = path.v - contact.normal * contact.v_n;
                let (path, r) = (Path { v, ..path }, model.radii[a]);
                part_beyond(&model.faces[b], &path, r, trajectories.border_rounding(&path, r))
            }
            Kind::Pair => Part::Face,
        };
        if self.of.is_empty() {
            self.of = vec![Vec::new(); model.len()];
            self.island_of = vec![NONE; model.len()];
        }
        let held = RestingContact {
            part,
            announced: false,
            v_n: contact.v_n,
            settles_at,
            reason,
            untold: self.held.get(&contact.key).map_or(0.0, |before| before.untold),
            load: Load::default(),
            rub: None,
        };
        if self.held.insert(contact.key, held).is_none() {
            self.of[a].push(contact.key);
            if kind == Kind::Pair {
                self.of[b].push(contact.key);
            }
        }
        self.dirty.push(a);
    }

    /// Removes a contact that rests no longer; returns what it was, if it did.
    pub(super) fn drop(&mut self, key: Key) -> Option<RestingContact> {
        let (kind, a, b) = key;
        self.of[a].retain(|&other| other != key);
        if kind == Kind::Pair {
            self.of[b].retain(|&other| other != key);
        }
        self.held.remove(&key)
    }

    /// Has bounces that were summed up act on a contact when they are over.
    pub(crate) fn rub(&mut self, key: Key, rub: Rub) {
        self.kept_mut(key).rub = Some(rub);
    }

    /// Holds a contact that opens until `time` (s) all the same.
    pub(super) fn hold_until(&mut self, key: Key, time: f64) {
        self.kept_mut(key).settles_at = time;
    }

    /// The spheres of every island that a dirty sphere belongs or is connected to, ascending.
    pub(super) fn take_dirty(&mut self) -> Vec<usize> {
        let mut found: Vec<usize> = Vec::new();
        let mut open: Short<usize> = self.dirty.drain(..).collect();
        while let Some(i) = open.pop() {
            let Err(place) = found.binary_search(&i) else { continue };
            found.insert(place, i);
            if let Some(island) = self.island(i) {
                open.extend(island.spheres.iter().copied());
            }
            for &(kind, a, b) in self.of.get(i).into_iter().flatten() {
                open.push(a);
                if kind == Kind::Pair {
                    open.push(b);
                }
            }
        }
        found
    }

    pub(super) fn remove_island(&mut self, i: usize, now: f64) {
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

    pub(super) fn insert_island(&mut self, island: Island, now: f64) {
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

    /// Puts the spheres of curved islands where they really are, in a state of the last frame: their lines are chords.
    pub(crate) fn arcs_into(&self, model: &Model, state: &mut State) {
        let over = self.past.iter().filter(|past| state.t < past.until).map(|past| (&past.spheres, &past.curve));
        let current = self.islands.iter().flatten();
        let current = current.filter_map(|island| Some((&island.spheres, island.curve.as_ref()?)));
        let mut real: Vec<(usize, Body)> = Vec::new();
        for (spheres, curve) in over.chain(current).filter(|(_, curve)| curve.from <= state.t) {
            real.extend(spheres.iter().copied().zip(curve.real(model, state.t - curve.from)));
        }
        for (i, body) in real {
            (state.x[i], state.v[i]) = (body.x, body.v);
        }
    }

    /// Remembers a chord that was followed until `now` (s), for states read within the frame.
    pub(super) fn remember_chord(&mut self, spheres: &[usize], curve: &Curve, now: f64) {
        if curve.from < now {
            self.past.push(Past { spheres: spheres.to_vec(), curve: curve.clone(), until: now });
        }
    }

    /// A copy of which states from `time` (s) on can be read, and none before.
    pub(crate) fn since(&self, time: f64) -> Rests {
        let past: Vec<Past> = self.past.iter().filter(|past| past.until > time).cloned().collect();
        Rests {
            held: self.held.clone(),
            of: self.of.clone(),
            islands: self.islands.clone(),
            vacant: self.vacant.clone(),
            island_of: self.island_of.clone(),
            dirty: self.dirty.clone(),
            past,
            releases: self.releases.clone(),
            ..*self
        }
    }

    /// Memory that they take beside their own size, bytes, as near as the contacts and spheres tell.
    pub(crate) fn bytes(&self) -> usize {
        (self.held.len() + self.releases.entries()) * BYTES_A_CONTACT
            + self.of.len() * BYTES_A_SPHERE
            + self.past.len() * BYTES_A_PAST
    }

    /// Forgets what belongs to frames before the present one.
    pub(crate) fn forget(&mut self) {
        self.past.clear();
    }
}

impl Rests {
    /// If sphere `i` follows a chord that began before `now` (s), its island leaves it, and must be solved again: its
    /// spheres, and the curve with the chord that they followed.
    pub(crate) fn leave_chord(&mut self, i: usize, now: f64) -> Option<(Vec<usize>, Curve)> {
        let island = self.island_mut(i).filter(|island| island.curve.as_ref().is_some_and(|c| c.from < now))?;
        let (spheres, curve) = (island.spheres.clone(), island.curve.as_mut()?);
        let followed = curve.clone();
        // the trajectories are off the chord now: it must not be followed, nor the step be read, any longer
        curve.from = f64::INFINITY;
        self.remember_chord(&spheres, &followed, now);
        self.dirty.push(i);
        Some((spheres, followed))
    }

    pub(super) fn island_mut(&mut self, i: usize) -> Option<&mut Island> {
        let number = *self.island_of.get(i)?;
        self.islands.get_mut(number as usize)?.as_mut()
    }
}
