//! Is the house in order? The plan of the modules, enforced; and what a reader may take for granted in every file.
//!
//! Each rule is a function from a file to its complaints, so that the last test can show each of them an offence.

#[path = "tidy/readme.rs"]
mod readme;
#[path = "tidy/source.rs"]
mod source;

use source::{Contents, File, Name, Root};

/// Who may import whom. A module that is not here may not exist; an arrow that is not here may not be drawn.
const PLAN: &[(&str, &[&str])] = &[
    ("main", &["cli"]),
    (
        "cli",
        &[
            "app",
            "audit",
            "export",
            "frame",
            "geometry",
            "measure",
            "physics",
            "printable",
            "scene",
            "snapshot",
            "terminal",
            "text_mode",
            "view",
            "worker",
        ],
    ),
    ("terminal", &["app", "frame", "physics", "printable", "scene", "view"]),
    ("app", &["frame", "geometry", "physics", "printable", "scene", "snapshot", "view", "worker"]),
    ("worker", &["audit", "measure", "physics", "scene", "snapshot"]),
    ("view", &["geometry", "snapshot"]),
    ("frame", &["printable"]),
    ("measure", &["export", "geometry", "physics", "printable", "scene"]),
    ("text_mode", &["audit", "export", "physics", "scene"]),
    ("export", &["physics", "printable"]),
    ("audit", &["physics"]),
    ("snapshot", &["audit", "geometry", "physics", "printable", "scene"]),
    ("physics", &["geometry", "roots", "scene"]),
    ("scene", &["geometry", "printable"]),
    ("geometry", &[]),
    ("roots", &[]),
    ("printable", &[]),
];

/// The methods: folders or files of the physics that only its door may name.
const METHODS: &[&str] = &["paper", "swept", "exact", "moreau"];

/// Which crates live where only.
const HOMES: &[(&str, &[&str])] = &[
    ("crossterm", &["terminal"]),
    ("signal_hook", &["terminal", "cli"]),
    ("ron", &["scene", "config"]),
    ("serde_path_to_error", &["scene", "config"]),
    ("serde", &["scene", "config", "export"]),
    ("serde_json", &["export"]),
    ("csv", &["export"]),
    ("clap", &["cli"]),
    ("clap_complete", &["cli"]),
    ("clap_mangen", &["cli"]),
    ("indicatif", &["cli"]),
    ("unicode_properties", &["printable"]),
];

/// Parts of the standard library by which the outer world would enter.
const OUTER_WORLD: &[&str] = &["time", "thread", "fs", "io", "net", "process", "env", "os", "random"];

/// Modules that see nothing but their arguments.
const BLIND: &[&str] = &["physics", "geometry", "roots", "audit", "snapshot", "view"];

/// What the judge may know of the physics: what a run tells, never how it was found.
const TOLD: &[&str] =
    &["Class", "Contact", "Kind", "Method", "Model", "Settings", "Simulation", "State", "Tallies", "contact", "model"];

/// What only a mathematical library computes: its last bit differs from machine to machine.
const INEXACT: &[&str] = &[
    "sin",
    "cos",
    "tan",
    "sin_cos",
    "asin",
    "acos",
    "atan",
    "atan2",
    "sinh",
    "cosh",
    "tanh",
    "exp",
    "exp2",
    "exp_m1",
    "ln",
    "ln_1p",
    "log2",
    "log10",
    "powf",
    "powi",
    "cbrt",
    "hypot",
    "mul_add",
    "angle_between",
    "slerp",
    "to_radians",
];

/// What may stand in no product file.
const UNFINISHED: &[&str] =
    &["unwrap", "todo!", "unimplemented!", "dbg!", "println!", "eprintln!", "print!", "eprint!"];

/// Files that may be longer than [`FILE`], and why.
const LONG_FILES: &[(&str, &str)] = &[];

/// Lines of the longest file, of the longest function.
const FILE: usize = 500;
const FUNCTION: usize = 80;

type Rule = fn(&File) -> Vec<String>;

fn complain(file: &File, line: usize, what: &str) -> String {
    format!("{}:{line}: {what}", file.path)
}

fn top(file: &File) -> String {
    file.module().first().cloned().unwrap_or_else(|| "lib".into())
}

/// The names of a file that one condition finds wrong.
fn names(file: &File, wrong: impl Fn(&Name) -> Option<String>) -> Vec<String> {
    let complaint = |name: &Name| wrong(name).map(|what| complain(file, name.line, &what));
    file.contents().names.iter().filter_map(complaint).collect()
}

