//! Which walls are near which cubes.

use glam::DVec3;

use super::{Cells, ENTRIES, OUTERMOST, WALLS};
use crate::physics::events::record::CellCoordinates;
use crate::physics::model::Model;
use crate::physics::wall::Face;

/// Widening of walls that leaves room for the rounding of coordinates, dimensionless.
const MARGIN: f64 = 1.0 + 1e-6;

/// Notes of a wall near a place that there may be, 8 bytes each: a quarter of a gigabyte. A hundred shelves through a
/// million spheres need some millions; a thousand walls on each other, over a lattice of a million, would need ten times as
/// many.
const MOST_NOTES: usize = 1 << 25;

/// The cubes from one corner to the other, and where among them a wall's plane is.
struct Slab<'a> {
    face: &'a Face,
    low: CellCoordinates,
    high: CellCoordinates,
    /// The axis along which the plane is crossed most steeply.
    steep: usize,
    /// How far from the plane (m) the middle of a cube near it may be.
    half: f64,
}

impl Cells {
    /// Lists each wall in every place whose cubes a sphere of the table touches it from; where that would be too many
    /// notes, all walls are near everywhere.
    pub(crate) fn register(&mut self, model: &Model) {
        self.register_within(model, MOST_NOTES);
    }

    fn register_within(&mut self, model: &Model, most: usize) {
        let reach = self.widest * MARGIN;
        let mut near: Vec<(u32, u32)> = Vec::new();
        for (wall, face) in model.faces.iter().enumerate() {
            let bounds = face.shape.bounds().grown(reach);
            let n = face.normal.abs();
            let slab = Slab {
                face,
                low: self.coordinates_of(bounds.min),
                high: self.coordinates_of(bounds.max),
                steep: (0..3).fold(0, |best, axis| if n[axis] > n[best] { axis } else { best }),
                // half the cube's extent along the wall's normal, and what a sphere adds
                half: 0.5 * self.edge * (n.x + n.y + n.z) * MARGIN + reach,
            };
            self.places_near(&slab, |place| near.push((place, wall as u32)));
            if near.len() > most {
                return self.register_everywhere(model.faces.len());
            }
        }
        near.sort_unstable();
        near.dedup();
        self.starts = vec![0; self.table.len() + 1];
        for &(place, _) in &near {
            self.starts[place as usize + 1] += 1;
        }
        for place in 0..self.table.len() {
            self.starts[place + 1] += self.starts[place];
        }
        for &(place, _) in &near {
            self.table[place as usize].0[ENTRIES] |= WALLS;
        }
        self.walls = near.into_iter().map(|(_, wall)| wall).collect();
    }

    fn register_everywhere(&mut self, walls: usize) {
        self.starts = Vec::new();
        self.walls = (0..walls as u32).collect();
        self.table.iter_mut().for_each(|place| place.0[ENTRIES] |= WALLS);
    }

    /// Calls `found` with every place near a wall, column by column along the steep axis, so that a slanted wall costs what
    /// it covers and not its whole box.
    fn places_near(&self, slab: &Slab, mut found: impl FnMut(u32)) {
        let Slab { low, high, steep, .. } = *slab;
        // where the table is folded or the outermost cubes reach to infinity, a number stands for many cubes, and the
        // distance from the plane tells nothing
        let vague = |axis: usize| {
            i64::from(high[axis]) - i64::from(low[axis]) >= i64::from(self.size[axis]) - 1
                || low[axis] == -OUTERMOST
                || high[axis] == OUTERMOST
        };
        let range = |axis: usize, low: i32, high: i32| {
            let all = i64::from(high) - i64::from(low) >= i64::from(self.size[axis]) - 1;
            if all { 0..=self.size[axis] - 1 } else { low..=high }
        };
        let (one, two) = ((steep + 1) % 3, (steep + 2) % 3);
        let whole = vague(one) || vague(two) || low[steep] == -OUTERMOST || high[steep] == OUTERMOST;
        let mut cube = [0; 3];
        for u in range(one, low[one], high[one]) {
            for w in range(two, low[two], high[two]) {
                (cube[one], cube[two]) = (u, w);
                let (from, to) = if whole { (low[steep], high[steep]) } else { self.column(slab, cube) };
                for s in range(steep, from, to) {
                    cube[steep] = s;
                    found(self.index_of(cube));
                }
            }
        }
    }

    /// The first and the last cube of a column that are near a wall's plane, within the wall's box.
    fn column(&self, slab: &Slab, mut cube: CellCoordinates) -> (i32, i32) {
        let Slab { face, low, high, steep, half } = *slab;
        cube[steep] = low[steep];
        let middle = DVec3::from_array(cube.map(|k| f64::from(k) + 0.5));
        let height = face.height(self.origin + middle * self.edge);
        let step = face.normal[steep] * self.edge;
        let (a, b) = ((-half - height) / step, (half - height) / step);
        // a cube more on either side than the division says
        let (from, to) = (a.min(b).floor() - 1.0, a.max(b).ceil() + 1.0);
        let last = f64::from(high[steep]) - f64::from(low[steep]);
        (low[steep] + from.clamp(0.0, last + 1.0) as i32, low[steep] + to.clamp(-1.0, last) as i32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::events::schedule::cells::Layout;

    #[test]
    fn where_notes_of_walls_would_be_too_many_all_walls_are_near_everywhere() {
        // a floor of 30 × 30 spheres, and ten walls above it, a hair apart
        let wall =
            |i: u32| format!("Wall(center: (50, 50, {}), s1: (100, 0, 0), s2: (0, 100, 0))", 1.5 + f64::from(i) * 1e-6);
        let walls: Vec<String> = (0..10).map(wall).collect();
        let spheres = "Lattice(origin: (1, 1, 1), counts: (30, 30, 1), spacing: 3, mass: 1, radius: 0.3)";
        let text = format!("Scene(walls: [{}], spheres: [{spheres}])", walls.join(", "));
        let model = Model::new(&crate::scene::parse(&text, "floor").expect("a valid scene"));
        let mut cells = Cells::new(&model, Layout::new(&model.initial.x, 0.3));
        let noted = cells.walls.len();
        assert!(noted > 1000, "{noted} notes");
        let near = |cells: &Cells| {
            let of = |&x| cells.walls_near(cells.cell_of(x)).to_vec();
            model.initial.x.iter().map(of).collect::<Vec<_>>()
        };
        let before = near(&cells);
        cells.register_within(&model, noted - 1);
        assert_eq!(cells.walls.len(), 10);
        for (all, few) in near(&cells).iter().zip(before) {
            assert!(few.iter().all(|wall| all.contains(wall)), "{few:?}");
        }
    }
}
