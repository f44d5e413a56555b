//! How deep now? Gaps, degrees, normals of spheres with walls and each other.
//!
//! Gap: distance of a sphere's centre to the **closest point** of the parallelogram (face, edge or corner) minus r; of
//! a pair: distance of the centres minus r1 + r2. Degree: −gap / r, −gap / (r1 + r2) (source: paper 2.2; its distance
//! to the plane alone jumps at edges and has no root there).

use std::ops::Range;

use glam::DVec3;

use super::contact::{Key, Kind};
use super::model::Model;
use super::neighbors::Cells;
use super::requirements::PairSearch;
use super::wall::Face;

/// Where and how deep two bodies touch (negative degree: apart).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intersection {
    /// Contact point, m: on the wall, or on the line of centres in the middle of the overlap.
    pub point: DVec3,
    /// Unit normal, from the contact point to the (first) sphere's centre.
    pub normal: DVec3,
    /// −gap / r or −gap / (r1 + r2), dimensionless.
    pub degree: f64,
}

/// Two bodies that touch or overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// The two bodies that overlap.
    pub key: Key,
    /// Intersection degree, dimensionless.
    pub degree: f64,
}

/// How a sphere of radius `r` (m) at `x` (m) touches a wall. The side it is on is decided by its centre's way from `from`
/// (m), the frame's start: where that way leads through the face, the degree goes on growing beyond 1 past the plane, so
/// that no search accepts the far side.
pub fn wall_touch(face: &Face, from: DVec3, x: DVec3, r: f64) -> Intersection {
    let height = face.height(x);
    if face.shades(x) {
        let side = side(face, from, x, height);
        return Intersection {
            point: x - face.normal * height,
            normal: face.normal * side,
            degree: 1.0 - side * height / r,
        };
    }
    let arm = face.shape.closest(x).offset;
    let distance = arm.length();
    Intersection { point: x - arm, normal: arm / distance, degree: 1.0 - distance / r }
}

/// +1 or −1: the side of the face from which a centre came to `x` at this height (m) over the plane.
fn side(face: &Face, from: DVec3, x: DVec3, height: f64) -> f64 {
    let before = face.height(from);
    let crossed = (before < 0.0) != (height < 0.0);
    let came = if crossed && face.shades(from + (x - from) * (before / (before - height))) { before } else { height };
    if came < 0.0 { -1.0 } else { 1.0 }
}

/// Gap, m, up to which bodies of size `r` (m) at coordinates of size `at` (m) touch at load: what rounding may leave
/// between bodies that are meant to touch, 1e-12 r or 8 ulp of the coordinates.
pub fn touching(r: f64, at: f64) -> f64 {
    (1e-12 * r).max(8.0 * f64::EPSILON * at)
}

/// How two spheres at `a` and `b` (m) of radii `r_a` and `r_b` (m) touch.
pub fn pair_touch(a: DVec3, b: DVec3, r_a: f64, r_b: f64) -> Intersection {
    let (arm, reach) = (a - b, r_a + r_b);
    let distance = arm.length();
    // Coincident centres have no normal: any fixed one separates them.
    let normal = if distance > 0.0 { arm / distance } else { DVec3::Y };
    let degree = 1.0 - distance / reach;
    Intersection { point: b + normal * (r_b - 0.5 * degree * reach), normal, degree }
}

/// The bodies of `key` as they touch in a state with centres `x` (m); `from` as in [`wall_touch`].
pub fn touch(model: &Model, from: &[DVec3], x: &[DVec3], (kind, a, b): Key) -> Intersection {
    match kind {
        Kind::Wall => wall_touch(&model.faces[b], from[a], x[a], model.radii[a]),
        Kind::Pair => pair_touch(x[a], x[b], model.radii[a], model.radii[b]),
    }
}

/// Degree of two spheres whose radii sum to `reach` (m), or nothing if it is below −`slack`.
#[inline(always)]
fn pair_degree(a: DVec3, b: DVec3, reach: f64, slack: f64) -> Option<f64> {
    let squared = (a - b).length_squared();
    let limit = reach * (1.0 + slack);
    if squared > limit * limit {
        return None;
    }
    let degree = 1.0 - squared.sqrt() / reach;
    (degree >= -slack).then_some(degree)
}

