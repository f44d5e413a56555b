//! Counted work that wears out the cells: after enough of it they are reviewed.

/// Crossings per sphere after which the records are reordered: they have gone some cells from their neighbours in memory by
/// then.
const CROSSINGS: u64 = 3;

/// Looks at a pair per sphere after which it is asked whether smaller cells would spare some.
const PAIRS: u64 = 256;

/// Work since the last review.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wear {
    crossings: u64,
    /// Looks at a pair since it was last asked whether there are too many.
    pub(crate) pairs: u64,
    /// Looks around that were not for a crossing.
    pub(crate) looks: u64,
    /// Time of the last review, s.
    pub(crate) since: f64,
    /// Crossings and pairs from which on the cells are reviewed.
    most: [u64; 2],
}

impl Wear {
    /// No wear, of cells of `spheres` spheres at time `t`, s.
    pub(crate) fn new(spheres: usize, t: f64) -> Wear {
        Wear { crossings: 0, pairs: 0, looks: 0, since: t, most: [CROSSINGS, PAIRS].map(|each| each * spheres as u64) }
    }

    /// Counts a sphere that crossed into a cell and looked at `pairs` pairs.
    #[inline(always)]
    pub(crate) fn cross(&mut self, pairs: u64) {
        self.crossings += 1;
        self.pairs += pairs;
    }

    /// Counts a sphere that looked around, at `pairs` pairs.
    #[inline(always)]
    pub(crate) fn look(&mut self, pairs: u64) {
        self.looks += 1;
        self.pairs += pairs;
    }

    /// Whether it is time for a review.
    #[inline(always)]
    pub(crate) fn is_worn(&self) -> bool {
        self.has_many_crossings() | (self.pairs > self.most[1])
    }

    /// Whether the spheres have gone so far from their neighbours in memory that they should be reordered.
    #[inline(always)]
    pub(crate) fn has_many_crossings(&self) -> bool {
        self.crossings > self.most[0]
    }
}
