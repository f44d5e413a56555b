//! Sums that lose nothing.

use glam::DVec3;

/// A sum of vectors that loses nothing: Neumaier's.
#[derive(Default)]
pub(crate) struct Sum {
    total: DVec3,
    rest: DVec3,
}

impl Sum {
    /// One more term.
    pub(crate) fn add(&mut self, term: DVec3) {
        for axis in 0..3 {
            let (total, term) = (self.total[axis], term[axis]);
            let next = total + term;
            self.rest[axis] += if total.abs() >= term.abs() { total - next + term } else { term - next + total };
            self.total[axis] = next;
        }
    }

    /// What they come to.
    pub(crate) fn value(&self) -> DVec3 {
        self.total + self.rest
    }
}
