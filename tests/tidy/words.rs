//! Do comments say what they mean where they stand, and do the maps of the rooms name what is in them?

use crate::source::File;

/// Words for people: data is none of them.
const PEOPLE: [&str; 12] = [
    "who",
    "whom",
    "whoever",
    "nobody",
    "somebody",
    "everybody",
    "anybody",
    "someone",
    "anyone",
    "everyone",
    "likewise",
    "ditto",
];

/// How a doc comment begins that says nothing in a hover, where no line stands before it.
const LEANING: [&str; 16] = [
    "The same", "Same ", "It ", "It's ", "Its ", "This ", "These ", "Those ", "That of ", "They ", "Such ", "So many ",
    "So much ", "As many ", "As much ", "See [",
];

fn complain(file: &File, line: usize, what: &str) -> String {
    format!("{}:{line}: {what}", file.path)
}

/// The lines of a file that are comments from their first character on: number, from 1, mark and text.
fn comments(file: &File) -> impl Iterator<Item = (usize, &str, &str)> {
    file.text.lines().enumerate().filter_map(|(index, line)| {
        let line = line.trim_start();
        let mark = ["///", "//!", "//"].into_iter().find(|mark| line.starts_with(mark))?;
        Some((index + 1, mark, line[mark.len()..].trim_start()))
    })
}

/// Comments speak of data as of things.
pub(crate) fn speaks_of_things(file: &File) -> Vec<String> {
    let person = |text: &str| {
        let mut words = text.split(|c: char| !c.is_alphanumeric()).map(str::to_lowercase);
        words.find(|word| PEOPLE.contains(&word.as_str()))
    };
    let found = comments(file).filter_map(|(line, _, text)| Some((line, person(text)?)));
    found
        .map(|(line, word)| complain(file, line, &format!("data is no person, and a line stands alone: `{word}`")))
        .collect()
}

/// The first line of a doc comment stands alone.
pub(crate) fn stands_alone(file: &File) -> Vec<String> {
    let docs: Vec<(usize, &str)> =
        comments(file).filter(|(_, mark, _)| *mark == "///").map(|(line, _, text)| (line, text)).collect();
    let begins = |index: usize| index == 0 || docs[index - 1].0 + 1 < docs[index].0;
    let leaning = |text: &str| LEANING.iter().find(|start| text.starts_with(*start));
    let first = (0..docs.len()).filter(|&index| begins(index)).map(|index| docs[index]);
    let found = first.filter_map(|(line, text)| Some((line, leaning(text)?)));
    found.map(|(line, start)| complain(file, line, &format!("a doc comment begins with `{}`", start.trim()))).collect()
}

/// The map of a room names every file in it; what it lists in a table is there. "The rest" stands for files alike.
pub(crate) fn maps_its_files(file: &File) -> Vec<String> {
    if !file.path.ends_with("/mod.rs") {
        return Vec::new();
    }
    let map: Vec<(usize, &str)> =
        comments(file).filter(|(_, mark, _)| *mark == "//!").map(|(line, _, text)| (line, text)).collect();
    let quoted = |text: &str| text.split('`').skip(1).step_by(2).map(String::from).collect::<Vec<_>>();
    let named: Vec<String> = map.iter().flat_map(|(_, text)| quoted(text)).collect();
    let whole = map.iter().any(|(_, text)| text.starts_with("| the rest |"));
    let children = file.children();
    let missing = children.iter().filter(|child| *child != "tests" && !whole && !named.contains(child));
    let mut found: Vec<String> =
        missing.map(|child| complain(file, 1, &format!("the map does not name `{child}`"))).collect();
    for (line, text) in map.iter().filter(|(_, text)| text.starts_with("| ") && text.contains('`')) {
        let cell = text.split('|').nth(1).unwrap_or_default();
        let gone = quoted(cell).into_iter().filter(|name| !children.contains(name));
        found.extend(gone.map(|name| complain(file, *line, &format!("the map names `{name}`, which is not there"))));
    }
    found
}
