//! What a crowd costs: as much as happens in it, wherever its spheres are and however small. Work is counted, never timed.

use crate::support::{self, ELASTIC, lattice, room, scene, sphere};
use carom::physics::{Class, Contact, Kind, Method, Progress, Scene, Settings, Simulation, Until};
use carom::random::SplitMix64;
use carom::scene::{Sphere, Wall};
use glam::{DVec3, dvec3};

/// What a run did and what it cost.
struct Cost {
    /// Events of every sort: contacts, crossings of cells, plans that were stale, ends of frames.
    events: u64,
    /// Looks at a pair or a wall.
    looks: u64,
    impacts: u64,
    /// Impacts: when (s), wall or pair, the sphere, the other.
    list: Vec<(f64, Kind, usize, usize)>,
}

fn by(method: Method, dt: f64) -> Settings {
    Settings { method, dt, tolerance: 1e-6 }
}

/// Runs to `until` (s) in one frame but for what happens. The last frame may end later; what it holds is left out.
fn cost_by(method: Method, scene: &Scene, until: f64) -> Cost {
    let mut run = Simulation::new(scene, by(method, until));
    run.record_events(true);
    let mut events = 0;
    loop {
        match run.advance(Until::Time(until), 1) {
            Progress::Reached => break,
            Progress::Yielded => events += 1,
            Progress::Stalled(stall) => panic!("{}", stall.reason),
        }
    }
    let collide = |event: &Contact| event.class == Class::Collide && event.time <= until;
    let list: Vec<_> = run.take_events().into_iter().filter(collide).map(|e| (e.time, e.kind, e.a, e.b)).collect();
    Cost { events, looks: run.tallies().evaluations, impacts: list.len() as u64, list }
}

fn cost(scene: &Scene, until: f64) -> Cost {
    cost_by(Method::Exact, scene, until)
}

/// Numbers in [−½, ½), the same in every run.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut random = SplitMix64::new(seed);
    move || random.unit() - 0.5
}

fn vector(next: &mut impl FnMut() -> f64) -> DVec3 {
    dvec3(next(), next(), next())
}

/// `n`³ spheres in a cube of edge 1 m about the origin, jittered, with velocities of up to 1 m/s per axis.
fn strewn(n: usize, radius: f64, seed: u64) -> Vec<Sphere> {
    let mut next = numbers(seed);
    let mut spheres = lattice(n, 1.0 / n as f64, DVec3::ZERO, radius);
    for sphere in &mut spheres {
        sphere.x += vector(&mut next) * (1.0 / n as f64 - 2.0 * radius);
        sphere.v = vector(&mut next) * 2.0;
    }
    spheres
}

fn free(spheres: Vec<Sphere>) -> Scene {
    scene(DVec3::ZERO, ELASTIC, Vec::new(), spheres)
}

fn boxed(half: f64, spheres: Vec<Sphere>) -> Scene {
    scene(DVec3::ZERO, ELASTIC, room(DVec3::splat(-half), DVec3::splat(half)), spheres)
}

/// The impacts of elastic spheres in free space until `until` (s), by looking at every pair again and again: no cells, no
/// plans, no code of the engine.
fn by_hand(scene: &Scene, until: f64) -> Vec<(f64, Kind, usize, usize)> {
    let mut spheres: Vec<Sphere> = scene.spheres.clone();
    let (mut now, mut list) = (0.0, Vec::new());
    let meet = |a: &Sphere, b: &Sphere| {
        let (x, v, reach) = (a.x - b.x, a.v - b.v, a.radius + b.radius);
        let (p, q, c) = (v.length_squared(), x.dot(v), x.length_squared() - reach * reach);
        let root = q * q - p * c;
        (q < 0.0 && root > 0.0).then(|| (-q - root.sqrt()) / p)
    };
    loop {
        let mut first = (until - now, 0, 0);
        for b in 1..spheres.len() {
            for a in 0..b {
                if let Some(t) = meet(&spheres[a], &spheres[b]).filter(|&t| t < first.0) {
                    first = (t, a, b);
                }
            }
        }
        let (t, a, b) = first;
        if b == 0 {
            return list;
        }
        now += t;
        spheres.iter_mut().for_each(|s| s.x += s.v * t);
        let n = (spheres[a].x - spheres[b].x).normalize();
        let (m, k) = (spheres[a].mass, spheres[b].mass);
        let push = -2.0 * n.dot(spheres[a].v - spheres[b].v) / (1.0 / m + 1.0 / k);
        spheres[a].v += n * (push / m);
        spheres[b].v -= n * (push / k);
        list.push((now, Kind::Pair, a, b));
    }
}

