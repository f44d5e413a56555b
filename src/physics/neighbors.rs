//! Which spheres can touch at all: cells, as soon as the scene has many.
//!
//! Space is cut into cubes a little wider than the widest pair's reach, so that touching spheres lie in the same or in
//! adjacent cubes. Cube (i, j, k) is kept in cell i + p j + q k modulo a power of two: no bounds are needed, a cloud may
//! move and spread as it likes, rows along x stay contiguous in memory, and a line or a sheet of spheres fills as many
//! cells as a block does. Cubes that share a cell cost a distance each, never a contact. Cells are filled afresh for
//! every trial state by a counting sort: linear in the number of spheres, and in an order fixed by the indices.

use std::ops::Range;

use glam::DVec3;

/// Cells per sphere, at least: more cells mean fewer distances, and more to count through.
const CELLS_PER_SPHERE: usize = 2;

/// Fewest cells: below, two of the 27 cubes around a sphere could share a cell, and a pair be met twice.
const FEWEST_CELLS: usize = 128;

/// Width of a cube over the widest reach: leaves room for the rounding of coordinates divided by it.
const MARGIN: f64 = 1.0 + 1e-6;

/// A sphere as the pair loop reads it: centre and radius, m, in one 32-byte line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Ball {
    x: f64,
    y: f64,
    z: f64,
    r: f64,
}

/// The spheres sorted by cell.
#[derive(Debug, Clone, Default)]
pub(crate) struct Cells {
    /// 1 / width of a cube, 1/m.
    scale: f64,
    /// Number of cells − 1; the number is a power of two.
    mask: usize,
    /// Cells from one row along x to the next in y.
    row: usize,
    /// Cells from one layer to the next in z.
    layer: usize,
    /// While counting: spheres per cell; after [`Cells::open`]: where each cell begins; one more than there are cells.
    starts: Vec<u32>,
    /// While scattering: where the next sphere of each cell goes.
    heads: Vec<u32>,
    /// Cell by sphere.
    cell: Vec<u32>,
    /// Spheres by cell.
    balls: Vec<Ball>,
    /// Sphere indices, in the order of `balls`.
    ids: Vec<u32>,
}

/// Number of cells for so many spheres.
pub(crate) fn cell_count(spheres: usize) -> usize {
    (CELLS_PER_SPHERE * spheres).next_power_of_two().max(FEWEST_CELLS)
}

impl Cells {
    /// Cells for spheres of these radii, m.
    pub(crate) fn new(radii: &[f64]) -> Cells {
        let n = radii.len();
        let count = cell_count(n);
        let widest = 2.0 * radii.iter().copied().fold(0.0, f64::max);
        // About the cube root of the count, and odd, so that steps in y and z too run through all cells.
        let row = (1usize << (count.ilog2() / 3)) + 1;
        Cells {
            scale: 1.0 / (widest * MARGIN),
            mask: count - 1,
            row,
            layer: row * row,
            starts: vec![0; count + 1],
            heads: vec![0; count],
            cell: vec![0; n],
            balls: vec![Ball::default(); n],
            ids: vec![0; n],
        }
    }

    /// Number of cells.
    pub(crate) fn len(&self) -> usize {
        self.mask + 1
    }

    /// Forgets the last trial state.
    pub(crate) fn clear(&mut self) {
        self.starts.fill(0);
    }

    /// Counts these spheres into their cells.
    pub(crate) fn count(&mut self, x: &[DVec3], range: Range<usize>) {
        for (x, cell) in x[range.clone()].iter().zip(&mut self.cell[range]) {
            let at = |u: f64| floor(u * self.scale) as usize;
            let c = at(x.x).wrapping_add(at(x.y).wrapping_mul(self.row)).wrapping_add(at(x.z).wrapping_mul(self.layer))
                & self.mask;
            *cell = c as u32;
            self.starts[c] += 1;
        }
    }

    /// Computes where each cell begins, once all spheres are counted.
    pub(crate) fn open(&mut self) {
        let mut total = 0;
        for (start, head) in self.starts.iter_mut().zip(&mut self.heads) {
            let count = *start;
            (*start, *head) = (total, total);
            total += count;
        }
        let last = self.len();
        self.starts[last] = total;
    }

    /// Puts these spheres into their cells, their radii (m) grown by a factor.
    pub(crate) fn scatter(&mut self, x: &[DVec3], radii: &[f64], growth: f64, range: Range<usize>) {
        for i in range {
            let head = &mut self.heads[self.cell[i] as usize];
            let place = *head as usize;
            *head += 1;
            self.balls[place] = Ball { x: x[i].x, y: x[i].y, z: x[i].z, r: radii[i] * growth };
            self.ids[place] = i as u32;
        }
    }

    /// Calls `near` with every pair (lower index first) whose centres are no farther apart than its radii reach, of
    /// which one lies in one of these cells and the other in the same or a later neighbour: over all cells, every pair
    /// once. The number of distances computed.
    pub(crate) fn pairs(&self, cells: Range<usize>, near: impl FnMut(usize, usize)) -> u64 {
        self.pairs_until(cells, near, || false)
    }

