//! Which bodies are near each other: boxes halved again and again until few are left, whatever their sizes. A grid
//! would need one cell size for a dust grain and a planet.

use crate::geometry::Bounds;

/// So few boxes are compared each with each.
const FEW: usize = 32;

/// The first two bodies (by the order of the search, the same on every machine) whose boxes touch and for which `hit`
/// says true. Costs about n log n for bodies that do not overlap.
pub(super) fn first_hit(boxes: &[Bounds], hit: &impl Fn(usize, usize) -> bool) -> Option<(usize, usize)> {
    search(boxes, (0..boxes.len() as u32).collect(), hit)
}

fn search(boxes: &[Bounds], bodies: Vec<u32>, hit: &impl Fn(usize, usize) -> bool) -> Option<(usize, usize)> {
    if bodies.len() > FEW {
        for axis in widest_axes(boxes, &bodies) {
            if let Some((low, high)) = halves(boxes, &bodies, axis) {
                drop(bodies);
                return search(boxes, low, hit).or_else(|| search(boxes, high, hit));
            }
        }
    }
    let pairs =
        bodies.iter().enumerate().flat_map(|(i, &a)| bodies[i + 1..].iter().map(move |&b| (a.min(b), a.max(b))));
    pairs.map(|(a, b)| (a as usize, b as usize)).find(|&(a, b)| boxes[a].touches(&boxes[b]) && hit(a, b))
}

/// The axes, by how far the centres spread along them.
fn widest_axes(boxes: &[Bounds], bodies: &[u32]) -> [usize; 3] {
    let center = |&body: &u32| boxes[body as usize].center();
    let spread = Bounds::of(bodies.iter().map(|body| Bounds { min: center(body), max: center(body) }))
        .map_or(glam::DVec3::ZERO, |bounds| bounds.size());
    let mut axes = [0, 1, 2];
    axes.sort_by(|&a, &b| spread[b].total_cmp(&spread[a]));
    axes
}

/// The bodies on either side of the median centre, those across it on both; none if that helps little, because most
/// boxes lie across.
fn halves(boxes: &[Bounds], bodies: &[u32], axis: usize) -> Option<(Vec<u32>, Vec<u32>)> {
    let mut centers: Vec<f64> = bodies.iter().map(|&body| boxes[body as usize].center()[axis]).collect();
    let middle = centers.len() / 2;
    let plane = *centers.select_nth_unstable_by(middle, f64::total_cmp).1;
    let side = |keep: &dyn Fn(&Bounds) -> bool| -> Vec<u32> {
        bodies.iter().copied().filter(|&body| keep(&boxes[body as usize])).collect()
    };
    let low = side(&|bounds| bounds.min[axis] <= plane);
    let high = side(&|bounds| bounds.max[axis] >= plane);
    let helps = low.len() + high.len() <= bodies.len() * 8 / 5 && low.len().max(high.len()) <= bodies.len() * 19 / 20;
    helps.then_some((low, high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn cubes(n: usize) -> Vec<Bounds> {
        let at = |i: usize| DVec3::new((i % n) as f64, (i / n % n) as f64, (i / n / n) as f64);
        (0..n * n * n).map(|i| Bounds::around(at(i), 0.4)).collect()
    }

    #[test]
    fn every_touching_pair_is_offered() {
        let mut boxes = cubes(7);
        boxes.push(Bounds { min: DVec3::new(2.0, -1.0, 2.0), max: DVec3::new(2.1, 9.0, 3.1) });
        let offered = std::cell::RefCell::new(std::collections::BTreeSet::new());
        first_hit(&boxes, &|a, b| {
            offered.borrow_mut().insert((a, b));
            false
        });
        let all = (0..boxes.len()).flat_map(|a| (a + 1..boxes.len()).map(move |b| (a, b)));
        let expected: std::collections::BTreeSet<_> = all.filter(|&(a, b)| boxes[a].touches(&boxes[b])).collect();
        assert_eq!(offered.into_inner(), expected);
        assert_eq!(expected.len(), 14, "two columns of seven");
    }
}
