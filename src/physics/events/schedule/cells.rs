//! Cells for many spheres: which of them may meet, and which walls are near.
//!
//! Space is cut into cubes at least as wide as the widest pair's reach; cube (i, j, k) is kept in a cell of a table folded
//! modulo its size, so that no bounds are needed and a spreading cloud costs no memory. Cubes that share a cell cost a
//! prediction each, never an event. A sphere that crosses into the next cube is an event; nine cubes are new to it then.
//!
//! A cell is sixteen bytes with its spheres' slots in them, and those of a row of cubes lie side by side, so that what is
//! around a sphere is nine rows of three at fixed distances, but at the table's border. A search copies all words of a cell
//! and advances by its count: cheaper than a mispredicted branch.

use glam::DVec3;

use super::candidates::{Candidates, MOST_CANDIDATES, ROOM};
use super::simd::Simd;
use crate::physics::events::record::{CellCoordinates, CellRef, Exit};
use crate::physics::model::Model;
use crate::physics::path::Path;
use crate::roots::quadratic_fall;
use layout::Layout;

pub(crate) mod layout;
mod walls;

/// Largest coordinate of a cube: the outermost reach to infinity, where coordinates could not tell cubes apart.
const OUTERMOST: i32 = 1 << 28;

/// How far beyond its cube a sphere must be that leaves it on a parabola, in edges: less than a cube is wider than it must
/// be, and far more than rounding. What turns round at the border would else go to and fro at one instant, for ever.
const SLACK: f64 = 1e-7;

/// Spheres that a cell holds before it overflows.
const ENTRIES: usize = 3;

/// Words that are copied at once from a cell: its entries and its header.
const WORDS: usize = ENTRIES + 1;

/// First bit of the number of spheres in entries, in a header.
const COUNT: u32 = 30;

/// Bit that says that walls are near, in a header.
const WALLS: u32 = 1 << 29;

/// Bit that says that the cell is at the border of the table, where what is around it is elsewhere, in a header.
const BORDER: u32 = 1 << 28;

/// Bits of the slot that overflowed last, in a header; all of them set: none.
const NONE: u32 = BORDER - 1;

/// What one cell of the table holds: slots in entries, and a header that says how many, whether walls are near, and which
/// slot overflowed last.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
struct Cell([u32; WORDS]);

impl Cell {
    const EMPTY: Cell = Cell([0, 0, 0, NONE]);

    fn count(&self) -> usize {
        (self.0[ENTRIES] >> COUNT) as usize
    }

    /// The slot that overflowed last; [`NONE`] if none has.
    fn overflow(&self) -> u32 {
        self.0[ENTRIES] & NONE
    }

    fn push_overflow(&mut self, slot: u32) {
        self.0[ENTRIES] = self.0[ENTRIES] & !NONE | slot;
    }

    fn empty(&mut self) {
        *self = Cell([0, 0, 0, self.0[ENTRIES] & (WALLS | BORDER) | NONE]);
    }
}

