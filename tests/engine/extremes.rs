//! What each method does at the extremes: a table, a line per extreme and a column per method.
//!
//! `cargo test --test engine extremes:: -- --nocapture` prints it. Each cell says what was found; what must hold for it, and of
//! `paper` what fails and how, is checked while it is filled in.

use crate::support::{ELASTIC, G, PAPER_LAW, floor, paper_scene, recorded, room, run_to, scene, sphere, still, wall};
use carom::physics::{Class, Method, Scene, Settings, Simulation, Stall, Until};
use carom::scene::{ContactLaw, Wall};
use glam::{DVec3, dvec3};

/// What is found, or what must not be.
type Cell = Result<String, String>;

/// One extreme, for one method.
type Extreme = fn(Method) -> Cell;

const EXTREMES: [(&str, Extreme); 13] = [
    ("tolerance 0", tolerance_0),
    ("tolerance 1e300", tolerance_1e300),
    ("dt 1e-12 s, 1000 frames", dt_1e_12),
    ("dt 1e6 s", dt_1e6),
    ("1e8 m/s at a wall", fast),
    ("mass ratio 1e12", unlike_masses),
    ("radius 1e-9 m", tiny),
    ("radius 1e9 m", huge),
    ("1e9 m from the origin", far_away),
    ("e = 0", inelastic),
    ("e = 1, 10 bounces", elastic),
    ("2025 impacts at once", crowd_of_impacts),
    ("2025 rests at once", crowd_of_rests),
];

#[test]
fn every_method_stands_the_extremes_or_fails_them_as_it_is_known_to() {
    let mut wrong = Vec::new();
    let mut table = vec![line("extreme", Method::ALL.iter().map(|method| method.name().to_owned()))];
    for (name, extreme) in EXTREMES {
        let cells = Method::ALL.iter().map(|&method| {
            extreme(method).unwrap_or_else(|complaint| {
                wrong.push(format!("{name}, {}: {complaint}", method.name()));
                String::from("WRONG")
            })
        });
        table.push(line(name, cells));
    }
    let table = table.join("\n");
    println!("{table}");
    assert!(wrong.is_empty(), "{}\n{table}", wrong.join("\n"));
}

fn line(name: &str, cells: impl Iterator<Item = String>) -> String {
    cells.fold(format!("| {name:<23} |"), |line, cell| format!("{line} {cell:<27} |"))
}

/// `cell` if `holds`, else that it does not.
fn must(holds: bool, cell: String) -> Cell {
    if holds { Ok(cell) } else { Err(cell) }
}

fn start(scene: &Scene, method: Method, dt: f64, tolerance: f64) -> Simulation {
    recorded(scene, Settings { method, dt, tolerance })
}

/// Runs to `until` (s), or says why that cannot be.
fn go(run: &mut Simulation, until: f64) -> Result<(), String> {
    run_to(run, until, u64::MAX).map_or(Ok(()), |Stall { reason, .. }| Err(reason))
}

/// Impacts up to now.
fn impacts(run: &mut Simulation) -> usize {
    run.take_events().iter().filter(|event| event.class == Class::Collide).count()
}

fn law(restitution: f64, rest_speed: f64) -> ContactLaw {
    ContactLaw { restitution, wall_restitution: restitution, tangential: 1.0, rest_speed }
}

/// How far scene 1 of the paper is from the event-driven run after 2 s, m, and the deepest degree on the way.
fn deviation(method: Method, dt: f64, tolerance: f64) -> Result<(f64, f64, u64), String> {
    let reference = {
        let mut run = start(&paper_scene(1), Method::Exact, 0.01, 1e-3);
        go(&mut run, 2.0)?;
        run.at(2.0).x[0]
    };
    let mut run = start(&paper_scene(1), method, dt, tolerance);
    go(&mut run, 2.0)?;
    Ok((run.at(2.0).x[0].distance(reference), run.tallies().deepest_degree, run.tallies().unconverged))
}

fn tolerance_0(method: Method) -> Cell {
    let (off, deepest, unconverged) = deviation(method, 0.01, 0.0)?;
    let holds = match method {
        // First order in dt: a centimetre or ten after some bounces; the printed slack of 1e-4 remains.
        Method::Paper => off < 0.3 && deepest < 1.1e-4,
        Method::Swept => off < 1e-12,
        Method::Exact => off == 0.0,
        Method::Moreau => off < 0.3 && deepest < 1e-12 && unconverged == 0,
    };
    must(holds, format!("{off:.0e} m off"))
}

fn tolerance_1e300(method: Method) -> Cell {
    let (off, deepest, unconverged) = deviation(method, 0.01, 1e300)?;
    let holds = match method {
        // Counts as 0.5, and the printed slack.
        Method::Paper => deepest > 1e-3 && deepest < 0.5 + 1.1e-4,
        Method::Swept => off < 1.0 && deepest <= 0.5,
        Method::Exact => off == 0.0,
        // Counts as 0.1.
        Method::Moreau => off < 0.3 && deepest < 0.1 && unconverged == 0,
    };
    must(holds, format!("{off:.0e} m off, {deepest:.0e} deep"))
}

