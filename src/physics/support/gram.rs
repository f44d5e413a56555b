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

/// Solves u = `free` + M⁻¹ Jᵀ λ, J u + c = 0; u by body and λ by row. A row of which less than 1e-5 is new is left out, with
/// λ = 0, if `leaves_out`; otherwise only one that depends on others and is met with them. Where more is left of one, or
/// among unlike masses, there is no answer.
pub(super) fn bind(
    inverse_mass: &[f64],
    free: &[DVec3],
    rows: &[Row],
    leaves_out: bool,
) -> Option<(Vec<DVec3>, Vec<f64>)> {
    let factor = Skyline::of_like_masses(inverse_mass, rows, leaves_out)?;
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
    /// Its index.
    row: usize,
    /// √A of its diagonal before scaling.
    length: f64,
    /// The first row that it couples with, by place.
    first: usize,
    /// Where its entries begin.
    start: usize,
}

/// The Cholesky factor, row by row. Of few rows it asks for no memory: it is made millions of times a second.
pub(super) struct Skyline {
    held: SmallVec<[Held; FEW]>,
    entries: SmallVec<[f64; FEW * (FEW + 1) / 2]>,
    /// Least square of what was new of a column.
    least: f64,
    /// Rows that were left out.
    left_out: SmallVec<[usize; FEW]>,
}

impl Skyline {
    /// The factor of these rows; none where [`bind`] has no answer.
    pub(super) fn of_like_masses(inverse_mass: &[f64], rows: &[Row], leaves_out: bool) -> Option<Skyline> {
        let (light, heavy) =
            inverse_mass.iter().fold((0.0, f64::INFINITY), |(most, least): (f64, f64), &w| (most.max(w), least.min(w)));
        if light > LIKE_MASSES * heavy { None } else { Skyline::of(inverse_mass, rows, leaves_out) }
    }

    /// u by body and λ by row, for the rows of the factor with any offsets.
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

    fn of(inverse_mass: &[f64], rows: &[Row], leaves_out: bool) -> Option<Skyline> {
        let mut factor = Skyline {
            held: SmallVec::with_capacity(rows.len()),
            entries: SmallVec::with_capacity(rows.len() * (rows.len().min(FEW) + 1) / 2),
            least: 1.0,
            left_out: SmallVec::new(),
        };
        let mut firsts: SmallVec<[usize; FEW]> = smallvec![usize::MAX; inverse_mass.len()];
        if rows.len() <= FEW {
            for index in 0..rows.len() {
                factor.append((inverse_mass, rows), index, leaves_out, &mut firsts)?;
            }
        } else {
            for index in walked(inverse_mass.len(), rows) {
                factor.append((inverse_mass, rows), index, leaves_out, &mut firsts)?;
            }
        }
        Some(factor)
    }

    /// Appends a row; none if too little of it is new.
    fn append(
        &mut self,
        (inverse_mass, rows): (&[f64], &[Row]),
        index: usize,
        leaves_out: bool,
        firsts: &mut [usize],
    ) -> Option<()> {
        let (row, place, start) = (&rows[index], self.held.len(), self.entries.len());
        let weight = inverse_mass[row.a] + row.b.map_or(0.0, |b| inverse_mass[b]);
        let length = (weight * row.normal.length_squared()).sqrt();
        let first = firsts[row.a].min(row.b.map_or(usize::MAX, |b| firsts[b])).min(place);
        let mut new = 1.0;
        for other in first..place {
            let held = self.held[other];
            let coupling = coupling(inverse_mass, row, &rows[held.row]) / (length * held.length);
            let from = held.first.max(first);
            let (above, own) = (
                &self.entries[held.start + from - held.first..][..other - from],
                &self.entries[start + from - first..],
            );
            let entry = (coupling - dot(above, own)) / self.entries[held.start + other - held.first];
            new -= entry * entry;
            self.entries.push(entry);
        }
        if new <= if leaves_out { LEFT_OUT } else { DEPENDS } {
            self.entries.truncate(start);
            self.left_out.push(index);
            return Some(());
        }
        if !leaves_out && new < INDEPENDENT || new.is_nan() {
            return None;
        }
        self.least = self.least.min(new);
        self.entries.push(new.sqrt());
        self.held.push(Held { row: index, length, first, start });
        for body in [Some(row.a), row.b].into_iter().flatten() {
            firsts[body] = firsts[body].min(place);
        }
        Some(())
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

    /// The entries of a row left of the diagonal, and that.
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

/// The rows in the order in which a walk from neighbour to neighbour has met all their bodies.
fn walked(bodies: usize, rows: &[Row]) -> Vec<usize> {
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); bodies];
    for (a, b) in rows.iter().filter_map(|row| Some((row.a, row.b?))) {
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
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
    let mut order: Vec<usize> = (0..rows.len()).collect();
    let key = |&index: &usize| {
        let (a, b) = (place[rows[index].a], rows[index].b.map_or(0, |b| place[b]));
        (a.max(b), a.min(b), index)
    };
    order.sort_unstable_by_key(key);
    order
}

/// Meets `start` and everything connected with it, nearest first.
fn walk(start: usize, neighbours: &[Vec<usize>], place: &mut [usize], met: &mut Vec<usize>) {
    let mut next = met.len();
    place[start] = next;
    met.push(start);
    while next < met.len() {
        for &body in &neighbours[met[next]] {
            if place[body] == usize::MAX {
                place[body] = met.len();
                met.push(body);
            }
        }
        next += 1;
    }
}
