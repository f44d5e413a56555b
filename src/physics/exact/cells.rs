//! Cells for many spheres: who may meet whom, and which walls are near.
//!
//! Space is cut into cubes at least as wide as the widest pair's reach; cube (i, j, k) is kept in a table folded modulo
//! powers of two, so that no bounds are needed and a spreading cloud costs no memory. Cubes that share a place cost a
//! prediction each, never an event. A sphere that crosses into the next cube is an event; it then meets nine new cubes.

use glam::DVec3;

use crate::geometry::Bounds;
use crate::physics::State;
use crate::physics::contact_time::{Path, quadratic_fall};
use crate::physics::model::Model;

/// Cubes are not counted beyond this: the outermost reach to infinity, where coordinates could not tell them apart.
const OUTERMOST: i32 = 1 << 28;

/// No sphere.
const NOBODY: u32 = u32::MAX;

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

/// The table of cubes.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    origin: DVec3,
    edge: f64,
    /// log₂ of the table's size along each axis.
    bits: [u32; 3],
    heads: Vec<u32>,
    next: Vec<u32>,
    cubes: Vec<Cube>,
    /// Walls near the cubes of place p: `walls[starts[p]..starts[p + 1]]`, ascending.
    starts: Vec<u32>,
    walls: Vec<u32>,
}

impl Cells {
    /// Cells for the spheres of `state`, all of them in their cubes, and the walls in every cube they come near.
    pub(super) fn new(model: &Model, state: &State) -> Cells {
        let widest = model.radii.iter().copied().fold(0.0, f64::max);
        let around = |i: usize| Bounds { min: state.x[i], max: state.x[i] };
        let room = Bounds::of((0..state.x.len()).map(around)).unwrap_or(Bounds { min: DVec3::ZERO, max: DVec3::ONE });
        let edge = edge(2.0 * widest * (1.0 + 1e-6), room.size(), state.x.len());
        let bits = table(room.size() / edge, state.x.len());
        let places = 1_usize << (bits[0] + bits[1] + bits[2]);
        let mut cells = Cells {
            origin: room.min,
            edge,
            bits,
            heads: vec![NOBODY; places],
            next: vec![NOBODY; state.x.len()],
            cubes: vec![[0; 3]; state.x.len()],
            starts: Vec::new(),
            walls: Vec::new(),
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

    /// Calls `visit` for every sphere in the 27 cubes around sphere `i`'s, itself left out.
    #[inline]
    pub(super) fn around(&self, i: usize, mut visit: impl FnMut(usize)) {
        let [x, y, z] = self.cubes[i];
        for dz in -1..=1 {
            for dy in -1..=1 {
                for dx in -1..=1 {
                    self.spheres_in([x + dx, y + dy, z + dz], |j| {
                        if j != i {
                            visit(j);
                        }
                    });
                }
            }
        }
    }

    /// Calls `visit` for every sphere in the nine cubes that came within reach when sphere `i` went `way`.
    #[inline]
    pub(super) fn ahead(&self, i: usize, way: Way, mut visit: impl FnMut(usize)) {
        let axis = way.axis as usize;
        let (one, two) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut cube = self.cubes[i];
        cube[axis] += i32::from(way.sign);
        for d1 in -1..=1 {
            for d2 in -1..=1 {
                let mut at = cube;
                at[one] += d1;
                at[two] += d2;
                self.spheres_in(at, |j| {
                    if j != i {
                        visit(j);
                    }
                });
            }
        }
    }

    #[inline]
    fn spheres_in(&self, cube: Cube, mut visit: impl FnMut(usize)) {
        let mut j = self.heads[self.place(cube)];
        while j != NOBODY {
            visit(j as usize);
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
        let place = self.place(self.cubes[i]);
        self.next[i] = self.heads[place];
        self.heads[place] = i as u32;
    }

    fn unlink(&mut self, i: usize) {
        let place = self.place(self.cubes[i]);
        let mut at = self.heads[place];
        if at as usize == i {
            self.heads[place] = self.next[i];
            return;
        }
        while self.next[at as usize] as usize != i {
            at = self.next[at as usize];
        }
        self.next[at as usize] = self.next[i];
    }

    #[inline]
    fn place(&self, cube: Cube) -> usize {
        let fold = |axis: usize| (cube[axis] as u32 & ((1 << self.bits[axis]) - 1)) as usize;
        fold(0) | fold(1) << self.bits[0] | fold(2) << (self.bits[0] + self.bits[1])
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
            let folded = |axis: usize| i64::from(high[axis]) - i64::from(low[axis]) >= (1_i64 << self.bits[axis]) - 1;
            let wraps = (0..3).any(folded);
            let range = |axis: usize| {
                if folded(axis) { 0..=(1 << self.bits[axis]) - 1 } else { low[axis]..=high[axis] }
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
        self.starts = vec![0; self.heads.len() + 1];
        for &(place, _) in &near {
            self.starts[place as usize + 1] += 1;
        }
        for place in 0..self.heads.len() {
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

/// log₂ of the table's size along each axis: enough for the spheres' box, no more than some cubes a sphere.
fn table(cubes: DVec3, count: usize) -> [u32; 3] {
    let limit = (8 * count).max(64);
    let mut bits = cubes.to_array().map(|n| {
        let mut b = 2;
        while f64::from(1_u32 << b) < n + 2.0 && b < 20 {
            b += 1;
        }
        b
    });
    while 1_usize << (bits[0] + bits[1] + bits[2]) > limit {
        let longest = (0..3).max_by_key(|&axis| bits[axis]).unwrap_or(0);
        if bits[longest] <= 2 {
            break;
        }
        bits[longest] -= 1;
    }
    bits
}