fn dt_1e_12(method: Method) -> Cell {
    let mut run = start(&paper_scene(3), method, 1e-12, 1e-3);
    for _ in 0..1000 {
        run.advance(Until::Frame, u64::MAX);
    }
    let state = run.state();
    // Sphere 0 rests on the floor and is under way at 5 m/s: 5e-9 m, in steps of 5e-12 m added to 4.5 m.
    let way = state.x[0].x + 4.5;
    let holds = (state.t - 1e-9).abs() < 1e-21 && (way - 5e-9).abs() < 1e-12 && state.x[0].y == 0.5;
    must(holds, format!("{way:.3e} m in {:.0e} s", state.t))
}

fn dt_1e6(method: Method) -> Cell {
    let mut run = start(&paper_scene(0), method, 1e6, 1e-3);
    run.advance(Until::Time(20.0), u64::MAX);
    let (t, y) = (run.time(), run.state().x[0].y);
    if method == Method::Paper {
        // −9.8 · 10⁶ m/s for 10⁶ s, in one frame, with nothing in the way.
        return must(y < -9e12, format!("tunnels to y = {y:.0e} m"));
    }
    // Within the tolerance of a rest on the floor, and nothing gained on the way.
    let rests = (y - 0.5).abs() < 1e-3 && run.energy() <= run.initial_energy();
    must(rests, format!("y = {y:.3} m at {t:.0e} s"))
}

/// How many of twenty spheres pass a wall at this speed, m/s, started so that frames end at all distances from it.
fn passing(method: Method, speed: f64) -> Result<usize, String> {
    let shield = wall(DVec3::ZERO, DVec3::Y * 4.0, DVec3::Z * 4.0);
    let mut passed = 0;
    for k in 0..20 {
        let from = -1.0 - speed * 0.01 * (1.0 + (f64::from(k) + 0.5) / 20.0);
        let body = sphere(DVec3::X * from, DVec3::X * speed, 0.5);
        let mut run = start(&scene(DVec3::ZERO, PAPER_LAW, vec![shield.clone()], vec![body]), method, 0.01, 1e-3);
        go(&mut run, 0.05)?;
        let v = run.state().v[0].x;
        passed += usize::from(v > 0.0);
        // A sphere that does not pass comes back at 0.8 of the speed.
        if v <= 0.0 && (v / speed + 0.8).abs() > 1e-9 {
            return Err(format!("comes back at {v} m/s"));
        }
    }
    Ok(passed)
}

fn fast(method: Method) -> Cell {
    let counts: Result<Vec<usize>, String> =
        [99.0, 110.0, 200.0, 1e3, 1e8].iter().map(|&speed| passing(method, speed)).collect();
    let counts = counts?;
    let holds = match method {
        // It tunnels from 2 r / dt = 100 m/s on, with probability 1 − 2 r / (v dt): 0, 1.8, 10, 18, 20 of 20.
        Method::Paper => {
            let expected = [0, 2, 10, 18, 20];
            counts[0] == 0 && counts.iter().zip(expected).all(|(&count, wanted)| count.abs_diff(wanted) <= 1)
        }
        _ => counts == [0; 5],
    };
    must(holds, format!("{} of 20 pass", counts[4]))
}

fn unlike_masses(method: Method) -> Cell {
    let mut spheres: Vec<_> = (0..10).map(|k| still(dvec3(0.0, 0.5 + f64::from(k), 0.0))).collect();
    spheres[9].mass = 1e12;
    let tube = room(dvec3(-0.5, 0.0, -0.5), dvec3(0.5, 20.0, 0.5));
    let mut run = start(&scene(G, PAPER_LAW, tube, spheres), method, 0.01, 1e-3);
    go(&mut run, 10.0)?;
    let state = run.state();
    let drift = (0..10).map(|k| state.x[k].distance(dvec3(0.0, 0.5 + k as f64, 0.0))).fold(0.0, f64::max);
    let loads: Vec<f64> = run.contacts().iter().filter(|c| c.a == 0).map(|c| c.impulse / run.step()).collect();
    let load = loads.iter().copied().fold(0.0, f64::max);
    let holds = match method {
        // Each sphere's own weight and no more: the column stands because nothing presses it.
        Method::Paper => drift < 1e-3 && load < 100.0,
        // 1e12 kg over 1 kg leave four digits.
        _ => drift < 1e-6,
    };
    let note = if method == Method::Paper { ", holds 9.8 N" } else { "" };
    must(holds, format!("drift {drift:.0e} m{note}"))
}

