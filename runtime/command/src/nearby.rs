//! Suggestions for a file that cannot be read.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use eigentol_compiler::base::nearest::nearest;

/// Maximum number of files suggested.
const NAMED: usize = 5;

/// Advice on the file that may be meant: for a folder the declarations in it, otherwise the file with the nearest name.
pub(crate) fn nearby(path: &Path, why: ErrorKind) -> Option<String> {
    if why == ErrorKind::IsADirectory {
        let names: Vec<String> = declarations(path).iter().map(|file| file.display().to_string()).collect();
        return Some(match &names[..] {
            [] => "name a file: this is a folder".to_owned(),
            names => format!("name a file in it: `{}`", names.join("`, `")),
        });
    }
    if why != ErrorKind::NotFound {
        return None;
    }
    if let Some(value) = path.to_str().filter(|x| x.contains('=')) {
        return Some(format!("put the value after its option: `--set {value}`"));
    }
    // Compared without extensions, which would make any two names look alike.
    let files = files(path.parent()?);
    let stem = |file: &Path| Some(file.file_stem()?.to_str()?.to_owned());
    let stems: Vec<String> = files.iter().filter_map(|file| stem(file)).collect();
    let near = nearest(&stem(path)?, stems.iter().map(String::as_str))?;
    let file = files.iter().find(|file| stem(file).as_deref() == Some(near))?;
    Some(format!("did you mean `{}`?", file.display()))
}

/// A few declarations in a folder, by name.
fn declarations(folder: &Path) -> Vec<PathBuf> {
    let mut paths = files(folder);
    paths.retain(|file| is_declaration(file));
    paths.truncate(NAMED);
    paths
}

/// The files of a folder, declarations first, then by name; empty if the folder cannot be read.
fn files(folder: &Path) -> Vec<PathBuf> {
    let here = folder.as_os_str().is_empty();
    let read = fs::read_dir(if here { Path::new(".") } else { folder });
    let mut files: Vec<PathBuf> =
        read.into_iter().flatten().flatten().map(|entry| folder.join(entry.file_name())).collect();
    files.retain(|file| file.is_file());
    files.sort_by_key(|file| (!is_declaration(file), file.clone()));
    files
}

fn is_declaration(file: &Path) -> bool {
    file.extension().is_some_and(|x| x == "mechanism")
}
