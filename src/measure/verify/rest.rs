//! Stacks at rest: nothing moves, and what holds each sphere up is what lies on it.

use glam::DVec3;

use super::bodies::{G, exact, floor, scene, sphere, wall};
use super::check::Check;
use super::runner::{Row, Runner, Trouble};
use crate::physics::State;
use crate::physics::support::{Bodies, Resting, Surface, hold};
use crate::scene::{ContactLaw, Scene, Sphere};

pub(super) const CHECK: Check = Check {
    title: "stacks at rest",
    source: "statics: nothing drifts, each contact of a column carries what lies on it, and the floor carries the \
             whole of a pyramid",
    allowed: "what rests is not integrated and must not drift by more than its places are rounded (64 ulp of 10 m); \
              forces are solved to rounding",
    measure,
};

/// Impacts lose half of the approach speed; slow ones rest.
const LAW: ContactLaw = ContactLaw { restitution: 0.5, wall_restitution: 0.5, tangential: 1.0, rest_speed: 0.1 };

/// Largest drift, m: 64 ulp of 10 m.
const DRIFT: f64 = 64.0 * 10.0 * f64::EPSILON;

/// Gap up to which bodies count as touching, m: far above rounding, far below every other gap.
const NEAR: f64 = 1e-9;

/// Forces, relative: factors of matrices of some sixty rows, all of numbers around 1.
const FORCE: f64 = 1e-12;

fn measure(runner: &Runner) -> Result<Vec<Row>, Trouble> {
    let (column, pyramid) = (column()?, pyramid()?);
    let until = runner.pick(20.0, 100.0);
    let column_end = runner.go(&mut exact(&column), until)?;
    let pyramid_end = runner.go(&mut exact(&pyramid), until)?;
    // Contacts in the order of the spheres, lowest first: the k-th carries all spheres from k on.
    let share = |(k, carried): (usize, Carried)| carried.force / (G * (column.spheres.len() - k) as f64);
    let shares = carried(&column, &column_end).into_iter().enumerate().map(share);
    let worst = shares.max_by(|a, b| (a - 1.0).abs().total_cmp(&(b - 1.0).abs())).unwrap_or(f64::NAN);
    let floor = carried(&pyramid, &pyramid_end).iter().filter(|on| on.wall).map(|on| on.force * on.normal.y).sum();
    Ok(vec![
        Row::new("column of 10, drift", "m", [0.0, drift(&column, &column_end)], DRIFT),
        Row::new("column of 10, force/load", "", [1.0, worst], FORCE),
        Row::new("pyramid of 30, drift", "m", [0.0, drift(&pyramid, &pyramid_end)], DRIFT),
        Row::new("pyramid of 30, on the floor", "N", [30.0 * G, floor], FORCE),
    ])
}

fn lying(x: DVec3) -> Sphere {
    sphere(x, DVec3::ZERO, 0.5)
}

fn column() -> Result<Scene, Trouble> {
    let spheres = (0..10).map(|k| lying(DVec3::Y * (0.5 + f64::from(k)))).collect();
    scene(DVec3::Y * -G, LAW, vec![floor()], spheres)
}

/// Square layers of 4 × 4, 3 × 3, 2 × 2 and 1 touching spheres, the lowest just between four walls.
fn pyramid() -> Result<Scene, Trouble> {
    let mut spheres = Vec::new();
    for layer in 0..4_u8 {
        let (side, height) = (4 - layer, f64::from(layer) * 0.5_f64.sqrt());
        let at = |k: u8| f64::from(k) - f64::from(side - 1) * 0.5;
        let places = (0..side).flat_map(|i| (0..side).map(move |j| (i, j)));
        spheres.extend(places.map(|(i, j)| lying(DVec3::new(at(i), 0.5 + height, at(j)))));
    }
    let side = |out: DVec3| wall(DVec3::Y + out * 2.0, DVec3::Y * 2.0, DVec3::new(out.z, 0.0, out.x) * 4.0);
    let walls = vec![floor(), side(DVec3::X), side(DVec3::NEG_X), side(DVec3::Z), side(DVec3::NEG_Z)];
    scene(DVec3::Y * -G, LAW, walls, spheres)
}

/// Farthest way of any sphere from where it began, m.
fn drift(scene: &Scene, end: &State) -> f64 {
    scene.spheres.iter().zip(&end.x).map(|(sphere, x)| sphere.x.distance(*x)).fold(0.0, f64::max)
}

/// The force in a contact.
struct Carried {
    wall: bool,
    normal: DVec3,
    /// Force, N.
    force: f64,
}

/// What each contact carries, sphere by sphere, walls before the spheres before it.
fn carried(scene: &Scene, state: &State) -> Vec<Carried> {
    let contacts = touching(scene, &state.x);
    let inverse_mass: Vec<f64> = scene.spheres.iter().map(|sphere| 1.0 / sphere.mass).collect();
    let applied = vec![scene.gravity; scene.spheres.len()];
    let bodies = Bodies { inverse_mass: &inverse_mass, velocity: &state.v, applied: &applied };
    let forces = hold(bodies, &contacts, &[]).acceleration.multipliers;
    let of = |(on, force): (&Resting, f64)| Carried { wall: on.b.is_none(), normal: on.normal, force };
    contacts.iter().zip(forces).map(of).collect()
}

fn touching(scene: &Scene, x: &[DVec3]) -> Vec<Resting> {
    let mut contacts = Vec::new();
    for (a, sphere) in scene.spheres.iter().enumerate() {
        let walls = scene.walls.iter().map(|wall| wall.shape.closest(x[a]).offset);
        let on_wall = walls.filter(|arm| arm.length() < sphere.radius + NEAR);
        contacts.extend(on_wall.map(|arm| Resting { a, b: None, normal: arm.normalize(), surface: Surface::Face }));
        let below = (0..a).filter(|&b| x[a].distance(x[b]) < sphere.radius + scene.spheres[b].radius + NEAR);
        contacts.extend(below.map(|b| {
            let arm = x[a] - x[b];
            Resting { a, b: Some(b), normal: arm.normalize(), surface: Surface::Round { radius: arm.length() } }
        }));
    }
    contacts
}
