//! Does the shadow run know the truth, does what `exact` says of its error hold, and does the certificate end where it must?

use carom::certify::{Cause, Certificate, Double, certify};
use carom::physics::{Class, Contact, Kind, Method, Simulation};
use carom::scene::{self, ContactLaw, Scene, Settings, Sphere};
use glam::{DVec3, dvec3};

use crate::arithmetic::{Big, big, decimal, off, whole};
use crate::random::Random;
use crate::support::{ELASTIC, G, PAPER_LAW, floor, gas, go, room, scene, sphere, wall};

fn certified(scene: &Scene, until: f64) -> Certificate {
    certify(scene, until, &|| true).expect("it is not interrupted")
}

/// Component `axis` of where the shadow has sphere `i`, m.
fn place(certificate: &Certificate, i: usize, axis: usize) -> Double {
    certificate.place(i).expect("there is such a sphere")[axis]
}

/// Nothing rests.
fn bouncy(e: f64, tangential: f64) -> ContactLaw {
    ContactLaw { restitution: e, wall_restitution: e, tangential, rest_speed: 0.0 }
}

fn exact() -> Settings {
    Settings { method: Method::Exact, dt: 0.1, tolerance: 0.0 }
}

#[test]
fn a_fall_is_the_parabola_to_the_last_digit() {
    let ball = sphere(dvec3(0.0, 100.0, 0.0), dvec3(0.3, 0.1, 0.7), 0.5);
    let certificate = certified(&scene(G, ELASTIC, vec![], vec![ball]), 1.7);
    let t = big(1.7);
    let y = big(100.0) + big(0.1) * &t - big(9.8) * &t * &t / big(2.0);
    assert!(off(place(&certificate, 0, 1), &y) < 1e-29, "{certificate:?}");
    assert!(off(place(&certificate, 0, 0), &(big(0.3) * &t)) < 1e-30);
}

#[test]
fn a_ball_that_loses_at_each_bounce_is_where_the_geometric_series_has_it() {
    // From 4 m at 8 m/s² it lands after 1 s at 8 m/s, and again after 1, 1/2 and 1/4 s: at 2.75 s at 1 m/s.
    let ball = sphere(dvec3(0.0, 4.5, 0.0), DVec3::X, 0.5);
    let falling = scene(DVec3::NEG_Y * 8.0, bouncy(0.5, 0.5), vec![floor(40.0)], vec![ball]);
    let certificate = certified(&falling, 2.625);
    let x = big(1.0 + 0.5 + 0.5 * 0.25 + 0.125 * 0.125);
    assert!(off(place(&certificate, 0, 0), &x) < 1e-29, "{certificate:?}");
    assert!(off(place(&certificate, 0, 1), &big(0.5 + 0.0625)) < 1e-29, "{certificate:?}");
    assert_eq!((certificate.events, certificate.ending), (3, None));
}

#[test]
fn bounces_at_times_that_are_no_fractions_come_to_thirty_digits() {
    let (e, height, until) = (0.7, 1.3, 2.1);
    let ball = sphere(dvec3(0.0, 0.5 + height, 0.0), DVec3::ZERO, 0.5);
    let certificate = certified(&scene(G, bouncy(e, 1.0), vec![floor(40.0)], vec![ball]), until);
    let g = big(9.8);
    let fall = (big(2.0) * (big(0.5 + height) - big(0.5)) / &g).sqrt();
    let (mut since, mut speed, mut bounces) = (fall.clone(), &g * &fall * big(e), 1);
    while &since + big(2.0) * &speed / &g < big(until) {
        since += big(2.0) * &speed / &g;
        speed *= big(e);
        bounces += 1;
    }
    let left: Big = big(until) - since;
    let y = big(0.5) + &speed * &left - g * &left * &left / big(2.0);
    assert!(off(place(&certificate, 0, 1), &y) < 1e-28, "{certificate:?}");
    assert_eq!((certificate.events, certificate.ending), (bounces, None));
}

