//! Cells for many spheres: who may meet whom, and which walls are near.
//!
//! Space is cut into cubes at least as wide as the widest pair's reach; cube (i, j, k) is kept in a table folded modulo
//! its size, so that no bounds are needed and a spreading cloud costs no memory. Cubes that share a place cost a
//! prediction each, never an event. A sphere that crosses into the next cube is an event; it then meets nine new cubes.
//!
//! A place is sixteen bytes with its spheres' seats in them, and those of a row of cubes lie side by side, so that what is
//! around a sphere is nine rows of three at fixed distances, but at the table's border. Whoever looks around copies them
//! all without asking how many there are, since a branch that is mispredicted costs more than the copy.

use glam::DVec3;

use super::candidates::{Candidates, MOST_NEAR, ROOM};
use super::simd::Simd;
use crate::physics::events::record::{CellCoordinates, CellRef, Exit};
use crate::physics::model::Model;
use crate::physics::path::Path;
use crate::roots::quadratic_fall;

pub(crate) use super::cells::layout::Layout;

pub(crate) mod layout;
mod walls;

/// Cubes are not counted beyond this: the outermost reach to infinity, where coordinates could not tell them apart.
const OUTERMOST: i32 = 1 << 28;

/// Spheres that a place holds before it spills.
const SLOTS: usize = 3;

/// Copied at once from a place: its slots and its mark.
const PLACE: usize = SLOTS + 1;

/// In a mark: where the number of spheres in slots begins.
const COUNT: u32 = 30;

/// In a mark: walls are near.
const WALLS: u32 = 1 << 29;

/// In a mark: the place is at the border of the table, where what is around it is elsewhere.
const BORDER: u32 = 1 << 28;

/// In a mark, the bits of the seat spilled last; all of them: nobody.
const NONE: u32 = BORDER - 1;

/// What one place of the table holds: seats in slots, and a mark that says how many, whether walls are near, and who was
/// spilled last.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
struct Place([u32; PLACE]);

impl Place {
    const EMPTY: Place = Place([0, 0, 0, NONE]);

    fn count(&self) -> usize {
        (self.0[SLOTS] >> COUNT) as usize
    }

    fn spilled(&self) -> u32 {
        self.0[SLOTS] & NONE
    }

    fn spill(&mut self, seat: u32) {
        self.0[SLOTS] = self.0[SLOTS] & !NONE | seat;
    }

    fn empty(&mut self) {
        *self = Place([0, 0, 0, self.0[SLOTS] & (WALLS | BORDER) | NONE]);
    }
}

/// The table of cubes.
#[derive(Debug, Clone)]
pub(crate) struct Cells {
    origin: DVec3,
    edge: f64,
    /// The table's size along each axis.
    size: [i32; 3],
    /// From one place to the next along each axis.
    strides: [u32; 3],
    /// The largest radius of a sphere in the table, m.
    widest: f64,
    places: Vec<Place>,
    /// The seat spilled before this one into the same place; empty as long as none is.
    next: Vec<u32>,
    /// How many are spilled.
    spilled: usize,
    /// Seats of the spheres that are in no cube: all look at them.
    loose: Vec<u32>,
    /// Walls near the cubes of place p: `walls[starts[p]..starts[p + 1]]`, ascending.
    starts: Vec<u32>,
    walls: Vec<u32>,
}

impl Cells {
    /// An empty table, and the walls in every cube from which a sphere of it touches them.
    pub(crate) fn new(model: &Model, layout: Layout) -> Cells {
        let Layout { origin, edge, size, widest } = layout;
        let mut cells = Cells {
            origin,
            edge,
            size,
            widest,
            strides: [1, size[0] as u32, size[0] as u32 * size[1] as u32],
            places: vec![Place::EMPTY; size.iter().map(|&n| n as usize).product()],
            next: Vec::new(),
            spilled: 0,
            loose: Vec::new(),
            starts: Vec::new(),
            walls: Vec::new(),
        };
        cells.mark_borders();
        cells.register(model);
        cells
    }

    /// How it was laid out.
    pub(crate) fn layout(&self) -> Layout {
        Layout { origin: self.origin, edge: self.edge, size: self.size, widest: self.widest }
    }

    fn mark_borders(&mut self) {
        let [x, y, z] = self.size.map(|n| n as usize);
        let end = |k: usize, n: usize| k == 0 || k + 1 == n;
        for (number, place) in self.places.iter_mut().enumerate() {
            if end(number % x, x) || end(number / x % y, y) || end(number / x / y, z) {
                place.0[SLOTS] |= BORDER;
            }
        }
    }

