//! Is every file either read or refused? Files from nowhere, and from the wrong places: nothing may panic, hang or pass
//! that breaks a rule.
//!
//! `CAROM_MUTANTS=1000000 cargo test --release --test fuzz` tries as many mutants of the corpus as that, by fixed seeds.
//! The same checks are targets of bolero, with the corpus in `__fuzz__`: `cargo bolero test --sanitizer NONE scene_files`
//! looks for new paths through the code; without it the corpus alone is run.

// A fuzzer tells what it met.
#![allow(clippy::print_stdout)]

#[path = "fuzz/mutant.rs"]
mod mutant;
#[path = "support/random.rs"]
mod random;

use carom::{
    export::{Format, Table, TradeRow, read_trade},
    measure::{self, Placed},
    physics::{Method, Simulation, Until},
    scene::{self, Scene},
};
use random::Random;

/// Mutants tried in the ordinary tests.
const FEW: u64 = 4000;

/// Scenes of more spheres than this are right or wrong for reasons that smaller ones have too, and take longer.
const CROWD: usize = 20_000;

fn mutants() -> u64 {
    let asked = std::env::var("CAROM_MUTANTS").ok();
    asked.map_or(FEW, |count| count.parse().expect("CAROM_MUTANTS is a number"))
}

/// Tries all mutants of the files of the first folders, with pieces of those of the second; the seed of one that panics is the last that is named.
fn try_all([good, other]: [&[&str]; 2], ending: &str, check: impl Fn(&[u8]) -> bool) {
    let [files, others] = [good, other].map(|folders| mutant::files(folders, ending, 4096));
    let mut read = 0_u64;
    for seed in 0..mutants() {
        let file = mutant::mutant(&files, &others, &mut Random::new(seed));
        let tried = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| check(&file)));
        let was_read = tried.unwrap_or_else(|_| panic!("mutant {seed}:\n{}", String::from_utf8_lossy(&file)));
        read += u64::from(was_read);
    }
    println!("{ending}: {} mutants, of which {read} were read and all others refused", mutants());
    assert!(
        read > mutants() / 100 && read < mutants(),
        "{read} of {}: the mutants are too wild or too tame",
        mutants()
    );
}

#[test]
fn every_mutant_of_a_scene_file_is_read_or_refused() {
    try_all([&["scenes", "tests/__fuzz__/scene/corpus"], &["scenes", "tests/refused"]], "ron", scene_file);
}

#[test]
fn every_mutant_of_a_merge_file_is_read_or_refused() {
    let corpus: &[&str] = &["tests/__fuzz__/merge/corpus"];
    try_all([corpus, corpus], "csv", merge_file);
}

#[test]
fn scene_files() {
    let target = bolero::check!(name = "scene").with_iterations(0).with_max_len(1 << 16);
    target.for_each(|file: &[u8]| {
        let _ = scene_file(file);
    });
}

#[test]
fn merge_files() {
    let target = bolero::check!(name = "merge").with_iterations(0).with_max_len(1 << 16);
    target.for_each(|file: &[u8]| {
        let _ = merge_file(file);
    });
}

/// Whether the file was read; panics if anything is wrong with that.
fn scene_file(file: &[u8]) -> bool {
    let Ok(text) = str::from_utf8(file) else { return false };
    if spheres_asked_for(text) > CROWD {
        return false;
    }
    match scene::parse(text, "mutant.ron") {
        Ok(scene) => {
            assert_sound(&scene);
            let _ = scene::warnings(&scene, scene.solver, scene.duration);
            runs(&scene);
            true
        }
        Err(error) => {
            let said = error.to_string();
            assert!(said.starts_with("mutant.ron") && !said.contains(char::is_control), "{said:?}");
            assert!(said.len() < 1000, "{} bytes: {said}", said.len());
            false
        }
    }
}

/// An upper bound of what the generators are asked for: the product of the numbers behind each `count`.
fn spheres_asked_for(text: &str) -> usize {
    let asked = text.split("count").skip(1).map(|rest| {
        let end = rest.find(|c: char| c.is_alphabetic() && c != 's' || c == ']').unwrap_or(rest.len());
        let numbers = rest[..end].split(|c: char| !c.is_ascii_digit()).filter(|digits| !digits.is_empty());
        numbers.fold(1_usize, |all, digits| all.saturating_mul(digits.parse().unwrap_or(usize::MAX)))
    });
    asked.fold(0, usize::saturating_add)
}

/// The rules that each value of a scene keeps alone.
fn assert_sound(scene: &Scene) {
    let fraction = |value: f64| (0.0..=1.0).contains(&value);
    let law = &scene.contact;
    assert!(fraction(law.restitution) && fraction(law.wall_restitution) && fraction(law.tangential));
    assert!(law.rest_speed >= 0.0 && law.rest_speed.is_finite());
    assert!(scene.solver.dt > 0.0 && scene.solver.dt.is_finite());
    assert!(scene.solver.tolerance >= 0.0 && scene.solver.tolerance.is_finite());
    assert!(scene.duration >= 0.0 && scene.duration.is_finite() && scene.gravity.is_finite());
    for wall in &scene.walls {
        assert!(wall.shape.corners().iter().all(|corner| corner.is_finite()), "{wall:?}");
    }
    for sphere in &scene.spheres {
        assert!(sphere.mass > 0.0 && sphere.mass.is_finite() && sphere.radius > 0.0 && sphere.radius.is_finite());
        assert!(sphere.x.is_finite() && sphere.v.is_finite() && sphere.force.is_finite(), "{sphere:?}");
    }
    let texts = scene.spheres.iter().filter_map(|sphere| sphere.name.as_ref()).chain([&scene.name, &scene.about]);
    texts.for_each(|text| assert!(!text.contains(char::is_control), "{text:?}"));
}

/// Begins a run by the scene's own method: a little work, whatever it leads to.
fn runs(scene: &Scene) {
    if scene.spheres.len() <= 64 && scene.walls.len() <= 64 {
        let mut run = Simulation::new(scene, scene.solver);
        let _ = run.advance(Until::Frame, 100);
    }
}

/// Whether the file was read; panics if anything is wrong with that.
fn merge_file(file: &[u8]) -> bool {
    let rows = match read_trade(file) {
        Ok(rows) => rows,
        Err(said) => {
            assert!(!said.to_string().contains(char::is_control), "{said:?}");
            return false;
        }
    };
    let place = |line: u64| format!("mutant.csv:{line}");
    let placed = rows.into_iter().map(|(line, row)| Placed { place: place(line), row }).collect();
    let Ok(rows) = measure::merge(placed) else { return false };
    let _ = (
        measure::report(&rows, Method::ALL, &[], measure::Axes::default()),
        measure::figure(&rows, Method::ALL, measure::Axes::default(), ""),
    );
    let mut table = Table::new::<TradeRow>(Format::Csv, Vec::new()).expect("memory");
    rows.iter().for_each(|row| table.write(row).expect("memory"));
    let written = table.finish().expect("memory");
    let again: Vec<TradeRow> =
        read_trade(&written[..]).expect("what was written").into_iter().map(|(_, row)| row).collect();
    assert_eq!(again, rows, "written and read again");
    true
}