fn follows_the_plan(file: &File) -> Vec<String> {
    let from = top(file);
    if from == "lib" {
        return Vec::new();
    }
    let Some((_, allowed)) = PLAN.iter().find(|(module, _)| *module == from) else {
        return vec![complain(file, 1, &format!("the plan knows no module `{from}`"))];
    };
    names(file, |name| {
        let to = (name.root == Root::Ours).then(|| name.parts.first())??;
        let fine = *to == from || allowed.contains(&to.as_str());
        (!fine).then(|| format!("`{from}` must not name `{to}`"))
    })
}

fn only_the_model_names_the_scene(file: &File) -> Vec<String> {
    if top(file) != "physics" || file.path == "src/physics/model.rs" {
        return Vec::new();
    }
    names(file, |name| {
        let scene = name.root == Root::Ours && name.parts.first().is_some_and(|part| part == "scene");
        scene.then(|| "within the physics only `model` names the scene".to_string())
    })
}

fn no_method_names_another(file: &File) -> Vec<String> {
    let module = file.module();
    if module.first().is_none_or(|top| top != "physics") || module.len() < 2 {
        return Vec::new();
    }
    names(file, |name| {
        let to = (name.root == Root::Ours && name.parts[0] == "physics").then(|| name.parts.get(1))??;
        let wrong = METHODS.contains(&to.as_str()) && *to != module[1];
        wrong.then(|| format!("`{}` must not name the method `{to}`", module[1]))
    })
}

fn judges_for_itself(file: &File) -> Vec<String> {
    if top(file) != "audit" {
        return Vec::new();
    }
    names(file, |name| {
        let to = (name.root == Root::Ours && name.parts[0] == "physics").then(|| name.parts.get(1))??;
        (!TOLD.contains(&to.as_str())).then(|| format!("the judge must not know of the physics' `{to}`"))
    })
}

fn sees_only_its_arguments(file: &File) -> Vec<String> {
    let from = top(file);
    if !BLIND.contains(&from.as_str()) {
        return Vec::new();
    }
    names(file, |name| {
        let standard = name.root == Root::Other && matches!(name.parts[0].as_str(), "std" | "core");
        let part = name.parts.get(1).filter(|part| standard && OUTER_WORLD.contains(&part.as_str()))?;
        Some(format!("`{from}` must not know of std::{part}"))
    })
}

fn computes_the_same_bits_everywhere(file: &File) -> Vec<String> {
    if !matches!(top(file).as_str(), "physics" | "geometry" | "roots" | "audit") {
        return Vec::new();
    }
    let Contents { names, calls, .. } = file.contents();
    let inexact = |word: &str| INEXACT.contains(&word);
    let called = calls.iter().filter(|call| inexact(&call.name)).map(|call| (call.line, call.name.clone()));
    let named = names.iter().filter_map(|name| {
        let last = name.parts.last()?;
        let float = name.parts.iter().any(|part| matches!(part.as_str(), "f64" | "DVec3"));
        let hashed = matches!(last.as_str(), "HashMap" | "HashSet");
        (hashed || (float && inexact(last))).then(|| (name.line, last.clone()))
    });
    let foreign = names.iter().filter_map(|name| {
        let root = name.parts.first().filter(|_| name.root == Root::Other)?;
        let parallel = matches!(root.as_str(), "rayon" | "libm" | "rand");
        parallel.then(|| (name.line, root.clone()))
    });
    let words = called.chain(named).chain(foreign);
    words.map(|(line, word)| complain(file, line, &format!("`{word}` is not the same on every machine"))).collect()
}

fn crates_stay_at_home(file: &File) -> Vec<String> {
    let from = top(file);
    names(file, |name| {
        let (krate, homes) = HOMES.iter().find(|(krate, _)| name.root == Root::Other && name.parts[0] == *krate)?;
        (!homes.contains(&from.as_str())).then(|| format!("`{krate}` is named in {} only", homes.join(" and ")))
    })
}

fn is_finished(file: &File) -> Vec<String> {
    let calls = file.contents().calls;
    let unfinished = calls.iter().filter(|call| UNFINISHED.contains(&call.name.as_str()));
    let mut found: Vec<String> =
        unfinished.map(|call| complain(file, call.line, &format!("`{}` in the product", call.name))).collect();
    let marks = ["TO", "FIX", "XX", "HA"].iter().zip(["DO", "ME", "X", "CK"]).map(|(a, b)| format!("{a}{b}"));
    for mark in marks {
        let lines = file.text.lines().enumerate().filter(|(_, line)| line.contains(&mark));
        found.extend(lines.map(|(index, _)| complain(file, index + 1, &format!("`{mark}` was left behind"))));
    }
    found
}

