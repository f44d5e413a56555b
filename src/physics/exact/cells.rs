//! Cells for many spheres: who may meet whom, and which walls are near.
//!
//! Space is cut into cubes at least as wide as the widest pair's reach; cube (i, j, k) is kept in a table folded modulo
//! its size, so that no bounds are needed and a spreading cloud costs no memory. Cubes that share a place cost a
//! prediction each, never an event. A sphere that crosses into the next cube is an event; it then meets nine new cubes.
//!
//! A place is sixteen bytes with its spheres' seats in them, and 4 × 4 × 4 places lie together, so that what is around
//! a sphere is in few cache lines and few pages. Whoever looks around copies them all without asking how many there
//! are, since a branch that is mispredicted costs more than the copy.

use glam::DVec3;

use super::lanes::{Four, Lanes, MOST};
use crate::geometry::Bounds;
use crate::physics::State;
use crate::physics::contact_time::{Path, quadratic_fall};
use crate::physics::model::Model;

/// Cubes are not counted beyond this: the outermost reach to infinity, where coordinates could not tell them apart.
const OUTERMOST: i32 = 1 << 28;

/// Spheres that a place holds before it spills.
const SLOTS: usize = 3;

/// Copied at once from a place: its slots and its mark.
const PLACE: usize = SLOTS + 1;

/// What the 27 places around a sphere hold without spilling is fewer than this.
const MOST_NEAR: usize = 128;

/// Room for it, one more place and padding to four.
const ROOM: usize = MOST_NEAR + 2 * PLACE;

/// In a mark: where the number of spheres in slots begins.
const COUNT: u32 = 30;

/// In a mark: walls are near.
const WALLS: u32 = 1 << 29;

/// In a mark, the bits of the seat spilled last; all of them: nobody.
const NOBODY: u32 = WALLS - 1;

/// A cube.
pub(super) type Cube = [i32; 3];

/// A sphere leaves its cube: the axis, and +1 or −1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Way {
    /// 0, 1 or 2.
    pub(super) axis: u8,
    /// +1 or −1.
    pub(super) sign: i8,
}

/// What one place of the table holds: seats in slots, and a mark that says how many, whether walls are near, and who was
/// spilled last.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
struct Place([u32; PLACE]);

impl Place {
    const EMPTY: Place = Place([0, 0, 0, NOBODY]);

    fn count(&self) -> usize {
        (self.0[SLOTS] >> COUNT) as usize
    }

    fn spilled(&self) -> u32 {
        self.0[SLOTS] & NOBODY
    }

    fn spill(&mut self, seat: u32) {
        self.0[SLOTS] = self.0[SLOTS] & !NOBODY | seat;
    }

    fn empty(&mut self) {
        *self = Place([0, 0, 0, self.0[SLOTS] & WALLS | NOBODY]);
    }
}

/// The table of cubes.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    origin: DVec3,
    edge: f64,
    /// The table's size along each axis, in fours.
    size: [i32; 3],
    places: Vec<Place>,
    /// What coordinates −1 to `size` add to a place's number, by axis.
    shares: [Vec<u32>; 3],
    /// The seat spilled before this one into the same place; empty as long as none is.
    next: Vec<u32>,
    /// Walls near the cubes of place p: `walls[starts[p]..starts[p + 1]]`, ascending.
    starts: Vec<u32>,
    walls: Vec<u32>,
}

/// Seats of the spheres that a sphere may meet, its own among them, and what was found out about each.
#[derive(Debug, Clone, Default)]
pub(super) struct Near {
    seats: Vec<u32>,
    count: usize,
    /// Room to look at them four by four.
    pub(super) fours: Vec<Four>,
}

impl Near {
    /// Nobody.
    pub(super) fn nobody() -> Near {
        Near { seats: vec![0; ROOM], count: 0, fours: vec![Four::default(); MOST / 4] }
    }

    /// Who is near.
    #[inline]
    pub(super) fn seats(&self) -> &[u32] {
        &self.seats[..self.count]
    }

    /// The same made up to fours by `seat`, and the room to look at them.
    #[inline]
    pub(super) fn padded(&mut self, seat: usize) -> (&[u32], &mut [Four]) {
        self.seats[self.count..self.count + 4].fill(seat as u32);
        (&self.seats[..self.count.next_multiple_of(4)], &mut self.fours)
    }

