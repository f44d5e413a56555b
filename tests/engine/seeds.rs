//! What the owner asked for: the source paper's sentences and formulas, a test each.

use crate::support::{self, ELASTIC, G, PAPER_LAW, changed, floor, paper, run_to, scene, sphere, wall};
use carom::physics::overlap::{pair_touch, wall_touch};
use carom::physics::wall::Face;
use carom::physics::{Class, Contact, ContactLaw, Kind, Method, Progress, Scene, Simulation, Until, describe};
use glam::{DVec3, dvec3};

/// A sphere of radius 0.5 m that touches the floor at t = 0.
fn on_floor(gravity: DVec3, v: DVec3) -> Scene {
    scene(gravity, PAPER_LAW, vec![floor(20.0)], vec![sphere(DVec3::Y * 0.5, v, 0.5)])
}

/// Two spheres of radius 0.5 m that touch at t = 0 along x, with these masses and velocities.
fn touching_pair(law: ContactLaw, masses: [f64; 2], v: [DVec3; 2]) -> Scene {
    let mut spheres = vec![sphere(DVec3::ZERO, v[0], 0.5), sphere(DVec3::X, v[1], 0.5)];
    (spheres[0].mass, spheres[1].mass) = (masses[0], masses[1]);
    scene(DVec3::ZERO, law, Vec::new(), spheres)
}

/// Runs so many frames.
fn frames(run: &mut Simulation, count: usize) {
    for _ in 0..count {
        assert_eq!(run.advance(Until::Frame, u64::MAX), Progress::Reached);
    }
}

fn after_one_frame(scene: &Scene) -> Vec<DVec3> {
    let mut run = Simulation::new(scene, paper(0.01, 1e-3));
    frames(&mut run, 1);
    run.state().v
}

/// Products and sums of a handful of numbers of size 1 to 10 round by less than this.
const ROUNDING: f64 = 1e-14;

fn assert_close(found: DVec3, expected: DVec3) {
    assert!((found - expected).length() <= ROUNDING, "{found} instead of {expected}");
}

#[test]
fn forward_adds_the_forces_to_the_momentum_then_moves_by_the_new_velocity() {
    let mut body = sphere(dvec3(1.0, 2.0, 3.0), dvec3(4.0, 5.0, 6.0), 0.5);
    (body.mass, body.force) = (2.0, dvec3(1.0, 0.0, -3.0));
    let mut run = Simulation::new(&scene(G, PAPER_LAW, Vec::new(), vec![body.clone()]), paper(0.25, 1e-3));
    frames(&mut run, 1);
    let v = body.v + (G + body.force / 2.0) * 0.25;
    assert_eq!((run.state().v[0], run.state().x[0]), (v, body.x + v * 0.25));
    assert_eq!((run.time(), run.step()), (0.25, 0.25));
}

#[test]
fn a_transient_force_is_cleared_as_soon_as_the_update_is_done() {
    let mut run = Simulation::new(&on_floor(DVec3::ZERO, dvec3(0.0, -2.0, 0.0)), paper(0.01, 1e-3));
    let impulses = |run: &Simulation| run.transient()[..1].to_vec(); // the last row is the watchdog's
    assert_eq!(impulses(&run), [dvec3(0.0, 3.6, 0.0)]);
    frames(&mut run, 1);
    let v = run.state().v;
    assert_eq!(impulses(&run), [DVec3::ZERO]);
    frames(&mut run, 3);
    assert_eq!(run.state().v, v);
}

#[test]
fn the_impulse_acts_in_full_however_short_the_next_frame_is() {
    // The second sphere is 1 mm over the floor: the first frame is cut short there, a tenth of the way.
    let walls = vec![floor(20.0)];
    let spheres =
        vec![sphere(dvec3(-3.0, 0.5, 0.0), DVec3::NEG_Y, 0.5), sphere(dvec3(3.0, 0.501, 0.0), DVec3::NEG_Y, 0.5)];
    let mut run = Simulation::new(&scene(DVec3::ZERO, PAPER_LAW, walls, spheres), paper(0.01, 1e-3));
    frames(&mut run, 1);
    assert!(run.step() < 0.002, "{}", run.step());
    assert_close(run.state().v[0], dvec3(0.0, 0.8, 0.0));
}