    /// Fills the table with spheres in these places, seat by seat, and with no others.
    pub(crate) fn fill(&mut self, places: impl ExactSizeIterator<Item = u32>) {
        self.places.iter_mut().for_each(Place::empty);
        self.loose.clear();
        self.spilled = 0;
        if !self.next.is_empty() {
            self.next = vec![NONE; places.len()];
        }
        let seats = places.len();
        for (seat, place) in places.enumerate() {
            self.enter(seat, place, seats);
        }
    }

    /// Enters a seat, one of so many, in a place or among the loose ones.
    pub(crate) fn enter(&mut self, seat: usize, place: u32, seats: usize) {
        match (CellRef { place, ..CellRef::default() }).is_loose() {
            true => self.loose.push(seat as u32),
            false => self.link(seat, place, seats),
        }
    }

    /// Takes a seat from where it was entered.
    pub(crate) fn leave(&mut self, seat: usize, place: u32) {
        match (CellRef { place, ..CellRef::default() }).is_loose() {
            true => self.loose.retain(|&other| other as usize != seat),
            false => self.unlink(seat as u32, place),
        }
    }

    /// Seats of the spheres that one in a cube may meet: those around it and those in no cube; after it went `way` only
    /// those that came within reach, since the ones in no cube have been looked at before. A sphere that is itself in no
    /// cube may meet all.
    #[inline(always)]
    pub(crate) fn look(&self, spot: CellRef, way: Option<Exit>, near: &mut Candidates, seats: usize) {
        match way {
            _ if spot.is_loose() => near.all(seats),
            Some(way) => self.ahead(spot, way, near),
            None => {
                self.around(spot, near);
                self.loose.iter().for_each(|&seat| near.push(seat));
            }
        }
    }

    /// Whether so many share places that looking around costs more than it should.
    pub(crate) fn is_crowded(&self, seats: usize) -> bool {
        8 * self.spilled > seats
    }

    /// The largest radius of a sphere in a cube, m.
    pub(crate) fn widest(&self) -> f64 {
        self.widest
    }

    /// How wide a cube is, m.
    pub(crate) fn edge(&self) -> f64 {
        self.edge
    }

    /// Walls near a cube, ascending.
    #[inline]
    pub(crate) fn walls_near(&self, spot: CellRef) -> &[u32] {
        let place = spot.place as usize;
        if self.places[place].0[SLOTS] & WALLS == 0 {
            return &[];
        }
        &self.walls[self.starts[place] as usize..self.starts[place + 1] as usize]
    }

    /// The spheres in the 27 cubes around a cube.
    #[inline]
    pub(crate) fn around(&self, spot: CellRef, near: &mut Candidates) {
        if self.places[spot.place as usize].0[SLOTS] & BORDER != 0 {
            return self.around_border(spot.cube, near);
        }
        let [_, y, z] = self.strides;
        // the first place of the first row
        let first = spot.place - (1 + y + z);
        self.gather([0, z, 2 * z].map(|z| [0, y, 2 * y].map(|y| first + y + z)).as_flattened(), near, 3);
    }

    /// The spheres in the nine cubes that came within reach when a sphere went `way` into this cube.
    #[inline]
    pub(crate) fn ahead(&self, spot: CellRef, way: Exit, near: &mut Candidates) {
        if self.places[spot.place as usize].0[SLOTS] & BORDER != 0 {
            return self.ahead_border(spot.cube, way, near);
        }
        let axis = way.axis as usize % 3;
        let (one, two) = (self.strides[(axis + 1) % 3], self.strides[(axis + 2) % 3]);
        let front = spot.place.wrapping_add_signed(self.strides[axis] as i32 * i32::from(way.sign));
        let first = front - (one + two);
        self.gather(
            [0, two, 2 * two].map(|two| [0, one, 2 * one].map(|one| first + one + two)).as_flattened(),
            near,
            1,
        );
    }

    /// The same at the border of the table.
    #[cold]
    #[inline(never)]
    fn around_border(&self, [x, y, z]: CellCoordinates, near: &mut Candidates) {
        let places =
            [-1, 0, 1].map(|dz| [-1, 0, 1].map(|dy| [-1, 0, 1].map(|dx| self.place([x + dx, y + dy, z + dz]))));
        self.gather(places.as_flattened().as_flattened(), near, 1);
    }

