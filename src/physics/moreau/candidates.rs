//! Which bodies may touch within the frame: spheres grown by how far they may move.
//!
//! Cells serve the many that move about as far as they are wide; the few that move farther are compared with all spheres,
//! so that one fast sphere does not make every cell as wide as its way.

use std::cell::Cell;
use std::ops::Range;

use glam::DVec3;

use crate::physics::contact::{Key, Kind};
use crate::physics::model::Model;
use crate::physics::neighbors::Cells;
use crate::physics::requirements::PairSearch;
use crate::physics::wall::Face;

/// Spheres or cells worked on between two looks at the budget.
const CHUNK: usize = 4096;

/// Reach over the widest radius that the first cells are made for, dimensionless.
const SNUG: f64 = 1.25;

/// Factor by which cells grow when too many spheres reach beyond them.
const GROWTH: f64 = 1.5;

/// Widening of a wall that leaves room for the rounding of (u, v), dimensionless.
const BESIDE: f64 = 1.0 + 1e-6;

/// Candidates that a frame may have beside those of each sphere: what memory small scenes may take, some 30 MB.
const MOST_IN_ALL: usize = 1 << 20;

/// Candidates that a frame may have for each sphere besides: one that moves as far as it is wide meets about ten.
const MOST_PER_SPHERE: usize = 32;

/// What the search does next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SearchStage {
    /// Compares spheres with the planes of the walls, from this one on.
    Walls(usize),
    /// Measures distances in cells, from this one on.
    Cells(usize),
    /// Compares the far-reaching spheres (all, without cells) with all spheres, from this one on.
    Far(usize),
    /// Nothing: all candidates are found.
    Done,
}

/// The candidates of one frame, found in slices.
#[derive(Debug, Clone)]
pub(super) struct Candidates {
    /// Pairs of bodies that may touch, sorted once the search is done.
    pub(super) found: Vec<Key>,
    /// Radius plus the way that a sphere may go in the frame, m, by sphere.
    reach: Vec<f64>,
    /// Reach as the cells see it, m, by sphere; NaN for spheres that are compared with all others.
    near: Vec<f64>,
    /// Spheres that are compared with all others.
    far: Vec<usize>,
    cells: Option<Cells>,
    /// Largest reach that the cells are made for, m.
    widest: f64,
    stage: SearchStage,
}

impl Candidates {
    pub(super) fn new(model: &Model) -> Candidates {
        let widest = SNUG * model.radii.iter().copied().fold(0.0, f64::max);
        let n = model.len();
        let cells = (model.pairs == PairSearch::Cells).then(|| Cells::new(&vec![widest; n]));
        let far = if cells.is_none() { (0..n).collect() } else { Vec::new() };
        Candidates {
            found: Vec::new(),
            reach: vec![0.0; n],
            near: vec![0.0; n],
            far,
            cells,
            widest,
            stage: SearchStage::Done,
        }
    }

    /// A copy without scratch memory, which keeps only how wide the cells are.
    pub(super) fn kept(&self) -> Candidates {
        Candidates {
            found: Vec::new(),
            reach: Vec::new(),
            near: Vec::new(),
            far: Vec::new(),
            cells: None,
            widest: self.widest,
            stage: SearchStage::Done,
        }
    }

    /// Gives a kept copy its memory back.
    pub(super) fn wake(&mut self, model: &Model) {
        let widest = self.widest;
        *self = Candidates { widest, ..Candidates::new(model) };
        if let Some(cells) = &mut self.cells {
            *cells = Cells::new(&vec![widest; model.len()]);
        }
    }

    /// Begins anew with these reaches, m by sphere.
    pub(super) fn begin(&mut self, reach: impl Iterator<Item = f64>) {
        self.reach.clear();
        self.reach.extend(reach);
        self.restart();
    }

    /// Begins anew with a sphere's reach (m) no smaller than this.
    pub(super) fn widen(&mut self, sphere: usize, reach: f64) {
        self.reach[sphere] = self.reach[sphere].max(reach);
    }

    /// How far from its centre a sphere is looked around, m.
    pub(super) fn reach(&self, sphere: usize) -> f64 {
        self.reach[sphere]
    }

    pub(super) fn restart(&mut self) {
        self.found.clear();
        self.stage = SearchStage::Walls(0);
        if self.cells.is_some() {
            self.fit_cells();
        }
    }

    /// Chooses the width of the cells: most spheres' reach fits. Grows by steps, so that few frames pay for it.
    fn fit_cells(&mut self) {
        let n = self.reach.len();
        let most = 8 + n / 64;
        let beyond = |limit: f64| self.reach.iter().filter(|&&reach| reach > limit).count();
        let mut widest = self.widest;
        while beyond(widest) > most && widest.is_finite() {
            widest *= GROWTH;
        }
        // Back to narrow cells only when far too wide: a width that flickers would be paid for in every frame.
        let narrow = widest / (GROWTH * GROWTH);
        let smallest = SNUG * self.reach.iter().copied().fold(f64::INFINITY, f64::min);
        if widest == self.widest && narrow > smallest && beyond(narrow) <= most {
            widest /= GROWTH;
        }
        if widest != self.widest {
            self.widest = widest;
            self.cells = Some(Cells::new(&vec![widest; n]));
        }
        self.far.clear();
        self.far.extend((0..n).filter(|&i| self.reach[i] > widest));
        let seen = |reach: f64| if reach > widest { f64::NAN } else { reach };
        self.near.clear();
        self.near.extend(self.reach.iter().map(|&reach| seen(reach)));
        if let Some(cells) = &mut self.cells {
            cells.clear();
        }
    }