/// Both list the same impacts at the same times. Times agree to 1e-6 s: a few impacts per sphere, each of which makes an
/// error of rounding some ten to a thousand times larger.
fn assert_same(found: &[(f64, Kind, usize, usize)], expected: &[(f64, Kind, usize, usize)]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!((found.1, found.2, found.3), (expected.1, expected.2, expected.3));
        assert!((found.0 - expected.0).abs() <= 1e-6 * (1.0 + expected.0), "{found:?}, by hand {expected:?}");
    }
}

#[test]
fn nothing_costs_nothing_however_fast_one_flies() {
    let mut spheres = lattice(5, 0.01, DVec3::ZERO, 1e-3);
    spheres.push(sphere(dvec3(-1.0, 0.5, 0.5), dvec3(1e5, 0.0, 0.0), 1e-3));
    for method in [Method::Exact, Method::Swept] {
        let [short, long] = [10.0, 1e9].map(|until| cost_by(method, &free(spheres.clone()), until));
        assert_eq!(long.impacts, 0);
        // a few crossings per sphere until it is noticed that they lead nowhere
        assert!(short.events < 1000 && short.looks < 50_000, "{}, {}", short.events, short.looks);
        assert_eq!((long.events, long.looks), (short.events, short.looks), "and nothing from then on");
    }
}

#[test]
fn a_dilute_gas_costs_what_strikes_the_walls_whatever_the_radius() {
    for (n, radius, half) in [(5, 1e-5, 5.0), (5, 1e-9, 500.0), (10, 1e-12, 5.0)] {
        let mut spheres = strewn(n, 0.0, 3);
        for sphere in &mut spheres {
            (sphere.x, sphere.v, sphere.radius) = (sphere.x * 1.9 * half, sphere.v * half, radius);
        }
        let scene = boxed(half, spheres);
        let found = cost(&scene, 20.0);
        assert!(found.list.iter().all(|impact| impact.1 == Kind::Wall), "this gas is too thin for pairs to meet");
        // how often a path unfolded over mirrored rooms passes a wall
        let width = 2.0 * (half - radius);
        let passes = |x: f64, v: f64| ((x + 0.5 * width + 20.0 * v) / width).floor().abs() as u64;
        let expected: u64 = scene.spheres.iter().map(|s| (0..3).map(|k| passes(s.x[k], s.v[k])).sum::<u64>()).sum();
        assert_eq!(found.impacts, expected, "{n}³ spheres of {radius} m");
        // about as many cubes lie in a row as the cube root of twice their number, and a flight is slanted
        assert!(found.events < 25 * found.impacts, "{} for {}", found.events, found.impacts);
        assert!(found.looks < 250 * found.impacts, "{} for {}", found.looks, found.impacts);
    }
}

#[test]
fn a_cloud_that_spreads_for_ever_meets_whom_it_should_and_falls_silent() {
    let cloud = free(strewn(6, 0.02, 11));
    let [early, later, last] = [10.0, 1e6, 1e12].map(|until| cost(&cloud, until));
    assert_same(&last.list, &by_hand(&cloud, 1e12));
    assert!(last.impacts > 20, "{}", last.impacts);
    let all = 216 * 216;
    assert!(early.looks < 20 * all && later.looks - early.looks < 20 * all, "{} {}", early.looks, later.looks);
    // 20 doublings of its size: each costs no more than some crossings a sphere
    assert!(last.events - later.events < 20 * 10 * 216, "{} after {}", last.events, later.events);
}

