//! Is the house in order? The plan of the modules, enforced; and what a reader may take for granted in every file.
//!
//! Each rule is a function from a file to its complaints, so that the last test can show each of them an offence.

#[path = "tidy/circles.rs"]
mod circles;
#[path = "tidy/plan.rs"]
mod plan;
#[path = "tidy/readme.rs"]
mod readme;
#[path = "tidy/source.rs"]
mod source;
#[path = "tidy/words.rs"]
mod words;

use std::collections::BTreeSet;

use plan::{
    ARGUMENTS, BLIND, FILE, FUNCTION, HOMES, INEXACT, LONG_FILES, METHODS, OF_THE_SCENE, OUTER_WORLD, PLAN, TOLD,
    UNFINISHED,
};
use source::{Contents, File, Name, Named, Root};
use words::{maps_its_files, speaks_of_things, stands_alone};

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

/// Arrows between modules that these files draw, as (from, to).
fn arrows_drawn(files: &[File]) -> BTreeSet<(String, String)> {
    let of = |file: &File| {
        let from = top(file);
        let ours = file.contents().names.into_iter().filter(|name| name.root == Root::Ours);
        ours.filter_map(|name| name.parts.first().cloned()).map(|to| (from.clone(), to)).collect::<Vec<_>>()
    };
    files.iter().flat_map(of).collect()
}

/// Arrows of the plan that these files do not draw.
fn arrows_not_drawn(files: &[File]) -> Vec<String> {
    let drawn = arrows_drawn(files);
    let allowed = PLAN.iter().flat_map(|(from, to)| to.iter().map(|to| (from.to_string(), to.to_string())));
    allowed.filter(|arrow| !drawn.contains(arrow)).map(|(from, to)| format!("`{from}` does not name `{to}`")).collect()
}

/// Homes of outside crates in which these files do not name them.
fn homes_not_used(files: &[File]) -> Vec<String> {
    let named = |home: &str, krate: &str| {
        let of_home = files.iter().filter(|file| top(file) == home);
        of_home.flat_map(|file| file.contents().names).any(|name| name.root == Root::Other && name.parts[0] == krate)
    };
    let homes = HOMES.iter().flat_map(|(krate, homes)| homes.iter().map(move |home| (*krate, *home)));
    homes
        .filter(|(krate, home)| !named(home, krate))
        .map(|(krate, home)| format!("`{home}` does not name `{krate}`"))
        .collect()
}

/// Outside the physics and its judge, what belongs to the scene is called by its own address.
fn takes_it_from_the_scene(file: &File) -> Vec<String> {
    if matches!(top(file).as_str(), "physics" | "audit") {
        return Vec::new();
    }
    names(file, |name| {
        let [physics, what] = name.parts.get(..2)? else { return None };
        let wrong = name.root == Root::Ours && physics == "physics" && OF_THE_SCENE.contains(&what.as_str());
        wrong.then(|| format!("`{what}` is the scene's: `crate::scene::{what}`"))
    })
}

fn names_what_it_takes(file: &File) -> Vec<String> {
    names(file, |name| {
        let all = name.root == Root::Ours && name.parts.last().is_some_and(|last| last == "*");
        all.then(|| "takes all names of another file".to_string())
    })
}