#[test]
fn two_spheres_part_as_momentum_and_restitution_have_it() {
    // 1 kg at 2 m/s into 3 kg at rest, e = 1/2: −1/4 and 3/4 m/s. They meet after 1 s.
    let balls = vec![
        sphere(DVec3::ZERO, DVec3::X * 2.0, 0.5),
        Sphere { mass: 3.0, ..sphere(DVec3::X * 3.0, DVec3::ZERO, 0.5) },
    ];
    let certificate = certified(&scene(DVec3::ZERO, bouncy(0.5, 1.0), vec![], balls), 5.0);
    assert!(off(place(&certificate, 0, 0), &big(2.0 - 0.25 * 4.0)) < 1e-29, "{certificate:?}");
    assert!(off(place(&certificate, 1, 0), &big(3.0 + 0.75 * 4.0)) < 1e-29, "{certificate:?}");
}

#[test]
fn a_ball_slides_on_a_slope_as_its_weight_along_it_has_it() {
    // Down a slope of 3 : 4 at g · 3/5, from rest: 9.8 · 0.6 · 1.1²/2 m along (−4/5, −3/5).
    let slope = wall(DVec3::ZERO, dvec3(40.0, 30.0, 0.0), DVec3::Z * 40.0);
    let ball = sphere(dvec3(-3.0, 4.0, 0.0), DVec3::ZERO, 5.0);
    let certificate = certified(&scene(G, PAPER_LAW, vec![slope], vec![ball]), 1.1);
    let along = big(9.8) * big(3.0) / big(5.0) * big(1.1) * big(1.1) / big(2.0);
    let x = big(-3.0) - &along * big(4.0) / big(5.0);
    assert!(off(place(&certificate, 0, 0), &x) < 1e-29, "{certificate:?}");
    assert_eq!((certificate.events, certificate.ending), (1, None));
}

#[test]
fn the_photon_of_the_hundred_digit_challenge_is_known_to_eighteen_digits_and_exact_knows_what_it_lost() {
    let photon = scene::open("photon").expect("a built-in scene").scene;
    let certificate = certified(&photon, 10.0);
    assert_eq!((certificate.events, certificate.until), (14, 10.0));
    let [x, y] = [0, 1].map(|axis| whole(place(&certificate, 0, axis)));
    let squared = (&x * &x + &y * &y) / big(900.0);
    let known = decimal(&[995_262_919.0, 4_433_541_608.0, 9_031_180_942.0]);
    let share = f64::try_from((squared / (&known * &known) - big(1.0)).with_precision(53).value()).expect("a number");
    // The mirrors weigh 1e30 times the photon, and fourteen impacts enlarge what is off by some 1e10.
    assert!(share.abs() < 2e-18, "{share:e}");
    let found = go(&mut Simulation::new(&photon, exact()), 10.0).x[0].length();
    let lost = (found - 30.0 * 0.995_262_919_443_354_2).abs();
    assert!(lost > 1e-7 && lost <= certificate.error, "{lost:e} of {:e}", certificate.error);
}

/// A room with a slope or none, and a few spheres under the paper's law.
fn any_scene(random: &mut Random) -> Scene {
    let mut walls = room(dvec3(-5.0, 0.0, -5.0), dvec3(5.0, 10.0, 5.0));
    if random.unit() < 0.5 {
        let edges = [dvec3(random.between(2.0, 6.0), random.between(-2.0, 2.0), 0.0), DVec3::NEG_Z * 4.0];
        walls.push(wall(dvec3(0.0, 4.0, 0.0), edges[0], edges[1]));
    }
    let spot = |k: usize| dvec3(-3.0 + 2.0 * (k % 3) as f64, 7.5, -3.0 + 2.0 * (k / 3) as f64);
    let count = random.pick(&[1, 2, 4, 7]);
    let spheres = (0..count).map(|k| Sphere {
        mass: random.decade(-1.0, 1.0),
        ..sphere(spot(k) + random.vector() * 0.3, random.vector() * 8.0, random.between(0.2, 0.6))
    });
    let spheres: Vec<Sphere> = spheres.collect();
    let law = ContactLaw {
        restitution: random.between(0.3, 1.0),
        wall_restitution: random.between(0.3, 1.0),
        tangential: random.between(0.8, 1.0),
        rest_speed: 0.1,
    };
    scene(G, law, walls, spheres)
}

