//! Why contacts rest: each scene leaves one reason.

use crate::support::{G, PAPER_LAW, go, scene, sphere, wall};
use carom::physics::{Kind, Method, RestReason, Scene, Settings, Simulation};
use carom::scene::{ContactLaw, Sphere, Wall};
use glam::{DVec3, dvec3};

/// Impacts lose half of the approach speed, nothing along the wall, and nothing rests by being slow.
const HALF: ContactLaw = ContactLaw { restitution: 0.5, wall_restitution: 0.5, tangential: 1.0, rest_speed: 0.0 };

/// A floor of 4 m around a point.
fn floor(center: DVec3) -> Wall {
    wall(center, DVec3::X * 4.0, DVec3::NEG_Z * 4.0)
}

/// A sphere of 0.5 m above a floor at y = 0.
fn above(contact: ContactLaw, gap: f64, v: DVec3) -> Scene {
    scene(G, contact, vec![floor(DVec3::ZERO)], vec![sphere(DVec3::Y * (0.5 + gap), v, 0.5)])
}

/// A sphere of 0.5 m that lies on a floor at y = 0 below another one.
fn stacked(contact: ContactLaw, gap: f64, v: DVec3) -> Scene {
    let spheres = vec![sphere(DVec3::Y * 0.5, DVec3::ZERO, 0.5), sphere(DVec3::Y * (1.5 + gap), v, 0.5)];
    scene(G, contact, vec![floor(DVec3::ZERO)], spheres)
}

/// A ball of 1 kg that touches a wall at x = 0, and one of this mass (kg) that comes at it with 1 m/s from 1 m away.
fn squeeze(mass: f64, e: f64) -> Scene {
    let law = ContactLaw { restitution: e, wall_restitution: e, ..HALF };
    let heavy = Sphere { mass, ..sphere(DVec3::X * 2.5, DVec3::NEG_X, 0.5) };
    let walls = vec![wall(DVec3::ZERO, DVec3::Y * 4.0, DVec3::Z * 4.0)];
    scene(DVec3::ZERO, law, walls, vec![sphere(DVec3::X * 0.5, DVec3::ZERO, 0.5), heavy])
}

fn reason_of(scene: &Scene, method: Method, until: f64, key: (Kind, usize, usize)) -> Option<RestReason> {
    let mut run = Simulation::new(scene, Settings { method, dt: 0.01, tolerance: 1e-12 });
    go(&mut run, until);
    run.rest_reason(key)
}

fn reason(scene: &Scene, method: Method, until: f64, wall: usize) -> Option<RestReason> {
    reason_of(scene, method, until, (Kind::Wall, 0, wall))
}

#[track_caller]
fn assert_reason(scene: &Scene, until: f64, wall: usize, expected: RestReason) {
    for method in [Method::Exact, Method::Swept] {
        let found = reason(scene, method, until, wall);
        assert_eq!(found, Some(expected), "{method:?}: {:?}", found.map(RestReason::words));
    }
}

#[test]
fn a_sphere_placed_on_the_floor_touches() {
    assert_reason(&above(HALF, 0.0, DVec3::ZERO), 0.1, 0, RestReason::Touching);
}

#[test]
fn an_approach_below_the_rest_speed_is_slow() {
    // Falls 1 mm: 0.14 m/s.
    let slow = ContactLaw { rest_speed: 0.5, ..HALF };
    assert_reason(&above(slow, 1e-3, DVec3::ZERO), 0.1, 0, RestReason::Slow);
}

#[test]
fn an_impact_without_restitution_stops() {
    let dead = ContactLaw { wall_restitution: 0.0, ..HALF };
    assert_reason(&above(dead, 0.1, DVec3::ZERO), 1.0, 0, RestReason::Stopped);
}

#[test]
fn ever_lower_bounces_are_summed_up() {
    // Falls 0.1 m in 0.14 s; all bounces take twice that.
    assert_reason(&above(HALF, 0.1, DVec3::ZERO), 1.0, 0, RestReason::SeriesSummed);
}

#[test]
fn far_from_the_origin_coordinates_cannot_resolve_the_last_hops() {
    let there = DVec3::X * 1e6;
    let far = scene(G, HALF, vec![floor(there)], vec![sphere(there + DVec3::Y * 0.6, DVec3::ZERO, 0.5)]);
    assert_reason(&far, 1.0, 0, RestReason::WithinCoordinates);
}

#[test]
fn the_clock_cannot_resolve_the_flight_of_next_to_nothing() {
    // A flight of 1e-19 s, where the first time that matters is a millisecond.
    assert_reason(&above(HALF, 0.0, DVec3::NEG_Y * 1e-18), 0.1, 0, RestReason::WithinClock);
}

#[test]
fn bounces_too_low_to_see_rest_on_a_wall_that_takes_nothing() {
    // 5e-7 m/s go 1e-14 m high; pairs would lose, so that the scene as a whole is not elastic.
    let elastic_wall = ContactLaw { wall_restitution: 1.0, ..HALF };
    assert_reason(&above(elastic_wall, 0.0, DVec3::NEG_Y * 5e-7), 0.1, 0, RestReason::Undamped);
}

