//! The impact law is not cut short: a chain of impacts that ends is computed to its end, and what a rule takes away is
//! what the bounces that it stands for would have taken.
//!
//! `CAROM_LONG=1 cargo test --release --test engine impact_law::` counts six digits of π at one instant too.

use crate::support::{ELASTIC, G, ball, changed, floor, go, recorded, scene, smooth, sphere, wall};
use carom::physics::{Class, Contact, ContactLaw, Method, Scene, Settings, Simulation};
use carom::scene::{Sphere, Wall};
use glam::{DVec3, dvec3};

/// One rounding, relative.
const EPS: f64 = f64::EPSILON;

fn start(scene: &Scene, method: Method) -> Simulation {
    recorded(scene, Settings { method, dt: 1e3, tolerance: 1e-3 })
}

/// A wall across the x axis.
fn stop(x: f64) -> Wall {
    wall(DVec3::X * x, DVec3::Y * 10.0, DVec3::Z * 10.0)
}

/// Points in a row between walls, the impact law one by one: what spheres of radius 0.5 m do on a line, their widths
/// left out. No rule but the law.
struct Row {
    e: f64,
    /// The gap before each, m: before the first that of the left wall; the last that of the right one, infinite if none.
    gaps: Vec<f64>,
    speeds: Vec<f64>,
    masses: Vec<f64>,
    time: f64,
    impacts: u64,
}

impl Row {
    /// Speed at which gap `k` closes, m/s.
    fn closing(&self, k: usize) -> f64 {
        let left = if k == 0 { 0.0 } else { self.speeds[k - 1] };
        let right = if k == self.speeds.len() { 0.0 } else { self.speeds[k] };
        left - right
    }

    /// The next impact, if there is one by `until`, s; else it goes on to that time.
    fn step(&mut self, until: f64) -> bool {
        let meets = |k: usize| (self.gaps[k].max(0.0) / self.closing(k), k);
        let first =
            (0..self.gaps.len()).filter(|&k| self.closing(k) > 0.0).map(meets).min_by(|a, b| a.0.total_cmp(&b.0));
        let (after, hit) = first.unwrap_or((f64::INFINITY, 0));
        let step = after.min(until - self.time);
        for k in 0..self.gaps.len() {
            self.gaps[k] -= self.closing(k) * step;
        }
        self.time += step;
        if after > step {
            return false;
        }
        self.gaps[hit] = 0.0;
        let n = self.speeds.len();
        let share = |k: usize| 1.0 / self.masses[k];
        let (a, b) = (if hit == 0 { 0.0 } else { share(hit - 1) }, if hit == n { 0.0 } else { share(hit) });
        let impulse = (1.0 + self.e) * self.closing(hit) / (a + b);
        if hit > 0 {
            self.speeds[hit - 1] -= impulse * a;
        }
        if hit < n {
            self.speeds[hit] += impulse * b;
        }
        self.impacts += 1;
        true
    }

    fn run(mut self, until: f64) -> Row {
        while self.step(until) {
            assert!(self.impacts < 20_000_000, "the reference does not end");
        }
        self
    }
}

/// The scene of a row whose left wall is at x = 0, and the row.
fn row(e: f64, gaps: &[f64], speeds: &[f64], masses: &[f64]) -> (Scene, Row) {
    let (mut x, mut spheres) = (0.0, Vec::new());
    for k in 0..speeds.len() {
        x += gaps[k] + 0.5;
        spheres.push(ball(x, speeds[k], masses[k]));
        x += 0.5;
    }
    let mut walls = vec![stop(0.0)];
    walls.extend(gaps.last().filter(|gap| gap.is_finite()).map(|gap| stop(x + gap)));
    let row = Row { e, gaps: gaps.into(), speeds: speeds.into(), masses: masses.into(), time: 0.0, impacts: 0 };
    (scene(DVec3::ZERO, smooth(e), walls, spheres), row)
}