#[test]
fn one_giant_among_dust_meets_whom_it_should_at_the_price_of_dust() {
    let mut next = numbers(5);
    let mut spheres = strewn(8, 4e-3, 7);
    spheres.retain(|dust| dust.x.length() > 0.31);
    spheres.push(Sphere { mass: 50.0, ..sphere(DVec3::ZERO, vector(&mut next) * 0.1, 0.3) });
    let giant = spheres.len() - 1;
    let scene = free(spheres);
    let found = cost(&scene, 3.0);
    assert_same(&found.list, &by_hand(&scene, 3.0));
    let struck = found.list.iter().filter(|impact| impact.3 == giant).count() as u64;
    assert!(struck > 20, "{struck}");
    // the giant looks at all when it is struck; all the dust flies away in the end, and looks at all once for that
    let (all, impacts) = (giant as u64 + 1, found.impacts);
    assert!(found.looks < all * all + 2 * all * struck + 200 * impacts, "{}: {all}, {struck}, {impacts}", found.looks);
}

#[test]
fn a_giant_does_not_make_dust_in_a_room_dear() {
    let dust = || {
        let mut spheres = strewn(14, 0.01, 7);
        spheres.retain(|dust| dust.x.length() > 0.22);
        spheres
    };
    let plain = cost(&boxed(0.6, dust()), 0.5);
    let mut spheres = dust();
    spheres.push(Sphere { mass: 1e3, ..sphere(DVec3::ZERO, DVec3::ZERO, 0.2) });
    let found = cost(&boxed(0.6, spheres), 0.5);
    let each = |cost: &Cost| cost.looks as f64 / cost.impacts as f64;
    assert!(plain.impacts > 1000, "{}", plain.impacts);
    assert!(each(&found) < 4.0 * each(&plain), "{} beside {}", each(&found), each(&plain));
}

/// `nx` × `ny` spheres in a plane or on a line through the origin, with these steps between them.
fn flat(counts: [usize; 2], steps: [DVec3; 2], radius: f64) -> Vec<Sphere> {
    let mut next = numbers(1);
    let middle = steps[0] * (0.5 * (counts[0] - 1) as f64) + steps[1] * (0.5 * (counts[1] - 1) as f64);
    let place = |k: usize| steps[0] * (k % counts[0]) as f64 + steps[1] * (k / counts[0]) as f64 - middle;
    (0..counts[0] * counts[1]).map(|k| sphere(place(k), vector(&mut next) * 2.0, radius)).collect()
}

#[test]
fn layers_and_lines_cost_what_a_cube_does_however_they_lie() {
    let cube =
        cost(&boxed(10.0, strewn(20, 1e-3, 2).into_iter().map(|s| Sphere { x: s.x * 19.0, ..s }).collect()), 0.3);
    let each = |cost: &Cost, n: usize| (cost.events as f64 / n as f64, cost.looks as f64 / n as f64);
    let (events, looks) = each(&cube, 8000);
    let lying = [
        ("layer", [100, 80], [DVec3::X * 0.15, DVec3::Z * 0.15]),
        ("slanted layer", [100, 80], [dvec3(0.11, 0.11, 0.0), dvec3(0.0, 0.11, 0.11)]),
        ("line", [8000, 1], [DVec3::Y * 2e-3, DVec3::ZERO]),
        ("slanted line", [8000, 1], [DVec3::splat(2e-3), DVec3::ZERO]),
    ];
    for (name, counts, steps) in lying {
        let found = cost(&boxed(10.0, flat(counts, steps, 5e-4)), 0.3);
        let (e, l) = each(&found, 8000);
        // they are as many times closer to each other, and spread as fast: cubes are narrower at first
        assert!(e < 30.0 * (1.0 + events) && l < 30.0 * (1.0 + looks), "{name}: {e} events and {l} looks a sphere");
    }
}

