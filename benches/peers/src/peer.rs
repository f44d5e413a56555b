//! The other engine: `rapier3d-f64`, set up so that it solves the same problem and can show what it is able to.
//!
//! Spheres are balls of the scene's mass, walls are thick fixed boxes behind the scene's faces: half-spaces cost the same
//! for one ground and more than twice as much for a gas in a box, since every ball is near a half-space. No friction, no
//! damping, nothing sleeps. Rotations are locked: without friction nothing turns; it costs the same either way.

use std::fmt;

use carom::physics::Scene;
use glam::DVec3;
use rapier3d_f64::prelude::{
    ColliderBuilder, IntegrationParameters, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, SpringCoefficients, Vector,
};

/// How thick the boxes behind the walls are, m: more than any ball travels in a step.
const THICKNESS: f64 = 1.0;

/// How contacts are treated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Contacts {
    /// As rapier does unless told otherwise.
    Default,
    /// Only what touches is a contact. By default it begins 0.02 m before, and so early an impact is that an elastic
    /// crowd loses most of its energy. Of the settings tried the one that keeps energy best.
    Late,
    /// Springs as hard as rapier allows, overlaps pushed out at any speed. Of the settings tried the one that lets a
    /// heap overlap least.
    Hard,
}

/// What of rapier's settings is varied.
#[derive(Debug, Clone, Copy)]
pub struct Tuning {
    /// Steps in a second; rapier's default is 60.
    pub rate: u32,
    /// `num_solver_iterations`: the small steps in which each step is solved; rapier's default is 4.
    pub iterations: usize,
    /// How contacts are treated.
    pub contacts: Contacts,
}

impl fmt::Display for Tuning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tuning { rate, iterations, contacts } = self;
        let words = match contacts {
            Contacts::Default if (*rate, *iterations) == (60, 4) => " (defaults)",
            Contacts::Default => "",
            Contacts::Late => " late contacts",
            Contacts::Hard => " hard contacts",
        };
        write!(f, "dt 1/{rate} iterations {iterations}{words}")
    }
}

impl Tuning {
    fn parameters(&self) -> IntegrationParameters {
        let stock = IntegrationParameters {
            dt: 1.0 / f64::from(self.rate),
            num_solver_iterations: self.iterations,
            ..IntegrationParameters::default()
        };
        let spring = SpringCoefficients { natural_frequency: 1e6, damping_ratio: 1.0 };
        match self.contacts {
            Contacts::Default => stock,
            Contacts::Late => {
                IntegrationParameters { normalized_prediction_distance: 1e-4, contact_recycling: false, ..stock }
            }
            Contacts::Hard => IntegrationParameters {
                contact_softness: spring,
                static_contact_softness: spring,
                contact_recycling: false,
                normalized_max_corrective_velocity: f64::MAX,
                ..stock
            },
        }
    }
}

/// A scene as rapier's world.
pub struct World {
    world: PhysicsWorld,
    balls: Vec<RigidBodyHandle>,
}

impl World {
    /// The same spheres and walls at t = 0.
    pub fn new(scene: &Scene, tuning: Tuning) -> World {
        let law = scene.contact;
        assert_eq!(law.restitution, law.wall_restitution, "one restitution for all contacts");
        let mut world = PhysicsWorld::new();
        world.gravity = vector(scene.gravity);
        world.integration_parameters = tuning.parameters();
        // equal on both sides, so that rapier's rule for combining them gives this e
        let smooth = |collider: ColliderBuilder| collider.restitution(law.restitution).friction(0.0);
        for wall in boxes(scene) {
            let half = 0.5 * wall.size;
            let shape = ColliderBuilder::cuboid(half.x, half.y, half.z);
            world.insert(RigidBodyBuilder::fixed().translation(vector(wall.center)), smooth(shape));
        }
        let ball = |sphere: &carom::scene::Sphere| {
            let body = RigidBodyBuilder::dynamic().translation(vector(sphere.x)).linvel(vector(sphere.v));
            let shape = ColliderBuilder::ball(sphere.radius).mass(sphere.mass);
            world.insert(body.lock_rotations().can_sleep(false), smooth(shape)).0
        };
        let balls = scene.spheres.iter().map(ball).collect();
        World { world, balls }
    }

    /// One step of its dt.
    pub fn step(&mut self) {
        self.world.step();
    }

    /// Centres (m) and velocities (m/s) by sphere.
    pub fn state(&self) -> (Vec<DVec3>, Vec<DVec3>) {
        let of = |handle: &RigidBodyHandle| {
            let body = &self.world.bodies[*handle];
            (DVec3::from(body.translation().to_array()), DVec3::from(body.linvel().to_array()))
        };
        self.balls.iter().map(of).unzip()
    }
}

/// A box along the axes, m.
struct Slab {
    center: DVec3,
    size: DVec3,
}

/// The boxes behind the scene's walls, seen from the spheres.
fn boxes(scene: &Scene) -> Vec<Slab> {
    let behind = |wall: &carom::scene::Wall| {
        let shape = wall.shape;
        let inward = shape.normal() * shape.plane_distance(scene.spheres[0].x).signum();
        let axes = [shape.s1, shape.s2, inward].map(|edge| edge.to_array().iter().filter(|part| **part != 0.0).count());
        assert_eq!(axes, [1, 1, 1], "walls along the axes");
        Slab {
            center: shape.center - 0.5 * THICKNESS * inward,
            size: shape.s1.abs() + shape.s2.abs() + THICKNESS * inward.abs(),
        }
    };
    scene.walls.iter().map(behind).collect()
}

fn vector(v: DVec3) -> Vector {
    Vector::from_array(v.to_array())
}
