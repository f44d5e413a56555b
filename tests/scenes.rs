//! Does every shipped scene load, is every refusal said in the words promised, and can no file do harm?

use std::fs;
use std::path::{Path, PathBuf};

use carom::scene::{self, Scene, builtin};
use glam::DVec3;
use proptest::prelude::*;

fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = fs::read_dir(folder).expect("the folder is part of the repository");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("readable").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|found| found == ending));
    paths.sort();
    paths
}

fn parsed(text: &str) -> Result<Scene, String> {
    scene::parse(text, "test.ron").map_err(|error| error.to_string())
}

fn refusal(text: &str) -> String {
    parsed(text).expect_err("it breaks a rule")
}

#[test]
fn every_file_of_the_scenes_folder_is_embedded_as_it_is() {
    let stems: Vec<_> = files("scenes", "ron")
        .into_iter()
        .map(|path| {
            let name = path.file_stem().expect("it ends in .ron").to_string_lossy().into_owned();
            let text = fs::read_to_string(&path).expect("readable");
            assert_eq!(builtin::find(&name).map(|found| found.text), Some(text.as_str()), "{name} is not embedded");
            name
        })
        .collect();
    assert_eq!(stems.len(), builtin::ALL.len());
    let first = builtin::ALL.iter().take(5).map(|found| found.name);
    assert!(first.eq(["paper-0", "paper-1", "paper-2", "paper-3", "paper-4"]));
}

#[test]
fn every_shipped_scene_opens_says_what_to_look_at_and_earns_no_warning() {
    for builtin in builtin::ALL {
        let opened = scene::open(builtin.name).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((opened.key.as_str(), opened.path), (builtin.name, None));
        let scene = opened.scene;
        assert!(!scene.about.is_empty() && !scene.name.is_empty(), "{} says nothing of itself", builtin.name);
        assert!(scene.about.chars().count() <= 100, "{}: its line is too long for a list", builtin.name);
        assert_eq!(scene::warnings(&scene), Vec::<String>::new(), "{}", builtin.name);
        assert!(scene.spheres.iter().any(|sphere| sphere.color.is_some()), "{} is grey", builtin.name);
    }
}

#[test]
fn the_paper_s_scenes_are_the_paper_s() {
    let spheres = |name: &str| {
        let scene = scene::open(name).expect("it is built in").scene;
        assert_eq!(scene.gravity, DVec3::new(0.0, -9.8, 0.0));
        assert!(scene.spheres.iter().all(|sphere| (sphere.mass, sphere.radius) == (1.0, 0.5)));
        let law = scene.contact;
        let numbers = (law.restitution, law.wall_restitution, law.tangential, law.rest_speed);
        assert_eq!(numbers, (0.8, 0.8, 0.99, 0.1));
        let extra: Vec<_> = scene.walls[6..].iter().map(|wall| wall.shape).map(|w| [w.center, w.s1, w.s2]).collect();
        let moving: Vec<_> = scene.spheres.iter().map(|sphere| [sphere.x, sphere.v]).collect();
        (extra.as_flattened().to_vec(), moving.as_flattened().to_vec())
    };
    let vectors = |numbers: &[[f64; 3]]| numbers.iter().copied().map(DVec3::from_array).collect::<Vec<_>>();
    let slope = vectors(&[[3.0, 3.0, 7.5], [0.0, 0.0, 20.0], [8.0, 6.0, 0.0]]);
    assert_eq!(spheres("paper-0"), (vec![], vectors(&[[-4.5, 9.5, 0.0], [0.0; 3]])));
    assert_eq!(spheres("paper-1"), (slope.clone(), vectors(&[[4.5, 5.0, 5.0], [0.0, 0.0, -2.0]])));
    let walls =
        [[0.0, 4.0, -0.5], [0.0, 0.0, 4.0], [10.0, 2.0, 0.0], [0.0, 2.0, -0.5], [0.0, 0.0, 4.0], [10.0, -2.0, 0.0]];
    let balls =
        [[-4.5, 7.0, -0.5], [3.0, 2.0, 0.0], [4.5, 3.0, -0.5], [0.0, 10.0, 0.0], [0.0, 1.0, -0.5], [0.0, 10.0, 0.0]];
    assert_eq!(spheres("paper-2"), (vectors(&walls), vectors(&balls)));
    let balls = [[-4.5, 0.5, 0.0], [5.0, 0.0, 0.0], [4.5, 5.5, 0.0], [-3.0, 0.0, 0.0]];
    assert_eq!(spheres("paper-3"), (slope, vectors(&balls)));
    let walls =
        [[-2.5, 2.5, -0.5], [5.0, -3.0, 0.0], [0.0, 0.0, -4.0], [2.5, 2.5, -0.5], [0.0, 0.0, 4.0], [5.0, 3.0, 0.0]];
    let balls = [[-4.5, 9.5, -0.5], [5.0, 0.0, 0.0], [4.5, 9.5, -0.5], [-5.0, 0.0, 0.0]];
    assert_eq!(spheres("paper-4"), (vectors(&walls), vectors(&balls)));
}

