//! Contacts that hold both ways by the Cholesky factor of A = J M⁻¹ Jᵀ, for rows that are independent by a good deal and
//! bodies of like masses: many times cheaper than an orthogonal factor, and with steps of iterative refinement as good.
//!
//! A is scaled to a diagonal of 1 and kept as a skyline (Jennings 1966; George, Liu, Computer Solution of Large Sparse
//! Positive Definite Systems, ch. 4): of every row the entries from the first one that is not 0 to the diagonal, within
//! which all fill stays. Many rows are taken in the order in which a walk from neighbour to neighbour meets their bodies
//! (Cuthill, McKee 1969), so that each couples only with those shortly before it.

use glam::DVec3;
use smallvec::{SmallVec, smallvec};

use super::problem::Row;

/// Least square of what is new of a column: below, A has lost more digits than refinement brings back.
const INDEPENDENT: f64 = 1e-8;

/// Least square of what is new of a column where columns with less are left out: those that stay need fewer digits.
const LEFT_OUT: f64 = 1e-10;

/// Square of what rounding leaves of a column that depends on others. Whether it does shows in the end: what it asks for
/// is then met without it, but for this share.
const DEPENDS: f64 = 1e-13;

/// Ratio of masses up to which multipliers that cancel in a light body cost it no more than three digits before refinement.
const LIKE_MASSES: f64 = 1e3;

/// Rows up to which their order does not matter.
const FEW: usize = 16;

/// Squares of what is new of a column below which a further step of refinement is worth its cost.
const DOUBTFUL: f64 = 1e-3;

/// Solves u = `free` + M⁻¹ Jᵀ λ, J u + c = 0; u by body and λ by row. A row of which less than 1e-5 is new is left out,
/// with λ = 0, if `leaves_out`; otherwise only one that depends on others and is met with them. Where more is left of one,
/// or among unlike masses, there is no answer.
pub(super) fn bind(
    inverse_mass: &[f64],
    free: &[DVec3],
    rows: &[Row],
    leaves_out: bool,
) -> Option<(Vec<DVec3>, Vec<f64>)> {
    let mut factor = Skyline::empty();
    if !factor.take(inverse_mass, rows, leaves_out) {
        return None;
    }
    let (u, multipliers) = factor.bind(inverse_mass, free, rows);
    let is_met = |&index: &usize| {
        let row = &rows[index];
        let (own, other) = (u[row.a], row.b.map_or(DVec3::ZERO, |b| u[b]));
        let size = own.length() + other.length() + free[row.a].length() + row.b.map_or(0.0, |b| free[b].length());
        (row.normal.dot(own - other) + row.offset).abs() <= DEPENDS * (size + row.offset.abs())
    };
    (leaves_out || factor.left_out.iter().all(is_met)).then_some((u, multipliers))
}

/// A row that holds.
#[derive(Debug, Clone, Copy)]
struct Held {
    /// Index of the row.
    row: usize,
    /// √A of the row's diagonal before scaling.
    length: f64,
    /// The first row that the row couples with, by place.
    first: usize,
    /// Where the row's entries begin.
    start: usize,
}

/// The Cholesky factor, row by row. Of few rows it asks for no memory: it is made millions of times a second.
pub(super) struct Skyline {
    held: SmallVec<[Held; FEW]>,
    entries: SmallVec<[f64; FEW * (FEW + 1) / 2]>,
    /// Least square of what was new of a column so far.
    least: f64,
    /// Rows that were left out.
    left_out: SmallVec<[usize; FEW]>,
}

impl Skyline {
    /// The factor of no rows.
    #[inline]
    pub(super) fn empty() -> Skyline {
        Skyline { held: SmallVec::new(), entries: SmallVec::new(), least: 1.0, left_out: SmallVec::new() }
    }

    /// Takes these rows into an empty factor, where it stands: it is too large to be handed about. False where [`bind`] has
    /// no answer.
    pub(super) fn take(&mut self, inverse_mass: &[f64], rows: &[Row], leaves_out: bool) -> bool {
        let (light, heavy) =
            inverse_mass.iter().fold((0.0, f64::INFINITY), |(most, least): (f64, f64), &w| (most.max(w), least.min(w)));
        if light > LIKE_MASSES * heavy {
            return false;
        }
        let mut firsts: SmallVec<[usize; FEW]> = smallvec![usize::MAX; inverse_mass.len()];
        let mut append = |index: usize| self.append((inverse_mass, rows), index, leaves_out, &mut firsts);
        if rows.len() <= FEW {
            (0..rows.len()).all(&mut append)
        } else {
            walked(inverse_mass.len(), rows).into_iter().all(append)
        }
    }

