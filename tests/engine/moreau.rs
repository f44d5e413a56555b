//! Crowds by velocity-level time-stepping: what it promises of drops, impacts, rest, piles, and of its own solver.

use crate::support::{
    ELASTIC, G, PAPER_LAW, changed, floor, gas, lattice, moved, pyramid, recorded, room, run_to, scene, sphere, still,
    wall,
};
use carom::audit::{Fault, Judge};
use carom::physics::{Class, Contact, Kind, Method, Scene, Settings, Simulation, StallKind, Until};
use carom::scene::{ContactLaw, Sphere, Wall};
use glam::{DVec3, dvec3};

/// Impacts lose half of the approach speed.
const HALF: ContactLaw = ContactLaw { restitution: 0.5, wall_restitution: 0.5, ..PAPER_LAW };

fn moreau(dt: f64, tolerance: f64) -> Settings {
    Settings { method: Method::Moreau, dt, tolerance }
}

fn start(scene: &Scene, dt: f64, tolerance: f64) -> Simulation {
    recorded(scene, moreau(dt, tolerance))
}

/// A tube of square section, as wide as a sphere, and its floor.
fn tube() -> Vec<Wall> {
    room(dvec3(-0.5, 0.0, -0.5), dvec3(0.5, 30.0, 0.5))
}

/// Σ penetration² over all pairs and walls, m², and the deepest penetration, m.
fn penetration(scene: &Scene, x: &[DVec3]) -> (f64, f64) {
    let mut gaps = Vec::new();
    for (i, a) in scene.spheres.iter().enumerate() {
        gaps.extend(scene.walls.iter().map(|wall| wall.shape.distance(x[i]) - a.radius));
        let others = scene.spheres.iter().enumerate().skip(i + 1);
        gaps.extend(others.map(|(j, b)| x[i].distance(x[j]) - (a.radius + b.radius)));
    }
    let depths = gaps.into_iter().map(|gap| (-gap).max(0.0));
    depths.fold((0.0, 0.0), |(sum, deepest), depth| (sum + depth * depth, depth.max(deepest)))
}

/// Gap of a contact, m.
fn gap(scene: &Scene, contact: &Contact) -> f64 {
    let of = |i: usize| scene.spheres[i].radius;
    -contact.degree * (of(contact.a) + if contact.kind == Kind::Pair { of(contact.b) } else { 0.0 })
}

fn of_class(events: &[Contact], class: Class) -> Vec<&Contact> {
    events.iter().filter(|event| event.class == class).collect()
}

#[test]
fn a_drop_falls_by_g_t_times_t_plus_dt_over_two() {
    let mut run = start(&scene(G, PAPER_LAW, Vec::new(), vec![still(DVec3::Y * 100.0)]), 0.01, 1e-3);
    for k in 1..=1000 {
        run.advance(Until::Frame, u64::MAX);
        let t = f64::from(k) * 0.01;
        // A thousand roundings of coordinates up to 400 m.
        assert!((run.state().x[0].y - (100.0 - 4.9 * t * (t + 0.01))).abs() < 1e-10, "t {t}");
    }
}

#[test]
fn an_impact_leaves_with_e_times_its_approach_speed_and_its_share_of_the_tangential_one() {
    let bodies = vec![sphere(DVec3::Y * 3.0, dvec3(1.0, 0.0, 0.0), 0.5)];
    let mut run = start(&scene(G, PAPER_LAW, vec![floor(20.0)], bodies), 0.001, 1e-3);
    run_to(&mut run, 3.0, u64::MAX);
    let events = run.take_events();
    let impacts = of_class(&events, Class::Collide);
    assert!(impacts.len() >= 3, "{} impacts", impacts.len());
    for impact in &impacts {
        // One row is solved to rounding by one sweep.
        assert!((impact.separation_speed / impact.approach_speed - 0.8).abs() < 1e-12, "{impact:?}");
    }
    // v = √(2 · 9.8 · 2.5) = 7 m/s; a frame's fall is missing, and half a frame's of Euler's.
    assert!((impacts[0].approach_speed - 7.0).abs() < 0.015, "{}", impacts[0].approach_speed);
    let kept = 0.99_f64.powi(impacts.len() as i32);
    assert!((run.state().v[0].x - kept).abs() < 1e-12, "{} after {} impacts", run.state().v[0].x, impacts.len());
}