    /// Whether more bodies may meet than a frame is made for. Then the search goes no further.
    pub(super) fn overflows(&self) -> bool {
        self.found.len() > most_candidates(self.reach.len())
    }

    /// Goes on with the search among spheres at `x` (m): whether all candidates are found, and the work that took.
    pub(super) fn go_on(&mut self, model: &Model, x: &[DVec3]) -> (bool, u64) {
        if self.overflows() {
            return (true, 1);
        }
        let work = match self.stage {
            SearchStage::Walls(from) => self.walls(model, x, from..x.len().min(from + CHUNK)),
            SearchStage::Cells(from) => self.pairs_in_cells(from),
            SearchStage::Far(from) => self.far_pairs(x, from),
            SearchStage::Done => 0,
        };
        (self.stage == SearchStage::Done, work)
    }

    fn walls(&mut self, model: &Model, x: &[DVec3], range: Range<usize>) -> u64 {
        for i in range.clone() {
            for (w, face) in model.faces.iter().enumerate() {
                if is_near(face, x[i], self.reach[i]) {
                    self.found.push((Kind::Wall, i, w));
                }
            }
        }
        if let Some(cells) = &mut self.cells {
            cells.count(x, range.clone());
        }
        if self.overflows() {
            return (range.len() * model.faces.len()) as u64;
        }
        self.stage = SearchStage::Walls(range.end);
        if range.end == x.len() {
            self.stage = self.after_walls(x);
        }
        1 + (range.len() * model.faces.len()) as u64
    }

    fn after_walls(&mut self, x: &[DVec3]) -> SearchStage {
        let Some(cells) = &mut self.cells else { return SearchStage::Far(0) };
        cells.open();
        cells.scatter(x, &self.near, 1.0, 0..x.len());
        SearchStage::Cells(0)
    }

    fn pairs_in_cells(&mut self, from: usize) -> u64 {
        let cells = self.cells.as_ref().expect("cells are gone through only where they have been filled");
        let to = cells.len().min(from + CHUNK);
        let (found, most) = (&mut self.found, most_candidates(self.reach.len()));
        let full = Cell::new(found.len() > most);
        let near = |a: usize, b: usize| {
            if !full.get() {
                found.push((Kind::Pair, a, b));
                full.set(found.len() > most);
            }
        };
        let distances = cells.pairs_until(from..to, near, || full.get());
        self.stage = if to == cells.len() { SearchStage::Far(0) } else { SearchStage::Cells(to) };
        distances + (to - from) as u64 / 4
    }

    /// Compares one far-reaching sphere with all spheres; pairs of two such are met once, from the lower index. The work
    /// that took.
    fn far_pairs(&mut self, x: &[DVec3], from: usize) -> u64 {
        let Some(&i) = self.far.get(from) else {
            self.found.sort_unstable();
            self.stage = SearchStage::Done;
            return 1 + self.found.len() as u64;
        };
        let first = if self.cells.is_some() { 0 } else { i + 1 };
        for j in first..x.len() {
            let limit = self.reach[i] + self.reach[j];
            let met_elsewhere = j == i || (j < i && self.near[j].is_nan());
            if (x[i] - x[j]).length_squared() <= limit * limit && !met_elsewhere {
                self.found.push((Kind::Pair, i.min(j), i.max(j)));
            }
        }
        self.stage = SearchStage::Far(from + 1);
        (x.len() - first) as u64
    }
}

/// Most candidates of a frame of so many spheres.
pub(super) fn most_candidates(spheres: usize) -> usize {
    MOST_IN_ALL + MOST_PER_SPHERE * spheres
}

/// Whether a wall may be as near to `x` (m) as `reach` (m): it lies within that of the plane, and its foot within that of
/// the outline.
fn is_near(face: &Face, x: DVec3, reach: f64) -> bool {
    let foot = x - face.shape.center;
    let beside = |dual: DVec3| foot.dot(dual).abs() <= 0.5 + BESIDE * reach * dual.length();
    foot.dot(face.normal).abs() <= reach && beside(face.dual1) && beside(face.dual2)
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;
    use crate::geometry::Parallelogram;

    #[test]
    fn no_wall_within_reach_is_left_out() {
        let skewed = Parallelogram { center: DVec3::ONE, s1: dvec3(3.0, 0.0, 0.1), s2: dvec3(2.5, 0.3, 0.4) };
        let face = Face::new(skewed);
        for k in 0..4096 {
            let at = |shift: u32| f64::from((k >> shift) & 15) - 7.5;
            let x = DVec3::ONE + dvec3(at(0), at(4), at(8)) * 0.4;
            // a distance is rounded: some ulp of coordinates of a few metres
            let distance = skewed.distance(x) * (1.0 + 1e-12);
            assert!(is_near(&face, x, distance), "{x} at {distance} m");
        }
    }
}