/// The table of cubes.
#[derive(Debug, Clone)]
pub(crate) struct Cells {
    /// Corner of cube (0, 0, 0), m.
    origin: DVec3,
    /// Edge of a cube, m.
    edge: f64,
    /// The table's size along each axis.
    size: [i32; 3],
    /// Distance in the table from one cell to the next along each axis.
    strides: [u32; 3],
    /// The largest radius of a sphere in the table, m.
    widest: f64,
    table: Vec<Cell>,
    /// The slot that overflowed before each slot in the same cell; empty as long as none has.
    next: Vec<u32>,
    /// Number of slots that have overflowed.
    overflow: usize,
    /// Slots of the spheres that are in no cube: all look at them.
    loose: Vec<u32>,
    /// Walls near the cubes of cell c: `walls[starts[c]..starts[c + 1]]`, ascending; all of them if `starts` is empty.
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
            table: vec![Cell::EMPTY; size.iter().map(|&n| n as usize).product()],
            next: Vec::new(),
            overflow: 0,
            loose: Vec::new(),
            starts: Vec::new(),
            walls: Vec::new(),
        };
        cells.note_borders();
        cells.register(model);
        cells
    }

    /// Memory that it takes, bytes.
    pub(crate) fn bytes(&self) -> usize {
        let notes = [&self.next, &self.loose, &self.starts, &self.walls].map(|notes| size_of_val(&**notes));
        size_of::<Cells>() + size_of_val(&*self.table) + notes.iter().sum::<usize>()
    }

    /// The layout of the table.
    pub(crate) fn layout(&self) -> Layout {
        Layout { origin: self.origin, edge: self.edge, size: self.size, widest: self.widest }
    }

    fn note_borders(&mut self) {
        let [x, y, z] = self.size.map(|n| n as usize);
        let end = |k: usize, n: usize| k == 0 || k + 1 == n;
        for (index, cell) in self.table.iter_mut().enumerate() {
            if end(index % x, x) || end(index / x % y, y) || end(index / x / y, z) {
                cell.0[ENTRIES] |= BORDER;
            }
        }
    }

    /// Fills the table with spheres in these cells, slot by slot, and with no others.
    pub(crate) fn fill(&mut self, cells: impl ExactSizeIterator<Item = u32>) {
        self.table.iter_mut().for_each(Cell::empty);
        self.loose.clear();
        self.overflow = 0;
        if !self.next.is_empty() {
            self.next = vec![NONE; cells.len()];
        }
        let slots = cells.len();
        for (slot, cell) in cells.enumerate() {
            self.enter(slot, cell, slots);
        }
    }

    /// Enters a slot, one of so many, in the cell of this index or among the loose ones.
    pub(crate) fn enter(&mut self, slot: usize, cell: u32, slots: usize) {
        match (CellRef { index: cell, ..CellRef::default() }).is_loose() {
            true => self.loose.push(slot as u32),
            false => self.link(slot, cell, slots),
        }
    }

    /// Takes a slot from where it was entered.
    pub(crate) fn leave(&mut self, slot: usize, cell: u32) {
        match (CellRef { index: cell, ..CellRef::default() }).is_loose() {
            true => self.loose.retain(|&other| other as usize != slot),
            false => self.unlink(slot as u32, cell),
        }
    }

    /// Lists the spheres that one in a cell may meet: those around it and those in no cell; after it came through the side
    /// `exit` only those that came within reach, since the ones in no cell have been looked at before. A sphere that is
    /// itself in no cell may meet all.
    #[inline(always)]
    pub(crate) fn look(&self, cell: CellRef, exit: Option<Exit>, candidates: &mut Candidates, slots: usize) {
        match exit {
            _ if cell.is_loose() => candidates.all(slots),
            Some(exit) => self.ahead(cell, exit, candidates),
            None => {
                self.around(cell, candidates);
                self.loose.iter().for_each(|&slot| candidates.push(slot));
            }
        }
    }

    /// Whether so many share cells that looking around costs more than it should.
    pub(crate) fn is_crowded(&self, slots: usize) -> bool {
        8 * self.overflow > slots
    }

    /// The largest radius of a sphere in a cell, m.
    pub(crate) fn widest(&self) -> f64 {
        self.widest
    }

    /// Edge of a cube, m.
    pub(crate) fn edge(&self) -> f64 {
        self.edge
    }

    /// Walls near a cell, ascending.
    #[inline]
    pub(crate) fn walls_near(&self, cell: CellRef) -> &[u32] {
        let index = cell.index as usize;
        if self.table[index].0[ENTRIES] & WALLS == 0 {
            return &[];
        }
        if self.starts.is_empty() {
            return &self.walls;
        }
        &self.walls[self.starts[index] as usize..self.starts[index + 1] as usize]
    }

    /// Lists the spheres in the 27 cubes around a cell.
    #[inline]
    pub(crate) fn around(&self, cell: CellRef, candidates: &mut Candidates) {
        if self.table[cell.index as usize].0[ENTRIES] & BORDER != 0 {
            return self.around_border(cell.coordinates, candidates);
        }
        let [_, y, z] = self.strides;
        // the first cell of the first row
        let first = cell.index - (1 + y + z);
        self.gather([0, z, 2 * z].map(|z| [0, y, 2 * y].map(|y| first + y + z)).as_flattened(), candidates, 3);
    }

    /// Lists the spheres in the nine cubes that came within reach when a sphere went through `exit` into this cell.
    #[inline]
    pub(crate) fn ahead(&self, cell: CellRef, exit: Exit, candidates: &mut Candidates) {
        if self.table[cell.index as usize].0[ENTRIES] & BORDER != 0 {
            return self.ahead_border(cell.coordinates, exit, candidates);
        }
        let axis = exit.axis as usize % 3;
        let (one, two) = (self.strides[(axis + 1) % 3], self.strides[(axis + 2) % 3]);
        let front = cell.index.wrapping_add_signed(self.strides[axis] as i32 * i32::from(exit.sign));
        let first = front - (one + two);
        self.gather(
            [0, two, 2 * two].map(|two| [0, one, 2 * one].map(|one| first + one + two)).as_flattened(),
            candidates,
            1,
        );
    }

    /// Lists the spheres in the 27 cubes around a cell at the border of the table.
    #[cold]
    #[inline(never)]
    fn around_border(&self, [x, y, z]: CellCoordinates, candidates: &mut Candidates) {
        let cells =
            [-1, 0, 1].map(|dz| [-1, 0, 1].map(|dy| [-1, 0, 1].map(|dx| self.index_of([x + dx, y + dy, z + dz]))));
        self.gather(cells.as_flattened().as_flattened(), candidates, 1);
    }

    /// Lists the spheres in the nine cubes that came within reach when a sphere went through `exit` into a cell at the
    /// border of the table.
    #[cold]
    #[inline(never)]
    fn ahead_border(&self, cube: CellCoordinates, exit: Exit, candidates: &mut Candidates) {
        let axis = exit.axis as usize;
        let at = |one: i32, two: i32| {
            let mut cube = cube;
            cube[axis] += i32::from(exit.sign);
            cube[(axis + 1) % 3] += one;
            cube[(axis + 2) % 3] += two;
            self.index_of(cube)
        };
        self.gather([-1, 0, 1].map(|two| [-1, 0, 1].map(|one| at(one, two))).as_flattened(), candidates, 1);
    }

    /// Copies the slots in rows of `width` cells each, given by the index of the first.
    #[inline(always)]
    fn gather(&self, rows: &[u32], candidates: &mut Candidates, width: usize) {
        let (mut count, mut headers) = (0, NONE);
        let slots = candidates.slots.first_chunk_mut::<ROOM>().expect("candidate lists begin with that room");
        for &row in rows {
            for Cell(entries) in &self.table[row as usize..row as usize + width] {
                // the remainder says no more than that there is room
                let free = count % MOST_CANDIDATES;
                slots[free..free + WORDS].copy_from_slice(entries);
                count += (entries[ENTRIES] >> COUNT) as usize;
                headers &= entries[ENTRIES];
            }
        }
        candidates.count = count;
        if headers & NONE != NONE {
            self.gather_overflow(rows, candidates, width);
        }
    }

    #[cold]
    fn gather_overflow(&self, rows: &[u32], candidates: &mut Candidates, width: usize) {
        for cell in rows.iter().flat_map(|&row| &self.table[row as usize..row as usize + width]) {
            let mut slot = cell.overflow();
            while slot != NONE {
                candidates.push(slot);
                slot = self.next[slot as usize];
            }
        }
    }

    /// Asks for the memory of the cells around one: it will be read soon.
    #[inline]
    pub(crate) fn fetch_around(&self, cell: CellRef, simd: Simd) {
        let [_, y, z] = self.strides;
        let first = cell.index.wrapping_sub(1 + y + z);
        for row in [0, z, 2 * z].map(|z| [0, y, 2 * y].map(|y| first.wrapping_add(y + z))).as_flattened() {
            if let Some([first, _, last]) = self.table.get(*row as usize..).and_then(<[Cell]>::first_chunk) {
                simd.fetch(first);
                simd.fetch(last);
            }
        }
    }

    /// When a sphere on `path` leaves its cube (s from now; infinite if never), and through which side.
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
                let left = if sign > 0 { self.edge - x } else { x } + SLACK * self.edge;
                let s = f64::from(sign);
                let t = if a == 0.0 { straight_exit(left, s * v) } else { quadratic_fall([left, -s * v, -s * a]) };
                if let Some(t) = t.filter(|&t| t < first.0) {
                    first = (t, Exit { axis: axis as u8, sign });
                }
            }
        }
        first
    }

    /// When a sphere on `path`, without acceleration, leaves its cube (s from now; infinite if never), and through which
    /// side. Without branches: the side cannot be predicted by the processor.
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

    /// Moves the sphere at a slot out of its cell through `exit`: by the index, since a recomputed position may disagree
    /// with the event. Returns the cell that it is in then.
    pub(crate) fn cross(&mut self, slot: usize, cell: CellRef, exit: Exit, slots: usize) -> CellRef {
        let next = self.beyond(cell, exit);
        self.unlink(slot as u32, cell.index);
        self.link(slot, next.index, slots);
        next
    }

    /// The cell that a sphere comes to when it goes through `exit`.
    #[inline]
    pub(crate) fn beyond(&self, cell: CellRef, exit: Exit) -> CellRef {
        let (axis, mut cube) = (exit.axis as usize % 3, cell.coordinates);
        cube[axis] += i32::from(exit.sign);
        let border = self.table[cell.index as usize].0[ENTRIES] & BORDER != 0;
        let beside = cell.index.wrapping_add_signed(self.strides[axis] as i32 * i32::from(exit.sign));
        CellRef { coordinates: cube, index: if border { self.index_of(cube) } else { beside } }
    }

    /// Enters a slot, one of so many, in the cell of this index.
    fn link(&mut self, slot: usize, index: u32, slots: usize) {
        let cell = &mut self.table[index as usize];
        let count = cell.count();
        if count < ENTRIES {
            cell.0[count] = slot as u32;
            cell.0[ENTRIES] += 1 << COUNT;
            return;
        }
        if self.next.is_empty() {
            self.next = vec![NONE; slots];
        }
        self.next[slot] = cell.overflow();
        cell.push_overflow(slot as u32);
        self.overflow += 1;
    }

    /// Takes a slot from the cell of this index.
    fn unlink(&mut self, slot: u32, index: u32) {
        let cell = &mut self.table[index as usize];
        // what is left beyond the count is looked at too, but never found first
        let not = |entry: usize| usize::from(cell.0[entry] != slot);
        let entry = not(0) * (1 + not(1) * (1 + not(2)));
        if entry == ENTRIES {
            self.take_overflow(index as usize, slot);
            return;
        }
        let (count, overflow) = (cell.count(), cell.overflow());
        if overflow == NONE {
            cell.0[entry] = cell.0[count - 1];
            cell.0[ENTRIES] -= 1 << COUNT;
        } else {
            cell.0[entry] = overflow;
            cell.push_overflow(self.next[overflow as usize]);
            self.overflow -= 1;
        }
    }

    /// Takes a slot that found no entry off its chain.
    fn take_overflow(&mut self, index: usize, slot: u32) {
        self.overflow -= 1;
        let after = self.next[slot as usize];
        let cell = &mut self.table[index];
        if cell.overflow() == slot {
            cell.push_overflow(after);
            return;
        }
        let mut at = cell.overflow();
        while self.next[at as usize] != slot {
            at = self.next[at as usize];
        }
        self.next[at as usize] = after;
    }

    /// The index of the cell that keeps a cube. The cubes that the spheres begin in and those around them are off the
    /// border.
    fn index_of(&self, cube: CellCoordinates) -> u32 {
        let share = |axis: usize| (cube[axis] + 2).rem_euclid(self.size[axis]) as u32 * self.strides[axis];
        share(0) + share(1) + share(2)
    }

    /// The cell that keeps the cube of a point, m.
    pub(crate) fn cell_of(&self, x: DVec3) -> CellRef {
        let cube = self.coordinates_of(x);
        CellRef { coordinates: cube, index: self.index_of(cube) }
    }

    /// The cube that holds a point (m).
    fn coordinates_of(&self, x: DVec3) -> CellCoordinates {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_turns_round_at_a_border_before_the_clock_can_tell_does_not_cross_it() {
        let layout = Layout { origin: DVec3::ZERO, edge: 0.16, size: [4; 3], widest: 0.05 };
        let model = Model::new(&crate::scene::open("paper-0").expect("a built-in scene").scene);
        let cells = Cells::new(&model, layout);
        for sign in [1.0, -1.0] {
            let path = Path { x: DVec3::splat(0.16), v: DVec3::Y * (sign * 4.9e-63), a: DVec3::Y * (sign * -4.4e-32) };
            for cube in [[1, 0, 1], [1, 1, 1]] {
                let (time, _) = cells.crossing(cube, &path);
                // the slack is 1.6e-8 m, and it takes 8e11 s to come there
                assert!(time > 1e6, "{cube:?}: {time} s");
            }
        }
    }
}