#[test]
fn a_pair_shares_its_momentum_by_newton_s_law() {
    let mut heavy = sphere(dvec3(-2.0, 0.0, 0.0), dvec3(3.0, 0.0, 0.0), 0.5);
    heavy.mass = 2.0;
    let bodies = vec![heavy, still(DVec3::ZERO)];
    let mut run = start(&scene(DVec3::ZERO, PAPER_LAW, Vec::new(), bodies), 0.01, 1e-3);
    run_to(&mut run, 1.0, u64::MAX);
    // v_a = (m_a − e m_b) v / (m_a + m_b), v_b = (1 + e) m_a v / (m_a + m_b).
    let v = run.state().v;
    assert!((v[0].x - 1.2).abs() < 1e-14 && (v[1].x - 3.6).abs() < 1e-14, "{v:?}");
    assert_eq!(run.tallies().impacts, 1);
}

#[test]
fn forty_nine_balls_bounce_four_hundred_and_ninety_times_and_back_to_their_height() {
    let scene = carom::scene::open("bouncing-49").expect("a built-in scene").scene;
    let mut run = start(&scene, 0.001, 1e-3);
    let (mut least, mut most) = (0.0_f64, 0.0_f64);
    while run.time() < 20.0 {
        run.advance(Until::Frame, u64::MAX);
        let error = run.energy() / run.initial_energy() - 1.0;
        (least, most) = (least.min(error), most.max(error));
    }
    assert_eq!(run.tallies().impacts, 490);
    // Euler's frames sway by g v dt/2 per kilogram, 9.4e-4 of the energy at the largest speed, and forget nothing.
    assert!(least > -1e-3 && most < 1e-3, "{least:e} … {most:e}");
}

#[test]
fn no_impact_of_a_gas_creates_energy_whatever_a_frame_holds() {
    for restitution in [0.0, 0.5, 1.0] {
        let law = ContactLaw { restitution, wall_restitution: restitution, ..ELASTIC };
        let gas = changed(&gas(500, 3, 1.0), |draft| draft.contact = law);
        // A sphere goes about its own radius in a frame: several impacts of it at once.
        let mut run = start(&gas, 0.05, 1e-6);
        let mut before = run.energy();
        for _ in 0..200 {
            run.advance(Until::Frame, u64::MAX);
            // Five hundred squares are summed.
            assert!(run.energy() <= before * (1.0 + 1e-10), "e {restitution}: {} after {before} J", run.energy());
            before = run.energy();
        }
        let (_, deepest) = penetration(&gas, &run.state().x);
        assert!(deepest < 1e-6, "e {restitution}: {deepest:e} m");
        // What several impacts in a frame would gain is withheld, what they lose is lost: in 10 s, not much at this dt.
        assert!(restitution < 1.0 || before > 0.7 * run.initial_energy(), "{before} of {} J", run.initial_energy());
    }
}

#[test]
fn a_column_of_ten_carries_its_weight_contact_by_contact() {
    let spheres = (0..10).map(|k| still(dvec3(0.0, 0.5 + f64::from(k), 0.0))).collect();
    let mut run = start(&scene(G, PAPER_LAW, vec![floor(20.0)], spheres), 0.01, 0.0);
    run_to(&mut run, 10.0, u64::MAX);
    assert_eq!(run.contacts().len(), 10);
    for contact in run.contacts() {
        let above = 10 - if contact.kind == Kind::Wall { 0 } else { contact.b };
        let weight = above as f64 * 9.8;
        assert_eq!(contact.class, Class::Rest);
        // Tolerance 0 is rounding.
        assert!((contact.impulse / 0.01 / weight - 1.0).abs() < 1e-9, "{contact:?}");
    }
    let tallies = run.tallies();
    assert_eq!((tallies.impacts, tallies.rests, tallies.releases, tallies.unconverged), (0, 10, 0, 0));
}

