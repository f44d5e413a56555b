//! Which file imports from which, and the circles that these arrows form: no file of a circle can be read, tested or
//! moved without all the others.

use std::collections::{BTreeMap, BTreeSet};

use crate::source::{File, Root};

/// By the path of a file: the paths of the files that it names something of.
pub(crate) type Arrows = BTreeMap<String, BTreeSet<String>>;

/// The arrows between these files. A name belongs to the file of the deepest module on its path: `crate::view::Screen`
/// to `src/view/mod.rs`, even if that only passes it on, and `super::screen::Screen` to `src/view/screen.rs`.
pub(crate) fn arrows(files: &[File]) -> Arrows {
    let homes: BTreeMap<Vec<String>, &str> = files.iter().map(|file| (file.module(), file.path.as_str())).collect();
    let home = |parts: &[String]| (0..=parts.len()).rev().find_map(|depth| homes.get(&parts[..depth]).copied());
    let arrows = files.iter().map(|file| {
        let ours = file.contents().names.into_iter().filter(|name| name.root == Root::Ours);
        let to = ours.filter_map(|name| home(&name.parts)).filter(|to| *to != file.path).map(String::from);
        (file.path.clone(), to.collect())
    });
    arrows.collect()
}

/// The circles: groups of files, each of which leads to every other of its group along the arrows.
pub(crate) fn circles(arrows: &Arrows) -> Vec<BTreeSet<String>> {
    let reach: BTreeMap<&String, BTreeSet<&String>> = arrows.keys().map(|from| (from, reached(arrows, from))).collect();
    let mut circles = BTreeSet::new();
    for (from, found) in reach.iter().filter(|(from, found)| found.contains(*from)) {
        let there_and_back = found.iter().filter(|to| reach.get(**to).is_some_and(|back| back.contains(*from)));
        circles.insert(there_and_back.map(|file| (*file).clone()).collect::<BTreeSet<_>>());
    }
    circles.into_iter().collect()
}

/// All files that a way along one arrow or more leads to.
fn reached<'a>(arrows: &'a Arrows, from: &str) -> BTreeSet<&'a String> {
    let next = |file: &str| arrows.get(file).into_iter().flatten();
    let mut found: BTreeSet<&String> = BTreeSet::new();
    let mut open: Vec<&String> = next(from).collect();
    while let Some(file) = open.pop() {
        if found.insert(file) {
            open.extend(next(file));
        }
    }
    found
}
