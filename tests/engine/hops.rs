//! Low hops that nothing damps, millions of them: followed at once, against the closed form.

use crate::support::{G, floor, go, recorded, scene, sphere, wall};
use carom::physics::{ContactLaw, Method, Settings, Simulation};
use glam::{DVec3, dvec3};

const EXACT: Settings = Settings { method: Method::Exact, dt: 0.1, tolerance: 1e-3 };

/// Radius, m, and the height from which a ball begins to hop, m: as coordinates round it, 2⁻³³ exactly.
const R: f64 = 0.25;
const HEIGHT: f64 = 1.0 / (1_u64 << 33) as f64;

/// Duration of a hop of that height, s.
fn period() -> f64 {
    2.0 * (2.0 * HEIGHT / -G.y).sqrt()
}

/// Elastic walls; balls that strike each other lose, or not.
fn law(restitution: f64) -> ContactLaw {
    ContactLaw { restitution, wall_restitution: 1.0, tangential: 1.0, rest_speed: 0.0 }
}

/// A ball that begins at the top of a hop, at `x`, m, and slides along with `v`, m/s.
fn hopper(x: f64, v: f64) -> carom::scene::Sphere {
    sphere(dvec3(x, R + HEIGHT, 0.0), DVec3::X * v, R)
}

fn impacts(run: &mut Simulation) -> u64 {
    run.take_events().iter().map(carom::physics::Contact::impact_count).sum()
}

#[test]
fn a_ball_that_hops_low_is_where_the_closed_form_says_and_has_struck_as_often() {
    let mut run = recorded(&scene(G, law(1.0), vec![floor(20.0)], vec![hopper(-3.0, 0.5)]), EXACT);
    let mut told = 0;
    for k in 1..=20 {
        let t = 0.37 * f64::from(k);
        let state = go(&mut run, t);
        told += impacts(&mut run);
        // Coordinates tell a millionth of a hop.
        let phase = (t / period() + 0.5).fract() * period();
        let up = (0.5 * period() - phase).abs() * -G.y;
        let height = HEIGHT - 0.5 * up * up / -G.y;
        assert!((state.x[0].x - (-3.0 + 0.5 * t)).abs() <= 1e-14 * t.max(1.0), "x = {} at {t} s", state.x[0].x);
        assert!((state.x[0].y - R - height).abs() <= 1e-5 * HEIGHT, "{} m up at {t} s", state.x[0].y - R);
    }
    // Of the hops under way no row has told, but they are counted; no energy is lost.
    let expected = (run.time() / period() + 0.5) as u64;
    assert!(
        run.tallies().impacts.abs_diff(expected) <= 1,
        "{} impacts instead of {expected} by {} s",
        run.tallies().impacts,
        run.time()
    );
    assert!(told <= expected + 1 && expected - told.min(expected) <= 1 << 20, "{told} of {expected} impacts told");
    let energy = go(&mut run, 7.5).energy(run.model()) / run.initial_energy() - 1.0;
    assert!(energy.abs() <= 64.0 * f64::EPSILON, "energy off by {energy:e}");
}

#[test]
fn two_balls_that_hop_meet_when_they_should_and_part_as_the_law_says() {
    for restitution in [1.0, 0.5] {
        // Centres 2 m apart, closing at 1 m/s: they touch after 1.5 s, and exchange what restitution leaves.
        let balls = vec![hopper(-1.0, 0.75), hopper(1.0, -0.25)];
        let mut run = recorded(&scene(G, law(restitution), vec![floor(20.0)], balls), EXACT);
        let state = go(&mut run, 2.5);
        let struck: Vec<_> =
            run.take_events().into_iter().filter(|row| row.kind == carom::physics::Kind::Pair).collect();
        assert_eq!(struck.len(), 1, "{struck:?}");
        assert!((struck[0].time - 1.5).abs() <= 1e-12, "they meet at {} s", struck[0].time);
        let (mean, half) = (0.25, 0.5 * restitution);
        for (found, expected) in state.v.iter().zip([mean - half, mean + half]) {
            // The line of centres is off the level by no more than a hop: 1e-10 of the radius.
            assert!((found.x - expected).abs() <= 1e-8, "{} instead of {expected} m/s", found.x);
        }
    }
}

