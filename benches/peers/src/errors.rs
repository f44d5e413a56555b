//! What a run got wrong. Measured in a run of its own, looked at after every frame, so that it costs the timing nothing.

use carom::physics::Scene;
use glam::DVec3;

use crate::cases::Case;
use crate::engine::Entrant;
use crate::overlap::Overlap;

/// Means are over the ends of all frames.
#[derive(Debug, Clone, Copy)]
pub struct Errors {
    /// Mean of (E − E₀)², J².
    pub squared_energy: f64,
    /// E/E₀ − 1 at the end.
    pub drift: f64,
    /// Mean of Σ overlap² over pairs and walls, m².
    pub squared_overlap: f64,
    /// Deepest overlap, m.
    pub deepest: f64,
    /// Impacts in a simulated second, where the engine counts them.
    pub impact_rate: Option<f64>,
}

/// The errors of one entrant.
pub fn of(case: &Case, entrant: &Entrant) -> Errors {
    let scene = &case.scene;
    let initial = energy(scene, &places(scene, |sphere| sphere.x), &places(scene, |sphere| sphere.v));
    let mut run = entrant.begin(scene);
    let (mut squared_energy, mut squared_overlap, mut deepest, mut last) = (0.0, 0.0, 0.0_f64, initial);
    for t in case.times(entrant) {
        run.advance(t);
        let (x, v) = run.state(t);
        assert!(x.iter().chain(&v).all(|p| p.is_finite()), "{} left the numbers", entrant.settings());
        last = energy(scene, &x, &v);
        squared_energy += (last - initial) * (last - initial);
        let overlap = Overlap::of(scene, &x);
        squared_overlap += overlap.squares;
        deepest = deepest.max(overlap.deepest);
    }
    let frames = case.times(entrant).count();
    Errors {
        squared_energy: squared_energy / frames as f64,
        drift: last / initial - 1.0,
        squared_overlap: squared_overlap / frames as f64,
        deepest,
        impact_rate: run.impacts().map(|impacts| impacts as f64 / case.until),
    }
}

fn places(scene: &Scene, of: impl Fn(&carom::scene::Sphere) -> DVec3) -> Vec<DVec3> {
    scene.spheres.iter().map(of).collect()
}

/// Σ ½ m v² − m g·x, J.
fn energy(scene: &Scene, x: &[DVec3], v: &[DVec3]) -> f64 {
    let of = |(sphere, (x, v)): (&carom::scene::Sphere, (&DVec3, &DVec3))| {
        sphere.mass * (0.5 * v.length_squared() - scene.gravity.dot(*x))
    };
    scene.spheres.iter().zip(x.iter().zip(v)).map(of).sum()
}