    fn push(&mut self, seat: u32) {
        self.seats[self.count] = seat;
        self.count += 1;
        if self.count + 5 > self.seats.len() {
            self.seats.resize(2 * self.seats.len(), 0);
        }
    }
}

impl Cells {
    /// Cells for the spheres of `state`, still empty, and the walls in every cube they come near.
    pub(super) fn new(model: &Model, state: &State) -> Cells {
        let widest = model.radii.iter().copied().fold(0.0, f64::max);
        let around = |i: usize| Bounds { min: state.x[i], max: state.x[i] };
        let room = Bounds::of((0..state.x.len()).map(around)).unwrap_or(Bounds { min: DVec3::ZERO, max: DVec3::ONE });
        let edge = edge(2.0 * widest * (1.0 + 1e-6), room.size(), state.x.len());
        let size = table(room.size() / edge, state.x.len());
        let mut cells = Cells {
            origin: room.min,
            edge,
            size,
            places: vec![Place::EMPTY; size.iter().map(|&n| n as usize).product()],
            shares: shares(size),
            next: Vec::new(),
            starts: Vec::new(),
            walls: Vec::new(),
        };
        cells.register(model, widest);
        cells
    }

    /// Fills the table with spheres in these cubes, seat by seat, and with no others.
    pub(super) fn fill(&mut self, cubes: impl ExactSizeIterator<Item = Cube>) {
        self.places.iter_mut().for_each(Place::empty);
        if !self.next.is_empty() {
            self.next = vec![NOBODY; cubes.len()];
        }
        let seats = cubes.len();
        for (seat, cube) in cubes.enumerate() {
            self.link(seat, cube, seats);
        }
    }

    /// Walls near a cube, ascending.
    #[inline]
    pub(super) fn walls_near(&self, cube: Cube) -> &[u32] {
        let place = self.place(cube);
        if self.places[place].0[SLOTS] & WALLS == 0 {
            return &[];
        }
        &self.walls[self.starts[place] as usize..self.starts[place + 1] as usize]
    }

    /// The spheres in the 27 cubes around a cube.
    #[inline]
    pub(super) fn around(&self, cube: Cube, near: &mut Near) {
        let [x, y, z] = cube;
        self.gather(self.beside(0, x), self.beside(1, y), self.beside(2, z), near);
    }

    /// The spheres in the nine cubes that came within reach when a sphere went `way` into this cube.
    #[inline]
    pub(super) fn ahead(&self, cube: Cube, way: Way, near: &mut Near) {
        let axis = way.axis as usize;
        let (one, two) = ((axis + 1) % 3, (axis + 2) % 3);
        let front = self.share(axis, cube[axis] + i32::from(way.sign));
        self.gather([front], self.beside(one, cube[one]), self.beside(two, cube[two]), near);
    }

    /// Copies the seats of all places whose number is a sum of one share of each axis.
    #[inline(always)]
    fn gather<const N: usize>(&self, ones: [u32; N], twos: [u32; 3], threes: [u32; 3], near: &mut Near) {
        let (mut count, mut marks) = (0, NOBODY);
        let Some(seats) = near.seats.first_chunk_mut::<ROOM>() else { return };
        for three in threes {
            for two in twos {
                for one in ones {
                    let Place(slots) = &self.places[(one + two + three) as usize];
                    // the remainder says no more than that there is room
                    let free = count % MOST_NEAR;
                    seats[free..free + PLACE].copy_from_slice(slots);
                    count += (slots[SLOTS] >> COUNT) as usize;
                    marks &= slots[SLOTS];
                }
            }
        }
        near.count = count;
        if marks & NOBODY != NOBODY {
            self.gather_spilled(&ones, twos, threes, near);
        }
    }

    #[cold]
    fn gather_spilled(&self, ones: &[u32], twos: [u32; 3], threes: [u32; 3], near: &mut Near) {
        for place in threes.iter().flat_map(|c| twos.iter().flat_map(move |b| ones.iter().map(move |a| a + b + c))) {
            let mut seat = self.places[place as usize].spilled();
            while seat != NOBODY {
                near.push(seat);
                seat = self.next[seat as usize];
            }
        }
    }

    /// Asks for the places around a cube: they will be read soon.
    #[inline]
    pub(super) fn fetch_around(&self, cube: Cube, lanes: Lanes) {
        for z in self.beside(2, cube[2]) {
            for y in self.beside(1, cube[1]) {
                let [first, _, last] = self.beside(0, cube[0]);
                lanes.fetch(&self.places[(first + y + z) as usize]);
                lanes.fetch(&self.places[(last + y + z) as usize]);
            }
        }
    }

