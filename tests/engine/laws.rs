//! Closed forms and conservation laws.

use crate::support::{
    ELASTIC, G, PAPER_LAW, floor, gas, lattice, paper, paper_scene, room, run_to, scene, sphere, wall,
};
use carom::physics::{Simulation, Until};
use glam::{DVec3, dvec3};

#[test]
fn a_drop_in_euler_frames_falls_by_g_t_times_t_plus_dt_over_two() {
    for dt in [0.1, 0.01, 0.001] {
        let body = sphere(DVec3::Y * 100.0, DVec3::ZERO, 0.5);
        let mut run = Simulation::new(&scene(G, PAPER_LAW, Vec::new(), vec![body]), paper(dt, 1e-3));
        for k in 1..=1000 {
            run.advance(Until::Frame, u64::MAX);
            let t = f64::from(k) * dt;
            let y = 100.0 - 9.8 * t * (t + dt) / 2.0;
            // Each of k additions rounds x, v and t by half an ulp; falls of 5e4 m have ulps of 7e-12 m.
            let rounding = f64::from(k) * (y.abs() + 100.0) * 1e-15;
            assert!((run.state().x[0].y - y).abs() <= rounding, "dt {dt}, t {t}: {}", run.state().x[0].y - y);
        }
    }
}

#[test]
fn the_error_of_a_free_flight_is_first_order_in_dt() {
    // In scene 0 nothing is hit before 1.35 s: up to t = 1 the error is g t dt / 2 = 4.9 dt.
    for dt in [0.1, 0.01, 0.001, 0.0001] {
        let mut run = Simulation::new(&paper_scene(0), paper(dt, 1e-3));
        let mut worst = 0.0_f64;
        while run.time() < 1.0 - 0.5 * dt {
            run.advance(Until::Frame, u64::MAX);
            let t = run.time();
            worst = worst.max((run.state().x[0].y - (9.5 - 4.9 * t * t)).abs());
        }
        // 10⁴ roundings of a position near 10 m against an error of 5e-4 m: nine digits are there.
        assert!((worst / (4.9 * dt) - 1.0).abs() < 1e-8, "dt {dt}: {worst}");
    }
}

#[test]
fn flight_loses_half_g_squared_dt_joules_per_second_and_kilogram() {
    let mut body = sphere(DVec3::ZERO, dvec3(3.0, 20.0, -1.0), 0.5);
    body.mass = 2.5;
    let mut run = Simulation::new(&scene(G, PAPER_LAW, Vec::new(), vec![body]), paper(0.01, 1e-3));
    run_to(&mut run, 10.0, u64::MAX);
    let lost = (run.initial_energy() - run.energy()) / (2.5 * run.time());
    // 48 dt J/s per kg; energies near 1e3 J keep twelve digits.
    assert!((lost / (0.5 * 9.8 * 9.8 * 0.01) - 1.0).abs() < 1e-10, "{lost}");
}

#[test]
fn an_elastic_bounce_loses_g_dt_u() {
    // Ten bounces from 5 m at u = √(2 g h) = 9.9 m/s: from 53.9 J to 44.3 J (dt 0.01), 52.94 J (dt 0.001).
    for dt in [0.01, 0.001] {
        let walls = vec![floor(20.0)];
        let body = sphere(DVec3::Y * 5.5, DVec3::ZERO, 0.5);
        let mut run = Simulation::new(&scene(G, ELASTIC, walls, vec![body]), paper(dt, 1e-3));
        while run.tallies().impacts < 10 {
            run.advance(Until::Frame, u64::MAX);
        }
        let lost = run.initial_energy() - run.energy();
        // u falls with the energy, by a tenth at dt = 0.01, and the tenth flight is half a flight.
        assert!((lost / (10.0 * 9.8 * dt * 9.9) - 1.0).abs() < 0.1, "dt {dt}: {lost} J");
    }
}