    #[cold]
    #[inline(never)]
    fn ahead_border(&self, cube: CellCoordinates, way: Exit, near: &mut Candidates) {
        let axis = way.axis as usize;
        let at = |one: i32, two: i32| {
            let mut cube = cube;
            cube[axis] += i32::from(way.sign);
            cube[(axis + 1) % 3] += one;
            cube[(axis + 2) % 3] += two;
            self.place(cube)
        };
        self.gather([-1, 0, 1].map(|two| [-1, 0, 1].map(|one| at(one, two))).as_flattened(), near, 1);
    }

    /// Copies the seats in rows of some places each, by the number of the first.
    #[inline(always)]
    fn gather(&self, rows: &[u32], near: &mut Candidates, width: usize) {
        let (mut count, mut marks) = (0, NONE);
        let Some(seats) = near.seats.first_chunk_mut::<ROOM>() else { return };
        for &row in rows {
            for Place(slots) in &self.places[row as usize..row as usize + width] {
                // the remainder says no more than that there is room
                let free = count % MOST_NEAR;
                seats[free..free + PLACE].copy_from_slice(slots);
                count += (slots[SLOTS] >> COUNT) as usize;
                marks &= slots[SLOTS];
            }
        }
        near.count = count;
        if marks & NONE != NONE {
            self.gather_spilled(rows, near, width);
        }
    }

    #[cold]
    fn gather_spilled(&self, rows: &[u32], near: &mut Candidates, width: usize) {
        for place in rows.iter().flat_map(|&row| &self.places[row as usize..row as usize + width]) {
            let mut seat = place.spilled();
            while seat != NONE {
                near.push(seat);
                seat = self.next[seat as usize];
            }
        }
    }

    /// Asks for the places around a cube: they will be read soon.
    #[inline]
    pub(crate) fn fetch_around(&self, spot: CellRef, lanes: Simd) {
        let [_, y, z] = self.strides;
        let first = spot.place.wrapping_sub(1 + y + z);
        for row in [0, z, 2 * z].map(|z| [0, y, 2 * y].map(|y| first.wrapping_add(y + z))).as_flattened() {
            if let Some([first, _, last]) = self.places.get(*row as usize..).and_then(<[Place]>::first_chunk) {
                lanes.fetch(first);
                lanes.fetch(last);
            }
        }
    }

    /// When a sphere on `path` leaves its cube, s from now, and where to.
    #[inline]
    pub(crate) fn crossing(&self, cube: CellCoordinates, path: &Path) -> (f64, Exit) {
        if path.a == DVec3::ZERO && cube.iter().all(|index| index.abs() < OUTERMOST) {
            return self.straight_crossing(cube, path);
        }
        let mut first = (f64::INFINITY, Exit::default());
        for axis in 0..3 {
            let (x, v, a) = (self.within(cube, path, axis), path.v[axis], 0.5 * path.a[axis]);
            for sign in [1_i8, -1] {
                if cube[axis] == OUTERMOST * i32::from(sign) {
                    continue;
                }
                let left = if sign > 0 { self.edge - x } else { x };
                let s = f64::from(sign);
                let t = if a == 0.0 { straight_exit(left, s * v) } else { quadratic_fall([left, -s * v, -s * a]) };
                if let Some(t) = t.filter(|&t| t < first.0) {
                    first = (t, Exit { axis: axis as u8, sign });
                }
            }
        }
        first
    }

    /// The same without acceleration and branches: which way a sphere goes cannot be predicted.
    #[inline(always)]
    fn straight_crossing(&self, cube: CellCoordinates, path: &Path) -> (f64, Exit) {
        let exit = |axis: usize| {
            let (x, v) = (self.within(cube, path, axis), path.v[axis]);
            let left = if v > 0.0 { self.edge - x } else { x };
            let t = left.max(0.0) / v.abs();
            // on the border and at rest it would be none
            if v == 0.0 { f64::INFINITY } else { t }
        };
        let [x, y, z] = [exit(0), exit(1), exit(2)];
        let xy = if y < x { y } else { x };
        let first = if z < xy { z } else { xy };
        let axis = if z < xy { 2 } else { u8::from(y < x) };
        let toward = [path.v.x > 0.0, path.v.y > 0.0, path.v.z > 0.0][axis as usize];
        (first, Exit { axis, sign: 2 * i8::from(toward) - 1 })
    }

