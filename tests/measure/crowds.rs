//! `measure --crowd`: figures beyond the horizon, over many seeds.

use std::fs;

use carom::export::FIGURES;
use carom::measure::{
    Budget, Crowd, CrowdPlan, Mean, Rung, SceneCrowds, Shard, crowd_figure, crowd_report, crowd_rows, crowds,
};
use carom::physics::{Method, Scene};
use carom::scene::ContactLaw;
use glam::{DVec3, dvec3};

use crate::support::{G, changed, room, scene, sphere};
use crate::{ON, carom_of, program};

/// Eight balls that fall into a narrow box and come to rest there.
fn heap() -> Scene {
    let law = ContactLaw { restitution: 0.3, wall_restitution: 0.3, tangential: 0.5, rest_speed: 0.05 };
    let places = (0..8).map(|k| dvec3(f64::from(k % 2), f64::from(k / 4), f64::from(k / 2 % 2)));
    let balls = places.map(|at| sphere(at * 0.45 + dvec3(-0.2 + 0.02 * at.y, 0.3, -0.2), DVec3::ZERO, 0.2));
    let heap = scene(G, law, room(dvec3(-0.5, 0.0, -0.5), dvec3(0.5, 5.0, 0.5)), balls.collect());
    changed(&heap, |draft| draft.duration = 2.0)
}

fn plan(rungs: &[Rung], seeds: u64, jobs: usize) -> CrowdPlan {
    CrowdPlan { rungs: rungs.to_vec(), seeds, budget: Budget::UNLIMITED, shard: Shard::WHOLE, jobs }
}

fn of(crowd: &Crowd, figure: &str) -> Mean {
    let place = FIGURES.iter().position(|(name, ..)| *name == figure).expect("a figure");
    crowd.means[place].unwrap_or_else(|| panic!("no {figure}: {crowd:?}"))
}

#[test]
fn a_heap_at_rest_is_carried_by_the_walls_and_half_the_step_agrees() {
    let rung = |dt: f64| Rung { method: Method::Moreau, dt: Some(dt), tolerance: Some(1e-9) };
    let found = crowds(&heap(), &plan(&[rung(1e-2), rung(5e-3)], 30, 2), ON).expect("it is not interrupted");
    for crowd in &found {
        assert_eq!(crowd.finished, (30, 30));
        // At rest the walls carry the weight. What is left is the momentum of the last frames of sliding, over M g · 0.4 s.
        let [load, forces] = ["load on walls / weight", "contact forces / weight"].map(|figure| of(crowd, figure).mean);
        assert!((load - 1.0).abs() < 5e-2 && (forces - load).abs() < 5e-2, "{load}, {forces}");
        let [contacts, packing] = ["contacts of a sphere", "packing"].map(|figure| of(crowd, figure).mean);
        assert!((1.0..8.0).contains(&contacts) && (0.1..0.74).contains(&packing), "{contacts}, {packing}");
        // What the solver leaves: a part of a radius, of the weight of all, and of their product.
        let [overlap, pull, product] =
            ["overlap at rest", "pull at rest", "gap × force at rest"].map(|figure| of(crowd, figure).mean);
        assert!(overlap < 1e-2 && pull == 0.0 && product < 1e-3, "{overlap} m, {pull} N, {product} J");
        let [low, middle, high] = ["height of the lowest tenth", "median height", "height of the highest tenth"]
            .map(|figure| of(crowd, figure).mean);
        assert!(low >= 0.199 && low <= middle && middle <= high && high < 2.0, "{low}, {middle}, {high}");
    }
    let again = crowds(&heap(), &plan(&[rung(1e-2)], 30, 1), ON).expect("it is not interrupted");
    assert_eq!(again[0], found[0], "whatever the number of threads");
    let heaps = SceneCrowds { key: "heap".into(), until: 2.0, seeds: 30, crowds: found };
    let rows = crowd_rows(&heaps);
    assert_eq!(rows.len(), 2 * FIGURES.len());
    let energies: Vec<_> = rows.iter().filter(|row| row.figure == "energy at the end").collect();
    assert!(energies.iter().all(|row| row.seeds == 30 && row.agrees.is_some()), "{energies:?}");
    assert_eq!(energies.iter().map(|row| row.standard).collect::<Vec<_>>(), [false, true]);
    assert!(energies[0].agrees_with_half.is_some() && energies[1].agrees_with_half.is_none(), "{energies:?}");
    let text = crowd_report(&heaps);
    assert!(text.contains("30 seeds") && text.contains("standard") && text.contains("half the step gives"), "{text}");
    assert!(text.lines().filter(|line| line.starts_with("  ")).all(|line| line.chars().count() <= 80), "{text}");
    let drawn = crowd_figure(&[heaps], "carom measure <heap>");
    // Of each setting a band, a line and marks of energy and of heights, and what the walls carry.
    assert_eq!((drawn.matches("fill-opacity=\"0.2\"").count(), drawn.matches("<title>").count()), (4, 20), "{drawn}");
    assert!(drawn.contains("&lt;heap&gt;") && !drawn.contains("NaN") && !drawn.contains("inf"), "{drawn}");
}