/// Height over the floor, in radii, after a drop of ten radii and long enough to come to rest.
fn dropped(method: Method, r: f64, dt: f64, until: f64) -> Result<f64, String> {
    let body = sphere(DVec3::Y * 11.0 * r, DVec3::ZERO, r);
    let rest_speed = 0.01 * (20.0 * 9.8 * r).sqrt();
    let mut run = start(&scene(G, law(0.5, rest_speed), vec![floor(2.0 * 100.0 * r)], vec![body]), method, dt, 1e-3);
    go(&mut run, until)?;
    Ok(run.at(until).x[0].y / r - 1.0)
}

fn tiny(method: Method) -> Cell {
    // √(20 r / g) = 45 µs for the first fall, three times that for all bounces.
    let gap = dropped(method, 1e-9, 1e-7, 1e-3)?;
    must(gap.abs() <= 1.2e-3, format!("rests at a gap of {gap:.0e} r"))
}

fn huge(method: Method) -> Cell {
    let gap = dropped(method, 1e9, 100.0, 1e6)?;
    must(gap.abs() <= 1.2e-3, format!("rests at a gap of {gap:.0e} r"))
}

fn far_away(method: Method) -> Cell {
    let at = dvec3(1e9, 1e9, -1e9);
    let ground = Wall { shape: carom::geometry::Parallelogram { center: at, ..floor(2.0 * 10.0).shape }, color: None };
    let mut run = start(&scene(G, PAPER_LAW, vec![ground], vec![still(at + DVec3::Y * 3.0)]), method, 0.001, 1e-3);
    go(&mut run, 20.0)?;
    let gap = run.at(20.0).x[0].y - at.y - 0.5;
    let found = impacts(&mut run);
    let holds = match method {
        Method::Paper => gap.abs() < 1e-3,
        // 7 m/s · 0.8ⁿ reaches 0.1 m/s with the 20th impact; coordinates have steps of 1.2e-7 m here.
        _ => gap.abs() < 1e-3 && found.abs_diff(20) <= 1,
    };
    must(holds, format!("gap {gap:.0e} m, {found} impacts"))
}

fn inelastic(method: Method) -> Cell {
    let mut run =
        start(&scene(G, law(0.0, 0.1), vec![floor(2.0 * 10.0)], vec![still(DVec3::Y * 3.0)]), method, 0.01, 1e-3);
    go(&mut run, 5.0)?;
    let (found, gap) = (impacts(&mut run), run.at(5.0).x[0].y - 0.5);
    must(found == 1 && gap.abs() < 1e-3, format!("{found} impact, gap {gap:.0e} m"))
}

fn elastic(method: Method) -> Cell {
    let mut run = start(&scene(G, ELASTIC, vec![floor(2.0 * 10.0)], vec![still(DVec3::Y * 5.5)]), method, 0.01, 1e-9);
    // √(10/9.8) s down, then up and down: ten impacts in 19 of these.
    let fall = (10.0_f64 / 9.8).sqrt();
    go(&mut run, 19.5 * fall)?;
    let (found, error) = (impacts(&mut run), run.energy() / run.initial_energy() - 1.0);
    let holds = match method {
        // 53.9 J to 44.3 J in ten bounces: Euler's frames lose g dt v in each.
        Method::Paper => error < -0.1 && error > -0.3,
        Method::Swept => found == 10 && error.abs() < 1e-6,
        Method::Exact => found == 10 && error.abs() < 1e-13,
        // It sways by g v dt/2 per kilogram, 9e-3 of it, and comes back.
        Method::Moreau => found == 10 && error.abs() < 1e-2,
    };
    must(holds, format!("{found} impacts, energy {error:+.0e}"))
}

/// 45 × 45 spheres at this height over a floor.
fn crowd(height: f64, law: ContactLaw) -> Scene {
    let at = |k: i32| f64::from(k) * 1.1 - 24.2;
    let place = |k: i32| dvec3(at(k / 45), 0.5 + height, at(k % 45));
    scene(G, law, vec![floor(2.0 * 50.0)], (0..2025).map(|k| still(place(k))).collect())
}

fn crowd_of_impacts(method: Method) -> Cell {
    let mut run = start(&crowd(0.1, PAPER_LAW), method, 0.01, 1e-6);
    // √(0.2/9.8) = 0.143 s.
    go(&mut run, 0.2)?;
    let (state, found) = (run.state(), impacts(&mut run));
    let alike = state.v.iter().all(|v| *v == state.v[0]) && state.x.iter().all(|x| x.y == state.x[0].y);
    must(found == 2025 && alike && state.v[0].y > 0.0, format!("{found} alike to the bit"))
}

fn crowd_of_rests(method: Method) -> Cell {
    let mut run = start(&crowd(0.0, PAPER_LAW), method, 0.01, 1e-6);
    go(&mut run, 1.0)?;
    let (state, tallies) = (run.state(), run.tallies());
    let still = state.x.iter().all(|x| x.y == 0.5) && state.v.iter().all(|v| *v == DVec3::ZERO);
    must(tallies.rests == 2025 && tallies.releases == 0 && still, format!("{} rests, drift 0", tallies.rests))
}