#[test]
fn the_degree_of_a_wall_is_one_minus_distance_over_radius_at_face_edge_and_corner() {
    let plate = Face::new(wall(DVec3::ZERO, DVec3::X * 2.0, DVec3::NEG_Z * 2.0).shape);
    let cases = [
        (dvec3(0.3, 0.4, -0.2), 0.4, DVec3::Y),
        (dvec3(0.3, -0.4, -0.2), 0.4, DVec3::NEG_Y),
        (dvec3(1.3, 0.4, 0.0), 0.5, dvec3(0.6, 0.8, 0.0)),
        (dvec3(1.2, 0.1, 1.2), 0.3, dvec3(2.0, 1.0, 2.0) / 3.0),
    ];
    for (x, distance, normal) in cases {
        let touch = wall_touch(&plate, x, x, 0.5);
        assert!((touch.degree - (1.0 - distance / 0.5)).abs() <= ROUNDING, "at {x}: {}", touch.degree);
        assert_close(touch.normal, normal);
        assert_close(touch.point, x - normal * distance);
    }
}

#[test]
fn the_degree_of_a_pair_is_one_minus_distance_over_the_sum_of_radii() {
    let touch = pair_touch(dvec3(0.0, 1.2, 0.0), DVec3::ZERO, 0.5, 1.0);
    assert!((touch.degree - (1.0 - 1.2 / 1.5)).abs() <= ROUNDING);
    assert_eq!(touch.normal, DVec3::Y);
    assert_close(touch.point, dvec3(0.0, 0.85, 0.0));
}

#[test]
fn the_side_of_a_wall_is_the_one_where_the_frame_began() {
    let plate = Face::new(wall(DVec3::ZERO, DVec3::X * 2.0, DVec3::NEG_Z * 2.0).shape);
    let through = wall_touch(&plate, dvec3(0.0, 3.0, 0.0), dvec3(0.0, -0.1, 0.0), 0.5);
    assert_eq!((through.degree, through.normal), (1.2, DVec3::Y));
    // The way around the edge is no way through.
    let around = wall_touch(&plate, dvec3(3.0, -0.5, 0.0), dvec3(0.9, 0.1, 0.0), 0.5);
    assert_eq!((around.degree, around.normal), (0.8, DVec3::Y));
}

#[test]
fn bisection_ends_when_the_degree_lies_within_the_tolerance_plus_the_printed_slack() {
    for tolerance in [1e-1, 1e-3, 1e-6, 0.0] {
        let body = sphere(dvec3(0.0, 0.53, 0.0), dvec3(0.0, -5.0, 0.0), 0.5);
        let mut run = Simulation::new(&scene(G, PAPER_LAW, vec![floor(20.0)], vec![body]), paper(0.01, tolerance));
        frames(&mut run, 1);
        let contact = run.contacts()[0];
        let accepted = tolerance + 1e-4;
        assert!(contact.degree > 0.0 && contact.degree <= accepted, "tolerance {tolerance}: {}", contact.degree);
        if let Some((last, earlier)) = run.probes().split_last() {
            assert_eq!((last.step, last.degree), (run.step(), contact.degree));
            assert!(earlier.iter().all(|p| p.degree <= 0.0 || p.degree > accepted));
            // Each trial step lies in the middle of what the earlier ones left.
            let mut ends = [0.0, 0.01];
            for pair in run.probes().windows(2) {
                ends[usize::from(pair[0].degree > accepted)] = pair[0].step;
                assert_eq!(pair[1].step, 0.5 * (ends[0] + ends[1]));
            }
        }
    }
}

#[test]
fn a_frame_that_ends_at_a_collision_has_lasted_only_until_then() {
    let mut run = Simulation::new(&support::paper_scene(1), paper(0.01, 1e-3));
    let mut cut = 0;
    for _ in 0..500 {
        let before = run.time();
        frames(&mut run, 1);
        assert_eq!(run.time(), before + run.step());
        cut += usize::from(run.step() < 0.01);
    }
    assert!(cut > 5, "{cut} frames cut short");
}

