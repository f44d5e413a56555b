//! Where results go: standard output, or a file that is replaced as a whole or not at all.

use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Stdout, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use super::failure::{Failure, printable};

/// A FILE of the command line; `-` is standard output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Target {
    /// `-`
    Stdout,
    /// Anything else.
    File(PathBuf),
}

impl From<&str> for Target {
    fn from(word: &str) -> Target {
        if word == "-" { Target::Stdout } else { Target::File(PathBuf::from(word)) }
    }
}

impl Target {
    /// Where it is, whatever it was called: `a.csv` and `./a.csv` are one place.
    pub(super) fn place(&self) -> io::Result<PathBuf> {
        match self {
            Target::Stdout => Ok(PathBuf::from("-")),
            Target::File(path) => std::path::absolute(path),
        }
    }
}

/// A buffered writer of results. What is not [finished](Output::finish) leaves no file behind and no file changed.
#[derive(Debug)]
pub(super) struct Output {
    writer: BufWriter<Sink>,
    name: String,
}

#[derive(Debug)]
enum Sink {
    Stdout(Stdout),
    /// A pipe or device: nothing to replace.
    Stream(File),
    /// Becomes the file of that name.
    Replacement(NamedTempFile, PathBuf),
}

impl Output {
    /// Opens a target. Nothing changes under its name before [`Output::finish`].
    ///
    /// # Errors
    /// If it is a directory, or its directory can't be written to.
    pub(super) fn open(target: &Target) -> Result<Output, Failure> {
        let Target::File(path) = target else { return Ok(Output::stdout()) };
        let name = path.display().to_string();
        let sink = sink(path).map_err(|error| cannot_write(&name, &error))?;
        Ok(Output { writer: BufWriter::new(sink), name })
    }

    /// Standard output.
    pub(super) fn stdout() -> Output {
        Output { writer: BufWriter::new(Sink::Stdout(io::stdout())), name: "standard output".into() }
    }

    /// Writes out what is buffered and puts the file in its place.
    ///
    /// # Errors
    /// If either fails; then a file of that name is as it was.
    pub(super) fn finish(mut self) -> Result<(), Failure> {
        self.flush()?;
        let Output { writer, name } = self;
        match writer.into_inner().map_err(|error| cannot_write(&name, error.error()))? {
            Sink::Replacement(file, path) => {
                file.persist(path).map(drop).map_err(|failed| cannot_write(&name, &failed.error).into())
            }
            Sink::Stdout(_) | Sink::Stream(_) => Ok(()),
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes).map_err(|error| cannot_write(&self.name, &error))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush().map_err(|error| cannot_write(&self.name, &error))
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Sink::Stdout(stdout) => stdout.write(bytes),
            Sink::Stream(file) => file.write(bytes),
            Sink::Replacement(file, _) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Sink::Stdout(stdout) => stdout.flush(),
            Sink::Stream(file) => file.flush(),
            Sink::Replacement(file, _) => file.flush(),
        }
    }
}

/// Keeps the kind, by which a closed pipe is told from a failure.
fn cannot_write(name: &str, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("cannot write {}: {}", printable(name), plain(error)))
}

/// The system's message without Rust's `(os error N)`.
fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or(&text).to_string()
}

fn sink(path: &Path) -> io::Result<Sink> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(found) if found.permissions().readonly() => Err(io::ErrorKind::PermissionDenied.into()),
        Ok(found) if !found.is_file() => File::options().write(true).open(path).map(Sink::Stream),
        Ok(found) => replacement(&fs::canonicalize(path)?, Some(&found)), // a link stays, what it names is replaced
        Err(error) if error.kind() == io::ErrorKind::NotFound => replacement(path, None),
        Err(error) => Err(error),
    }
}

/// A temporary file beside `path`, so that the renaming at the end stays within one file system.
fn replacement(path: &Path, found: Option<&Metadata>) -> io::Result<Sink> {
    if path.file_name().is_none() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let ordinary = fs::Permissions::from_mode(0o666); // less the umask, as any new file
    let file = Builder::new().prefix(".carom-").permissions(ordinary).tempfile_in(folder)?;
    if let Some(found) = found {
        file.as_file().set_permissions(found.permissions())?;
    }
    Ok(Sink::Replacement(file, path.to_path_buf()))
}