#[allow(clippy::print_stdout)] // read with --nocapture
#[test]
fn what_exact_says_of_its_error_holds_in_each_of_a_thousand_scenes() {
    let random = &mut Random::new(7);
    let (mut whole_runs, mut events) = (0, 0);
    for k in 0..1000 {
        let scene = any_scene(random);
        let certificate = certified(&scene, 3.0);
        events += certificate.events;
        whole_runs += usize::from(certificate.ending.is_none());
        let state = go(&mut Simulation::new(&scene, exact()), certificate.until);
        for (i, x) in state.x.iter().enumerate() {
            let off =
                DVec3::from_array([0, 1, 2].map(|axis| (Double::from(x[axis]) - place(&certificate, i, axis)).value()));
            // Reading a state rounds it: coordinates of ten metres, three ulp each.
            assert!(off.length() <= certificate.error + 1e-14, "{k}, sphere {i}: {off}, {certificate:?}");
        }
        // Few impacts with round bodies each enlarge rounding by at most some hundred times.
        assert!(certificate.error < 1e-6, "{k}: {certificate:?}");
    }
    println!("{whole_runs} of 1000 random scenes are certified to their end; {events} events");
    assert!(events > 10_000, "{events} events");
    assert!(whole_runs > 900, "{whole_runs} of 1000 are certified to their end");
}

#[test]
fn where_it_cannot_follow_it_ends_and_says_why() {
    let of = |walls, spheres, until| {
        let certificate = certified(&scene(G, PAPER_LAW, walls, spheres), until);
        let ending = certificate.ending.expect("it ends before the run");
        (ending.cause, certificate.until)
    };
    // At 2 m/s, slowed by 1 m/s², to the border 2 m ahead: it turns there.
    let turns = vec![Sphere { force: DVec3::NEG_X, ..sphere(dvec3(18.0, 0.5, 0.0), DVec3::X * 2.0, 0.5) }];
    let (cause, until) = of(vec![floor(40.0)], turns, 5.0);
    assert!(cause == Cause::RollsOver && (until - 2.0).abs() < 1e-5, "{cause:?} at {until}");
    // Past a standing sphere at 2 m/s, at a distance that rounding does not tell from a touch.
    let grazes = vec![sphere(DVec3::Y * 0.5, DVec3::ZERO, 0.5), sphere(dvec3(-2.0, 0.5, 1.0), DVec3::X * 2.0, 0.5)];
    let (cause, until) = of(vec![floor(40.0)], grazes, 5.0);
    assert!(cause == Cause::Touching && (0.9..=1.0).contains(&until), "{cause:?} at {until}");
    // Three balls of a line fall into the hollows of four that lie side by side: all strike at √(2 (1 − √3/2)/9.8) s, again and again,
    // and the law does not say in which order.
    let scene = scene::open("stack").expect("a built-in scene").scene;
    let certificate = certified(&scene, 1.0);
    let cause = certificate.ending.map(|ending| ending.cause);
    assert_eq!(cause, Some(Cause::AmidImpacts), "at {} s", certificate.until);
    let falls = (2.0 * (1.0 - 0.75_f64.sqrt()) / 9.8).sqrt();
    assert!((certificate.until - falls).abs() < 1e-12, "at {} s", certificate.until);
}

#[test]
fn a_ball_that_slides_fast_over_an_edge_flies_on() {
    // 4 m/s: the edge would have to pull. The border is at 20 m, which it passes after ½ s; 8 m/s² on.
    let ball = sphere(dvec3(18.0, 0.5, 0.25), DVec3::X * 4.0, 0.5);
    let certificate = certified(&scene(DVec3::NEG_Y * 8.0, PAPER_LAW, vec![floor(40.0)], vec![ball]), 1.75);
    assert_eq!((certificate.until, &certificate.ending), (1.75, &None));
    assert!(off(place(&certificate, 0, 0), &big(25.0)) < 1e-29, "{certificate:?}");
    assert!(off(place(&certificate, 0, 1), &big(0.5 - 4.0 * 1.25 * 1.25)) < 1e-28, "{certificate:?}");
}

/// Centre (m) of a ball that leaves an edge at `cos` of its angle, and its velocity (m/s), at g = 8 m/s² and r = ½ m: the edge pushes no
/// more where v² = g r cos θ.
fn leaves_edge(cos: &Big) -> [Big; 4] {
    let sin = (big(1.0) - cos * cos).sqrt();
    let speed = (big(4.0) * cos).sqrt();
    [&sin / big(2.0), cos / big(2.0), &speed * cos, -speed * sin]
}

