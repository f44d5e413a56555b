//! Closed forms that the event-driven method must meet to rounding: drops, bounces, impacts, chains, edges, slopes.

use crate::support::{ELASTIC, G, ball, floor, go, recorded, scene, smooth, sphere, wall};
use carom::physics::{Class, Contact, ContactLaw, Kind, Method, Progress, Scene, Settings, Simulation, State, Until};
use carom::scene::{Sphere, Wall};
use glam::{DVec3, dvec3};

/// One rounding, relative.
const EPS: f64 = f64::EPSILON;

fn start(scene: &Scene) -> Simulation {
    recorded(scene, Settings { method: Method::Exact, dt: 0.1, tolerance: 1e-3 })
}

/// Runs frame by frame until this pair or wall has collided; returns the state right then.
fn go_to_impact(run: &mut Simulation, kind: Kind, a: usize, b: usize) -> State {
    for _ in 0..10_000 {
        assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
        if run.contacts().iter().any(|c| c.class == Class::Collide && c.key() == (kind, a, b)) {
            return run.state();
        }
    }
    panic!("{kind:?} {a}-{b} has not collided by {} s", run.time());
}

fn rows(run: &mut Simulation, class: Class) -> Vec<Contact> {
    run.take_events().into_iter().filter(|row| row.class == class).collect()
}

/// A sphere of radius 0.5 m, `h` (m) above the floor.
fn dropped(h: f64, law: ContactLaw) -> Scene {
    dropped_ball(0.5, h, law)
}

/// A sphere of radius `r` (m), `h` (m) above the floor.
fn dropped_ball(r: f64, h: f64, law: ContactLaw) -> Scene {
    scene(G, law, vec![floor(20.0)], vec![sphere(DVec3::Y * (r + h), DVec3::ZERO, r)])
}

/// A wall across the x axis, its back to the left.
fn stop(x: f64) -> Wall {
    wall(DVec3::X * x, DVec3::Y * 4.0, DVec3::Z * 4.0)
}

fn assert_close(found: DVec3, expected: DVec3, tolerance: f64, what: &str) {
    let error = (found - expected).length();
    assert!(error <= tolerance, "{what}: {found} instead of {expected}, off by {error:e}");
}

#[test]
fn a_drop_lasts_sqrt_2h_over_g_and_ends_at_sqrt_2gh() {
    for h in [1e-3, 0.1, 1.0, 9.0, 1e3, 1e6] {
        let mut run = start(&dropped(h, smooth(0.8)));
        let time = (2.0 * h / 9.8).sqrt();
        go(&mut run, time * 1.1);
        let hit = rows(&mut run, Class::Collide)[0];
        // h is known as the coordinate 0.5 + h: one ulp of that, and a few of the formulas.
        let tolerance = 4.0 * EPS * (1.0 + 0.5 / h);
        assert!((hit.time / time - 1.0).abs() <= tolerance, "{h} m: {} s instead of {time} s", hit.time);
        let speed = (2.0 * 9.8 * h).sqrt();
        assert!((hit.approach_speed / speed - 1.0).abs() <= tolerance, "{h} m: {} m/s", hit.approach_speed);
    }
}

#[test]
fn the_nth_bounce_rises_to_e_to_the_2n_times_the_height() {
    for e in [0.3, 0.5, 0.8, 0.95, 1.0] {
        let mut run = start(&dropped(1.0, smooth(e)));
        for n in 1..=10 {
            go_to_impact(&mut run, Kind::Wall, 0, 0);
            let rise = rows(&mut run, Class::Collide)[0].separation_speed;
            let (height, apex) = (e.powi(2 * n), run.time() + rise / 9.8);
            let top = go(&mut run.clone(), apex).x[0].y - 0.5;
            // Near the floor a coordinate of 0.5 m is rounded to 1.1e-16 m, and each impact's time, by up to 4.4e-16 s
            // after 4 s, misplaces the sphere by at most 4.4 m/s of that; ten impacts of it.
            assert!((top - height).abs() <= 1e-14, "e = {e}, bounce {n}: {top} m instead of {height} m");
            assert!((rise * rise / 19.6 - height).abs() <= 1e-14, "e = {e}, bounce {n}: leaves at {rise} m/s");
        }
    }
}

/// √(2h/g) (1 + e) / (1 − e), s.
fn bouncing_time(h: f64, e: f64) -> f64 {
    (2.0 * h / 9.8).sqrt() * (1.0 + e) / (1.0 - e)
}

