//! How wide the cubes are, how many places the table has, and which spheres are too large for them.
//!
//! The widest pair in the table sets the least edge. Where spheres are sparse the edge is wider, so that there are about
//! two cubes a sphere whatever the radii: a crossing is cheap, but none is free. Where most of the spheres' box is empty,
//! because they crowd in a clump, a line or a slanted layer, the box says too little, and the spheres themselves are
//! counted. All follows from ratios: no unit of length enters.

use glam::DVec3;

use crate::geometry::Bounds;

/// Most other spheres in the cube of a sphere, on average, where a smaller cube can help.
const CROWDED: f64 = 2.0;

/// Cost of a crossing in looks at a pair, apart from those that it takes.
const CROSSING: f64 = 16.0;

/// Distance from the origin, in cubes, that is not near the outermost, which reach to infinity.
const FARTHEST: f64 = 1e7;

/// Edge of a cube over the least one: leaves room for the rounding of coordinates divided by it.
const MARGIN: f64 = 1.0 + 1e-6;

/// Where the spheres are that the table is for, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Layout {
    pub(crate) origin: DVec3,
    /// Edge of a cube, m.
    pub(crate) edge: f64,
    /// The table's size along each axis.
    pub(crate) size: [i32; 3],
    /// The largest radius in the table, m.
    pub(crate) widest: f64,
}

impl Layout {
    /// The layout for spheres at `x` (m) none of which has a larger radius than `widest`, m.
    pub(crate) fn new(x: &[DVec3], widest: f64) -> Layout {
        let room = bounds(x);
        let mut origin = room.min;
        let least = 2.0 * widest * MARGIN;
        let mut edge = sparse_edge(least, room.size(), x.len());
        while edge > least && crowding(x, origin, edge) > CROWDED {
            edge = least.max(0.5 * edge);
            if room.size().max_element() > FARTHEST * edge {
                // cubes are counted from where most are
                origin = median(x);
            }
        }
        Layout { origin, edge, size: table(room.size() / edge, x.len()), widest }
    }

    /// Whether the cubes or the table differ so much from another's that it is worth changing them.
    pub(crate) fn differs(&self, other: &Layout) -> bool {
        let apart = |a: f64, b: f64, most: f64| a > most * b || b > most * a;
        apart(self.edge, other.edge, 1.3)
            || self.widest != other.widest
            || (0..3).any(|axis| apart(f64::from(self.size[axis]), f64::from(other.size[axis]), 1.7))
    }

    /// Whether spheres at `x` (m), in a box of this size (m), should have much wider or narrower cubes.
    pub(crate) fn is_outgrown(&self, x: &[DVec3], size: DVec3) -> bool {
        let edge = sparse_edge(2.0 * self.widest * MARGIN, size, x.len());
        self.edge > 1.5 * edge || edge > 1.5 * self.edge && crowding(x, self.origin, 1.5 * self.edge) <= CROWDED
    }
}

/// The box of some points, m.
pub(crate) fn bounds(x: &[DVec3]) -> Bounds {
    Bounds::of(x.iter().map(|&x| Bounds { min: x, max: x })).unwrap_or(Bounds { min: DVec3::ZERO, max: DVec3::ONE })
}