/// Holds two places of a flight (m, s apart) against where it began and how fast; the time since then, s.
fn flew(times: [f64; 2], places: [[Big; 2]; 2], [x, y, v, w]: [Big; 4]) -> Big {
    let speed = (&places[1][0] - &places[0][0]) / big(times[1] - times[0]);
    let near = |one: &Big, two: &Big| f64::try_from((one - two).with_precision(53).value()).expect("a number").abs();
    assert!(near(&speed, &v) < 1e-27, "{:e}", near(&speed, &v));
    let since = (&places[0][0] - x) / &v;
    let fallen = y + w * &since - big(4.0) * &since * &since;
    assert!(near(&places[0][1], &fallen) < 1e-27, "{:e}", near(&places[0][1], &fallen));
    big(times[0]) - since
}

#[test]
fn a_ball_that_slides_slowly_over_an_edge_leaves_it_where_the_edge_would_have_to_pull() {
    // At 1 m/s to the border at 1 s: v² = 1 + 2 g r (1 − cos θ) = g r cos θ at cos θ = 3/4.
    let ball = sphere(dvec3(19.0, 0.5, 0.25), DVec3::X, 0.5);
    let scene = scene(DVec3::NEG_Y * 8.0, PAPER_LAW, vec![floor(40.0)], vec![ball]);
    let times = [1.5, 1.75];
    let places = times.map(|until| {
        let certificate = certified(&scene, until);
        assert!(certificate.ending.is_none() && certificate.error < 1e-12, "{certificate:?}");
        [whole(place(&certificate, 0, 0)) - big(20.0), whole(place(&certificate, 0, 1))]
    });
    let since = flew(times, places, leaves_edge(&big(0.75)));
    // The time on the edge is ∫ r dθ/v; with u = tan(θ/2), by Simpson's rule and Richardson's extrapolation.
    let integrand = |u: &Big| {
        let square = big(1.0) + u * u;
        let cos = (big(1.0) - u * u) / &square;
        big(1.0) / (&square * (big(1.0) + big(8.0) * (big(1.0) - cos)).sqrt())
    };
    let end = (big(0.25) / big(1.75)).sqrt();
    let time = big(1.0) + romberg(&integrand, &end);
    let off = f64::try_from((time - since).with_precision(53).value()).expect("a number").abs();
    assert!(off < 1e-26, "{off:e} s");
}

/// ∫ from 0 to `end` of something smooth.
fn romberg(integrand: &dyn Fn(&Big) -> Big, end: &Big) -> Big {
    let half = (integrand(&big(0.0)) + integrand(end)) / big(2.0);
    let mut rows: Vec<Big> = Vec::new();
    for level in 0..12 {
        let count = 1_u32 << level;
        let step = end / big(f64::from(count));
        let inner = (1..count).fold(half.clone(), |sum, k| sum + integrand(&(&step * big(f64::from(k)))));
        let mut value = inner * step;
        let mut power = big(4.0);
        for row in &mut rows {
            let better = (&power * &value - &*row) / (&power - big(1.0));
            *row = std::mem::replace(&mut value, better);
            power *= big(4.0);
        }
        rows.push(value);
    }
    rows.pop().expect("twelve levels")
}

#[test]
fn a_ball_that_begins_to_rest_on_an_edge_or_a_corner_leaves_it_at_two_thirds_of_its_height() {
    // From rest at 3 : 4 of the radius: cos θ = 2/3 of what it began with. 1e-16 of the beginning is rounding of its place.
    let start = dvec3(20.0 + 0.3, 0.4, 0.25);
    let corner = dvec3(20.0 + 0.18, 0.4, 20.0 + 0.24);
    for (x, across) in [(start, DVec3::X), (corner, dvec3(0.6, 0.0, 0.8))] {
        let scene = scene(DVec3::NEG_Y * 8.0, PAPER_LAW, vec![floor(40.0)], vec![sphere(x, DVec3::ZERO, 0.5)]);
        let times = [0.75, 1.0];
        let places = times.map(|until| {
            let certificate = certified(&scene, until);
            assert!(certificate.ending.is_none() && certificate.error < 1e-12, "{certificate:?}");
            let [x, y, z] = [0, 1, 2].map(|axis| place(&certificate, 0, axis).value());
            [across.dot(dvec3(x - 20.0, 0.0, if across.z == 0.0 { 0.0 } else { z - 20.0 })), y]
        });
        let [sin, cos]: [f64; 2] = [(1.0 - 0.64_f64 * 4.0 / 9.0).sqrt(), 0.8 * 2.0 / 3.0];
        let speed = (4.0 * cos).sqrt();
        let found = (places[1][0] - places[0][0]) / (times[1] - times[0]);
        assert!((found - speed * cos).abs() < 1e-13, "{found} {}", speed * cos);
        let since = (places[0][0] - 0.5 * sin) / found;
        let fallen = 0.5 * cos - speed * sin * since - 4.0 * since * since;
        assert!((places[0][1] - fallen).abs() < 1e-13, "{} {fallen}", places[0][1]);
    }
}