#[test]
fn a_ball_that_hops_over_the_end_of_its_floor_falls_from_there() {
    let tile = wall(DVec3::ZERO, DVec3::X * 2.0, DVec3::Z * 2.0);
    let mut run = recorded(&scene(G, law(1.0), vec![tile], vec![hopper(0.0, 1.0)]), EXACT);
    let on_top = go(&mut run, 0.99);
    assert!((on_top.x[0].y - R).abs() <= 2.0 * HEIGHT, "{} m up before the edge", on_top.x[0].y - R);
    let beyond = go(&mut run, 1.5);
    assert!(beyond.x[0].y < 0.0, "it is {} m up, half a second after the edge", beyond.x[0].y);
    let energy = beyond.energy(run.model()) / run.initial_energy() - 1.0;
    assert!(energy.abs() <= 1e-12, "energy off by {energy:e}");
}

#[test]
fn a_ball_that_hops_and_is_rubbed_comes_as_far_as_the_geometric_series_says() {
    // Each impact leaves 0.999 of what slides: after n of them v τⁿ is left, and v T (1 − τⁿ)/(1 − τ) is behind it. So slow
    // a ball (1e-8 of what a fall by its radius gains) loses less energy than rounding, and may lose it untold.
    let (kept, v): (f64, f64) = (0.999, 2e-8);
    let law = ContactLaw { tangential: kept, ..law(1.0) };
    let mut run = recorded(&scene(G, law, vec![floor(20.0)], vec![hopper(0.0, v)]), EXACT);
    for t in [1e-4, 1e-3, 5e-3, 0.01, 0.1, 1.0] {
        let state = go(&mut run, t);
        // It begins at the top of a hop.
        let since = t / period() - 0.5;
        let done = since.floor();
        let left = kept.powi(done as i32 + 1);
        let slid = v * period() * (0.5 + kept * (1.0 - kept.powi(done as i32)) / (1.0 - kept) + left * (since - done));
        assert!((state.x[0].x - slid).abs() <= 1e-9 * slid, "x = {:e} instead of {slid:e} m at {t} s", state.x[0].x);
        assert!((state.v[0].x - v * left).abs() <= 1e-6 * v, "{:e} m/s left at {t} s", state.v[0].x);
    }
    // the hops went at once, but for a few
    let (impacts, turns) = (run.tallies().impacts, run.tallies().frames);
    assert!(impacts as f64 >= 1.0 / period() - 2.0 && turns < impacts / 100, "{impacts} impacts in {turns} turns");
}

#[test]
fn what_lies_within_the_hops_of_a_ball_is_met() {
    // Four balls all but fit between two elastic walls, pulled towards the first. The one beside it is sent to and fro until
    // it hops on its wall by some 1e-13 m, and touches the next, which falls towards it.
    let down =
        |x: f64, (y, z): (f64, f64), v: DVec3, mass: f64| carom::scene::Sphere { mass, ..ball(dvec3(x, y, z), v) };
    let balls = vec![
        down(0.0, (0.0, 0.0), dvec3(0.0, -0.20549385131075892, 0.0009112829034687922), 1.0),
        down(
            0.4999999999934867,
            (2.1743579364886654e-6, 1.3362104666611093e-6),
            dvec3(0.0, 0.0003020704031308634, 0.20572785606573563),
            5.0,
        ),
        down(0.9999999999934589, (2.341056863058929e-6, 1.3362104666611093e-6), DVec3::ZERO, 0.1),
        down(1.5000002498590133, (-9.525941274450468e-7, 1.2453649464207614e-5), DVec3::ZERO, 1.0),
    ];
    let upright = |x: f64| wall(DVec3::X * x, DVec3::Y * 10.0, DVec3::Z * 10.0);
    let back = wall(dvec3(0.75, 0.0, -0.25), DVec3::X * 2.5, DVec3::Y * 10.0);
    let walls = vec![upright(-0.25000000000025), upright(1.7500002498591543), back];
    let mut run = recorded(&scene(dvec3(-3.0, -9.8, 0.0), law(0.8), walls, balls), EXACT);
    for k in 1..=20 {
        let state = go(&mut run, 0.01 * f64::from(k));
        for pair in state.x.windows(2) {
            let gap = pair[0].distance(pair[1]) - 2.0 * R;
            assert!(gap >= -1e-12, "{gap:e} m at {} s", state.t);
        }
    }
}