    /// When a sphere on `path` leaves its cube, s from now, and where to.
    #[inline]
    pub(super) fn crossing(&self, cube: Cube, path: &Path) -> (f64, Way) {
        if path.a == DVec3::ZERO && cube.iter().all(|index| index.abs() < OUTERMOST) {
            return self.straight_crossing(cube, path);
        }
        let mut first = (f64::INFINITY, Way::default());
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
                    first = (t, Way { axis: axis as u8, sign });
                }
            }
        }
        first
    }

    /// The same without acceleration and branches: which way a sphere goes cannot be predicted.
    #[inline(always)]
    fn straight_crossing(&self, cube: Cube, path: &Path) -> (f64, Way) {
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
        (first, Way { axis, sign: 2 * i8::from(toward) - 1 })
    }

    /// Where in its cube a sphere is along an axis, m.
    #[inline(always)]
    fn within(&self, cube: Cube, path: &Path, axis: usize) -> f64 {
        path.x[axis] - (self.origin[axis] + f64::from(cube[axis]) * self.edge)
    }

    /// The sphere at a seat goes `way` from its cube: by the index, since a recomputed position may disagree with the
    /// event. Returns where it is then.
    pub(super) fn cross(&mut self, seat: usize, cube: Cube, way: Way, seats: usize) -> Cube {
        self.unlink(seat as u32, cube);
        let mut next = cube;
        next[way.axis as usize] += i32::from(way.sign);
        self.link(seat, next, seats);
        next
    }

    /// Enters a seat, one of so many.
    fn link(&mut self, seat: usize, cube: Cube, seats: usize) {
        let number = self.place(cube);
        let place = &mut self.places[number];
        let count = place.count();
        if count < SLOTS {
            place.0[count] = seat as u32;
            place.0[SLOTS] += 1 << COUNT;
            return;
        }
        if self.next.is_empty() {
            self.next = vec![NOBODY; seats];
        }
        self.next[seat] = place.spilled();
        place.spill(seat as u32);
    }

    fn unlink(&mut self, seat: u32, cube: Cube) {
        let number = self.place(cube);
        let place = &mut self.places[number];
        let count = place.count();
        let Some(slot) = place.0[..count].iter().position(|&other| other == seat) else {
            self.unspill(number, seat);
            return;
        };
        let spilled = place.spilled();
        if spilled == NOBODY {
            place.0[slot] = place.0[count - 1];
            place.0[SLOTS] -= 1 << COUNT;
        } else {
            place.0[slot] = spilled;
            place.spill(self.next[spilled as usize]);
        }
    }

    /// Takes a seat that found no slot off its chain.
    fn unspill(&mut self, number: usize, seat: u32) {
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

    /// The number of a cube's place.
    #[inline]
    pub(super) fn place(&self, cube: Cube) -> usize {
        (self.share(0, cube[0]) + self.share(1, cube[1]) + self.share(2, cube[2])) as usize
    }

    /// What a cube's coordinate along an axis adds to its place's number.
    #[inline(always)]
    fn share(&self, axis: usize, coordinate: i32) -> u32 {
        self.shares[axis][self.folded(axis, coordinate) + 1]
    }

    /// The same for a coordinate and its two neighbours.
    #[inline(always)]
    fn beside(&self, axis: usize, coordinate: i32) -> [u32; 3] {
        let c = self.folded(axis, coordinate);
        let shares = &self.shares[axis][c..c + 3];
        [shares[0], shares[1], shares[2]]
    }

    /// A cube's coordinate modulo the table's size.
    #[inline(always)]
    fn folded(&self, axis: usize, coordinate: i32) -> usize {
        // nearly always within, negative ones are not: a division would cost more than all the rest
        if (coordinate as u32) < self.size[axis] as u32 { coordinate as usize } else { self.wrapped(axis, coordinate) }
    }

    #[cold]
    #[inline(never)]
    fn wrapped(&self, axis: usize, coordinate: i32) -> usize {
        coordinate.rem_euclid(self.size[axis]) as usize
    }

    /// The cube that holds a point (m).
    pub(super) fn cube_of(&self, x: DVec3) -> Cube {
        let index = |axis: usize| ((x[axis] - self.origin[axis]) / self.edge).floor();
        // a float beyond i32 becomes its end, and the clamp brings it in
        [0, 1, 2].map(|axis| (index(axis) as i32).clamp(-OUTERMOST, OUTERMOST))
    }

    /// Lists each wall in every place whose cubes it comes within `reach` (m) of.
    fn register(&mut self, model: &Model, reach: f64) {
        let mut near: Vec<(u32, u32)> = Vec::new();
        for (wall, face) in model.faces.iter().enumerate() {
            let bounds = face.shape.bounds().grown(reach * (1.0 + 1e-6));
            let (low, high) = (self.cube_of(bounds.min), self.cube_of(bounds.max));
            let folded = |axis: usize| i64::from(high[axis]) - i64::from(low[axis]) >= i64::from(self.size[axis]) - 1;
            let wraps = (0..3).any(folded);
            let range = |axis: usize| {
                if folded(axis) { 0..=self.size[axis] - 1 } else { low[axis]..=high[axis] }
            };
            // half the cube's extent along the wall's normal
            let n = face.normal.abs();
            let half = 0.5 * self.edge * (n.x + n.y + n.z) * (1.0 + 1e-6) + reach * (1.0 + 1e-6);
            for x in range(0) {
                for y in range(1) {
                    for z in range(2) {
                        let middle = DVec3::new(f64::from(x) + 0.5, f64::from(y) + 0.5, f64::from(z) + 0.5);
                        let far = face.height(self.origin + middle * self.edge).abs() > half;
                        // a folded range stands for many cubes: the plane's distance tells nothing
                        if wraps || !far || self.is_rim([x, y, z]) {
                            near.push((self.place([x, y, z]) as u32, wall as u32));
                        }
                    }
                }
            }
        }
        near.sort_unstable();
        near.dedup();
        self.starts = vec![0; self.places.len() + 1];
        for &(place, _) in &near {
            self.starts[place as usize + 1] += 1;
        }
        for place in 0..self.places.len() {
            self.starts[place + 1] += self.starts[place];
        }
        for &(place, _) in &near {
            self.places[place as usize].0[SLOTS] |= WALLS;
        }
        self.walls = near.into_iter().map(|(_, wall)| wall).collect();
    }

    fn is_rim(&self, cube: Cube) -> bool {
        cube.iter().any(|c| c.abs() == OUTERMOST)
    }
}

