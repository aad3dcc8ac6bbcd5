//! The destination of text: standard output, or a file that is replaced only once everything is written.

use std::ffi::OsStr;
use std::fs::{self, File, OpenOptions};
use std::io::{self, IsTerminal as _, Write};
use std::path::{Path, PathBuf};
use std::process;

use clap::Args;

use crate::failure::Failure;
use crate::interrupt;

/// Where an answer goes.
#[derive(Args, Debug)]
pub(crate) struct Destination {
    /// Write to a file instead of standard output; an existing file is replaced once the answer is complete
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Destination {
    /// Rejects an unwritable file before any long computation.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        match &self.output {
            Some(path) => (Target::of(path).check()).map_err(|source| Failure::write(path, source)),
            None => Ok(()),
        }
    }

    /// Whether the answer goes to a terminal.
    pub(crate) fn is_terminal(&self) -> bool {
        self.output.is_none() && io::stdout().is_terminal()
    }

    /// Writes a text.
    pub(crate) fn write(&self, text: &str) -> Result<(), Failure> {
        self.write_bytes(text.as_bytes())
    }

    /// Writes text or binary data.
    pub(crate) fn write_bytes(&self, content: &[u8]) -> Result<(), Failure> {
        interrupt::answer();
        let written = match &self.output {
            Some(path) => Target::of(path).write(content),
            None => {
                let mut out = io::stdout().lock();
                out.write_all(content).and_then(|()| out.flush())
            }
        };
        written.map_err(|source| self.failure(source))
    }

    /// Begins output that is written as it arrives.
    pub(crate) fn begin(&self) -> Result<(Unfinished, Begun), Failure> {
        let begun = match &self.output {
            Some(path) => Target::of(path).begin(),
            None => Ok((Unfinished(None), Box::new(io::stdout()) as Begun)),
        };
        begun.map_err(|source| self.failure(source))
    }

    /// Interprets a write error.
    pub(crate) fn failure(&self, source: io::Error) -> Failure {
        match &self.output {
            Some(path) => Failure::write(path, source),
            None => printing(source),
        }
    }

    /// A file of this name beside the file, unless that is a device or a link.
    pub(crate) fn beside(&self, name: &str) -> Option<Self> {
        let output = self.output.as_deref()?;
        let is_file = matches!(Target::of(output), Target::File { path, .. } if path == output);
        is_file.then(|| Self { output: Some(output.with_file_name(name)) })
    }

    /// The path of the file, if any.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.output.as_deref()
    }
}

/// Writes to standard output.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(printing)
}

fn printing(error: io::Error) -> Failure {
    match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::NobodyReads,
        _ => Failure::Print(error),
    }
}

/// Output that is written as it arrives.
pub(crate) type Begun = Box<dyn Write + Send>;

/// The temporary path and final path of a file; until it is complete, the existing file stays.
pub(crate) struct Unfinished(Option<(PathBuf, PathBuf)>);

impl Unfinished {
    pub(crate) fn move_into_place(mut self) -> io::Result<()> {
        match &self.0 {
            Some((beside, path)) => fs::rename(beside, path)?,
            None => return Ok(()),
        }
        self.0 = None;
        Ok(())
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if let Some((beside, _)) = &self.0 {
            // The incomplete file is useless; failing to remove it is not another failure.
            let _ = fs::remove_file(beside);
        }
    }
}

/// Most symbolic links that are followed, as on Linux.
const LINKS: usize = 40;

/// The path to which a symbolic link leads, also if nothing exists there yet.
fn followed(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..LINKS {
        let Ok(next) = fs::read_link(&path) else {
            break;
        };
        // An absolute path replaces the folder.
        path = path.parent().unwrap_or(Path::new("")).join(next);
    }
    path
}

#[cfg(unix)]
fn is_pipe(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    fs::metadata(path).is_ok_and(|data| data.file_type().is_fifo())
}

#[cfg(not(unix))]
fn is_pipe(_: &Path) -> bool {
    false
}

/// Whether two paths lead to the same file, as far as links and existing folders tell.
pub(crate) fn is_same(one: &Path, other: &Path) -> bool {
    let whole = |path: &Path| {
        let path = followed(path);
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => fs::canonicalize(folder),
            _ => fs::canonicalize("."),
        };
        let name = path.file_name().unwrap_or_default();
        folder.map_or(path.clone(), |folder| folder.join(name))
    };
    whole(one) == whole(other)
}

/// Removes the temporary files that killed runs left beside a file, where the system says which processes run.
fn remove_left_behind(path: &Path) {
    let processes = Path::new("/proc");
    let (Some(folder), Some(name)) = (path.parent(), path.file_name().and_then(OsStr::to_str)) else {
        return;
    };
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let (true, Ok(entries)) = (processes.join("self").exists(), fs::read_dir(folder)) else {
        return;
    };
    for entry in entries.flatten() {
        let entry_name = entry.file_name();
        let rest = entry_name.to_str().and_then(|text| text.strip_prefix(name));
        let process = rest.and_then(|rest| rest.strip_prefix('.')?.strip_suffix(".part"));
        let process = process.and_then(|process| process.parse::<u32>().ok());
        if process.is_some_and(|process| !processes.join(process.to_string()).exists()) {
            // What cannot be removed is in nobody's way.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// A file to write.
pub(crate) enum Target {
    /// Written next to its destination and moved into place, so that a failure keeps the existing file.
    File { path: PathBuf, beside: PathBuf },
    /// A device or a pipe.
    Device(PathBuf),
}

impl Target {
    pub(crate) fn of(path: &Path) -> Self {
        let path = followed(path);
        let device = fs::metadata(&path).is_ok_and(|data| !data.is_file() && !data.is_dir());
        if device {
            return Self::Device(path);
        }
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(format!(".{}.part", process::id()));
        let beside = path.with_file_name(name);
        Self::File { path, beside }
    }

    pub(crate) fn check(&self) -> io::Result<()> {
        match self {
            // Its reader would take the first opening for the whole answer.
            Self::Device(path) if is_pipe(path) => Ok(()),
            Self::Device(path) => OpenOptions::new().write(true).open(path).map(|_| ()),
            Self::File { path, beside } => {
                if path.is_dir() {
                    return Err(io::ErrorKind::IsADirectory.into());
                }
                remove_left_behind(path);
                File::create(beside)?;
                fs::remove_file(beside)
            }
        }
    }

    fn begin(&self) -> io::Result<(Unfinished, Begun)> {
        self.check()?;
        Ok(match self {
            Self::Device(path) => {
                let device = OpenOptions::new().write(true).open(path)?;
                (Unfinished(None), Box::new(device))
            }
            Self::File { path, beside } => {
                let file = File::create(beside)?;
                let moves = (beside.clone(), path.clone());
                (Unfinished(Some(moves)), Box::new(file))
            }
        })
    }

    pub(crate) fn write(&self, content: &[u8]) -> io::Result<()> {
        self.check()?;
        match self {
            Self::Device(path) => OpenOptions::new().write(true).open(path)?.write_all(content),
            Self::File { path, beside } => {
                let written = File::create(beside).and_then(|mut file| {
                    file.write_all(content)?;
                    file.sync_all()
                });
                let moved = written.and_then(|()| fs::rename(beside, path));
                if moved.is_err() {
                    // The incomplete file is useless; failing to remove it is not another failure.
                    let _ = fs::remove_file(beside);
                }
                moved
            }
        }
    }
}