fn fits_on_a_screen(file: &File) -> Vec<String> {
    let functions = file.contents().functions;
    let long = functions.iter().filter(|function| function.lines > FUNCTION);
    let mut found: Vec<String> = long
        .map(|function| complain(file, function.line, &format!("`{}` has {} lines", function.name, function.lines)))
        .collect();
    let lines = file.text.lines().count();
    if lines > FILE && !LONG_FILES.iter().any(|(path, _)| *path == file.path) {
        found.push(complain(file, lines, &format!("{lines} lines are more than {FILE}; split it along the plan")));
    }
    found
}

/// A test waits for a text or an exit, not for a time; and none is skipped.
fn is_an_honest_test(file: &File) -> Vec<String> {
    let Contents { names, attributes, .. } = file.contents();
    let ignored = attributes.iter().filter(|attribute| attribute.name == "ignore").map(|it| (it.line, "is ignored"));
    let timed = names.iter().filter_map(|name| match name.parts.last()?.as_str() {
        "sleep" => Some((name.line, "sleeps")),
        "now" if name.parts.len() > 1 => Some((name.line, "reads a clock")),
        _ => None,
    });
    ignored.chain(timed).map(|(line, what)| complain(file, line, &format!("a test {what}"))).collect()
}

#[track_caller]
fn holds(rule: Rule, folders: &[&str]) {
    let files: Vec<File> = folders.iter().flat_map(|folder| source::files(folder)).collect();
    assert!(!files.is_empty(), "a rule without a file is no rule");
    let complaints: Vec<String> = files.iter().flat_map(rule).collect();
    assert!(complaints.is_empty(), "\n{}\n", complaints.join("\n"));
}

#[test]
fn imports_follow_the_plan() {
    holds(follows_the_plan, &["src"]);
}

#[test]
fn within_the_physics_only_the_model_names_the_scene() {
    holds(only_the_model_names_the_scene, &["src"]);
}

#[test]
fn methods_do_not_know_each_other() {
    holds(no_method_names_another, &["src"]);
}

#[test]
fn the_judge_shares_nothing_with_what_it_judges() {
    holds(judges_for_itself, &["src"]);
}

#[test]
fn physics_and_views_have_no_clock_no_thread_and_no_file() {
    holds(sees_only_its_arguments, &["src"]);
}

#[test]
fn the_physics_uses_nothing_that_differs_between_machines() {
    holds(computes_the_same_bits_everywhere, &["src"]);
}

#[test]
fn each_outside_crate_is_named_where_it_belongs() {
    holds(crates_stay_at_home, &["src"]);
}

#[test]
fn nothing_unfinished_is_left_in_the_product() {
    holds(is_finished, &["src"]);
}

#[test]
fn functions_and_files_fit() {
    holds(fits_on_a_screen, &["src", "tests"]);
}

#[test]
fn no_test_sleeps_reads_a_clock_or_is_ignored() {
    holds(is_an_honest_test, &["tests"]);
}

