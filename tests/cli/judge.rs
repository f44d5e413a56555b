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
    let ran = carom(&["judge", a, b, c, "--scene", "cannon", "--until", "1", "--dt", "1e-2,1e-3,1e-4"]).succeeds();
    let line = ran.out.lines().find(|line| line.starts_with("Order of convergence")).expect("an order");
    let order: f64 = line.split(' ').nth(5).and_then(|word| word.parse().ok()).expect("a number");
    assert!((order - 1.0).abs() < 0.1, "Euler is of first order: {line}");
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
