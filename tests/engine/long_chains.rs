//! Chains of impacts at one place, however long: against the impact law blow by blow, and against its limits.

use crate::support::{ELASTIC, ball, floor, go, recorded, room, scene, sphere, wall};
use carom::physics::{ContactLaw, Method, Settings, Simulation};
use carom::scene::Sphere;
use glam::{DVec3, dvec3};

const EXACT: Settings = Settings { method: Method::Exact, dt: 0.1, tolerance: 1e-3 };

/// Radii of a light ball on the floor and a heavy one that comes down on it, m.
const RADII: [f64; 2] = [0.1, 0.5];

/// Direction from the light ball to the heavy one: 60° steep.
fn normal() -> DVec3 {
    dvec3(-0.5, 0.75_f64.sqrt(), 0.0)
}

/// A light ball on the floor, still, and a heavy one that touches it and comes at it; a quarter of a metre per second
/// sideways, so that the chain turns what rubs.
fn wedge(law: ContactLaw, light: f64) -> Simulation {
    let below = DVec3::Y * RADII[0];
    let small = Sphere { mass: light, ..sphere(below, DVec3::ZERO, RADII[0]) };
    let big = sphere(below + normal() * (RADII[0] + RADII[1]), COMING, RADII[1]);
    recorded(&scene(DVec3::ZERO, law, vec![floor(20.0)], vec![small, big]), EXACT)
}

const COMING: DVec3 = DVec3::new(1.0, -0.5, 0.25);

fn law(restitution: f64, wall_restitution: f64, tangential: f64) -> ContactLaw {
    ContactLaw { restitution, wall_restitution, tangential, rest_speed: 0.0 }
}

/// The law blow by blow: velocities (m/s) of a light ball of `light` kg and a heavy one of 1 kg, and the number of impacts,
/// until neither contact approaches by more than a millionth of a millionth of a metre per second.
fn blow_by_blow(law: ContactLaw, light: f64) -> ([DVec3; 2], u64) {
    let ([mut v, mut w], mut count) = ([DVec3::ZERO, COMING], 0);
    loop {
        let (on_floor, on_ball) = (v.y, (w - v).dot(normal()));
        if on_floor < -1e-12 {
            let across = dvec3(v.x, 0.0, v.z);
            v = across * law.tangential - DVec3::Y * (law.wall_restitution * on_floor);
        } else if on_ball < -1e-12 {
            let push = normal() * (-(1.0 + law.restitution) * on_ball / (1.0 / light + 1.0));
            (v, w) = (v - push / light, w + push);
        } else {
            return ([v, w], count);
        }
        count += 1;
    }
}

#[test]
fn a_light_ball_in_the_wedge_between_a_heavy_one_and_a_wall_is_struck_as_the_law_says() {
    let laws = [law(0.0, 0.0, 0.5), law(0.0, 0.0, 0.9), law(0.3, 0.0, 0.5), law(0.5, 0.7, 0.9), law(1.0, 1.0, 0.5)];
    for law in laws {
        let ([light, heavy], count) = blow_by_blow(law, 1e-4);
        let mut run = wedge(law, 1e-4);
        let state = go(&mut run, 1e-9);
        // A chain of as many impacts, each of which rounds; where approaches die out without end, those of 1e-12 m/s that
        // the sum leaves out change the light ball by as much, 1e4 times.
        let off = [state.v[0] - light, state.v[1] - heavy].map(DVec3::length);
        assert!(off[0] <= 1e-7 && off[1] <= 1e-10, "{law:?}: {} and {}, after {count} impacts; {off:?}", light, heavy);
        assert!(count > 1000, "{law:?}: {count} impacts are no long chain");
    }
}

#[test]
fn of_a_wedge_that_rubs_the_limit_is_a_light_ball_that_holds_the_heavy_one() {
    // The light ball is rubbed until it stands, however light: the heavy one loses all of its approach, and nothing else.
    for light in [1e-6, 1e-9, 1e-12] {
        let mut run = wedge(law(0.0, 0.0, 0.5), light);
        let state = go(&mut run, 1e-9);
        let expected = COMING - normal() * COMING.dot(normal());
        // The light ball has carried off of the momentum its own share at most, along the floor.
        let (left, off) = (state.v[0].length(), (state.v[1] - expected).length());
        assert!(left <= 1e-9 && off <= 2.0 * light + 1e-11, "{light} kg: {left:e} m/s left, off by {off:e} m/s");
        assert!(run.tallies().impacts as f64 > 1.0 / light, "{light} kg: {} impacts", run.tallies().impacts);
    }
}