#[test]
fn ten_spheres_dropped_in_a_tube_come_to_rest_on_each_other() {
    let spheres = (0..10).map(|k| still(dvec3(0.0, 0.6 + 1.1 * f64::from(k), 0.0))).collect();
    let scene = scene(G, HALF, tube(), spheres);
    for dt in [0.1, 0.01, 0.001] {
        let mut run = start(&scene, dt, 1e-9);
        run_to(&mut run, 10.0, u64::MAX);
        for (k, x) in run.state().x.iter().enumerate() {
            // The solver may leave 1e-9 of rest_speed + 2 g dt in every contact.
            let left = 1e-9 * (0.1 + 19.6 * dt) * dt * (k + 1) as f64;
            assert!((*x - dvec3(0.0, 0.5 + k as f64, 0.0)).length() <= left, "dt {dt}: sphere {k} at {x}");
        }
        assert_eq!(run.tallies().unconverged, 0, "dt {dt}");
    }
}

#[test]
fn a_heavy_sphere_on_light_ones_does_not_crush_them() {
    for mass in [1e4, 1e8, 1e12] {
        let mut spheres: Vec<_> = (0..10).map(|k| still(dvec3(0.0, 0.5 + f64::from(k), 0.0))).collect();
        spheres[9].mass = mass;
        let scene = scene(G, PAPER_LAW, tube(), spheres);
        let mut run = start(&scene, 0.01, 1e-6);
        run_to(&mut run, 10.0, u64::MAX);
        let (_, deepest) = penetration(&scene, &run.state().x);
        // 1e12 of 1 kg leave four digits of the light ones' accelerations, over a hundredth of a second.
        assert!(deepest < 1e-8, "{mass:e} kg: {deepest:e} m");
        assert_eq!(run.tallies().unconverged, 0, "{mass:e} kg");
    }
}

#[test]
fn a_pyramid_with_gaps_settles_and_then_does_not_drift() {
    let scene = pyramid(4, 1e-4, HALF);
    let mut run = start(&scene, 0.01, 1e-8);
    run_to(&mut run, 20.0, u64::MAX);
    let settled = run.state();
    run_to(&mut run, 100.0, u64::MAX);
    let after = run.state();
    let drift = after.x.iter().zip(&settled.x).map(|(x, y)| x.distance(*y)).fold(0.0, f64::max);
    assert!(drift <= 1e-12, "drifted by {drift:e} m");
    // What the solver may leave: 1e-8 of rest_speed + 2 g dt, over a frame.
    assert!(penetration(&scene, &after.x).1 <= 3e-11, "{:e} m deep", penetration(&scene, &after.x).1);
    assert_eq!(run.tallies().unconverged, 0);
}

#[test]
fn inelastic_666_settles_without_overlap_or_gap_in_counted_work() {
    let scene = carom::scene::open("inelastic-666").expect("a built-in scene").scene;
    assert_eq!(scene.solver.method, Method::Moreau);
    let mut run = Simulation::new(&scene, scene.solver);
    let (mut squares, mut deepest) = (0.0, 0.0_f64);
    while run.time() < 10.0 {
        run.advance(Until::Frame, u64::MAX);
        let (sum, most) = penetration(&scene, &run.state().x);
        (squares, deepest) = (squares + sum, deepest.max(most));
    }
    let tallies = run.tallies();
    let mean = squares / tallies.frames as f64;
    // Targets of the scene, far above rounding.
    assert!(mean <= 1e-18 && deepest <= 1e-9, "Σ penetration² {mean:e} m², deepest {deepest:e} m");
    let resting = run.contacts().iter().filter(|contact| contact.class == Class::Rest);
    let widest = resting.map(|contact| gap(&scene, contact)).fold(0.0, f64::max);
    assert!(widest <= 1e-9 && run.contacts().len() >= 216, "{widest:e} m between {} contacts", run.contacts().len());
    assert_eq!(tallies.unconverged, 0);
    // What a row costs, some ten nanoseconds, makes this 0.2 s.
    assert!(tallies.relaxations + tallies.evaluations < 20_000_000, "{tallies:?}");
}

#[test]
fn a_solver_that_has_not_converged_says_so() {
    // Eight layers have a thousand contacts, too many for the direct solver, and sweeping cannot lift such a mass.
    let scene = pyramid(8, 0.0, HALF);
    let heavy = changed(&scene, |draft| draft.spheres.last_mut().expect("a top").mass = 1e8);
    let mut run = start(&heavy, 0.01, 1e-3);
    run_to(&mut run, 0.05, u64::MAX);
    assert!(run.tallies().unconverged >= 4, "{:?}", run.tallies());
    let mut run = start(&scene, 0.01, 1e-3);
    run_to(&mut run, 0.05, u64::MAX);
    assert_eq!(run.tallies().unconverged, 0);
}