/// That a method does what the law does one by one, until `until`, s.
fn assert_as_by_the_law(case: (Scene, Row), until: f64, method: Method, growth: f64) {
    let (scene, row) = (case.0, case.1.run(until));
    // Each impact rounds the speeds, and what it rounds grows with the impacts that follow.
    let tolerance = 4.0 * EPS * row.impacts as f64 * growth;
    let mut run = start(&scene, method);
    let state = go(&mut run, until);
    let what = format!("{method:?}, e = {}, masses {:?}", row.e, row.masses);
    let fastest = row.speeds.iter().fold(0.0, |fastest: f64, speed| fastest.max(speed.abs()));
    for (found, &expected) in state.v.iter().zip(&row.speeds) {
        let error = (found.x - expected).abs();
        assert!(
            error <= tolerance * fastest,
            "{what}: {} m/s instead of {expected} m/s after {} impacts",
            found.x,
            row.impacts
        );
    }
    assert_eq!((impacts_by(&mut run, until), run.tallies().collapses), (row.impacts, 0), "{what}");
}

/// Impacts until a time, s: the last frame goes on to what comes after it.
fn impacts_by(run: &mut Simulation, until: f64) -> u64 {
    run.take_events().iter().filter(|row| row.time <= until).map(Contact::impact_count).sum()
}

#[test]
fn a_light_ball_between_a_wall_and_a_heavy_one_sends_it_back_whatever_the_restitution() {
    // Thousands of impacts within a microsecond, with or without a gap. Where 1 − e is well below 4 √(m/M), the chain of
    // impacts ends (the two impacts of a round have complex eigenvalues), and the heavy ball leaves.
    let cases: [(f64, &[f64]); 6] = [
        (1e2, &[0.9, 0.99, 1.0]),
        (1e4, &[0.99, 0.999, 1.0]),
        (1e6, &[0.999, 0.99999, 1.0]),
        (1e7, &[0.9995, 0.99999, 0.999_999, 1.0]),
        (1e8, &[0.99999, 1.0]),
        (1e9, &[0.99999, 1.0 - 1e-7, 1.0]),
    ];
    for (mass, restitutions) in cases {
        for (&e, gap) in restitutions.iter().flat_map(|e| [(e, 0.0), (e, 1.0)]) {
            let case = row(e, &[0.0, gap, f64::INFINITY], &[0.0, -1.0], &[1.0, mass]);
            // By the last impact what the first have changed has turned by half a circle and no more, in the plane of
            // √M V and √m v: an error of the heavy ball's speed is √(M/m) times as large as one of the light ball's.
            assert_as_by_the_law(case, 6.0, Method::Exact, mass.sqrt());
        }
    }
}

#[test]
fn a_heavy_ball_is_turned_round_by_light_ones_at_two_walls() {
    for (mass, e) in [(1e3, 0.999), (1e4, 0.9999), (1e5, 1.0)] {
        let case = row(e, &[0.25, 1.0, 0.5, 0.0], &[0.0, -1.0, 0.0], &[1.0, mass, 2.0]);
        // As in the test before, and once more for the second wall.
        assert_as_by_the_law(case, 3.0, Method::Exact, mass);
    }
}

#[test]
fn swept_sends_the_heavy_ball_back_too() {
    for (mass, e) in [(1e6, 1.0), (1e7, 0.99999)] {
        let case = row(e, &[0.0, 0.0, f64::INFINITY], &[0.0, -1.0], &[1.0, mass]);
        assert_as_by_the_law(case, 4.0, Method::Swept, mass.sqrt());
    }
}

#[test]
fn a_squeeze_that_loses_too_much_comes_to_rest() {
    // 1 − e far over 4 √(m/M): real eigenvalues below 1, and the heavy ball's speed goes to 0 with the light one's.
    for (mass, e) in [(1e6, 0.9), (1e4, 0.5), (1e5, 0.9)] {
        let (scene, _) = row(e, &[0.0, 1.0, f64::INFINITY], &[0.0, -1.0], &[1.0, mass]);
        let mut run = start(&scene, Method::Exact);
        let state = go(&mut run, 4.0);
        // What is left is rounding of the speed that it came with.
        assert!(state.v.iter().all(|v| v.length() <= 1e-13), "e = {e}, {mass} kg: {:?}", state.v);
        assert!(run.tallies().collapses > 0);
    }
}