#[test]
fn a_layer_that_falls_together_meets_the_floor_together() {
    let spheres = flat([60, 60], [DVec3::X * 0.1, DVec3::Z * 0.1], 0.02);
    let spheres = spheres.into_iter().map(|s| Sphere { v: DVec3::NEG_Y, ..s }).collect();
    let found = cost(&boxed(4.0, spheres), 8.0);
    assert_eq!(found.impacts, 3600);
    let spheres = || found.list.iter().map(|impact| impact.2);
    assert!(spheres().eq(0..3600), "ties go by the index");
    assert!(found.list.iter().all(|impact| impact.0 == found.list[0].0));
}

#[test]
fn no_unit_of_length_or_time_changes_what_a_crowd_costs() {
    let scaled = |length: f64, time: f64| {
        let spheres = strewn(6, 0.01, 4).into_iter();
        let body = |s: Sphere| Sphere { x: s.x * length, v: s.v * (length / time), radius: s.radius * length, ..s };
        let walls = room(DVec3::splat(-2.0 * length), DVec3::splat(2.0 * length));
        let found = cost(&scene(DVec3::ZERO, ELASTIC, walls, spheres.map(body).collect()), 20.0 * time);
        let list: Vec<_> = found.list.iter().map(|e| (e.0 / time, e.1, e.2, e.3)).collect();
        (found.events, found.looks, list)
    };
    let expected = scaled(1.0, 1.0);
    // powers of two are exact, so that every bit stays
    for (length, time) in [(1_048_576.0, 1.0), (1.0 / 1_048_576.0, 1024.0), (0.5_f64.powi(90), 2_f64.powi(30))] {
        assert!(scaled(length, time) == expected, "{length} m, {time} s");
    }
}

#[test]
fn walls_in_any_number_are_near_only_where_they_are() {
    let mut next = numbers(9);
    let mut walls: Vec<Wall> = room(DVec3::splat(-1.0), DVec3::splat(1.0));
    for _ in 0..20_000 {
        let (center, s1, s2) = (vector(&mut next) * 1.9, vector(&mut next) * 0.01, vector(&mut next) * 0.01);
        walls.push(support::wall(dvec3(center.x, -0.5 - 0.25 * (1.0 + center.y), center.z), s1, s2));
    }
    let spheres = strewn(8, 1e-3, 1).into_iter().map(|s| Sphere { x: s.x * 0.5 + DVec3::Y * 0.5, ..s }).collect();
    let found = cost(&scene(DVec3::ZERO, ELASTIC, walls, spheres), 0.1);
    assert!(found.looks < 100 * 512, "{}", found.looks);
}

#[test]
fn nobody_and_few_go_by_every_method() {
    for &method in Method::ALL {
        for walls in [Vec::new(), room(DVec3::splat(-2.0), DVec3::splat(2.0))] {
            for count in [0, 1, 2, 64, 65] {
                let mut spheres = strewn(5, 0.05, 8);
                spheres.truncate(count);
                let scene = scene(dvec3(0.0, -1.0, 0.0), ELASTIC, walls.clone(), spheres);
                let mut run = Simulation::new(&scene, by(method, 0.01));
                assert_eq!(support::run_to(&mut run, 1.0, u64::MAX), None, "{count} by {}", method.name());
                let state = run.at(1.0);
                assert_eq!((state.t, state.x.len()), (1.0, count));
                assert!(state.x.iter().all(|x| x.is_finite()));
            }
        }
    }
}

#[test]
fn frames_too_short_to_count_are_not_counted_out() {
    for method in [Method::Exact, Method::Swept] {
        for (count, dt) in [(0, 1e-300), (1, 1e-300), (3, 1e-15), (65, 5e-324)] {
            let mut spheres = strewn(5, 0.05, 8);
            spheres.truncate(count);
            let scene = boxed(2.0, spheres);
            let end = |dt: f64| {
                let mut run = Simulation::new(&scene, by(method, dt));
                for _ in 0..100_000 {
                    if run.advance(Until::Time(3.0), 100) == Progress::Reached {
                        return (run.at(3.0).hash(), run.tallies().impacts);
                    }
                }
                panic!("{count} spheres in frames of {dt} s do not arrive");
            };
            assert_eq!(end(dt), end(0.01), "{count} spheres in frames of {dt} s");
        }
    }
}