#[test]
fn a_sphere_that_slides_off_its_table_rests_once_and_is_released_once() {
    let table = wall(DVec3::ZERO, DVec3::X * 2.0, DVec3::NEG_Z * 2.0);
    let mut run = start(&scene(G, PAPER_LAW, vec![table], vec![sphere(DVec3::Y * 0.5, DVec3::X, 0.5)]), 0.01, 1e-3);
    run_to(&mut run, 3.0, u64::MAX);
    let events = run.take_events();
    let classes: Vec<_> = events.iter().map(|event| event.class).collect();
    assert_eq!(classes, [Class::Rest, Class::Release], "{events:?}");
    assert_eq!(events[0].time, 0.0);
    // Over the edge after 1 s; then it rolls over it, and leaves when that is too slow to be held down.
    assert!(events[1].time > 1.0 && events[1].time < 2.0 && run.state().x[0].y < 0.0, "{events:?}");
}

#[test]
fn an_impact_without_rebound_is_one_event_and_then_rests() {
    let law = ContactLaw { restitution: 0.0, wall_restitution: 0.0, ..PAPER_LAW };
    let mut run = start(&scene(G, law, vec![floor(20.0)], vec![still(DVec3::Y * 3.0)]), 0.01, 1e-3);
    run_to(&mut run, 2.0, u64::MAX);
    let events = run.take_events();
    let classes: Vec<_> = events.iter().map(|event| event.class).collect();
    assert_eq!(classes, [Class::Collide, Class::Rest], "{events:?}");
    // Tolerance 1e-3 of the speeds at hand over one frame, taken back by the next: rounding is left.
    assert!((run.state().x[0].y - 0.5).abs() < 1e-12, "{}", run.state().x[0].y);
}

#[test]
fn slices_of_any_size_and_a_continued_run_make_the_same_bits() {
    let scene = carom::scene::open("inelastic-666").expect("a built-in scene").scene;
    let whole = |until: f64| {
        let mut run = Simulation::new(&scene, scene.solver);
        run_to(&mut run, until, u64::MAX);
        run
    };
    let end = whole(1.0).state().hash();
    for work in [1, 777, 20_000] {
        let mut run = Simulation::new(&scene, scene.solver);
        run_to(&mut run, 1.0, work);
        assert_eq!(run.state().hash(), end, "slices of {work}");
    }
    // 0.55 s: the heap has just struck the ground.
    for stop in [0.0, 0.3, 0.55, 0.8] {
        let run = whole(stop);
        let mut again = Simulation::resumed(&moved(&scene, &run.state()), run.settings(), run.time(), &run.transient());
        run_to(&mut again, 1.0, u64::MAX);
        assert_eq!(again.state().hash(), end, "continued from {stop} s");
    }
}

#[test]
fn a_frame_is_a_whole_dt_and_is_read_on_the_straight_line_between_its_ends() {
    let scene = pyramid(3, 1e-3, HALF);
    let mut run = start(&scene, 0.01, 1e-6);
    for _ in 0..100 {
        let before = run.state();
        run.advance(Until::Frame, u64::MAX);
        let (after, middle) = (run.state(), run.at(before.t + 0.005));
        assert_eq!((run.step(), after.t), (0.01, before.t + 0.01));
        assert_eq!((run.at(before.t), run.at(after.t)), (before.clone(), after.clone()));
        for i in 0..after.x.len() {
            // Coordinates of some metres.
            assert!((middle.x[i] - 0.5 * (before.x[i] + after.x[i])).length() < 1e-14);
        }
    }
}