/// The clock's rounding at the last impact may leave the sphere an ulp or two above or below.
fn assert_lies_still(state: &State, r: f64) {
    assert_close(state.x[0], DVec3::Y * r, 4.0 * EPS * r, "it lies on the floor");
    assert_eq!(state.v[0], DVec3::ZERO, "it lies still");
}

/// When the sphere on the floor began to rest, s.
fn rest_begins(scene: &Scene, until: f64) -> f64 {
    let mut run = start(scene);
    let state = go(&mut run, until);
    assert_lies_still(&state, scene.spheres[0].radius);
    let rests = rows(&mut run, Class::Rest);
    assert_eq!(rests.len(), 1, "{rests:?}");
    rests[0].time
}

#[test]
fn infinitely_many_bounces_end_when_the_geometric_series_does() {
    // Nothing rubs (tangential = 1) and rest_speed is 0: bounces whose hops go under 1e-12 radii are summed up in
    // closed form. That is long before the effective rest speed, 10 g ulp(t)/(1 − e) = 1e-8 m/s at worst, or hops of
    // four ulp of the radius could cut off anything. Demanded up to e = 0.8; near 1 each of the ~18/(1 − e) bounces
    // rounds its time and its place, in either direction.
    let tolerance = 1e-12;
    let restitutions = [0.1, 0.5, 0.7, 0.8, 0.9, 0.99, 0.999];
    for (e, r) in restitutions.into_iter().flat_map(|e| [(e, 0.5), (e, 1e-4)]) {
        for h in [0.1, 1.0, 4.9] {
            let expected = bouncing_time(h, e);
            let found = rest_begins(&dropped_ball(r, h, smooth(e)), expected + 1.0);
            let error = (found / expected - 1.0).abs();
            assert!(error <= tolerance, "e = {e}, r = {r}, {h} m: {found} s, not {expected} s, off by {error:e}");
        }
    }
}

#[test]
fn without_restitution_the_first_impact_is_the_last() {
    for h in [0.1, 1.0, 4.9] {
        let mut run = start(&dropped(h, smooth(0.0)));
        let expected = bouncing_time(h, 0.0);
        let state = go(&mut run, expected + 1.0);
        assert_lies_still(&state, 0.5);
        let events = run.take_events();
        assert_eq!(events.iter().map(|row| row.class).collect::<Vec<_>>(), [Class::Collide, Class::Rest]);
        assert!((events[0].time / expected - 1.0).abs() <= 16.0 * EPS, "{} s, not {expected} s", events[0].time);
        assert_eq!(events[1].time, events[0].time, "it rests at once");
    }
}

#[test]
fn a_rest_speed_ends_the_series_at_the_first_impact_that_is_no_faster() {
    // Impact k comes at √(2h/g) (1 + 2 (e + e² + … + eᵏ)) with √(2gh) eᵏ; the first at most rest_speed rests. Fast ones
    // are met one by one, those of hops under 1e-12 radii (3e-6 m/s) are summed up. No case is within rounding of a tie.
    for e in [0.5, 0.8, 0.95, 0.99] {
        for rest_speed in [0.1, 1e-3, 1.3e-5, 1.3e-6, 1.1e-7, 1e-12] {
            let (fall, mut speed) = ((2.0_f64 / 9.8).sqrt(), 19.6_f64.sqrt());
            let mut expected = fall;
            while speed > rest_speed {
                speed *= e;
                expected += 2.0 * speed / 9.8;
            }
            let found = rest_begins(&dropped(1.0, ContactLaw { rest_speed, ..smooth(e) }), expected + 1.0);
            let error = (found / expected - 1.0).abs();
            assert!(error <= 1e-12, "e = {e}, {rest_speed} m/s: {found} s, not {expected} s, off by {error:e}");
        }
    }
}

#[test]
fn bounces_that_rub_end_though_nothing_may_rest() {
    // With tangential < 1 there is no closed form, and with rest_speed = 0 flights shorter than ulp(t)/(1 − e) would
    // never decay. The effective rest speed ends them: 10 g ulp(t)/(1 − e), or the speed of a hop of four ulp of the
    // coordinates (0.5 m), √(2 g · 4 ε r) = 9.3e-8 m/s, which is larger for these e.
    for e in [0.5, 0.8, 0.95, 0.99] {
        let law = ContactLaw { tangential: 0.99, ..smooth(e) };
        let expected = bouncing_time(1.0, e);
        let found = rest_begins(&dropped(1.0, law), expected + 1.0);
        let rest_speed = (2.0 * 9.8 * 4.0 * EPS * 0.5_f64).sqrt();
        let lost = 2.0 * rest_speed / (9.8 * (1.0 - e));
        assert!((expected - found).abs() <= lost, "e = {e}: {found} s, {:e} s early", expected - found);
    }
}

