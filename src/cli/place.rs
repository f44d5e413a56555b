//! Which file a word of the command line leads to, so that no output destroys an input or another output.
//!
//! Two words lead to one file if the system says so: by device and number for what exists (other spellings, symbolic
//! and hard links, linked folders, `-` and `/dev/stdout`), by the folder's and the name in it for what does not exist
//! yet. Names that a file system takes for one (capitals and small letters, say) are known as one only once the file
//! exists.

use std::ffi::OsString;
use std::fs::{self, Metadata};
use std::io;
use std::os::fd::AsFd;
use std::os::unix::fs::{FileTypeExt, MetadataExt};
use std::path::{Path, PathBuf};

use rustix::io::Errno;

/// Most links that lead to links that are followed, as many as by Linux.
const MOST_LINKS: usize = 40;

/// Where bytes end up.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Place {
    /// A file that exists, by device and number.
    There(u64, u64),
    /// A file that does not exist yet: its folder, by device and number, and its name.
    New(u64, u64, OsString),
    /// The null device, which any number of outputs may share.
    Nowhere,
}

impl Place {
    /// The place that a path leads to, whether or not there is a file.
    ///
    /// # Errors
    /// If the path leads nowhere: a folder is missing, links go in a circle.
    pub(super) fn of(path: &Path) -> io::Result<Place> {
        match fs::metadata(path) {
            Ok(found) => Ok(Place::there(&found)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let path = destination(path)?;
                let folder = fs::metadata(folder(&path))?;
                let name = path.file_name().ok_or(Errno::ISDIR)?;
                Ok(Place::New(folder.dev(), folder.ino(), name.to_owned()))
            }
            Err(error) => Err(error),
        }
    }

    /// The place of an open file.
    pub(super) fn of_open(file: impl AsFd) -> Option<Place> {
        let found = fs::File::from(file.as_fd().try_clone_to_owned().ok()?).metadata().ok()?;
        Some(Place::there(&found))
    }

    fn there(found: &Metadata) -> Place {
        let null = || fs::metadata("/dev/null").is_ok_and(|null| null.rdev() == found.rdev());
        if found.file_type().is_char_device() && null() {
            Place::Nowhere
        } else {
            Place::There(found.dev(), found.ino())
        }
    }
}

/// The path of a file of that name once it exists: the links that lead to nothing yet are followed.
///
/// # Errors
/// If they go in a circle.
pub(super) fn destination(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        let Ok(to) = fs::read_link(&path) else { return Ok(path) };
        path = folder(&path).join(to);
    }
    Err(Errno::LOOP.into())
}

/// The folder of a path.
pub(super) fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