#[test]
fn a_ball_that_rolls_off_another_keeps_to_it_and_they_keep_the_momentum_of_both() {
    let rolls = vec![sphere(DVec3::Y * 0.5, DVec3::ZERO, 0.5), sphere(dvec3(0.6, 1.3, 0.0), DVec3::ZERO, 0.5)];
    let scene = scene(G, ContactLaw { tangential: 1.0, ..PAPER_LAW }, vec![floor(40.0)], rolls);
    for until in [0.1, 0.5, 2.0] {
        let certificate = certified(&scene, until);
        assert!(certificate.until == until && certificate.ending.is_none(), "{certificate:?}");
        assert!(certificate.error < 1e-10, "{certificate:?}");
        let [[x, y, _], [u, w, _]] = [0, 1].map(|i| [0, 1, 2].map(|axis| whole(place(&certificate, i, axis))));
        let sum = f64::try_from((&x + &u - big(0.6)).with_precision(53).value()).expect("a number");
        assert!(sum.abs() < 1e-28, "{sum:e} m at {until}");
        let gap = ((&x - &u) * (&x - &u) + (&y - &w) * (&y - &w)).sqrt();
        let gap = f64::try_from(gap.with_precision(53).value()).expect("a number");
        assert!(if until == 0.1 { (gap - 1.0).abs() < 1e-15 } else { gap > 1.0 }, "{gap} m at {until}");
    }
}

#[test]
fn a_ball_slides_over_the_seam_of_two_tiles_as_if_there_were_none() {
    let tile = |x: f64| wall(DVec3::X * x, DVec3::X * 4.0, DVec3::NEG_Z * 4.0);
    let ball = sphere(dvec3(-1.0, 0.5, 0.25), dvec3(0.75, 0.0, 0.125), 0.5);
    let certificate = certified(&scene(G, PAPER_LAW, vec![tile(-2.0), tile(2.0)], vec![ball]), 3.0);
    assert_eq!((certificate.until, &certificate.ending), (3.0, &None));
    assert!(off(place(&certificate, 0, 0), &big(1.25)) < 1e-29, "{certificate:?}");
    assert!(off(place(&certificate, 0, 1), &big(0.5)) < 1e-29, "{certificate:?}");
}

#[test]
fn a_ball_in_a_corner_meets_both_walls_at_one_time_and_their_order_makes_no_difference() {
    let walls = room(dvec3(-5.0, 0.0, -5.0), dvec3(5.0, 10.0, 5.0));
    let ball = sphere(dvec3(0.0, 8.0, 0.0), dvec3(9.0, 0.0, 9.0), 0.5);
    let certificate = certified(&scene(DVec3::ZERO, bouncy(0.5, 0.5), walls, vec![ball]), 1.0);
    assert_eq!((certificate.until, certificate.ties, certificate.ending.clone()), (1.0, 0, None));
    // After ½ s each component has lost once as the normal one and once as the tangential one.
    for axis in [0, 2] {
        assert!(off(place(&certificate, 0, axis), &big(4.5 - 9.0 * 0.25 * 0.5)) < 1e-28, "{certificate:?}");
    }
}

#[test]
fn a_row_of_balls_that_touch_passes_an_impact_on() {
    let ball = |x: f64, v: f64| sphere(DVec3::X * x, DVec3::X * v, 0.5);
    let row = vec![ball(-2.0, 1.0), ball(0.0, 0.0), ball(1.0, 0.0), ball(2.0, 0.0)];
    let certificate = certified(&scene(DVec3::ZERO, ELASTIC, vec![], row), 3.0);
    assert_eq!((certificate.events, certificate.ties, certificate.ending.clone()), (3, 0, None));
    // It meets the row after 1 s; the last one flies on for 2 s at 1 m/s.
    for (i, x) in [-1.0, 0.0, 1.0, 4.0].into_iter().enumerate() {
        assert!(off(place(&certificate, i, 0), &big(x)) < 1e-29, "{certificate:?}");
    }
}

