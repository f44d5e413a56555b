//! `carom judge`: verdicts, exit codes, refusals, results in every form.

use std::fs;
use std::process::Stdio;

use tempfile::TempDir;

use crate::program::{Ran, carom, command, folder, in_folder};

/// A file of states of a scene by a method.
fn states(folder: &TempDir, name: &str, arguments: &[&str]) -> String {
    let path = in_folder(folder, name);
    let rest = ["--until", "2", "--every", "0.01", "--states", &path];
    carom(&[&["run"], arguments, &rest].concat()).succeeds();
    path
}

#[test]
fn exact_passes_paper_fails_and_a_broken_file_is_bad_input() {
    let folder = folder();
    let exact = states(&folder, "exact.csv", &["paper-1", "--method", "exact"]);
    let paper = states(&folder, "paper.csv", &["paper-1", "--method", "paper"]);
    let judged = |files: &[&str], more: &[&str]| {
        let scene = ["--scene", "paper-1", "--until", "2", "--tolerance", "1e-6"];
        carom(&[&["judge"], files, &scene, more].concat())
    };
    let ran = judged(&[&exact], &[]).succeeds();
    for word in ["passes", "certified", "exact.csv", "1e-6 m pass", "impacts that can be seen are found"] {
        assert!(ran.out.contains(word), "{word:?} is not in {}", ran.out);
    }
    let ran = judged(&[&exact, &paper], &["--jobs", "2"]);
    assert_eq!((ran.code, ran.err.as_str()), (Some(1), ""), "{ran:?}");
    let verdicts: Vec<&str> = ran.out.lines().filter(|line| line.ends_with(".csv")).map(|line| &line[..6]).collect();
    assert_eq!(verdicts, ["passes", "fails "], "{}", ran.out);
    let broken = in_folder(&folder, "broken.csv");
    fs::write(&broken, "time,x,y,z\n0,1,2,3\n1,1,2\n").expect("a file");
    let ran = judged(&[&exact, &broken], &[]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.out.contains("broken.csv:3: 3 cells, where 4 are wanted") && ran.out.contains("passes"), "{}", ran.out);
    let ran = judged(&["nowhere.csv"], &[]);
    assert!(ran.code == Some(2) && ran.out.contains("nowhere.csv"), "{ran:?}");
}

#[test]
fn json_and_svg_have_what_the_table_has_and_names_are_mapped() {
    let folder = folder();
    let exact = states(&folder, "exact.csv", &["paper-0", "--method", "exact"]);
    let text = fs::read_to_string(&exact).expect("states").replace("time,sphere,x", "t,ball,px");
    fs::write(&exact, text.replace(',', ";")).expect("a file");
    let (json, svg) = (in_folder(&folder, "marks.jsonl"), in_folder(&folder, "marks.svg"));
    let scene = ["--scene", "paper-0", "--until", "2", "--columns", "t=time,ball=sphere,px=x"];
    carom(&[&["judge", &exact, "--json", &json, "--svg", &svg], &scene[..]].concat()).succeeds();
    let json = fs::read_to_string(json).expect("JSON");
    let line: serde_json::Value = serde_json::from_str(json.trim()).expect("an object");
    assert_eq!(line["verdict"], "marked");
    assert_eq!(line["error"].as_f64(), Some(0.0));
    assert_eq!((line["impacts_found"].as_u64(), line["impacts_wanted"].as_u64()), (Some(1), Some(1)), "{line}");
    assert!(line["errors"].as_array().is_some_and(|errors| errors.len() > 100), "{line}");
    let svg = fs::read_to_string(svg).expect("SVG");
    assert!(svg.contains("</svg>") && svg.contains("position error over time") && svg.contains("exact.csv"), "{svg}");
}

#[test]
fn standard_input_is_a_file_and_two_files_are_held_against_each_other() {
    let folder = folder();
    let exact = states(&folder, "exact.csv", &["paper-0", "--method", "exact"]);
    let mut piped =
        command(&["judge", "-", "--scene", "paper-0", "--until", "2", "--against", &exact, "--tolerance", "1e-9"]);
    piped.stdin(Stdio::from(fs::File::open(&exact).expect("states")));
    let ran = Ran::from(crate::watch::output(&mut piped)).succeeds();
    assert!(ran.out.contains("against") && ran.out.contains("passes"), "{}", ran.out);
    let ran = carom(&["judge", "-", "-", "--scene", "paper-0"]).fails_with(2);
    assert!(ran.err.contains("once"), "{}", ran.err);
}

#[test]
fn files_of_one_program_at_several_steps_give_its_order() {
    let folder = folder();
    let files: Vec<String> = ["1e-2", "1e-3", "1e-4"]
        .map(|dt| states(&folder, &format!("{dt}.csv"), &["cannon", "--method", "paper", "--dt", dt]))
        .to_vec();
    let [a, b, c] = [&files[0], &files[1], &files[2]].map(String::as_str);
    // Up to 1 s, and of the whole run: there all three are somewhere else altogether at last, which is no matter of steps.
    let json = in_folder(&folder, "marks.jsonl");
    for (until, error, said) in [("1", 0.1, "of 3 files"), ("10", 0.3, "where one is a radius off")] {
        let scene = ["--scene", "cannon", "--until", until, "--dt", "1e-2,1e-3,1e-4", "--json", &json];
        let ran = carom(&[&["judge", a, b, c], &scene[..]].concat()).succeeds();
        let line = ran.out.lines().find(|line| line.starts_with("Order of convergence")).expect("an order");
        let order: f64 = line.split(' ').nth(5).and_then(|word| word.parse().ok()).expect("a number");
        assert!((order - 1.0).abs() < error && line.contains(said), "Euler is of first order: {line}");
        for row in fs::read_to_string(&json).expect("JSON").lines() {
            let row: serde_json::Value = serde_json::from_str(row).expect("an object");
            assert!(row["order"].as_f64().is_some_and(|found| (found - order).abs() < 0.01), "{row}");
        }
    }
    let ran = carom(&["judge", a, b, "--scene", "cannon", "--dt", "1e-2"]).fails_with(2);
    assert!(ran.err.contains("1 steps for 2 files"), "{}", ran.err);
}

