//! Single spheres on more walls than they need: pits, funnels and tubes.
//!
//! The right answer is statics: what lies at the bottom of a pit stays there, at no speed, and touches without overlap;
//! what just fits into a tube slides straight on.

use crate::random::Random;
use crate::support::{G, PAPER_LAW, scene, sphere, wall};
use carom::physics::{Method, Progress, Scene, Settings, Simulation, State, Until};
use carom::scene::{ContactLaw, Wall};
use glam::{DVec3, dvec3};

const METHODS: [Method; 2] = [Method::Exact, Method::Swept];

/// Overlap allowed to what rests, in radii.
const OVERLAP: f64 = 1e-12;

/// Deepest overlap with a wall, in radii.
fn deepest(scene: &Scene, state: &State) -> f64 {
    let r = scene.spheres[0].radius;
    scene.walls.iter().map(|wall| 1.0 - wall.shape.distance(state.x[0]) / r).fold(0.0, f64::max)
}

/// Runs to `until` (s), frame by frame; the state then. Says what went wrong on the way.
fn run(scene: &Scene, method: Method, until: f64) -> Result<(State, Simulation), String> {
    let mut run = Simulation::new(scene, Settings { method, dt: 0.05, tolerance: 1e-12 });
    let mut yields = 0;
    while run.time() < until {
        match run.advance(Until::Frame, 100_000) {
            Progress::Stalled(stall) => return Err(stall.reason),
            // a million events of one sphere
            Progress::Yielded if yields >= 10 => return Err(format!("no end of events at {} s", run.time())),
            Progress::Yielded => yields += 1,
            Progress::Reached => {
                let depth = deepest(scene, &run.state());
                if depth > OVERLAP {
                    return Err(format!("{depth:e} r deep at {} s", run.time()));
                }
            }
        }
    }
    Ok((run.state(), run))
}

/// `count` slopes around the y axis that rise as `rise` : 1, and reach from `hole` to 4 m, turned by `turn` (share of one).
fn pit(count: usize, rise: f64, hole: f64, turn: f64) -> Vec<Wall> {
    let of = |k: usize| {
        let angle = std::f64::consts::TAU * (k as f64 + turn) / count as f64;
        let (out, across) = (dvec3(angle.cos(), 0.0, angle.sin()), dvec3(-angle.sin(), 0.0, angle.cos()));
        let slope = (out + DVec3::Y * rise) * (4.0 - hole);
        wall(out * hole + slope * 0.5, across * 16.0, slope)
    };
    (0..count).map(of).collect()
}

/// A sphere dropped into a pit of the sort chosen by `random`.
fn drop_into(random: &mut Random, walls: Vec<Wall>, r: f64) -> Scene {
    let contact = ContactLaw {
        restitution: 0.5,
        wall_restitution: random.pick(&[0.0, 0.1, 0.5, 0.8]),
        tangential: random.pick(&[0.0, 0.5, 0.99]),
        rest_speed: random.pick(&[0.0, 0.01, 0.1]),
    };
    let x = dvec3(random.between(-0.3, 0.3), random.between(4.0, 6.0), random.between(-0.3, 0.3));
    scene(G, contact, walls, vec![sphere(x, DVec3::ZERO, r)])
}

/// Drops `count` spheres and asks that they rest in the end.
fn assert_rest(count: u64, of: impl Fn(&mut Random) -> Scene) {
    let mut left = 0;
    for (seed, method) in (0..count).flat_map(|seed| METHODS.map(|method| (seed, method))) {
        let scene = of(&mut Random::new(seed));
        let (state, mut after) = match run(&scene, method, 60.0) {
            Ok(done) => done,
            Err(why) => panic!("seed {seed} by {method:?}: {why}"),
        };
        if state.x[0].length() > 10.0 {
            // it has bounced out, and falls
            left += 1;
            continue;
        }
        assert_eq!(state.v[0], DVec3::ZERO, "seed {seed} by {method:?} at {:?}: {scene:?}", state.x[0]);
        while after.time() < 1000.0 {
            assert_eq!(after.advance(Until::Time(1000.0), 1_000_000), Progress::Reached, "seed {seed} by {method:?}");
        }
        let later = after.state();
        assert!(later.x[0] == state.x[0], "seed {seed} by {method:?}: {} is now at {}", state.x[0], later.x[0]);
    }
    assert!(left < count / 2, "{left} of {count} drops by two methods bounced out");
}

#[test]
fn a_ball_comes_to_rest_on_three_to_eight_slopes() {
    assert_rest(120, |random| {
        let (count, rise) = (3 + (random.unit() * 6.0) as usize, random.decade(-0.5, 0.5));
        let turn = if random.unit() < 0.5 { 0.0 } else { random.unit() };
        let r = random.between(0.1, 0.5);
        drop_into(random, pit(count, rise, 0.0, turn), r)
    });
}

/// `count` long walls around the y axis, at distance `r`, turned by `turn`: a tube into which a sphere of radius `r` just fits.
fn tube(count: usize, r: f64, turn: f64) -> Vec<Wall> {
    let of = |k: usize| {
        let angle = std::f64::consts::TAU * (k as f64 + turn) / count as f64;
        let (out, across) = (dvec3(angle.cos(), 0.0, angle.sin()), dvec3(-angle.sin(), 0.0, angle.cos()));
        wall(out * r, across * 40.0, DVec3::Y * 400.0)
    };
    (0..count).map(of).collect()
}