/// Degrees that a test of every sphere against every wall and every other sphere computes.
pub fn evaluations(model: &Model) -> u64 {
    let n = model.len() as u64;
    n * model.faces.len() as u64 + n * n.saturating_sub(1) / 2
}

/// Whether any sphere is as near to a wall's plane, or to another sphere, as a contact needs: a quick look at scenes
/// whose pairs are all looked at. `WALLS` and `PAIRS` tell whether there are any.
#[inline(always)]
pub fn any_near<const WALLS: bool, const PAIRS: bool>(model: &Model, x: &[DVec3]) -> bool {
    let mut near = false;
    if WALLS {
        for (x, r) in x.iter().zip(&model.radii) {
            for face in &model.faces {
                near |= face.height(*x).abs() <= *r;
            }
        }
    }
    if PAIRS {
        for (a, (x_a, r_a)) in x.iter().zip(&model.radii).enumerate() {
            for (x_b, r_b) in x.iter().zip(&model.radii).skip(a + 1) {
                let reach = r_a + r_b;
                near |= (*x_a - *x_b).length_squared() <= reach * reach;
            }
        }
    }
    near
}

/// All overlaps of one trial state at a time, found in slices: [`Finder::begin`], then [`Finder::walls`] over all
/// spheres, then [`Finder::pairs`] until it is done.
#[derive(Debug, Clone, Default)]
pub struct Finder {
    /// The overlaps found, a gap of exactly 0 included; sorted by key as soon as all are found.
    pub found: Vec<Overlap>,
    /// Degrees computed for the present trial state.
    pub evaluations: u64,
    /// Whether bodies that touch but for rounding count too.
    at_load: bool,
    /// How many of the overlaps are with walls.
    walls: usize,
    stage: FinderStage,
    cells: Option<Cells>,
}

/// What the pair search does next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum FinderStage {
    /// Lays out the cells.
    #[default]
    Open,
    /// Sorts spheres into cells, from this one on.
    Scatter(usize),
    /// Measures distances, from this cell on.
    Measure(usize),
}

/// Spheres or cells worked on between two looks at the budget.
pub const CHUNK: usize = 4096;

/// Why a finder that looks into its cells has them.
const CELLS: &str = "a finder for a model whose pairs are found by cells has cells";

/// By how much radii grow for the coarse tests at load: more than [`touching`] allows up to 5e8 radii from the origin.
const LOAD_GROWTH: f64 = 1.0 + 1e-6;

impl Finder {
    /// A finder for this model's trial states.
    pub fn new(model: &Model) -> Finder {
        let cells = (model.pairs == PairSearch::Cells).then(|| Cells::new(&model.radii));
        Finder { cells, ..Finder::default() }
    }

    /// A copy of what was found, without memory to find more.
    pub(super) fn kept(&self) -> Finder {
        Finder { found: self.found.clone(), ..Finder::default() }
    }

    /// Gives a kept copy memory to find more.
    pub(super) fn wake(&mut self, model: &Model) {
        let found = std::mem::take(&mut self.found);
        *self = Finder { found, ..Finder::new(model) };
    }

    /// Finds all overlaps of a state with centres `x` (m) in one go, at load also what touches but for rounding; the
    /// number of degrees computed.
    pub fn all(&mut self, model: &Model, x: &[DVec3], at_load: bool) -> u64 {
        self.begin();
        self.at_load = at_load;
        self.walls(model, x, x, 0..x.len());
        while !self.pairs(model, x).0 {}
        self.at_load = false;
        self.evaluations
    }

    /// Forgets the last trial state.
    #[inline(always)]
    pub fn begin(&mut self) {
        self.found.clear();
        self.evaluations = 0;
        self.stage = FinderStage::Open;
        if let Some(cells) = &mut self.cells {
            cells.clear();
        }
    }