    /// Calls `near` as [`Cells::pairs`] does, until `enough` is true. The number of distances computed.
    #[inline]
    pub(crate) fn pairs_until(
        &self,
        cells: Range<usize>,
        mut near: impl FnMut(usize, usize),
        enough: impl Fn() -> bool,
    ) -> u64 {
        let mut distances = 0;
        for c in cells {
            let own = self.starts[c] as usize..self.starts[c + 1] as usize;
            if own.is_empty() {
                continue;
            }
            let rows = [self.row, self.layer - self.row, self.layer, self.layer + self.row];
            let [r1, r2, r3, r4] = rows.map(|step| self.around((c + step) & self.mask));
            let next = self.span((c + 1) & self.mask);
            for k in own.clone() {
                if enough() {
                    return distances;
                }
                for others in [k + 1..own.end, next.clone(), r1.0.clone(), r2.0.clone(), r3.0.clone(), r4.0.clone()] {
                    distances += self.scan(k, others, &mut near);
                }
                for others in [&r1.1, &r2.1, &r3.1, &r4.1] {
                    distances += self.scan(k, others.clone(), &mut near);
                }
            }
        }
        distances
    }

    /// The range of a cell's spheres in `balls`.
    fn span(&self, c: usize) -> Range<usize> {
        self.starts[c] as usize..self.starts[c + 1] as usize
    }

    /// Where the spheres of a cell and of both its neighbours along x are: one range, two where the cells wrap around.
    fn around(&self, c: usize) -> (Range<usize>, Range<usize>) {
        let at = |c: usize| self.starts[c] as usize;
        if c == 0 {
            (at(0)..at(2), at(self.mask)..at(self.mask + 1))
        } else if c == self.mask {
            (at(c - 1)..at(c + 1), at(0)..at(1))
        } else {
            (at(c - 1)..at(c + 2), 0..0)
        }
    }

    #[inline(always)]
    fn scan(&self, k: usize, others: Range<usize>, near: &mut impl FnMut(usize, usize)) -> u64 {
        let a = self.balls[k];
        let first = others.start;
        let others = &self.balls[others];
        for (j, b) in others.iter().enumerate() {
            let (dx, dy, dz, reach) = (a.x - b.x, a.y - b.y, a.z - b.z, a.r + b.r);
            if dx * dx + dy * dy + dz * dz <= reach * reach {
                let (i, j) = (self.ids[k] as usize, self.ids[first + j] as usize);
                near(i.min(j), i.max(j));
            }
        }
        others.len() as u64
    }
}

/// The largest integer not above `u`, without a call into a mathematics library.
#[inline(always)]
fn floor(u: f64) -> i64 {
    let whole = u as i64;
    whole.wrapping_sub(i64::from(u < whole as f64))
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, dvec3};

    use super::Cells;

    type Pair = (usize, usize);

    /// Pairs found through cells, and by looking at all.
    fn both(x: &[DVec3], r: &[f64]) -> (Vec<Pair>, Vec<Pair>) {
        let mut cells = Cells::new(r);
        cells.clear();
        cells.count(x, 0..x.len());
        cells.open();
        cells.scatter(x, r, 1.0, 0..x.len());
        let mut found = Vec::new();
        cells.pairs(0..cells.len(), |a, b| found.push((a, b)));
        let near = |a: usize, b: usize| (x[a] - x[b]).length_squared() <= (r[a] + r[b]) * (r[a] + r[b]);
        let pairs = (0..x.len()).flat_map(|a| (a + 1..x.len()).map(move |b| (a, b)));
        (found, pairs.filter(|&(a, b)| near(a, b)).collect())
    }

    /// A cloud of this size about a place: a fixed Weyl sequence, no randomness.
    fn cloud(n: usize, size: DVec3, about: DVec3) -> Vec<DVec3> {
        let at = |k: usize, step: f64| (k as f64 * step).fract() - 0.5;
        let step = dvec3(0.754_877_666_246_693, 0.569_840_290_998_053, 0.324_717_957_244_746);
        (0..n).map(|k| about + size * dvec3(at(k + 1, step.x), at(k + 1, step.y), at(k + 1, step.z))).collect()
    }

    #[test]
    fn every_touching_pair_is_met_exactly_once_wherever_the_cloud_is_and_whatever_its_shape() {
        let sizes = [DVec3::splat(4.0), dvec3(300.0, 0.1, 0.1), dvec3(0.1, 300.0, 0.1), dvec3(0.0, 40.0, 40.0)];
        for n in [2, 65, 700] {
            for size in sizes {
                for about in [DVec3::ZERO, dvec3(-1e6, 7.0, 1e7)] {
                    let radii: Vec<f64> = (0..n).map(|k| 0.1 + 0.1 * (k % 3) as f64).collect();
                    let (mut found, expected) = both(&cloud(n, size, about), &radii);
                    found.sort_unstable();
                    assert_eq!(found, expected, "{n} spheres, {size} about {about}");
                }
            }
        }
    }

    #[test]
    fn positions_that_are_no_numbers_meet_nothing() {
        let mut x = cloud(70, DVec3::splat(1e3), DVec3::ZERO);
        (x[3], x[5]) = (DVec3::NAN, DVec3::INFINITY);
        let (found, _) = both(&x, &[0.5; 70]);
        assert!(found.iter().all(|&(a, b)| ![3, 5].contains(&a) && ![3, 5].contains(&b)));
    }

    #[test]
    fn a_line_of_spheres_spreads_over_the_cells_instead_of_crowding_a_few() {
        let x: Vec<DVec3> = (0..4096).map(|k| dvec3(0.0, k as f64, 0.0)).collect();
        let r = vec![0.4; x.len()];
        let mut cells = Cells::new(&r);
        cells.clear();
        cells.count(&x, 0..x.len());
        // The pigeonhole gives one per cell at best; crowding would show as dozens.
        assert!(cells.starts.iter().all(|&count| count <= 2));
    }
}