#[test]
fn what_just_fits_slides_along_its_tube_without_an_event() {
    for (seed, method) in (0..200_u64).flat_map(|seed| METHODS.map(|method| (seed, method))) {
        let mut random = Random::new(seed);
        let count = 2 + (random.unit() * 6.0) as usize;
        let r = random.between(0.1, 2.0);
        let turn = if random.unit() < 0.5 { 0.0 } else { random.unit() };
        let restitution = random.pick(&[0.0, 0.5, 1.0]);
        let contact = ContactLaw { restitution, wall_restitution: restitution, rest_speed: 0.0, ..PAPER_LAW };
        let v = random.vector();
        let across = dvec3(v.x, 0.0, v.z);
        let scene = scene(DVec3::ZERO, contact, tube(count, r, turn), vec![sphere(DVec3::ZERO, v, r)]);
        let (state, after) = run(&scene, method, 10.0).unwrap_or_else(|why| panic!("seed {seed} by {method:?}: {why}"));
        let free = if count == 2 {
            let angle = std::f64::consts::PI * turn;
            let along = dvec3(-angle.sin(), 0.0, angle.cos());
            along * along.dot(across)
        } else {
            DVec3::ZERO
        };
        let expected = free + DVec3::Y * v.y;
        assert_eq!(after.tallies().impacts, 0, "seed {seed} by {method:?}: {count} walls");
        // an ulp of v in ten seconds, and ten of the place
        let error = state.x[0].distance(expected * state.t);
        assert!(error < 1e-13, "seed {seed} by {method:?}, {count} walls: {error:e} m off");
        assert!(
            state.v[0].distance(expected) < 1e-14,
            "seed {seed} by {method:?}, {count} walls: {} instead of {expected}",
            state.v[0]
        );
    }
}

/// Where the walls end their edges are a few ulp of the coordinates off each other: no wedge that could stop a sphere.
#[test]
fn what_just_fits_leaves_its_tube_with_all_its_speed() {
    for seed in 0..200_u64 {
        let mut random = Random::new(seed);
        let count = random.pick(&[2, 4, 4, 6]);
        let r = random.pick(&[0.03, 0.1, 0.5]);
        let out = random.vector().normalize_or(DVec3::Y);
        let side = out.any_orthonormal_vector();
        let (length, speed) = (random.between(2.0, 20.0), random.between(0.5, 3.0));
        let plate = |k: usize| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
            let normal = side * cos + out.cross(side) * sin;
            wall(normal * r, normal.cross(out) * 8.0 * r, out * length)
        };
        let restitution = random.pick(&[0.0, 0.5, 1.0]);
        let contact = ContactLaw { restitution, wall_restitution: restitution, rest_speed: 0.0, ..PAPER_LAW };
        let walls = (0..count).map(plate).collect();
        let scene = scene(DVec3::ZERO, contact, walls, vec![sphere(DVec3::ZERO, out * speed, r)]);
        let (state, after) =
            run(&scene, Method::Exact, 2.0 * length / speed).unwrap_or_else(|why| panic!("seed {seed}: {why}"));
        // ulps of coordinates of 20 m over a radius of 3 cm turn a normal by 1e-13
        assert!(state.v[0].distance(out * speed) < 1e-12 * speed, "seed {seed}: {}", state.v[0]);
        assert_eq!(after.tallies().rests, 0, "seed {seed}");
    }
}

/// A row of spheres in a tube, struck along it: normals that lean by 1e-14 push them across, and nothing may drift into a wall.
#[test]
fn a_blow_along_a_tube_drives_nothing_into_its_walls() {
    for seed in 0..200_u64 {
        let mut random = Random::new(seed);
        let (r, play) = (0.1, random.decade(-15.0, -12.0));
        let walls = tube(random.pick(&[2, 4]), r * (1.0 + play), 0.0);
        let restitution = random.pick(&[0.0, 0.5, 0.9]);
        let contact = ContactLaw { restitution, wall_restitution: restitution, rest_speed: 0.0, ..PAPER_LAW };
        let lean = || DVec3::X * (r * play);
        let spheres = vec![
            sphere(DVec3::ZERO - lean(), DVec3::Y * random.between(0.5, 3.0), r),
            sphere(DVec3::Y * (2.0 * r + random.pick(&[0.0, 0.3])) + lean(), DVec3::ZERO, r),
        ];
        let scene = scene(DVec3::ZERO, contact, walls, spheres);
        let (state, _) = run(&scene, Method::Exact, 10.0).unwrap_or_else(|why| panic!("seed {seed}: {why}"));
        let overlap = |x: &DVec3| scene.walls.iter().map(|wall| 1.0 - wall.shape.distance(*x) / r).fold(0.0, f64::max);
        let deepest = state.x.iter().map(overlap).fold(0.0, f64::max);
        assert!(deepest <= OVERLAP, "seed {seed}: {deepest:e}");
    }
}