/// The largest radius (m) that the table should hold; those above it are few, and all look at them. `x` (m) is where the
/// spheres are.
///
/// Judged by what a contact costs: a look at each sphere around and at each one that is kept out, a crossing, and a look
/// at all spheres as often as one of those kept out is struck, which grows with its cross-section.
pub(crate) fn widest_in_table(x: &[DVec3], radii: &[f64]) -> f64 {
    let widest = radii.iter().copied().fold(0.0, f64::max);
    let least = radii.iter().copied().fold(f64::INFINITY, f64::min);
    if widest <= 1.5 * least {
        return widest;
    }
    let (size, count) = (bounds(x).size(), radii.len() as f64);
    let mut sorted = radii.to_vec();
    sorted.sort_unstable_by(|a, b| b.total_cmp(a));
    let typical = sorted[sorted.len() / 2];
    // radii relative to the typical one: their squares are numbers whatever the unit
    let section = |r: f64| (r / typical + 1.0) * (r / typical + 1.0);
    let all: f64 = sorted.iter().map(|&r| section(r)).sum();
    let sparse = sparse_edge(0.0, size, radii.len());
    let (mut best, mut cheapest) = (widest, f64::INFINITY);
    let (mut struck, mut next) = (0.0, 0);
    for (out, &r) in sorted.iter().enumerate() {
        if out == next {
            let cubes = cubes(size, sparse.max(2.0 * r));
            let cost = CROSSING + 27.0 * count / cubes + out as f64 + count * struck / all;
            if cost < cheapest {
                (best, cheapest) = (r, cost);
            }
            next = out + 1 + out / 2;
        }
        struck += section(r);
    }
    best
}

/// Number of cubes of a box.
fn cubes(size: DVec3, edge: f64) -> f64 {
    (size / edge + DVec3::ONE).to_array().iter().product()
}

/// Edge of a cube, m: the least, or wider where spheres are sparse, so that there are about two cubes a sphere.
fn sparse_edge(least: f64, size: DVec3, count: usize) -> f64 {
    let most = 2.0 * count as f64;
    // a row of more cubes than that is too many by itself
    let mut edge = least.max(size.max_element() / (most + 1.0));
    if edge == 0.0 {
        return 0.0;
    }
    while cubes(size, 2.0 * edge) > most {
        edge *= 2.0;
    }
    // small steps keep to operations that are the same everywhere
    while cubes(size, edge) > most {
        edge *= 1.0905;
    }
    edge
}

/// Other spheres in the cube of a sphere, on average over spheres at `x` (m). Cubes are counted in a folded table, which
/// adds less than one.
fn crowding(x: &[DVec3], origin: DVec3, edge: f64) -> f64 {
    let slots = (4 * x.len()).next_power_of_two();
    let mut counts = vec![0_u32; slots];
    let mut others = 0_u64;
    for x in x {
        let [x, y, z] = ((*x - origin) / edge).floor().to_array().map(|u| u as i64);
        // odd factors without a common pattern, so that lines and layers spread
        let mixed = x
            .wrapping_mul(0x9e37_79b9_7f4a_7c15_u64 as i64)
            .wrapping_add(y.wrapping_mul(0xc2b2_ae3d_27d4_eb4f_u64 as i64))
            .wrapping_add(z.wrapping_mul(0x1656_67b1_9e37_79f9));
        let count = &mut counts[(mixed as u64 >> 32) as usize % slots];
        others += 2 * u64::from(*count);
        *count += 1;
    }
    others as f64 / x.len().max(1) as f64
}

/// The median along each axis, m.
fn median(x: &[DVec3]) -> DVec3 {
    let along = |axis: usize| {
        let mut sorted: Vec<f64> = x.iter().map(|x| x[axis]).collect();
        let middle = sorted.len() / 2;
        *sorted.select_nth_unstable_by(middle, f64::total_cmp).1
    };
    DVec3::from_array([0, 1, 2].map(along))
}

/// The table's size along each axis: enough for the spheres' box, a cube more all around it and a border, no more than
/// some cubes a sphere. A table that is too small for the box is folded; sizes without a common factor then keep the
/// cubes of a slanted line or layer in different places.
fn table(cubes: DVec3, count: usize) -> [i32; 3] {
    let limit = (4 * count).max(8192) as f64;
    // a float beyond i32 becomes its end
    let mut size = cubes.to_array().map(|n| n.min(1e6) as i32 + 5);
    let mut folded = false;
    while size.iter().copied().map(f64::from).product::<f64>() > limit {
        let longest = (0..3).max_by_key(|&axis| size[axis]).expect("there are three axes");
        if size[longest] <= 4 {
            break;
        }
        folded = true;
        size[longest] = size[longest] / 2 + 1;
    }
    let mut size = size.map(|n| n.max(4));
    if folded {
        while common_factor(size[0], size[1]) > 1 {
            size[1] += 1;
        }
        while common_factor(size[0], size[2]) > 1 || common_factor(size[1], size[2]) > 1 {
            size[2] += 1;
        }
    }
    size
}