/// Gap between two upright walls and a ball in it, m: 2⁻³³, as coordinates round it exactly.
const GAP: f64 = HEIGHT;

/// Speed at which a ball goes to and fro in that gap, m/s: it strikes a wall 8.6e8 times a second.
const ACROSS: f64 = 0.1;

/// Two upright walls that a ball at x = R all but fits between.
fn gap() -> Vec<carom::scene::Wall> {
    [0.0, 2.0 * R + GAP].map(|x| wall(DVec3::X * x, DVec3::Y * 40.0, DVec3::Z * 40.0)).to_vec()
}

#[test]
fn a_ball_in_a_gap_goes_to_and_fro_a_billion_times_a_second_and_flies_along_it() {
    let v = dvec3(ACROSS, 1.0, 0.5);
    let mut run = recorded(&scene(G, law(1.0), gap(), vec![ball(DVec3::X * R, v)]), EXACT);
    for k in 1..=10 {
        let t = 0.13 * f64::from(k);
        let state = go(&mut run, t);
        let flown = dvec3(R, v.y * t + 0.5 * G.y * t * t, v.z * t);
        let (x, off) = (state.x[0], state.x[0] - flown);
        // Each flight begins where coordinates round it to: along the walls that leaves an ulp a hundred times a second.
        assert!(off.y.abs() <= 1e-13 && off.z.abs() <= 1e-13, "{off} m off at {t} s");
        assert!(off.x >= -1e-15 && off.x <= GAP + 1e-15, "{x} is not within the gap at {t} s");
        assert!((state.v[0].x.abs() - ACROSS).abs() <= 1e-12 * ACROSS, "{} m/s at {t} s", state.v[0]);
    }
    let (impacts, expected) = (run.tallies().impacts as f64, ACROSS / GAP * run.time());
    // The clock tells a flight to a ten-millionth.
    assert!((impacts / expected - 1.0).abs() <= 1e-6, "{impacts} impacts instead of {expected}");
    assert!(run.tallies().frames < 10_000, "{} frames", run.tallies().frames);
    let energy = run.state().energy(run.model()) / run.initial_energy() - 1.0;
    // Of the height and the fall, a hundred times as much as their sum.
    assert!(energy.abs() <= 1e-13, "energy off by {energy:e}");
}

#[test]
fn a_ball_in_a_gap_that_rubs_creeps_as_the_limit_of_the_law_says() {
    // Each impact leaves a half of what slides, and each flight of T adds g T: v' = (v + g T) / 2 ends at v = g T, and a
    // flight leads v T + g T²/2 down, so that the ball creeps at 3/2 g T = 17 nm/s: 1e-17 m a flight, which no place tells.
    let law = ContactLaw { tangential: 0.5, ..law(1.0) };
    let start = ball(dvec3(R, 3.0, 0.0), DVec3::X * ACROSS);
    let mut run = recorded(&scene(G, law, gap(), vec![start]), EXACT);
    let flight = GAP / ACROSS;
    let creeps = 1.5 * -G.y * flight;
    for k in 1..=5 {
        let t = 0.2 * f64::from(k);
        let fallen = 3.0 - go(&mut run, t).x[0].y;
        // Of some 8000 rounds, after which the rows are told, two are followed impact by impact, as places round them.
        assert!((fallen - creeps * t).abs() <= 5e-4 * creeps * t + 1e-15, "{fallen:e} m instead of {:e}", creeps * t);
    }
    // What the walls take is what the fall gives.
    let lost = run.initial_energy() - run.state().energy(run.model());
    assert!((lost + G.y * creeps).abs() <= 1e-3 * creeps * -G.y + 1e-13, "{lost:e} J lost");
    let impacts = run.tallies().impacts as f64;
    assert!((impacts * flight - 1.0).abs() <= 1e-4, "{impacts} impacts in 1 s, {flight:e} s apart");
}

