//! `Gas`: spheres strewn at random, disjoint from each other, from all walls and from the spheres listed before.
//!
//! Up to a packing fraction of 0.2 by random insertion: a uniformly drawn centre is kept if it is free. That gives the
//! unbiased gas, but above it a free place is hardly ever drawn. Then, or if walls crowd the box so that the draws are
//! spent, the spheres are strewn over a lattice instead: sites drawn without return, each sphere shifted at random within
//! its own cell. That reaches 0.5. The work is bounded either way, and the outcome depends on nothing but the scene.

use std::f64::consts::{FRAC_PI_6, SQRT_2};

use glam::DVec3;

use super::effort::{Effort, NOTED, SLANTED};
use super::validated::Sphere;
use crate::format::{number, rounded};
use crate::geometry::{Bounds, Parallelogram};
use crate::random::SplitMix64;

/// Packing fraction up to which random insertion is tried. A million spheres took 1.8 draws each at 0.11 and 4.1 at 0.2;
/// at 0.3, sixty each were not enough.
const SPARSE: f64 = 0.2;
/// Draws per sphere, on average, before random insertion is given up.
const DRAWS: usize = 20;
/// Shifts tried in one cell of the lattice before it is left empty.
const SHIFTS: usize = 8;
/// Cells a lattice may have per sphere wanted.
const MOST_SITES: usize = 16;
/// Overlap that counts as touching, in radii: far below what the rules allow.
const TOUCH: f64 = 1e-12;
/// No spheres of one size fill more of space than this (Kepler's conjecture: π / √18).
const DENSEST: f64 = FRAC_PI_6 * SQRT_2;

/// What a gas must keep clear of.
#[derive(Debug)]
pub(super) struct Obstacles<'a> {
    pub(super) walls: &'a [Parallelogram],
    pub(super) spheres: &'a [Sphere],
    pub(super) effort: &'a Effort,
}

/// Centres (m) of `count` spheres of radius `r` (m) whose surfaces stay within `bounds` (m).
///
/// # Errors
/// A sentence if they do not fit.
pub(super) fn strewn(
    bounds: Bounds,
    count: usize,
    r: f64,
    obstacles: &Obstacles,
    draw: &mut SplitMix64,
) -> Result<Vec<DVec3>, String> {
    let inner = bounds.grown(-r);
    let size = bounds.size();
    if inner.size().min_element() < 0.0 {
        let (radius, edge) = (number(r), rounded(size.min_element()));
        return Err(format!(
            "a box with an edge of {edge} m is refused; allowed is at least twice the radius of {radius} m"
        ));
    }
    let fraction = count as f64 * FRAC_PI_6 * (2.0 * r / size.x) * (2.0 * r / size.y) * (2.0 * r / size.z);
    let too_many = |placed: usize| {
        let fraction = rounded(fraction);
        let room = "allowed are fewer or smaller spheres or a larger box (up to about 0.3 of it can be filled)";
        format!("{count} spheres, {fraction} of the box, do not fit: {placed} found a place; {room}")
    };
    if fraction > DENSEST {
        return Err(too_many(0));
    }
    let field = Field::new(bounds, count, r, obstacles);
    let sparse = if fraction <= SPARSE { inserted(&field, inner, count, draw) } else { None };
    let strewn = sparse.map_or_else(|| latticed(&field, bounds, count, draw).map_err(too_many), Ok);
    if obstacles.effort.spent() { Err(Effort::refusal()) } else { strewn }
}

/// Centres (m) by random insertion; none if the draws run out.
fn inserted(field: &Field, inner: Bounds, count: usize, draw: &mut SplitMix64) -> Option<Vec<DVec3>> {
    let mut gas = Placed::new(field, count);
    for _ in 0..count.saturating_mul(DRAWS) + 1000 {
        if field.obstacles.effort.spent() {
            return None;
        }
        let center = inner.min + inner.size() * draw.units();
        if field.is_free(center) && gas.is_free(center) {
            gas.place(center);
        }
        if gas.centers.len() == count {
            return Some(gas.centers);
        }
    }
    None
}

/// Centres (m) strewn over lattices, from the widest that has a cell for each sphere to the tightest; the error is the most
/// spheres that fitted.
fn latticed(field: &Field, bounds: Bounds, count: usize, draw: &mut SplitMix64) -> Result<Vec<DVec3>, usize> {
    let volume_per_sphere = bounds.size() / (count as f64);
    let mut spacing = cube_root(volume_per_sphere.x * bounds.size().y * bounds.size().z).max(2.0 * field.r);
    let mut most = 0;
    loop {
        let counts = (bounds.size() / spacing).max(DVec3::ONE).floor();
        if counts.element_product() > (count * MOST_SITES) as f64 {
            return Err(most);
        }
        let centers = on_lattice(field, bounds, counts, count, draw);
        if centers.len() == count {
            return Ok(centers);
        }
        most = most.max(centers.len());
        if field.obstacles.effort.spent() {
            return Err(most);
        }
        if spacing <= 2.0 * field.r {
            return Err(most);
        }
        // 3 % tighter each time: from the widest to the tightest in a few dozen rounds.
        spacing = (spacing * 0.97).max(2.0 * field.r);
    }
}