#[test]
fn what_a_scene_leaves_out_has_the_paper_s_value() {
    let scene = parsed("Scene()").expect("everything may be left out");
    assert_eq!((scene.name.as_str(), scene.about.as_str(), scene.gravity), ("test", "", DVec3::ZERO));
    let law = scene.contact;
    assert_eq!((law.restitution, law.wall_restitution, law.tangential, law.rest_speed), (0.8, 0.8, 0.99, 0.1));
    assert_eq!((scene.solver.method.name(), scene.solver.dt, scene.solver.tolerance), ("paper", 0.01, 0.001));
    assert_eq!(scene.duration, 20.0);
}

/// A refused file tells in its first line what must be said of it: `// expect: …`, without the file's name.
#[test]
fn every_refused_file_has_its_exact_message() {
    let paths = files("tests/refused", "ron");
    assert!(paths.len() >= 40, "only {} refusals", paths.len());
    for path in paths {
        let text = fs::read_to_string(&path).expect("readable");
        let name = path.file_name().expect("it has one").to_string_lossy();
        let expected = text.lines().next().and_then(|line| line.strip_prefix("// expect: "));
        let expected = expected.unwrap_or_else(|| panic!("{name} does not say what it expects"));
        let said = scene::parse(&text, "FILE").map(|_| "it was accepted".to_owned()).unwrap_or_else(|e| e.to_string());
        assert_eq!(said, format!("FILE:{expected}"), "in {name}");
    }
}

/// Whether a message may be printed as it is.
fn is_printable(message: &str) -> bool {
    let format =
        |c: char| matches!(c, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}');
    message.chars().count() < 2500 && !message.chars().any(|c| c.is_control() || format(c))
}

/// Text that is nearly a scene: pieces of the format in any order.
fn pieces() -> impl Strategy<Value = String> {
    let known = [
        "Scene(",
        "walls: [",
        "spheres: [",
        "Sphere(",
        "Wall(",
        "Room(",
        "Gas(",
        "Lattice(",
        "view: (",
        "solver: (",
        "x: (0, 1, 2)",
        "mass: 1",
        "radius: 0.5",
        "min: (0, 0, 0)",
        "max: (9, 9, 9)",
        "count: 5",
        "seed: 18446744073709551615",
        "counts: (2, 2, 2)",
        "spacing: 3",
        "origin: (1, 1, 1)",
        "method: paper",
        "method: \u{1b}",
        "dt: 1e-12",
        ",",
        ")",
        "]",
        "(",
        "[",
        "{",
        "}",
        "\"",
        "\\",
        "\u{202e}",
        "\u{1b}[2J",
        "r#\"",
        "/*",
        "*/",
        "//",
        "\n",
        "inf",
        "NaN",
        "-1e400",
        "1_0",
        "0x",
        "'",
        "#![enable(implicit_some)]",
        "Some(",
        "None",
        "name: \"a\u{7}\"",
        "é",
    ];
    prop::collection::vec(prop::sample::select(known.to_vec()), 0..40).prop_map(|words| words.concat())
}

proptest! {
    // A fixed seed: the same cases on every machine and every day.
    #![proptest_config(ProptestConfig { rng_seed: proptest::test_runner::RngSeed::Fixed(20_261_122), failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn no_text_can_make_it_panic_or_print_control_characters(text in prop_oneof![pieces(), ".{0,200}"], origin in ".{0,20}") {
        if let Err(error) = scene::parse(&text, &origin) {
            prop_assert!(is_printable(&error.to_string()), "{error}");
        }
    }

    #[test]
    fn a_shipped_scene_with_one_piece_replaced_is_still_safe(at in 0.0..1.0, length in 0_usize..30, with in pieces(), which in 0_usize..5) {
        let text = builtin::ALL[which].text;
        let boundary = |offset: usize| (offset..).find(|&i| text.is_char_boundary(i.min(text.len()))).map_or(0, |i| i.min(text.len()));
        let from = boundary((at * text.len() as f64) as usize);
        let to = boundary(from + length);
        let damaged = format!("{}{with}{}", &text[..from], &text[to..]);
        if let Err(error) = scene::parse(&damaged, "test.ron") {
            prop_assert!(is_printable(&error.to_string()), "{error}");
        }
    }

    #[test]
    fn no_bytes_in_a_file_can_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a\u{1b}\u{202e}.ron");
        fs::write(&path, bytes).expect("writable");
        if let Err(error) = scene::open(&path.to_string_lossy()) {
            prop_assert!(is_printable(&error.to_string()), "{error}");
        }
    }
}
