//! Does the README tell the truth: its picture, its commands, its scene?

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::process::Command;

use crate::source::home;

fn readme() -> String {
    fs::read_to_string(home().join("README.md")).expect("the README")
}

/// The fenced blocks of a language.
fn blocks(language: &str) -> Vec<String> {
    let text = readme();
    let mut found = Vec::new();
    let mut open: Option<(bool, String)> = None;
    for line in text.lines() {
        open = match (open.take(), line.strip_prefix("```")) {
            (None, Some(tag)) => Some((tag == language, String::new())),
            (None, None) => None,
            (Some((wanted, block)), Some(_)) => {
                found.extend(wanted.then_some(block));
                None
            }
            (Some((wanted, block)), None) => Some((wanted, block + line + "\n")),
        };
    }
    assert!(!found.is_empty(), "the README has no {language} block");
    found
}

/// Every command of the blocks and of the text between backquotes, without its comment.
fn commands() -> Vec<String> {
    let blocks = blocks("sh").concat();
    let lines = blocks.lines().map(|line| line.split(" #").next().unwrap_or("").trim().to_string());
    let text: String = readme().lines().filter(|line| !line.starts_with("```")).collect::<Vec<_>>().join("\n");
    let quoted = text.split('`').skip(1).step_by(2).map(String::from).collect::<Vec<_>>();
    let known = |command: &String| ["carom", "cargo", "tests/", ".ci/"].iter().any(|start| command.starts_with(start));
    lines.chain(quoted).filter(known).collect()
}

/// The words that carom itself gets, if it is a command for carom: SCENE stands for any.
fn arguments(command: &str) -> Option<Vec<String>> {
    let words: Vec<&str> = match command.split_once("-- ") {
        Some((cargo, words)) if cargo.starts_with("cargo run") => words.split_whitespace().collect(),
        _ => command.strip_prefix("carom")?.split_whitespace().collect(),
    };
    Some(words.into_iter().map(|word| word.replace("SCENE", "paper-2")).collect())
}

#[test]
fn every_command_of_the_readme_exists() {
    let commands = commands();
    assert!(commands.len() > 8, "{commands:?}");
    for command in commands {
        if let Some(words) = arguments(&command) {
            exists(&command, words);
        } else if !command.starts_with("cargo") {
            let file = fs::metadata(home().join(&command)).unwrap_or_else(|error| panic!("`{command}`: {error}"));
            assert!(file.permissions().mode() & 0o111 != 0, "`{command}` is no program");
        }
    }
}

/// A command alone is its name; with more words it must be right as it stands.
fn exists(written: &str, words: Vec<String>) {
    let command = carom::cli::command();
    if let [name] = words.as_slice()
        && command.find_subcommand(name).is_some()
    {
        return;
    }
    let parsed = command.try_get_matches_from([vec!["carom".to_string()], words].concat());
    if let Err(error) = parsed {
        assert_eq!(error.exit_code(), 0, "`{written}`: {error}"); // help is no error
    }
}

#[test]
fn every_scene_that_the_readme_names_is_built_in() {
    let built_in = |word: &str| carom::scene::builtin::ALL.iter().any(|scene| scene.name == word);
    for command in commands() {
        let words = arguments(&command).unwrap_or_default();
        let numbered = words.iter().filter(|word| word.starts_with("paper-"));
        numbered.for_each(|word| assert!(built_in(word), "`{command}`"));
    }
    assert!(readme().contains("paper-2"));
}

#[test]
fn the_picture_is_the_stored_frame_and_the_one_that_is_drawn() {
    let stored = fs::read_to_string(home().join("tests/frames/readme.txt")).expect("the stored frame");
    assert_eq!(blocks("text")[0], stored, "the picture is not tests/frames/readme.txt");
    let command = commands().into_iter().find(|command| command.starts_with("carom render")).expect("its command");
    let words = arguments(&command).expect("words for carom");
    let drawn = Command::new(env!("CARGO_BIN_EXE_carom")).args(words).output().expect("the built binary");
    assert_eq!(String::from_utf8(drawn.stdout).expect("text"), stored, "`{command}` draws something else");
}

#[test]
fn the_scene_is_complete_and_short() {
    for block in blocks("ron") {
        let scene = carom::scene::parse(&block, "README.md").unwrap_or_else(|error| panic!("{error}"));
        assert!(block.lines().count() <= 12 && !scene.spheres.is_empty(), "{block}");
        assert_eq!(carom::scene::warnings(&scene, scene.solver, scene.duration), Vec::<String>::new());
    }
}
