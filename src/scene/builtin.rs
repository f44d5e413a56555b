//! The scenes that come with the binary, so that it needs no files.

/// A scene of `scenes/`, as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Builtin {
    /// Name of the scene: the file's, without the ending.
    pub name: &'static str,
    /// Text of the scene's file.
    pub text: &'static str,
}

/// Embeds the files of these names.
macro_rules! embedded {
    ($($name:literal),* $(,)?) => {
        &[$(Builtin { name: $name, text: include_str!(concat!("../../scenes/", $name, ".ron")) }),*]
    };
}

/// Every scene of `scenes/`, the paper's five first. A test refuses a file that is missing here.
pub const ALL: &[Builtin] = embedded![
    "paper-0",
    "paper-1",
    "paper-2",
    "paper-3",
    "paper-4",
    "newtons-cradle",
    "billiard",
    "cannon",
    "zeno",
    "corner",
    "zigzag",
    "galton",
    "stack",
    "brownian",
    "box-gas",
    "bouncing-49",
    "elastic-666",
    "inelastic-666",
    "photon",
];

/// The built-in scene of that name.
pub fn find(name: &str) -> Option<Builtin> {
    ALL.iter().copied().find(|builtin| builtin.name == name)
}

/// Built-in names like this one: those that contain it or are few letters off; nearest first.
pub(super) fn close_names(name: &str) -> Vec<&'static str> {
    // No name is that long; a longer word is like none, and comparing it would only take time.
    if name.chars().count() > 40 {
        return Vec::new();
    }
    let off = |known: &str| if !name.is_empty() && known.contains(name) { 0 } else { strsim::levenshtein(name, known) };
    let mut names: Vec<_> = ALL.iter().map(|builtin| (off(builtin.name), builtin.name)).collect();
    names.sort_by_key(|&(off, _)| off);
    names.into_iter().take_while(|&(off, _)| off <= 3).map(|(_, known)| known).take(5).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_finger_finds_its_scene() {
        assert_eq!(close_names("papper-3").first(), Some(&"paper-3"));
        assert_eq!(close_names("paper").len(), 5);
        assert!(close_names(&"x".repeat(100_000)).is_empty());
    }
}