#[test]
fn a_crowd_of_which_nothing_is_known_is_drawn_all_the_same() {
    let drawn = crowd_figure(&[SceneCrowds { key: "heap".into(), until: 2.0, seeds: 3, crowds: vec![] }], "");
    assert!(drawn.ends_with("</svg>\n") && !drawn.contains("NaN") && !drawn.contains("inf"), "{drawn}");
}

#[test]
fn by_paper_the_floor_carries_the_weight_of_what_rests_on_it_to_rounding() {
    // It cannot hold what leans on others; three balls on the floor it can.
    let law = ContactLaw { restitution: 0.0, wall_restitution: 0.0, tangential: 1.0, rest_speed: 0.1 };
    let balls = [-2.0, 0.0, 2.0].map(|x: f64| sphere(dvec3(x, 0.5 + 0.05 * x.abs(), 0.0), DVec3::ZERO, 0.5));
    let walls = room(dvec3(-5.0, 0.0, -5.0), dvec3(5.0, 4.0, 5.0));
    let heap = changed(&scene(G, law, walls, balls.to_vec()), |draft| draft.duration = 2.0);
    let rungs = [1e-2, 5e-3].map(|dt| Rung { method: Method::Paper, dt: Some(dt), tolerance: Some(1e-6) });
    let found = crowds(&heap, &plan(&rungs, 2, 1), ON).expect("it is not interrupted");
    for crowd in found {
        for figure in ["contact forces / weight", "load on walls / weight"] {
            let load = of(&crowd, figure).mean;
            assert!((load - 1.0).abs() < 1e-9, "{figure}: {load:?}");
        }
        assert!(crowd.finished == (2, 2) && of(&crowd, "pull at rest").mean == 0.0, "{crowd:?}");
    }
}

#[test]
fn the_floor_carries_the_weight_of_what_rests_to_rounding_by_every_method() {
    // A row of three in a groove as wide as they are, the middle one on the others: all normals stand still.
    let law = ContactLaw { restitution: 0.0, wall_restitution: 0.0, tangential: 1.0, rest_speed: 0.1 };
    let balls = vec![
        sphere(dvec3(-0.6, 0.5, 0.0), DVec3::ZERO, 0.5),
        sphere(dvec3(0.6, 0.5, 0.0), DVec3::ZERO, 0.5),
        sphere(dvec3(0.0, 1.3, 0.0), DVec3::ZERO, 0.5),
    ];
    let walls = room(dvec3(-1.1, 0.0, -0.5), dvec3(1.1, 4.0, 0.5));
    let heap = changed(&scene(G, law, walls, balls), |draft| draft.duration = 2.0);
    let rungs = [
        (Method::Exact, None, None),
        (Method::Swept, Some(1e-1), Some(1e-9)),
        (Method::Moreau, Some(1e-2), Some(1e-9)),
    ];
    for (method, dt, tolerance) in rungs {
        let found = crowds(&heap, &plan(&[Rung { method, dt, tolerance }], 1, 1), ON).expect("it is not interrupted");
        for figure in ["contact forces / weight", "load on walls / weight"] {
            let load = of(&found[0], figure).mean;
            assert!((load - 1.0).abs() < 1e-9, "{method:?}, {figure}: {load:?}");
        }
        let [pull, product] = ["pull at rest", "gap × force at rest"].map(|figure| of(&found[0], figure).mean);
        assert!(pull == 0.0 && product < 1e-6, "{method:?}: {pull} N, {product} J");
    }
}

