//! How deep spheres stand in walls and in each other, judged from positions alone: for both engines the same.

use carom::physics::Scene;
use glam::DVec3;

/// Overlaps of one moment.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Overlap {
    /// Σ overlap² over pairs and walls, m².
    pub squares: f64,
    /// The deepest, m.
    pub deepest: f64,
}

impl Overlap {
    /// What overlaps when the spheres of the scene have their centres here, m.
    pub fn of(scene: &Scene, x: &[DVec3]) -> Overlap {
        let mut overlap = Overlap::default();
        overlap.add_walls(scene, x);
        overlap.add_pairs(scene, x);
        overlap
    }

    fn add(&mut self, depth: f64) {
        if depth > 0.0 {
            self.squares += depth * depth;
            self.deepest = self.deepest.max(depth);
        }
    }

    /// Walls count as planes with the side where the spheres began: one that has passed through is deep, not free.
    fn add_walls(&mut self, scene: &Scene, x: &[DVec3]) {
        for wall in &scene.walls {
            let inward = wall.shape.normal() * wall.shape.plane_distance(scene.spheres[0].x).signum();
            for (sphere, x) in scene.spheres.iter().zip(x) {
                self.add(sphere.radius - (*x - wall.shape.center).dot(inward));
            }
        }
    }

    /// Pairs whose shadows on the x axis overlap, found by sorting.
    fn add_pairs(&mut self, scene: &Scene, x: &[DVec3]) {
        let spheres = &scene.spheres;
        let widest = spheres.iter().map(|sphere| sphere.radius).fold(0.0, f64::max);
        let mut order: Vec<usize> = (0..x.len()).collect();
        order.sort_by(|i, j| x[*i].x.total_cmp(&x[*j].x));
        for (rank, &i) in order.iter().enumerate() {
            let reach = x[i].x + spheres[i].radius + widest;
            for &j in order[rank + 1..].iter().take_while(|j| x[**j].x < reach) {
                let sum = spheres[i].radius + spheres[j].radius;
                if x[i].distance_squared(x[j]) < sum * sum {
                    self.add(sum - x[i].distance(x[j]));
                }
            }
        }
    }
}