    /// Vectors u by body and multipliers λ by row, for the rows of the factor with any offsets.
    pub(super) fn bind(&self, inverse_mass: &[f64], free: &[DVec3], rows: &[Row]) -> (Vec<DVec3>, Vec<f64>) {
        let mut u = free.to_vec();
        let mut multipliers = vec![0.0; rows.len()];
        let mut change: SmallVec<[f64; FEW]> = smallvec![0.0; self.held.len()];
        for _ in 0..if self.least < DOUBTFUL { 3 } else { 2 } {
            for (change, held) in change.iter_mut().zip(&self.held) {
                let row = &rows[held.row];
                let relative = u[row.a] - row.b.map_or(DVec3::ZERO, |b| u[b]);
                *change = -(row.normal.dot(relative) + row.offset) / held.length;
            }
            self.solve(&mut change);
            for (change, held) in change.iter().zip(&self.held) {
                let (row, force) = (&rows[held.row], change / held.length);
                multipliers[held.row] += force;
                u[row.a] += row.normal * (force * inverse_mass[row.a]);
                if let Some(b) = row.b {
                    u[b] -= row.normal * (force * inverse_mass[b]);
                }
            }
        }
        (u, multipliers)
    }

    /// Appends a row; false if too little of it is new.
    fn append(
        &mut self,
        (inverse_mass, rows): (&[f64], &[Row]),
        index: usize,
        leaves_out: bool,
        firsts: &mut [usize],
    ) -> bool {
        let (row, place, start) = (&rows[index], self.held.len(), self.entries.len());
        let weight = inverse_mass[row.a] + row.b.map_or(0.0, |b| inverse_mass[b]);
        let length = (weight * row.normal.length_squared()).sqrt();
        let first = firsts[row.a].min(row.b.map_or(usize::MAX, |b| firsts[b])).min(place);
        let count = place - first;
        self.entries.resize(start + count + 1, 0.0);
        let (before, own) = self.entries.split_at_mut(start);
        let mut new = 1.0;
        for (k, held) in self.held[first..].iter().enumerate() {
            let coupling = coupling(inverse_mass, row, &rows[held.row]) / (length * held.length);
            let from = held.first.max(first);
            let above = &before[held.start + from - held.first..=held.start + first + k - held.first];
            let (&diagonal, above) = above.split_last().expect("a row ends with its diagonal");
            let entry = (coupling - dot(above, &own[from - first..])) / diagonal;
            new -= entry * entry;
            own[k] = entry;
        }
        if new <= if leaves_out { LEFT_OUT } else { DEPENDS } {
            self.entries.truncate(start);
            self.left_out.push(index);
            return true;
        }
        if !leaves_out && new < INDEPENDENT || new.is_nan() {
            return false;
        }
        self.least = self.least.min(new);
        own[count] = new.sqrt();
        self.held.push(Held { row: index, length, first, start });
        for body in [Some(row.a), row.b].into_iter().flatten() {
            firsts[body] = firsts[body].min(place);
        }
        true
    }

    /// Solves A z = `right`, in place.
    fn solve(&self, right: &mut [f64]) {
        for (place, held) in self.held.iter().enumerate() {
            let (own, diagonal) = self.row(place);
            let known = dot(own, &right[held.first..place]);
            right[place] = (right[place] - known) / diagonal;
        }
        for (place, held) in self.held.iter().enumerate().rev() {
            let (own, diagonal) = self.row(place);
            let (head, tail) = right.split_at_mut(place);
            tail[0] /= diagonal;
            head[held.first..].iter_mut().zip(own).for_each(|(value, entry)| *value -= entry * tail[0]);
        }
    }

    /// The entries of a row left of the diagonal, and the diagonal.
    fn row(&self, place: usize) -> (&[f64], f64) {
        let held = self.held[place];
        let count = place - held.first;
        (&self.entries[held.start..held.start + count], self.entries[held.start + count])
    }
}