/// (rule, file, offence): without these a rule could be blind and nobody would know.
const OFFENCES: &[(Rule, &str, &str)] = &[
    (follows_the_plan, "src/view/layout.rs", "use crate::{geometry::Bounds, scene::{self, Scene}};"),
    (follows_the_plan, "src/view/layout.rs", "fn f() { let _ = crate::physics::Until::Frame; }"),
    (follows_the_plan, "src/view/layout.rs", "fn f(sim: &super::super::physics::Simulation) {}"),
    (follows_the_plan, "src/view/mod.rs", "fn f() { assert!(matches!(1, crate::worker::ONE)); }"),
    (follows_the_plan, "src/view/mod.rs", "fn f() { assert!(is(Pair { a: crate::worker::ONE, b: 2 })); }"),
    (follows_the_plan, "src/physics/state.rs", "use crate::snapshot::Snapshot as S;"),
    (follows_the_plan, "src/physics/mod.rs", "mod inner { use super::super::export; }"),
    (follows_the_plan, "src/scene/rules.rs", "use crate::physics::Kind;"),
    (follows_the_plan, "src/app/keys.rs", "pub use crate::terminal::input;"),
    (follows_the_plan, "src/worker/mod.rs", "fn f() { crate::view::draw(); }"),
    (follows_the_plan, "src/geometry.rs", "use super::scene::Wall;"),
    (follows_the_plan, "src/geometry.rs", "use crate::*;"),
    (follows_the_plan, "src/utils.rs", "fn f() {}"),
    (only_the_model_names_the_scene, "src/physics/paper/mod.rs", "use crate::scene::Scene;"),
    (no_method_names_another, "src/physics/paper/mod.rs", "use crate::physics::swept::Swept;"),
    (no_method_names_another, "src/physics/exact/queue.rs", "use super::super::paper;"),
    (no_method_names_another, "src/physics/overlap.rs", "fn f() { super::paper::step(); }"),
    (judges_for_itself, "src/audit/overlap.rs", "use crate::physics::contact_time::touch;"),
    (judges_for_itself, "src/audit/law.rs", "fn f() { crate::physics::motion::classify(1.0, true, &law); }"),
    (sees_only_its_arguments, "src/physics/mod.rs", "use std::{fmt, time::Instant};"),
    (sees_only_its_arguments, "src/physics/paper/mod.rs", "fn f() { std::thread::yield_now(); }"),
    (sees_only_its_arguments, "src/view/mod.rs", "fn f() -> bool { std::env::var(\"TERM\").is_ok() }"),
    (computes_the_same_bits_everywhere, "src/physics/motion.rs", "fn f(a: f64) -> f64 { a.mul_add(2.0, 1.0) }"),
    (computes_the_same_bits_everywhere, "src/physics/motion.rs", "fn f(a: f64) -> f64 { f64::sin(a) }"),
    (computes_the_same_bits_everywhere, "src/physics/motion.rs", "fn f(a: f64) { assert!(a.powi(2) > 0.0); }"),
    (computes_the_same_bits_everywhere, "src/roots.rs", "use std::collections::HashMap;"),
    (crates_stay_at_home, "src/app/mod.rs", "use crossterm::event::KeyCode;"),
    (crates_stay_at_home, "src/physics/state.rs", "#[derive(serde::Serialize)] struct S;"),
    (crates_stay_at_home, "src/cli/run.rs", "fn f() { let _ = ron::from_str::<u8>(\"1\"); }"),
    (is_finished, "src/cli/run.rs", "fn f(a: Option<u8>) -> u8 { a.unwrap() }"),
    (is_finished, "src/cli/run.rs", "fn f(a: Option<u8>) { assert!(a.unwrap() > 0); }"),
    (is_finished, "src/cli/run.rs", "fn f() { todo!() }"),
    (is_an_honest_test, "tests/cli.rs", "#[test] #[ignore] fn f() {}"),
    (is_an_honest_test, "tests/cli.rs", "fn f() { std::thread::sleep(D); }"),
    (is_an_honest_test, "tests/cli.rs", "fn f() { let t = std::time::Instant::now(); }"),
];

#[test]
fn every_rule_finds_its_offence() {
    for (rule, path, text) in OFFENCES {
        assert!(!rule(&File::new(path, text)).is_empty(), "nobody minds {text:?} in {path}");
    }
    let long = format!("fn f() {{\n{}}}\n", "    g();\n".repeat(FUNCTION));
    assert_eq!(fits_on_a_screen(&File::new("src/a.rs", &long)).len(), 1, "a function too long");
    assert_eq!(fits_on_a_screen(&File::new("src/a.rs", &"\n".repeat(FILE + 1))).len(), 1, "a file too long");
}

#[test]
fn what_is_allowed_is_not_an_offence() {
    let fine: &[(Rule, &str, &str)] = &[
        (follows_the_plan, "src/physics/mod.rs", "mod contact; use contact::Contact; use self::state::State;"),
        (follows_the_plan, "src/view/mod.rs", "#[cfg(test)] mod tests { use crate::physics::Kind; }"),
        (no_method_names_another, "src/physics/mod.rs", "mod paper; use paper::Paper;"),
        (no_method_names_another, "src/physics/paper/frame.rs", "use super::response; use crate::physics::paper::X;"),
        (only_the_model_names_the_scene, "src/physics/model.rs", "use crate::scene::Scene;"),
        (sees_only_its_arguments, "src/view/mod.rs", "use std::sync::Arc; fn f() { std::iter::once(1); }"),
        (judges_for_itself, "src/audit/law.rs", "use crate::physics::{Class, Contact, contact::Key, model::Face};"),
        (is_finished, "src/cli/run.rs", "#[cfg(test)] mod tests { fn f() { Some(1).unwrap(); } }"),
    ];
    for (rule, path, text) in fine {
        assert_eq!(rule(&File::new(path, text)), Vec::<String>::new(), "{text:?} in {path}");
    }
}
