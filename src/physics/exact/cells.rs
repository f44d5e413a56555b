//! Cells for many spheres: who may meet whom, and which walls are near.
//!
//! Space is cut into cubes at least as wide as the widest pair's reach; cube (i, j, k) is kept in a table folded modulo
//! its size, so that no bounds are needed and a spreading cloud costs no memory. Cubes that share a place cost a
//! prediction each, never an event. A sphere that crosses into the next cube is an event; it then meets nine new cubes.
//!
//! A place is half a cache line with its spheres' numbers in it: whoever looks around copies them all without asking
//! how many there are, since a branch that is mispredicted costs more than the copy.

use glam::DVec3;

use crate::geometry::Bounds;
use crate::physics::State;
use crate::physics::contact_time::{Path, quadratic_fall};
use crate::physics::model::Model;

/// Cubes are not counted beyond this: the outermost reach to infinity, where coordinates could not tell them apart.
const OUTERMOST: i32 = 1 << 28;

/// No sphere.
const NOBODY: u32 = u32::MAX;

/// Spheres that a place holds before it spills.
const SLOTS: usize = 6;

/// What the 27 places around a sphere hold at most, spilled ones apart.
const MOST_NEAR: usize = 27 * SLOTS;

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

/// What one place of the table holds.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(32))]
struct Place {
    /// The first `count` are spheres.
    spheres: [u32; SLOTS],
    count: u32,
    /// The first of those that found no slot.
    spilled: u32,
}

impl Place {
    const EMPTY: Place = Place { spheres: [NOBODY; SLOTS], count: 0, spilled: NOBODY };
}

/// The table of cubes.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    origin: DVec3,
    edge: f64,
    /// The table's size along each axis.
    size: [i32; 3],
    places: Vec<Place>,
    /// The sphere spilled before this one into the same place; empty as long as none is.
    next: Vec<u32>,
    cubes: Vec<Cube>,
    /// Walls near the cubes of place p: `walls[starts[p]..starts[p + 1]]`, ascending.
    starts: Vec<u32>,
    walls: Vec<u32>,
    /// Lent to whoever looks around.
    pub(super) near: Near,
}

/// Spheres that a sphere may meet, itself among them.
#[derive(Debug, Clone, Default)]
pub(super) struct Near {
    /// Room for all slots.
    spheres: Vec<u32>,
    count: usize,
    spilled: Vec<u32>,
}

impl Near {
    /// Nobody.
    pub(super) fn nobody() -> Near {
        Near { spheres: vec![0; MOST_NEAR], count: 0, spilled: Vec::new() }
    }

    /// Those in the places' slots.
    #[inline]
    pub(super) fn slots(&self) -> &[u32] {
        &self.spheres[..self.count]
    }

    /// Those that found no slot.
    #[inline]
    pub(super) fn spilled(&self) -> &[u32] {
        &self.spilled
    }
}

