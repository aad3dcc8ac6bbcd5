//! What a file that cannot be read may have been meant to be.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use eigentol_compiler::base::nearest::nearest;

/// Files that are named at most.
const NAMED: usize = 5;

/// The files that may be meant: in a folder those that it has, otherwise the one whose name is nearest.
pub(crate) fn nearby(path: &Path, why: ErrorKind) -> Option<String> {
    if why == ErrorKind::IsADirectory {
        let files = declarations(path);
        let names: Vec<String> = files.iter().map(|own| own.display().to_string()).collect();
        return Some(match &names[..] {
            [] => "name a file, this is a folder".to_owned(),
            names => format!("name a file in it: `{}`", names.join("`, `")),
        });
    }
    if why != ErrorKind::NotFound {
        return None;
    }
    if let Some(value) = path.to_str().filter(|own| own.contains('=')) {
        return Some(format!("a value stands behind its option: `--set {value}`"));
    }
    let folder = path.parent()?;
    let with_ending = path.with_extension("mechanism");
    if path.extension().is_none() && with_ending.exists() {
        return Some(format!("did you mean `{}`?", with_ending.display()));
    }
    let names: Vec<String> = (files(folder).iter())
        .filter_map(|own| Some(own.file_name()?.to_str()?.to_owned()))
        .collect();
    let near = nearest(
        path.file_name()?.to_str()?,
        names.iter().map(String::as_str),
    )?;
    Some(format!("did you mean `{}`?", folder.join(near).display()))
}

/// Some declarations of a folder, by name.
fn declarations(folder: &Path) -> Vec<PathBuf> {
    let mut found = files(folder);
    found.retain(|file| file.extension().is_some_and(|own| own == "mechanism"));
    found.truncate(NAMED);
    found
}

/// The files of a folder, by name; none where it cannot be read.
fn files(folder: &Path) -> Vec<PathBuf> {
    let folder = match folder.as_os_str().is_empty() {
        true => Path::new("."),
        false => folder,
    };
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    files.retain(|file| file.is_file());
    files.sort();
    files
}