/// Up to `count` centres (m) in the cells of one lattice, the cells in random order.
fn on_lattice(field: &Field, bounds: Bounds, counts: DVec3, count: usize, draw: &mut SplitMix64) -> Vec<DVec3> {
    let cell = bounds.size() / counts;
    // Rounding may leave the tightest cell a little too tight; the spheres then touch, which is no overlap.
    let slack = (cell - DVec3::splat(2.0 * field.r)).max(DVec3::ZERO);
    let [_, ny, nz] = counts.to_array().map(|n| n as usize);
    let mut sites: Vec<usize> = (0..counts.element_product() as usize).collect();
    let mut centers = Vec::with_capacity(count);
    for i in 0..sites.len() {
        let chosen = i + draw.below(sites.len() - i);
        sites.swap(i, chosen);
        let site = sites[i];
        let index = DVec3::new((site / (ny * nz)) as f64, (site / nz % ny) as f64, (site % nz) as f64);
        let corner = bounds.min + cell * index + DVec3::splat(field.r);
        let free = (0..SHIFTS).map(|_| corner + slack * draw.units()).find(|&center| field.is_free(center));
        centers.extend(free);
        if centers.len() == count || field.obstacles.effort.spent() {
            break;
        }
    }
    centers
}

/// The cube root, by Newton's steps from above: `cbrt` is not the same on every machine.
fn cube_root(value: f64) -> f64 {
    let mut root = value.max(1.0);
    loop {
        let next = (2.0 * root + value / (root * root)) / 3.0;
        if next >= root {
            return root;
        }
        root = next;
    }
}

/// The box in cells, with the obstacles that reach into each.
struct Field<'a> {
    bounds: Bounds,
    r: f64,
    cell: f64,
    counts: [usize; 3],
    /// Along each axis, from where to where the spheres of each cell reach, m.
    ends: [Vec<[f64; 2]>; 3],
    obstacles: &'a Obstacles<'a>,
    /// The obstacles that reach into each cell: walls first, spheres after them.
    reaching: Vec<Vec<u32>>,
}