fn with_many_arguments(file: &File) -> Vec<String> {
    let functions = file.contents().functions.into_iter();
    let many = functions.filter(|function| function.arguments > ARGUMENTS);
    let of = |function: &Named| format!("`{}` has {} arguments", function.name, function.arguments);
    many.map(|function| complain(file, function.line, &of(&function))).collect()
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
    if module.first().is_none_or(|top| top != "physics") || module.len() < 2 || module[1] == "simulation" {
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
        let to = (name.root == Root::Ours && name.parts[0] == "physics").then(|| name.parts.get(1..))??;
        let told = |depth: usize| TOLD.contains(&to[..to.len().min(depth)].join("::").as_str());
        (!told(1) && !told(2)).then(|| format!("the judge must not know of the physics' `{}`", to.join("::")))
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
    if !matches!(top(file).as_str(), "physics" | "geometry" | "roots" | "random" | "audit") {
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
fn every_arrow_of_the_plan_is_drawn() {
    let complaints = arrows_not_drawn(&source::files("src"));
    assert!(complaints.is_empty(), "the plan allows what nothing needs:\n{}\n", complaints.join("\n"));
}

#[test]
fn every_home_of_an_outside_crate_names_it() {
    let complaints = homes_not_used(&source::files("src"));
    assert!(complaints.is_empty(), "\n{}\n", complaints.join("\n"));
}

#[test]
fn no_files_import_each_other_in_a_circle() {
    let circles = circles::circles(&circles::arrows(&source::files("src")));
    assert!(circles.is_empty(), "each of these files leads to all others of its group: {circles:#?}");
}

#[test]
fn files_say_which_names_they_take() {
    holds(names_what_it_takes, &["src"]);
}

#[test]
fn functions_have_few_arguments() {
    holds(with_many_arguments, &["src", "tests"]);
}

#[test]
fn what_belongs_to_the_scene_has_one_address() {
    holds(takes_it_from_the_scene, &["src"]);
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
fn comments_speak_of_things() {
    holds(speaks_of_things, &["src", "tests", "benches", "examples"]);
}

#[test]
fn the_first_line_of_a_doc_comment_stands_alone() {
    holds(stands_alone, &["src"]);
}

#[test]
fn the_map_of_a_room_names_its_files() {
    holds(maps_its_files, &["src"]);
}

#[test]
fn no_test_sleeps_reads_a_clock_or_is_ignored() {
    holds(is_an_honest_test, &["tests"]);
}

/// (rule, file, offence): without these a rule could be blind, and no test would tell.
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
    (takes_it_from_the_scene, "src/app/knobs.rs", "use crate::physics::{Class, Settings};"),
    (names_what_it_takes, "src/view/stage.rs", "use super::*;"),
    (names_what_it_takes, "src/view/stage.rs", "use crate::view::screen::*;"),
    (with_many_arguments, "src/view/stage.rs", "fn f(a: u8, b: u8, c: u8, d: u8, e: u8, f: u8) {}"),
    (with_many_arguments, "src/view/stage.rs", "impl S { fn f(&self, a: u8, b: u8, c: u8, d: u8, e: u8, f: u8) {} }"),
    (only_the_model_names_the_scene, "src/physics/paper/mod.rs", "use crate::scene::Scene;"),
    (no_method_names_another, "src/physics/paper/mod.rs", "use crate::physics::swept::Swept;"),
    (no_method_names_another, "src/physics/events/schedule/queue.rs", "use super::super::super::paper;"),
    (no_method_names_another, "src/physics/overlap.rs", "fn f() { super::paper::step(); }"),
    (judges_for_itself, "src/audit/overlap.rs", "use crate::physics::wall::touch;"),
    (judges_for_itself, "src/audit/law.rs", "fn f() { crate::physics::impact_law::classify(1.0, true, &law); }"),
    (sees_only_its_arguments, "src/physics/mod.rs", "use std::{fmt, time::Instant};"),
    (sees_only_its_arguments, "src/physics/paper/mod.rs", "fn f() { std::thread::yield_now(); }"),
    (sees_only_its_arguments, "src/view/mod.rs", "fn f() -> bool { std::env::var(\"TERM\").is_ok() }"),
    (computes_the_same_bits_everywhere, "src/physics/impact_law.rs", "fn f(a: f64) -> f64 { a.mul_add(2.0, 1.0) }"),
    (computes_the_same_bits_everywhere, "src/physics/impact_law.rs", "fn f(a: f64) -> f64 { f64::sin(a) }"),
    (computes_the_same_bits_everywhere, "src/physics/impact_law.rs", "fn f(a: f64) { assert!(a.powi(2) > 0.0); }"),
    (computes_the_same_bits_everywhere, "src/roots.rs", "use std::collections::HashMap;"),
    (crates_stay_at_home, "src/app/mod.rs", "use crossterm::event::KeyCode;"),
    (crates_stay_at_home, "src/physics/state.rs", "#[derive(serde::Serialize)] struct S;"),
    (crates_stay_at_home, "src/cli/run.rs", "fn f() { let _ = ron::from_str::<u8>(\"1\"); }"),
    (is_finished, "src/cli/run.rs", "fn f(a: Option<u8>) -> u8 { a.unwrap() }"),
    (is_finished, "src/cli/run.rs", "fn f(a: Option<u8>) { assert!(a.unwrap() > 0); }"),
    (is_finished, "src/cli/run.rs", "fn f() { todo!() }"),
    (speaks_of_things, "src/scene/rules.rs", "// lent to whoever looks around\nfn f() {}"),
    (speaks_of_things, "tests/cli.rs", "/// Who touches whom.\nfn f() {}"),
    (stands_alone, "src/scene/rules.rs", "/// The same, but for walls.\nfn f() {}"),
    (stands_alone, "src/scene/rules.rs", "struct S {\n    /// Its length, m.\n    length: f64,\n}"),
    (maps_its_files, "src/view/mod.rs", "//! Begin with `stage`.\nmod stage;\nmod sheet;"),
    (maps_its_files, "src/view/mod.rs", "//! | `stage`, `look` | one view |\nmod stage;"),
    (is_an_honest_test, "tests/cli.rs", "#[test] #[ignore] fn f() {}"),
    (is_an_honest_test, "tests/cli.rs", "fn f() { std::thread::sleep(D); }"),
    (is_an_honest_test, "tests/cli.rs", "fn f() { let t = std::time::Instant::now(); }"),
];

#[test]
fn every_rule_finds_its_offence() {
    for (rule, path, text) in OFFENCES {
        assert!(!rule(&File::new(path, text)).is_empty(), "no rule minds {text:?} in {path}");
    }
    let long = format!("fn f() {{\n{}}}\n", "    g();\n".repeat(FUNCTION));
    assert_eq!(fits_on_a_screen(&File::new("src/a.rs", &long)).len(), 1, "a function too long");
    assert_eq!(fits_on_a_screen(&File::new("src/a.rs", &"\n".repeat(FILE + 1))).len(), 1, "a file too long");
}

fn made_up(files: &[(&str, &str)]) -> Vec<File> {
    files.iter().map(|(path, text)| File::new(path, text)).collect()
}

#[test]
fn circles_of_files_are_found_and_nothing_else() {
    let found = |files: &[(&str, &str)]| circles::circles(&circles::arrows(&made_up(files)));
    let pair = found(&[("src/view/a.rs", "use super::b::B;"), ("src/view/b.rs", "fn f() { crate::view::a::f(); }")]);
    assert_eq!(pair, [BTreeSet::from(["src/view/a.rs".to_string(), "src/view/b.rs".to_string()])]);
    let door = [("src/view/mod.rs", "mod a; pub use a::f;"), ("src/view/a.rs", "use super::T;")];
    assert_eq!(found(&door).len(), 1, "a child that imports from its door");
    let long = [("src/a.rs", "use crate::b::B;"), ("src/b.rs", "use crate::c::C;"), ("src/c.rs", "use crate::a::A;")];
    assert_eq!(found(&long)[0].len(), 3, "by way of a third");
    let map = [
        ("src/view/mod.rs", "mod a; mod b; pub use a::f;"),
        ("src/view/a.rs", "use super::b::T;"),
        ("src/view/b.rs", ""),
    ];
    assert_eq!(found(&map), Vec::new(), "a map, and a file that imports from its neighbour");
    let tested = [("src/a.rs", "#[cfg(test)] mod tests { use crate::b::B; }"), ("src/b.rs", "use crate::a::A;")];
    assert_eq!(found(&tested), Vec::new(), "tests may look around");
}

#[test]
fn an_arrow_that_nothing_draws_is_found() {
    let complaints =
        arrows_not_drawn(&made_up(&[("src/main.rs", "fn main() {}"), ("src/view/a.rs", "use crate::format;")]));
    let tells = |what: &str| complaints.iter().any(|complaint| complaint == what);
    assert!(tells("`main` does not name `cli`") && tells("`view` does not name `snapshot`"));
    assert!(!tells("`view` does not name `format`"));
    let idle =
        homes_not_used(&made_up(&[("src/scene/file.rs", "use ron::Options;"), ("src/app/mod.rs", "use serde::de;")]));
    let tells = |what: &str| idle.iter().any(|complaint| complaint == what);
    assert!(tells("`scene` does not name `serde`") && !tells("`scene` does not name `ron`"));
}

#[test]
fn what_is_allowed_is_not_an_offence() {
    let fine: &[(Rule, &str, &str)] = &[
        (follows_the_plan, "src/physics/mod.rs", "mod contact; use contact::Contact; use self::state::State;"),
        (follows_the_plan, "src/view/mod.rs", "#[cfg(test)] mod tests { use crate::physics::Kind; }"),
        (takes_it_from_the_scene, "src/audit/law.rs", "use crate::physics::Settings;"),
        (takes_it_from_the_scene, "src/app/knobs.rs", "use crate::scene::Settings; use crate::physics::Class;"),
        (names_what_it_takes, "src/view/stage.rs", "#[cfg(test)] mod tests { use super::*; }"),
        (names_what_it_takes, "src/scene/file.rs", "fn f() { use ron::Error::*; }"),
        (with_many_arguments, "src/view/stage.rs", "impl S { fn f(&self, a: u8, b: u8, c: u8, d: u8, e: u8) {} }"),
        (no_method_names_another, "src/physics/mod.rs", "mod paper; use paper::Paper;"),
        (no_method_names_another, "src/physics/simulation.rs", "use super::{exact, paper};"),
        (no_method_names_another, "src/physics/paper/frame.rs", "use super::response; use crate::physics::paper::X;"),
        (only_the_model_names_the_scene, "src/physics/model.rs", "use crate::scene::Scene;"),
        (sees_only_its_arguments, "src/view/mod.rs", "use std::sync::Arc; fn f() { std::iter::once(1); }"),
        (judges_for_itself, "src/audit/law.rs", "use crate::physics::{Class, Contact, contact::Key, wall::Face};"),
        (is_finished, "src/cli/run.rs", "#[cfg(test)] mod tests { fn f() { Some(1).unwrap(); } }"),
        (speaks_of_things, "src/scene/warnings.rs", "fn f() -> &'static str { \"nobody will see the end\" } // whole"),
        (stands_alone, "src/scene/rules.rs", "/// A length, m.\n/// It is above 0.\nfn f() {}"),
        (
            maps_its_files,
            "src/cli/mod.rs",
            "//! | `run` | a run |\n//! | the rest | a command each |\nmod run;\nmod show;",
        ),
    ];
    for (rule, path, text) in fine {
        assert_eq!(rule(&File::new(path, text)), Vec::<String>::new(), "{text:?} in {path}");
    }
}