#[test]
fn equal_masses_swap_their_velocities_to_the_bit() {
    let spheres = vec![ball(-2.0, 3.0, 1.0), ball(1.0, -0.1, 1.0)];
    let mut run = start(&scene(DVec3::ZERO, ELASTIC, Vec::new(), spheres));
    let state = go(&mut run, 2.0);
    // Along an axis the normal is exact; 3 − (3 + 0.1) and back rounds.
    assert_close(state.v[0], DVec3::X * -0.1, 2.0 * EPS * 3.0, "first");
    assert_close(state.v[1], DVec3::X * 3.0, 2.0 * EPS * 3.0, "second");
    assert_eq!(run.tallies().impacts, 1);
}

#[test]
fn an_oblique_impact_on_a_wall_turns_the_normal_part_and_rubs_the_tangential_one() {
    // A wall of 3-4-5, normal (−0.6, 0.8, 0), hit from above and from below; e = 0.7, tangential = 0.9.
    let (n, t) = (dvec3(-0.6, 0.8, 0.0), dvec3(0.8, 0.6, 0.0));
    let law = ContactLaw { wall_restitution: 0.7, restitution: 0.1, tangential: 0.9, rest_speed: 0.1 };
    for side in [1.0, -1.0] {
        let v = n * (-2.0 * side) + t * 0.5 + DVec3::Z * 0.25;
        let body = sphere(n * (1.5 * side), v, 0.5);
        let mut run = start(&scene(DVec3::ZERO, law, vec![wall(DVec3::ZERO, t * 8.0, DVec3::Z * 8.0)], vec![body]));
        let state = go(&mut run, 1.0);
        // The gap of 1 m closes at 2 m/s; a handful of products of numbers under 2 round.
        let after = n * (1.4 * side) + (t * 0.5 + DVec3::Z * 0.25) * 0.9;
        assert_close(state.v[0], after, 8.0 * EPS, "velocity");
        let met = n * (0.5 * side) + (t * 0.5 + DVec3::Z * 0.25) * 0.5;
        assert_close(state.x[0], met + after * 0.5, 8.0 * EPS, "position");
        let hit = rows(&mut run, Class::Collide)[0];
        assert!((hit.time - 0.5).abs() <= 4.0 * EPS && (hit.impulse - 3.4).abs() <= 16.0 * EPS, "{hit:?}");
    }
}

#[test]
fn an_oblique_impact_of_two_spheres_changes_their_normal_parts_alone() {
    // v_a' = v_a + J n / m_a, v_b' = v_b − J n / m_b, J = (1 + e) |v_n| / (1/m_a + 1/m_b); they touch with n at 3-4-5.
    let (n, gap_time) = (dvec3(-0.6, 0.8, 0.0), 0.75);
    let (v_a, v_b) = (dvec3(2.0, -1.0, 0.5), dvec3(-0.5, 0.25, -1.0));
    for (m_a, m_b, e) in [(1.0, 1.0, 1.0), (1.0, 3.0, 0.8), (0.125, 16.0, 0.5), (1e6, 1.0, 0.0), (1.0, 1e6, 0.9)] {
        let law = ContactLaw { restitution: e, wall_restitution: 0.1, tangential: 0.5, rest_speed: 0.0 };
        let a = Sphere { mass: m_a, ..sphere(n - v_a * gap_time, v_a, 0.75) };
        let b = Sphere { mass: m_b, ..sphere(-v_b * gap_time, v_b, 0.25) };
        let mut run = start(&scene(DVec3::ZERO, law, Vec::new(), vec![a, b]));
        let state = go(&mut run, 1.0);
        let v_n = (v_a - v_b).dot(n);
        let j = -(1.0 + e) * v_n / (1.0 / m_a + 1.0 / m_b);
        // Places are rounded at 2 m and the normal is a difference of them over 1 m; speeds are under 4 m/s.
        assert_close(state.v[0], v_a + n * (j / m_a), 64.0 * EPS, "first");
        assert_close(state.v[1], v_b - n * (j / m_b), 64.0 * EPS, "second");
        let hit = rows(&mut run, Class::Collide)[0];
        assert!((hit.time - gap_time).abs() <= 16.0 * EPS && (hit.impulse / j - 1.0).abs() <= 64.0 * EPS, "{hit:?}");
    }
}