fn common_factor(a: i32, b: i32) -> i32 {
    if b == 0 { a } else { common_factor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    /// Points of a fixed Weyl sequence in a box of this size.
    fn cloud(n: usize, size: DVec3) -> Vec<DVec3> {
        let at = |k: usize, step: f64| (k as f64 * step).fract();
        let step = dvec3(0.819_172_513_396_164, 0.671_043_606_703_789, 0.549_700_477_901_970);
        (1..=n).map(|k| size * dvec3(at(k, step.x), at(k, step.y), at(k, step.z))).collect()
    }

    #[test]
    fn sparse_spheres_of_any_size_have_two_cubes_each_and_a_unit_changes_nothing() {
        for radius in [1e-300, 1e-12, 1e-6, 1e-3] {
            for unit in [1.0, 1024.0 * 1024.0, 1.0 / 1024.0] {
                let x: Vec<DVec3> = cloud(1000, DVec3::splat(unit));
                let layout = Layout::new(&x, radius * unit);
                let cubes = cubes(bounds(&x).size(), layout.edge);
                assert!((900.0..=2000.0).contains(&cubes), "{cubes} cubes at {radius:e}");
                let plain = Layout::new(&cloud(1000, DVec3::ONE), radius);
                assert_eq!((layout.edge / unit, layout.size), (plain.edge, plain.size), "powers of two are exact");
            }
        }
    }

    #[test]
    fn no_cube_is_narrower_than_the_widest_pair() {
        let layout = Layout::new(&cloud(1000, DVec3::ONE), 0.2);
        assert!(layout.edge >= 0.4);
    }

    #[test]
    fn a_line_a_layer_and_a_clump_are_spread_however_they_lie() {
        let flat = |x: DVec3| dvec3(x.x, x.y, 0.3 * x.x + 0.7 * x.y);
        let line = |x: DVec3| dvec3(x.x, x.x, x.x);
        let clump = |x: DVec3| if x.x < 0.01 { x * 1e6 } else { x };
        for shape in [flat, line, clump] {
            let x: Vec<DVec3> = cloud(5000, DVec3::ONE).into_iter().map(shape).collect();
            let layout = Layout::new(&x, 1e-9);
            assert!(crowding(&x, layout.origin, layout.edge) <= CROWDED);
            let mut places = std::collections::BTreeMap::new();
            for &x in &x {
                let cube = [0, 1, 2].map(|axis| {
                    (((x[axis] - layout.origin[axis]) / layout.edge).floor() as i64)
                        .rem_euclid(i64::from(layout.size[axis]))
                });
                *places.entry(cube).or_insert(0_u64) += 1;
            }
            let others = places.values().map(|n| n * (n - 1)).sum::<u64>() as f64 / x.len() as f64;
            assert!(others < 6.0, "{others} others share the place of a sphere");
        }
    }

    #[test]
    fn one_giant_is_kept_out_and_spheres_of_a_size_are_not() {
        let x = cloud(3000, DVec3::ONE);
        let mut radii = vec![1e-3; 3000];
        assert_eq!(widest_in_table(&x, &radii), 1e-3);
        radii[17] = 0.3;
        assert_eq!(widest_in_table(&x, &radii), 1e-3);
        radii.iter_mut().step_by(2).for_each(|r| *r = 2e-3);
        assert_eq!(widest_in_table(&x, &radii), 2e-3);
    }
}