/// An element of A.
#[inline]
fn coupling(inverse_mass: &[f64], one: &Row, other: &Row) -> f64 {
    let shared = |body: usize| match (other.a == body, other.b == Some(body)) {
        (true, _) => inverse_mass[body],
        (_, true) => -inverse_mass[body],
        _ => 0.0,
    };
    let weight = shared(one.a) - one.b.map_or(0.0, shared);
    if weight == 0.0 { 0.0 } else { weight * one.normal.dot(other.normal) }
}

/// Σ xᵢ yᵢ, four at a time where there are so many: the processor need not wait for each sum.
#[inline]
fn dot(x: &[f64], y: &[f64]) -> f64 {
    let y = &y[..x.len()];
    if x.len() < 4 {
        return x.iter().zip(y).fold(0.0, |sum, (x, y)| sum + x * y);
    }
    let mut sums = [0.0; 4];
    let (quads, others) = (x.chunks_exact(4), y.chunks_exact(4));
    let rest: f64 = quads.remainder().iter().zip(others.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in quads.zip(others) {
        for k in 0..4 {
            sums[k] += x[k] * y[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Which bodies share a row: those of body i stand in `list[starts[i]..starts[i + 1]]`.
struct Neighbours {
    starts: Vec<usize>,
    list: Vec<usize>,
}

impl Neighbours {
    fn new(bodies: usize, rows: &[Row]) -> Neighbours {
        let pairs = || rows.iter().filter_map(|row| Some((row.a, row.b?)));
        let mut starts = vec![0; bodies + 1];
        pairs().for_each(|(a, b)| {
            starts[a] += 1;
            starts[b] += 1;
        });
        let mut total = 0;
        for start in &mut starts {
            total += *start;
            *start = total;
        }
        // filled from the back, every start comes to where its list begins
        let mut list = vec![0; total];
        for (a, b) in rows.iter().rev().filter_map(|row| Some((row.a, row.b?))) {
            for (one, other) in [(b, a), (a, b)] {
                starts[one] -= 1;
                list[starts[one]] = other;
            }
        }
        Neighbours { starts, list }
    }

    fn of(&self, body: usize) -> &[usize] {
        &self.list[self.starts[body]..self.starts[body + 1]]
    }
}

/// The rows in the order in which a walk from neighbour to neighbour has met all their bodies.
fn walked(bodies: usize, rows: &[Row]) -> Vec<usize> {
    let neighbours = Neighbours::new(bodies, rows);
    let mut place = vec![usize::MAX; bodies];
    let mut met: Vec<usize> = Vec::with_capacity(bodies);
    for start in 0..bodies {
        if place[start] != usize::MAX {
            continue;
        }
        // the walk begins where another one ends: at one end of the pile
        let from = met.len();
        walk(start, &neighbours, &mut place, &mut met);
        let end = met[met.len() - 1];
        met.drain(from..).for_each(|body| place[body] = usize::MAX);
        walk(end, &neighbours, &mut place, &mut met);
    }
    let last = |row: &Row| place[row.a].max(row.b.map_or(0, |b| place[b]));
    let mut ends = vec![0; bodies];
    rows.iter().for_each(|row| ends[last(row)] += 1);
    let mut total = 0;
    for end in &mut ends {
        total += *end;
        *end = total;
    }
    let (mut order, mut starts) = (vec![0; rows.len()], ends.clone());
    for (index, row) in rows.iter().enumerate().rev() {
        let start = &mut starts[last(row)];
        *start -= 1;
        order[*start] = index;
    }
    for (start, end) in starts.into_iter().zip(ends) {
        // few rows end at one body
        order[start..end].sort_by_key(|&index| place[rows[index].a].min(rows[index].b.map_or(0, |b| place[b])));
    }
    order
}

/// Meets `start` and everything connected with it, nearest first.
fn walk(start: usize, neighbours: &Neighbours, place: &mut [usize], met: &mut Vec<usize>) {
    let mut next = met.len();
    place[start] = next;
    met.push(start);
    while next < met.len() {
        for &body in neighbours.of(met[next]) {
            if place[body] == usize::MAX {
                place[body] = met.len();
                met.push(body);
            }
        }
        next += 1;
    }
}