#[test]
fn as_many_balls_leave_a_cradle_of_five_touching_ones_as_come_in() {
    // Published: 4, 6 and 6 impacts make it of pairwise sequential handling.
    for (incoming, impacts) in [(1, 4), (2, 6), (3, 6)] {
        let place = |k: usize| if k < incoming { k as f64 - 5.0 } else { k as f64 };
        let speed = |k: usize| if k < incoming { 2.0 } else { 0.0 };
        let spheres = (0..5).map(|k| ball(place(k), speed(k), 1.0)).collect();
        let mut run = start(&scene(DVec3::ZERO, ELASTIC, Vec::new(), spheres));
        let state = go(&mut run, 6.0);
        for k in 0..5 {
            let expected = if k >= 5 - incoming { DVec3::X * 2.0 } else { DVec3::ZERO };
            assert_eq!(state.v[k], expected, "{incoming} in, ball {k}");
        }
        assert_eq!(run.tallies().impacts, impacts, "{incoming} in");
    }
}

#[test]
fn a_cradle_with_gaps_hands_on_half_of_one_plus_e_each_time() {
    // v_n = v₀ ((1 + e) / 2)^(n − 1); the one that hits keeps (1 − e) / 2 of its speed. Each gap is a twentieth of the
    // one before, so that the wave has passed before a ball from behind catches up.
    for e in [0.2, 0.5, 0.8, 0.99, 1.0] {
        let (mut spheres, mut x, mut gap) = (vec![ball(0.0, 2.0, 1.0)], 0.0, 0.5);
        for _ in 1..6 {
            x += 1.0 + gap;
            gap *= 0.05;
            spheres.push(ball(x, 0.0, 1.0));
        }
        let mut run = start(&scene(DVec3::ZERO, smooth(e), Vec::new(), spheres));
        go(&mut run, 5.0);
        let hits = rows(&mut run, Class::Collide);
        for (k, hit) in hits.iter().take(5).enumerate() {
            let speed = 2.0 * (0.5 * (1.0 + e)).powi(k as i32);
            // Each impact rounds the speed a few times.
            let rounding = 8.0 * EPS * (k + 1) as f64;
            assert_eq!(hit.key(), (Kind::Pair, k, k + 1), "e = {e}");
            assert!((hit.approach_speed - speed).abs() <= rounding, "e = {e}: {hit:?}");
            // Equal masses: the impulse is what the next ball gets.
            assert!((hit.impulse - 0.5 * (1.0 + e) * speed).abs() <= rounding, "e = {e}: {hit:?}");
        }
    }
}

/// Galperin 2003: a wall, 1 kg at rest, 100^k kg coming in: ⌊π 10^k⌋ impacts.
const PI_COUNTS: [u64; 5] = [3, 31, 314, 3141, 31415];

#[test]
fn a_heavy_ball_and_a_light_one_at_a_wall_count_the_digits_of_pi() {
    for (k, digits) in PI_COUNTS.into_iter().enumerate() {
        let mass = 100_f64.powi(k as i32);
        let mut run =
            start(&scene(DVec3::ZERO, ELASTIC, vec![stop(0.0)], vec![ball(2.0, 0.0, 1.0), ball(4.0, -1.0, mass)]));
        // After 1 s of approach and the turn, no impact is left a hundred seconds on.
        let state = go(&mut run, 100.0);
        assert_eq!((run.tallies().impacts, run.tallies().collapses), (digits, 0), "mass 100^{k}");
        assert!(state.v[1].x >= state.v[0].x.abs(), "something is still to come: {:?}", state.v);
    }
}

#[test]
fn the_digits_of_pi_are_counted_at_one_instant_too_without_ever_being_taken_for_a_collapse() {
    // Wall and balls touch already: all impacts happen at t = 0, far more than the thousand after which e < 1 rests.
    for (k, digits) in PI_COUNTS.into_iter().enumerate() {
        let mass = 100_f64.powi(k as i32);
        let mut run =
            start(&scene(DVec3::ZERO, ELASTIC, vec![stop(0.0)], vec![ball(0.5, 0.0, 1.0), ball(1.5, -1.0, mass)]));
        let state = go(&mut run, 1.0);
        assert_eq!((run.tallies().impacts, run.tallies().collapses), (digits, 0), "mass 100^{k}");
        // Each impact rounds the energy by an ulp.
        let error = state.energy(run.model()) / run.initial_energy() - 1.0;
        assert!(error.abs() <= EPS * digits as f64, "mass 100^{k}: energy off by {error:e}");
    }
}