    /// Where in its cube a sphere is along an axis, m.
    #[inline(always)]
    fn within(&self, cube: CellCoordinates, path: &Path, axis: usize) -> f64 {
        path.x[axis] - (self.origin[axis] + f64::from(cube[axis]) * self.edge)
    }

    /// The sphere at a seat goes `way` from its cube: by the index, since a recomputed position may disagree with the
    /// event. Returns where it is then.
    pub(crate) fn cross(&mut self, seat: usize, spot: CellRef, way: Exit, seats: usize) -> CellRef {
        let next = self.beyond(spot, way);
        self.unlink(seat as u32, spot.place);
        self.link(seat, next.place, seats);
        next
    }

    /// The cube that a sphere comes to when it goes `way`.
    #[inline]
    pub(crate) fn beyond(&self, spot: CellRef, way: Exit) -> CellRef {
        let (axis, mut cube) = (way.axis as usize % 3, spot.cube);
        cube[axis] += i32::from(way.sign);
        let border = self.places[spot.place as usize].0[SLOTS] & BORDER != 0;
        let beside = spot.place.wrapping_add_signed(self.strides[axis] as i32 * i32::from(way.sign));
        CellRef { cube, place: if border { self.place(cube) } else { beside } }
    }

    /// Enters a seat, one of so many.
    fn link(&mut self, seat: usize, place: u32, seats: usize) {
        let place = &mut self.places[place as usize];
        let count = place.count();
        if count < SLOTS {
            place.0[count] = seat as u32;
            place.0[SLOTS] += 1 << COUNT;
            return;
        }
        if self.next.is_empty() {
            self.next = vec![NONE; seats];
        }
        self.next[seat] = place.spilled();
        place.spill(seat as u32);
        self.spilled += 1;
    }

    fn unlink(&mut self, seat: u32, number: u32) {
        let place = &mut self.places[number as usize];
        // what is left beyond the count is looked at too, but never found first
        let not = |slot: usize| usize::from(place.0[slot] != seat);
        let slot = not(0) * (1 + not(1) * (1 + not(2)));
        if slot == SLOTS {
            self.unspill(number as usize, seat);
            return;
        }
        let (count, spilled) = (place.count(), place.spilled());
        if spilled == NONE {
            place.0[slot] = place.0[count - 1];
            place.0[SLOTS] -= 1 << COUNT;
        } else {
            place.0[slot] = spilled;
            place.spill(self.next[spilled as usize]);
            self.spilled -= 1;
        }
    }

    /// Takes a seat that found no slot off its chain.
    fn unspill(&mut self, number: usize, seat: u32) {
        self.spilled -= 1;
        let after = self.next[seat as usize];
        let place = &mut self.places[number];
        if place.spilled() == seat {
            place.spill(after);
            return;
        }
        let mut at = place.spilled();
        while self.next[at as usize] != seat {
            at = self.next[at as usize];
        }
        self.next[at as usize] = after;
    }

    /// The number of a cube's place. The cubes that the spheres begin in and those around them are off the border.
    fn place(&self, cube: CellCoordinates) -> u32 {
        let share = |axis: usize| (cube[axis] + 2).rem_euclid(self.size[axis]) as u32 * self.strides[axis];
        share(0) + share(1) + share(2)
    }

    /// Where a point (m) is.
    pub(crate) fn spot(&self, x: DVec3) -> CellRef {
        let cube = self.cube_of(x);
        CellRef { cube, place: self.place(cube) }
    }

    /// The cube that holds a point (m).
    fn cube_of(&self, x: DVec3) -> CellCoordinates {
        let index = |axis: usize| ((x[axis] - self.origin[axis]) / self.edge).floor();
        // a float beyond i32 becomes its end, and the clamp brings it in
        [0, 1, 2].map(|axis| (index(axis) as i32).clamp(-OUTERMOST, OUTERMOST))
    }
}

/// When a sphere with speed `v` (m/s) towards a border `left` (m) away crosses it, s.
fn straight_exit(left: f64, v: f64) -> Option<f64> {
    (v > 0.0).then(|| left.max(0.0) / v)
}

/// Orders cubes so that neighbours are near: 4 × 4 × 4 of them, then the next.
pub(crate) fn nearness([x, y, z]: CellCoordinates) -> [i32; 6] {
    [z >> 2, y >> 2, x >> 2, z & 3, y & 3, x & 3]
}