#[test]
fn a_ball_that_goes_straight_from_wall_to_wall_of_a_valley_that_rubs_goes_on_for_ever() {
    // From a wall straight off, by symmetry straight onto the other one: nothing slides, so nothing is rubbed away. Walls at
    // 60° to the ground; the ball begins s up from where it would touch both, at u² = g s cos 60° / (sin 60° cos 60°).
    let (sin, cos) = (0.75_f64.sqrt(), 0.5);
    let (r, s) = (0.5, 1e-12);
    let side = |sign: f64| {
        wall(dvec3(2.0 * cos * sign, 2.0 * sin, 0.0), dvec3(4.0 * cos * sign, 4.0 * sin, 0.0), DVec3::Z * 4.0)
    };
    let (up, normal) = (dvec3(-cos, sin, 0.0), dvec3(sin, cos, 0.0));
    let u = (-G.y * s * cos / (sin * cos)).sqrt();
    let law = ContactLaw { tangential: 0.5, ..law(1.0) };
    let start = sphere(DVec3::Y * (r / cos) + up * s, normal * u, r);
    let mut run = recorded(&scene(G, law, vec![side(1.0), side(-1.0)], vec![start]), EXACT);
    let center = DVec3::Y * (r / cos);
    for k in 1..=10 {
        let state = go(&mut run, f64::from(k));
        let way = state.x[0].distance(center);
        assert!(way <= 2.0 * s, "{way:e} m from where it would rest");
        // Places of 1 m tell 1e-16 m, which is worth g 1e-16 of u²/2.
        let (energy, first) =
            (state.v[0].length_squared() * 0.5 - G.y * (state.x[0].y - center.y), 0.5 * u * u - G.y * s * sin);
        assert!((energy / first - 1.0).abs() <= 0.02, "{energy:e} J instead of {first:e} at {k} s");
    }
    let (impacts, expected) = (run.tallies().impacts as f64, 10.0 * -G.y / (2.0 * u * cos));
    assert!((impacts / expected - 1.0).abs() <= 0.02, "{impacts} impacts instead of {expected}");
    assert!(run.tallies().frames < 10_000, "{} frames", run.tallies().frames);
}

#[test]
fn two_balls_in_a_gap_meet_when_they_should_and_exchange_what_they_have_along_it() {
    // Centres 2 m apart, closing at 1 m/s, while each goes to and fro across the gap: they touch after 1.5 s.
    let balls = [(-1.0, 0.75), (1.0, -0.25)].map(|(z, v)| ball(dvec3(R, 0.0, z), dvec3(ACROSS, 0.0, v)));
    let mut run = recorded(&scene(DVec3::ZERO, law(1.0), gap(), balls.to_vec()), EXACT);
    let state = go(&mut run, 2.5);
    let struck: Vec<_> = run.take_events().into_iter().filter(|row| row.kind == carom::physics::Kind::Pair).collect();
    assert_eq!(struck.len(), 1, "{struck:?}");
    assert!((struck[0].time - 1.5).abs() <= 1e-9, "they meet at {} s", struck[0].time);
    for (found, expected) in state.v.iter().zip([-0.25, 0.75]) {
        // The line of centres is off the level by no more than the gap, 2.3e-10 of the sum of the radii.
        assert!((found.z - expected).abs() <= 1e-9, "{} instead of {expected} m/s", found.z);
    }
}

/// A ball of that radius.
fn ball(x: DVec3, v: DVec3) -> carom::scene::Sphere {
    sphere(x, v, R)
}