#[test]
fn rows_of_three_and_four_collapse_below_the_published_restitutions_and_fly_apart_above() {
    // McNamara, Young 1992: n = 3 below e = 7 − 4√3 = 0.0718, n = 4 below 0.172 (seen between 0.17 and 0.18).
    let rows = [vec![(0.0, 3.0), (2.0, 0.0), (3.5, -1.0)], vec![(0.0, 3.0), (2.0, 1.0), (3.5, -1.0), (5.0, -2.5)]];
    let cases = [(0, 0.0, true), (0, 0.03, true), (0, 0.07, true), (0, 0.08, false), (0, 0.2, false)];
    let more = [(1, 0.05, true), (1, 0.15, true), (1, 0.17, true), (1, 0.18, false), (1, 0.3, false)];
    for (row, e, collapses) in cases.into_iter().chain(more) {
        let spheres: Vec<Sphere> = rows[row].iter().map(|&(x, v)| ball(x, v, 1.0)).collect();
        let mut run = start(&scene(DVec3::ZERO, smooth(e), Vec::new(), spheres));
        let state = go(&mut run, 10.0);
        let count = rows[row].len() as f64;
        let common = rows[row].iter().map(|(_, v)| v).sum::<f64>() / count;
        let momentum: f64 = state.v.iter().map(|v| v.x).sum();
        // Hundreds of impacts at most, whose velocities of 3 m/s and less each round by an ulp.
        assert!((momentum - common * count).abs() <= 1e-13, "e = {e}: {momentum} kg m/s");
        let spread = state.v.iter().map(|v| (v.x - common).abs()).fold(0.0, f64::max);
        // What is left after a collapse is rounding; above, at least the e^(2 · impacts) that ten impacts leave.
        assert_eq!(spread <= 1e-14, collapses, "{count} balls, e = {e}: spread {spread:e} m/s");
        assert!(collapses || state.v.is_sorted_by(|a, b| a.x < b.x), "e = {e}: {:?}", state.v);
    }
}

#[test]
fn every_row_that_runs_into_a_wall_comes_to_rest_or_flies_apart() {
    // Over n and e; the longest take half a million impacts. Collapses leave speeds of 1e-160 m/s, whose squares are 0.
    let few = [4, 5, 6, 8, 10, 12].into_iter().flat_map(|n| (1..=7).map(move |k| (n, 0.1 * f64::from(k))));
    for (count, e) in few.chain([(16, 0.6), (23, 0.7)]) {
        let spheres = (0..count).map(|k| ball(1.5 * f64::from(k), if k == 0 { 2.0 } else { 0.0 }, 1.0)).collect();
        let row = scene(DVec3::ZERO, smooth(e), vec![stop(1.5 * f64::from(count))], spheres);
        let mut run = Simulation::new(&row, Settings { method: Method::Exact, dt: 1e8, tolerance: 1e-3 });
        let mut energy = run.initial_energy();
        for t in [1.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0, 1e3, 1e4, 1e6, 1e8] {
            let state = go(&mut run, t);
            // Overlaps by rounding stay under 1e-12 r, as demanded of every scene.
            assert!(state.x.is_sorted_by(|a, b| b.x - a.x >= 1.0 - 5e-13), "{count} balls, e = {e}: {:?}", state.x);
            let now = state.energy(run.model());
            assert!(now <= energy * (1.0 + 8.0 * EPS), "{count} balls, e = {e}: {energy} J, then {now} J");
            energy = now;
        }
        let state = run.state();
        let apart = state.v.is_sorted_by(|a, b| a.x <= b.x) && state.v[count as usize - 1].x <= 0.0;
        let rests = energy == 0.0 && run.tallies().collapses > 0;
        assert!(rests || apart, "{count} balls, e = {e}: {energy} J, {:?}", state.v);
    }
}

/// A tilted wall of 3-4-5 from its middle: 4 m down the slope, 8 m across, and its directions down and out.
fn slope() -> (Wall, DVec3, DVec3) {
    let (down, out) = (dvec3(0.8, -0.6, 0.0), dvec3(0.6, 0.8, 0.0));
    (wall(DVec3::ZERO, down * 4.0, DVec3::Z * 8.0), down, out)
}