#[test]
fn digits_of_pi_are_counted_at_one_instant() {
    // Galperin 2003: ⌊π 10^k⌋ impacts of a light ball that touches the wall and the heavy one, all at t = 0.
    let more = std::env::var_os("CAROM_LONG").is_some_and(|value| value != "0");
    let counts: &[(i32, u64)] = if more { &[(5, 314_159), (6, 3_141_592)] } else { &[(5, 314_159)] };
    for &(k, digits) in counts {
        let balls = vec![ball(0.5, 0.0, 1.0), ball(1.5, -1.0, 100_f64.powi(k))];
        let mut run = start(&scene(DVec3::ZERO, ELASTIC, vec![stop(0.0)], balls), Method::Exact);
        let state = go(&mut run, 1.0);
        assert_eq!((run.tallies().impacts, run.tallies().collapses), (digits, 0), "mass 100^{k}");
        let error = state.energy(run.model()) / run.initial_energy() - 1.0;
        assert!(error.abs() <= EPS * digits as f64, "mass 100^{k}: energy off by {error:e}");
    }
}

#[test]
fn nothing_is_taken_where_nothing_is_lossy() {
    // A ball of 1000 t falls on one of 1 kg, which bounces on the floor, or lies there: energy is kept, whatever the chain
    // of impacts. Touching, all of it happens at one instant, and each impact's gap is 0.
    for (method, gap) in [Method::Exact, Method::Swept].into_iter().flat_map(|m| [0.1, 1e-9, 0.0].map(|gap| (m, gap))) {
        let light = sphere(DVec3::Y * (0.5 + gap), DVec3::ZERO, 0.5);
        let heavy = Sphere { mass: 1e6, ..sphere(DVec3::Y * 3.0, DVec3::ZERO, 0.5) };
        let mut run = start(&scene(G, ELASTIC, vec![floor(100.0)], vec![light, heavy]), method);
        for t in [0.5, 0.6, 1.0, 1.5, 2.0] {
            let state = go(&mut run, t);
            let error = state.energy(run.model()) / run.initial_energy() - 1.0;
            // Tens of thousands of impacts at most, each of which rounds the energy by an ulp at random.
            assert!(error.abs() <= 1e-12, "{method:?}, gap {gap} m: energy off by {error:e} at {t} s");
        }
        assert_eq!(run.tallies().collapses, 0, "{method:?}, gap {gap} m");
    }
}

#[test]
fn three_balls_of_no_restitution_end_as_the_impacts_do() {
    // The middle ball is driven into two others in turn, each approach a tenth of the one before, until nothing is left.
    // The right digits: the law one by one in numbers of 200 bits, a hundred impacts down to 1e-50 m/s.
    let expected = [
        dvec3(3.623_210_361_942_523_5, 1.008_137_558_257_403_4e-4, 0.0),
        dvec3(0.688_321_582_741_534_8, 1.421_283_366_668_984_4, 0.0),
        dvec3(0.688_468_055_315_941_6, -1.421_384_180_424_810_2, 0.0),
    ];
    for rest_speed in [0.0, 1e-6, 0.05] {
        let law = ContactLaw { rest_speed, ..smooth(0.0) };
        let at = |x: f64, y: f64, v: f64| sphere(dvec3(x, y, 0.0), DVec3::X * v, 0.5);
        let balls = vec![at(-1.0, 0.0, 5.0), at(1.0, 0.9, 0.0), at(1.0001, -0.9, 0.0)];
        let mut run = start(&scene(DVec3::ZERO, law, Vec::new(), balls), Method::Exact);
        let state = go(&mut run, 2.0);
        for (found, expected) in state.v.iter().zip(expected) {
            // The normals are those of places under 2 m, known to some ulp over the distance of 1 m.
            assert!(
                (*found - expected).length() <= 64.0 * EPS,
                "rest_speed {rest_speed}: {found} instead of {expected}"
            );
        }
    }
}

/// A sphere of radius 0.5 m thrown at a tilted wall: what all its bounces leave.
struct Thrown {
    e: f64,
    tangential: f64,
    /// Sine of the slope; the cosine is that of 3-4-5, or 1.
    slope: [f64; 2],
    /// Height over the wall (m), and speed along it (m/s), at the start.
    height: f64,
    along: f64,
}

