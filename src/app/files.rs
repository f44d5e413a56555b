//! Files that are written whole or not at all, and replace none: a number that is free makes the name.

use std::{
    fs::Permissions,
    io::{Error, ErrorKind, Write},
    os::unix::fs::PermissionsExt,
    path::{Path, PathBuf},
};

use tempfile::{Builder, NamedTempFile, PersistError};

/// Most numbers that are tried for a name.
const NUMBERS: u32 = 10_000;

/// Writes files of these endings and contents, all under one name that none of them has yet: `stem-1.svg`, `stem-1.ron`.
///
/// # Errors
/// The system's error; then none of the files is there.
pub(super) fn write(folder: &Path, stem: &str, files: &[(&str, &[u8])]) -> Result<Vec<String>, Error> {
    let drafts: Vec<NamedTempFile> = files.iter().map(|(_, bytes)| draft(folder, bytes)).collect::<Result<_, _>>()?;
    let mut drafts: Vec<Option<NamedTempFile>> = drafts.into_iter().map(Some).collect();
    for number in 1..=NUMBERS {
        let names: Vec<String> = files.iter().map(|(ending, _)| format!("{stem}-{number}.{ending}")).collect();
        if names.iter().any(|name| folder.join(name).symlink_metadata().is_ok()) {
            continue;
        }
        let mut placed: Vec<PathBuf> = Vec::new();
        let mut failed = None;
        for (draft, name) in drafts.iter_mut().zip(&names) {
            let path = folder.join(name);
            match draft.take().map(|draft| draft.persist_noclobber(&path)) {
                Some(Ok(_)) => placed.push(path),
                Some(Err(PersistError { error, file })) => {
                    *draft = Some(file);
                    failed = Some(error);
                    break;
                }
                None => {}
            }
        }
        match failed {
            None => return Ok(names),
            Some(error) => {
                placed.iter().for_each(|path| drop(std::fs::remove_file(path))); // half of them is of no use
                if error.kind() != ErrorKind::AlreadyExists || !placed.is_empty() {
                    return Err(error);
                }
            }
        }
    }
    Err(Error::new(ErrorKind::AlreadyExists, format!("{NUMBERS} files of that name are there already")))
}

/// A file that has no name of its own yet.
fn draft(folder: &Path, bytes: &[u8]) -> Result<NamedTempFile, Error> {
    let ordinary = Permissions::from_mode(0o666); // less the umask, as any new file
    let mut file = Builder::new().prefix(".carom-").permissions(ordinary).tempfile_in(folder)?;
    file.write_all(bytes)?;
    Ok(file)
}

/// A name that any file system takes, made of a scene's.
pub(super) fn stem(key: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '_' };
    let stem: String = key.trim_start_matches(['-', '.']).chars().take(40).map(plain).collect();
    if stem.is_empty() { "scene".into() } else { stem }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_one_of_the_files_has_already_is_left_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("drop-1.ron"), "mine").expect("a file");
        std::fs::create_dir(folder.path().join("drop-2.svg")).expect("a folder");
        std::os::unix::fs::symlink("nowhere", folder.path().join("drop-3.ron")).expect("a link");
        let both: [(&str, &[u8]); 2] = [("svg", b"picture"), ("ron", b"state")];
        assert_eq!(write(folder.path(), "drop", &both).expect("written"), ["drop-4.svg", "drop-4.ron"]);
        assert_eq!(write(folder.path(), "drop", &both[..1]).expect("written"), ["drop-1.svg"]);
        assert_eq!(std::fs::read(folder.path().join("drop-1.ron")).expect("there"), b"mine");
        assert_eq!(std::fs::read(folder.path().join("drop-4.ron")).expect("there"), b"state");
        assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 6, "and nothing else is left");
    }

    #[test]
    fn where_nothing_can_be_written_nothing_is() {
        let folder = tempfile::tempdir().expect("a folder");
        assert!(write(&folder.path().join("gone"), "drop", &[("svg", b"picture")]).is_err());
        assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 0);
    }

    #[test]
    fn a_scene_of_any_name_gives_a_name_that_is_no_path() {
        assert_eq!(
            ["paper-1", "../etc/x", "--", "", "a b", "大"].map(stem),
            ["paper-1", "_etc_x", "scene", "scene", "a_b", "大"]
        );
    }
}