#[test]
fn pairs_keep_the_momentum_to_rounding_and_elastic_ones_the_energy() {
    // A lattice that falls in on itself, without walls: velocities point to the middle.
    let mut spheres = lattice(5, 0.45, DVec3::ZERO, 0.2);
    for (k, body) in spheres.iter_mut().enumerate() {
        body.v = -body.x + dvec3(0.01, -0.02, 0.005) * (k % 7) as f64;
        body.mass = 0.5 + (k % 5) as f64;
    }
    for law in [ELASTIC, PAPER_LAW] {
        let mut run = Simulation::new(&scene(DVec3::ZERO, law, Vec::new(), spheres.clone()), paper(0.001, 1e-3));
        let before = run.state().momentum(run.model());
        assert!(run_to(&mut run, 0.5, u64::MAX).is_none());
        let impacts = run.tallies().impacts as f64;
        assert!(impacts > 100.0, "{impacts}");
        // Each impact rounds momenta of at most a few kg m/s.
        let drift = (run.state().momentum(run.model()) - before).length();
        assert!(drift <= impacts * 4e-15, "{drift} kg m/s after {impacts} impacts");
    }
}

#[test]
fn equal_elastic_spheres_on_a_line_pass_their_velocity_on() {
    let mut spheres: Vec<_> = (0..5).map(|k| sphere(DVec3::X * (f64::from(k) * 1.5), DVec3::ZERO, 0.5)).collect();
    spheres[0].v = DVec3::X * 2.0;
    let mut run = Simulation::new(&scene(DVec3::ZERO, ELASTIC, Vec::new(), spheres), paper(0.01, 1e-6));
    run_to(&mut run, 3.0, u64::MAX);
    let mut expected = [DVec3::ZERO; 5];
    expected[4] = DVec3::X * 2.0;
    assert_eq!(run.state().v, expected);
}

#[test]
fn fast_spheres_tunnel_with_probability_one_minus_2r_over_v_dt() {
    let (r, dt, offsets) = (0.5, 0.01, 200);
    for v in [90.0, 101.0, 110.0, 200.0, 1000.0, 1e6] {
        let tunnelled = (0..offsets).filter(|&k| {
            // Evenly spread starts, one frame's way long.
            let start = 1.0 + v * dt * (f64::from(k) + 0.5) / f64::from(offsets);
            let walls = vec![wall(DVec3::ZERO, DVec3::Y * 9.0, DVec3::Z * 9.0)];
            let body = sphere(DVec3::X * start, DVec3::X * -v, r);
            let mut run = Simulation::new(&scene(DVec3::ZERO, ELASTIC, walls, vec![body]), paper(dt, 1e-3));
            run_to(&mut run, 5.0 / v + 4.0 * dt, u64::MAX);
            run.state().x[0].x < 0.0
        });
        let expected = (1.0 - 2.0 * r / (v * dt)).max(0.0);
        // A fraction of 200 evenly spread starts is known to one of them.
        let found = tunnelled.count() as f64 / f64::from(offsets);
        assert!((found - expected).abs() <= 1.0 / f64::from(offsets), "{v} m/s: {found}, not {expected}");
    }
}

#[test]
fn a_gas_in_a_box_stays_in_it_and_keeps_its_energy() {
    // 100 spheres: the neighbour search finds what looking at all pairs finds, or spheres would pass each other.
    let mut run = Simulation::new(&gas(100, 11, 1.0), paper(0.01, 1e-6));
    assert!(run_to(&mut run, 1.0, u64::MAX).is_none());
    assert!(run.tallies().impacts > 100, "{}", run.tallies().impacts);
    // Elastic impacts without gravity keep the energy to rounding: 1e-15 of it each.
    assert!((run.energy() / run.initial_energy() - 1.0).abs() < 1e-12);
    assert!(run.tallies().deepest_degree <= 1e-6 + 1e-4);
    let half = run.model().faces[0].shape.s1.length() / 2.0;
    assert!(run.state().x.iter().all(|x| x.abs().max_element() < half));
}

#[test]
fn a_sphere_in_a_corner_of_elastic_walls_comes_back_the_way_it_went() {
    let walls = room(DVec3::splat(-2.0), DVec3::splat(2.0));
    let v = dvec3(1.0, 1.0, 1.0);
    let mut run =
        Simulation::new(&scene(DVec3::ZERO, ELASTIC, walls, vec![sphere(DVec3::ZERO, v, 0.5)]), paper(0.01, 1e-6));
    run_to(&mut run, 2.5, u64::MAX);
    assert_eq!((run.state().v[0], run.tallies().impacts), (-v, 3));
}
