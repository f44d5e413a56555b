//! Which spheres are near a body: a tree of boxes, halved again and again until few spheres are left, whatever their
//! sizes. A grid would need one cell size for a dust grain and a planet.

use crate::geometry::Bounds;

/// Most boxes of a leaf, which are looked at one by one.
const FEW: usize = 8;

/// A box of the tree, and the spheres in it: `order[from..to]`.
#[derive(Debug)]
struct Node {
    bounds: Bounds,
    from: usize,
    to: usize,
    /// Index of the node of the upper half; that of the lower half is the next node. None: a leaf.
    upper: Option<usize>,
}

/// A tree of boxes, found by place.
#[derive(Debug)]
pub(super) struct Tree<'a> {
    boxes: &'a [Bounds],
    order: Vec<u32>,
    nodes: Vec<Node>,
}

impl<'a> Tree<'a> {
    /// The tree of these boxes, in a time of about n log n.
    pub(super) fn new(boxes: &'a [Bounds]) -> Tree<'a> {
        let mut tree = Tree { boxes, order: (0..boxes.len() as u32).collect(), nodes: Vec::new() };
        if !boxes.is_empty() {
            tree.grow(0, boxes.len());
        }
        tree
    }

    /// Appends the node of `order[from..to]` and those below it. Halves have as many boxes, so the tree is shallow.
    fn grow(&mut self, from: usize, to: usize) {
        let boxes = self.boxes;
        let of = |order: &[u32], part: fn(&Bounds) -> Bounds| {
            Bounds::of(order.iter().map(|&body| part(&boxes[body as usize])))
                .unwrap_or(Bounds { min: glam::DVec3::ZERO, max: glam::DVec3::ZERO })
        };
        let index = self.nodes.len();
        let bounds = of(&self.order[from..to], |bounds| *bounds);
        self.nodes.push(Node { bounds, from, to, upper: None });
        if to - from <= FEW {
            return;
        }
        let centers = of(&self.order[from..to], |bounds| Bounds { min: bounds.center(), max: bounds.center() });
        let axis = (0..3).fold(0, |best, axis| if centers.size()[axis] > centers.size()[best] { axis } else { best });
        let middle = (to - from) / 2;
        let center = |body: u32| boxes[body as usize].center()[axis];
        self.order[from..to].select_nth_unstable_by(middle, |&a, &b| center(a).total_cmp(&center(b)).then(a.cmp(&b)));
        self.grow(from, from + middle);
        self.nodes[index].upper = Some(self.nodes.len());
        self.grow(from + middle, to);
    }

    /// The sphere of lowest index that `hit`s, among those whose boxes `touches` says yes to. It must say yes to every
    /// box that holds such a box.
    pub(super) fn first(&self, touches: impl Fn(&Bounds) -> bool, hit: impl Fn(usize) -> bool) -> Option<usize> {
        let mut found: Option<usize> = None;
        let mut open = Vec::from_iter((!self.nodes.is_empty()).then_some(0));
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            if !touches(&node.bounds) {
                continue;
            }
            if let Some(upper) = node.upper {
                open.extend([upper, index + 1]);
                continue;
            }
            let near = self.order[node.from..node.to].iter().map(|&body| body as usize);
            let hits = near.filter(|&body| touches(&self.boxes[body]) && hit(body)).min();
            found = [found, hits].into_iter().flatten().min();
        }
        found
    }
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
    fn every_touching_box_is_offered_and_the_first_is_found() {
        let mut boxes = cubes(7);
        boxes.push(Bounds { min: DVec3::new(2.0, -1.0, 2.0), max: DVec3::new(2.1, 9.0, 3.1) });
        boxes.push(Bounds::around(DVec3::splat(3.0), 9.0));
        let tree = Tree::new(&boxes);
        for body in &boxes {
            let offered = std::cell::RefCell::new(Vec::new());
            let found = tree.first(
                |bounds| bounds.touches(body),
                |near| {
                    offered.borrow_mut().push(near);
                    near % 5 == 3
                },
            );
            let mut offered = offered.into_inner();
            offered.sort_unstable();
            let expected: Vec<usize> = (0..boxes.len()).filter(|&near| boxes[near].touches(body)).collect();
            assert_eq!(offered, expected, "{body:?}");
            assert_eq!(found, expected.into_iter().find(|near| near % 5 == 3));
        }
    }

    #[test]
    fn a_search_costs_no_more_than_the_depth_of_the_tree_and_what_is_there() {
        let boxes = cubes(30);
        let (tree, asked) = (Tree::new(&boxes), std::cell::Cell::new(0));
        for body in &boxes {
            let touches = |bounds: &Bounds| {
                asked.set(asked.get() + 1);
                bounds.touches(body)
            };
            assert!(tree.first(touches, |_| false).is_none());
        }
        // 27 000 searches down 12 levels, both halves looked at in each, and one leaf of 8 or a neighbouring one.
        assert!(asked.get() < 27_000 * 80, "{}", asked.get());
    }

    #[test]
    fn nothing_is_near_nothing() {
        assert_eq!(Tree::new(&[]).first(|_| true, |_| true), None);
    }
}