#[test]
fn no_output_replaces_a_trajectory() {
    let folder = folder();
    let exact = states(&folder, "exact.csv", &["paper-0", "--method", "exact"]);
    let before = fs::read(&exact).expect("states");
    let ran = carom(&["judge", &exact, "--scene", "paper-0", "--json", &exact]).fails_with(2);
    assert!(ran.err.contains("would replace"), "{}", ran.err);
    assert_eq!(fs::read(&exact).expect("states"), before);
}

#[test]
fn a_crowd_is_compared_with_many_runs_and_what_a_file_cannot_tell_is_said() {
    let folder = folder();
    let table = in_folder(&folder, "crowd.csv");
    let crowd = ["--crowd", "4", "--methods", "moreau", "--dt", "1e-2", "--tolerances", "1e-6", "--csv", &table];
    carom(&[&["measure", "bouncing-49"], &crowd[..]].concat()).succeeds();
    let path = in_folder(&folder, "run.csv");
    let settings = ["--method", "moreau", "--dt", "1e-2", "--tolerance", "1e-6"];
    let rows = ["--every", "0.1", "--states", &path];
    carom(&[&["run", "bouncing-49"], &settings[..], &rows[..]].concat()).succeeds();
    let (json, scene) = (in_folder(&folder, "marks.jsonl"), ["--scene", "bouncing-49", "--crowd", &table]);
    let judged = |file: &str| carom(&[&["judge", file, "--json", &json], &scene[..]].concat()).succeeds().out;
    let figures = || {
        let json = fs::read_to_string(&json).expect("JSON");
        let mark: serde_json::Value = serde_json::from_str(json.trim()).expect("an object");
        mark["crowd"].as_array().expect("figures").clone()
    };
    let right = judged(&path);
    for word in ["mean of runs", "within", "not known of this file", "gap × force at rest", "4 of moreau, dt 1e-2 s"] {
        assert!(right.contains(word), "{word:?} is not in {right}");
    }
    let found = figures();
    let known = found.iter().filter(|figure| !figure["agrees"].is_null());
    assert!(known.clone().count() >= 9 && known.clone().all(|figure| figure["agrees"] == true), "{found:?}");
    // A metre higher: every height differs, and the energy by M g.
    let text = fs::read_to_string(&path).expect("states");
    let shifted = text.lines().enumerate().map(|(line, row)| {
        let mut cells: Vec<String> = row.split(',').map(str::to_owned).collect();
        if line > 0 {
            cells[3] = format!("{:?}", cells[3].parse::<f64>().expect("a number") + 1.0);
        }
        cells.join(",") + "\n"
    });
    let high = in_folder(&folder, "high.csv");
    fs::write(&high, shifted.collect::<String>()).expect("a file");
    assert!(judged(&high).contains("differs"));
    let wrong: Vec<_> = figures().into_iter().filter(|figure| figure["agrees"] == false).collect();
    assert!(wrong.iter().any(|figure| figure["figure"] == "median height") && wrong.len() >= 7, "{wrong:?}");
    let other = carom(&["judge", &path, "--scene", "paper-0", "--crowd", &table]).fails_with(2);
    assert!(other.err.contains("no setting of paper-0"), "{}", other.err);
    let broken = carom(&["judge", &path, "--scene", "bouncing-49", "--crowd", &path]).fails_with(2);
    assert!(broken.err.contains("run.csv:1: these are not the columns of the table of a crowd"), "{}", broken.err);
}

#[test]
fn rows_of_all_spheres_are_read_as_rows_of_one_are() {
    let folder = folder();
    let long = states(&folder, "long.csv", &["paper-3", "--method", "exact"]);
    let text = fs::read_to_string(&long).expect("states");
    let spheres = text.lines().skip(1).filter(|row| row.starts_with("0.0,")).count();
    let names = ["x", "y", "z", "vx", "vy", "vz"];
    let mut wide = String::from("time");
    (0..spheres).for_each(|i| names.iter().for_each(|name| wide += &format!(",{name}{i}")));
    let rows: Vec<&str> = text.lines().skip(1).collect();
    for moment in rows.chunks(spheres) {
        wide += "\n";
        wide += moment[0].split(',').next().expect("a time");
        moment.iter().for_each(|row| row.splitn(3, ',').skip(2).for_each(|cells| wide += &format!(",{cells}")));
    }
    let path = in_folder(&folder, "wide.csv");
    fs::write(&path, wide + "\n").expect("a file");
    let judged = |file: &str| {
        let ran = carom(&["judge", file, "--scene", "paper-3", "--until", "2", "--tolerance", "1e-9"]).succeeds();
        ran.out.lines().skip(1).map(|line| line.replace("wide.csv", "long.csv")).collect::<Vec<_>>()
    };
    assert_eq!(judged(&path), judged(&long));
}