#[test]
fn spheres_that_lean_on_each_other_and_do_not_move_are_certified_to_the_end() {
    // Two lie in a trough, a third above between them, in a groove as wide as they are.
    let balls = vec![
        sphere(dvec3(-0.6, 0.5, 0.0), DVec3::ZERO, 0.5),
        sphere(dvec3(0.6, 0.5, 0.0), DVec3::ZERO, 0.5),
        sphere(dvec3(0.0, 1.3, 0.0), DVec3::ZERO, 0.5),
    ];
    let walls = room(dvec3(-1.1, 0.0, -2.5), dvec3(1.1, 4.0, 2.5));
    let certificate = certified(&scene(G, PAPER_LAW, walls, balls), 5.0);
    assert!(certificate.until == 5.0 && certificate.ending.is_none(), "{certificate:?}");
    assert!(off(place(&certificate, 2, 1), &big(1.3)) < 1e-15, "{certificate:?}");
    // One falls onto the top of another, with too little to bounce.
    let tower = vec![sphere(DVec3::Y * 0.5, DVec3::ZERO, 0.5), sphere(DVec3::Y * 1.5001, DVec3::ZERO, 0.5)];
    let certificate = certified(&scene(G, PAPER_LAW, vec![floor(40.0)], tower), 5.0);
    assert!(certificate.until == 5.0 && certificate.ending.is_none(), "{certificate:?}");
    assert!(off(place(&certificate, 1, 1), &big(1.5)) < 1e-28, "{certificate:?}");
}

#[test]
fn stacks_of_more_spheres_than_sets_of_contacts_can_be_tried_are_certified_to_the_end() {
    // A column: twenty contacts. Square layers of 4 × 4, 3 × 3, 2 × 2 and 1 between four walls, all of which touch: forces are not unique.
    let lying = |x: f64, y: f64, z: f64| sphere(dvec3(x, y, z), DVec3::ZERO, 0.5);
    let column = (0..20).map(|k| lying(0.0, 0.5 + f64::from(k), 0.0)).collect();
    let layers = (0..4_u8).flat_map(|layer| {
        let at = move |k: u8| f64::from(k) - f64::from(3 - layer) * 0.5;
        let square = (0..4 - layer).flat_map(move |i| (0..4 - layer).map(move |j| (i, j)));
        square.map(move |(i, j)| (at(i), 0.5 + f64::from(layer) * 0.5_f64.sqrt(), at(j)))
    });
    let pyramid = layers.map(|(x, y, z)| lying(x, y, z)).collect();
    let walls = room(dvec3(-2.0, 0.0, -2.0), dvec3(2.0, 6.0, 2.0));
    for (walls, balls) in [(vec![floor(40.0)], column), (walls, pyramid)] {
        let scene = scene(G, PAPER_LAW, walls, balls);
        let certificate = certified(&scene, 5.0);
        assert!(certificate.until == 5.0 && certificate.ending.is_none(), "{certificate:?}");
        for (i, sphere) in scene.spheres.iter().enumerate() {
            assert_eq!([0, 1, 2].map(|axis| place(&certificate, i, axis).value()), sphere.x.to_array(), "sphere {i}");
        }
    }
}

#[test]
fn what_ends_a_curved_motion_does_not_hide_how_far_it_is_off() {
    // Five lines of balls with gaps between them lie in a box that holds the lowest at its ends: they slide over each other, until two of
    // the lowest come together. Nothing happens before, so that no event compares them.
    let lines =
        (0..5_u8).flat_map(|line| (0..5 - line).map(move |k| (f64::from(line), f64::from(k), f64::from(4 - line))));
    let ball = |(line, k, last): (f64, f64, f64)| {
        sphere(dvec3((k - 0.5 * last) * 1.2, 0.5 + 0.8 * line, 0.0), DVec3::ZERO, 0.5)
    };
    let walls = room(dvec3(-2.9, 0.0, -2.0), dvec3(2.9, 7.0, 2.0));
    let law = ContactLaw { tangential: 1.0, ..PAPER_LAW };
    let scene = scene(G, law, walls, lines.map(ball).collect());
    let errors = [0.1, 0.3, 1.0].map(|until| {
        let certificate = certified(&scene, until);
        assert_eq!(certificate.ending.is_some(), until == 1.0, "{certificate:?}");
        assert!(certificate.until >= until.min(0.34), "{certificate:?}");
        certificate.error
    });
    // rounding of arcs need not grow: it is told, which is more than nothing, wherever the run ends
    assert!(errors.iter().all(|error| (1e-17..1e-12).contains(error)), "{errors:?}");
}

