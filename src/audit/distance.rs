//! How far a point is from a wall: the nearest of its foot on the face, if that lies inside, and of the points of the four
//! edges, each a segment with its ends. The foot comes from an orthonormal basis of the plane, found by Gram and Schmidt.

use glam::DVec3;

use crate::physics::Model;
use crate::physics::wall::Face;

/// A wall as the judge measures it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Board {
    /// First corner, m.
    corner: DVec3,
    /// First edge, m.
    s1: DVec3,
    /// Second edge, m.
    s2: DVec3,
    /// Orthonormal vectors in the plane, the first along `s1`.
    basis: [DVec3; 2],
    /// Length of `s1`, m.
    length: f64,
    /// Height of the parallelogram over `s1`, m.
    height: f64,
    /// How far `s2` leans along `s1`, m.
    lean: f64,
    /// Unit normal.
    pub(super) normal: DVec3,
}

/// All walls of a model.
pub(super) fn boards(model: &Model) -> Vec<Board> {
    model.faces.iter().map(Board::of).collect()
}

impl Board {
    /// The board of a wall, from its centre and edges; nothing else of it is read.
    pub(super) fn of(face: &Face) -> Board {
        Board::new(face.shape.center, face.shape.s1, face.shape.s2)
    }

    fn new(center: DVec3, s1: DVec3, s2: DVec3) -> Board {
        let length = s1.length();
        let along = s1 / length;
        let lean = along.dot(s2);
        let mut across = s2 - along * lean;
        across -= along * along.dot(across); // once more: for a thin wall the first time leaves rounding
        let height = across.length();
        let across = across / height;
        let corner = center - (s1 + s2) * 0.5;
        Board { corner, s1, s2, basis: [along, across], length, height, lean, normal: along.cross(across) }
    }

    /// The way from the wall's first corner to `p`, m.
    fn arm(&self, p: DVec3) -> DVec3 {
        p - self.corner
    }

    /// Signed distance of `p` (m) from the plane, m.
    pub(super) fn level(&self, p: DVec3) -> f64 {
        self.normal.dot(self.arm(p))
    }

    /// Shares of `s1` and `s2` of the foot of `p` (m): inside if both are in [0, 1].
    pub(super) fn shares(&self, p: DVec3) -> [f64; 2] {
        let arm = self.arm(p);
        let second = self.basis[1].dot(arm) / self.height;
        [(self.basis[0].dot(arm) - second * self.lean) / self.length, second]
    }

    /// The way from the closest point of the wall to `p` (m), m.
    pub(super) fn offset(&self, p: DVec3) -> DVec3 {
        let [first, second] = self.shares(p);
        let inside = |share: f64| (0.0..=1.0).contains(&share);
        if inside(first) && inside(second) {
            // no edge is nearer; one beside the foot is as far, to rounding, from up to 1e-8 of the distance aside
            return (0..2)
                .fold(self.arm(p), |offset, _| self.basis.iter().fold(offset, |rest, e| rest - *e * e.dot(rest)));
        }
        let mut nearest = DVec3::INFINITY;
        let edges = [
            (DVec3::ZERO, self.s1, second < 0.0),
            (DVec3::ZERO, self.s2, first < 0.0),
            (self.s2, self.s1, second > 1.0),
            (self.s1, self.s2, first > 1.0),
        ];
        for (from, along, is_beyond) in edges {
            let arm = self.arm(p) - from;
            let share = arm.dot(along) / along.dot(along);
            let offset = arm - along * share.clamp(0.0, 1.0);
            if is_beyond && inside(share) {
                // no corner is nearer; one beside the foot is as far, to rounding, from up to 1e-8 of the distance aside
                return offset;
            }
            if offset.length_squared() < nearest.length_squared() {
                nearest = offset;
            }
        }
        nearest
    }

    /// What rounding of a distance from this wall to `p` (m) is relative to, m: coordinates, and the way to its corner.
    pub(super) fn size(&self, p: DVec3) -> f64 {
        p.abs().max_element() + self.arm(p).abs().max_element()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    /// The point of a face is told from that of an edge beside it where their distances differ by less than rounding.
    #[test]
    fn beside_an_edge_the_foot_on_the_face_counts() {
        let board = Board::new(dvec3(0.3, -0.2, 0.1), dvec3(2.0, 0.4, 0.0), dvec3(0.7, 0.5, 1.0));
        for k in 0..1000 {
            let (along, inside) = ((f64::from(k) + 0.5) / 1000.0, f64::from(k % 17) * 1e-9 + 1e-10);
            let foot = board.corner + board.s1 * along + board.s2 * inside;
            let offset = board.offset(foot + board.normal * 0.3);
            assert!((offset - board.normal * 0.3).length() < 1e-14, "{along} {inside}: {offset}");
        }
    }

    /// The point of an edge is told from a corner beside it, and from that of the other edge there, where their distances
    /// differ by less than rounding.
    #[test]
    fn beside_a_corner_the_foot_on_the_edge_beyond_which_it_is_counts() {
        for s2 in [dvec3(0.0, 0.0, 1.0), dvec3(1.5, 0.0, 1.0), dvec3(-1.5, 0.0, 1.0)] {
            let board = Board::new(dvec3(0.0, 0.0, 0.0), dvec3(2.0, 0.0, 0.0), s2);
            for (inside, beyond) in [(2.7e-9, 1e-9), (1e-12, 4e-9), (4e-9, 1e-12), (1e-9, 0.2)] {
                let away = dvec3(0.0, 0.4, -beyond);
                for foot in [board.corner + dvec3(inside, 0.0, 0.0), board.corner + board.s1 - dvec3(inside, 0.0, 0.0)]
                {
                    let offset = board.offset(foot + away);
                    assert!((offset - away).length() < 1e-15, "{s2} {inside} {beyond}: {offset}");
                }
            }
        }
    }

    /// The least distance over a fine grid of the wall's points: never less than the true one, and close to it.
    #[test]
    fn no_point_of_the_wall_is_nearer_than_the_closest_one() {
        let (center, s1, s2) = (dvec3(0.3, -0.2, 0.1), dvec3(2.0, 0.4, 0.0), dvec3(0.7, 0.5, 1.0));
        let board = Board::new(center, s1, s2);
        for k in 0..343 {
            let p = dvec3(f64::from(k % 7), f64::from(k / 7 % 7), f64::from(k / 49)) - dvec3(3.0, 3.0, 3.0);
            let point = |i: i32, j: i32| center + s1 * (f64::from(i) / 200.0 - 0.5) + s2 * (f64::from(j) / 200.0 - 0.5);
            let grid = (0..=200).flat_map(|i| (0..=200).map(move |j| (i, j)));
            let least = grid.map(|(i, j)| (p - point(i, j)).length()).fold(f64::INFINITY, f64::min);
            let found = board.offset(p).length();
            // Neighbouring points of the grid are 0.02 m apart: the nearest one is 0.02 m off at most.
            assert!(found <= least + 1e-12 && found >= least - 0.02, "{p}: {found}, {least}");
        }
    }
}