#[test]
fn the_response_is_threefold_with_thresholds_of_a_tenth_of_a_metre_per_second() {
    let expected = [
        (-5.0, Class::Collide),
        (-0.1001, Class::Collide),
        (-0.1, Class::Rest),
        (-0.05, Class::Rest),
        (0.0, Class::Rest),
        (0.1, Class::Rest),
        (0.1001, Class::Leave),
    ];
    for (v_n, class) in expected {
        let run = Simulation::new(&on_floor(G, DVec3::Y * v_n), paper(0.01, 1e-3));
        let contact = run.contacts()[0];
        assert_eq!((contact.class, contact.approach_speed), (class, -v_n));
    }
}

#[test]
fn a_wall_turns_the_normal_velocity_to_minus_four_fifths_and_takes_one_percent_of_the_tangential() {
    let v = after_one_frame(&on_floor(DVec3::ZERO, dvec3(3.0, -2.0, 1.0)));
    assert_close(v[0], dvec3(2.97, 1.6, 0.99));
}

#[test]
fn walls_may_have_a_restitution_of_their_own() {
    let floor = on_floor(DVec3::ZERO, dvec3(0.0, -2.0, 0.0));
    let scene = changed(&floor, |draft| draft.contact.wall_restitution = 0.5);
    assert_close(after_one_frame(&scene)[0], DVec3::Y);
}

#[test]
fn a_pair_parts_with_four_fifths_of_its_approach_speed_and_keeps_its_momentum() {
    // F once on each ball (the report's F/2 twice): F/2 once would leave 10 % of the approach speed.
    let masses = [1.0, 3.0];
    let v = [dvec3(2.0, 0.5, 0.0), dvec3(-1.0, 0.0, 0.25)];
    let after = after_one_frame(&touching_pair(PAPER_LAW, masses, v));
    assert_close(after[0] * masses[0] + after[1] * masses[1], v[0] * masses[0] + v[1] * masses[1]);
    assert!(((after[1] - after[0]).x - 0.8 * 3.0).abs() <= ROUNDING);
    assert_close(after[0].with_x(0.0), v[0].with_x(0.0));
}

#[test]
fn equal_elastic_spheres_swap_their_velocities_head_on() {
    let v = [DVec3::X * 1.5, DVec3::X * -0.5];
    assert_eq!(after_one_frame(&touching_pair(ELASTIC, [1.0, 1.0], v)), [v[1], v[0]]);
}

#[test]
fn a_support_force_cancels_what_presses_and_nothing_else() {
    // A slope of 3 : 4, and a sphere at rest on it: it slides with g sin θ along the slope.
    let (along, up) = (dvec3(0.8, 0.6, 0.0), dvec3(-0.6, 0.8, 0.0));
    let slope = wall(DVec3::ZERO, along * 20.0, DVec3::NEG_Z * 20.0);
    let resting = scene(G, PAPER_LAW, vec![slope], vec![sphere(up * 0.5, DVec3::ZERO, 0.5)]);
    assert_close(after_one_frame(&resting)[0], along * (-9.8 * 0.6 * 0.01));
    // A ceiling holds nothing.
    let ceiling = wall(DVec3::ZERO, DVec3::X * 20.0, DVec3::Z * 20.0);
    let hanging = scene(G, PAPER_LAW, vec![ceiling], vec![sphere(DVec3::Y * -0.5, DVec3::ZERO, 0.5)]);
    assert_eq!(after_one_frame(&hanging), [G * 0.01]);
}

#[test]
fn a_resting_normal_velocity_becomes_zero() {
    let mut run = Simulation::new(&on_floor(G, dvec3(1.0, -0.05, 0.0)), paper(0.01, 1e-3));
    frames(&mut run, 1);
    assert_eq!(run.state().v, [DVec3::X]);
    assert!(run_to(&mut run, 5.0, u64::MAX).is_none());
    assert_eq!((run.state().v[0], run.state().x[0].y), (DVec3::X, 0.5));
}