/// When a sphere with speed `v` (m/s) towards a border `left` (m) away crosses it, s.
fn straight_exit(left: f64, v: f64) -> Option<f64> {
    (v > 0.0).then(|| left.max(0.0) / v)
}

/// Edge of a cube, m: the widest reach, or wider where spheres are sparse, so that there are about two cubes a sphere.
fn edge(reach: f64, size: DVec3, count: usize) -> f64 {
    let mut edge = reach;
    // doubling by √2 keeps to operations that are the same everywhere
    for _ in 0..200 {
        let cubes = (size / edge + DVec3::ONE).to_array().iter().product::<f64>();
        if cubes <= 2.0 * count as f64 {
            break;
        }
        edge *= 1.0905;
    }
    edge.min(1.6 * reach)
}

/// The table's size along each axis, in fours: enough for the spheres' box, no more than some cubes a sphere.
fn table(cubes: DVec3, count: usize) -> [i32; 3] {
    let limit = (4 * count).max(64) as f64;
    // a float beyond i32 becomes its end
    let mut size = cubes.to_array().map(|n| n.min(1e6) as i32 + 2);
    while size.iter().copied().map(f64::from).product::<f64>() > limit {
        let longest = (0..3).max_by_key(|&axis| size[axis]).unwrap_or(0);
        if size[longest] <= 4 {
            break;
        }
        size[longest] = size[longest] / 2 + 1;
    }
    size.map(|n| (n + 3) / 4 * 4)
}

/// What the coordinates −1 to `size` add to a place's number, by axis: blocks of 4 × 4 × 4 places one after the other.
fn shares(size: [i32; 3]) -> [Vec<u32>; 3] {
    let [x, y, _] = size.map(|n| n as u32 / 4);
    let blocks = [64, 64 * x, 64 * x * y];
    [0, 1, 2].map(|axis| {
        let share = |c: i32| {
            let c = c.rem_euclid(size[axis]) as u32;
            c / 4 * blocks[axis] + c % 4 * [1, 4, 16][axis]
        };
        (-1..=size[axis]).map(share).collect()
    })
}