impl<'a> Field<'a> {
    fn new(bounds: Bounds, count: usize, r: f64, obstacles: &'a Obstacles<'a>) -> Field<'a> {
        let (cell, counts) = cells(bounds, count, r);
        let reaching = vec![Vec::new(); counts.iter().product()];
        let ends = [0, 1, 2].map(|axis| ends([bounds.min[axis], bounds.max[axis]], cell, counts[axis], r));
        let mut field = Field { bounds, r, cell, counts, ends, obstacles, reaching };
        for (index, wall) in obstacles.walls.iter().enumerate() {
            let outline = wall.outline();
            let touches = |block: &Bounds| obstacles.effort.spend(SLANTED) && outline.may_touch(block);
            field.enter(index as u32, wall.bounds(), touches);
        }
        for (index, sphere) in obstacles.spheres.iter().enumerate() {
            let around = Bounds::around(sphere.x, sphere.radius);
            field.enter((obstacles.walls.len() + index) as u32, around, |block| block.touches(&around));
        }
        field
    }

    /// Notes a body in the cells from which spheres reach it, if `touches` tells of any box whether the body does.
    fn enter(&mut self, body: u32, around: Bounds, touches: impl Fn(&Bounds) -> bool) {
        let reach = around.grown(self.r);
        if !self.obstacles.effort.spend(1) || !reach.touches(&self.bounds) {
            return;
        }
        let mut open = vec![(self.coordinates(reach.min), self.coordinates(reach.max))];
        while let Some((low, high)) = open.pop() {
            if !self.obstacles.effort.spend(1) {
                return;
            }
            if !touches(&self.block(low, high)) {
                continue;
            }
            let axis = (0..3).fold(0, |best, k| if high[k] - low[k] > high[best] - low[best] { k } else { best });
            if low[axis] == high[axis] {
                self.obstacles.effort.spend(NOTED);
                let [_, ny, nz] = self.counts;
                self.reaching[(low[0] * ny + low[1]) * nz + low[2]].push(body);
                continue;
            }
            let middle = usize::midpoint(low[axis], high[axis]);
            let (mut first, mut second) = ((low, high), (low, high));
            (first.1[axis], second.0[axis]) = (middle, middle + 1);
            open.extend([first, second]);
        }
    }

    /// What the spheres of a block of cells reach, m, with all that lies beyond the field behind its outermost cells.
    fn block(&self, low: [usize; 3], high: [usize; 3]) -> Bounds {
        let [x, y, z] = &self.ends;
        let min = DVec3::new(x[low[0]][0], y[low[1]][0], z[low[2]][0]);
        Bounds { min, max: DVec3::new(x[high[0]][1], y[high[1]][1], z[high[2]][1]) }
    }

    fn coordinates(&self, p: DVec3) -> [usize; 3] {
        let scaled = ((p - self.bounds.min) / self.cell).to_array();
        [0, 1, 2].map(|axis| (scaled[axis].max(0.0) as usize).min(self.counts[axis] - 1))
    }

    fn cell_of(&self, p: DVec3) -> usize {
        let [i, j, k] = self.coordinates(p);
        (i * self.counts[1] + j) * self.counts[2] + k
    }

    /// The cells that a box reaches into.
    fn cells_of(&self, reach: Bounds) -> impl Iterator<Item = usize> + use<> {
        let (low, high) = (self.coordinates(reach.min), self.coordinates(reach.max));
        let [_, ny, nz] = self.counts;
        let rows = (low[0]..=high[0]).flat_map(move |i| (low[1]..=high[1]).map(move |j| (i * ny + j) * nz));
        rows.flat_map(move |row| row + low[2]..=row + high[2])
    }

    /// Whether a sphere at `center` (m) is clear of every wall and of the spheres listed before.
    fn is_free(&self, center: DVec3) -> bool {
        let walls = self.obstacles.walls;
        // A box as thin as the spheres leaves only places that touch: rounding must not close them.
        let r = self.r * (1.0 - TOUCH);
        let reaching = &self.reaching[self.cell_of(center)];
        let slanted = reaching.partition_point(|&index| (index as usize) < self.obstacles.walls.len());
        self.obstacles.effort.spend(1 + reaching.len() as u64 + SLANTED * slanted as u64);
        reaching.iter().all(|&index| match walls.get(index as usize) {
            Some(wall) => wall.distance(center) >= r,
            None => {
                let sphere = &self.obstacles.spheres[index as usize - walls.len()];
                sphere.x.distance(center) >= r + sphere.radius
            }
        })
    }
}

/// Edge (m) and numbers of cubic cells: at least a diameter wide, and not many more than spheres.
fn cells(bounds: Bounds, count: usize, r: f64) -> (f64, [usize; 3]) {
    let mut edge = 2.0 * r;
    loop {
        let counts = (bounds.size() / edge).floor().max(DVec3::ONE);
        if counts.element_product() <= (2 * count + 64) as f64 {
            return (edge, counts.to_array().map(|n| n as usize));
        }
        edge *= 1.25;
    }
}

/// The stretches that spheres of radius `r` (m) reach that have their centres in each of `count` cells between two borders,
/// m. The last cell has all that is left.
fn ends([min, max]: [f64; 2], cell: f64, count: usize, r: f64) -> Vec<[f64; 2]> {
    // A hair's breadth more than the cells: rounding may put a centre on either side of their border.
    let beyond = 1e-9 * cell + r;
    let border = |index: usize| min + cell * index as f64;
    let last = |index: usize| if index + 1 == count { border(count).max(max) } else { border(index + 1) };
    (0..count).map(|index| [border(index) - beyond, last(index) + beyond]).collect()
}

/// The spheres placed so far, in chains by cell.
struct Placed<'a> {
    field: &'a Field<'a>,
    centers: Vec<DVec3>,
    first: Vec<Option<u32>>,
    next: Vec<Option<u32>>,
}

