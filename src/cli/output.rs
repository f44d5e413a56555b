//! Where results go: standard output, or a file that is replaced as a whole or not at all.

use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Stdout, Write};
use std::os::fd::AsFd;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use rustix::io::Errno;
use tempfile::{Builder, NamedTempFile};

use super::failure::{Failure, cannot_write};
use super::place::{Place, destination, folder};
use super::target::Target;

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
    /// A file beside the target, which becomes the file of that name.
    Replacement(NamedTempFile, PathBuf),
}

impl Output {
    /// Opens a target. Nothing changes under its name before [`Output::finish`].
    ///
    /// # Errors
    /// If it is a directory, or its directory can't be written to.
    pub(super) fn open(target: &Target) -> Result<Output, Failure> {
        let Target::File(path) = target else { return Ok(Output::stdout()) };
        if target.is_stdout() {
            return Ok(Output::stdout());
        }
        let name = target.name();
        let sink = sink(path).map_err(|error| cannot_write(&name, &error))?;
        Ok(Output { writer: BufWriter::new(sink), name })
    }

    /// Standard output.
    pub(super) fn stdout() -> Output {
        Output { writer: BufWriter::new(Sink::Stdout(io::stdout())), name: "standard output".into() }
    }

    /// Writes a report on standard output, or on standard error where results have the former for themselves.
    ///
    /// # Errors
    /// If standard output cannot be written.
    pub(super) fn report(text: &str, on_stdout: bool) -> Result<(), Failure> {
        if on_stdout {
            let mut out = Output::stdout();
            out.write_all(text.as_bytes())?;
            return out.finish();
        }
        let _ = io::stderr().write_all(text.as_bytes()); // where it cannot be read, the results still stand
        Ok(())
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

fn sink(path: &Path) -> io::Result<Sink> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(Errno::ISDIR.into()),
        Ok(found) if found.permissions().readonly() => Err(Errno::ACCESS.into()),
        // The shell has opened this file for us: replacing it would leave its bytes in one that has no name any more.
        Ok(_) if is_stderr(path) => Ok(Sink::Stream(File::from(io::stderr().as_fd().try_clone_to_owned()?))),
        Ok(found) if !found.is_file() => File::options().write(true).open(path).map(Sink::Stream),
        Ok(found) => replacement(&fs::canonicalize(path)?, Some(&found)), // a link stays, what it names is replaced
        Err(error) if error.kind() == io::ErrorKind::NotFound => replacement(&destination(path)?, None),
        Err(error) => Err(error),
    }
}

fn is_stderr(path: &Path) -> bool {
    let place = Place::of(path).ok().filter(|place| *place != Place::Nowhere);
    place.is_some() && place == Place::of_open(io::stderr())
}

/// A temporary file beside `path`, so that the renaming at the end stays within one file system.
fn replacement(path: &Path, found: Option<&Metadata>) -> io::Result<Sink> {
    if path.file_name().is_none() {
        return Err(Errno::ISDIR.into());
    }
    let ordinary = fs::Permissions::from_mode(0o666); // less the umask, as any new file
    let file = Builder::new().prefix(".carom-").permissions(ordinary).tempfile_in(folder(path)).map_err(unwrapped)?;
    if let Some(found) = found {
        file.as_file().set_permissions(found.permissions())?;
    }
    Ok(Sink::Replacement(file, path.to_path_buf()))
}

/// The system's own words: tempfile adds the path of its file, which the command line does not name.
fn unwrapped(error: io::Error) -> io::Error {
    let text = error.to_string();
    io::Error::new(error.kind(), text.split(" (os error ").next().unwrap_or(&text).to_owned())
}