#[test]
fn a_sphere_that_just_fits_between_walls_is_squeezed() {
    let walls = vec![floor(DVec3::ZERO), floor(DVec3::Y)];
    let fits = scene(G, PAPER_LAW, walls, vec![sphere(DVec3::Y * 0.5, DVec3::X, 0.5)]);
    assert_reason(&fits, 0.1, 0, RestReason::Squeezed);
}

#[test]
fn beyond_a_seam_a_sphere_rests_on_the_next_tile_because_of_the_last_one() {
    // Slides at 1 m/s over the seam at x = 2: no approach tells of the next tile, whose gap is 0 there and nowhere before.
    let walls = vec![floor(DVec3::ZERO), floor(DVec3::X * 4.0)];
    let slides = scene(G, HALF, walls, vec![sphere(dvec3(1.5, 0.5, 0.0), DVec3::X, 0.5)]);
    assert_reason(&slides, 1.0, 1, RestReason::SharedPoint);
}

#[test]
fn where_a_floor_bends_by_next_to_nothing_the_one_before_holds_the_sphere_down() {
    // At 1 mm/s on to a slope of 1e-10 rad: an impact would lift it off the floor by 1e-13 m/s, and gravity put it back.
    let slope = wall(dvec3(4.0, 2e-10, 0.0), dvec3(4.0, 4e-10, 0.0), DVec3::NEG_Z * 4.0);
    let walls = vec![floor(DVec3::ZERO), slope];
    let slides = scene(G, HALF, walls, vec![sphere(dvec3(1.9995, 0.5, 0.0), DVec3::X * 1e-3, 0.5)]);
    assert_eq!(reason(&slides, Method::Exact, 0.6, 1), Some(RestReason::HeldDown));
    // `swept` looks for it within its tolerance, where it shares the point already
    assert_eq!(reason(&slides, Method::Swept, 0.6, 1), Some(RestReason::SharedPoint));
}

#[test]
fn pairs_rest_for_the_reasons_that_walls_have() {
    let slow = ContactLaw { rest_speed: 0.5, ..HALF };
    let dead = ContactLaw { restitution: 0.0, ..HALF };
    // The falls, and the speeds, of the tests above.
    for (scene, expected) in [
        (stacked(HALF, 0.0, DVec3::ZERO), RestReason::Touching),
        (stacked(slow, 1e-3, DVec3::ZERO), RestReason::Slow),
        (stacked(dead, 0.1, DVec3::ZERO), RestReason::Stopped),
        (stacked(HALF, 0.1, DVec3::ZERO), RestReason::SeriesSummed),
        (stacked(HALF, 0.0, DVec3::NEG_Y * 1e-18), RestReason::WithinClock),
    ] {
        assert_eq!(reason_of(&scene, Method::Exact, 1.0, (Kind::Pair, 0, 1)), Some(expected));
    }
    let there = DVec3::X * 1e6;
    let spheres = [0.5, 1.6].map(|y| sphere(there + DVec3::Y * y, DVec3::ZERO, 0.5)).to_vec();
    let far = scene(G, HALF, vec![floor(there)], spheres);
    assert_eq!(reason_of(&far, Method::Exact, 1.0, (Kind::Pair, 0, 1)), Some(RestReason::WithinCoordinates));
}

#[test]
fn a_squeeze_that_loses_too_much_rests_because_the_chain_collapses() {
    // 1 − e is far over 4 √(m/M): no number of impacts is enough, and all of them come at one instant.
    for (mass, e) in [(1e4, 0.5), (1e6, 0.9)] {
        for key in [(Kind::Wall, 0, 0), (Kind::Pair, 0, 1)] {
            let found = reason_of(&squeeze(mass, e), Method::Exact, 2.0, key);
            assert_eq!(found, Some(RestReason::Collapse), "{mass} kg, e = {e}: {key:?}");
        }
    }
}

#[test]
fn a_ball_under_one_that_presses_it_on_a_wall_chatters() {
    // Ten nanometres off the wall, and the heavy one as far off the light one, both pulled towards the wall: what the light
    // ball loses, over flights that the clock can tell, the heavy one gives back.
    let law = ContactLaw { restitution: 0.9, wall_restitution: 0.5, ..HALF };
    let ball = |x: f64, mass: f64| Sphere { mass, ..sphere(DVec3::X * x, DVec3::ZERO, 0.5) };
    let walls = vec![wall(DVec3::ZERO, DVec3::Y * 4.0, DVec3::Z * 4.0)];
    let pressed = scene(DVec3::NEG_X, law, walls, vec![ball(0.5 + 1e-8, 1.0), ball(1.5 + 2e-8, 1e6)]);
    for key in [(Kind::Wall, 0, 0), (Kind::Pair, 0, 1)] {
        assert_eq!(reason_of(&pressed, Method::Exact, 3.0, key), Some(RestReason::Chatter), "{key:?}");
    }
}

#[test]
fn what_flies_and_what_no_event_tells_of_has_no_reason() {
    let flying = above(HALF, 10.0, DVec3::ZERO);
    let resting = above(PAPER_LAW, 0.0, DVec3::ZERO);
    for (scene, method) in [(&flying, Method::Exact), (&resting, Method::Moreau)] {
        let mut run = Simulation::new(scene, Settings { method, dt: 0.01, tolerance: 1e-3 });
        go(&mut run, 0.1);
        assert_eq!(run.rest_reason((Kind::Wall, 0, 0)), None, "{method:?}");
    }
}