impl Cells {
    /// Cells for the spheres of `state`, all of them in their cubes, and the walls in every cube they come near.
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
            next: Vec::new(),
            cubes: vec![[0; 3]; state.x.len()],
            starts: Vec::new(),
            walls: Vec::new(),
            near: Near::nobody(),
        };
        for i in 0..state.x.len() {
            cells.cubes[i] = cells.cube_of(state.x[i]);
            cells.link(i);
        }
        cells.register(model, widest);
        cells
    }

    /// Walls near sphere `i`'s cube, ascending.
    #[inline]
    pub(super) fn walls_near(&self, i: usize) -> &[u32] {
        if self.walls.is_empty() {
            return &[];
        }
        let place = self.place(self.cubes[i]);
        &self.walls[self.starts[place] as usize..self.starts[place + 1] as usize]
    }

    /// The spheres in the 27 cubes around sphere `i`'s.
    #[inline]
    pub(super) fn around(&self, i: usize, near: &mut Near) {
        let [x, y, z] = self.cubes[i];
        let (xs, ys, zs) = (self.beside(0, x), self.beside(1, y), self.beside(2, z));
        near.count = 0;
        near.spilled.clear();
        for z in zs {
            for y in ys {
                for x in xs {
                    self.take(z + y + x, near);
                }
            }
        }
    }

    /// The spheres in the nine cubes that came within reach when sphere `i` went `way`.
    #[inline]
    pub(super) fn ahead(&self, i: usize, way: Way, near: &mut Near) {
        let axis = way.axis as usize;
        let (one, two) = ((axis + 1) % 3, (axis + 2) % 3);
        let cube = self.cubes[i];
        let front = self.folded(axis, cube[axis] + i32::from(way.sign));
        near.count = 0;
        near.spilled.clear();
        let (ones, twos) = (self.beside(one, cube[one]), self.beside(two, cube[two]));
        for two in twos {
            for one in ones {
                self.take(front + one + two, near);
            }
        }
    }

    #[inline(always)]
    fn take(&self, place: usize, near: &mut Near) {
        let place = &self.places[place];
        near.spheres[near.count..near.count + SLOTS].copy_from_slice(&place.spheres);
        near.count += place.count as usize;
        if place.spilled != NOBODY {
            self.take_spilled(place.spilled, near);
        }
    }

    #[cold]
    fn take_spilled(&self, first: u32, near: &mut Near) {
        let mut j = first;
        while j != NOBODY {
            near.spilled.push(j);
            j = self.next[j as usize];
        }
    }

    /// When sphere `i` on `path` leaves its cube, s from now, and where to.
    #[inline]
    pub(super) fn crossing(&self, i: usize, path: &Path) -> (f64, Way) {
        let cube = self.cubes[i];
        let mut first = (f64::INFINITY, Way::default());
        for (axis, &index) in cube.iter().enumerate() {
            let low = self.origin[axis] + f64::from(index) * self.edge;
            let (x, v, a) = (path.x[axis] - low, path.v[axis], 0.5 * path.a[axis]);
            if a == 0.0 {
                let (left, sign) = if v > 0.0 { (self.edge - x, 1_i8) } else { (x, -1) };
                let t = left.max(0.0) / v.abs();
                // at rest t is infinite or none, neither of which is earlier
                if t < first.0 && cube[axis] != OUTERMOST * i32::from(sign) {
                    first = (t, Way { axis: axis as u8, sign });
                }
                continue;
            }
            for sign in [1_i8, -1] {
                if index == OUTERMOST * i32::from(sign) {
                    continue;
                }
                let left = if sign > 0 { self.edge - x } else { x };
                let s = f64::from(sign);
                if let Some(t) = quadratic_fall([left, -s * v, -s * a]).filter(|&t| t < first.0) {
                    first = (t, Way { axis: axis as u8, sign });
                }
            }
        }
        first
    }

    /// Sphere `i` goes `way`: by the index, since a recomputed position may disagree with the event.
    pub(super) fn cross(&mut self, i: usize, way: Way) {
        self.unlink(i);
        self.cubes[i][way.axis as usize] += i32::from(way.sign);
        self.link(i);
    }

    fn link(&mut self, i: usize) {
        let number = self.place(self.cubes[i]);
        let place = &mut self.places[number];
        if let Some(slot) = place.spheres.get_mut(place.count as usize) {
            *slot = i as u32;
            place.count += 1;
            return;
        }
        if self.next.is_empty() {
            self.next = vec![NOBODY; self.cubes.len()];
        }
        self.next[i] = place.spilled;
        place.spilled = i as u32;
    }

    fn unlink(&mut self, i: usize) {
        let number = self.place(self.cubes[i]);
        let place = &mut self.places[number];
        let i = i as u32;
        let Some(slot) = place.spheres[..place.count as usize].iter().position(|&j| j == i) else {
            self.unspill(number, i);
            return;
        };
        if place.spilled == NOBODY {
            place.count -= 1;
            place.spheres[slot] = place.spheres[place.count as usize];
        } else {
            place.spheres[slot] = place.spilled;
            place.spilled = self.next[place.spilled as usize];
        }
    }

    /// Takes a sphere that found no slot off its chain.
    fn unspill(&mut self, number: usize, i: u32) {
        let after = self.next[i as usize];
        let place = &mut self.places[number];
        if place.spilled == i {
            place.spilled = after;
            return;
        }
        let mut at = place.spilled;
        while self.next[at as usize] != i {
            at = self.next[at as usize];
        }
        self.next[at as usize] = after;
    }

    #[inline]
    fn place(&self, cube: Cube) -> usize {
        self.folded(0, cube[0]) + self.folded(1, cube[1]) + self.folded(2, cube[2])
    }

    /// What a cube's coordinate along an axis adds to its place's number.
    #[inline(always)]
    fn folded(&self, axis: usize, coordinate: i32) -> usize {
        let n = self.size[axis];
        // nearly always within: a division would cost more than all the rest
        let c = if (0..n).contains(&coordinate) { coordinate } else { coordinate.rem_euclid(n) };
        c as usize * self.stride(axis)
    }

    /// The same for a coordinate and its two neighbours.
    #[inline(always)]
    fn beside(&self, axis: usize, coordinate: i32) -> [usize; 3] {
        [self.folded(axis, coordinate - 1), self.folded(axis, coordinate), self.folded(axis, coordinate + 1)]
    }

    #[inline(always)]
    fn stride(&self, axis: usize) -> usize {
        match axis {
            0 => 1,
            1 => self.size[0] as usize,
            _ => self.size[0] as usize * self.size[1] as usize,
        }
    }

    fn cube_of(&self, x: DVec3) -> Cube {
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
        self.walls = near.into_iter().map(|(_, wall)| wall).collect();
    }

    fn is_rim(&self, cube: Cube) -> bool {
        cube.iter().any(|c| c.abs() == OUTERMOST)
    }
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

/// The table's size along each axis: enough for the spheres' box, no more than some cubes a sphere. Three at least, so
/// that the cubes around one have a place each.
fn table(cubes: DVec3, count: usize) -> [i32; 3] {
    let limit = (4 * count).max(64) as f64;
    // a float beyond i32 becomes its end
    let mut size = cubes.to_array().map(|n| (n.min(1e6) as i32 + 2).max(3));
    while size.iter().copied().map(f64::from).product::<f64>() > limit {
        let longest = (0..3).max_by_key(|&axis| size[axis]).unwrap_or(0);
        if size[longest] <= 4 {
            break;
        }
        size[longest] = size[longest] / 2 + 1;
    }
    size
}