#[test]
fn a_sphere_slides_down_a_tilted_wall_on_a_parabola_and_falls_off_its_edge_on_another() {
    // s = ½ g sin θ t² down and v_z t across. The lower edge is 3 m away: there v² = 2 g sin θ s is far over g r cos θ,
    // so that the edge cannot hold it and it flies.
    let (tilted, down, out) = slope();
    let (origin, across) = (down * -1.0 + out * 0.5, DVec3::Z * 0.25);
    let law = ContactLaw { rest_speed: 0.1, ..smooth(0.5) };
    let mut run = start(&scene(G, law, vec![tilted], vec![sphere(origin, across, 0.5)]));
    let pull = 9.8 * 0.6;
    let edge = (6.0_f64 / pull).sqrt();
    for t in [0.25, 0.5, edge] {
        let state = go(&mut run, t);
        // A handful of roundings of places and speeds under 8 m and 8 m/s.
        assert_close(state.x[0], origin + down * (0.5 * pull * t * t) + across * t, 32.0 * EPS, "place");
        assert_close(state.v[0], down * (pull * t) + across, 32.0 * EPS, "velocity");
    }
    let after = 0.75;
    let (x, v) = (down * 2.0 + out * 0.5 + across * edge, down * (pull * edge) + across);
    let state = go(&mut run, edge + after);
    // The moment at which it leaves is found to 1e-8 s, along a motion that is the same to the second order: the face
    // pushes g cos θ = 7.84 m/s² on one side of it and nothing on the other.
    assert_close(state.x[0], x + v * after + G * (0.5 * after * after), 1e-7, "in flight");
    assert_eq!(run.tallies().impacts, 0);
    let left = rows(&mut run, Class::Release);
    assert!((left[0].time - edge).abs() <= 4.0 * EPS, "left at {} s instead of {edge} s", left[0].time);
}

#[test]
fn a_corner_hit_head_on_sends_the_sphere_back_the_way_it_came() {
    // Towards the corner (2, 0, 2) along −(2, 1, 2)/3, from 2.5 m off: the gap of 2 m closes at 3 m/s.
    let n = dvec3(2.0, 1.0, 2.0) / 3.0;
    for e in [1.0, 0.5] {
        let law = ContactLaw { tangential: 0.5, ..smooth(e) };
        let plate = wall(DVec3::ZERO, DVec3::X * 4.0, DVec3::Z * 4.0);
        let corner = dvec3(2.0, 0.0, 2.0);
        let mut run = start(&scene(DVec3::ZERO, law, vec![plate], vec![sphere(corner + n * 2.5, n * -3.0, 0.5)]));
        let state = go(&mut run, 1.0);
        // The direction of a quartic's root: the normal is known to some ulp of 4 m over 0.5 m.
        assert_close(state.v[0], n * (3.0 * e), 256.0 * EPS, "velocity");
        assert_close(state.x[0], corner + n * (0.5 + e), 256.0 * EPS, "place");
        let hit = rows(&mut run, Class::Collide)[0];
        assert!((hit.time - 2.0 / 3.0).abs() <= 64.0 * EPS, "at {} s", hit.time);
        assert_close(hit.point, corner, 16.0 * EPS, "contact point");
    }
}

#[test]
fn an_edge_reflects_about_the_line_from_it_to_the_centre() {
    // Falls 0.3 m beside the edge of a shelf: touches with n at 3-4-5, so v_n = −0.8 and v' = v + (1 + e) 0.8 n.
    let shelf = wall(dvec3(-2.0, 0.0, 0.0), DVec3::X * 4.0, DVec3::Z * 4.0);
    let n = dvec3(0.6, 0.8, 0.0);
    for (e, e_pair) in [(1.0, 0.0), (0.5, 1.0)] {
        let law = ContactLaw { restitution: e_pair, ..smooth(e) };
        let body = sphere(dvec3(0.3, 1.4, 0.5), DVec3::NEG_Y, 0.5);
        let mut run = start(&scene(DVec3::ZERO, law, vec![shelf.clone()], vec![body]));
        let state = go(&mut run, 1.5);
        let after = DVec3::NEG_Y + n * ((1.0 + e) * 0.8);
        // The normal is known to an ulp of 1.4 m over 0.5 m.
        assert_close(state.v[0], after, 32.0 * EPS, "velocity");
        assert_close(state.x[0], dvec3(0.3, 0.4, 0.5) + after * 0.5, 32.0 * EPS, "place");
    }
}
