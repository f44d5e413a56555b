//! Which spheres are near each other: a grid over the box that holds all but the outermost, its cells as wide as most
//! spheres need. What lies outside belongs to the border's cells; the few largest spheres look into all cells they cover.

use glam::DVec3;

/// Share of the spheres that are called large at most.
const LARGE: f64 = 0.02;

/// Share of the spheres, at either end of each axis, that may lie outside the grid.
const OUTSIDE: f64 = 0.02;

/// Up to this many spheres every pair is looked at.
const FEW: usize = 24;

/// Spheres sorted into cells.
#[derive(Debug, Clone, Default)]
pub(super) struct Crowd {
    /// Lowest corner of the grid, m.
    low: DVec3,
    /// Cells per metre, by axis.
    per_metre: DVec3,
    counts: [usize; 3],
    /// Where each cell's spheres begin in `members`.
    begins: Vec<u32>,
    /// The spheres that are not large, cell by cell.
    members: Vec<u32>,
    cells: Vec<u32>,
    /// The large spheres.
    large: Vec<usize>,
    /// Radius of the largest sphere that is not large, m.
    small: f64,
    sorted: Vec<f64>,
}

impl Crowd {
    /// A crowd of spheres with these radii, m.
    pub(super) fn new(radii: &[f64]) -> Crowd {
        let mut sorted = radii.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        let place = ((sorted.len() as f64 * (1.0 - LARGE)) as usize).min(sorted.len().saturating_sub(1));
        let small = sorted.get(place).copied().unwrap_or(0.0);
        let large = (0..radii.len()).filter(|&i| radii[i] > small).collect();
        Crowd { large, small, sorted, ..Crowd::default() }
    }

    /// Calls `meet` once for every pair a < b whose gap may be at most `margin` times r_a + r_b.
    pub(super) fn pairs(&mut self, x: &[DVec3], radii: &[f64], margin: f64, mut meet: impl FnMut(usize, usize)) {
        if x.len() <= FEW {
            (0..x.len()).for_each(|a| (a + 1..x.len()).for_each(|b| meet(a, b)));
            return;
        }
        self.sort(x, radii);
        let grown = 1.0 + margin;
        for i in 0..x.len() {
            let is_large = radii[i] > self.small;
            let reach = DVec3::splat((radii[i] + self.small) * grown);
            let (from, to) = (self.cell(x[i] - reach), self.cell(x[i] + reach));
            for cx in from[0]..=to[0] {
                for cy in from[1]..=to[1] {
                    let first = self.index([cx, cy, from[2]]);
                    let last = self.index([cx, cy, to[2]]);
                    for &j in &self.members[self.begins[first] as usize..self.begins[last + 1] as usize] {
                        let j = j as usize;
                        if is_large || j > i {
                            meet(i.min(j), i.max(j));
                        }
                    }
                }
            }
        }
        for (k, &a) in self.large.iter().enumerate() {
            self.large[k + 1..].iter().for_each(|&b| meet(a, b));
        }
    }

    /// Lays out the grid and sorts all spheres that are not large into it.
    fn sort(&mut self, x: &[DVec3], radii: &[f64]) {
        let side = (1..x.len()).find(|side| side * side * side >= x.len()).unwrap_or(1) as f64;
        let (mut low, mut per_metre) = (DVec3::ZERO, DVec3::ZERO);
        for axis in 0..3 {
            self.sorted.clear();
            self.sorted.extend(x.iter().map(|x| x[axis]));
            let outside = (x.len() as f64 * OUTSIDE) as usize;
            let last = x.len() - 1 - outside;
            let first = *self.sorted.select_nth_unstable_by(outside, f64::total_cmp).1;
            let end = *self.sorted.select_nth_unstable_by(last, f64::total_cmp).1;
            let width = ((end - first) / side).max(2.0 * self.small).max(f64::MIN_POSITIVE);
            self.counts[axis] = (((end - first) / width) as usize).min(side as usize) + 1;
            (low[axis], per_metre[axis]) = (first, 1.0 / width);
        }
        (self.low, self.per_metre) = (low, per_metre);
        self.cells.clear();
        for x in x {
            let cell = self.index(self.cell(*x)) as u32;
            self.cells.push(cell);
        }
        self.begins.clear();
        self.begins.resize(self.counts.iter().product::<usize>() + 1, 0);
        let smalls = || (0..x.len()).filter(|&i| radii[i] <= self.small);
        for i in smalls() {
            self.begins[self.cells[i] as usize + 1] += 1;
        }
        (1..self.begins.len()).for_each(|c| self.begins[c] += self.begins[c - 1]);
        let mut next = self.begins.clone();
        self.members.clear();
        self.members.resize(x.len(), 0);
        for i in smalls() {
            let place = &mut next[self.cells[i] as usize];
            self.members[*place as usize] = i as u32;
            *place += 1;
        }
    }

    fn cell(&self, p: DVec3) -> [usize; 3] {
        let place = (p - self.low) * self.per_metre;
        // a conversion to integers ends at 0 and at the largest
        [0, 1, 2].map(|axis| (place[axis] as usize).min(self.counts[axis] - 1))
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (x * self.counts[1] + y) * self.counts[2] + z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix64;

    #[test]
    fn every_pair_that_touches_is_met_once() {
        let mut draw = SplitMix64::new(1);
        let mut unit = || draw.unit();
        // dust, a few giants, and one sphere far away
        let mut x: Vec<DVec3> = (0..400).map(|_| DVec3::new(unit(), unit(), unit())).collect();
        x[17] = DVec3::new(1e6, -1e6, 3.0);
        let radii: Vec<f64> = (0..400).map(|i| if i % 97 == 0 { 0.3 } else { 0.01 + 0.03 * unit() }).collect();
        let touch = |a: usize, b: usize| (x[a] - x[b]).length() <= radii[a] + radii[b];
        let mut met = Vec::new();
        Crowd::new(&radii).pairs(&x, &radii, 1e-9, |a, b| {
            if touch(a, b) {
                met.push((a, b));
            }
        });
        met.sort_unstable();
        let all = (0..400).flat_map(|a| (a + 1..400).map(move |b| (a, b))).filter(|&(a, b)| touch(a, b));
        assert_eq!(met, all.collect::<Vec<_>>());
        assert!(met.len() > 200, "{}", met.len());
    }
}