#[test]
fn a_sphere_that_touches_at_load_is_in_contact_and_one_a_hair_away_is_not() {
    let at = |y: f64| {
        let body = sphere(DVec3::Y * y, DVec3::NEG_Y, 0.5);
        Simulation::new(&scene(G, PAPER_LAW, vec![floor(20.0)], vec![body]), paper(0.01, 1e-3)).contacts().len()
    };
    assert_eq!([at(0.5), at(0.5 + 1e-13), at(0.5 + 1e-11)], [1, 1, 0]);
}

#[test]
fn walls_come_before_pairs_and_all_in_the_order_of_their_numbers() {
    let spheres = [2.0, 0.0, 1.0].map(|x| sphere(dvec3(x, 0.5, 0.0), DVec3::NEG_Y, 0.5));
    let run = Simulation::new(&scene(G, PAPER_LAW, vec![floor(20.0)], spheres.to_vec()), paper(0.01, 1e-3));
    let order: Vec<_> = run.contacts().iter().map(Contact::key).collect();
    let expected = [(Kind::Wall, 0, 0), (Kind::Wall, 1, 0), (Kind::Wall, 2, 0), (Kind::Pair, 0, 2), (Kind::Pair, 1, 2)];
    assert_eq!(order, expected);
}

#[test]
fn tolerances_above_one_half_count_as_one_half() {
    let state = |tolerance| {
        let mut run = Simulation::new(&support::paper_scene(0), paper(0.01, tolerance));
        run_to(&mut run, 3.0, u64::MAX);
        run.state()
    };
    assert_eq!(state(0.5), state(7.0));
}

#[test]
fn overlap_from_before_the_tolerance_was_lowered_is_allowed_until_it_ends() {
    // It falls slowly enough to rest at once, 4 mm deep.
    let body = sphere(dvec3(0.0, 0.505, 0.0), dvec3(0.1, -0.09, 0.0), 0.5);
    let mut run = Simulation::new(&scene(G * 1e-3, PAPER_LAW, vec![floor(20.0)], vec![body]), paper(0.1, 0.2));
    assert!(run_to(&mut run, 1.0, u64::MAX).is_none());
    let deep = run.contacts()[0].degree;
    assert!(deep > 1e-3, "{deep}");
    run.set_settings(paper(0.1, 1e-6));
    for _ in 0..100 {
        frames(&mut run, 1);
        // It neither sinks nor cuts a frame short.
        assert!((run.contacts()[0].degree - deep).abs() < ROUNDING);
        assert_eq!(run.step(), 0.1);
    }
}

#[test]
fn a_contact_rests_once_and_is_released_once() {
    // Over the edge of a table: rest begins at load, and ends where the table does.
    let table = wall(dvec3(0.0, 0.0, 0.0), DVec3::X * 2.0, DVec3::NEG_Z * 2.0);
    let body = sphere(DVec3::Y * 0.5, DVec3::X, 0.5);
    let mut run = Simulation::new(&scene(G, PAPER_LAW, vec![table], vec![body]), paper(0.01, 1e-3));
    run.record_events(true);
    assert!(run_to(&mut run, 2.0, u64::MAX).is_none());
    let events = run.take_events();
    assert_eq!((events[0].class, events[0].time), (Class::Rest, 0.0));
    let count = |class| events.iter().filter(|e| e.class == class).count() as u64;
    assert_eq!(count(Class::Rest), count(Class::Release));
    let tallies = run.tallies();
    assert_eq!((tallies.rests, tallies.releases), (count(Class::Rest), count(Class::Release)));
    assert!(events.windows(2).all(|e| e[0].time <= e[1].time));
}

#[test]
fn every_method_describes_itself_including_when_not_to_use_it() {
    for &method in Method::ALL {
        let description = describe(method);
        assert_eq!(description.method, method);
        let fields = [description.summary, description.order, description.source, description.knobs, description.avoid];
        assert!(fields.iter().all(|text| text.len() > 20), "{}: {description:?}", method.name());
    }
}