#[test]
fn contacts_of_one_sphere_at_one_time_are_counted_where_their_order_is_that_of_exact() {
    // A ball between two that come from both sides at one time: whichever meets it first, they part otherwise.
    let ball = |x: f64, v: f64, mass: f64| Sphere { mass, ..sphere(DVec3::X * x, DVec3::X * v, 0.5) };
    let balls = vec![ball(-3.0, 2.0, 1.0), ball(0.0, 0.0, 1.0), ball(3.0, -2.0, 1.0)];
    let certificate = certified(&scene(DVec3::ZERO, ELASTIC, vec![], balls), 1.5);
    assert!(certificate.ties > 0 && certificate.ending.is_none(), "{certificate:?}");
}

#[test]
fn a_gas_of_a_thousand_is_certified_for_ten_collisions_of_each() {
    // A tenth of the volume is spheres: a free path of some radii, so that an impact enlarges what is off by less than ten.
    let gas = gas(1000, 5, 1.0);
    let certificate = certified(&gas, 2.0);
    let mut run = Simulation::new(&gas, exact());
    run.record_events(true);
    go(&mut run, certificate.until);
    let pairs = |row: &Contact| row.class == Class::Collide && row.kind == Kind::Pair && row.time <= certificate.until;
    let collisions = run.take_events().into_iter().filter(pairs).count();
    // Two spheres take part in each. It is a tenth of a radius off by then, at most; soon after exact has lost all its digits.
    assert!(collisions >= 5000, "{collisions} up to {} s, {:?}", certificate.until, certificate.ending);
    assert!(certificate.error < 1e-2, "{} m", certificate.error);
}

#[test]
fn an_error_that_comes_late_in_a_long_flight_does_not_count_from_its_beginning() {
    // Of a thousand spheres some fly for seconds before they meet one that has met many.
    let scene = scene::open("box-gas").expect("a built-in scene").scene;
    let whole = certified(&scene, 5.0);
    for (asked, least) in [(1e-9, 1.5), (1e-12, 0.5)] {
        let within = whole.within(asked);
        assert!(whole.error > asked && within > least, "{asked:e} m: {within} s");
        let again = certified(&scene, within);
        assert!(again.error <= asked && again.error > 1e-3 * asked, "{asked:e} m: {} m at {within} s", again.error);
    }
}

#[test]
fn the_paper_s_five_scenes_are_certified_to_their_end_with_the_digits_that_their_growth_leaves() {
    // A displacement grows by 1, 1e3, 2, 2e8 and 1e4 in scenes 0 to 4, and coordinates of 10 m round to 1e-15.
    let scenes = [("paper-0", 1e-13), ("paper-1", 1e-10), ("paper-2", 1e-12), ("paper-3", 1e-6), ("paper-4", 1e-10)];
    for (name, most) in scenes {
        let scene = scene::open(name).expect("a built-in scene").scene;
        let certificate = certified(&scene, 20.0);
        assert_eq!((certificate.until, &certificate.ending), (20.0, &None), "{name}");
        assert!(certificate.error > 0.0 && certificate.error < most, "{name}: {}", certificate.error);
    }
}

#[test]
fn a_crowd_that_is_too_large_to_be_looked_at_pair_by_pair_is_certified_at_its_start_only() {
    let balls = (0..10_001).map(|k| sphere(DVec3::X * f64::from(k), DVec3::Y, 0.25)).collect();
    let certificate = certified(&scene(G, ELASTIC, vec![], balls), 1.0);
    assert_eq!((certificate.until, certificate.looks), (0.0, 0));
    assert_eq!(certificate.ending.map(|ending| ending.cause), Some(Cause::Spent));
}

#[test]
fn a_certificate_that_is_told_not_to_go_on_is_none() {
    let scene = scene::open("paper-3").expect("a built-in scene").scene;
    assert_eq!(certify(&scene, 20.0, &|| false), None);
}