impl<'a> Placed<'a> {
    fn new(field: &'a Field<'a>, count: usize) -> Placed<'a> {
        let first = vec![None; field.reaching.len()];
        Placed { field, centers: Vec::with_capacity(count), first, next: Vec::with_capacity(count) }
    }

    fn place(&mut self, center: DVec3) {
        let head = &mut self.first[self.field.cell_of(center)];
        self.next.push(head.replace(self.centers.len() as u32));
        self.centers.push(center);
    }

    fn is_free(&self, center: DVec3) -> bool {
        let diameter = 2.0 * self.field.r;
        let mut cells = self.field.cells_of(Bounds::around(center, diameter));
        cells.all(|cell| self.chain(cell).all(|other| other.distance(center) >= diameter))
    }

    fn chain(&self, cell: usize) -> impl Iterator<Item = DVec3> {
        std::iter::successors(self.first[cell], |&index| self.next[index as usize])
            .map(|index| self.centers[index as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(edge: f64) -> Bounds {
        Bounds { min: DVec3::ZERO, max: DVec3::splat(edge) }
    }

    fn strew(count: usize, r: f64) -> Result<Vec<DVec3>, String> {
        strew_among(&[], &[], count, r)
    }

    fn strew_among(walls: &[Parallelogram], spheres: &[Sphere], count: usize, r: f64) -> Result<Vec<DVec3>, String> {
        let obstacles = Obstacles { walls, spheres, effort: &Effort::whole() };
        strewn(cube(10.0), count, r, &obstacles, &mut SplitMix64::new(7))
    }

    #[test]
    fn sparse_and_dense_gases_are_disjoint_and_inside() {
        // Packing fractions 0.004, 0.1, 0.2, 0.3 and 0.45: the first three by insertion, the others over a lattice.
        for count in [8, 191, 381, 573, 860] {
            let centers = strew(count, 0.5).expect("it fits");
            assert_eq!(centers.len(), count);
            assert!(centers.iter().all(|&x| cube(10.0).grown(-0.5).contains(x)));
            let apart = |(i, &a): (usize, &DVec3)| centers[..i].iter().all(|b| a.distance(*b) >= 1.0 - 1e-12);
            assert!(centers.iter().enumerate().all(apart), "{count}");
        }
    }

    #[test]
    fn a_gas_keeps_clear_of_slanted_walls_and_earlier_spheres() {
        let center = DVec3::splat(5.0);
        let wall = Parallelogram { center, s1: DVec3::new(8.0, 6.0, 0.0), s2: DVec3::Z * 10.0 };
        let earlier = Sphere {
            x: center.with_y(8.0),
            v: DVec3::ZERO,
            mass: 1.0,
            radius: 1.5,
            force: DVec3::ZERO,
            color: None,
            name: None,
        };
        for count in [150, 350] {
            let centers = strew_among(&[wall], std::slice::from_ref(&earlier), count, 0.5).expect("it fits");
            assert!(centers.iter().all(|&x| wall.distance(x) >= 0.5 - 1e-12 && x.distance(earlier.x) >= 2.0 - 1e-12));
        }
    }

    #[test]
    fn what_cannot_fit_is_refused_and_soon() {
        assert!(strew(1500, 0.5).is_err_and(|message| message.contains("0.7854 of the box")));
        assert!(strew(1, 6.0).is_err());
        assert!(strew(1200, 0.5).is_err(), "0.63 is above every cubic lattice");
        assert!(strew(1000, 0.5).is_ok(), "ten by ten by ten is the tightest lattice");
    }

    #[test]
    fn walls_at_one_place_are_given_up_after_so_many_looks_and_notes() {
        // At some 30 ns a look and 60 a note of two million cells: well below a second.
        let wall = Parallelogram { center: DVec3::splat(5.0), s1: DVec3::new(8.0, 8.0, 0.0), s2: DVec3::Z * 10.0 };
        let walls = vec![wall; 100_000];
        for count in [1000, 1_000_000] {
            let effort = Effort::whole();
            let obstacles = Obstacles { walls: &[], spheres: &[], effort: &effort };
            let mut field = Field::new(cube(10.0), count, 0.002, &obstacles);
            let looks = std::cell::Cell::new(0);
            for (index, wall) in walls.iter().enumerate() {
                let outline = wall.outline();
                let touches = |block: &Bounds| {
                    looks.set(looks.get() + 1);
                    effort.spend(SLANTED) && outline.may_touch(block)
                };
                field.enter(index as u32, wall.bounds(), touches);
            }
            let notes: usize = field.reaching.iter().map(Vec::len).sum();
            assert!(effort.spent() && looks.get() < 16_000_000 && notes < 5_000_000, "{looks:?} looks, {notes} notes");
        }
    }

    #[test]
    fn thin_and_long_boxes_work() {
        let thin = Bounds { min: DVec3::ZERO, max: DVec3::new(1e6, 1.0, 1.0) };
        let nothing = Obstacles { walls: &[], spheres: &[], effort: &Effort::whole() };
        let centers = strewn(thin, 2000, 0.5, &nothing, &mut SplitMix64::new(1)).expect("one in five hundred metres");
        assert!(centers.iter().all(|x| x.y == 0.5 && x.z == 0.5));
    }

    #[test]
    fn the_cube_root_is_one() {
        for value in [1e-27, 1e-3, 1.0, 8.0, 1e30] {
            let root = cube_root(value);
            assert!((root * root * root / value - 1.0).abs() < 1e-15 * 4.0, "three roundings: {value}");
        }
    }
}