impl Thrown {
    fn scene(&self) -> Scene {
        let [sin, cos] = self.slope;
        let (down, out) = (dvec3(cos, -sin, 0.0), dvec3(sin, cos, 0.0));
        let law = ContactLaw { tangential: self.tangential, ..smooth(self.e) };
        let tilted = wall(DVec3::ZERO, down * 400.0, DVec3::Z * 8.0);
        scene(G, law, vec![tilted], vec![sphere(out * (0.5 + self.height), down * self.along, 0.5)])
    }

    /// When the bounces end (s) and how far down the wall (m), bounce by bounce. Infinitely many leave no speed along it.
    fn end(&self) -> (f64, f64) {
        let (pull, press) = (9.8 * self.slope[0], 9.8 * self.slope[1]);
        let mut flight = (2.0 * self.height / press).sqrt();
        let mut speed = press * flight;
        let (mut time, mut way, mut along) = (0.0, 0.0, self.along);
        while flight > 1e-25 {
            way += along * flight + 0.5 * pull * flight * flight;
            along = (along + pull * flight) * self.tangential;
            time += flight;
            speed *= self.e;
            flight = 2.0 * speed / press;
        }
        (time, way)
    }
}

#[test]
fn bounces_that_rub_end_where_their_series_does() {
    // Without friction they would go on with their speed along the wall; with it, infinitely many impacts take all of it.
    let level = [0.0, 1.0];
    let tilted = [0.6, 0.8];
    for (e, tangential) in [(1e-4, 0.99), (0.1, 0.9), (0.5, 0.99), (0.5, 0.3), (0.8, 0.0), (0.9, 0.9), (0.95, 0.5)] {
        for (slope, along) in [(level, 0.3), (tilted, 0.3), (tilted, 0.0), (tilted, -2.0)] {
            let thrown = Thrown { e, tangential, slope, height: 0.25, along };
            let (time, way) = thrown.end();
            let mut run = start(&thrown.scene(), Method::Exact);
            let after = 0.5;
            let state = go(&mut run, time + after);
            // then it slides down without friction: a rest does not rub
            let pull = 9.8 * slope[0];
            let down = dvec3(slope[1], -slope[0], 0.0);
            let (x, v) = (way + 0.5 * pull * after * after, pull * after);
            let what = format!("e = {e}, tangential {tangential}, slope {slope:?}, {along} m/s");
            let (found_x, found_v) = (state.x[0].dot(down), state.v[0].dot(down));
            // The distance from a tilted wall is known to some ulp of 10 m, 1e-2 of the hops of 1e-12 r from which on the
            // sum is taken, and with it how long it lasts, 1e-6 s / (1 − e), before it slides down, at 3 m/s in the end.
            let tolerance = if slope == level { 1e-12 } else { 3e-8 / (1.0 - e) };
            assert!((found_x - x).abs() <= tolerance, "{what}: {found_x} m instead of {x} m, off by {:e}", found_x - x);
            assert!(
                (found_v - v).abs() <= tolerance,
                "{what}: {found_v} m/s instead of {v} m/s, off by {:e}",
                found_v - v
            );
            let rests = run.take_events().into_iter().filter(|row| row.class == Class::Rest).count();
            assert_eq!(rests, 1, "{what}");
        }
    }
}

#[test]
fn swept_rubs_as_many_bounces_as_it_does_not_see() {
    // Hops lower than its tolerance stay hidden in the overlap; the law's limit is still that nothing slides.
    let thrown = Thrown { e: 0.5, tangential: 0.99, slope: [0.0, 1.0], height: 2.5, along: 0.3 };
    let (time, way) = thrown.end();
    let mut run = start(&thrown.scene(), Method::Swept);
    let state = go(&mut run, time + 1.0);
    // First order in the tolerance: an impact may come 1e-3 · 0.5 m / 7 m/s early, a hop of that height, 0.02 s long,
    // be one too many or too few.
    assert!(state.v[0].length() <= 1e-12, "still {} m/s", state.v[0]);
    assert!((state.x[0].x - way).abs() <= 0.3 * 0.05, "{} m instead of {way} m", state.x[0].x);
}

