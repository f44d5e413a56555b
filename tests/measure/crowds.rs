//! `measure --crowd`: figures beyond the horizon, over many seeds.

use carom::measure::{Crowd, FIGURES, Mean, Rung, crowd_report, crowd_rows, crowds};
use carom::physics::{Method, Scene};
use carom::scene::ContactLaw;
use glam::{DVec3, dvec3};

use crate::support::{G, changed, room, scene, sphere};
use crate::{ON, carom_of};

/// Eight balls that fall into a narrow box and come to rest there.
fn heap() -> Scene {
    let law = ContactLaw { restitution: 0.3, wall_restitution: 0.3, tangential: 0.5, rest_speed: 0.05 };
    let places = (0..8).map(|k| dvec3(f64::from(k % 2), f64::from(k / 4), f64::from(k / 2 % 2)));
    let balls = places.map(|at| sphere(at * 0.45 + dvec3(-0.2 + 0.02 * at.y, 0.3, -0.2), DVec3::ZERO, 0.2));
    let heap = scene(G, law, room(dvec3(-0.5, 0.0, -0.5), dvec3(0.5, 5.0, 0.5)), balls.collect());
    changed(&heap, |draft| draft.duration = 2.0)
}

fn of(crowd: &Crowd, figure: &str) -> Mean {
    let place = FIGURES.iter().position(|(name, _)| *name == figure).expect("a figure");
    crowd.means[place].unwrap_or_else(|| panic!("no {figure}: {crowd:?}"))
}

#[test]
fn a_heap_at_rest_is_carried_by_the_walls_and_half_the_step_agrees() {
    let rung = |dt: f64| Rung { method: Method::Moreau, dt: Some(dt), tolerance: Some(1e-9) };
    let found = crowds(&heap(), &[rung(1e-2), rung(5e-3)], (30, f64::INFINITY), 2, ON).expect("it is not interrupted");
    for crowd in &found {
        assert_eq!(crowd.finished, (30, 30));
        // At rest the walls carry the weight. What is left is the momentum of the last frames of sliding, over M g · 0.4 s.
        let load = of(crowd, "load on walls / weight");
        assert!((load.mean - 1.0).abs() < 5e-2, "{load:?}");
        let [contacts, packing] = ["contacts of a sphere", "packing"].map(|figure| of(crowd, figure).mean);
        assert!((1.0..8.0).contains(&contacts) && (0.1..0.74).contains(&packing), "{contacts}, {packing}");
        assert!(of(crowd, "gap × force at rest").mean < 1e-3, "{crowd:?}");
        let [low, middle, high] = ["height of the lowest tenth", "median height", "height of the highest tenth"]
            .map(|figure| of(crowd, figure).mean);
        assert!(low >= 0.199 && low <= middle && middle <= high && high < 2.0, "{low}, {middle}, {high}");
    }
    let again = crowds(&heap(), &[rung(1e-2)], (30, f64::INFINITY), 1, ON).expect("it is not interrupted");
    assert_eq!(again[0], found[0], "whatever the number of threads");
    let rows = crowd_rows("heap", &found);
    assert_eq!(rows.len(), 2 * FIGURES.len());
    let energies = rows.iter().filter(|row| row.figure == "energy at the end");
    assert!(energies.clone().count() == 2 && energies.clone().all(|row| row.seeds == 30 && row.agrees.is_some()));
    let text = crowd_report("heap", 2.0, &found);
    assert!(text.contains("30 seeds") && text.contains("held against moreau, dt 5e-3 s"), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
}

#[test]
fn the_floor_carries_the_weight_of_what_rests_to_rounding() {
    let floor = |duration: f64| {
        let law = ContactLaw { restitution: 0.0, wall_restitution: 0.0, tangential: 1.0, rest_speed: 0.1 };
        let ball = sphere(DVec3::Y * 0.5, DVec3::ZERO, 0.5);
        let walls = room(dvec3(-2.0, 0.0, -2.0), dvec3(2.0, 4.0, 2.0));
        changed(&scene(G, law, walls, vec![ball]), |draft| draft.duration = duration)
    };
    for (method, dt, tolerance) in [(Method::Exact, None, None), (Method::Moreau, Some(1e-2), Some(1e-9))] {
        let found = crowds(&floor(2.0), &[Rung { method, dt, tolerance }], (3, f64::INFINITY), 1, ON);
        let load = of(&found.expect("it is not interrupted")[0], "load on walls / weight");
        assert!((load.mean - 1.0).abs() < 1e-9, "{method:?}: {load:?}");
    }
}

#[test]
fn a_crowd_on_the_command_line_has_a_block_for_each_figure() {
    let ran = carom_of(&["measure", "paper-4", "--crowd", "3", "--methods", "moreau,exact", "--csv", "-"]);
    assert_eq!(ran.lines().filter(|line| line.starts_with("paper-4,moreau,0.01,")).count(), FIGURES.len(), "{ran}");
    assert!(ran.starts_with("scene,method,dt,tolerance,figure,unit,mean,standard_error,seeds,agrees\n"), "{ran}");
}