#[test]
fn what_comes_to_rest_at_two_walls_does_not_wait_while_a_heavy_ball_drives_it_into_a_third() {
    // A light ball gets into the corner of a room, and a heavy one comes at it: where it approaches two of the walls no
    // faster than rest_speed it rests, while the heavy one strikes it into the third hundreds of millions of times. The heavy
    // one loses its approach down to rest_speed, and then rests too; nothing else changes it.
    let small = Sphere {
        mass: 2.514_754_975_431_319_4e-8,
        ..sphere(
            dvec3(4.642_917_632_733_574, -1.469_559_658_257_505, -4.748_462_131_178_252),
            dvec3(0.304_862_245_628_241_5, -2.841_703_243_920_784, 0.820_703_548_539_224_7),
            0.000_146_487_948_303_904_71,
        )
    };
    let big = sphere(
        dvec3(3.568_469_861_396_640_6, -4.174_013_858_534_769, 0.054_516_162_298_543_606),
        dvec3(1.134_849_168_541_815, -2.154_528_272_285_235, -2.681_031_745_955_433_4),
        0.000_185_140_552_984_523_11,
    );
    let law = ContactLaw { rest_speed: 0.1, ..law(0.0, 0.0, 1.0) };
    let walls = room(DVec3::splat(-5.0), DVec3::splat(5.0));
    let mut run = recorded(&scene(DVec3::ZERO, law, walls, vec![small, big]), EXACT);
    let before = go(&mut run, 1.885_111_07);
    let after = go(&mut run, 1.885_111_071_922_65);
    let normal = (after.x[1] - after.x[0]).normalize();
    let expected = before.v[1] - normal * before.v[1].dot(normal);
    let off = (after.v[1] - expected).length();
    // Nothing of it is left along the normal; the light ball can have taken its own share at most, in as many strikes.
    assert!(off <= 1e-6, "the heavy ball is off by {off:e} m/s: {} instead of {expected}", after.v[1]);
    assert!(after.v[1].dot(normal).abs() <= 1e-9, "it still comes at {:e} m/s", after.v[1].dot(normal));
    assert!(run.tallies().impacts > 100_000_000, "{} impacts", run.tallies().impacts);
}

#[test]
fn the_digits_of_pi_are_counted_to_the_billions_at_one_instant() {
    // Galperin 2003: a wall, 1 kg at rest, 100^k kg coming in: ⌊π 10^k⌋ impacts.
    for (k, digits) in [(5, 314_159), (6, 3_141_592), (7, 31_415_926), (8, 314_159_265), (9, 3_141_592_653_u64)] {
        let stop = wall(DVec3::ZERO, DVec3::Y * 4.0, DVec3::Z * 4.0);
        let spheres = vec![ball(0.5, 0.0, 1.0), ball(1.5, -1.0, 100_f64.powi(k))];
        let mut run = recorded(&scene(DVec3::ZERO, ELASTIC, vec![stop], spheres), EXACT);
        let state = go(&mut run, 1.0);
        assert_eq!((run.tallies().impacts, run.tallies().collapses), (digits, 0), "mass 100^{k}");
        // Those that are skipped are followed in 32 digits; the few hundred others round the energy by an ulp each.
        let error = state.energy(run.model()) / run.initial_energy() - 1.0;
        assert!(error.abs() <= 1000.0 * f64::EPSILON, "mass 100^{k}: energy off by {error:e}");
    }
}

#[test]
fn a_ball_that_follows_is_met_where_the_chain_has_slowed_the_heavy_one_down_to_it() {
    // All touch at one instant; the one behind the heavy ball comes at half its speed, and is struck in the middle of the
    // chain: what is skipped must end there, and go on afterwards.
    let (masses, begin) = ([1.0, 1e6, 1e4], [0.0, -1.0, -0.5]);
    let (mut v, mut count) = (begin, 0_u64);
    loop {
        if v[0] < 0.0 {
            v[0] = -v[0];
        } else if let Some(k) = (0..2).find(|&k| v[k + 1] < v[k]) {
            let impulse = 2.0 * (v[k] - v[k + 1]) / (1.0 / masses[k] + 1.0 / masses[k + 1]);
            v[k] -= impulse / masses[k];
            v[k + 1] += impulse / masses[k + 1];
        } else {
            break;
        }
        count += 1;
    }
    let stop = wall(DVec3::ZERO, DVec3::Y * 4.0, DVec3::Z * 4.0);
    let spheres = (0..3).map(|k| ball(0.5 + k as f64, begin[k], masses[k])).collect();
    let mut run = recorded(&scene(DVec3::ZERO, ELASTIC, vec![stop], spheres), EXACT);
    let state = go(&mut run, 1e-9);
    assert!(run.take_events().iter().any(|row| row.impacts > 1), "nothing was skipped");
    assert_eq!(run.tallies().impacts, count);
    for (found, expected) in state.v.iter().zip(v) {
        // Thousands of impacts, each of which rounds; what they turn grows with √(M/m) for the light ball.
        assert!((found.x - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{} instead of {expected} m/s", found.x);
    }
}

#[test]
fn the_rows_of_a_long_chain_give_its_momentum() {
    let mut run = wedge(law(0.0, 0.0, 0.5), 1e-6);
    let state = go(&mut run, 1e-9);
    let events = run.take_events();
    let told: u64 = events.iter().map(carom::physics::Contact::impact_count).sum();
    assert_eq!(told, run.tallies().impacts);
    // What the heavy ball has lost is what the rows of the pair have given it.
    let given: DVec3 = events.iter().filter(|row| row.a == 0 && row.b == 1).map(|row| row.normal * -row.impulse).sum();
    let off = (state.v[1] - COMING - given).length();
    assert!(off <= 1e-12, "{off:e} m/s unexplained");
}