/// A scene in other units: lengths times `length`, times times `time`.
fn in_units(scene: &Scene, length: f64, time: f64) -> Scene {
    changed(scene, |other| {
        other.gravity *= length / (time * time);
        other.contact.rest_speed *= length / time;
        for wall in &mut other.walls {
            (wall.shape.center, wall.shape.s1, wall.shape.s2) =
                (wall.shape.center * length, wall.shape.s1 * length, wall.shape.s2 * length);
        }
        for body in &mut other.spheres {
            (body.x, body.v, body.radius) = (body.x * length, body.v * (length / time), body.radius * length);
        }
    })
}

/// Scenes with bounces, chains, rests, edges and slides, and how long each is followed, s.
fn of_all_kinds() -> Vec<(Scene, f64)> {
    let thrown = Thrown { e: 0.5, tangential: 0.99, slope: [0.6, 0.8], height: 1.0, along: -1.0 };
    let light = sphere(DVec3::Y * 0.6, DVec3::ZERO, 0.5);
    let heavy = Sphere { mass: 1e4, ..sphere(DVec3::Y * 3.0, DVec3::ZERO, 0.5) };
    let shelf = wall(dvec3(-2.0, 0.0, 0.0), DVec3::X * 4.0, DVec3::Z * 4.0);
    let rim = sphere(dvec3(0.1, 1.4, 0.5), DVec3::NEG_Y, 0.5);
    vec![
        (thrown.scene(), 2.0),
        (scene(G, smooth(0.9), vec![floor(100.0)], vec![light.clone(), heavy.clone()]), 1.5),
        (scene(G, ELASTIC, vec![floor(100.0)], vec![light, heavy]), 1.0),
        (scene(G, smooth(0.25), vec![shelf, floor(100.0)], vec![rim]), 1.5),
        (row(0.999, &[0.0, 1.0, f64::INFINITY], &[0.0, -1.0], &[1.0, 1e4]).0, 2.0),
    ]
}

#[test]
fn units_of_length_and_time_that_are_powers_of_two_change_no_bit() {
    for (index, (scene, until)) in of_all_kinds().into_iter().enumerate() {
        for method in [Method::Exact, Method::Swept] {
            let mut run = start(&scene, method);
            let state = go(&mut run, until);
            let impacts = impacts_by(&mut run, until);
            for (length, time) in [(2_f64.powi(-10), 1.0), (1.0, 2_f64.powi(-12)), (2_f64.powi(20), 2_f64.powi(12))] {
                let mut other = start(&in_units(&scene, length, time), method);
                let found = go(&mut other, until * time);
                let what = format!("scene {index}, {method:?}, {length} m, {time} s");
                assert_eq!(impacts_by(&mut other, until * time), impacts, "{what}");
                for i in 0..state.x.len() {
                    assert_eq!(found.x[i], state.x[i] * length, "{what}: place of {i}");
                    assert_eq!(found.v[i], state.v[i] * (length / time), "{what}: velocity of {i}");
                }
            }
        }
    }
}

#[test]
fn kilometres_and_hours_change_no_more_than_rounding() {
    for (index, (scene, until)) in of_all_kinds().into_iter().enumerate() {
        let state = go(&mut start(&scene, Method::Exact), until);
        for (length, time) in [(1e-3, 1.0 / 3600.0), (1e9, 1.0), (1.0, 1e-9), (1e-9, 1e6)] {
            let found = go(&mut start(&in_units(&scene, length, time), Method::Exact), until * time);
            for i in 0..state.x.len() {
                // The input itself is rounded; chains, a rim, and low hops over a tilted wall enlarge that a millionfold or so.
                let (x, v) = (found.x[i] / length - state.x[i], (found.v[i] / (length / time)) - state.v[i]);
                assert!(
                    x.length() <= 2e-8 && v.length() <= 2e-8,
                    "scene {index}, {length} m, {time} s: off by {x} m, {v} m/s"
                );
            }
        }
    }
}