#[test]
fn a_state_within_a_frame_and_what_is_hidden_of_its_energy_make_that_of_the_frame_s_end() {
    let falling: Vec<Sphere> = lattice(3, 1.1, dvec3(1.0, -5.0, 0.5), 0.5);
    let scene = scene(G, HALF, room(DVec3::splat(-9.0), DVec3::splat(9.0)), falling);
    let mut run = start(&scene, 0.01, 1e-3);
    for _ in 0..300 {
        run.advance(Until::Frame, u64::MAX);
        let (end, energy) = (run.time(), run.state().energy(run.model()));
        for share in [0.01, 0.3, 0.7, 0.99] {
            let state = run.at(end - 0.01 * share);
            let within = state.energy(run.model()) + run.hidden_energy_at(&state);
            // Rounding of some 1e4 J.
            assert!((within - energy).abs() <= 1e-10, "{within} J in the frame to {end} s, {energy} J at its end");
        }
    }
}

#[test]
fn bodies_that_have_parted_since_the_last_frame_collide_again() {
    // The second strikes the first, which is 1 mm away at the frame's end, bounces off the wall and meets the second at 5 m/s.
    let law = ContactLaw { restitution: 0.1, wall_restitution: 1.0, tangential: 1.0, rest_speed: 0.1 };
    let board = wall(DVec3::ZERO, DVec3::Y, DVec3::Z);
    let spheres = vec![
        sphere(dvec3(0.104, 0.0, 0.0), DVec3::ZERO, 0.1),
        sphere(dvec3(0.3045, 0.0, 0.0), dvec3(-5.0, 0.0, 0.0), 0.1),
    ];
    let mut run = start(&scene(DVec3::ZERO, law, vec![board], spheres), 1e-3, 1e-6);
    let mut speeds = Vec::new();
    for _ in 0..3 {
        run.advance(Until::Frame, u64::MAX);
        assert!(run.contacts().iter().all(|row| row.class == Class::Collide), "{:?}", run.contacts());
        speeds.extend(run.contacts().iter().filter(|row| row.kind == Kind::Pair).map(|row| row.approach_speed));
    }
    assert_eq!(speeds.len(), 2, "{speeds:?}");
    // 5 (1 + 0.1)/2 back from the wall and 5 (1 − 0.1)/2 onwards; rounding of a few operations.
    assert!((speeds[1] - 5.0).abs() < 1e-13, "{speeds:?}");
}

#[test]
fn a_frame_in_which_everything_may_meet_is_refused_by_count_and_names_dt() {
    // 9261 spheres that fall 490 m in a frame: 4e7 pairs, a gigabyte of them.
    let below = wall(DVec3::NEG_Y * 25.5, DVec3::X * 20.0, DVec3::NEG_Z * 20.0);
    let crowd = scene(G, HALF, vec![below], lattice(21, 2.5, DVec3::ZERO, 0.5));
    let stalled = |work: u64| {
        let mut run = start(&crowd, 10.0, 1e-3);
        let stall = run_to(&mut run, 10.0, work).expect("a stall");
        (stall, run.tallies().evaluations)
    };
    let (stall, evaluations) = stalled(u64::MAX);
    assert_eq!((stall.kind, stall.time), (StallKind::StepTooLarge, 0.0));
    for word in ["10 s", "smaller dt", "1344928 pairs"] {
        assert!(stall.reason.contains(word), "{word:?} is not in {:?}", stall.reason);
    }
    assert_eq!(stalled(1000), (stall, evaluations));
    // Two million distances to find one and a third that are near: it does not look at all of the 4e7.
    assert!(evaluations < 10_000_000, "{evaluations}");
    let mut run = start(&crowd, 0.01, 1e-3);
    assert_eq!(run_to(&mut run, 0.02, u64::MAX), None);
}

#[test]
fn heaps_that_settle_pass_the_judge() {
    for (name, until) in [("inelastic-666", 0.6), ("galton", 2.5)] {
        let scene = carom::scene::open(name).expect("a built-in scene").scene;
        let mut run = start(&scene, scene.solver.dt.min(0.01), 1e-3);
        let mut judge = Judge::of(&run);
        while run.time() < until {
            run.advance(Until::Frame, u64::MAX);
            let events = run.take_events();
            judge.frame(&run, &events);
        }
        // a contact that is about to rest may still be open by a little more than the tolerance
        let rows = judge.findings().rows();
        let found: Vec<_> = rows.iter().filter(|finding| finding.fault != Fault::RestGap).collect();
        assert!(found.is_empty(), "{name}: {}", found[0]);
    }
}