#[test]
fn a_run_that_has_spent_what_it_may_take_says_how_far_it_came_and_gives_what_it_has() {
    let rung = Rung { method: Method::Moreau, dt: Some(1e-3), tolerance: Some(1e-9) };
    let few = |counted: u64| CrowdPlan { budget: Budget::counted(counted), ..plan(&[rung], 3, 1) };
    let all = crowds(&heap(), &plan(&[rung], 3, 1), ON).expect("it is not interrupted");
    let found = crowds(&heap(), &few(1_000_000), ON).expect("it is not interrupted");
    let (least, most) = found[0].reached;
    assert!(found[0].finished == (0, 3) && 0.0 < least && least <= most && most < 2.0, "{found:?}");
    let early = FIGURES.iter().position(|(_, _, column)| *column == "energy_5").expect("a figure");
    assert_eq!(found[0].means[early], all[0].means[early], "what was reached is as good as of a whole run");
    assert_eq!(found[0].means[FIGURES.len() - 1], None);
    let text = crowd_report(&SceneCrowds { key: "heap".into(), until: 2.0, seeds: 3, crowds: found });
    assert!(text.contains("3 of 3 runs had spent what they may take, reached "), "{text}");
}

#[test]
fn parts_of_a_crowd_make_the_table_of_the_whole_to_the_bit() {
    let folder = program::folder();
    let path = |name: &str| program::in_folder(&folder, name);
    let asked = ["measure", "paper-4", "paper-0", "--crowd", "4", "--methods", "moreau,exact"];
    let whole = carom_of(&[&asked[..], &["--csv", &path("whole.csv")]].concat());
    let parts: Vec<String> = (1..=3).map(|k| path(&format!("{k}.csv"))).collect();
    for (k, part) in parts.iter().enumerate() {
        carom_of(&[&asked[..], &["--jobs", "1", "--shard", &format!("{}/3", k + 1), "--csv", part]].concat());
    }
    let joined = [&parts[2], &parts[0], &parts[1]].map(String::as_str);
    let merged = carom_of(&[&["measure", "--csv", &path("merged.csv"), "--merge"], &joined[..]].concat());
    let read = |name: &str| fs::read_to_string(path(name)).expect("a table");
    let sorted = |text: &str| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        lines.sort();
        lines
    };
    // Which scene comes first is that of the files.
    assert_eq!(sorted(&read("merged.csv")), sorted(&read("whole.csv")));
    assert_eq!(sorted(&merged), sorted(&whole));
    let twice = program::carom(&["measure", "--merge", &parts[0], &parts[0]]).fails_with(1);
    assert!(twice.err.contains("1.csv:2: this run is in") && twice.err.contains("already"), "{}", twice.err);
    let lacking = carom_of(&["measure", "--merge", &parts[0]]);
    assert!(lacking.contains("runs are missing"), "{lacking}");
}

#[test]
fn a_crowd_on_the_command_line_has_a_block_for_each_figure() {
    let ran = carom_of(&["measure", "paper-4", "--crowd", "3", "--methods", "moreau,exact", "--csv", "-"]);
    assert_eq!(ran.lines().filter(|line| line.starts_with("paper-4,moreau,0.01,")).count(), FIGURES.len(), "{ran}");
    assert!(ran.starts_with("scene,method,dt,tolerance,runs,reached,figure,unit,mean,standard_error,seeds,"), "{ran}");
}
