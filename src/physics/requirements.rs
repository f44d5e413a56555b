//! What a model holds and what it leaves out, in numbers and words.

/// How pairs that may touch are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PairSearch {
    /// Fewer than two spheres: there are no pairs.
    None,
    /// Few spheres: every pair.
    All,
    /// Many spheres: cells.
    Cells,
}

/// What a scene requires; whatever is zero, false or `None` here is absent from its model and costs nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Requirements {
    /// Number of spheres.
    pub spheres: usize,
    /// Whether gravity acts.
    pub gravity: bool,
    /// Number of spheres with a force of their own.
    pub forces: usize,
    /// Number of walls.
    pub walls: usize,
    /// Edges of walls that a sphere can reach: four per wall, none of a closed room's six walls.
    pub open_edges: usize,
    /// Number of pairs of spheres.
    pub pairs: u64,
    /// How pairs that may touch are found.
    pub search: PairSearch,
    /// Number of cells the spheres are sorted into.
    pub cells: usize,
}

impl Requirements {
    /// What the model holds, a phrase each.
    pub fn held(&self) -> Vec<String> {
        let mut held = vec![counted(self.spheres as u64, "sphere")];
        if self.gravity {
            held.push(String::from("gravity"));
        }
        if self.forces > 0 {
            held.push(format!("a force of its own for {}", counted(self.forces as u64, "sphere")));
        }
        if self.walls > 0 {
            held.push(counted(self.walls as u64, "wall"));
        }
        if self.open_edges > 0 {
            held.push(counted(self.open_edges as u64, "reachable edge"));
        }
        match self.search {
            PairSearch::None => {}
            PairSearch::All => held.push(counted(self.pairs, "pair")),
            PairSearch::Cells => held.push(format!("neighbour search in {}", counted(self.cells as u64, "cell"))),
        }
        held
    }

    /// What the model leaves out because the scene does not require it, a phrase each.
    pub fn left_out(&self) -> Vec<&'static str> {
        let mut out = Vec::new();
        let mut unless = |needed: bool, phrase| {
            if !needed {
                out.push(phrase);
            }
        };
        unless(self.gravity, "gravity");
        unless(self.forces > 0, "forces on single spheres");
        unless(self.walls > 0, "walls");
        unless(self.walls == 0 || self.open_edges == 4 * self.walls, "edges and corners of the closed room");
        unless(self.search != PairSearch::None, "pairs");
        unless(self.search == PairSearch::Cells, "neighbour search");
        out
    }
}

/// "1 wall", "6 walls".
fn counted(n: u64, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}