    /// Tests these spheres, at `x` (m), against every wall, and counts them into their cells; `from` as in
    /// [`wall_touch`]. Ranges come in order.
    #[inline(always)]
    pub fn walls(&mut self, model: &Model, from: &[DVec3], x: &[DVec3], range: Range<usize>) {
        if !model.faces.is_empty() {
            let growth = self.growth();
            for i in range.clone() {
                let (x, r) = (x[i], model.radii[i]);
                for (w, face) in model.faces.iter().enumerate() {
                    // The plane is never farther than the parallelogram: most spheres are done here.
                    if face.height(x).abs() <= r * growth {
                        self.meet(model, from[i], x, (i, w));
                    }
                }
            }
            self.evaluations += (range.len() * model.faces.len()) as u64;
        }
        if let Some(cells) = &mut self.cells {
            cells.count(x, range);
        }
    }

    /// Measures sphere `i` near the plane of wall `w`, and keeps the overlap if there is one.
    #[cold]
    #[inline(never)]
    fn meet(&mut self, model: &Model, from: DVec3, x: DVec3, (i, w): (usize, usize)) {
        let (face, r) = (&model.faces[w], model.radii[i]);
        let degree = wall_touch(face, from, x, r).degree;
        if degree >= -slack(self.at_load, r, x, face.shape.center) {
            self.found.push(Overlap { key: (Kind::Wall, i, w), degree });
        }
    }

    /// By how much radii grow for the coarse tests.
    fn growth(&self) -> f64 {
        if self.at_load { LOAD_GROWTH } else { 1.0 }
    }

    /// Goes on with the pairs, after all walls: whether all overlaps are found, and the work that took.
    #[inline(always)]
    pub fn pairs(&mut self, model: &Model, x: &[DVec3]) -> (bool, u64) {
        match model.pairs {
            PairSearch::None => (true, 0),
            PairSearch::All => self.every_pair(model, x),
            PairSearch::Cells => self.near_pairs(model, x),
        }
    }

    fn every_pair(&mut self, model: &Model, x: &[DVec3]) -> (bool, u64) {
        let r = &model.radii;
        for a in 0..x.len() {
            for b in a + 1..x.len() {
                let reach = r[a] + r[b];
                if let Some(degree) = pair_degree(x[a], x[b], reach, slack(self.at_load, reach, x[a], x[b])) {
                    self.found.push(Overlap { key: (Kind::Pair, a, b), degree });
                }
            }
        }
        let distances = (x.len() * (x.len() - 1) / 2) as u64;
        self.evaluations += distances;
        (true, distances)
    }

    fn near_pairs(&mut self, model: &Model, x: &[DVec3]) -> (bool, u64) {
        let growth = self.growth();
        let cells = self.cells.as_mut().expect(CELLS);
        match self.stage {
            FinderStage::Open => {
                cells.open();
                self.walls = self.found.len();
                self.stage = FinderStage::Scatter(0);
                (false, cells.len() as u64 / 4)
            }
            FinderStage::Scatter(from) => {
                let to = x.len().min(from + CHUNK);
                cells.scatter(x, &model.radii, growth, from..to);
                self.stage = if to < x.len() { FinderStage::Scatter(to) } else { FinderStage::Measure(0) };
                (false, (to - from) as u64)
            }
            FinderStage::Measure(from) => {
                let to = cells.len().min(from + CHUNK);
                let last = to == cells.len();
                let work = self.measure(model, x, from..to);
                self.stage = FinderStage::Measure(to);
                (last, work)
            }
        }
    }

    /// Measures the distances that begin in these cells; the work that took.
    fn measure(&mut self, model: &Model, x: &[DVec3], range: Range<usize>) -> u64 {
        let cells = self.cells.take().expect(CELLS);
        let work = range.len() as u64 / 4;
        let last = range.end == cells.len();
        let distances = cells.pairs(range, |a, b| {
            let reach = model.radii[a] + model.radii[b];
            let degree = pair_degree(x[a], x[b], reach, slack(self.at_load, reach, x[a], x[b]));
            self.found.extend(degree.map(|degree| Overlap { key: (Kind::Pair, a, b), degree }));
        });
        if last {
            self.found[self.walls..].sort_unstable_by_key(|o| o.key);
        }
        self.evaluations += distances;
        self.cells = Some(cells);
        work + distances
    }
}

/// The gap that counts as none, in units of the size `r` (m) of the bodies at `p` and `q` (m).
#[inline(always)]
fn slack(at_load: bool, r: f64, p: DVec3, q: DVec3) -> f64 {
    if at_load { touching(r, p.abs().max(q.abs()).max_element()) / r } else { 0.0 }
}
